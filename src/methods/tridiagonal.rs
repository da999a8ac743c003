//! Tridiagonal systems by the sweep.

use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, Proof,
    Reference, ReferenceAnswer, Region, Rows, SolverAnswer,
};
use crate::reference::{Ball, tridiagonal as exact};
use crate::solvers::tridiagonal::{Sweep, TridiagonalError};
use rug::Rational;

/// Input `lower[n−1], diagonal[n], upper[n−1], d[n]`, output `x[n]`.
pub struct Audit;

pub(super) struct Parts<'a, T> {
    pub lower: &'a [T],
    pub diagonal: &'a [T],
    pub upper: &'a [T],
    pub d: &'a [T],
}

pub(super) fn split<T>(input: &[T]) -> Option<Parts<'_, T>> {
    let n = (input.len() + 2) / 4;
    if n == 0 || input.len() + 2 != 4 * n {
        return None;
    }
    let (lower, rest) = input.split_at(n - 1);
    let (diagonal, rest) = rest.split_at(n);
    let (upper, d) = rest.split_at(n - 1);
    Some(Parts {
        lower,
        diagonal,
        upper,
        d,
    })
}

/// The word for an error, the same for open and cyclic systems.
pub(super) fn word(e: &TridiagonalError) -> &'static str {
    match e {
        TridiagonalError::Pivot { .. } => "singular",
        TridiagonalError::NotFinite { .. } => "not finite",
        TridiagonalError::Overflow { .. } => "overflow",
        _ => "bad layout",
    }
}

fn solve(input: &[f64]) -> Result<Vec<f64>, &'static str> {
    let p = split(input).ok_or("bad layout")?;
    let a = Sweep::factor(p.lower, p.diagonal, p.upper).map_err(|e| word(&e))?;
    a.solve(p.d).map_err(|e| word(&e))
}

/// `|A⁻¹| (|A| |x| + |d|)`, entry by entry: the sum over all data of `|datum · ∂x_i/∂datum|`,
/// computed exactly and rounded once.
pub(super) fn conditions(
    inverse: &[Vec<Rational>],
    x: &[Rational],
    abs_row: impl Fn(usize) -> Rational,
) -> Vec<f64> {
    let v: Vec<Rational> = (0..x.len()).map(abs_row).collect();
    inverse
        .iter()
        .map(|row| {
            let terms = row.iter().zip(&v).map(|(a, v)| Rational::from(a * v).abs());
            terms.sum::<Rational>().to_f64()
        })
        .collect()
}

/// Exact values as balls.
pub(super) fn values(x: &[Rational], bits: u32) -> ReferenceAnswer {
    ReferenceAnswer::Values(Reference {
        values: x.iter().map(|q| Ball::rational(bits, q)).collect(),
        proof: Proof::Exact,
    })
}

/// Zero if two bit-identical answers, infinite otherwise.
pub(super) fn identical(a: &[f64], b: &[f64]) -> f64 {
    let same = a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.to_bits() == b.to_bits());
    if same { 0.0 } else { f64::INFINITY }
}

/// `|b| > |a| + |c|`, exactly.
pub(super) fn dominant(b: f64, a: f64, c: f64) -> bool {
    let size = |x: f64| Rational::from_f64(x.abs());
    match (size(b), size(a), size(c)) {
        (Some(b), Some(a), Some(c)) => b > a + c,
        _ => false,
    }
}

fn size(draw: &mut Draw) -> usize {
    draw.integer(1, 10)
}

/// A row: the off-diagonal entries and a diagonal that exceeds their sum by the factor.
fn assemble(
    draw: &mut Draw,
    n: usize,
    scale: fn(&mut Draw) -> f64,
    excess: fn(&mut Draw) -> f64,
) -> Vec<f64> {
    let (mut lower, mut diagonal, mut upper, mut d) = (vec![], vec![], vec![], vec![]);
    for i in 0..n {
        let s = scale(draw);
        let entry = |draw: &mut Draw, there: bool| {
            let size = draw.uniform(0.1, 1.0);
            if there { draw.signed(size * s) } else { 0.0 }
        };
        let (a, c) = (entry(draw, i > 0), entry(draw, i + 1 < n));
        let sum = if n == 1 { s } else { a.abs() + c.abs() };
        let b = sum * (1.0 + excess(draw));
        if i > 0 {
            lower.push(a);
        }
        diagonal.push(draw.signed(b));
        if i + 1 < n {
            upper.push(c);
        }
        d.push(draw.uniform(-1.0, 1.0) * s);
    }
    [lower, diagonal, upper, d].concat()
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "tridiagonal"
    }

    fn summary(&self) -> &'static str {
        "tridiagonal system with a diagonally dominant matrix, by the sweep without pivoting"
    }

    fn source(&self) -> &'static str {
        "Zinchenko 2008, eqs (18)-(20), corrected"
    }

    fn inputs(&self) -> Vec<Input> {
        let names = ["lower[n-1]", "diagonal[n]", "upper[n-1]", "d[n]"];
        names.map(|name| Input { name, unit: "1" }).to_vec()
    }

    fn outputs(&self) -> Vec<Output> {
        vec![Output {
            name: "x",
            unit: "1",
            budget: Budget::new(
                Limit::Conditioned(13.0),
                "a matrix dominant by rows is factored with |L||U| <= 3|A|, and the sweep solves a \
                 system off by 4u|L||U| (Higham, Accuracy and Stability, 2nd ed., th. 9.12-9.13); \
                 u more for the quotient -c/p",
            ),
        }]
    }

    fn rows(&self) -> Option<Rows> {
        Some(Rows {
            index: "i",
            count: "n",
            meaning: "the unknowns",
        })
    }

    fn domain(&self) -> Domain {
        let table_1 = vec![
            // lower, diagonal, upper of Table 1 (signs of the middle entries turned), U_0 = 3,
            // U_n = -5.
            1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 4.0, 4.0, 4.0, 4.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 3.0,
            7.0, -2.0, 4.0, 11.0, -5.0,
        ];
        Domain {
            regions: vec![
                Region {
                    name: "well-scaled",
                    description: "n = 1..10, entries 0.1..1, diagonal 1.05 to 3 times the row's rest",
                    sample: |d| {
                        let n = size(d);
                        assemble(d, n, |_| 1.0, |d| d.uniform(0.05, 2.0))
                    },
                },
                Region {
                    name: "badly-scaled",
                    description: "as well-scaled, each row times 1e-40..1e40",
                    sample: |d| {
                        let n = size(d);
                        assemble(
                            d,
                            n,
                            |d| d.log_uniform(1e-40, 1e40),
                            |d| d.uniform(0.05, 2.0),
                        )
                    },
                },
                Region {
                    name: "nearly-singular",
                    description: "n = 2..10, dominance by 1e-14..1e-3 only",
                    sample: |d| {
                        let n = d.integer(2, 10);
                        assemble(d, n, |_| 1.0, |d| d.log_uniform(1e-14, 1e-3))
                    },
                },
            ],
            check_points: vec![
                CheckPoint {
                    name: "table-1",
                    input: table_1,
                },
                CheckPoint {
                    name: "one",
                    input: vec![3.0, 1.0],
                },
                CheckPoint {
                    name: "singular-one",
                    input: vec![0.0, 1.0],
                },
                CheckPoint {
                    name: "singular",
                    input: vec![1.0, 1.0, 1.0, 1.0, 2.0, 3.0],
                },
                CheckPoint {
                    name: "singular-last-row",
                    input: vec![-1.0, -1.0, 1.0, 2.0, 1.0, -1.0, -1.0, 1.0, 0.0, 0.0],
                },
            ],
        }
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/tridiagonal.csv"))
    }

    /// Dominant by rows, as the budget supposes.
    fn admits(&self, input: &[f64]) -> bool {
        split(input).is_some_and(|p| {
            (0..p.d.len()).all(|i| {
                let before = if i > 0 { p.lower[i - 1] } else { 0.0 };
                dominant(
                    p.diagonal[i],
                    before,
                    p.upper.get(i).copied().unwrap_or(0.0),
                )
            })
        })
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match solve(input) {
            Ok(x) => SolverAnswer::Values(x),
            Err(why) => SolverAnswer::Refuses(why),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let Some(p) = split(input) else {
            return ReferenceAnswer::Refuses("bad layout");
        };
        match exact::solve(p.lower, p.diagonal, p.upper, p.d) {
            Some(x) => values(&x, bits),
            None => ReferenceAnswer::Refuses("singular"),
        }
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        let q: Vec<Rational> = input
            .iter()
            .filter_map(|&x| Rational::from_f64(x))
            .collect();
        let p = split(&q).filter(|_| q.len() == input.len())?;
        let inverse = exact::inverse(p.lower, p.diagonal, p.upper)?;
        let x = exact::solve(p.lower, p.diagonal, p.upper, p.d)?;
        let n = x.len();
        Some(conditions(&inverse, &x, |i| {
            let mut sum = Rational::from(&p.diagonal[i] * &x[i]).abs() + p.d[i].clone().abs();
            if i > 0 {
                sum += Rational::from(&p.lower[i - 1] * &x[i - 1]).abs();
            }
            if i + 1 < n {
                sum += Rational::from(&p.upper[i] * &x[i + 1]).abs();
            }
            sum
        }))
    }

    fn laws(&self) -> Vec<Law> {
        vec![
            Law {
                name: "scaling",
                statement: "x(A, 8 d) = 8 x(A, d) and x(8 A, 8 d) = x(A, d), bit for bit",
                residual: |input| {
                    let x = solve(input).ok()?;
                    let all: Vec<f64> = input.iter().map(|v| 8.0 * v).collect();
                    let n = split(input)?.d.len();
                    let mut right = input.to_vec();
                    right[3 * n - 2..].iter_mut().for_each(|v| *v *= 8.0);
                    let x8: Vec<f64> = x.iter().map(|v| 8.0 * v).collect();
                    let same = identical(&solve(&all).ok()?, &x);
                    Some(same + identical(&solve(&right).ok()?, &x8))
                },
            },
            Law {
                name: "signs",
                statement: "x(A, -d) = -x(A, d), bit for bit but for the sign of zero",
                residual: |input| {
                    let x = solve(input).ok()?;
                    let n = x.len();
                    let mut minus = input.to_vec();
                    minus[3 * n - 2..].iter_mut().for_each(|v| *v = -*v);
                    let y = solve(&minus).ok()?;
                    let same = x.iter().zip(&y).all(|(x, y)| *x == -*y);
                    Some(if same { 0.0 } else { f64::INFINITY })
                },
            },
        ]
    }
}

//! Cyclic tridiagonal systems.

use super::tridiagonal::{conditions, dominant, identical, values, word};
use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, ReferenceAnswer,
    Region, Rows, SolverAnswer,
};
use crate::reference::tridiagonal as exact;
use crate::solvers::cyclic_tridiagonal::CyclicSweep;
use rug::Rational;

/// Input `lower[n], diagonal[n], upper[n], d[n]`, output `x[n]`.
pub struct Audit;

pub(super) fn split<T>(input: &[T]) -> Option<[&[T]; 4]> {
    let n = input.len() / 4;
    if n < 3 || !input.len().is_multiple_of(4) {
        return None;
    }
    Some([0, 1, 2, 3].map(|k| &input[k * n..(k + 1) * n]))
}

fn solve(input: &[f64]) -> Result<Vec<f64>, &'static str> {
    let [l, b, u, d] = split(input).ok_or("bad layout")?;
    let a = CyclicSweep::factor(l, b, u).map_err(|e| word(&e))?;
    a.solve(d).map_err(|e| word(&e))
}

fn assemble(
    draw: &mut Draw,
    scale: fn(&mut Draw) -> f64,
    excess: fn(&mut Draw) -> f64,
) -> Vec<f64> {
    let n = draw.integer(3, 9);
    let mut parts: [Vec<f64>; 4] = Default::default();
    for _ in 0..n {
        let s = scale(draw);
        let entry = |draw: &mut Draw| {
            let size = draw.uniform(0.1, 1.0);
            draw.signed(size * s)
        };
        let (a, c) = (entry(draw), entry(draw));
        let b = (a.abs() + c.abs()) * (1.0 + excess(draw));
        let row = [a, draw.signed(b), c, draw.uniform(-1.0, 1.0) * s];
        for (part, v) in parts.iter_mut().zip(row) {
            part.push(v);
        }
    }
    parts.concat()
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "cyclic-tridiagonal"
    }

    fn summary(&self) -> &'static str {
        "cyclic tridiagonal system with a diagonally dominant matrix, by the sweep with one more column"
    }

    fn source(&self) -> &'static str {
        "Zinchenko 2008, eqs (18)-(20), closed to a ring"
    }

    fn inputs(&self) -> Vec<Input> {
        let names = ["lower[n]", "diagonal[n]", "upper[n]", "d[n]"];
        names.map(|name| Input { name, unit: "1" }).to_vec()
    }

    fn outputs(&self) -> Vec<Output> {
        vec![Output {
            name: "x",
            unit: "1",
            budget: Budget::new(
                Limit::Conditioned(24.0),
                "elimination of a matrix dominant by rows; the last row collects one product for \
                 each of at most 9 unknowns, n + 4 roundings against 4 of the open sweep, and \
                 |L||U| is a small multiple of |A|",
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
        let ring = |n: usize, a: f64, b: f64, c: f64, d: Vec<f64>| {
            [vec![a; n], vec![b; n], vec![c; n], d].concat()
        };
        Domain {
            regions: vec![
                Region {
                    name: "well-scaled",
                    description: "n = 3..9, entries 0.1..1, diagonal 1.05 to 3 times the row's rest",
                    sample: |d| assemble(d, |_| 1.0, |d| d.uniform(0.05, 2.0)),
                },
                Region {
                    name: "badly-scaled",
                    description: "as well-scaled, each row times 1e-40..1e40",
                    sample: |d| {
                        assemble(d, |d| d.log_uniform(1e-40, 1e40), |d| d.uniform(0.05, 2.0))
                    },
                },
                Region {
                    name: "nearly-singular",
                    description: "dominance by 1e-12..1e-3 only",
                    sample: |d| {
                        // One sign off the diagonal and the other on it: constants are almost
                        // in the kernel.
                        let mut v = assemble(d, |_| 1.0, |d| d.log_uniform(1e-12, 1e-3));
                        let n = v.len() / 4;
                        for (i, v) in v[..3 * n].iter_mut().enumerate() {
                            *v = if i / n == 1 { v.abs() } else { -v.abs() };
                        }
                        v
                    },
                },
            ],
            check_points: vec![
                CheckPoint {
                    name: "spline-ring",
                    input: ring(5, 1.0, 4.0, 1.0, vec![1.0, -2.0, 1.0, 0.5, -0.5]),
                },
                CheckPoint {
                    name: "smallest",
                    input: ring(3, 1.0, 4.0, 1.0, vec![6.0, 0.0, -6.0]),
                },
                CheckPoint {
                    name: "too-small",
                    input: ring(2, 1.0, 4.0, 1.0, vec![6.0, 0.0]),
                },
                CheckPoint {
                    name: "singular",
                    input: ring(3, -1.0, 2.0, -1.0, vec![1.0, 0.0, -1.0]),
                },
            ],
        }
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/cyclic-tridiagonal.csv"))
    }

    /// Dominant by rows, as the budget supposes.
    fn admits(&self, input: &[f64]) -> bool {
        split(input).is_some_and(|[l, b, u, _]| (0..b.len()).all(|i| dominant(b[i], l[i], u[i])))
    }

    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match solve(input) {
            Ok(x) => SolverAnswer::Values(x),
            Err(why) => SolverAnswer::Refuses(why),
        }
    }

    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        let Some([l, b, u, d]) = split(input) else {
            return ReferenceAnswer::Refuses("bad layout");
        };
        match exact::solve_cyclic(l, b, u, d) {
            Some(x) => values(&x, bits),
            None => ReferenceAnswer::Refuses("singular"),
        }
    }

    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        let q: Vec<Rational> = input
            .iter()
            .filter_map(|&x| Rational::from_f64(x))
            .collect();
        let [l, b, u, d] = split(&q).filter(|_| q.len() == input.len())?;
        let inverse = exact::inverse_cyclic(l, b, u)?;
        let x = exact::solve_cyclic(l, b, u, d)?;
        let n = x.len();
        Some(conditions(&inverse, &x, |i| {
            Rational::from(&l[i] * &x[(i + n - 1) % n]).abs()
                + Rational::from(&b[i] * &x[i]).abs()
                + Rational::from(&u[i] * &x[(i + 1) % n]).abs()
                + d[i].clone().abs()
        }))
    }

    fn laws(&self) -> Vec<Law> {
        vec![Law {
            name: "scaling",
            statement: "x(8 A, 8 d) = x(A, d), bit for bit",
            residual: |input| {
                let all: Vec<f64> = input.iter().map(|v| 8.0 * v).collect();
                Some(identical(&solve(input).ok()?, &solve(&all).ok()?))
            },
        }]
    }
}

//! Tridiagonal systems by the sweep.

use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::{conditioned, held, point, region};
use crate::methods::definition::{Definition, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::Undecided;
use crate::reference::tridiagonal::{self as reference, Solution};
use crate::solvers::tridiagonal::{Sweep, TridiagonalError};
use rug::Rational;

inputs! {
    /// A tridiagonal system `A x = d`.
    pub struct TridiagonalInput {
        /// Below the diagonal.
        lower: list "lower[n-1]", "1";
        /// The diagonal.
        diagonal: list "diagonal[n]", "1";
        /// Above the diagonal.
        upper: list "upper[n-1]", "1";
        /// The right-hand side.
        d: list "d[n]", "1";
    }
}

/// Tridiagonal systems `A x = d` by the sweep without pivoting: a pivot that is zero ends it, where
/// [`TridiagonalPivoting`](super::TridiagonalPivoting) exchanges rows.
///
/// A candidate is a `Fn(lower, diagonal, upper, d) -> x`, all slices of `f64`.
#[derive(Clone, Copy, Debug)]
pub struct Tridiagonal;

method! {
    Tridiagonal "tridiagonal":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d)
}

/// The word for a pivot before the last row that is zero or too small to divide by: without row
/// exchanges elimination ends there, whether the matrix is singular or not.
pub(super) const ZERO_PIVOT: &str = "zero pivot";

/// The word for an error of elimination without row exchanges in `rows` rows, the same for open
/// and cyclic systems.
pub(super) fn word(e: &TridiagonalError, rows: usize) -> &'static str {
    match e {
        // Nothing is left to be exchanged with.
        TridiagonalError::Pivot { row, .. } if row + 1 == rows => "singular",
        TridiagonalError::Pivot { .. } => ZERO_PIVOT,
        TridiagonalError::NotFinite { .. } => "not finite",
        TridiagonalError::Overflow { .. } => "overflow",
        _ => "bad layout",
    }
}

/// An error in words, with the method that does not end at a zero pivot.
pub(super) fn explained(e: &TridiagonalError, rows: usize) -> String {
    match word(e, rows) {
        ZERO_PIVOT => format!(
            "{e}: elimination without row exchanges ends here, tridiagonal-pivoting exchanges rows"
        ),
        _ => e.to_string(),
    }
}

/// The solution for another right-hand side.
fn solution(i: TridiagonalInput, d: &[f64]) -> Result<Vec<f64>, &'static str> {
    let word = |e: TridiagonalError| word(&e, d.len());
    let a = Sweep::factor(i.lower, i.diagonal, i.upper).map_err(word)?;
    a.solve(d).map_err(word)
}

/// The reference of tridiagonal systems.
pub(super) fn certified(
    i: TridiagonalInput<Rational>,
    bits: u32,
) -> Result<ReferenceAnswer, Uncertified> {
    let solution = reference::solution(i.lower, i.diagonal, i.upper, i.d, bits);
    answer(solution, bits)
}

/// The answer that a solution is.
pub(super) fn answer(solution: Solution, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
    match solution {
        Solution::Exact(x) => Ok(ReferenceAnswer::exact(&x, bits)),
        Solution::Enclosed(x) => Ok(ReferenceAnswer::bounded(
            x,
            "generators of the inverse, or elimination, in ball arithmetic",
        )),
        Solution::Singular => Err(Uncertified::Refused("singular")),
        Solution::Open => {
            Err(Undecided::new(bits, "whether the determinant of so long a system is zero").into())
        }
    }
}

/// The condition numbers of tridiagonal systems.
pub(super) fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
    let q = exact(numbers)?;
    let i = Tridiagonal::unpack(&q)?;
    reference::conditions(i.lower, i.diagonal, i.upper, i.d)
}

/// A row of outputs for each unknown.
pub(super) const UNKNOWNS: Rows = Rows {
    index: "i",
    count: "n",
    meaning: "the unknowns",
};

/// Zero if two bit-identical answers, infinite otherwise.
pub(in crate::methods) fn identical(a: &[f64], b: &[f64]) -> f64 {
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

impl Definition for Tridiagonal {
    type Input<'a, T: Number> = TridiagonalInput<'a, T>;
    const SUMMARY: &'static str =
        "tridiagonal system with a diagonally dominant matrix, by the sweep without pivoting";
    const SOURCE: &'static str = "Zinchenko 2008, eqs (18)-(20), corrected";

    fn outputs() -> Vec<Output> {
        let reason = "a matrix dominant by rows is factored with |L||U| <= 3|A|, and the sweep solves a \
                      system off by 4u|L||U| (Higham, Accuracy and Stability, 2nd ed., \
                      th. 9.12-9.13); u more for the quotient -c/p";
        vec![conditioned("x", "1", 13.0, reason)]
    }

    fn rows() -> Option<Rows> {
        Some(UNKNOWNS)
    }

    fn domain() -> Domain {
        let table_1 = vec![
            // lower, diagonal, upper of Table 1 (signs of the middle entries turned), U_0 = 3,
            // U_n = -5.
            1.0, 1.0, 1.0, 1.0, 0.0, 1.0, 4.0, 4.0, 4.0, 4.0, 1.0, 0.0, 1.0, 1.0, 1.0, 1.0, 3.0,
            7.0, -2.0, 4.0, 11.0, -5.0,
        ];
        Domain {
            regions: vec![
                region(
                    "well-scaled",
                    "n = 1..10, entries 0.1..1, diagonal 1.05 to 3 times the row's rest",
                    |d| {
                        let n = size(d);
                        assemble(d, n, |_| 1.0, |d| d.uniform(0.05, 2.0))
                    },
                ),
                region(
                    "badly-scaled",
                    "as well-scaled, each row times 1e-40..1e40",
                    |d| {
                        let n = size(d);
                        assemble(
                            d,
                            n,
                            |d| d.log_uniform(1e-40, 1e40),
                            |d| d.uniform(0.05, 2.0),
                        )
                    },
                ),
                region(
                    "nearly-singular",
                    "n = 2..10, dominance by 1e-14..1e-3 only",
                    |d| {
                        let n = d.integer(2, 10);
                        assemble(d, n, |_| 1.0, |d| d.log_uniform(1e-14, 1e-3))
                    },
                ),
            ],
            check_points: vec![
                point("table-1", table_1),
                point("one", [3.0, 1.0]),
                point("singular-one", [0.0, 1.0]),
                point("singular", [1.0, 1.0, 1.0, 1.0, 2.0, 3.0]),
                point(
                    "singular-last-row",
                    [-1.0, -1.0, 1.0, 2.0, 1.0, -1.0, -1.0, 1.0, 0.0, 0.0],
                ),
            ],
        }
    }

    /// Dominant by rows, as the budget supposes.
    fn admits(i: Self::Input<'_, f64>) -> bool {
        (0..i.d.len()).all(|k| {
            let before = if k > 0 { i.lower[k - 1] } else { 0.0 };
            let after = i.upper.get(k).copied().unwrap_or(0.0);
            dominant(i.diagonal[k], before, after)
        })
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        solution(i, i.d)
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        certified(i, bits)
    }

    fn may_refuse(i: Self::Input<'_, Rational>) -> Option<&'static str> {
        reference::has_zero_pivot(i.lower, i.diagonal, i.upper).then_some(ZERO_PIVOT)
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        let sweep = Sweep::factor(i.lower, i.diagonal, i.upper);
        let e = sweep.and_then(|a| a.solve(i.d)).err()?;
        Some(explained(&e, i.d.len()))
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions(numbers)
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "scaling",
                statement: "x(A, 8 d) = 8 x(A, d) and x(8 A, 8 d) = x(A, d), bit for bit",
                residual: |numbers| scaling(solution, Tridiagonal::unpack(numbers)?),
            },
            Law {
                name: "signs",
                statement: "x(A, -d) = -x(A, d), bit for bit but for the sign of zero",
                residual: |numbers| signs(solution, Tridiagonal::unpack(numbers)?),
            },
        ]
    }
}

/// A solver of a system with another right-hand side.
pub(super) type Solve = fn(TridiagonalInput, &[f64]) -> Result<Vec<f64>, &'static str>;

pub(super) fn scaling(solve: Solve, i: TridiagonalInput) -> Option<f64> {
    let times_8 = |v: &[f64]| v.iter().map(|v| 8.0 * v).collect::<Vec<f64>>();
    let x = solve(i, i.d).ok()?;
    let [lower, diagonal, upper, d] = [i.lower, i.diagonal, i.upper, i.d].map(times_8);
    let (lower, diagonal, upper) = (&lower[..], &diagonal[..], &upper[..]);
    let larger = TridiagonalInput {
        lower,
        diagonal,
        upper,
        d: &d,
    };
    let (both, right) = (solve(larger, &d).ok()?, solve(i, &d).ok()?);
    Some(identical(&both, &x) + identical(&right, &times_8(&x)))
}

pub(super) fn signs(solve: Solve, i: TridiagonalInput) -> Option<f64> {
    let minus: Vec<f64> = i.d.iter().map(|v| -v).collect();
    let (x, y) = (solve(i, i.d).ok()?, solve(i, &minus).ok()?);
    held(x.iter().zip(&y).all(|(x, y)| *x == -*y))
}

#[cfg(test)]
mod tests;

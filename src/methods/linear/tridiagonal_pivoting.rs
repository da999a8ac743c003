//! Tridiagonal systems by elimination with row exchanges.

use super::tridiagonal::{
    Solve, TridiagonalInput, UNKNOWNS, certified, conditions, scaling, signs,
};
use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::{conditioned, point, region};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::solvers::tridiagonal::{Pivoted, TridiagonalError};
use rug::Rational;

/// Tridiagonal systems `A x = d` by elimination with partial pivoting and one step of refinement,
/// for matrices that need not be dominant.
///
/// A candidate is a `Fn(lower, diagonal, upper, d) -> x`, all slices of `f64`.
#[derive(Clone, Copy, Debug)]
pub struct TridiagonalPivoting;

method! {
    TridiagonalPivoting "tridiagonal-pivoting":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d)
}

fn word(e: &TridiagonalError) -> &'static str {
    match e {
        TridiagonalError::Pivot { .. } => "singular",
        TridiagonalError::NotFinite { .. } => "not finite",
        TridiagonalError::Overflow { .. } => "overflow",
        _ => "bad layout",
    }
}

fn solution(i: TridiagonalInput, d: &[f64]) -> Result<Vec<f64>, &'static str> {
    let a = Pivoted::factor(i.lower, i.diagonal, i.upper).map_err(|e| word(&e))?;
    a.solve(d).map_err(|e| word(&e))
}

const SOLUTION: Solve = solution;

/// A system of up to ten rows with the diagonal and the entries beside it drawn apart, each row
/// times a scale.
fn assemble(
    draw: &mut Draw,
    diagonal: fn(&mut Draw) -> f64,
    scale: fn(&mut Draw) -> f64,
) -> Vec<f64> {
    let n = draw.integer(2, 10);
    let mut parts: [Vec<f64>; 4] = Default::default();
    for i in 0..n {
        let s = scale(draw);
        let entry = |draw: &mut Draw| {
            let size = draw.uniform(0.1, 1.0);
            draw.signed(size * s)
        };
        if i > 0 {
            parts[0].push(entry(draw));
        }
        parts[1].push(s * diagonal(draw));
        if i + 1 < n {
            parts[2].push(entry(draw));
        }
        parts[3].push(draw.uniform(-1.0, 1.0) * s);
    }
    parts.concat()
}

fn small(draw: &mut Draw) -> f64 {
    let size = draw.log_uniform(1e-20, 1e-3);
    draw.signed(size)
}

fn any(draw: &mut Draw) -> f64 {
    draw.uniform(-2.0, 2.0)
}

impl Definition for TridiagonalPivoting {
    type Input<'a, T: Number> = TridiagonalInput<'a, T>;
    const SUMMARY: &'static str =
        "tridiagonal system with any regular matrix, by elimination with partial pivoting";
    const SOURCE: &'static str = "Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., sections 9.6 and 12.2; \
         Skeel, Math. Comp. 35, 1980";

    fn outputs() -> Vec<Output> {
        let reason = "one step of refinement leaves a small componentwise backward error (Skeel): three terms of \
                      a residual in working precision, and as much again for what the second elimination adds";
        vec![conditioned("x", "1", 13.0, reason)]
    }

    fn rows() -> Option<Rows> {
        Some(UNKNOWNS)
    }

    fn domain() -> Domain {
        Domain {
            regions: vec![
                region(
                    "small-diagonal",
                    "n = 2..10, entries 0.1..1 beside a diagonal of 1e-20..1e-3",
                    |d| assemble(d, small, |_| 1.0),
                ),
                region(
                    "any-diagonal",
                    "n = 2..10, entries 0.1..1 beside a diagonal of -2..2",
                    |d| assemble(d, any, |_| 1.0),
                ),
                region(
                    "badly-scaled",
                    "as any-diagonal, each row times 1e-40..1e40",
                    |d| assemble(d, any, |d| d.log_uniform(1e-40, 1e40)),
                ),
            ],
            check_points: vec![
                point("zero-pivot", [1.0, 0.0, 0.0, 1.0, 3.0, 4.0]),
                point(
                    "zero-in-the-middle",
                    [1.0, 3.0, 2.0, 0.5, 4.0, 1.0, 2.0, 2.0, 7.0, 18.0],
                ),
                point("one", [3.0, 1.0]),
                point("singular-one", [0.0, 1.0]),
                point("singular", [1.0, 1.0, 1.0, 1.0, 2.0, 3.0]),
            ],
        }
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        solution(i, i.d)
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        certified(i, bits)
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        let a = Pivoted::factor(i.lower, i.diagonal, i.upper);
        let e = a.and_then(|a| a.solve(i.d)).err()?;
        Some(e.to_string())
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions(numbers)
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "scaling",
                statement: "x(A, 8 d) = 8 x(A, d) and x(8 A, 8 d) = x(A, d), bit for bit",
                residual: |numbers| scaling(SOLUTION, TridiagonalPivoting::unpack(numbers)?),
            },
            Law {
                name: "signs",
                statement: "x(A, -d) = -x(A, d), bit for bit but for the sign of zero",
                residual: |numbers| signs(SOLUTION, TridiagonalPivoting::unpack(numbers)?),
            },
        ]
    }
}

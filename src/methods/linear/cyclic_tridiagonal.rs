//! Cyclic tridiagonal systems.

use super::tridiagonal::{UNKNOWNS, ZERO_PIVOT, answer, dominant, identical, word};
use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::{conditioned, point, region};
use crate::methods::definition::{Definition, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::tridiagonal as reference;
use crate::solvers::cyclic_tridiagonal::CyclicSweep;
use rug::Rational;

inputs! {
    /// A cyclic tridiagonal system `A x = d` of at least three rows.
    pub struct CyclicTridiagonalInput {
        /// Before the diagonal; that of the first row stands in the last column.
        lower: list "lower[n]", "1";
        /// The diagonal.
        diagonal: list "diagonal[n]", "1";
        /// After the diagonal; that of the last row stands in the first column.
        upper: list "upper[n]", "1";
        /// The right-hand side.
        d: list "d[n]", "1";
    }
}

/// Cyclic tridiagonal systems `A x = d` by the sweep with one more column.
///
/// A candidate is a `Fn(lower, diagonal, upper, d) -> x`, all slices of the same length; `lower[0]`
/// stands in the last column, the last of `upper` in the first.
#[derive(Clone, Copy, Debug)]
pub struct CyclicTridiagonal;

method! {
    CyclicTridiagonal "cyclic-tridiagonal":
        Fn(&[f64], &[f64], &[f64], &[f64]), |f, i| f(i.lower, i.diagonal, i.upper, i.d)
}

fn is_ring<T: Number>(i: CyclicTridiagonalInput<T>) -> bool {
    i.d.len() >= 3
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

impl Definition for CyclicTridiagonal {
    type Input<'a, T: Number> = CyclicTridiagonalInput<'a, T>;
    const SUMMARY: &'static str = "cyclic tridiagonal system with a diagonally dominant matrix, by the sweep with one more column";
    const SOURCE: &'static str = "Zinchenko 2008, eqs (18)-(20), closed to a ring";

    fn outputs() -> Vec<Output> {
        let reason = "elimination of a matrix dominant by rows; the last row collects one product for each \
                      of at most 9 unknowns, n + 4 roundings against 4 of the open sweep, and |L||U| \
                      is a small multiple of |A|";
        vec![conditioned("x", "1", 24.0, reason)]
    }

    fn rows() -> Option<Rows> {
        Some(UNKNOWNS)
    }

    fn domain() -> Domain {
        let ring = |n: usize, a: f64, b: f64, c: f64, d: Vec<f64>| {
            [vec![a; n], vec![b; n], vec![c; n], d].concat()
        };
        Domain {
            regions: vec![
                region(
                    "well-scaled",
                    "n = 3..9, entries 0.1..1, diagonal 1.05 to 3 times the row's rest",
                    |d| assemble(d, |_| 1.0, |d| d.uniform(0.05, 2.0)),
                ),
                region(
                    "badly-scaled",
                    "as well-scaled, each row times 1e-40..1e40",
                    |d| assemble(d, |d| d.log_uniform(1e-40, 1e40), |d| d.uniform(0.05, 2.0)),
                ),
                region("nearly-singular", "dominance by 1e-12..1e-3 only", |d| {
                    // One sign off the diagonal and the other on it: constants are almost
                    // in the kernel.
                    let mut v = assemble(d, |_| 1.0, |d| d.log_uniform(1e-12, 1e-3));
                    let n = v.len() / 4;
                    for (i, v) in v[..3 * n].iter_mut().enumerate() {
                        *v = if i / n == 1 { v.abs() } else { -v.abs() };
                    }
                    v
                }),
            ],
            check_points: vec![
                point(
                    "spline-ring",
                    ring(5, 1.0, 4.0, 1.0, vec![1.0, -2.0, 1.0, 0.5, -0.5]),
                ),
                point("smallest", ring(3, 1.0, 4.0, 1.0, vec![6.0, 0.0, -6.0])),
                point("too-small", ring(2, 1.0, 4.0, 1.0, vec![6.0, 0.0])),
                point("singular", ring(3, -1.0, 2.0, -1.0, vec![1.0, 0.0, -1.0])),
            ],
        }
    }

    /// Dominant by rows, as the budget supposes.
    fn admits(i: Self::Input<'_, f64>) -> bool {
        is_ring(i) && (0..i.d.len()).all(|k| dominant(i.diagonal[k], i.lower[k], i.upper[k]))
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let word = |e| word(&e, i.d.len());
        let sweep = CyclicSweep::factor(i.lower, i.diagonal, i.upper).map_err(word)?;
        sweep.solve(i.d).map_err(word)
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        if !is_ring(i) {
            return Err(Uncertified::Refused("bad layout"));
        }
        answer(
            reference::solution_cyclic(i.lower, i.diagonal, i.upper, i.d, bits),
            bits,
        )
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        let sweep = CyclicSweep::factor(i.lower, i.diagonal, i.upper);
        let e = sweep.and_then(|a| a.solve(i.d)).err()?;
        Some(e.to_string())
    }

    fn may_refuse(i: Self::Input<'_, Rational>) -> Option<&'static str> {
        let rows = i.d.len();
        let has_zero_pivot = is_ring(i)
            && reference::has_zero_pivot(&i.lower[1..], i.diagonal, &i.upper[..rows - 1]);
        has_zero_pivot.then_some(ZERO_PIVOT)
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        let q = exact(numbers)?;
        let i = Self::unpack(&q).filter(|i| is_ring(*i))?;
        reference::conditions_cyclic(i.lower, i.diagonal, i.upper, i.d)
    }

    fn laws() -> Vec<Law> {
        vec![Law {
            name: "scaling",
            statement: "x(8 A, 8 d) = x(A, d), bit for bit",
            residual: |numbers| scaling(|i| CyclicTridiagonal::solve(i).ok(), numbers),
        }]
    }
}

fn scaling(
    solve: impl Fn(CyclicTridiagonalInput) -> Option<Vec<f64>>,
    numbers: &[f64],
) -> Option<f64> {
    let all: Vec<f64> = numbers.iter().map(|v| 8.0 * v).collect();
    let solved = |numbers| solve(CyclicTridiagonal::unpack(numbers)?);
    Some(identical(&solved(numbers)?, &solved(&all)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solver_that_does_not_scale_breaks_the_law() {
        let ring: Vec<f64> = (1..=12).map(f64::from).collect();
        let law =
            |solve: fn(CyclicTridiagonalInput) -> Vec<f64>| scaling(|i| Some(solve(i)), &ring);
        assert_eq!(law(|i| vec![i.d[0] / i.diagonal[0]]), Some(0.0));
        assert_eq!(law(|i| i.d.to_vec()), Some(f64::INFINITY));
        assert_eq!(scaling(|_| None, &ring), None);
    }

    /// Two rows are no ring, and every row counts.
    #[test]
    fn rings_of_dominant_rows_are_admitted() {
        let method = crate::methods::find("cyclic-tridiagonal").unwrap();
        let ring = |diagonal: &[f64]| {
            let ones = vec![1.0; diagonal.len()];
            method.admits(&[&ones[..], diagonal, &ones, &ones].concat())
        };
        assert!(ring(&[4.0, -3.0, 2.5]) && ring(&[4.0; 5]));
        for k in 0..3 {
            let mut diagonal = [4.0; 3];
            diagonal[k] = 2.0;
            assert!(!ring(&diagonal), "{k}");
        }
        assert!(!ring(&[4.0; 2]));
    }
}

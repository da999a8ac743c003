//! Cubic splines on equally spaced knots: the fit with the constant λ.

use super::common::{ROWS, outputs, outputs_of, reference_of};
use super::domain::a_few_floats_away;
use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::{held, point, region};
use crate::methods::definition::{Definition, conditions_at_reference, method};
use crate::methods::inputs::{Number, inputs};
use crate::methods::linear::identical;
use crate::reference::Ball;
use crate::reference::cubic_spline::{Spline as ExactSpline, SplineError};
use crate::solvers::cubic_spline::{Boundary, CubicSplineError, UniformCubicSpline};
use rug::Rational;

inputs! {
    /// Data of a spline on equal steps.
    pub struct CubicSplineUniformInput {
        x0: number "x0", "x";
        h: number "h", "x";
        m0: number "m0", "y/x^2";
        mn: number "mn", "y/x^2";
        q0: number "q0", "x";
        q1: number "q1", "x";
        y: list "y[n+1]", "y";
    }
}

/// A spline on equal steps to be made and where it is asked for.
#[derive(Clone, Copy, Debug)]
pub struct UniformSplineProblem<'a> {
    /// The first knot.
    pub x0: f64,
    /// The step; one that is not positive has to be refused.
    pub h: f64,
    /// The second derivatives at the ends.
    pub ends: [f64; 2],
    /// The ordinates.
    pub y: &'a [f64],
    /// Two abscissae, as in [`SplineProblem`](super::SplineProblem).
    pub queries: [f64; 2],
}

impl<'a> From<CubicSplineUniformInput<'a>> for UniformSplineProblem<'a> {
    fn from(i: CubicSplineUniformInput<'a>) -> UniformSplineProblem<'a> {
        let (ends, queries) = ([i.m0, i.mn], [i.q0, i.q1]);
        let CubicSplineUniformInput { x0, h, y, .. } = i;
        UniformSplineProblem {
            x0,
            h,
            ends,
            y,
            queries,
        }
    }
}

/// Cubic splines on equal steps with given second derivatives at the ends: the fit with the
/// constant λ.
///
/// A candidate is a `Fn(UniformSplineProblem) -> [[S, S', S'', S''', integral]; 2]`.
#[derive(Clone, Copy, Debug)]
pub struct CubicSplineUniform;

method! {
    CubicSplineUniform "cubic-spline-uniform": Fn(UniformSplineProblem<'_>), |f, i| f(i.into())
}

fn try_fit(i: CubicSplineUniformInput) -> Result<UniformCubicSpline, CubicSplineError> {
    let ends = Boundary::second_derivatives(i.m0, i.mn);
    UniformCubicSpline::fit(i.x0, i.h, i.y.to_vec(), ends)
}

fn fit(i: CubicSplineUniformInput) -> Result<UniformCubicSpline, &'static str> {
    try_fit(i).map_err(|e| match e {
        CubicSplineError::TooFewKnots { .. } => "too few knots",
        CubicSplineError::Step { .. } => "bad step",
        CubicSplineError::NotFinite { .. } => "not finite",
        _ => "overflow",
    })
}

/// Data of a number of segments between two limits.
fn sample(draw: &mut Draw, segments: [usize; 2], shape: Shape) -> Vec<f64> {
    let n = draw.integer(segments[0], segments[1]);
    let (sx, sy) = match shape {
        Shape::Scaled => (draw.log_uniform(1e-30, 1e30), draw.log_uniform(1e-30, 1e30)),
        _ => (1.0, 1.0),
    };
    let (x0, h) = (draw.uniform(-5.0, 5.0) * sx, draw.uniform(0.1, 2.0) * sx);
    let end = |draw: &mut Draw| draw.uniform(-5.0, 5.0) * sy / sx / sx;
    let (m0, mn) = (end(draw), end(draw));
    let query = |draw: &mut Draw| match shape {
        Shape::NearKnots => {
            let knot = x0 + h * draw.integer(1, n - 1) as f64;
            a_few_floats_away(draw, knot)
        }
        _ => x0 + h * draw.uniform(0.0, n as f64 * (1.0 - 1e-15)),
    };
    let (q0, q1) = (query(draw), query(draw));
    let mut input = vec![x0, h, m0, mn, q0, q1];
    for _ in 0..=n {
        let v = draw.uniform(-5.0, 5.0) * sy;
        input.push(if shape == Shape::Scaled {
            v * draw.log_uniform(1e-8, 1e8)
        } else {
            v
        });
    }
    input
}

#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Well,
    Scaled,
    NearKnots,
}

/// `Σ |y_j ∂f/∂y_j| + Σ |end ∂f/∂end|` of the functional `Σ e_j y_j + Σ c_j M_j`, where `M` solves
/// the spline's system, and `Σ end ∂f/∂end`: one solve with the transposed matrix.
fn linear_condition(y: &[f64], ends: [f64; 2], e: Vec<f64>, c: &[f64]) -> [f64; 2] {
    let n = y.len() - 1;
    let z = transposed_solve(c);
    let mut weight = e;
    for i in 1..n {
        weight[i - 1] += z[i];
        weight[i] -= 2.0 * z[i];
        weight[i + 1] += z[i];
    }
    let values: f64 = weight.iter().zip(y).map(|(w, y)| (w * y).abs()).sum();
    let ends = [ends[0] * z[0], ends[1] * z[n]];
    [values + ends[0].abs() + ends[1].abs(), ends[0] + ends[1]]
}

/// Solves `Aᵀ z = c` for the spline's matrix: rows `1, 4, 1` between unit rows at both ends. The
/// unknowns between the ends form a symmetric system of their own, eliminated from the last to the
/// first; nothing of the solver under audit is used.
fn transposed_solve(c: &[f64]) -> Vec<f64> {
    let n = c.len() - 1;
    let mut z = c.to_vec();
    if n < 2 {
        return z;
    }
    let mut pivot = vec![4.0; n];
    for i in (1..n - 1).rev() {
        pivot[i] = 4.0 - 1.0 / pivot[i + 1];
        z[i] -= z[i + 1] / pivot[i + 1];
    }
    z[1] /= pivot[1];
    for i in 2..n {
        z[i] = (z[i] - z[i - 1]) / pivot[i];
    }
    z[0] -= z[1];
    z[n] -= z[n - 1];
    z
}

impl Definition for CubicSplineUniform {
    type Input<'a, T: Number> = CubicSplineUniformInput<'a, T>;
    const SUMMARY: &'static str =
        "cubic spline on equal steps with given second derivatives at the ends";
    const SOURCE: &'static str =
        "Zinchenko 2008, eqs (8)-(20), corrected, with the limit of lambda";

    fn outputs() -> Vec<Output> {
        outputs(16.0)
    }

    fn rows() -> Option<Rows> {
        Some(ROWS)
    }

    fn domain() -> Domain {
        let point = |name, head: [f64; 6], y: &[f64]| point(name, [&head[..], y].concat());
        Domain {
            regions: vec![
                region(
                    "short",
                    "1 to 12 segments, steps 0.1..2, ordinates -5..5",
                    |d| sample(d, [1, 12], Shape::Well),
                ),
                region(
                    "seam",
                    "40 to 60 segments: where the constant lambda takes over (24 from each end)",
                    |d| sample(d, [40, 60], Shape::Well),
                ),
                region("long", "100 to 250 segments", |d| {
                    sample(d, [100, 250], Shape::Well)
                }),
                region(
                    "badly-scaled",
                    "2 to 60 segments, units from 1e-30 to 1e30, ordinates spread over 16 orders",
                    |d| sample(d, [2, 60], Shape::Scaled),
                ),
                region(
                    "near-knots",
                    "2 to 60 segments, queries at most three floats away from a rounded knot",
                    |d| sample(d, [2, 60], Shape::NearKnots),
                ),
            ],
            check_points: vec![
                point("one-segment", [0.0, 1.0, 3.0, -5.0, 0.25, 1.0], &[1.0, 2.0]),
                point(
                    "table-1",
                    [0.0, 0.5, 3.0, -5.0, 0.0, 2.5],
                    &[0.0, 1.0, -1.0, 2.0, 0.5, -3.0],
                ),
                point("decimal-step", [0.1, 0.1, 0.0, 0.0, 0.3, 0.7], &[1.0; 12]),
                point("one-knot", [0.0, 1.0, 0.0, 0.0, 0.0, 0.0], &[1.0]),
                point("no-step", [0.0, 0.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 2.0]),
                point("backwards", [0.0, -1.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 2.0]),
                point("outside", [0.0, 1.0, 0.0, 0.0, 0.5, 2.5], &[1.0, 2.0, 0.0]),
            ],
        }
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        outputs_of(&fit(i)?, [i.q0, i.q1])
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        try_fit(i).err().map(|e| e.to_string())
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let knot = |k| Rational::from(i.h * k as u32) + i.x0;
        let x: Vec<Rational> = (0..i.y.len()).map(knot).collect();
        let spline = ExactSpline::second_derivatives(&x, i.y, i.m0, i.mn).map_err(|e| match e {
            SplineError::TooFew(_) => Uncertified::Refused("too few knots"),
            SplineError::NotIncreasing(_) => Uncertified::Refused("bad step"),
            e => Uncertified::Failed(e.to_string()),
        })?;
        reference_of(&spline, &x, [i.q0, i.q1], bits)
    }

    /// The spline is linear in ordinates and end values, whose weights come from one transposed
    /// solve each; moving or stretching the abscissae acts through the spline's own derivatives.
    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions_at_reference::<Self>(numbers, 128)
    }

    fn conditions_at(numbers: &[f64], values: &[Ball]) -> Option<Vec<f64>> {
        let base: Vec<f64> = values.iter().map(Ball::to_f64).collect();
        let i = Self::unpack(numbers)?;
        let CubicSplineUniformInput { x0, h, y, .. } = i;
        let queries = [i.q0, i.q1];
        let n = y.len() - 1;
        let ends = [i.m0, i.mn].map(|m| m * (h * h / 6.0));
        let locate = |q: f64| {
            let t = (q - x0) / h;
            let i = (t.max(0.0) as usize).min(n - 1);
            (i, (t - i as f64).clamp(0.0, 1.0))
        };
        let linear = |f: &dyn Fn(&mut [f64], &mut [f64])| {
            let (mut e, mut c) = (vec![0.0; n + 1], vec![0.0; n + 1]);
            f(&mut e, &mut c);
            linear_condition(y, ends, e, &c)
        };
        // ∫ from x_0 to the query, over h.
        let area = |q: f64, sign: f64, e: &mut [f64], c: &mut [f64]| {
            let (i, k) = locate(q);
            for j in 0..i {
                for a in [j, j + 1] {
                    e[a] += 0.5 * sign;
                    c[a] -= 0.25 * sign;
                }
            }
            e[i] += sign * k * (1.0 - 0.5 * k);
            e[i + 1] += sign * 0.5 * k * k;
            c[i] -= sign * 0.25 * (k * (2.0 - k)).powi(2);
            c[i + 1] -= sign * 0.25 * k * k * (2.0 - k * k);
        };
        let mut out = Vec::new();
        for (a, b) in [(0, 1), (1, 0)] {
            let (q, other) = (queries[a], queries[b]);
            let (i, k) = locate(q);
            let w = 1.0 - k;
            let [s, d, dd, ddd, integral] = base[5 * a..5 * a + 5] else {
                return None;
            };
            // |q f'| + |x0 f'| + |h ∂f/∂h|, with h ∂f/∂h = −order·f − (q − x0) f' + 2 Σ end
            // ∂f/∂end: beside a longer step a second derivative that stays is a larger one.
            let moved = |order: f64, f: f64, df: f64, ends: f64| {
                ((q * df).abs() + (x0 * df).abs()) + (2.0 * ends - order * f - (q - x0) * df).abs()
            };
            let [value, of_value] = linear(&|e, c| {
                (e[i], e[i + 1]) = (w, k);
                (c[i], c[i + 1]) = (-k * w * (1.0 + w), -k * w * (1.0 + k));
            });
            let [first, of_first] = linear(&|e, c| {
                (e[i], e[i + 1]) = (-1.0, 1.0);
                (c[i], c[i + 1]) = (1.0 - 3.0 * w * w, 3.0 * k * k - 1.0);
            });
            let [second, of_second] = linear(&|_, c| (c[i], c[i + 1]) = (6.0 * w, 6.0 * k));
            let [third, of_third] = linear(&|_, c| (c[i], c[i + 1]) = (-6.0, 6.0));
            let [whole, of_whole] = linear(&|e, c| {
                area(other, 1.0, e, c);
                area(q, -1.0, e, c);
            });
            let at_other = base[5 * b];
            let stretched = integral - (other - x0) * at_other + (q - x0) * s + 2.0 * of_whole * h;
            out.push(value + moved(0.0, s, d, of_value));
            out.push(first / h + moved(1.0, d, dd, of_first / h));
            out.push(second / h / h + moved(2.0, dd, ddd, of_second / h / h));
            out.push(third / h / h / h + moved(3.0, ddd, 0.0, of_third / h / h / h));
            out.push(
                whole * h
                    + (q * s).abs()
                    + (other * at_other).abs()
                    + (x0 * (at_other - s)).abs()
                    + stretched.abs(),
            );
        }
        Some(out)
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "interpolation",
                statement: "S(x0 + i h) = y_i exactly, wherever x0 + i h is a float",
                residual: |numbers| {
                    let i = CubicSplineUniform::unpack(numbers)?;
                    let s = fit(i).ok()?;
                    held(interpolates(i, |x| s.value(x).ok())?)
                },
            },
            Law {
                name: "sorted-batch",
                statement: "a sorted batch gives the single values bit for bit",
                residual: |numbers| {
                    let i = CubicSplineUniform::unpack(numbers)?;
                    let s = fit(i).ok()?;
                    let (x0, h, n) = (i.x0, i.h, i.y.len() - 1);
                    let x: Vec<f64> = (0..40 * n)
                        .map(|i| (x0 + h * (i as f64 / 40.0)).max(x0))
                        .collect();
                    let single: Option<Vec<f64>> = x.iter().map(|&x| s.value(x).ok()).collect();
                    let mut batch = vec![0.0; x.len()];
                    s.values_sorted(&x, &mut batch).ok()?;
                    Some(identical(&single?, &batch))
                },
            },
        ]
    }
}

/// Returns whether a function has the ordinates at all knots that are floats; nothing without
/// steps.
fn interpolates(i: CubicSplineUniformInput, value: impl Fn(f64) -> Option<f64>) -> Option<bool> {
    let (x0, h) = (Rational::from_f64(i.x0)?, Rational::from_f64(i.h)?);
    let hit = |(i, y): (usize, &f64)| {
        let exact = Rational::from(&h * i as u32) + &x0;
        let x = exact.to_f64();
        Rational::from_f64(x) != Some(exact) || value(x) == Some(*y)
    };
    Some(i.y.iter().enumerate().all(hit))
}

#[cfg(test)]
mod tests;

//! Cubic splines with a condition of its own at each end.

use super::common::{self, EndKind, Kind, SplineProblem};
use super::conditions;
use super::domain::{Shape, domain_of};
use super::laws::{knots_law, scaling_law};
use crate::audit::{Domain, Draw, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::common::point;
use crate::methods::definition::{Definition, Entry, method};
use crate::methods::inputs::{Number, inputs};
use rug::Rational;

inputs! {
    /// Data of a spline with a condition for each end: 0 is not-a-knot, whose value is 0, 1 a given
    /// first derivative and 2 a given second derivative.
    pub struct CubicSplineMixedEndsInput {
        x: list "x[n]", "x";
        y: list "y[n]", "y";
        left: choice "left (0, 1 or 2)", "1";
        left_value: number "left_value", "y/x^left";
        right: choice "right (0, 1 or 2)", "1";
        right_value: number "right_value", "y/x^right";
        q0: number "q0", "x";
        q1: number "q1", "x";
    }
}

/// Cubic splines whose ends may differ: a given first or second derivative, or not-a-knot.
///
/// A candidate is a `Fn(CubicSplineMixedEndsInput) -> [[S, S', S'', S''', integral]; 2]`.
#[derive(Clone, Copy, Debug)]
pub struct CubicSplineMixedEnds;

method! {
    CubicSplineMixedEnds "cubic-spline-mixed-ends": Fn(CubicSplineMixedEndsInput<'_>), |f, i| f(i)
}

/// The condition of a code with its value; none for another number, and for a value that not-a-knot
/// would not use.
fn end(code: f64, value: f64) -> Option<EndKind> {
    match code {
        0.0 if value == 0.0 => Some(EndKind::NotAKnot),
        1.0 => Some(EndKind::FirstDerivative),
        2.0 => Some(EndKind::SecondDerivative),
        _ => None,
    }
}

const BAD_END: &str = "bad end";

impl<'a, T: Number> CubicSplineMixedEndsInput<'a, T> {
    fn kind(&self) -> Option<Kind> {
        let near = |v: T::Of<'a>| T::near(v);
        let first = end(near(self.left), near(self.left_value))?;
        Some(Kind::Ends([
            first,
            end(near(self.right), near(self.right_value))?,
        ]))
    }

    fn problem(&self) -> SplineProblem<'a, T> {
        SplineProblem {
            x: self.x,
            y: self.y,
            ends: Some([self.left_value, self.right_value]),
            queries: [self.q0, self.q1],
        }
    }
}

/// An input of the kind's layout, which is that of two end values, in the one with codes.
fn coded(kind: [EndKind; 2], n: usize, input: &[f64]) -> Vec<f64> {
    let (points, mut rest) = input.split_at(2 * n);
    let mut all = points.to_vec();
    for end in kind {
        let code = end.order().map_or(0.0, f64::from);
        let value = match end {
            EndKind::NotAKnot => 0.0,
            _ => {
                let (value, others) = (rest[0], &rest[1..]);
                rest = others;
                value
            }
        };
        all.extend([code, value]);
    }
    all.extend(rest);
    all
}

const KINDS: [EndKind; 3] = [
    EndKind::NotAKnot,
    EndKind::FirstDerivative,
    EndKind::SecondDerivative,
];

/// Two different conditions, not-a-knot only where there are three knots.
fn draw(draw: &mut Draw, shape: Shape) -> Vec<f64> {
    let first = draw.integer(0, 2);
    let kind = [KINDS[first], KINDS[(first + draw.integer(1, 2)) % 3]];
    loop {
        let input = Kind::Ends(kind).draw(draw, shape);
        let values = kind.iter().filter(|k| **k != EndKind::NotAKnot).count();
        let n = (input.len() - values - 2) / 2;
        if n > 2 || values == 2 {
            return coded(kind, n, &input);
        }
    }
}

/// The kind of the check points: a given slope at the left, natural or nearly so at the right.
const LEFT_SLOPE: [EndKind; 2] = [EndKind::FirstDerivative, EndKind::SecondDerivative];

impl Definition for CubicSplineMixedEnds {
    type Input<'a, T: Number> = CubicSplineMixedEndsInput<'a, T>;
    const SUMMARY: &'static str =
        "cubic spline with its own condition at each end: 0 not-a-knot, 1 S' given, 2 S'' given";
    const SOURCE: &'static str = "Zinchenko 2008, eqs (8)-(17), on arbitrary knots";

    fn outputs() -> Vec<Output> {
        common::outputs(16.0)
    }

    fn rows() -> Option<Rows> {
        Some(common::ROWS)
    }

    fn domain() -> Domain {
        let laid = |x: &[f64], y: &[f64], q: [f64; 2]| {
            let input = Kind::Ends(LEFT_SLOPE).check_point(x, y, q);
            coded(LEFT_SLOPE, x.len(), &input)
        };
        let sampler = |shape| -> fn(&mut Draw) -> Vec<f64> {
            match shape {
                Shape::Scaled => |d| draw(d, Shape::Scaled),
                Shape::NearKnots => |d| draw(d, Shape::NearKnots),
                Shape::Wild => |d| draw(d, Shape::Wild),
                _ => |d| draw(d, Shape::Well),
            }
        };
        let mut domain = domain_of(Kind::Ends(LEFT_SLOPE), sampler, laid);
        let (x, y) = ([0.0, 1.0, 3.0, 4.0], [1.0, -2.0, 1.0, 0.5]);
        let with = |name, n: usize, ends: [f64; 4]| {
            point(name, [&x[..n], &y[..n], &ends, &[0.25, 1.0]].concat())
        };
        domain.check_points.extend([
            with("not-a-knot-left", 4, [0.0, 0.0, 1.0, -2.0]),
            with("not-a-knot-right", 4, [2.0, 1.0, 0.0, 0.0]),
            with("not-a-knot-both", 4, [0.0, 0.0, 0.0, 0.0]),
            with("one-cubic", 3, [1.0, 0.5, 0.0, 0.0]),
            with("not-a-knot-without-a-knot", 2, [0.0, 0.0, 1.0, -2.0]),
            with("no-such-end", 4, [3.0, 0.0, 1.0, -2.0]),
            with("value-of-no-use", 4, [0.0, 0.5, 1.0, -2.0]),
        ]);
        domain
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        i.kind().is_some()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        i.kind().ok_or(BAD_END)?.solve(i.problem())
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let kind = i.kind().ok_or(Uncertified::Refused(BAD_END))?;
        kind.reference(i.problem(), bits)
    }

    fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
        i.kind()?.explanation(i.problem())
    }

    fn refusal(i: Self::Input<'_, f64>) -> Option<String> {
        let ends = [
            ("left", i.left, i.left_value),
            ("right", i.right, i.right_value),
        ];
        let (name, code, value) = ends
            .into_iter()
            .find(|(_, code, v)| end(*code, *v).is_none())?;
        Some(match code {
            0.0 => format!("{name}_value is {value}, expected 0: a not-a-knot end has no value"),
            _ => format!(
                "{name} is {code}, expected 0 (not-a-knot), 1 (first derivative) or 2 (second derivative)"
            ),
        })
    }

    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        let is_data = Self::layout().is_data(&Entry::<Self>::NEW, numbers);
        let kind = Self::unpack(numbers)?.kind()?;
        conditions::conditions(kind, numbers, &is_data, |data| {
            Some(Self::unpack(data)?.problem())
        })
    }

    fn laws() -> Vec<Law> {
        vec![
            knots_law(|v| {
                let i = Self::unpack(v)?;
                i.kind()?.knots_residual(i.problem())
            }),
            scaling_law(|v| {
                let i = Self::unpack(v)?;
                i.kind()?.scaling_residual(i.problem())
            }),
        ]
    }
}

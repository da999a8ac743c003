//! Cubic splines on arbitrary knots, a method for each kind of end condition.

use super::common::{self, Kind, SplineProblem};
use super::laws::{ends_law, knots_law, scaling_law};
use super::{conditions, domain};
use crate::audit::{Domain, Law, Output, ReferenceAnswer, Rows, Uncertified};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::{Number, inputs};
use rug::Rational;

inputs! {
    /// Data of a spline that asks for no end values.
    pub struct SplineInput {
        x: list "x[n]", "x";
        y: list "y[n]", "y";
        q0: number "q0", "x";
        q1: number "q1", "x";
    }
}

inputs! {
    /// Data of a spline with given second derivatives at its ends.
    pub struct CubicSplineSecondDerivativesInput {
        x: list "x[n]", "x";
        y: list "y[n]", "y";
        m0: number "m0", "y/x^2";
        mn: number "mn", "y/x^2";
        q0: number "q0", "x";
        q1: number "q1", "x";
    }
}

inputs! {
    /// Data of a spline with given first derivatives at its ends.
    pub struct CubicSplineClampedInput {
        x: list "x[n]", "x";
        y: list "y[n]", "y";
        s0: number "s0", "y/x";
        sn: number "sn", "y/x";
        q0: number "q0", "x";
        q1: number "q1", "x";
    }
}

/// How an input is a [`SplineProblem`]: with these end values.
macro_rules! problems {
    ($($input:ident: |$i:ident| $ends:expr;)*) => {$(
        impl<'a, T: Number> From<$input<'a, T>> for SplineProblem<'a, T> {
            fn from($i: $input<'a, T>) -> SplineProblem<'a, T> {
                let ends = $ends;
                SplineProblem { x: $i.x, y: $i.y, ends, queries: [$i.q0, $i.q1] }
            }
        }
    )*};
}
problems! {
    SplineInput: |i| None;
    CubicSplineSecondDerivativesInput: |i| Some([i.m0, i.mn]);
    CubicSplineClampedInput: |i| Some([i.s0, i.sn]);
}

macro_rules! on_knots {
    (
        $(#[$doc:meta])* $method:ident($input:ident), $kind:expr, $summary:literal,
        $source:literal, $outputs:expr, $($law:expr),*
    ) => {
        $(#[$doc])*
        ///
        /// A candidate is a `Fn(SplineProblem) -> [[S, S', S'', S''', integral]; 2]`.
        #[derive(Clone, Copy, Debug)]
        pub struct $method;

        impl Definition for $method {
            type Input<'a, T: Number> = $input<'a, T>;
            const SUMMARY: &'static str = $summary;
            const SOURCE: &'static str = $source;

            fn outputs() -> Vec<Output> {
                $outputs
            }
            fn rows() -> Option<Rows> {
                Some(common::ROWS)
            }
            fn domain() -> Domain {
                domain::domain!($kind)
            }
            fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
                $kind.solve(i.into())
            }
            fn reference(
                i: Self::Input<'_, Rational>,
                bits: u32,
            ) -> Result<ReferenceAnswer, Uncertified> {
                $kind.reference(i.into(), bits)
            }
            fn explanation(i: Self::Input<'_, f64>) -> Option<String> {
                $kind.explanation(i.into())
            }
            fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
                let all = vec![true; numbers.len()];
                conditions::conditions($kind, numbers, &all, |data| Some(Self::unpack(data)?.into()))
            }
            fn laws() -> Vec<Law> {
                vec![
                    knots_law(|v| $kind.knots_residual(Self::unpack(v)?.into())),
                    scaling_law(|v| $kind.scaling_residual(Self::unpack(v)?.into())),
                    $($law),*
                ]
            }
        }
    };
}
pub(super) use on_knots;

on_knots!(
    /// Cubic splines with given second derivatives at the ends.
    CubicSplineSecondDerivatives(CubicSplineSecondDerivativesInput),
    Kind::SECOND_DERIVATIVES,
    "cubic spline with given second derivatives at the ends (natural if zero)",
    "Zinchenko 2008, eqs (8)-(17), on arbitrary knots",
    common::outputs(16.0),
);

on_knots!(
    /// Cubic splines with given first derivatives at the ends.
    CubicSplineClamped(CubicSplineClampedInput),
    Kind::CLAMPED,
    "cubic spline with given first derivatives at the ends",
    "Zinchenko 2008, eqs (8)-(17), on arbitrary knots",
    common::outputs(16.0),
    ends_law(|v| Kind::CLAMPED.ends_residual(Self::unpack(v)?.into()))
);

on_knots!(
    /// Not-a-knot cubic splines.
    CubicSplineNotAKnot(SplineInput),
    Kind::NOT_A_KNOT,
    "cubic spline whose third derivative is continuous at the second knots from the ends",
    "Zinchenko 2008, eqs (8)-(17), on arbitrary knots",
    common::outputs(16.0),
);

on_knots!(
    /// Periodic cubic splines, which go on beyond their knots; unequal first and last ordinates
    /// have to be refused.
    CubicSplinePeriodic(SplineInput),
    Kind::Periodic,
    "periodic cubic spline",
    "Zinchenko 2008, eqs (8)-(17), on arbitrary knots",
    common::outputs(16.0),
);

method! {
    CubicSplineSecondDerivatives "cubic-spline-second-derivatives":
        Fn(SplineProblem<'_>), |f, i| f(i.into())
}

method! {
    CubicSplineClamped "cubic-spline-clamped": Fn(SplineProblem<'_>), |f, i| f(i.into())
}

method! {
    CubicSplineNotAKnot "cubic-spline-not-a-knot": Fn(SplineProblem<'_>), |f, i| f(i.into())
}

method! {
    CubicSplinePeriodic "cubic-spline-periodic": Fn(SplineProblem<'_>), |f, i| f(i.into())
}

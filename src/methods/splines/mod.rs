//! Cubic splines and piecewise cubics with local slopes.

mod common;
mod conditions;
mod domain;
mod laws;
mod mixed_ends;
mod on_knots;
mod uniform;

pub use common::SplineProblem;
pub use mixed_ends::{CubicSplineMixedEnds, CubicSplineMixedEndsInput};
pub use on_knots::{
    Akima, CubicSplineClamped, CubicSplineClampedInput, CubicSplineNotAKnot, CubicSplinePeriodic,
    CubicSplineSecondDerivatives, CubicSplineSecondDerivativesInput, ModifiedAkima, Pchip,
    SplineInput,
};
pub use uniform::{CubicSplineUniform, CubicSplineUniformInput, UniformSplineProblem};

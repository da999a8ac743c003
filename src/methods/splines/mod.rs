//! Cubic splines.

mod common;
mod conditions;
mod domain;
mod laws;
mod on_knots;
mod uniform;

pub use common::SplineProblem;
pub use on_knots::{
    CubicSplineClamped, CubicSplineClampedInput, CubicSplineNotAKnot, CubicSplinePeriodic,
    CubicSplineSecondDerivatives, CubicSplineSecondDerivativesInput, SplineInput,
};
pub use uniform::{CubicSplineUniform, CubicSplineUniformInput, UniformSplineProblem};

//! Cubic splines and piecewise cubics with local slopes.

mod common;
mod conditions;
mod domain;
mod laws;

pub use common::SplineProblem;

// The order of reports: ends on knots, uniform knots, mixed ends, local slopes.
crate::methods::definition::methods! {
    on_knots: CubicSplineSecondDerivatives, CubicSplineClamped, CubicSplineNotAKnot,
        CubicSplinePeriodic;
    uniform: CubicSplineUniform;
    mixed_ends: CubicSplineMixedEnds;
    local: Pchip, Akima, ModifiedAkima;
}

//! Cubic splines with given second derivatives at the ends.

use super::cubic_spline_common::{Kind, audit};
use super::cubic_spline_laws::{knots_law, scaling_law};

const KIND: Kind = Kind::SecondDerivatives;

audit!(
    KIND,
    "cubic-spline-second-derivatives",
    "cubic spline with given second derivatives at the ends (natural if zero)",
    16.0,
    knots_law(|v| KIND.knots_residual(v)),
    scaling_law(|v| KIND.scaling_residual(v))
);

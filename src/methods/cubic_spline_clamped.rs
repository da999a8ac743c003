//! Cubic splines with given first derivatives at the ends.

use super::cubic_spline_common::{Kind, audit};
use super::cubic_spline_laws::{ends_law, knots_law, scaling_law};

const KIND: Kind = Kind::Clamped;

audit!(
    KIND,
    "cubic-spline-clamped",
    "cubic spline with given first derivatives at the ends",
    16.0,
    knots_law(|v| KIND.knots_residual(v)),
    scaling_law(|v| KIND.scaling_residual(v)),
    ends_law(|v| KIND.ends_residual(v))
);

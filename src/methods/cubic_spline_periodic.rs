//! Periodic cubic splines.

use super::cubic_spline_common::{Kind, audit};
use super::cubic_spline_laws::{knots_law, scaling_law};

const KIND: Kind = Kind::Periodic;

audit!(
    KIND,
    "cubic-spline-periodic",
    "periodic cubic spline",
    16.0,
    knots_law(|v| KIND.knots_residual(v)),
    scaling_law(|v| KIND.scaling_residual(v))
);

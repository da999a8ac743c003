//! Not-a-knot cubic splines.

use super::cubic_spline_common::{Kind, audit};
use super::cubic_spline_laws::{knots_law, scaling_law};

const KIND: Kind = Kind::NotAKnot;

audit!(
    KIND,
    "cubic-spline-not-a-knot",
    "cubic spline whose third derivative is continuous at the second knots from the ends",
    16.0,
    knots_law(|v| KIND.knots_residual(v)),
    scaling_law(|v| KIND.scaling_residual(v))
);

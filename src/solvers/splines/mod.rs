//! Splines.

pub mod cubic_spline;

//! Splines.

pub mod cubic_spline;
pub mod hermite_spline;
mod piecewise;

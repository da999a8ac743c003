//! Splines over exact rationals.

pub mod cubic_spline;
mod hermite_slopes;

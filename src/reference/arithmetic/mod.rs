//! Balls, numbers as they are written, Taylor models.

pub(crate) mod ball;
#[cfg(feature = "formulas")]
pub(crate) mod ball128;
pub(crate) mod complex;
#[cfg(feature = "formulas")]
pub(crate) mod complex128;
pub(crate) mod decimal;
pub(crate) mod dot;
pub(crate) mod elementary;
pub(crate) mod fixed;
pub(crate) mod gauss_legendre;
pub(crate) mod hex_float;
pub(crate) mod mag;
pub(crate) mod nearest;
#[cfg(test)]
mod radius_tests;
pub(crate) mod taylor_model;

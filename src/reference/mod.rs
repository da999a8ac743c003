//! Arbitrary-precision references: every value a [`Ball`] with a proven radius, or exact.
//!
//! Nothing here knows the solvers or who audits them. A reference that cannot decide returns
//! [`Undecided`]; it never falls back on anything else.

mod ball;
pub mod cam_law;
pub mod chirp_oscillator;
pub mod class_iii;
mod complex;
pub mod cubic_spline;
mod decimal;
pub mod dyad;
mod elementary;
pub mod faddeeva;
pub mod fourier_series;
mod hex_float;
mod linear;
mod mag;
pub mod run_up;
mod taylor_model;
pub mod tridiagonal;

pub use ball::{Ball, dot};
pub use complex::ComplexBall;
pub use decimal::{Decimal, DecimalError};
pub use hex_float::{HexFloat, HexFloatError};
pub use linear::BallLu;
pub use mag::Mag;

/// The reference could not decide at the precision it was allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("undecided at {bits} bits: {reason}")]
pub struct Undecided {
    /// The highest precision tried.
    pub bits: u32,
    /// What stayed open.
    pub reason: String,
}

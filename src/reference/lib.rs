//! Arbitrary-precision references: every value a [`Ball`] with a proven radius, or exact.
//!
//! Nothing here knows the solvers or who audits them. A reference that cannot decide returns
//! [`Undecided`]; it never falls back on anything else.
//!
//! | folder | modules |
//! |---|---|
//! | arithmetic | [`Ball`], [`ComplexBall`], [`Mag`], [`Decimal`], [`HexFloat`], Taylor models |
//! | elementary | [`elementary`]: functions of balls |
//! | special | [`faddeeva`] |
//! | linear | [`dense`], [`banded`], [`tridiagonal`], [`eigenvalues`], [`BallLu`] |
//! | roots | [`roots::interval`], [`roots::systems`] |
//! | splines | [`cubic_spline`] |
//! | linkages | [`class_iii`], [`dyad`], [`planar`] |
//! | drive | [`run_up`], [`pendulum`] |
//! | cams | [`cam_law`], [`fourier_series`], [`chirp_oscillator`] |
//! | quadrature | [`quadrature`] |
//! | initial_value | [`initial_value`] |
//!
//! Features: `formulas` (elementary functions, integrals, roots, dense and banded systems),
//! `linkages`, `cams` and `run-up` (folder `drive`), all on by default.
//!
//! Balls are over MPFR, through the crate `rug`: whoever links this links GMP and MPFR (LGPL).
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A single subject leaves arithmetic of the others unused.
#![cfg_attr(
    not(all(feature = "formulas", feature = "cams", feature = "run-up")),
    allow(dead_code, unused_imports, unused_macros)
)]

mod arithmetic;
#[cfg(feature = "cams")]
mod cams;
#[cfg(test)]
mod draw;
#[cfg(feature = "run-up")]
mod drive;
#[cfg(feature = "formulas")]
pub mod elementary;
#[cfg(feature = "formulas")]
pub mod initial_value;
mod linear;
#[cfg(feature = "linkages")]
mod linkages;
#[cfg(feature = "formulas")]
pub mod quadrature;
#[cfg(feature = "formulas")]
pub mod roots;
mod special;
mod splines;

use arithmetic::{ball, complex, decimal, dot, gauss_legendre, hex_float, mag, taylor_model};
use linear::lu;

#[cfg(feature = "cams")]
pub use cams::{cam_law, chirp_oscillator, fourier_series};
#[cfg(feature = "run-up")]
pub use drive::{pendulum, run_up};
pub use linear::tridiagonal;
#[cfg(feature = "formulas")]
pub use linear::{banded, dense, eigenvalues};
#[cfg(feature = "linkages")]
pub use linkages::{class_iii, dyad, planar};
pub use special::faddeeva;
pub use splines::cubic_spline;

#[cfg(feature = "formulas")]
pub use arithmetic::{ball128::Ball128, complex128::Complex128};
pub use ball::{Apart, Ball, dot};
pub use complex::ComplexBall;
pub use decimal::{Decimal, DecimalError, nearest_f64, with_point};
pub use hex_float::{HexFloat, HexFloatError};
#[cfg(feature = "formulas")]
pub use linear::matrix::{LinearError, Matrix};
pub use lu::BallLu;
pub use mag::Mag;

/// The reference could not decide at the precision it was allowed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("undecided at {bits} bits: {reason}")]
pub struct Undecided {
    /// The highest precision tried.
    pub bits: u32,
    /// The undecided question.
    pub reason: String,
}

impl Undecided {
    /// At a precision, for a reason.
    pub fn new(bits: u32, reason: impl Into<String>) -> Undecided {
        let reason = reason.into();
        Undecided { bits, reason }
    }
}

//! Fast `f64` solvers for the dynamics of mechanisms. They need neither GMP nor MPFR.
//!
//! | folder | modules |
//! |---|---|
//! | special | [`faddeeva`] |
//! | linear | [`tridiagonal`], [`cyclic_tridiagonal`] |
//! | splines | [`cubic_spline`], [`hermite_spline`] |
//! | linkages | [`class_iii`], [`dyad`], [`planar`], [`reduction`] |
//! | drive | [`run_up`] |
//! | cams | [`cam_law`], [`fourier_series`], [`chirp_oscillator`], [`chirp_chart`] |
//!
//! Features: `parallel` runs batches on all cores, `run-up` integrates the equation of motion.
//!
//! Batches of the special functions are five times faster where this crate is compiled in one part; else the compiler leaves
//! their vector instructions as calls. In the `Cargo.toml` of the program:
//!
//! ```toml
//! [profile.release.package.mechaudit-solvers]
//! codegen-units = 1
//! ```
//!
//! The crate is the part of [mechaudit](https://crates.io/crates/mechaudit) that computes. What its
//! accuracy is said to be, that suite has audited against certified references.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod arithmetic;
mod cams;
mod drive;
mod linear;
mod linkages;
mod special;
mod splines;
#[cfg(test)]
mod tests;
pub mod units;

use arithmetic::{
    double_double, double_double_functions, exponential, hex, lanes, payne_hanek, real,
};
#[cfg(target_arch = "x86_64")]
use arithmetic::{pack, two};

pub use cams::{cam_law, chirp_chart, chirp_oscillator, fourier_series};
pub use drive::run_up;
pub use linear::{cyclic_tridiagonal, tridiagonal};
pub use linkages::{class_iii, dyad, planar, reduction};
pub use special::faddeeva;
pub use splines::{cubic_spline, hermite_spline};

//! Fast `f64` solvers for the dynamics of mechanisms. They need neither GMP nor MPFR.
//!
//! | folder | modules |
//! |---|---|
//! | special | [`faddeeva`] |
//! | linear | [`tridiagonal`], [`cyclic_tridiagonal`] |
//! | splines | [`cubic_spline`], [`hermite_spline`] |
//! | linkages | [`class_iii`], [`dyad`], [`planar`], [`reduction`] |
//! | initial_value | [`initial_value`] |
//! | drive | [`run_up`] |
//! | cams | [`cam_law`], [`fourier_series`], [`chirp_oscillator`], [`chirp_chart`] |
//!
//! Features: each folder is one (`splines` brings `linear`; `cams` needs `special` and `splines`,
//! `drive` needs `linkages` and `splines`), and all of them are on by default. `vectors` (on by
//! default) computes batches with vector instructions, `parallel` on all cores, with the same bits;
//! `run-up` integrates the equation of motion.
//!
//! Batches of the special functions are five times faster where this crate is compiled in one part;
//! else the compiler leaves their vector instructions as calls. In the `Cargo.toml` of the program:
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
// A single subject leaves arithmetic of the others unused.
#![cfg_attr(
    not(all(feature = "cams", feature = "run-up", feature = "vectors")),
    allow(dead_code, unused_imports, unused_macros)
)]

mod arithmetic;
#[cfg(feature = "cams")]
mod cams;
#[cfg(feature = "drive")]
mod drive;
#[cfg(feature = "linkages")]
pub mod initial_value;
#[cfg(feature = "splines")]
mod linear;
#[cfg(feature = "linkages")]
mod linkages;
#[cfg(feature = "special")]
mod special;
#[cfg(feature = "splines")]
mod splines;
#[cfg(test)]
mod tests;
pub mod units;

use arithmetic::{
    arctangent, double_double, double_double_functions, exponential, hex, lanes, numbers,
    payne_hanek, real,
};
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use arithmetic::{pack, two};

#[cfg(feature = "cams")]
pub use cams::{cam_law, chirp_chart, chirp_oscillator, fourier_series};
#[cfg(feature = "drive")]
pub use drive::run_up;
#[cfg(feature = "splines")]
pub use linear::{cyclic_tridiagonal, tridiagonal};
#[cfg(feature = "linkages")]
pub use linkages::{class_iii, dyad, planar, reduction};
#[cfg(feature = "special")]
pub use special::faddeeva;
#[cfg(feature = "splines")]
pub use splines::{cubic_spline, hermite_spline};

//! An accuracy oracle for the dynamics of mechanisms.
//!
//! Fast `f64` solvers stand beside arbitrary-precision references that carry a proof of their
//! error, and an audit compares the two.
//!
//! | module | what it holds | needs |
//! |---|---|---|
//! | [`solvers`] (crate `mechaudit-solvers`) | Faddeeva function, tridiagonal systems, cubic splines, PCHIP and Akima interpolants, linkages, reduction to the crank, run-up under a motor, cams | nothing but `f64`; time integration: feature `run-up` |
//! | `reference` (`mechaudit-reference`) | balls over MPFR, exact rational systems and splines, linkages enclosed by Krawczyk's operator | feature `oracle` |
//! | `audit` (`mechaudit-audit`) | domains, cases, budgets, the judge, statistics | feature `oracle` |
//! | `candidate` | your own code in place of a method's solver | feature `oracle` |
//! | `files` | the writer of files that the program and the Python package share | feature `files` |
//! | `message` | the words of an error, as a reader meets them | nothing |
//! | `methods` | one file for each audited method | feature `oracle` |
//! | `study` | problems that users bring as formulas or files | feature `studies` |
//!
//! The program `mechaudit` is the package `mechaudit-cli`. Files of machines, papers, proofs,
//! campaigns and reports belong to it.
//!
//! With `default-features = false` only the solvers are built, without GMP and MPFR; feature
//! `parallel` adds batches on all cores.
//!
//! # A linkage
#![cfg_attr(feature = "linkages", doc = "```")]
#![cfg_attr(not(feature = "linkages"), doc = "```ignore")]
//! use mechaudit::solvers::class_iii::{ClassIii, Geometry};
//! use mechaudit::solvers::units::{Angle, Length};
//!
//! let cm = Length::from_cm;
//! let linkage = ClassIii::new(Geometry {
//!     l1: cm(10.0), l2: cm(104.0), l3: cm(60.0), l4: cm(64.0), l5: cm(48.5),
//!     lb: cm(22.0), phi_b: Angle::from_deg(-39.3),
//!     x3: cm(75.0), y3: cm(93.0), x5: cm(128.5), y5: cm(103.5),
//! })?;
//! let phi1 = Angle::from_rad(0.5);
//! let mode = linkage.assembly_modes(phi1).modes[2];
//! let start = linkage.state_near(phi1, mode)?;
//! // Follow the branch: steps are as short as the Newton-Kantorovich theorem asks for.
//! let end = linkage.follow(&start, Angle::from_rad(0.5 + std::f64::consts::TAU))?;
//! assert!((end.positions.phi4 - start.positions.phi4).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # An audit
#![cfg_attr(all(feature = "oracle", feature = "splines"), doc = "```")]
#![cfg_attr(not(all(feature = "oracle", feature = "splines")), doc = "```ignore")]
//! use mechaudit::audit::{audit_method, Settings};
//! use mechaudit::methods;
//!
//! let method = methods::find("tridiagonal").unwrap();
//! let settings = Settings { cases_per_region: 10, ..Settings::default() };
//! let report = audit_method(&*method, &settings, &|| ());
//! assert!(report.passed());
//! ```
//!
//! # Code of your own
#![cfg_attr(all(feature = "oracle", feature = "splines"), doc = "```")]
#![cfg_attr(not(all(feature = "oracle", feature = "splines")), doc = "```ignore")]
//! use mechaudit::methods::Tridiagonal;
//!
//! fn thomas(lower: &[f64], diagonal: &[f64], upper: &[f64], right: &[f64]) -> Option<Vec<f64>> {
//!     let (mut d, mut x) = (diagonal.to_vec(), right.to_vec());
//!     for i in 1..d.len() {
//!         let factor = lower[i - 1] / d[i - 1];
//!         d[i] -= factor * upper[i - 1];
//!         x[i] -= factor * x[i - 1];
//!     }
//!     for i in (0..d.len()).rev() {
//!         let next = if i + 1 < d.len() { upper[i] * x[i + 1] } else { 0.0 };
//!         x[i] = (x[i] - next) / d[i];
//!     }
//!     x.iter().all(|x| x.is_finite()).then_some(x)
//! }
//!
//! mechaudit::audit::<Tridiagonal>(thomas)
//!     .seed(7)
//!     .effort(0.1)
//!     .run()?
//!     .assert_within_budget();
//! # Ok::<(), mechaudit::candidate::AuditError>(())
//! ```
//!
//! # What the words mean
//! * A **ball** is a midpoint and a radius that bounds the distance to the true value.
//! * An **ulp** of a reference value in `[2^e, 2^(e+1))` is `2^(e−52)`; errors are fractional ulps
//!   against the unrounded reference.
//! * The **condition** of an output is `Σ_j |x_j ∂f/∂x_j| / |f|`: how many relative errors of the
//!   inputs it takes up.
//! * **u** is `2⁻⁵³`, half an ulp of 1.
//! * **Worst found** is the largest of a sample, never a bound.
#![forbid(unsafe_code)]
#![warn(missing_docs)]
// A single subject leaves constructors of the others unused.
#![cfg_attr(
    not(all(feature = "cams", feature = "run-up")),
    allow(dead_code, unused_imports, unused_macros, unused_mut)
)]

#[cfg(feature = "oracle")]
pub mod book;
#[cfg(feature = "oracle")]
pub mod candidate;
#[cfg(feature = "files")]
pub mod files;
pub mod message;
#[cfg(feature = "oracle")]
pub mod methods;
#[cfg(feature = "oracle")]
mod resolve;
#[cfg(feature = "studies")]
pub mod study;

#[cfg(all(doctest, feature = "special", feature = "studies"))]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(feature = "oracle")]
#[doc(inline)]
pub use candidate::{audit, audit_by_name, compare};
#[cfg(feature = "oracle")]
pub use resolve::{MethodError, resolve};

#[cfg(feature = "oracle")]
#[doc(inline)]
pub use mechaudit_audit as audit;
#[cfg(feature = "oracle")]
#[doc(inline)]
pub use mechaudit_reference as reference;
#[doc(inline)]
pub use mechaudit_solvers as solvers;
/// A complex number of two `f64`, as candidates take and give it.
#[cfg(feature = "oracle")]
pub use num_complex::Complex64;

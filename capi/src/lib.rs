//! The C interface of mechaudit's solvers: `mechaudit.h`, and libcerf's names (`mechaudit/cerf.h`).
//!
//! All `unsafe` code of the workspace is here, at the border: pointers of the caller, and numbers that cross
//! it by value. What is computed is `mechaudit-solvers`, which forbids it.
//!
//! # Rules of the border
//! - No state: every function is thread-safe, a spline may be read by many threads at once.
//! - Functions of one point allocate nothing and cannot fail.
//! - What can fail returns a [`Status`] and, where asked, an [`Error`] with the place and the rule.
//! - Nothing unwinds into the caller. A panic would be a defect of this library: in the profile `capi`, which
//!   `capi/install` builds, it aborts; in the others it becomes [`Status::Internal`] where a status is returned, and
//!   aborts elsewhere.
//!
//! # Complex numbers by value
//! C's `double _Complex` has no counterpart among Rust's types of the C ABI. On x86-64 (System V) and AArch64
//! (AAPCS64) it is passed and returned like a structure of two doubles: two SSE eightbytes (psABI 3.2.3) and
//! a homogeneous floating-point aggregate (AAPCS64 5.9.5, 6.8.2). [`Complex`] is that structure; elsewhere the
//! functions that need it do not exist (`build.rs`), nor does `MECHAUDIT_COMPLEX` in the header.
//! `tests/abi.c` compares both ways of passing, bit for bit.

mod border;
#[cfg(feature = "cerf")]
mod cerf;
#[cfg(all(feature = "cerf", target_family = "unix"))]
mod cerf_cpp;
mod complex;
mod real;
mod spline;
mod strided;
mod tridiagonal;

pub use border::{Error, Status, mechaudit_status_message, mechaudit_version};
#[cfg(feature = "cerf")]
pub use cerf::*;
#[cfg(all(feature = "cerf", target_family = "unix"))]
pub use cerf_cpp::*;
pub use complex::*;
pub use real::*;
pub use spline::*;
pub use tridiagonal::*;

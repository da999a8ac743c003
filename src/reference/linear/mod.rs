//! Linear systems: dense, banded and tridiagonal, determinants, inverses, least squares and
//! eigenvalues of symmetric matrices.

#[cfg(feature = "formulas")]
pub mod banded;
#[cfg(feature = "formulas")]
pub mod dense;
#[cfg(feature = "formulas")]
pub mod eigenvalues;
#[cfg(feature = "formulas")]
mod exact;
mod generators;
pub(crate) mod lu;
#[cfg(feature = "formulas")]
pub(crate) mod matrix;
#[cfg(feature = "formulas")]
mod modular;
mod ring;
pub mod tridiagonal;
#[cfg(feature = "formulas")]
pub(crate) mod verified;

//! Linear systems: dense, banded and tridiagonal, determinants, inverses, least squares and
//! eigenvalues of symmetric matrices.

pub mod banded;
pub mod dense;
pub mod eigenvalues;
mod exact;
mod generators;
pub(crate) mod lu;
pub(crate) mod matrix;
mod modular;
mod ring;
pub mod tridiagonal;
pub(crate) mod verified;

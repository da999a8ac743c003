//! Linear systems, exactly and in balls.

mod generators;
pub(crate) mod lu;
mod ring;
pub mod tridiagonal;

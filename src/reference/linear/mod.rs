//! Linear systems, exactly and in balls.

pub(crate) mod lu;
pub mod tridiagonal;

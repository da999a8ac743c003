//! Linear systems.

pub mod cyclic_tridiagonal;
pub mod tridiagonal;

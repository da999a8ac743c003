//! Linear systems.

mod cyclic_tridiagonal;
mod tridiagonal;

pub(super) use tridiagonal::identical;

pub use cyclic_tridiagonal::{CyclicTridiagonal, CyclicTridiagonalInput};
pub use tridiagonal::{Tridiagonal, TridiagonalInput};

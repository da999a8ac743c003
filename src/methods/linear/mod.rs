//! Linear systems.

mod cyclic_tridiagonal;
mod tridiagonal;
mod tridiagonal_pivoting;

pub(super) use tridiagonal::identical;

pub use cyclic_tridiagonal::{CyclicTridiagonal, CyclicTridiagonalInput};
pub use tridiagonal::{Tridiagonal, TridiagonalInput};
pub use tridiagonal_pivoting::TridiagonalPivoting;

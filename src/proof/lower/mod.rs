//! The open lower half-plane, `w(z) = 2e^{−z²} − w(−z)`.

mod dominated;
mod exponential;
mod phase;
mod prove;
mod reflection;
mod regions;
mod rows;

pub use dominated::Dominated;
pub use exponential::{Exponential, Factors};
pub use prove::{Certificate, LOWER_HALF_PLANE, Leaf, Target, lower_half_plane, roots};
pub use regions::{Code, Region};
pub use rows::Rows;

#[cfg(test)]
mod tests;

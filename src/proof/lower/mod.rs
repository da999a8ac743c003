//! The open lower half-plane, `w(z) = 2e^{−z²} − w(−z)`.
//!
//! Proved is the norm, at every finite `f64` point with `Im z < 0` where w does not overflow. Every
//! bound and its derivation: the chapter on proofs of the book.

mod again;
mod apart;
mod dominated;
mod exponential;
mod phase;
mod prove;
mod reflection;
mod regions;
mod theorem;
mod zeros;

pub use again::Again;
pub use apart::Apart;
pub use dominated::Dominated;
pub use exponential::{Exponential, Factors};
pub use prove::{Certificate, LOWER_HALF_PLANE, Leaf, Target, lower_half_plane, roots};
pub use regions::{Code, Region};
pub use theorem::{BY_HAND, NOT_PROVED, OfRegion, Theorem, theorem};
pub use zeros::AroundZeros;

#[cfg(test)]
mod tests;

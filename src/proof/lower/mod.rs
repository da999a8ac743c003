//! The open lower half-plane, `w(z) = 2e^{−z²} − w(−z)`.

mod exponential;
mod phase;
mod rows;

pub use exponential::{Exponential, Factors};

#[cfg(test)]
mod tests;

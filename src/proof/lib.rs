//! Machine proofs of error bounds of `f64` solvers.
//!
//! [`upper_half_plane`] proves a bound of the error of the Faddeeva function of `mechaudit-solvers`
//! at every finite `f64` point of the closed upper half-plane, or of some of its shells. It runs
//! the solver's own generic code with numbers that enclose, over a rectangle of inputs, the exact
//! value and all that rounding does to it; [`real`] does so for erf, erfc, erfcx and Dawson's
//! function of every finite real argument; the truncation of each formula is bounded by certified
//! values of `mechaudit-reference`. The model of arithmetic, every rule and every inequality: the
//! chapter on proofs in the book of `mechaudit`.
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(test)]
#[path = "tests/at_points.rs"]
mod at_points;
mod bound;
mod bounds;
mod certificate;
mod choice;
mod code;
mod constants;
mod cover;
mod error;
mod evaluation;
mod exact;
mod formula;
mod grid;
mod interval;
pub mod lower;
#[cfg(test)]
#[path = "tests/pinned.rs"]
mod pinned;
pub mod program;
mod prove;
pub mod real;
mod summary;
mod tables;
mod tracked;
mod truncation;

pub use bound::Bound;
pub use certificate::{MOST_PARTS, Open, Watch};
pub use code::Code;
pub use cover::{Rectangle, hole};
pub use error::ProofError;
pub use evaluation::Rounding;
pub use formula::Formula;
pub use prove::{
    Certificate, Leaf, Target, UPPER_HALF_PLANE, first_rectangles, on_rectangle, upper_half_plane,
};
pub use summary::{Attained, OfFormula, Summary};
pub use tables::Tables;

//! The N four-bar mechanism, the benchmark of multibody solvers for singular positions: N + 1
//! cranks and N rods of 1 m and 1 kg, as the library of computational benchmark problems of the
//! Universidad de La Coruña (now IFToMM's) specifies it, problem A02.
//!
//! Cranks and rods form parallelograms, whose motion is that of a pendulum that turns over:
//! [`data`] reduces it in exact numbers, [`motion()`] encloses it, and every printed number is
//! compared. [`singular`] tells what meets where all bars lie on one line, what is defined there
//! and what is not. The ledger proves the equations for every N.

pub mod data;
mod findings;
mod motion;
mod printed;
pub mod singular;

pub(super) use findings::analysis;
pub use motion::{BITS, Course, DIGITS, Motion, QUANTITIES, TIMES, motion};
pub use printed::{Copied, Row};

//! Andrews' squeezing mechanism, the benchmark of solvers for equations of motion with constraints:
//! seven bodies, a constant torque, one spring, as the Test Set for Initial Value Problem Solvers
//! prints it after Hairer and Wanner.
//!
//! [`motion()`] encloses the motion without integrating in time; every printed digit is compared
//! with it. The ledger proves the printed equations from the kinetic and potential energy.

pub mod data;
mod findings;
mod motion;
mod printed;

pub use data::BITS;
pub(super) use findings::analysis;
pub use motion::{DIGITS, Motion, TIMES, motion};
pub use printed::{Printed, QUANTITIES, printed, unit};

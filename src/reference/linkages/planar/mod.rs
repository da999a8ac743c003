//! Planar mechanisms of one degree of freedom in balls.
//!
//! A [`Mechanism`] is bodies, pins, slides, pins in slots, gears and racks in exact data. Its coordinates are the
//! angles ψ of the bodies' axes and the displacements of slides; with `u_k = e^{iψ_k}` every point is a sum of terms
//! `z u_k` and `z s u_k`, so that the loops are closed by equations of that kind. A [`Linkage`] adds a [`Drive`], which
//! is one more linear equation, and a precision.
//!
//! Positions are enclosed by Krawczyk's operator, which proves existence and uniqueness. At a change point or a dead
//! position of the drive the answer is [`Undecided`](crate::Undecided).

mod conservative;
mod disc;
mod enclosure;
mod energy;
mod loops;
mod mechanism;
mod modes;
#[cfg(test)]
mod modes_tests;
mod panel;
mod reactions;
mod scalar;
mod series;
#[cfg(test)]
mod soundness_tests;
mod system;

pub use enclosure::{Linkage, Position};
#[cfg(test)]
mod tests;

pub use conservative::{Course, Moment};
pub use energy::{Forces, Spring};
pub use mechanism::{Attachment, Body, Drive, Frame, Joint, Mechanism, MechanismError, Point};
pub use reactions::Rates;
pub use series::Series;

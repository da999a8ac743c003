//! Planar mechanisms of one degree of freedom in balls.
//!
//! A [`Mechanism`] is bodies, pins, slides, pins in slots, gears and racks in exact data. Its
//! coordinates are the angles ψ of the bodies' axes and the displacements of slides; with
//! `u_k = e^{iψ_k}` every point is a sum of terms `z u_k` and `z s u_k`, so that the loops are
//! closed by equations of that kind. A [`Linkage`] adds a [`Drive`], which is one more linear
//! equation, and a precision.
//!
//! [`Linkage::position`] encloses by Krawczyk's operator, which proves existence and uniqueness;
//! [`Linkage::modes`] finds all positions and proves that none is missing, [`Linkage::nearest`] the
//! one next to approximate coordinates; [`Linkage::series`], [`Linkage::reduced_inertia`] and
//! [`Linkage::multipliers`] give derivatives of any order, inertia and reactions;
//! [`Linkage::from_rest`] the motion under conservative forces. [`Linkage::special`] decides
//! singular positions and zeros by exact algebra where directions are simple numbers,
//! [`Linkage::family`] motions like those of parallelograms. A [`Drawing`] may have any number of
//! degrees of freedom, which exact ranks tell. At other change points and dead positions of the
//! drive the answer is [`Undecided`](crate::Undecided).
//!
//! ```
//! use mechaudit_reference::Ball;
//! use mechaudit_reference::planar::{Attachment, Body, Drive, Joint, Linkage, Mechanism};
//! use rug::Rational;
//! // Crank 1, coupler 3, rocker 4, frame 6.
//! let at = |x: i32| [Rational::from(x), Rational::new()];
//! let pin = |a, b| Joint::Pin { a, b };
//! let joints = vec![
//!     pin(Attachment::ground(at(0)), Attachment::body(0, at(0))),
//!     pin(Attachment::body(0, at(1)), Attachment::body(1, at(0))),
//!     pin(Attachment::ground(at(6)), Attachment::body(2, at(0))),
//!     pin(Attachment::body(1, at(3)), Attachment::body(2, at(4))),
//! ];
//! let bodies = ["crank", "coupler", "rocker"].map(Body::massless).to_vec();
//! let linkage = Linkage::new(&Mechanism::new(bodies, joints)?, &Drive::coordinate(0), 128)?;
//! // At φ = 0 coupler and rocker are the legs of a 3-4-5 triangle, above or below the frame.
//! let modes = linkage.modes(&Ball::integer(128, 0))?;
//! assert_eq!(modes.len(), 2);
//! for mode in &modes {
//!     let (_, cosine) = mode.x[1].sin_cos();
//!     assert!(cosine.contains(&Rational::from((3, 5))));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chart;
mod conservative;
#[cfg(test)]
mod conservative_tests;
mod determined;
mod disc;
mod enclosure;
mod energy;
mod exact_rates;
mod freedom;
#[cfg(test)]
mod freedom_tests;
mod joint_forces;
mod loops;
mod mechanism;
mod mid_rad;
mod modes;
#[cfg(test)]
mod modes_tests;
mod nearest;
mod panel;
mod parts;
mod reactions;
mod real;
mod scalar;
mod series;
#[cfg(test)]
mod soundness_tests;
mod special;
mod surd;
mod system;

pub use enclosure::{Linkage, Position};
#[cfg(test)]
mod tests;

pub use conservative::{Course, Moment};
pub use determined::Determined;
pub use energy::{Forces, Spring};
pub use exact_rates::ExactRates;
pub use freedom::{Drawing, DrawnPin, Freedom, Mobility};
pub use joint_forces::JointForces;
pub use loops::{Form, Loops, Relation, Term};
pub use mechanism::Mechanism;
pub use parts::{Attachment, Body, Drive, Frame, Joint, MechanismError, Place, Point};
pub use reactions::Rates;
pub use real::Real;
pub use series::Series;
pub use special::{ExactDrive, Special};

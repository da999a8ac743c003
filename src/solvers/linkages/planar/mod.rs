//! Planar mechanisms of any structure with one degree of freedom.
//!
//! A [`Description`] lists bodies, joints (pins of two or more bodies, slides, pins in slots, gears
//! and racks) and the drive. [`Mechanism::new`] counts its degrees of freedom by structure, tells
//! which bodies are locked, over-constrained or loose, and takes it apart into Assur groups.
//! [`Mechanism::assembly_modes`] finds every position at one value of the drive,
//! [`Mechanism::nearest`] the one next to approximate angles, [`Mechanism::follow`] carries a
//! position along its branch by steps that are proved not to change it,
//! [`Mechanism::trace_branches`] does so for all of them and tells where they merge or cross. A
//! [`State`] holds positions and rates.
//!
//! Rates are derivatives with respect to the drive, so they do not depend on its speed.
//!
//! Not in it: friction, contact, flexible links, mechanisms in space.

mod arms;
mod bounds;
mod branches;
mod building;
mod chain;
mod check;
mod circles;
mod continuation;
mod dense;
pub mod dynamics;
mod error;
mod homotopy;
mod isotropic;
mod loads;
mod mechanism;
mod model;
mod modes;
mod motion;
mod nearest;
mod newton;
mod pebbles;
mod plane;
mod pose;
mod reactions;
mod singular;
mod state;
mod structure;
mod triad;
mod windings;

pub use branches::{BranchEnd, BranchMap, BranchSample};
pub use error::{MechanismError, NearestError, PositionError};
pub use loads::{BodyMass, Course, Load, LoadError, Loads, ReducedLoads};
pub use mechanism::Mechanism;
pub use model::{Description, Drive, GROUND, Guide, Joint, Named, Point};
pub use modes::Modes;
pub use reactions::{JointForce, ReactionError, Reactions};
pub use singular::{SingularKind, Singularity};
pub use state::{Displacement, State, curvature};
pub use structure::{Group, GroupKind, Structure};

#[cfg(test)]
mod equilibrium_tests;
#[cfg(test)]
mod gear_tests;
#[cfg(test)]
mod law_tests;
#[cfg(test)]
mod load_tests;
#[cfg(test)]
mod tests;

//! Planar linkages of any structure: bodies joined by pins, one of them driven.

mod conditions;
mod drawn;
mod flow;
mod input;
mod inverse;
mod kinematics;
mod laws;
mod points;
mod reactions;
mod reduction;
mod regions;
#[cfg(test)]
mod tests;

pub use input::{PlanarForcesInput, PlanarLinkageInput};
pub use kinematics::PlanarLinkage;
pub use reactions::PlanarReactions;
pub use reduction::PlanarReduction;

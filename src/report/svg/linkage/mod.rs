//! Linkages at several positions, with the paths of their joints.

mod class_iii;
#[cfg(test)]
mod drawn_tests;
mod dyad;
mod planar;
mod scene;

pub use class_iii::class_iii;
pub use dyad::dyad;
pub use planar::planar;
#[cfg(test)]
pub(in crate::report) use scene::tests;

/// Positions along a branch that paths are drawn through, but for the first.
pub const SAMPLES: u32 = 720;

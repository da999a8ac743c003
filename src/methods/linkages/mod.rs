//! Linkages.

mod class_iii;
mod class_iii_assembly_modes;
#[cfg(test)]
mod dyad_tests;
mod four_bar;
mod planar;
mod slider_crank;

pub(super) use class_iii::at_degrees;

pub use class_iii::{ClassIii, ClassIiiGeometry, ClassIiiInput};
pub use class_iii_assembly_modes::{ClassIiiAssemblyModes, ClassIiiAssemblyModesInput};
pub use four_bar::{FourBar, FourBarInput};
pub use planar::{
    PlanarForcesInput, PlanarLinkage, PlanarLinkageInput, PlanarReactions, PlanarReduction,
};
pub use slider_crank::{SliderCrank, SliderCrankInput};

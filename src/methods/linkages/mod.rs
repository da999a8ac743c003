//! Linkages.

#[cfg(test)]
mod dyad_tests;

pub(super) use class_iii::at_degrees;

crate::methods::definition::methods! {
    four_bar: FourBar;
    slider_crank: SliderCrank;
    class_iii_assembly_modes: ClassIiiAssemblyModes;
    class_iii: ClassIii;
    planar: PlanarLinkage, PlanarReduction, PlanarReactions;
}

//! Linkages, and their reduction to the crank.

pub mod class_iii;
pub mod dyad;
pub mod planar;
pub mod reduction;

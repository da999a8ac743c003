//! Linkages, enclosed.

pub mod class_iii;
pub mod dyad;
pub mod planar;

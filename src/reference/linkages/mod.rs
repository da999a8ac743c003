//! Linkages, enclosed.

pub mod class_iii;
pub mod dyad;

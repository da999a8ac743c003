//! Certified zeros: of functions of one variable, and of systems of equations.

pub mod interval;
pub mod systems;

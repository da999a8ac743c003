//! Machines under a motor, and pendulums.

pub mod pendulum;
pub mod run_up;

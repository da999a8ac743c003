//! Machines under a motor.

pub mod run_up;

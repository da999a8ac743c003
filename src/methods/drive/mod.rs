//! Linkages under a motor.

pub(super) mod run_up;

pub use run_up::{RunUp, RunUpInput};

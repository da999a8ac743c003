//! Other processes: candidates, what is said to them, and signals.

pub mod bounded;
pub mod candidate;
pub mod exec;
pub mod frames;
#[cfg(unix)]
pub mod guard;
pub mod inputs;
pub mod interrupt;
pub mod program;
pub mod wire;

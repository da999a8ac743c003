//! Other processes: candidates, their inputs and answers, and signals.

pub mod answers;
pub mod batches;
pub mod candidate;
pub mod frames;
#[cfg(unix)]
pub mod guard;
pub mod inputs;
pub mod interrupt;
pub mod program;
pub mod wire;

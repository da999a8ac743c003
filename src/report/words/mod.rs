//! The words that more than one form of a report uses.

pub mod audit;
#[cfg(feature = "report")]
pub mod ledger;
pub mod numbers;
#[cfg(feature = "report")]
pub mod paper;
mod tone;

pub use tone::Tone;

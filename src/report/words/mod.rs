//! What more than one form of a report says in the same words.

pub mod audit;
pub mod ledger;
pub mod numbers;
pub mod paper;
mod tone;

pub use tone::Tone;

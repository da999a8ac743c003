//! Findings on the tables and the conclusion, in words and figures.

mod claims;
mod inputs;
mod run_up;
mod tables;

pub(super) use claims::{claim_0119, conclusion, convergence};
pub(super) use inputs::{identifiability, recovered_centres, units_of_length};
pub(super) use run_up::run_up;
pub(super) use tables::{hidden_recipe, misprints, moment, reproduction};

#[cfg(test)]
mod tests;

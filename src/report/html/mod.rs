//! Pages without outside parts, for light and dark, for desk and phone.

pub mod audit;
mod convergence;
pub mod ledger;
mod page;
pub mod paper;
mod plots;
mod prose;
mod style;

//! Pages without outside parts, for light and dark, for desk and phone.

mod assets;
pub mod atlas;
pub mod audit;
mod convergence;
mod glossary;
pub mod ledger;
pub mod linkage;
mod motion;
pub(crate) mod page;
pub mod paper;
mod plots;
mod prose;
pub mod run;
mod spark;

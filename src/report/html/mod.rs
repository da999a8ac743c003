//! Pages without outside parts, for light and dark, for desk and phone.

mod assets;
pub mod audit;
mod convergence;
mod glossary;
#[cfg(feature = "report")]
pub mod ledger;
#[cfg(feature = "report")]
pub mod linkage;
#[cfg(feature = "report")]
mod motion;
pub(crate) mod page;
#[cfg(feature = "report")]
mod panel;
#[cfg(feature = "report")]
pub mod paper;
mod plots;
mod prose;
#[cfg(feature = "report")]
pub mod run;
mod spark;
#[cfg(feature = "report")]
pub mod trajectory;

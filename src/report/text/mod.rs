//! Reports for people, in as many columns as there are.

pub mod case;
pub mod comparison;
#[cfg(feature = "report")]
pub mod ledger;
pub mod method;
#[cfg(feature = "report")]
pub mod paper;
pub mod style;
#[cfg(feature = "report")]
pub mod summary;
pub mod table;

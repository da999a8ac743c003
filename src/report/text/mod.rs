//! Reports for people, in as many columns as there are.

pub mod atlas;
pub mod case;
pub mod comparison;
pub mod ledger;
pub mod method;
pub mod paper;
pub mod style;
pub mod summary;
pub mod table;

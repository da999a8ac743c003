//! Initial value problems of ordinary differential equations in `f64`.

mod crossing;
mod dop853;
mod dop853_table;

pub(crate) use crossing::first_crossing;
pub use dop853::{Dop853, StepError};

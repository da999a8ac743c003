//! Initial value problems of ordinary differential equations in `f64`.

mod dop853;
mod dop853_table;

pub use dop853::{Dop853, StepError};

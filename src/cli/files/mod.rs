//! Input and output files.

pub mod output;
pub mod source;

//! Input and output files.

pub mod bounded;
pub mod hard_folder;
pub mod output;
pub mod source;

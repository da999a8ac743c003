//! Input and output files.

pub mod artefact;
pub mod bounded;
pub mod errata;
pub mod hard_folder;
pub mod output;
pub mod source;

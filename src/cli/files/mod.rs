//! Files in, files out.

pub mod output;
pub mod source;
pub mod temporary;

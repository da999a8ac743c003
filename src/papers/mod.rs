//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

mod report;
pub mod zinchenko;

pub use report::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, SCHEMA_VERSION,
    Subject, Tally, VariantResult,
};

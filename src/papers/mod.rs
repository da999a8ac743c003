//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

pub mod gembara_senyk;
pub mod ledger;
mod report;
pub mod zinchenko;

pub use report::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, SCHEMA_VERSION,
    Subject, Tally, VariantResult,
};

use crate::reference::Undecided;

/// Called now and then with the phase, how much of it is done, and its whole.
pub type Progress<'a> = &'a (dyn Fn(&str, u64, u64) + Sync);

/// Audits a paper; undecided when a certified value cannot be had.
pub type PaperAudit = fn(Progress) -> Result<PaperReport, Undecided>;

/// The papers known by their key.
const PAPERS: &[(&str, PaperAudit)] = &[(zinchenko::KEY, zinchenko::report)];

/// The audit of the paper of that key.
pub fn find(key: &str) -> Option<PaperAudit> {
    PAPERS.iter().find(|p| p.0 == key).map(|p| p.1)
}

/// The keys of all papers.
pub fn keys() -> Vec<&'static str> {
    PAPERS.iter().map(|p| p.0).collect()
}

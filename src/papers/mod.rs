//! Published papers taken apart: their data as printed, their tables, their formulas, and what was
//! found. Each paper is a module; what it finds has the common shape defined here.

mod report;
pub mod zinchenko;

pub use report::{
    Citation, Entry, EntryVerdict, Figure, Finding, FindingVerdict, PaperReport, SCHEMA_VERSION,
    Subject, Tally, VariantResult,
};

/// Audits a paper, reporting progress as phase, steps done, steps in all.
pub type AuditPaper =
    fn(&(dyn Fn(&str, u64, u64) + Sync)) -> Result<PaperReport, crate::reference::Undecided>;

/// The names of the papers.
pub fn keys() -> &'static [&'static str] {
    &[zinchenko::KEY]
}

/// The audit of the paper of that name.
pub fn find(key: &str) -> Option<AuditPaper> {
    (key == zinchenko::KEY).then_some(zinchenko::report as AuditPaper)
}

//! Drawings and claims under dispute in PMKSWeb, a program for planar linkages: its issue 91, four
//! programs that trace two different paths of one four-bar; issue 92, links that change their
//! lengths; pull request 231, a slider that passes through the position in which its two roots
//! meet.
//!
//! [`drawing`] has the positions in balls from the drawn decimals; [`items()`] proves what they
//! rest on.

pub mod drawing;
mod findings;
mod ledger;

pub use ledger::items;

use super::ledger::Ledger;
use super::{Citation, PaperReport, Progress};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "pmksweb";

/// The source.
pub fn citation() -> Citation {
    Citation {
        key: KEY,
        authors: "PMKS-Web",
        title: "Issues 91 and 92, pull request 231 of PMKSWeb",
        year: Some(2023),
        venue: "github.com/PMKS-Web/PMKSWeb, 2023 to 2026",
    }
}

/// The verdicts.
///
/// # Errors
/// [`Undecided`] if a sign cannot be told.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 2);
    let ledger = Ledger::of(citation(), &items());
    progress("drawings", 1, 2);
    let findings = findings::all(&ledger)?;
    progress("done", 2, 2);
    Ok(PaperReport::new(citation(), findings))
}

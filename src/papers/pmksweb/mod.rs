//! Drawings and claims under dispute in PMKSWeb, a program for planar linkages: its issue 91, four
//! programs that trace two different paths of one four-bar; issue 92, links that change their
//! lengths; pull request 231, a slider that passes through the position in which its two roots
//! meet.
//!
//! [`drawing`] has the positions in balls from the drawn decimals; the ledger proves what they
//! rest on.

pub mod drawing;
mod findings;

use super::{PaperReport, Progress, file_of_known};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "pmksweb";

/// The verdicts.
///
/// # Errors
/// [`Undecided`] if a sign cannot be told.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 2);
    let ledger = file_of_known(KEY).ledger();
    progress("drawings", 1, 2);
    let findings = findings::all(&ledger)?;
    progress("done", 2, 2);
    Ok(PaperReport::new(
        file_of_known(KEY).citation.clone(),
        findings,
    ))
}

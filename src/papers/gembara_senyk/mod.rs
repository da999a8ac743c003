//! Gembara and Senyk, *Dynamics of oscillating-follower cam mechanisms in a non-stationary regime*:
//! the driven link of a cam mechanism as one mass on a spring while the shaft speeds up or runs
//! down, solved with the probability integral of complex argument.
//!
//! [`items()`] decides every formula; [`amplitude`] and [`charts`] show what follows from the
//! wrong ones; [`report`] sums that up.

pub mod amplitude;
pub mod charts;
mod findings;
mod ledger;

pub use ledger::items;

use super::ledger::{Ledger, Verdict, proved};
use super::{Citation, Finding, PaperReport, Progress};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "gembara-senyk";

/// The paper. The text layer at hand names neither year nor issue; its latest reference is of 1968.
pub fn citation() -> Citation {
    Citation {
        key: KEY,
        authors: "V. M. Gembara, D. M. Senyk",
        title: "Dynamics of oscillating-follower cam mechanisms in a non-stationary regime",
        year: None,
        venue: "Polihrafiia i vydavnycha sprava, Lviv (in Ukrainian), 1968 or later",
    }
}

/// The findings of the ledger: what is wrong, and one finding for what is proved; and what follows.
/// The paper's graphs cannot be recomputed: it gives neither cams nor oscillator.
///
/// # Errors
/// None; the signature is that of every paper.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 3);
    let ledger = Ledger::of(citation(), &items());
    let mut findings = of_the_ledger(&ledger);
    progress("amplitudes", 1, 3);
    findings.extend(findings::formulas());
    progress("charts", 2, 3);
    findings.extend(findings::comparison());
    progress("done", 3, 3);
    Ok(PaperReport::new(citation(), findings))
}

fn of_the_ledger(ledger: &Ledger) -> Vec<Finding> {
    let proved = proved(
        ledger,
        ["ledger-proved", "(1)-(19)"],
        format!(
            "{} formulas and steps are proved as printed",
            ledger.count(Verdict::Proved)
        ),
        "The difference of both sides has the normal form zero in the exact algebra. The \
         ledger lists every entry with its requirements.",
    );
    let wrong = ledger.entries.iter().filter_map(super::ledger::finding);
    wrong.chain([proved]).collect()
}

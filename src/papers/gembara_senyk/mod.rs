//! Gembara and Senyk, *Dynamics of oscillating-follower cam mechanisms in a non-stationary regime*:
//! the driven link of a cam mechanism as one mass on a spring while the shaft speeds up or runs
//! down, solved with the probability integral of complex argument.
//!
//! The ledger decides every formula; [`amplitude`] and [`charts`] show what follows from the
//! wrong ones; [`report`] sums that up.

pub mod amplitude;
pub mod charts;
mod findings;

use super::ledger::{Ledger, Verdict, proved};
use super::{Finding, PaperReport, Progress, file_of_known};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "gembara-senyk";

/// The findings of the ledger: what is wrong, and one finding for what is proved; and what follows.
/// The paper's graphs cannot be recomputed: it gives neither cams nor oscillator.
///
/// # Errors
/// None; the signature is that of every paper.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 3);
    let ledger = file_of_known(KEY).ledger();
    let mut findings = of_the_ledger(&ledger);
    progress("amplitudes", 1, 3);
    findings.extend(findings::formulas());
    progress("charts", 2, 3);
    findings.extend(findings::comparison());
    progress("done", 3, 3);
    Ok(PaperReport::new(
        file_of_known(KEY).citation.clone(),
        findings,
    ))
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

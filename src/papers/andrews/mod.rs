//! Andrews' squeezing mechanism, the benchmark of solvers for equations of motion with constraints:
//! seven bodies, a constant torque, one spring, as the Test Set for Initial Value Problem Solvers
//! prints it after Hairer and Wanner.
//!
//! [`motion()`] encloses the motion without integrating in time; every printed digit is compared
//! with it. [`items()`] proves the printed equations from the kinetic and potential energy.

pub mod data;
mod entries;
mod findings;
mod ledger;
mod motion;
mod printed;

pub use data::BITS;
pub use ledger::items;
pub use motion::{DIGITS, Motion, TIMES, motion};
pub use printed::{Printed, QUANTITIES, printed, unit};

use super::ledger::Ledger;
use super::{Citation, PaperReport, Progress};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "andrews";

/// The source.
pub fn citation() -> Citation {
    Citation {
        key: KEY,
        authors: "F. Mazzia, C. Magherini, F. Iavernaro",
        title: "Test Set for Initial Value Problem Solvers, problem andrews",
        year: Some(2006),
        venue: "Release 2.3, Report 43/2006, University of Bari; after E. Hairer, G. Wanner, Solving \
                Ordinary Differential Equations II, VII.7",
    }
}

/// Encloses the motion and compares every printed value.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 3);
    let ledger = Ledger::of(citation(), &items());
    progress("motion", 1, 3);
    let motion = motion(BITS)?;
    progress("digits", 2, 3);
    let printed = printed();
    let (entries, tallies) = entries::entries(&printed, &motion.values);
    let findings = findings::all(&ledger, &printed, &motion);
    progress("done", 3, 3);
    Ok(PaperReport::new(citation(), findings).with_entries(entries, tallies))
}

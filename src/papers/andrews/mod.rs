//! Andrews' squeezing mechanism, the benchmark of solvers for equations of motion with constraints:
//! seven bodies, a constant torque, one spring, as the Test Set for Initial Value Problem Solvers
//! prints it after Hairer and Wanner.
//!
//! [`motion()`] encloses the motion without integrating in time; every printed digit is compared
//! with it. The ledger proves the printed equations from the kinetic and potential energy.

pub mod data;
mod entries;
mod findings;
mod motion;
mod printed;

pub use data::BITS;
pub use motion::{DIGITS, Motion, TIMES, motion};
pub use printed::{Printed, QUANTITIES, printed, unit};

use super::{PaperReport, Progress, file_of_known};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "andrews";

/// Encloses the motion and compares every printed value.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 3);
    let ledger = file_of_known(KEY).ledger();
    progress("motion", 1, 3);
    let motion = motion(BITS)?;
    progress("digits", 2, 3);
    let printed = printed();
    let (entries, tallies) = entries::entries(&printed, &motion.values);
    let findings = findings::all(&ledger, &printed, &motion);
    progress("done", 3, 3);
    Ok(
        PaperReport::new(file_of_known(KEY).citation.clone(), findings)
            .with_entries(entries, tallies),
    )
}

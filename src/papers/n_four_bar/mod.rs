//! The N four-bar mechanism, the benchmark of multibody solvers for singular positions: N + 1
//! cranks and N rods of 1 m and 1 kg, as the library of computational benchmark problems of the
//! Universidad de La Coruña (now IFToMM's) specifies it, problem A02.
//!
//! Cranks and rods form parallelograms, whose motion is that of a pendulum that turns over:
//! [`data`] reduces it in exact numbers, [`motion()`] encloses it, and every printed number is
//! compared. [`singular`] tells what meets where all bars lie on one line, what is defined there
//! and what is not. The ledger proves the equations for every N.

pub mod data;
mod entries;
mod exact;
mod findings;
mod motion;
mod printed;
pub mod singular;

pub use motion::{BITS, Course, DIGITS, Motion, QUANTITIES, TIMES, motion};
pub use printed::{Copied, Row};

use super::{PaperReport, Progress, file_of_known};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "n-four-bar";

/// Encloses the motion, looks at the singular positions and compares every printed number.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 4);
    let ledger = file_of_known(KEY).ledger();
    progress("motion", 1, 4);
    let motion = motion(BITS)?;
    progress("digits", 2, 4);
    let (entries, tallies) = entries::entries(&motion);
    progress("singular positions", 3, 4);
    let findings = findings::all(&ledger, &motion)?;
    progress("done", 4, 4);
    Ok(
        PaperReport::new(file_of_known(KEY).citation.clone(), findings)
            .with_entries(entries, tallies),
    )
}

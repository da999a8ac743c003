//! The N four-bar mechanism, the benchmark of multibody solvers for singular positions: N + 1
//! cranks and N rods of 1 m and 1 kg, as the library of computational benchmark problems of the
//! Universidad de La Coruña (now IFToMM's) specifies it, problem A02.
//!
//! Cranks and rods form parallelograms, whose motion is that of a pendulum that turns over:
//! [`data`] reduces it in exact numbers, [`motion()`] encloses it, and every printed number is
//! compared. [`singular`] tells what meets where all bars lie on one line, what is defined there
//! and what is not. [`items()`] proves the equations for every N.

pub mod data;
mod entries;
mod exact;
mod findings;
mod ledger;
mod motion;
mod printed;
pub mod singular;

pub use ledger::items;
pub use motion::{BITS, Course, DIGITS, Motion, QUANTITIES, TIMES, motion};
pub use printed::{Copied, Row};

use super::ledger::Ledger;
use super::{Citation, PaperReport, Progress};
use crate::reference::Undecided;

/// The name used on the command line.
pub const KEY: &str = "n-four-bar";

/// The source.
pub fn citation() -> Citation {
    Citation {
        key: KEY,
        authors: "M. González",
        title: "N four-bar mechanism, problem A02",
        year: Some(2005),
        venue: "Library of computational benchmark problems for multibody dynamics, Universidad de La Coruña, now of \
                IFToMM; M. González, D. Dopico, U. Lugrís, J. Cuadrado, Multibody System Dynamics 16 (2006) 179-190; \
                after E. Bayo, A. Avello, Nonlinear Dynamics 5 (1994) 209-231",
    }
}

/// Encloses the motion, looks at the singular positions and compares every printed number.
///
/// # Errors
/// [`Undecided`] if a proof fails.
pub fn report(progress: Progress) -> Result<PaperReport, Undecided> {
    progress("ledger", 0, 4);
    let ledger = Ledger::of(citation(), &items());
    progress("motion", 1, 4);
    let motion = motion(BITS)?;
    progress("digits", 2, 4);
    let (entries, tallies) = entries::entries(&motion);
    progress("singular positions", 3, 4);
    let findings = findings::all(&ledger, &motion)?;
    progress("done", 4, 4);
    Ok(PaperReport::new(citation(), findings).with_entries(entries, tallies))
}

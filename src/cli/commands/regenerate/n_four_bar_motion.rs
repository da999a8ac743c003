//! The enclosed motion of the N four-bar mechanism.

use crate::cli::files::artefact::{Made, Outcome, certified};
use mechaudit::papers::n_four_bar::data::{SIZES, inertia, pendulum, squares, state};
use mechaudit::papers::n_four_bar::{BITS, DIGITS, QUANTITIES};
use rug::Rational;
use std::fmt::Write as _;

/// Seconds of the benchmark.
const LAST: u32 = 20;

/// Position and velocity of B0 at every second.
pub fn made() -> Outcome<Made> {
    let mut body = String::from("N,t_s,quantity,unit,value\n");
    for n in SIZES {
        let turning = pendulum(n, BITS)?;
        for t in 1..=LAST {
            let state = state(&turning, &Rational::from(t))?;
            for ((name, unit), value) in QUANTITIES.iter().zip(&state.values) {
                let value = certified(value, DIGITS, BITS)?;
                writeln!(body, "{n},{t},{name},{unit},{value}")?;
            }
        }
    }
    Ok(Made {
        title: "The enclosed motion of the N four-bar mechanism of the library of computational benchmark\n\
                problems: point B0, upright at the start with 1 m/s; see reference/README.md."
            .into(),
        facts: vec![
            ("precision", format!("{DIGITS} certified digits at {BITS} bits")),
            ("counts", format!("{} sizes, {LAST} times", SIZES.len())),
        ],
        recipe: format!(
            "{:?} at {LAST}",
            SIZES.map(|n| (n, inertia(n), squares(n)))
        ),
        body,
    })
}

//! The enclosed motion of Andrews' squeezing mechanism.

use crate::cli::files::artefact::{Made, Outcome, certified};
use mechaudit::papers::andrews::{BITS, DIGITS, QUANTITIES, TIMES, data, motion, printed, unit};
use std::fmt::Write as _;

/// Angles, rates, accelerations, multipliers at the start and at [`TIMES`], with what is printed
/// for them.
pub fn made() -> Outcome<Made> {
    let motion = motion(BITS)?;
    let printed = printed();
    let mut body = String::from("t_s,quantity,unit,printed,value\n");
    for (time, values) in ["0"].iter().chain(&TIMES).zip(&motion.values) {
        for (k, value) in values.iter().enumerate() {
            let text = printed.iter().find(|p| p.time == *time && p.quantity == k);
            let text = text.map_or("", |p| &p.number.text);
            // Zero at rest and unloaded: an enclosure of zero has no digits.
            let value = match value.contains_zero() && *time == "0" {
                true => "0".into(),
                false => certified(value, DIGITS, BITS)?,
            };
            writeln!(body, "{time},{},{},{text},{value}", QUANTITIES[k], unit(k))?;
        }
    }
    Ok(Made {
        title: "The enclosed motion of Andrews' squeezing mechanism from rest, beside the values that the\n\
                Test Set for Initial Value Problem Solvers prints; see reference/README.md. At t = 0 a 0\n\
                stands for an enclosure of zero."
            .into(),
        facts: vec![
            ("precision", format!("{DIGITS} certified digits at {BITS} bits")),
            ("counts", format!("{} quantities, {} times", QUANTITIES.len(), TIMES.len() + 1)),
        ],
        recipe: format!(
            "{:?} {:?} {:?} {:?} at {TIMES:?}",
            data::mechanism()?.bodies(),
            data::mechanism()?.joints(),
            data::forces(),
            data::fold(),
        ),
        body,
    })
}

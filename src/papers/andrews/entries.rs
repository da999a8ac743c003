//! Every printed value against the certified one, digit by digit.

use super::motion::{DIGITS, Motion, TIMES};
use super::printed::{Printed, QUANTITIES, kind};
use crate::papers::number::{Number, tally};
use crate::papers::{Entry, Tally};
use crate::reference::Ball;
use std::collections::BTreeMap;

/// The variant of the data: there is but one.
const VARIANT: &str = "as_printed";
/// Columns of the tallies, by kind of quantity.
const COLUMNS: [&str; 4] = ["angles", "rates", "accelerations", "multipliers"];
/// Printed values of a time: 1 at the start, 2 at the end.
const TABLES: [(u32, &str); 2] = [(1, "0"), (2, TIMES[2])];

/// The certified value of a printed one.
pub(super) fn certified<'a>(motion: &'a Motion, p: &Printed) -> &'a Ball {
    let at = TIMES.iter().position(|t| *t == p.time).map_or(0, |k| k + 1);
    &motion.values[at][p.quantity]
}

/// Judges every printed value.
pub(super) fn entries(printed: &[Printed], motion: &Motion) -> (Vec<Entry>, Vec<Tally>) {
    let mut entries = Vec::new();
    let mut tallies = Vec::new();
    for (table, time) in TABLES {
        for (k, column) in COLUMNS.into_iter().enumerate() {
            let of = printed
                .iter()
                .filter(|p| p.time == time && kind(p.quantity) == k);
            let of: Vec<&Printed> = of.collect();
            let pairs = of.iter().map(|p| (&p.number, certified(motion, p)));
            let pairs: Vec<(&Number, &Ball)> = pairs.collect();
            if !of.is_empty() {
                tallies.push(tally([VARIANT, column], table, &pairs));
            }
            entries.extend(of.iter().zip(&pairs).map(|(p, (number, value))| Entry {
                table,
                row: p.quantity as u32 + 1,
                column: QUANTITIES[p.quantity],
                printed: number.text.clone(),
                variants: BTreeMap::from([(VARIANT, number.judged(value, DIGITS))]),
            }));
        }
    }
    (entries, tallies)
}

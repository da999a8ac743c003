//! Every printed number against the certified one.

use super::motion::{DIGITS, Motion};
use crate::papers::number::{Number, tally};
use crate::papers::{Entry, Tally};
use crate::reference::Ball;
use std::collections::BTreeMap;

/// The variant of the data: there is but one.
const VARIANT: &str = "as_printed";
/// The library's columns, table 1.
const PLACE: [&str; 2] = ["B0_x", "B0_y"];
/// EXUDYN's quantities, table 2.
const COPIED: [&str; 6] = ["B0_x", "B0_y", "B0_vx", "B0_vy", "C0_x", "C0_y"];

/// A printed number, its row and what is due.
type Pair<'a> = (u32, &'a Number, &'a Ball);

/// Table, column, and what stands in it.
fn columns(motion: &Motion) -> Vec<(u32, &'static str, Vec<Pair<'_>>)> {
    let mut all: Vec<(u32, &'static str, Vec<Pair<'_>>)> = Vec::new();
    for (k, column) in PLACE.into_iter().enumerate() {
        let rows = motion.library.iter().zip(1..);
        let pairs = rows.map(|((row, due), i)| (i, &row.place[k], &due.values[k]));
        all.push((1, column, pairs.collect()));
    }
    for column in COPIED {
        let of = motion.exudyn.iter().zip(1..);
        let of = of.filter(|((copied, _), _)| copied.quantity == column);
        let pairs = of.filter_map(|((copied, due), i)| Some((i, &copied.number, due.as_ref()?)));
        all.push((2, column, pairs.collect()));
    }
    all
}

/// Judges every printed number for which a value is due.
pub(super) fn entries(motion: &Motion) -> (Vec<Entry>, Vec<Tally>) {
    let mut entries = Vec::new();
    let mut tallies = Vec::new();
    for (table, column, of) in columns(motion) {
        let pairs: Vec<(&Number, &Ball)> = of.iter().map(|(_, p, v)| (*p, *v)).collect();
        tallies.push(tally([VARIANT, column], table, &pairs));
        entries.extend(of.iter().map(|(row, number, value)| Entry {
            table,
            row: *row,
            column,
            printed: number.text.clone(),
            variants: BTreeMap::from([(VARIANT, number.judged(value, DIGITS))]),
        }));
    }
    (entries, tallies)
}

//! Every printed number against the certified one.

use super::motion::{DIGITS, Motion};
use crate::papers::number::{self, Column};
use crate::papers::{Entry, Tally};

/// The library's columns, table 1.
const PLACE: [&str; 2] = ["B0_x", "B0_y"];
/// EXUDYN's quantities, table 2.
const COPIED: [&str; 6] = ["B0_x", "B0_y", "B0_vx", "B0_vy", "C0_x", "C0_y"];

fn columns(motion: &Motion) -> Vec<Column<'_>> {
    let mut all: Vec<Column> = Vec::new();
    for (k, column) in PLACE.into_iter().enumerate() {
        let rows = motion.library.iter().zip(1..);
        let rows = rows.map(|((row, due), i)| (i, column, &row.place[k], &due.values[k]));
        all.push((1, column, rows.collect()));
    }
    for column in COPIED {
        let of = motion.exudyn.iter().zip(1..);
        let of = of.filter(|((copied, _), _)| copied.quantity == column);
        let rows =
            of.filter_map(|((copied, due), i)| Some((i, column, &copied.number, due.as_ref()?)));
        all.push((2, column, rows.collect()));
    }
    all
}

/// Judges every printed number for which a certified value exists.
pub(super) fn entries(motion: &Motion) -> (Vec<Entry>, Vec<Tally>) {
    number::entries(&columns(motion), DIGITS)
}

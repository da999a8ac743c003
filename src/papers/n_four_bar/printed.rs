//! The printed numbers: the library's reference for N = 40, and EXUDYN's runs for N = 2.

use super::motion::{DIGITS, Motion};
use crate::papers::number::{self, Column, Number, records};
use crate::papers::{Entry, Tally};
use rug::Rational;

const LIBRARY: &str = include_str!("../../../reference/published/n-four-bar-a02.csv");
const EXUDYN: &str = include_str!("../../../reference/published/n-four-bar-exudyn.csv");

/// A row of the library's reference.
pub struct Row {
    /// Time in s.
    pub time: Rational,
    /// x and y of B0 in m.
    pub place: [Number; 2],
}

/// A number of an EXUDYN run.
pub struct Copied {
    /// Step of the run in s.
    pub step: String,
    /// Time in s.
    pub time: Rational,
    /// `B0_x` and so on, or `drift`.
    pub quantity: String,
    /// The printed number.
    pub number: Number,
}

/// The library's rows.
pub fn library() -> Vec<Row> {
    let row = |r: &csv::StringRecord| Row {
        time: Number::read(&r[0]).value.value,
        place: [Number::read(&r[1]), Number::read(&r[2])],
    };
    records(LIBRARY).iter().map(row).collect()
}

/// EXUDYN's numbers.
pub fn exudyn() -> Vec<Copied> {
    let row = |r: &csv::StringRecord| Copied {
        step: r[0].into(),
        time: Number::read(&r[1]).value.value,
        quantity: r[2].into(),
        number: Number::read(&r[3]),
    };
    records(EXUDYN).iter().map(row).collect()
}

/// Judges every printed number for which a certified value exists: table 1 is the library's, table
/// 2 EXUDYN's.
pub(super) fn entries(motion: &Motion) -> (Vec<Entry>, Vec<Tally>) {
    let row = |number, name, printed, due| number::Row {
        number,
        name,
        printed,
        due: vec![Some(due)],
    };
    let mut all: Vec<Column> = Vec::new();
    for (k, name) in ["B0_x", "B0_y"].into_iter().enumerate() {
        let rows = motion.library.iter().zip(1..);
        let rows = rows.map(|((of, due), i)| row(i, name, &of.place[k], &due.values[k]));
        all.push(Column {
            table: 1,
            name,
            rows: rows.collect(),
        });
    }
    for name in ["B0_x", "B0_y", "B0_vx", "B0_vy", "C0_x", "C0_y"] {
        let of = motion.exudyn.iter().zip(1..);
        let of = of.filter(|((copied, _), _)| copied.quantity == name);
        let rows =
            of.filter_map(|((copied, due), i)| Some(row(i, name, &copied.number, due.as_ref()?)));
        all.push(Column {
            table: 2,
            name,
            rows: rows.collect(),
        });
    }
    number::by_digits(&all, DIGITS)
}

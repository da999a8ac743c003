//! The printed numbers: the library's reference for N = 40, and EXUDYN's runs for N = 2.

use crate::papers::number::{Number, records};
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

fn seconds(text: &str) -> Rational {
    Number::read(text).value.value
}

/// The library's rows.
pub fn library() -> Vec<Row> {
    let row = |r: &csv::StringRecord| Row {
        time: seconds(&r[0]),
        place: [Number::read(&r[1]), Number::read(&r[2])],
    };
    records(LIBRARY).iter().map(row).collect()
}

/// EXUDYN's numbers.
pub fn exudyn() -> Vec<Copied> {
    let row = |r: &csv::StringRecord| Copied {
        step: r[0].into(),
        time: seconds(&r[1]),
        quantity: r[2].into(),
        number: Number::read(&r[3]),
    };
    records(EXUDYN).iter().map(row).collect()
}

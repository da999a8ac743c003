//! The printed values, and their judgement digit by digit.

use super::motion::{DIGITS, TIMES};
use crate::papers::number::{self, Column, Number, Row, records};
use crate::papers::{Entry, Tally};
use crate::reference::Ball;
use crate::study::intern;
use std::sync::LazyLock;

const VALUES: &str = include_str!("../../../reference/published/andrews.csv");

/// The printed quantities: seven angles, their rates and accelerations, six multipliers.
pub static QUANTITIES: LazyLock<[&'static str; 27]> = LazyLock::new(|| std::array::from_fn(name));

fn name(quantity: usize) -> &'static str {
    let angles = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"];
    let angle = angles[quantity % 7];
    match kind(quantity) {
        0 => angle,
        1 => intern(&format!("{angle}_dot")),
        2 => intern(&format!("{angle}_ddot")),
        _ => intern(&format!("lambda_{}", quantity % 7 + 1)),
    }
}

/// The unit of a quantity by its index.
pub fn unit(quantity: usize) -> &'static str {
    ["rad", "rad/s", "rad/s^2", "N"][kind(quantity)]
}

/// The kinds of quantities.
pub(super) const KINDS: [&str; 4] = ["angles", "rates", "accelerations", "multipliers"];

/// The number of a quantity's kind.
pub(super) fn kind(quantity: usize) -> usize {
    quantity / 7
}

/// A printed value.
#[derive(Clone, Debug)]
pub struct Printed {
    /// The time in seconds, as printed.
    pub time: String,
    /// Index in [`QUANTITIES`].
    pub quantity: usize,
    /// The printed number.
    pub number: Number,
}

/// All printed values in the order of the file.
pub fn printed() -> Vec<Printed> {
    let row = |r: &csv::StringRecord| {
        let name = QUANTITIES.iter().position(|q| *q == &r[1]);
        Printed {
            time: r[0].into(),
            quantity: name.expect("a quantity of the mechanism"),
            number: Number::read(&r[2]),
        }
    };
    records(VALUES).iter().map(row).collect()
}

/// The certified value of a printed one.
pub(super) fn certified<'a>(values: &'a [Vec<Ball>], p: &Printed) -> &'a Ball {
    let at = TIMES.iter().position(|t| *t == p.time).map_or(0, |k| k + 1);
    &values[at][p.quantity]
}

/// Judges every printed value: table 1 is at the start, table 2 at the end.
pub(super) fn entries(printed: &[Printed], values: &[Vec<Ball>]) -> (Vec<Entry>, Vec<Tally>) {
    let mut columns: Vec<Column> = Vec::new();
    for (table, time) in [(1, "0"), (2, TIMES[2])] {
        for (k, column) in KINDS.into_iter().enumerate() {
            let of = printed
                .iter()
                .filter(|p| p.time == time && kind(p.quantity) == k);
            let rows = of.map(|p| Row {
                number: p.quantity as u32 + 1,
                name: QUANTITIES[p.quantity],
                printed: &p.number,
                due: vec![Some(certified(values, p))],
            });
            columns.push(Column {
                table,
                name: column,
                rows: rows.collect(),
            });
        }
    }
    columns.retain(|c| !c.rows.is_empty());
    number::by_digits(&columns, DIGITS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantities_come_in_four_kinds() {
        assert_eq!(
            [0, 6, 7, 13, 14, 20, 21, 26].map(kind),
            [0, 0, 1, 1, 2, 2, 3, 3]
        );
        assert_eq!([0, 7, 14, 21].map(unit), ["rad", "rad/s", "rad/s^2", "N"]);
        let named = [6, 8, 20, 21, 26].map(|k| QUANTITIES[k]);
        let due = [
            "epsilon",
            "Theta_dot",
            "epsilon_ddot",
            "lambda_1",
            "lambda_6",
        ];
        assert_eq!(named, due);
        let all = printed();
        let first = &all[0];
        assert_eq!((first.time.as_str(), first.quantity), ("0", 0));
        assert_eq!(first.number.text, "-0.0617138900142764496358948458001");
        assert!(all.iter().any(|p| p.time == "0.03" && p.quantity == 26));
    }

    /// Values that are the printed ones, but for one that is off by 2 of its last digit.
    #[test]
    fn every_value_is_an_entry_of_its_time_and_kind() {
        let all = printed();
        let mut values = vec![vec![Ball::integer(200, 0); QUANTITIES.len()]; TIMES.len() + 1];
        for p in &all {
            let at = if p.time == "0" { 0 } else { 3 };
            values[at][p.quantity] = Ball::rational(200, &p.number.value.value);
        }
        let end = |p: &&Printed| p.time == TIMES[2] && p.quantity == 8;
        let off = all.iter().find(end).unwrap();
        let two = Ball::rational(200, &off.number.value.unit()).shift(1);
        values[3][8] = &values[3][8] - &two;
        let (entries, tallies) = entries(&all, &values);
        assert_eq!(entries.len(), all.len());
        for p in &all {
            let table = if p.time == "0" { 1 } else { 2 };
            let row = p.quantity as u32 + 1;
            let mut own = entries.iter().filter(|e| (e.table, e.row) == (table, row));
            let entry = own.next().unwrap();
            assert!(own.next().is_none());
            assert_eq!(
                (entry.column, &entry.printed),
                (QUANTITIES[p.quantity], &p.number.text)
            );
            let units = entry.variants[number::AS_PRINTED].units_in_last_digit;
            assert_eq!(units, if (table, row) == (2, 9) { 2.0 } else { 0.0 });
        }
        let counts: Vec<(u32, &str, usize)> = tallies
            .iter()
            .map(|t| (t.table, t.column, t.entries))
            .collect();
        // Rates at the start vanish and are not printed, as are some others.
        assert_eq!(
            counts[counts.len() - 4..],
            [
                (2, "angles", 7),
                (2, "rates", 7),
                (2, "accelerations", 7),
                (2, "multipliers", 6),
            ]
        );
        assert!(counts.iter().all(|c| c.1 != "rates" || c.0 == 2));
        assert_eq!(counts.iter().map(|c| c.2).sum::<usize>(), all.len());
        let right: Vec<usize> = tallies.iter().map(|t| t.entries - t.within_one).collect();
        assert_eq!(right.iter().sum::<usize>(), 1);
    }
}

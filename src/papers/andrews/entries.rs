//! Every printed value against the certified one, digit by digit.

use super::motion::{DIGITS, TIMES};
use super::printed::{Printed, QUANTITIES, kind};
use crate::papers::number::{self, Column};
use crate::papers::{Entry, Tally};
use crate::reference::Ball;

/// Columns of the tallies, by kind of quantity.
const COLUMNS: [&str; 4] = ["angles", "rates", "accelerations", "multipliers"];
/// Printed values of a time: 1 at the start, 2 at the end.
const TABLES: [(u32, &str); 2] = [(1, "0"), (2, TIMES[2])];

/// The certified value of a printed one.
pub(super) fn certified<'a>(values: &'a [Vec<Ball>], p: &Printed) -> &'a Ball {
    let at = TIMES.iter().position(|t| *t == p.time).map_or(0, |k| k + 1);
    &values[at][p.quantity]
}

/// Judges every printed value.
pub(super) fn entries(printed: &[Printed], values: &[Vec<Ball>]) -> (Vec<Entry>, Vec<Tally>) {
    let mut columns: Vec<Column> = Vec::new();
    for (table, time) in TABLES {
        for (k, column) in COLUMNS.into_iter().enumerate() {
            let of = printed
                .iter()
                .filter(|p| p.time == time && kind(p.quantity) == k);
            let rows = of.map(|p| {
                let (row, name) = (p.quantity as u32 + 1, QUANTITIES[p.quantity]);
                (row, name, &p.number, certified(values, p))
            });
            columns.push((table, column, rows.collect()));
        }
    }
    columns.retain(|c| !c.2.is_empty());
    number::entries(&columns, DIGITS)
}

#[cfg(test)]
mod tests {
    use super::super::printed::printed;
    use super::*;

    /// Values that are the printed ones, but for one that is off by 2 of its last digit.
    #[test]
    fn every_value_is_an_entry_of_its_time_and_kind() {
        let all = printed();
        let mut values = vec![vec![Ball::integer(200, 0); QUANTITIES.len()]; TIMES.len() + 1];
        for p in &all {
            let at = if p.time == "0" { 0 } else { 3 };
            values[at][p.quantity] = Ball::rational(200, &p.number.value.value);
        }
        let off = all
            .iter()
            .find(|p| p.time == TIMES[2] && p.quantity == 8)
            .unwrap();
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

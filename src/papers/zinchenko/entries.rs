//! Every printed entry against its recomputed value.

use super::tables::{Column, Printed, ROWS};
use crate::papers::number::{explained, tally};
use crate::papers::{Entry, EntryVerdict, Tally, VariantJudgement, decided};
use crate::reference::Ball;
use std::collections::BTreeMap;

/// Digits of the recomputed values.
const DIGITS: usize = 25;

/// A variant of the data with its recomputed columns, in the order of [`Column::ALL`].
pub(super) struct Variant {
    pub name: &'static str,
    pub columns: Vec<Vec<Ball>>,
}

fn judge(
    printed: &[Printed],
    at: usize,
    value: &Ball,
    twin: Option<(&Printed, &Ball)>,
    column_agrees: bool,
) -> VariantJudgement {
    let p = &printed[at].number;
    let by_twin = || {
        let (t, v) = twin?;
        let (table, text) = (t.column.table(), &t.number.text);
        let says = || format!("Table {table} prints {text} for the same quantity, which agrees");
        t.number.is_rounded(v).then(says)
    };
    let reason = || by_twin().or_else(|| explained(&p.text, value));
    let (verdict, note) = match p.verdict(value) {
        EntryVerdict::Unexplained if column_agrees => match reason() {
            Some(note) => (EntryVerdict::Misprint, Some(note)),
            None => (EntryVerdict::Unexplained, None),
        },
        verdict => (verdict, None),
    };
    VariantJudgement {
        recomputed: decided(value.to_decimal(DIGITS)),
        units_in_last_digit: (p.units_off(value) * 1e6).round() / 1e6,
        verdict,
        note,
    }
}

/// Judges every entry under every variant.
pub(super) fn entries(printed: &[Printed], variants: &[Variant]) -> (Vec<Entry>, Vec<Tally>) {
    let mut all: Vec<Entry> = printed
        .iter()
        .map(|p| Entry {
            table: p.column.table(),
            row: p.row as u32,
            column: p.column.name(),
            printed: p.number.text.clone(),
            variants: BTreeMap::new(),
        })
        .collect();
    let mut tallies = Vec::new();
    let index = |c: Column| Column::ALL.iter().position(|&x| x == c).expect("a column");
    for v in variants {
        for (c, &column) in Column::ALL.iter().enumerate() {
            let first = c * ROWS;
            let pairs = printed[first..]
                .iter()
                .map(|p| &p.number)
                .zip(&v.columns[c]);
            let tally = tally([v.name, column.name()], column.table(), pairs.take(ROWS));
            // A misprint stands out only where nearly everything else agrees.
            let column_agrees = ROWS - tally.within_one <= ROWS / 10;
            for row in 0..ROWS {
                let twin = column.twin().map(|t| {
                    let k = index(t);
                    (&printed[k * ROWS + row], &v.columns[k][row])
                });
                let result = judge(
                    printed,
                    first + row,
                    &v.columns[c][row],
                    twin,
                    column_agrees,
                );
                all[first + row].variants.insert(v.name, result);
            }
            tallies.push(tally);
        }
    }
    (all, tallies)
}

/// `(within half a unit, within one)` over all columns of a variant.
pub(super) fn totals(tallies: &[Tally], variant: &str) -> (usize, usize) {
    let of = tallies.iter().filter(|t| t.variant == variant);
    of.fold((0, 0), |(a, b), t| (a + t.within_half, b + t.within_one))
}

#[cfg(test)]
mod tests {
    use super::super::tables;
    use super::*;
    use crate::papers::number::Number;
    use crate::reference::Decimal;

    fn ball(text: &str) -> Ball {
        Ball::rational(200, &Decimal::parse(text).unwrap().value)
    }

    #[test]
    fn single_edits() {
        let note = explained("-10.553", &ball("-10.5334")).unwrap();
        assert!(note.contains("-10.533"), "{note}");
        let note = explained("-110.0421", &ball("-110.04103")).unwrap();
        assert!(
            note.contains("-110.041") && note.contains("too many"),
            "{note}"
        );
        let note = explained("1325", &ball("1235")).unwrap();
        assert_eq!(note, "two digits exchanged: 1235 would agree");
        // Merely a few units off is no misprint.
        assert_eq!(explained("3.060", &ball("3.0634")), None);
        assert_eq!(explained("3.060", &ball("3.0671")), None);
    }

    /// Misprints are told as long as nine tenths of the column agree.
    #[test]
    fn a_column_with_five_entries_off_has_no_misprints() {
        let printed = tables::printed();
        for (off, due) in [(4, EntryVerdict::Misprint), (5, EntryVerdict::Unexplained)] {
            let mut columns: Vec<Vec<Ball>> = printed
                .chunks(ROWS)
                .map(|c| {
                    c.iter()
                        .map(|p| Ball::rational(200, &p.number.value.value))
                        .collect()
                })
                .collect();
            // A thousand too little, in a column without a twin.
            let c = Column::ALL.iter().position(|c| c.twin().is_none()).unwrap();
            for value in &mut columns[c][..off] {
                *value = &*value + &ball("3");
            }
            let name = "planted";
            let (all, tallies) = entries(&printed, &[Variant { name, columns }]);
            assert_eq!(tallies[c].within_one, ROWS - off);
            let verdicts = all[c * ROWS..].iter().map(|e| e.variants[name].verdict);
            let found: Vec<EntryVerdict> = verdicts.take(off).collect();
            assert!(found.contains(&due));
            assert!(!found.contains(&EntryVerdict::Agrees));
        }
    }

    #[test]
    fn an_entry_is_judged_by_its_units() {
        let printed = |text: &str| Printed {
            column: Column::Inertia,
            row: 0,
            number: Number::read(text),
        };
        let all = [printed("10.534"), printed("10.5")];
        let of = |value: &str, twin: Option<&str>, column_agrees| {
            let twin = twin.map(ball);
            let beside = twin.as_ref().map(|v| (&all[1], v));
            judge(&all, 0, &ball(value), beside, column_agrees)
        };
        for (value, twin, agrees, due, units) in [
            ("10.53449", None, true, EntryVerdict::Agrees, -0.49),
            ("10.53451", None, true, EntryVerdict::Rounding, -0.51),
            ("10.53301", None, true, EntryVerdict::Rounding, 0.99),
            ("10.5329", None, true, EntryVerdict::Unexplained, 1.1),
            ("10.5321", Some("10.54"), true, EntryVerdict::Misprint, 1.9),
            (
                "10.5321",
                Some("10.56"),
                true,
                EntryVerdict::Unexplained,
                1.9,
            ),
            ("10.834", None, true, EntryVerdict::Misprint, -300.0),
            // Nothing explains one entry of a column that is wrong throughout.
            ("10.834", None, false, EntryVerdict::Unexplained, -300.0),
        ] {
            let found = of(value, twin, agrees);
            assert_eq!(found.verdict, due, "{value} {twin:?}");
            assert!((found.units_in_last_digit - units).abs() < 1e-6, "{value}");
            assert_eq!(found.note.is_some(), due == EntryVerdict::Misprint);
        }
    }
}

//! Every printed entry against its recomputed value.

use super::tables::{COLUMNS, ROWS, twin};
use crate::papers::number::{self, Column, Number, Row, explained};
use crate::papers::{Entry, EntryVerdict, Tally, VariantJudgement, decided};
use crate::reference::Ball;

/// Digits of the recomputed values.
const DIGITS: usize = 25;

/// A variant of the data: its name and its recomputed columns.
pub(super) type Variant = (&'static str, Vec<Vec<Ball>>);

/// Judges an entry; the twin is the other table's print of the same quantity with its number.
fn judge(
    p: &Number,
    value: &Ball,
    twin: Option<(u32, (&Number, &Ball))>,
    column_agrees: bool,
) -> VariantJudgement {
    let by_twin = || {
        let (table, (other, v)) = twin?;
        let text = &other.text;
        let says = || format!("Table {table} prints {text} for the same quantity, which agrees");
        other.is_rounded(v).then(says)
    };
    let mut verdict = p.verdict(value);
    let mut note = None;
    if verdict == EntryVerdict::Unexplained && column_agrees {
        note = by_twin().or_else(|| explained(&p.text, value));
        verdict = note.as_ref().map_or(verdict, |_| EntryVerdict::Misprint);
    }
    VariantJudgement {
        recomputed: decided(value.to_decimal(DIGITS)),
        units_in_last_digit: (p.units_off(value) * 1e6).round() / 1e6,
        verdict,
        note,
    }
}

/// Judges every entry under every variant.
pub(super) fn entries(printed: &[Vec<Number>], variants: &[Variant]) -> (Vec<Entry>, Vec<Tally>) {
    let column = |(c, (table, name)): (usize, (u32, &'static str))| Column {
        table,
        name,
        rows: (0..ROWS)
            .map(|row| Row {
                number: row as u32,
                name,
                printed: &printed[c][row],
                due: variants.iter().map(|v| Some(&v.1[c][row])).collect(),
            })
            .collect(),
    };
    let columns: Vec<Column> = COLUMNS.into_iter().enumerate().map(column).collect();
    let names: Vec<&str> = variants.iter().map(|v| v.0).collect();
    number::entries(&names, &columns, |[c, row, k], agrees| {
        let of = |c: usize| (&printed[c][row], &variants[k].1[c][row]);
        let beside = twin(c).map(|t| (COLUMNS[t].0, of(t)));
        let (number, value) = of(c);
        judge(number, value, beside, agrees)
    })
}

#[cfg(test)]
mod tests {
    use super::super::tables;
    use super::*;
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
            let exact = |p: &Number| Ball::rational(200, &p.value.value);
            let mut columns: Vec<Vec<Ball>> = printed
                .iter()
                .map(|c| c.iter().map(exact).collect())
                .collect();
            // A thousand too little, in a column without a twin.
            for value in &mut columns[0][..off] {
                *value = &*value + &ball("3");
            }
            let (all, tallies) = entries(&printed, &[("planted", columns)]);
            assert_eq!(tallies[0].within_one, ROWS - off);
            let verdicts = all[..off].iter().map(|e| e.variants["planted"].verdict);
            let found: Vec<EntryVerdict> = verdicts.collect();
            assert!(found.contains(&due) && !found.contains(&EntryVerdict::Agrees));
        }
    }

    #[test]
    fn an_entry_is_judged_by_its_units() {
        let (printed, beside) = (Number::read("10.534"), Number::read("10.5"));
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
            let twin = twin.map(ball);
            let twin = twin.as_ref().map(|v| (3, (&beside, v)));
            let found = judge(&printed, &ball(value), twin, agrees);
            assert_eq!(found.verdict, due, "{value}");
            assert!((found.units_in_last_digit - units).abs() < 1e-6, "{value}");
            assert_eq!(found.note.is_some(), due == EntryVerdict::Misprint);
        }
    }
}

//! Every printed entry against its recomputed value.

use super::tables::{Column, Printed, ROWS};
use crate::audit::{Agreement, agreement};
use crate::papers::number::tally;
use crate::papers::{Entry, EntryVerdict, Tally, VariantJudgement, decided};
use crate::reference::{Ball, Decimal};
use std::collections::BTreeMap;

/// Digits of the recomputed values.
const DIGITS: usize = 25;

/// A variant of the data with its recomputed columns, in the order of [`Column::ALL`].
pub(super) struct Variant {
    pub name: &'static str,
    pub columns: Vec<Vec<Ball>>,
}

/// One digit other than the last replaced or left out, or two neighbours exchanged, such that the
/// result is the correct rounding. (A change of the last digit would explain anything.)
fn single_edit(text: &str, value: &Ball) -> Option<String> {
    let chars: Vec<char> = text.chars().collect();
    let digits: Vec<usize> = (0..chars.len())
        .filter(|&i| chars[i].is_ascii_digit())
        .collect();
    let last = *digits.last()?;
    let with = |change: &dyn Fn(&mut Vec<char>)| {
        let mut c = chars.clone();
        change(&mut c);
        c.into_iter().collect::<String>()
    };
    // The least change first: the length stays, then a character goes.
    let mut edits: Vec<(String, String)> = Vec::new();
    for &i in digits.iter().filter(|&&i| i != last) {
        for d in '0'..='9' {
            edits.push((with(&|c| c[i] = d), "one wrong digit".into()));
        }
        if chars[i + 1].is_ascii_digit() {
            edits.push((with(&|c| c.swap(i, i + 1)), "two digits exchanged".into()));
        }
    }
    for &i in digits.iter().filter(|&&i| i != last) {
        let what = format!("one digit too many ({})", chars[i]);
        let shorter = with(&|c| {
            c.remove(i);
        });
        edits.push((shorter, what));
    }
    edits.into_iter().find_map(|(edited, what)| {
        let written = Decimal::parse(&edited).ok()?;
        (agreement(&written, value) == Agreement::Agrees)
            .then(|| format!("{what}: {edited} would agree"))
    })
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
    let explained = || by_twin().or_else(|| single_edit(&p.text, value));
    let (verdict, note) = match p.verdict(value) {
        EntryVerdict::Unexplained if column_agrees => match explained() {
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

    fn ball(text: &str) -> Ball {
        Ball::rational(200, &Decimal::parse(text).unwrap().value)
    }

    #[test]
    fn single_edits() {
        let note = single_edit("-10.553", &ball("-10.5334")).unwrap();
        assert!(note.contains("-10.533"), "{note}");
        let note = single_edit("-110.0421", &ball("-110.04103")).unwrap();
        assert!(
            note.contains("-110.041") && note.contains("too many"),
            "{note}"
        );
        let note = single_edit("1325", &ball("1235")).unwrap();
        assert_eq!(note, "two digits exchanged: 1235 would agree");
        // Merely a few units off is no misprint.
        assert_eq!(single_edit("3.060", &ball("3.0634")), None);
        assert_eq!(single_edit("3.060", &ball("3.0671")), None);
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

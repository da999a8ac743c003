//! A printed number beside its certified value, digit by digit.

use super::file::Rounding;
use super::{Entry, EntryVerdict, Tally, VariantJudgement};
use crate::audit::{Agreement, agreement};
use crate::reference::{Ball, Decimal};

/// The variant of the data of a paper that is audited with its printed data alone.
pub(super) const AS_PRINTED: &str = "as_printed";

/// A number as printed.
#[derive(Clone, Debug)]
pub struct Number {
    /// The characters.
    pub text: String,
    /// Their value.
    pub value: Decimal,
}

impl Number {
    /// The number that a text is, if it is a decimal one.
    pub(super) fn parse(text: &str) -> Option<Number> {
        Some(Number {
            text: text.into(),
            value: Decimal::parse(text).ok()?,
        })
    }

    /// A number of a transcription.
    ///
    /// # Panics
    /// If the text is no decimal.
    pub(super) fn read(text: &str) -> Number {
        Number::parse(text).expect("a printed decimal")
    }

    /// `printed − value` in units of the last digit.
    pub(super) fn units_off(&self, value: &Ball) -> f64 {
        self.value.units_off(value).to_f64()
    }

    /// `printed − value`.
    pub(super) fn difference(&self, value: &Ball) -> Ball {
        Ball::rational(value.prec(), &self.value.value) - value
    }

    /// Returns true if the print is certainly the correct rounding.
    pub(super) fn is_rounded(&self, value: &Ball) -> bool {
        self.verdict(value) == EntryVerdict::Agrees
    }

    /// Returns true if the print is certainly within one unit of the last digit.
    pub(super) fn is_within_one(&self, value: &Ball) -> bool {
        self.verdict(value) <= EntryVerdict::Rounding
    }

    /// Returns true if the print is certainly the value with the digits that follow left out.
    pub(super) fn is_cut(&self, value: &Ball) -> bool {
        let [low, high] = self.beyond(value);
        (low.is_positive() || low.is_zero()) && high.is_positive()
    }

    /// Returns true if the print is certainly not the value by a rule of rounding.
    pub(super) fn is_wrong(&self, value: &Ball, rounding: Rounding) -> bool {
        let unit = Ball::rational(value.prec(), &self.value.unit());
        let beyond = |limit: Ball| (self.difference(value).abs() - limit).is_positive();
        match rounding {
            Rounding::Nearest => beyond(unit.shift(-1)),
            Rounding::LastDigit => beyond(unit),
            Rounding::Cut => self.beyond(value).iter().any(Ball::is_negative),
        }
    }

    /// By how much the value's size exceeds the print's, and how much there is left to the next
    /// number of as many digits.
    fn beyond(&self, value: &Ball) -> [Ball; 2] {
        let minus = self.text.starts_with('-');
        let off = self.difference(value);
        let low = if minus { off } else { -&off };
        let unit = Ball::rational(value.prec(), &self.value.unit());
        let high = &unit - &low;
        [low, high]
    }

    /// The verdict without a look for misprints; an undecided one is unexplained.
    pub(super) fn verdict(&self, value: &Ball) -> EntryVerdict {
        match agreement(&self.value, value) {
            Agreement::Agrees => EntryVerdict::Agrees,
            Agreement::LastDigit => EntryVerdict::Rounding,
            Agreement::Differs | Agreement::Undecided | Agreement::NoValue => {
                EntryVerdict::Unexplained
            }
        }
    }

    /// The number of printed digits that are right, and of all: those that the value has
    /// in the same places, or all where the print is the correct rounding.
    pub(super) fn right_digits(&self, value: &Ball) -> (usize, usize) {
        let digits = significant(&self.text);
        let all = digits.len();
        if self.is_rounded(value) {
            return (all, all);
        }
        let size = match value.is_negative() {
            true => -value,
            false => value.clone(),
        };
        let begins = |k: usize| {
            // The first k digits of the print, with zeros for the rest.
            let cut = self
                .text
                .char_indices()
                .map(|(i, c)| if digits[k..].contains(&i) { '0' } else { c });
            let cut: String = cut.collect();
            let Ok(cut) = Decimal::parse(cut.trim_start_matches('-')) else {
                return false;
            };
            let mut unit = self.value.unit();
            for _ in k..all {
                unit *= 10;
            }
            let low = &size - Ball::rational(size.prec(), &cut.value);
            let high = Ball::rational(size.prec(), &(cut.value + unit)) - &size;
            low.is_positive() && high.is_positive()
        };
        let same_sign = value.is_negative() == self.text.starts_with('-');
        let right = (1..=all).take_while(|&k| same_sign && begins(k)).count();
        (right, all)
    }

    /// The printed number with a bar after the last digit that is right.
    pub(super) fn marked(&self, value: &Ball) -> String {
        let digits = significant(&self.text);
        match self.right_digits(value) {
            (right, all) if right == all => self.text.clone(),
            (right, _) => {
                let (a, b) = self.text.split_at(digits[right]);
                format!("{a}|{b}")
            }
        }
    }

    /// The verdict, with the value to `digits` digits.
    pub(super) fn judged(&self, value: &Ball, digits: usize) -> VariantJudgement {
        let (right, all) = self.right_digits(value);
        VariantJudgement {
            recomputed: value
                .to_decimal(digits)
                .unwrap_or_else(|| "undecided".into()),
            units_in_last_digit: (self.units_off(value) * 1e3).round() / 1e3,
            verdict: self.verdict(value),
            note: (right < all)
                .then(|| format!("{right} of {all} digits are right: {}", self.marked(value))),
        }
    }
}

/// The places of significant digits in a printed number.
fn significant(text: &str) -> Vec<usize> {
    let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
    let places = mantissa.char_indices().filter(|(_, c)| c.is_ascii_digit());
    let places = places.skip_while(|(_, c)| *c == '0');
    places.map(|(i, _)| i).collect()
}

/// One digit other than the last replaced or left out, or two neighbours exchanged, such that the
/// result is the correct rounding. (A change of the last digit would explain anything.)
pub(super) fn explained(text: &str, value: &Ball) -> Option<String> {
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

/// A printed number with its place, and the value that is due by each variant of the data, where it
/// is known.
pub(super) struct Row<'a> {
    pub number: u32,
    pub name: &'static str,
    pub printed: &'a Number,
    pub due: Vec<Option<&'a Ball>>,
}

/// A printed column.
pub(super) struct Column<'a> {
    pub table: u32,
    pub name: &'static str,
    pub rows: Vec<Row<'a>>,
}

impl Column<'_> {
    /// Counts how many numbers agree with their values under a variant of the data.
    fn tally(&self, which: usize, variant: &'static str) -> Tally {
        let mut tally = Tally {
            variant,
            table: self.table,
            column: self.name,
            entries: self.rows.len(),
            ..Tally::default()
        };
        let known = self.rows.iter();
        let known = known.filter_map(|row| Some((row.printed, row.due[which]?)));
        for (printed, value) in known {
            let off = printed.units_off(value).abs();
            tally.within_half += usize::from(printed.is_rounded(value));
            tally.within_one += usize::from(printed.is_within_one(value));
            tally.worst_units = tally.worst_units.max(off);
            tally.worst = tally.worst.max(off * printed.value.unit().to_f64());
        }
        tally
    }
}

/// Judges every printed number under every variant, and counts how many agree. The judgement is by
/// the numbers of column, row and variant; true if nearly everything else in the column agrees, so
/// that a misprint stands out.
pub(super) fn entries(
    variants: &[&'static str],
    columns: &[Column],
    judge: impl Fn([usize; 3], bool) -> VariantJudgement,
) -> (Vec<Entry>, Vec<Tally>) {
    let of = |(k, &name): (usize, &&'static str)| {
        let tallies = columns.iter().map(|c| c.tally(k, name));
        tallies.collect::<Vec<_>>()
    };
    let tallies: Vec<Tally> = variants.iter().enumerate().flat_map(of).collect();
    let agrees = |t: &Tally| t.entries - t.within_one <= t.entries / 10;
    let mut all = Vec::new();
    for (c, column) in columns.iter().enumerate() {
        all.extend(column.rows.iter().enumerate().map(|(r, row)| {
            let judged = |(k, name): (usize, &&'static str)| {
                let agrees = agrees(&tallies[k * columns.len() + c]);
                (*name, judge([c, r, k], agrees))
            };
            Entry {
                table: column.table,
                row: row.number,
                column: row.name,
                printed: row.printed.text.clone(),
                variants: variants.iter().enumerate().map(judged).collect(),
            }
        }));
    }
    (all, tallies)
}

/// Judges columns of certified values by their digits alone.
pub(super) fn by_digits(columns: &[Column], digits: usize) -> (Vec<Entry>, Vec<Tally>) {
    entries(&[AS_PRINTED], columns, |[c, r, k], _| {
        let row = &columns[c].rows[r];
        let value = row.due[k].expect("a certified value");
        row.printed.judged(value, digits)
    })
}

/// The records of a published table; lines that begin with `#` are comments.
///
/// # Panics
/// If the text is no table.
pub(super) fn records(text: &str) -> Vec<csv::StringRecord> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let rows = reader
        .records()
        .map(|r| r.expect("a row of a published table"));
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ball(text: &str) -> Ball {
        Ball::rational(200, &Decimal::parse(text).unwrap().value)
    }

    #[test]
    fn digits_are_compared_in_their_places() {
        let check = |text: &str, value: &str| {
            let (p, v) = (Number::read(text), ball(value));
            (p.right_digits(&v), p.marked(&v))
        };
        assert_eq!(check("0.1234e2", "12.34499"), ((4, 4), "0.1234e2".into()));
        // Cut off instead of rounded.
        assert_eq!(check("0.1234e2", "12.3476"), ((4, 4), "0.1234e2".into()));
        assert_eq!(check("0.1234e2", "12.3276"), ((3, 4), "0.123|4e2".into()));
        assert_eq!(check("-0.1234e2", "-12.4"), ((2, 4), "-0.12|34e2".into()));
        assert_eq!(check("-0.05", "0.05"), ((0, 1), "-0.0|5".into()));
        assert_eq!(check("7.000", "6.9990"), ((0, 4), "|7.000".into()));
    }

    /// A ball that reaches beyond the limit decides nothing, though its midpoint fits.
    #[test]
    fn a_value_that_is_not_known_agrees_with_nothing() {
        use crate::reference::Mag;
        let p = Number::read("0.1234");
        let near = ball("0.12340");
        assert!(p.is_rounded(&near.widened(Mag::from_f64(4e-5))));
        assert!(!p.is_rounded(&near.widened(Mag::from_f64(6e-5))));
        assert!(!p.is_rounded(&near.widened(Mag::INFINITY)));
        assert_eq!(p.right_digits(&near.widened(Mag::from_f64(6e-5))).0, 3);
    }

    #[test]
    fn a_number_is_judged_by_its_last_digit() {
        for (value, due, units) in [
            ("12.34499", EntryVerdict::Agrees, -0.499),
            ("12.34501", EntryVerdict::Rounding, -0.501),
            ("12.33001", EntryVerdict::Rounding, 0.999),
            ("12.32999", EntryVerdict::Unexplained, 1.001),
        ] {
            let found = Number::read("12.34").judged(&ball(value), 7);
            assert_eq!(
                (found.verdict, found.units_in_last_digit),
                (due, units),
                "{value}"
            );
        }
        let agrees = Number::read("12.34").judged(&ball("12.34499"), 7);
        assert_eq!(
            (agrees.recomputed.as_str(), agrees.note),
            ("12.34499", None)
        );
        let off = Number::read("12.34").judged(&ball("12.1"), 4).note.unwrap();
        assert_eq!(off, "2 of 4 digits are right: 12.|34");
        let wide = ball("12.34").widened(crate::reference::Mag::from_f64(1.0));
        assert_eq!(
            Number::read("12.34").judged(&wide, 4).recomputed,
            "undecided"
        );
    }

    /// Digits as large as the number's own: 9 and 10 of which the last is not begun with.
    #[test]
    fn the_digits_that_are_right_are_those_before_the_first_wrong_one() {
        for (text, value, due) in [
            ("0.99", "1.01", (0, 2)),
            ("1.00", "0.98", (0, 3)),
            ("105", "109.4", (2, 3)),
            ("100", "109.4", (2, 3)),
            ("-105", "-109.4", (2, 3)),
            ("105", "-109.4", (0, 3)),
            ("5e2", "507", (1, 1)),
            ("5.1e2", "507", (2, 2)),
            ("5.3e2", "507", (1, 2)),
        ] {
            assert_eq!(
                Number::read(text).right_digits(&ball(value)),
                due,
                "{text} {value}"
            );
        }
    }

    #[test]
    fn a_column_is_counted_within_half_a_unit_and_one() {
        let numbers = ["1.00", "2.00", "3.0"].map(Number::read);
        let values = ["1.004", "1.991", "3.13"].map(ball);
        let of = |count: usize| {
            let rows = numbers.iter().zip(&values).take(count);
            let row = |(printed, value)| Row {
                number: 1,
                name: "column",
                printed,
                due: vec![Some(value)],
            };
            let column = Column {
                table: 2,
                name: "column",
                rows: rows.map(row).collect(),
            };
            column.tally(0, "variant")
        };
        let found = of(3);
        assert_eq!(
            (found.entries, found.within_half, found.within_one),
            (3, 1, 2)
        );
        assert!((found.worst_units - 1.3).abs() < 1e-12 && (found.worst - 0.13).abs() < 1e-12);
        let right = of(1);
        assert!((right.worst_units - 0.4).abs() < 1e-12 && (right.worst - 0.004).abs() < 1e-12);
    }
}

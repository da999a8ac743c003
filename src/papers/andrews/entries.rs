//! Every printed value against the certified one, digit by digit.

use super::motion::{DIGITS, Motion, TIMES};
use super::printed::{Printed, QUANTITIES, kind};
use crate::papers::{Entry, EntryVerdict, Tally, VariantJudgement};
use crate::reference::{Ball, Decimal};
use std::collections::BTreeMap;

/// The variant of the data: there is but one.
const VARIANT: &str = "as_printed";
/// Columns of the tallies, by kind of quantity.
const COLUMNS: [&str; 4] = ["angles", "rates", "accelerations", "multipliers"];
/// Printed values of a time: 1 at the start, 2 at the end.
const TABLES: [(u32, &str); 2] = [(1, "0"), (2, TIMES[2])];

/// The certified value of a printed one.
pub(super) fn certified<'a>(motion: &'a Motion, p: &Printed) -> &'a Ball {
    let at = TIMES.iter().position(|t| *t == p.time).map_or(0, |k| k + 1);
    &motion.values[at][p.quantity]
}

/// Certainly within `limit` units of the last digit.
pub(super) fn within(p: &Printed, value: &Ball, limit: f64) -> bool {
    let u = p.value.units_off(value);
    u.is_finite() && u.abs().upper() <= limit
}

/// The places of significant digits in a printed number.
fn significant(text: &str) -> Vec<usize> {
    let mantissa = text.split(['e', 'E']).next().unwrap_or(text);
    let places = mantissa.char_indices().filter(|(_, c)| c.is_ascii_digit());
    let places = places.skip_while(|(_, c)| *c == '0');
    places.map(|(i, _)| i).collect()
}

/// How many of the printed digits are right, and how many there are: those that the value has in the same places, or
/// all where the print is the correct rounding.
pub(super) fn right_digits(p: &Printed, value: &Ball) -> (usize, usize) {
    let digits = significant(&p.text);
    let all = digits.len();
    if within(p, value, 0.5) {
        return (all, all);
    }
    let size = match value.is_negative() {
        true => -value,
        false => value.clone(),
    };
    let begins = |k: usize| {
        // The first k digits of the print, with zeros for the rest.
        let cut = p
            .text
            .char_indices()
            .map(|(i, c)| if digits[k..].contains(&i) { '0' } else { c });
        let cut: String = cut.collect();
        let Ok(cut) = Decimal::parse(cut.trim_start_matches('-')) else {
            return false;
        };
        let mut unit = p.value.unit();
        for _ in k..all {
            unit *= 10;
        }
        let low = &size - Ball::rational(size.prec(), &cut.value);
        let high = Ball::rational(size.prec(), &(cut.value + unit)) - &size;
        low.is_positive() && high.is_positive()
    };
    let same_sign = value.is_negative() == p.text.starts_with('-');
    let right = (1..=all).take_while(|&k| same_sign && begins(k)).count();
    (right, all)
}

/// The printed number with a bar after the last digit that is right.
pub(super) fn marked(p: &Printed, value: &Ball) -> String {
    let digits = significant(&p.text);
    match right_digits(p, value) {
        (right, all) if right == all => p.text.clone(),
        (right, _) => {
            let (a, b) = p.text.split_at(digits[right]);
            format!("{a}|{b}")
        }
    }
}

fn judge(p: &Printed, value: &Ball) -> VariantJudgement {
    let verdict = match () {
        () if within(p, value, 0.5) => EntryVerdict::Agrees,
        () if within(p, value, 1.0) => EntryVerdict::Rounding,
        () => EntryVerdict::Unexplained,
    };
    let (right, all) = right_digits(p, value);
    VariantJudgement {
        recomputed: value
            .to_decimal(DIGITS)
            .unwrap_or_else(|| "undecided".into()),
        units_in_last_digit: (p.value.units_off(value).to_f64() * 1e3).round() / 1e3,
        verdict,
        note: (right < all)
            .then(|| format!("{right} of {all} digits are right: {}", marked(p, value))),
    }
}

/// Judges every printed value.
pub(super) fn entries(printed: &[Printed], motion: &Motion) -> (Vec<Entry>, Vec<Tally>) {
    let mut entries = Vec::new();
    let mut tallies = Vec::new();
    for (table, time) in TABLES {
        for (k, column) in COLUMNS.into_iter().enumerate() {
            let of = printed
                .iter()
                .filter(|p| p.time == time && kind(p.quantity) == k);
            let of: Vec<&Printed> = of.collect();
            let count = |limit: f64| {
                let near = of.iter().filter(|p| within(p, certified(motion, p), limit));
                near.count()
            };
            let worst =
                |off: &dyn Fn(&Printed) -> f64| of.iter().map(|p| off(p).abs()).fold(0.0, f64::max);
            let units = |p: &Printed| p.value.units_off(certified(motion, p)).to_f64();
            if !of.is_empty() {
                tallies.push(Tally {
                    variant: VARIANT,
                    table,
                    column,
                    entries: of.len(),
                    within_half: count(0.5),
                    within_one: count(1.0),
                    worst_units: worst(&units),
                    worst: worst(&|p| units(p) * p.value.unit().to_f64()),
                });
            }
            entries.extend(of.iter().map(|p| Entry {
                table,
                row: p.quantity as u32 + 1,
                column: QUANTITIES[p.quantity],
                printed: p.text.clone(),
                variants: BTreeMap::from([(VARIANT, judge(p, certified(motion, p)))]),
            }));
        }
    }
    (entries, tallies)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn printed(text: &str) -> Printed {
        Printed {
            time: "0".into(),
            quantity: 0,
            text: text.into(),
            value: Decimal::parse(text).unwrap(),
        }
    }

    fn ball(text: &str) -> Ball {
        Ball::rational(200, &Decimal::parse(text).unwrap().value)
    }

    #[test]
    fn digits_are_compared_in_their_places() {
        let check = |text: &str, value: &str| {
            let (p, v) = (printed(text), ball(value));
            (right_digits(&p, &v), marked(&p, &v))
        };
        assert_eq!(check("0.1234e2", "12.34499"), ((4, 4), "0.1234e2".into()));
        // Cut off instead of rounded.
        assert_eq!(check("0.1234e2", "12.3476"), ((4, 4), "0.1234e2".into()));
        assert_eq!(check("0.1234e2", "12.3276"), ((3, 4), "0.123|4e2".into()));
        assert_eq!(check("-0.1234e2", "-12.4"), ((2, 4), "-0.12|34e2".into()));
        assert_eq!(check("-0.05", "0.05"), ((0, 1), "-0.0|5".into()));
        assert_eq!(check("7.000", "6.9990"), ((0, 4), "|7.000".into()));
    }
}

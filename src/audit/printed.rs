//! Printed values, decimals of a few digits, against the reference.

use super::answer::ReferenceAnswer;
use super::expected::Expected;
use super::method::Method;
use super::settings::Settings;
use mechaudit_reference::{Ball, Decimal, DecimalError, nearest_f64};
use rug::Rational;
use serde::Serialize;

/// The verdict on a printed entry. Only [`Agreement::Agrees`] is agreement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// Within half a unit of its last digit.
    Agrees,
    /// Farther than half a unit and within one: the last digit is off by one.
    LastDigit,
    /// Farther than one unit of its last digit.
    Differs,
    /// The reference could not be decided against the entry.
    Undecided,
    /// The reference has no number here.
    NoValue,
}

/// One printed entry judged.
#[derive(Clone, Debug, Serialize)]
pub struct EntryJudgement {
    /// The verdict.
    pub agreement: Agreement,
    /// The distance from the reference in units of the entry's last digit, an upper bound, with the
    /// sign of entry less reference.
    pub units: f64,
    /// The reference to 20 digits, where it certifies them.
    pub reference: Option<String>,
    /// The reason why there is no verdict, if there is none.
    pub reason: Option<String>,
    /// The working precision that decided.
    pub bits: u32,
}

impl EntryJudgement {
    fn none(agreement: Agreement, reason: String) -> EntryJudgement {
        EntryJudgement {
            agreement,
            units: f64::NAN,
            reference: None,
            reason: Some(reason),
            bits: 0,
        }
    }
}

/// An entry that a table prints for a value.
#[derive(Clone, Debug, PartialEq)]
pub enum PrintedNumber {
    /// A decimal number.
    Decimal(Decimal),
    /// `inf` or `-inf`.
    Infinity {
        /// True for −∞.
        negative: bool,
    },
    /// `nan`.
    Nan,
}

/// The unit of printed values: they are those of the method times `by` and a power of 180/π.
#[derive(Clone, Debug, PartialEq)]
pub struct PrintedUnit {
    /// The rational factor.
    pub by: Rational,
    /// The power of 180/π.
    pub degrees: i32,
}

/// A printed value with its unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Printed {
    /// The number.
    pub number: PrintedNumber,
    /// Its unit, if it is not the method's.
    unit: Option<PrintedUnit>,
    /// Digits of the reference to show beside it.
    digits: usize,
}

/// Digits of the reference beside an entry that has fewer.
const DIGITS: usize = 20;

impl Printed {
    /// Reads an entry in the method's unit: a decimal, `inf`, `-inf` or `nan` in letters of any
    /// case.
    ///
    /// # Errors
    /// Anything else.
    pub fn parse(text: &str) -> Result<Printed, DecimalError> {
        let number = match text.trim().to_ascii_lowercase().as_str() {
            "nan" | "+nan" | "-nan" => PrintedNumber::Nan,
            "inf" | "+inf" | "infinity" | "+infinity" => {
                PrintedNumber::Infinity { negative: false }
            }
            "-inf" | "-infinity" => PrintedNumber::Infinity { negative: true },
            _ => PrintedNumber::Decimal(Decimal::parse(text)?),
        };
        let mantissa = text.split(['e', 'E']).next().unwrap_or_default();
        let figures = mantissa.bytes().filter(u8::is_ascii_digit);
        let significant = figures.skip_while(|b| *b == b'0').count();
        Ok(Printed {
            number,
            unit: None,
            // One more than the entry has: its last may be rounded.
            digits: DIGITS.max(significant + 1),
        })
    }

    /// In another unit.
    #[must_use]
    pub fn in_unit(self, unit: Option<PrintedUnit>) -> Printed {
        Printed { unit, ..self }
    }

    /// The nearest number.
    pub fn nearest(&self) -> f64 {
        match &self.number {
            PrintedNumber::Decimal(decimal) => nearest_f64(&decimal.value),
            PrintedNumber::Infinity { negative: false } => f64::INFINITY,
            PrintedNumber::Infinity { negative: true } => f64::NEG_INFINITY,
            PrintedNumber::Nan => f64::NAN,
        }
    }

    /// The number in the method's unit, enclosed with `bits` bits; none where it is no finite
    /// number.
    pub fn value(&self, bits: u32) -> Option<Ball> {
        let PrintedNumber::Decimal(decimal) = &self.number else {
            return None;
        };
        let Some(unit) = &self.unit else {
            return Some(Ball::rational(bits, &decimal.value));
        };
        let mut value = Ball::rational(bits, &Rational::from(&decimal.value / &unit.by));
        let degree = &Ball::pi(bits) / &Ball::integer(bits, 180);
        for _ in 0..unit.degrees.abs() {
            value = match unit.degrees > 0 {
                true => &value * &degree,
                false => &value / &degree,
            };
        }
        Some(value)
    }

    /// Returns true if the entry is the expected one, where no number is expected.
    fn is(&self, expected: &Expected) -> bool {
        match (&self.number, expected) {
            (PrintedNumber::Nan, Expected::NotANumber) => true,
            (PrintedNumber::Infinity { negative }, Expected::Infinity { negative: expected }) => {
                negative == expected
            }
            _ => false,
        }
    }
}

/// Judges printed values at an exact input: entry `(i, printed)` is value `i` of the method.
///
/// The precision doubles until every entry is decided, and the reference has as many digits as the
/// entry.
pub fn judge_printed(
    method: &dyn Method,
    input: &[Rational],
    printed: &[(usize, &Printed)],
    settings: &Settings,
) -> Vec<EntryJudgement> {
    let mut bits = settings.first_bits;
    loop {
        let reference = method.reference(input, bits);
        let judged: Vec<EntryJudgement> = printed
            .iter()
            .map(|(i, printed)| EntryJudgement {
                bits,
                ..entry(&reference, *i, printed)
            })
            .collect();
        let is_open = |(e, (_, printed)): (&EntryJudgement, &(usize, &Printed))| {
            let lacks_digits = e.reference.is_none() && printed.digits > DIGITS;
            e.agreement == Agreement::Undecided || lacks_digits && e.agreement != Agreement::NoValue
        };
        if bits >= settings.last_bits || !judged.iter().zip(printed).any(is_open) {
            return judged;
        }
        bits *= 2;
    }
}

fn entry(reference: &ReferenceAnswer, i: usize, printed: &Printed) -> EntryJudgement {
    let none = |reason: String| EntryJudgement::none(Agreement::NoValue, reason);
    let ball = match reference {
        ReferenceAnswer::Values(r) => r.values.get(i),
        ReferenceAnswer::Expected(expected, _) => match expected.get(i) {
            Some(expected) if expected.number().is_none() => {
                let text = expected.to_decimal(1).unwrap_or_default();
                return match printed.is(expected) {
                    true => EntryJudgement {
                        agreement: Agreement::Agrees,
                        units: 0.0,
                        reference: Some(text),
                        reason: None,
                        bits: 0,
                    },
                    false => none(text),
                };
            }
            expected => expected.and_then(Expected::number),
        },
        ReferenceAnswer::Refuses(why) => return none(format!("the reference refuses: {why}")),
        ReferenceAnswer::Undecided(why) => {
            return EntryJudgement::none(Agreement::Undecided, why.clone());
        }
        ReferenceAnswer::Failed(why) => return none(format!("the reference failed: {why}")),
    };
    match ball {
        Some(ball) => against(ball, printed),
        None => none("the reference has fewer values".into()),
    }
}

fn against(value: &Ball, printed: &Printed) -> EntryJudgement {
    let value = in_unit(value, printed.unit.as_ref());
    let reference = value.ball().to_decimal(printed.digits);
    let PrintedNumber::Decimal(decimal) = &printed.number else {
        // No number is as far off as that.
        return EntryJudgement {
            agreement: Agreement::Differs,
            units: f64::INFINITY,
            reference,
            reason: None,
            bits: 0,
        };
    };
    let agreement = agreement_of(&value, decimal);
    let off = decimal.units_off(value.ball());
    let undecided = agreement == Agreement::Undecided;
    EntryJudgement {
        agreement,
        units: off.magnitude().to_f64().copysign(off.mid().to_f64()),
        reference,
        reason: undecided.then(|| "too near to half a unit of its last digit or to one".into()),
        bits: 0,
    }
}

/// A value in the unit of an entry.
enum InUnit {
    /// An exact value, for ties are decided exactly.
    Exact(Rational, Ball),
    Enclosed(Ball),
}

impl InUnit {
    fn ball(&self) -> &Ball {
        match self {
            InUnit::Exact(_, ball) | InUnit::Enclosed(ball) => ball,
        }
    }
}

fn in_unit(value: &Ball, unit: Option<&PrintedUnit>) -> InUnit {
    let exact = value.mid().to_rational().filter(|_| value.rad().is_zero());
    let bits = value.prec();
    let Some(unit) = unit else {
        return match exact {
            Some(exact) => InUnit::Exact(exact, value.clone()),
            None => InUnit::Enclosed(value.clone()),
        };
    };
    if let Some(exact) = exact.filter(|x| unit.degrees == 0 || *x == 0) {
        let scaled = exact * &unit.by;
        let ball = Ball::rational(bits, &scaled);
        return InUnit::Exact(scaled, ball);
    }
    let mut scaled = value * Ball::rational(bits, &unit.by);
    let degrees = &Ball::integer(bits, 180) / &Ball::pi(bits);
    for _ in 0..unit.degrees.abs() {
        scaled = match unit.degrees > 0 {
            true => &scaled * &degrees,
            false => &scaled / &degrees,
        };
    }
    InUnit::Enclosed(scaled)
}

/// Judges a printed decimal against an enclosure of its value, in exact arithmetic.
pub fn agreement(printed: &Decimal, value: &Ball) -> Agreement {
    agreement_of(&in_unit(value, None), printed)
}

/// In exact arithmetic: a tie is one only against an exact reference.
fn agreement_of(value: &InUnit, printed: &Decimal) -> Agreement {
    let (mid, radius) = match value {
        InUnit::Exact(value, _) => (value.clone(), Rational::new()),
        InUnit::Enclosed(ball) => {
            let radius = ball.rad().to_float().to_rational();
            let (Some(mid), Some(radius)) = (ball.mid().to_rational(), radius) else {
                return Agreement::Undecided;
            };
            (mid, radius)
        }
    };
    let gap = Rational::from(&printed.value - &mid).abs();
    let (least, most) = (Rational::from(&gap - &radius), gap + radius);
    let unit = printed.unit();
    let half = unit.clone() / 2;
    match () {
        () if most <= half => Agreement::Agrees,
        () if least > unit => Agreement::Differs,
        () if least > half && most <= unit => Agreement::LastDigit,
        () => Agreement::Undecided,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planted::Planted;
    use mechaudit_reference::Mag;
    use std::sync::Mutex;

    #[test]
    fn entries_of_a_third() {
        let third = Ball::rational(128, &Rational::from((1, 3)));
        for (text, expected) in [
            ("0.3333", Agreement::Agrees),
            ("0.33330", Agreement::Differs),
            ("0.3334", Agreement::LastDigit),
            ("0.3336", Agreement::Differs),
            ("-0.3333", Agreement::Differs),
            ("0", Agreement::Agrees),
            ("1e0", Agreement::LastDigit),
            ("0e1", Agreement::Agrees),
        ] {
            let e = against(&third, &printed(text));
            assert_eq!(e.agreement, expected, "{text}: {}", e.units);
        }
    }

    #[test]
    fn a_tie_agrees_where_the_reference_is_exact_and_is_open_otherwise() {
        let exact = Ball::exact(128, 0.125);
        assert_eq!(
            against(&exact, &printed("0.12")).agreement,
            Agreement::Agrees
        );
        assert_eq!(
            against(&exact, &printed("0.13")).agreement,
            Agreement::Agrees
        );
        let wide = exact.widened(mechaudit_reference::Mag::power_of_two(-60));
        let open = against(&wide, &printed("0.12"));
        assert_eq!(open.agreement, Agreement::Undecided);
        assert!(open.reason.is_some());
    }

    fn printed(text: &str) -> Printed {
        Printed::parse(text).unwrap()
    }

    /// NaN and infinities agree with themselves where they are due, and with no number.
    #[test]
    fn what_is_no_number_is_an_entry() {
        let number = Ball::exact(128, 1.5);
        for text in ["nan", "NaN", "inf", "-Infinity"] {
            let e = against(&number, &printed(text));
            assert_eq!((e.agreement, e.units), (Agreement::Differs, f64::INFINITY));
            assert_eq!(e.reference.as_deref(), Some("1.5000000000000000000"));
        }
        let expected = ReferenceAnswer::Expected(
            vec![Expected::NotANumber, Expected::Infinity { negative: true }],
            crate::Proof::Exact,
        );
        for (i, text, agreement) in [
            (0, "NaN", Agreement::Agrees),
            (0, "inf", Agreement::NoValue),
            (1, "-inf", Agreement::Agrees),
            (1, "inf", Agreement::NoValue),
            (1, "nan", Agreement::NoValue),
        ] {
            let found = entry(&expected, i, &printed(text));
            assert_eq!(found.agreement, agreement, "{i} {text}");
        }
        let nearest = ["nan", "inf", "-inf", "0.5"].map(|t| printed(t).nearest().to_string());
        assert_eq!(nearest, ["NaN", "inf", "-inf", "0.5"]);
        assert!(Printed::parse("none").is_err());
    }

    /// A reference of thirds beside 45 digits, which 128 bits do not give.
    #[test]
    fn the_reference_has_as_many_digits_as_the_entry() {
        let method = Planted {
            reference: Box::new(|_, bits| {
                ReferenceAnswer::bounded(vec![Ball::integer(bits, 3).recip()], "planted")
            }),
            ..Planted::default()
        };
        for (digits, expected) in [(5, 20), (20, 21), (45, 46), (79, 80)] {
            let one = printed(&format!("0.{}", "3".repeat(digits)));
            let found = judge_printed(&method, &[], &[(0, &one)], &Settings::default());
            assert_eq!(found[0].agreement, Agreement::Agrees);
            let shown = found[0].reference.as_deref().unwrap();
            assert_eq!(shown, format!("0.{}", "3".repeat(expected)));
        }
    }

    /// Millimetres of an exact number of metres are exact, ties too; degrees are enclosed.
    #[test]
    fn entries_may_be_in_other_units() {
        let of = |text: &str, by: i32, degrees: i32| {
            let by = by.into();
            printed(text).in_unit(Some(PrintedUnit { by, degrees }))
        };
        let metres = Ball::exact(128, 0.0625);
        for (text, expected) in [
            ("62.5", Agreement::Agrees),
            ("62", Agreement::Agrees),
            ("63", Agreement::Agrees),
            ("62.4", Agreement::LastDigit),
            ("0.0625", Agreement::Differs),
        ] {
            assert_eq!(
                against(&metres, &of(text, 1000, 0)).agreement,
                expected,
                "{text}"
            );
        }
        let right = Ball::pi(128).shift(-1);
        let degrees = against(&right, &of("90.000000", 1, 1));
        assert_eq!(degrees.agreement, Agreement::Agrees);
        assert_eq!(degrees.reference.as_deref(), Some("90.000000000000000000"));
        let speed = against(&Ball::exact(128, 90.0), &of("1.5708", 1, -1));
        assert_eq!(speed.agreement, Agreement::Agrees);
        // Zero degrees are zero radians.
        let zero = against(&Ball::integer(128, 0), &of("0.5", 1, 1));
        assert_eq!(zero.agreement, Agreement::Differs);
        assert_eq!(zero.reference.as_deref(), Some("0"));
    }

    #[test]
    fn verdicts_change_at_half_a_unit_and_at_one() {
        let at = |value: f64, radius: f64| {
            let ball = Ball::exact(128, value).widened(Mag::from_f64(radius));
            against(&ball, &printed("1")).agreement
        };
        assert_eq!(at(1.5, 0.0), Agreement::Agrees);
        assert_eq!(at(1.5f64.next_up(), 0.0), Agreement::LastDigit);
        assert_eq!(at(2.0, 0.0), Agreement::LastDigit);
        assert_eq!(at(0.0, 0.0), Agreement::LastDigit);
        assert_eq!(at(2.0f64.next_up(), 0.0), Agreement::Differs);
        // Balls that touch a border.
        assert_eq!(at(1.25, 0.25), Agreement::Agrees);
        assert_eq!(at(1.625, 0.125), Agreement::Undecided);
        assert_eq!(at(1.75, 0.125), Agreement::LastDigit);
        assert_eq!(at(1.875, 0.125), Agreement::LastDigit);
        assert_eq!(at(2.125, 0.125), Agreement::Undecided);
        assert_eq!(at(2.25, 0.125), Agreement::Differs);
        assert_eq!(at(1.0, f64::INFINITY), Agreement::Undecided);
    }

    /// Units are bounds with the sign of entry less reference; the reference has 20 digits.
    #[test]
    fn an_entry_has_units_and_digits() {
        let e = against(
            &Ball::rational(200, &Rational::from((1, 3))),
            &printed("0.34"),
        );
        assert!((e.units - 2.0 / 3.0).abs() < 1e-12 && e.reason.is_none());
        assert_eq!(e.reference.as_deref(), Some("0.33333333333333333333"));
        let wide = Ball::exact(128, 1.75).widened(Mag::from_f64(0.125));
        let e = against(&wide, &printed("1"));
        assert!((e.units + 0.875).abs() < 1e-9, "{}", e.units);
    }

    /// Every entry is judged at the precision that decides all of them, up to the last.
    #[test]
    fn the_precision_grows_until_every_entry_is_decided() {
        let asked = Mutex::new(Vec::new());
        let method = Planted {
            reference: Box::new(|x, bits| {
                asked.lock().unwrap().push(bits);
                match bits {
                    0..256 => ReferenceAnswer::Undecided("not yet".into()),
                    _ => ReferenceAnswer::exact([&x[0], &(x[0].clone() / 3)], bits),
                }
            }),
            ..Planted::default()
        };
        let judged = |first_bits, last_bits, entries: &[(usize, &str)]| {
            asked.lock().unwrap().clear();
            let settings = Settings {
                first_bits,
                last_bits,
                ..Settings::default()
            };
            let parsed: Vec<_> = entries.iter().map(|(i, t)| (*i, printed(t))).collect();
            let parsed: Vec<_> = parsed.iter().map(|(i, d)| (*i, d)).collect();
            let found = judge_printed(&method, &[Rational::from(1)], &parsed, &settings);
            let each = found.iter().map(|e| (e.agreement, e.bits)).collect();
            (each, asked.lock().unwrap().clone())
        };
        let both = [(0, "1.00"), (1, "0.34")];
        let (found, bits): (Vec<_>, Vec<u32>) = judged(64, 1024, &both);
        assert_eq!(
            found,
            [(Agreement::Agrees, 256), (Agreement::LastDigit, 256)]
        );
        assert_eq!(bits, [64, 128, 256]);
        let (found, bits): (Vec<_>, _) = judged(64, 128, &both);
        assert_eq!(found, [(Agreement::Undecided, 128); 2]);
        assert_eq!(bits, [64, 128]);
        assert_eq!(judged(256, 512, &both).1, [256]);
    }

    /// One entry that cannot be decided asks for more bits, whatever the others are.
    #[test]
    fn one_open_entry_asks_for_more() {
        let asked = Mutex::new(Vec::new());
        let method = Planted {
            reference: Box::new(|_, bits| {
                asked.lock().unwrap().push(bits);
                let open = Ball::exact(64, 1.5).widened(Mag::from_f64(0.125));
                ReferenceAnswer::bounded(vec![Ball::integer(64, 1), open], "planted")
            }),
            ..Planted::default()
        };
        let settings = Settings {
            first_bits: 100,
            last_bits: 400,
            ..Settings::default()
        };
        let one = printed("1");
        let found = judge_printed(&method, &[], &[(0, &one), (1, &one)], &settings);
        let each: Vec<_> = found.iter().map(|e| (e.agreement, e.bits)).collect();
        assert_eq!(
            each,
            [(Agreement::Agrees, 400), (Agreement::Undecided, 400)]
        );
        assert_eq!(*asked.lock().unwrap(), [100, 200, 400]);
    }

    /// A zero is a number whatever its sign; an infinity, NaN, a refusal and a value that is not
    /// there are none.
    #[test]
    fn what_has_no_number_agrees_with_nothing() {
        let expected = ReferenceAnswer::Expected(
            vec![
                Expected::Number(Ball::integer(64, 2)),
                Expected::zero(true),
                Expected::Infinity { negative: true },
            ],
            crate::Proof::Exact,
        );
        let judged = |reference: &ReferenceAnswer, i: usize, text: &str| {
            let e = entry(reference, i, &printed(text));
            (e.agreement, e.reason.unwrap_or_default())
        };
        let agrees = (Agreement::Agrees, String::new());
        let none = |why: &str| (Agreement::NoValue, why.to_string());
        assert_eq!(judged(&expected, 0, "2.0"), agrees);
        assert_eq!(judged(&expected, 1, "0.00"), agrees);
        assert_eq!(judged(&expected, 1, "0.02").0, Agreement::Differs);
        assert_eq!(judged(&expected, 2, "0"), none("-inf"));
        let missing = none("the reference has fewer values");
        assert_eq!(judged(&expected, 3, "0"), missing);
        let values = ReferenceAnswer::exact([&Rational::from(2)], 64);
        assert_eq!(judged(&values, 0, "2"), agrees);
        assert_eq!(judged(&values, 1, "2"), missing);
        let why = || "planted".to_string();
        let refuses = ReferenceAnswer::Refuses("planted");
        assert_eq!(
            judged(&refuses, 0, "2"),
            none("the reference refuses: planted")
        );
        let failed = ReferenceAnswer::Failed(why());
        assert_eq!(
            judged(&failed, 0, "2"),
            none("the reference failed: planted")
        );
        let open = judged(&ReferenceAnswer::Undecided(why()), 0, "2");
        assert_eq!(open, (Agreement::Undecided, why()));
    }
}

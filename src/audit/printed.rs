//! Printed values, decimals of a few digits, against the reference.

use super::answer::ReferenceAnswer;
use super::due::Due;
use super::method::Method;
use super::settings::Settings;
use mechaudit_reference::{Ball, Decimal};
use rug::Rational;
use serde::Serialize;

/// What a printed entry is worth. Only [`Agreement::Agrees`] is agreement.
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
    /// Why there is no verdict, if there is none.
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

/// Judges printed values at an exact input: entry `(i, decimal)` is value `i` of the method.
///
/// The precision doubles until every entry is decided.
pub fn judge_printed(
    method: &dyn Method,
    input: &[Rational],
    printed: &[(usize, &Decimal)],
    settings: &Settings,
) -> Vec<EntryJudgement> {
    let mut bits = settings.first_bits;
    loop {
        let reference = method.reference(input, bits);
        let judged: Vec<EntryJudgement> = printed
            .iter()
            .map(|(i, decimal)| EntryJudgement {
                bits,
                ..entry(&reference, *i, decimal)
            })
            .collect();
        let open = |e: &EntryJudgement| e.agreement == Agreement::Undecided;
        if bits >= settings.last_bits || !judged.iter().any(open) {
            return judged;
        }
        bits *= 2;
    }
}

fn entry(reference: &ReferenceAnswer, i: usize, printed: &Decimal) -> EntryJudgement {
    let none = |reason: String| EntryJudgement::none(Agreement::NoValue, reason);
    let ball = match reference {
        ReferenceAnswer::Values(r) => r.values.get(i),
        ReferenceAnswer::Dues(dues, _) => match dues.get(i) {
            Some(due) if due.number().is_none() => {
                return none(due.to_decimal(1).unwrap_or_default());
            }
            due => due.and_then(Due::number),
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

fn against(value: &Ball, printed: &Decimal) -> EntryJudgement {
    let agreement = agreement(value, printed);
    let off = printed.units_off(value);
    let undecided = agreement == Agreement::Undecided;
    EntryJudgement {
        agreement,
        units: off.magnitude().to_f64().copysign(off.mid().to_f64()),
        reference: value.to_decimal(20),
        reason: undecided.then(|| "too near to half a unit of its last digit or to one".into()),
        bits: 0,
    }
}

/// In exact arithmetic: a tie is one only against an exact reference.
fn agreement(value: &Ball, printed: &Decimal) -> Agreement {
    let radius = value.rad().to_float().to_rational();
    let (Some(mid), Some(radius)) = (value.mid().to_rational(), radius) else {
        return Agreement::Undecided;
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
        for (text, due) in [
            ("0.3333", Agreement::Agrees),
            ("0.33330", Agreement::Differs),
            ("0.3334", Agreement::LastDigit),
            ("0.3336", Agreement::Differs),
            ("-0.3333", Agreement::Differs),
            ("0", Agreement::Agrees),
            ("1e0", Agreement::LastDigit),
            ("0e1", Agreement::Agrees),
        ] {
            let e = against(&third, &Decimal::parse(text).unwrap());
            assert_eq!(e.agreement, due, "{text}: {}", e.units);
        }
    }

    #[test]
    fn a_tie_agrees_where_the_reference_is_exact_and_is_open_otherwise() {
        let exact = Ball::exact(128, 0.125);
        let printed = |t| Decimal::parse(t).unwrap();
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

    fn printed(text: &str) -> Decimal {
        Decimal::parse(text).unwrap()
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

    /// A zero is a number whatever its sign; an infinity, NaN, a refusal and a value that is not there are none.
    #[test]
    fn what_has_no_number_agrees_with_nothing() {
        let dues = ReferenceAnswer::Dues(
            vec![
                Due::Number(Ball::integer(64, 2)),
                Due::zero(true),
                Due::Infinity { negative: true },
            ],
            crate::Proof::Exact,
        );
        let judged = |reference: &ReferenceAnswer, i: usize, text: &str| {
            let e = entry(reference, i, &printed(text));
            (e.agreement, e.reason.unwrap_or_default())
        };
        let agrees = (Agreement::Agrees, String::new());
        let none = |why: &str| (Agreement::NoValue, why.to_string());
        assert_eq!(judged(&dues, 0, "2.0"), agrees);
        assert_eq!(judged(&dues, 1, "0.00"), agrees);
        assert_eq!(judged(&dues, 1, "0.02").0, Agreement::Differs);
        assert_eq!(judged(&dues, 2, "0"), none("-inf"));
        let missing = none("the reference has fewer values");
        assert_eq!(judged(&dues, 3, "0"), missing);
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

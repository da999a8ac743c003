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
            Some(Due::Number(ball)) => Some(ball),
            Some(other) => return none(other.to_decimal(1).unwrap_or_default()),
            None => None,
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
}

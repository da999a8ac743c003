//! What is due for one value: a number, a zero with its sign, an infinity, or NaN.

use super::ulp::{Format, distance};
use mechaudit_reference::{Ball, Mag};

/// What is due for one value.
#[derive(Clone, Debug)]
pub enum Due {
    /// The number in the ball. From half a unit beyond the largest `f64` on, the infinity of its
    /// sign is the exact answer, and a number so small that zero is within the budget may be zero.
    Number(Ball),
    /// Zero with the sign that the function's limit gives it: the other zero is as wrong as an
    /// infinity of the wrong sign.
    Zero {
        /// The number zero.
        ball: Ball,
        /// Whether it is −0.
        negative: bool,
    },
    /// This infinity: the number is larger than any ball holds, or the value really is infinite.
    Infinity {
        /// True for −∞.
        negative: bool,
    },
    /// NaN: there is no value.
    NotANumber,
}

impl Due {
    /// Zero with a sign.
    pub fn zero(negative: bool) -> Due {
        Due::Zero {
            ball: Ball::integer(64, 0),
            negative,
        }
    }

    /// The number, if one is due.
    pub fn number(&self) -> Option<&Ball> {
        match self {
            Due::Number(ball) | Due::Zero { ball, .. } => Some(ball),
            _ => None,
        }
    }

    /// The number itself, if one is due.
    pub(super) fn into_number(self) -> Option<Ball> {
        match self {
            Due::Number(ball) | Due::Zero { ball, .. } => Some(ball),
            _ => None,
        }
    }

    /// The nearest number, with the sign of a zero that has one, an infinity or NaN.
    pub(super) fn nearest(&self) -> f64 {
        match self {
            Due::Number(ball) => ball.to_f64(),
            Due::Zero { negative, .. } => 0f64.copysign(if *negative { -1.0 } else { 1.0 }),
            Due::Infinity { negative: false } => f64::INFINITY,
            Due::Infinity { negative: true } => f64::NEG_INFINITY,
            Due::NotANumber => f64::NAN,
        }
    }

    /// Whether `got` is a zero, and not the one that is due.
    pub(super) fn wrong_zero(&self, got: f64) -> bool {
        matches!(self, Due::Zero { negative, .. } if got == 0.0 && got.is_sign_negative() != *negative)
    }

    /// This value with the sign of its limit, if it is exactly zero and has one.
    pub(super) fn signed(self, negative: Option<bool>) -> Due {
        match (self, negative) {
            (Due::Number(ball), Some(negative)) if ball.mid().is_zero() && ball.rad().is_zero() => {
                Due::Zero { ball, negative }
            }
            (due, _) => due,
        }
    }

    /// For people: certified decimals, `0` or `-0` where zero has a sign, `inf`, `-inf` or `nan`.
    pub fn to_decimal(&self, digits: usize) -> Option<String> {
        match self {
            Due::Number(ball) => ball.to_decimal(digits),
            Due::Zero { negative, .. } => Some(if *negative { "-0" } else { "0" }.into()),
            Due::Infinity { negative: false } => Some("inf".into()),
            Due::Infinity { negative: true } => Some("-inf".into()),
            Due::NotANumber => Some("nan".into()),
        }
    }

    /// Bounds on the error of `got`, as [`distance`]; zero or infinite where no number is due.
    pub(super) fn distance(&self, got: f64, format: Format) -> (Mag, Mag) {
        let right = match self {
            Due::Number(ball) | Due::Zero { ball, .. } => return distance(got, ball, format),
            Due::Infinity { negative } => got.is_infinite() && got.is_sign_negative() == *negative,
            Due::NotANumber => got.is_nan(),
        };
        let error = if right { Mag::ZERO } else { Mag::INFINITY };
        (error, error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Proof, ReferenceAnswer, Uncertified};

    fn number(n: i64) -> Due {
        Due::Number(Ball::integer(64, n))
    }

    #[test]
    fn dues_are_written_with_their_signs() {
        for (due, text) in [
            (number(3), "3.0000"),
            (Due::zero(false), "0"),
            (Due::zero(true), "-0"),
            (Due::Infinity { negative: false }, "inf"),
            (Due::Infinity { negative: true }, "-inf"),
            (Due::NotANumber, "nan"),
        ] {
            assert_eq!(due.to_decimal(5).as_deref(), Some(text));
        }
    }

    #[test]
    fn zeros_have_a_precision() {
        assert!(
            [true, false]
                .map(Due::zero)
                .iter()
                .all(|z| z.number().unwrap().prec() == 64)
        );
    }

    /// Numbers and zeros are certified, infinities and NaN are none.
    #[test]
    fn dues_that_are_numbers_are_certified() {
        let certified = |dues| ReferenceAnswer::Dues(dues, Proof::Exact).certified();
        let balls = certified(vec![number(3), Due::zero(true)]).unwrap();
        let values: Vec<f64> = balls.iter().map(|b| b.mid().to_f64()).collect();
        assert_eq!(values, [3.0, 0.0]);
        assert!(balls.iter().all(|b| b.rad().is_zero()));
        for none in [Due::Infinity { negative: false }, Due::NotANumber] {
            let found = certified(vec![number(3), none]);
            assert_eq!(found.map(|b| b.len()), Err(Uncertified::NoNumber));
        }
    }
}

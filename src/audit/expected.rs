//! The expected result for one value: a number, a zero with its sign, an infinity, or NaN.

use super::ulp::{Format, distance};
use mechaudit_reference::{Ball, Mag};

/// The expected result for one value.
#[derive(Clone, Debug)]
pub enum Expected {
    /// The number in the ball. From half a unit beyond the largest `f64` on, the infinity of its
    /// sign is the exact answer, and a number so small that zero is within the budget may be zero.
    Number(Ball),
    /// Zero with the sign that the function's limit gives it: the other zero is as wrong as an
    /// infinity of the wrong sign.
    Zero {
        /// The number zero.
        ball: Ball,
        /// True for −0.
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

impl Expected {
    /// Creates a zero with a sign.
    pub fn zero(negative: bool) -> Expected {
        Expected::Zero {
            ball: Ball::integer(64, 0),
            negative,
        }
    }

    /// Returns the number, if a number is expected.
    pub fn number(&self) -> Option<&Ball> {
        match self {
            Expected::Number(ball) | Expected::Zero { ball, .. } => Some(ball),
            _ => None,
        }
    }

    /// Converts into the number, if a number is expected.
    pub(super) fn into_number(self) -> Option<Ball> {
        match self {
            Expected::Number(ball) | Expected::Zero { ball, .. } => Some(ball),
            _ => None,
        }
    }

    /// Returns the nearest number, with the sign of a zero that has one, an infinity or NaN.
    pub(super) fn nearest(&self) -> f64 {
        match self {
            Expected::Number(ball) => ball.to_f64(),
            Expected::Zero { negative, .. } => 0f64.copysign(if *negative { -1.0 } else { 1.0 }),
            Expected::Infinity { negative: false } => f64::INFINITY,
            Expected::Infinity { negative: true } => f64::NEG_INFINITY,
            Expected::NotANumber => f64::NAN,
        }
    }

    /// Returns true if `got` is a zero of the wrong sign.
    pub(super) fn wrong_zero(&self, got: f64) -> bool {
        matches!(self, Expected::Zero { negative, .. } if got == 0.0 && got.is_sign_negative() != *negative)
    }

    /// Returns this value with the sign of its limit, if it is exactly zero and has one.
    pub(super) fn signed(self, negative: Option<bool>) -> Expected {
        match (self, negative) {
            (Expected::Number(ball), Some(negative))
                if ball.mid().is_zero() && ball.rad().is_zero() =>
            {
                Expected::Zero { ball, negative }
            }
            (expected, _) => expected,
        }
    }

    /// Formats the value: certified decimals, `0` or `-0` where zero has a sign, `inf`, `-inf` or
    /// `nan`.
    pub fn to_decimal(&self, digits: usize) -> Option<String> {
        match self {
            Expected::Number(ball) => ball.to_decimal(digits),
            Expected::Zero { negative, .. } => Some(if *negative { "-0" } else { "0" }.into()),
            Expected::Infinity { negative: false } => Some("inf".into()),
            Expected::Infinity { negative: true } => Some("-inf".into()),
            Expected::NotANumber => Some("nan".into()),
        }
    }

    /// Returns bounds on the error of `got`, as [`distance`] does; zero or infinity where no number
    /// is expected.
    pub(super) fn distance(&self, got: f64, format: Format) -> (Mag, Mag) {
        let right = match self {
            Expected::Number(ball) | Expected::Zero { ball, .. } => {
                return distance(got, ball, format);
            }
            Expected::Infinity { negative } => {
                got.is_infinite() && got.is_sign_negative() == *negative
            }
            Expected::NotANumber => got.is_nan(),
        };
        let error = if right { Mag::ZERO } else { Mag::INFINITY };
        (error, error)
    }
}

/// The values of a reference, where they are.
#[derive(Clone, Copy)]
pub(super) enum Values<'a> {
    Numbers(&'a [Ball]),
    Expected(&'a [Expected]),
}

impl<'a> Values<'a> {
    pub(super) fn len(self) -> usize {
        match self {
            Values::Numbers(balls) => balls.len(),
            Values::Expected(all) => all.len(),
        }
    }

    pub(super) fn get(self, i: usize) -> Due<'a> {
        match self {
            Values::Numbers(balls) => Due::Number(&balls[i]),
            Values::Expected(all) => Due::Expected(&all[i]),
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = Due<'a>> {
        (0..self.len()).map(move |i| self.get(i))
    }
}

/// One of them.
#[derive(Clone, Copy)]
pub(super) enum Due<'a> {
    Number(&'a Ball),
    Expected(&'a Expected),
}

impl<'a> Due<'a> {
    /// [`Expected::number`]
    pub(super) fn number(self) -> Option<&'a Ball> {
        match self {
            Due::Number(ball) => Some(ball),
            Due::Expected(expected) => expected.number(),
        }
    }

    /// [`Expected::nearest`]
    pub(super) fn nearest(self) -> f64 {
        match self {
            Due::Number(ball) => ball.to_f64(),
            Due::Expected(expected) => expected.nearest(),
        }
    }

    /// [`Expected::wrong_zero`]
    pub(super) fn wrong_zero(self, got: f64) -> bool {
        matches!(self, Due::Expected(expected) if expected.wrong_zero(got))
    }

    /// [`Expected::distance`]
    pub(super) fn distance(self, got: f64, format: Format) -> (Mag, Mag) {
        match self {
            Due::Number(ball) => distance(got, ball, format),
            Due::Expected(expected) => expected.distance(got, format),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Proof, ReferenceAnswer, Uncertified};

    fn number(n: i64) -> Expected {
        Expected::Number(Ball::integer(64, n))
    }

    #[test]
    fn expected_values_are_written_with_their_signs() {
        for (expected, text) in [
            (number(3), "3.0000"),
            (Expected::zero(false), "0"),
            (Expected::zero(true), "-0"),
            (Expected::Infinity { negative: false }, "inf"),
            (Expected::Infinity { negative: true }, "-inf"),
            (Expected::NotANumber, "nan"),
        ] {
            assert_eq!(expected.to_decimal(5).as_deref(), Some(text));
        }
    }

    #[test]
    fn zeros_have_a_precision() {
        assert!(
            [true, false]
                .map(Expected::zero)
                .iter()
                .all(|z| z.number().unwrap().prec() == 64)
        );
    }

    /// Numbers and zeros are certified, infinities and NaN are none.
    #[test]
    fn expected_numbers_are_certified() {
        let certified = |expected| ReferenceAnswer::Expected(expected, Proof::Exact).certified();
        let balls = certified(vec![number(3), Expected::zero(true)]).unwrap();
        let values: Vec<f64> = balls.iter().map(|b| b.mid().to_f64()).collect();
        assert_eq!(values, [3.0, 0.0]);
        assert!(balls.iter().all(|b| b.rad().is_zero()));
        for none in [Expected::Infinity { negative: false }, Expected::NotANumber] {
            let found = certified(vec![number(3), none]);
            assert_eq!(found.map(|b| b.len()), Err(Uncertified::NoNumber));
        }
    }
}

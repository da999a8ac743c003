//! Numbers beyond the exponents of MPFR: a sign and a lower bound on the magnitude.
//!
//! They come from overflow, `e^{10^300}`, and lead back to numbers by division or by functions with
//! limits: `1/(1 + e^{10^300})` is a ball around zero.

use super::ball::{Value, wrap};
use super::real::unary;
use crate::Func;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::{Ball, Mag};
use std::cmp::Ordering;

/// The smallest exponent of a huge number.
pub(super) const LEAST: i64 = 1 << 20;

/// The exponent of a number that overflows: see [`NoValue::Overflow`].
const OVERFLOW: i64 = (1 << 30) - 2;

/// The exponent from which on a number has more than 323 million digits: a little below that of one
/// that overflows, of which a sum may take a bit.
pub(super) const ENDLESS: i64 = OVERFLOW - (1 << 10);

/// The exponent of infinity itself, above all that numbers may have.
const INFINITE: i64 = 1 << 61;

/// The answer where the lower bound does not decide.
pub(super) const UNDECIDED: NoValue = NoValue::Undecided("a number beyond 2^(2^30)");

type Found = Result<Value, NoValue>;

/// A number beyond the exponents of MPFR.
pub(super) fn overflow(negative: bool) -> Value {
    Value::Huge {
        negative,
        exponent: OVERFLOW,
    }
}

/// Infinity, with which numbers are compared.
pub(super) fn infinity() -> Value {
    Value::Huge {
        negative: false,
        exponent: INFINITE,
    }
}

fn huge(negative: bool, exponent: i64) -> Found {
    match exponent >= LEAST {
        // A cap keeps sums of exponents within 64 bits.
        true => Ok(Value::Huge {
            negative,
            exponent: exponent.min(1 << 60),
        }),
        false => Err(UNDECIDED),
    }
}

/// `x ± 2^exponent`.
fn near(x: i64, exponent: i64, p: u32) -> Found {
    let ball = Ball::integer(p, x).widened(Mag::power_of_two(exponent));
    Ok(Value::Real(ball))
}

/// The exponent of a power of two that is not below the magnitude of a finite ball.
fn above(x: &Ball) -> Option<i64> {
    let size = x.magnitude();
    if size.is_zero() {
        return Some(-OVERFLOW);
    }
    Some(size.exponent()? + 1)
}

/// The exponent of a power of two that is not above the magnitude of a ball off zero.
fn below(x: &Ball) -> Option<i64> {
    let size = x.mignitude();
    (!size.is_zero())
        .then(|| size.exponent())
        .flatten()
        .map(|e| e - 1)
}

/// The signs and exponents of two huge numbers: true for one below zero.
fn both(a: &Value, b: &Value) -> Option<[(bool, i64); 2]> {
    let of = |x: &Value| match x {
        Value::Huge { negative, exponent } => Some((*negative, *exponent)),
        _ => None,
    };
    Some([of(a)?, of(b)?])
}

/// `a + b`, one of which is huge.
pub(super) fn add(a: &Value, b: &Value) -> Found {
    if let Some([(x, e), (y, f)]) = both(a, b) {
        return if x == y {
            huge(x, e.max(f))
        } else {
            Err(UNDECIDED)
        };
    }
    match (a, b) {
        (Value::Huge { negative, exponent }, Value::Real(x))
        | (Value::Real(x), Value::Huge { negative, exponent })
            if above(x).is_some_and(|size| size < *exponent) =>
        {
            huge(*negative, exponent - 1)
        }
        _ => Err(UNDECIDED),
    }
}

/// The order of two numbers, one of which is huge.
pub(super) fn order(a: &Value, b: &Value) -> Option<Ordering> {
    let above_it = |negative: bool| match negative {
        true => Ordering::Less,
        false => Ordering::Greater,
    };
    if let Some([(x, e), (y, f)]) = both(a, b) {
        return match (e == INFINITE, f == INFINITE) {
            (false, true) => Some(above_it(!y)),
            (true, false) => Some(above_it(x)),
            _ => (x != y).then(|| above_it(x)),
        };
    }
    match (a, b) {
        (Value::Huge { negative, exponent }, x) => {
            let x = match x {
                Value::Continued(z) => &z.re,
                x => x.real()?,
            };
            let is_beyond =
                is_negative(x) == Some(!negative) || above(x).is_some_and(|size| size < *exponent);
            is_beyond.then(|| above_it(*negative))
        }
        _ => order(b, a).map(Ordering::reverse),
    }
}

fn is_negative(x: &Ball) -> Option<bool> {
    match (x.is_negative(), x.is_positive()) {
        (true, _) => Some(true),
        (_, true) => Some(false),
        _ => None,
    }
}

/// `a b`, one of which is huge.
pub(super) fn mul(a: &Value, b: &Value) -> Found {
    if let Some([(x, e), (y, f)]) = both(a, b) {
        return huge(x != y, e + f);
    }
    match (a, b) {
        (Value::Huge { exponent, .. }, Value::Real(x))
        | (Value::Real(x), Value::Huge { exponent, .. })
            if x.is_zero() =>
        {
            match *exponent {
                INFINITE => Err(NoValue::Undefined("zero times infinity")),
                _ => Ok(Value::Real(x.clone())),
            }
        }
        (Value::Huge { negative, exponent }, Value::Real(x))
        | (Value::Real(x), Value::Huge { negative, exponent }) => {
            let (Some(sign), Some(size)) = (is_negative(x), below(x)) else {
                return Err(UNDECIDED);
            };
            huge(*negative != sign, exponent + size)
        }
        _ => Err(UNDECIDED),
    }
}

/// `a / b`, one of which is huge.
pub(super) fn div(a: &Value, b: &Value, p: u32) -> Found {
    match (a, b) {
        (Value::Real(x), Value::Huge { exponent, .. }) => match above(x) {
            Some(size) => near(0, size - exponent, p),
            None => Err(UNDECIDED),
        },
        (Value::Huge { negative, exponent }, Value::Real(x)) => {
            if x.is_zero() {
                return Err(NoValue::Undefined("division by zero"));
            }
            match (is_negative(x), above(x)) {
                (Some(sign), Some(size)) => huge(*negative != sign, exponent - size),
                _ => Err(UNDECIDED),
            }
        }
        _ => Err(UNDECIDED),
    }
}

/// `a^k` of a huge number.
pub(super) fn power(a: &Value, k: i32, p: u32) -> Found {
    let Value::Huge { negative, exponent } = a else {
        return Err(UNDECIDED);
    };
    let exponent = exponent.saturating_mul(k.unsigned_abs().into());
    match k {
        0 => near(1, -OVERFLOW, p).map(|_| Value::Real(Ball::integer(p, 1))),
        k if k < 0 => near(0, -exponent.min(1 << 60), p),
        k => huge(*negative && k % 2 != 0, exponent),
    }
}

/// A function of arguments one of which is huge.
pub(super) fn call(f: Func, x: &[&Value], p: u32) -> Found {
    match x {
        [Value::Huge { negative, exponent }] => one(f, *negative, *exponent, p),
        [a, b] => two(f, a, b, p),
        [a, b, c] if f == Func::Fma => add_any(&mul_any(a, b, p)?, c, p),
        _ => Err(UNDECIDED),
    }
}

fn mul_any(a: &Value, b: &Value, p: u32) -> Found {
    match (a, b) {
        (Value::Real(x), Value::Real(y)) => wrap(mechaudit_reference::elementary::mul(x, y, p)),
        _ => mul(a, b),
    }
}

fn add_any(a: &Value, b: &Value, p: u32) -> Found {
    match (a, b) {
        (Value::Real(x), Value::Real(y)) => wrap(mechaudit_reference::elementary::add(x, y, p)),
        _ => add(a, b),
    }
}

/// A function with a limit at infinity; the remainder is at most `2^-exponent` for those listed.
fn one(f: Func, negative: bool, exponent: i64, p: u32) -> Found {
    let tiny = -exponent;
    match (f, negative) {
        (Func::Exp | Func::Exp2 | Func::Exp10, true) => near(0, -OVERFLOW, p),
        (Func::Expm1, true) => near(-1, -OVERFLOW, p),
        (Func::Exp | Func::Exp2 | Func::Exp10 | Func::Expm1, false) => Ok(overflow(false)),
        (Func::Sinh | Func::Erfi, _) => Ok(overflow(negative)),
        (Func::Cosh, _) | (Func::Tgamma | Func::Lgamma, false) => huge(false, exponent),
        (Func::Tanh | Func::Erf, _) => near(if negative { -1 } else { 1 }, tiny, p),
        (Func::Erfc | Func::Erfcx, false) | (Func::Dawson, _) => near(0, tiny, p),
        (Func::Erfc, true) => near(2, tiny, p),
        (Func::Erfcx, true) => Ok(overflow(false)),
        (Func::Arctan, _) => {
            let half = Ball::pi(p).shift(-1).widened(Mag::power_of_two(tiny));
            Ok(Value::Real(if negative { -half } else { half }))
        }
        (Func::Abs, _) => huge(false, exponent),
        (Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint, _) => {
            huge(negative, exponent)
        }
        (Func::Sqrt | Func::Log | Func::Log2 | Func::Log10 | Func::Log1p, true) => {
            Err(NoValue::Undefined("a negative number"))
        }
        (Func::Sqrt, false) => huge(false, exponent / 2),
        (Func::Cbrt, _) => huge(negative, exponent / 3),
        // Sines are bounded whatever the argument.
        (Func::Sin | Func::Cos, _) => unary(f, &Ball::integer(p, 0).widened(Mag::from_f64(8.0)), p),
        (Func::Asin | Func::Acos | Func::Atanh, _) | (Func::Acosh, true) => {
            Err(NoValue::Undefined("a number outside of the domain"))
        }
        _ => Err(UNDECIDED),
    }
}

fn two(f: Func, a: &Value, b: &Value, p: u32) -> Found {
    let negative = |x: &Value| match x {
        Value::Huge { negative, .. } => Some(*negative),
        Value::Real(x) => is_negative(x),
        _ => None,
    };
    match f {
        Func::Fmin | Func::Fmax => {
            let first_is_less = order(a, b).ok_or(UNDECIDED)? == Ordering::Less;
            let takes_first = first_is_less == (f == Func::Fmin);
            Ok(if takes_first { a } else { b }.clone())
        }
        Func::Hypot => {
            let exponents = [a, b].into_iter().filter_map(|x| match x {
                Value::Huge { exponent, .. } => Some(*exponent),
                _ => None,
            });
            exponents.max().map_or(Err(UNDECIDED), |e| huge(false, e))
        }
        // The angle of a point far above, below, left or right of the origin: off ±π/2, 0 or ±π by
        // at most the quotient of the coordinates.
        Func::Atan2 => match (a, b) {
            (Value::Huge { negative, exponent }, Value::Real(x)) => match above(x) {
                Some(size) => {
                    let half = Ball::pi(p)
                        .shift(-1)
                        .widened(Mag::power_of_two(size - exponent));
                    Ok(Value::Real(if *negative { -half } else { half }))
                }
                None => Err(UNDECIDED),
            },
            (Value::Real(y), Value::Huge { negative, exponent }) => {
                let Some(size) = above(y) else {
                    return Err(UNDECIDED);
                };
                let off = Mag::power_of_two(size - exponent);
                match (negative, is_negative(y)) {
                    (false, _) => Ok(Value::Real(Ball::integer(p, 0).widened(off))),
                    (true, Some(below)) => {
                        let angle = Ball::pi(p).widened(off);
                        Ok(Value::Real(if below { -angle } else { angle }))
                    }
                    (true, None) => Err(UNDECIDED),
                }
            }
            _ => Err(UNDECIDED),
        },
        Func::Copysign => match (a, negative(b)) {
            (Value::Huge { exponent, .. }, Some(sign)) => huge(sign, *exponent),
            (Value::Real(x), Some(sign)) => {
                let size = x.abs();
                Ok(Value::Real(if sign { -size } else { size }))
            }
            _ => Err(UNDECIDED),
        },
        _ => Err(UNDECIDED),
    }
}

#[cfg(test)]
mod tests;

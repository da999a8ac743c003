//! Exponential function, logarithm, powers and circular functions of moderate numbers, and angles,
//! rounded to nearest.
//!
//! They are evaluated to 256 binary places (`u = 2^−256`), which is faster than MPFR (`benches/README.md`).
//! The value rounded to fewer bits is known as soon as neither a number of that many bits nor one
//! halfway between two of them lies within the errors below. Where one may, and for other arguments and
//! precisions, MPFR rounds: the result is the same.
//!
//! An argument `x` is cut off, and reduced to `x = n c + f` with c = ln 2 or π/4: f is off by less than
//! 4u. A product is off by less than 5u, a sum is exact, entries of tables and coefficients are off by
//! less than u.
//!
//! * `e^f = T + T (A + E + A E)` with `T = e^t`, `t = k 2^−8`, `A + 1` the same of `k 2^−16`, and
//!   `E = e^s − 1`, `s < 2^−16`, by the series up to `s^13`; the rest is below `2^−260`. E is off by
//!   less than 6u, the bracket by 13u, and with T in units of 2u the sum by 25u.
//! * With `S = sin t` and `D = 1 − cos t`, `t = k 2^−8`, and `v = 1 − cos s`, `s < 2^−8`:
//!   `sin f = S − S v + sin s − D sin s` and `1 − cos f = D + v − D v + S sin s`. The series go up to
//!   `s^21` and `s^22`, and the rests are below `2^−258`; they are off by less than 9u, the sums by
//!   less than 32u, and with f by less than 40u.
//! * `ln x = E ln 2 + y + ln(1 + δ)` with a double y, and `1 + δ = x 2^−E e^−y`, which is off by less
//!   than four times 35u. `|δ| < 2^−50`, and the series goes up to `δ^4`, the rest being below
//!   `2^−252`: less than 16u. The sum is off by less than 180u.
//! * `x^y = e^(y ln x)` for y of at most 64 bits and below `2^10`.
//! * The angle of a point whose larger coordinate is from 1/2 to 1 is `t + atan w` with a double t and
//!   `w = (a cos t − b sin t)/(b cos t + a sin t)`. Numerator and denominator are off by less than
//!   100u, w by less than 205u since the denominator is 1/2 or more. `|w| < 2^−50`, and
//!   `atan w = w − w³/3` but for less than `2^−252`. With π, the sum is off by less than 250u.

use super::fixed::{self, Fixed, Fraction, doubled, halved, minus, over, plus, times, widen};
use rug::float::{Constant, Round};
use rug::ops::{AssignRound, Pow};
use rug::{Float, Integer};
use std::cmp::Ordering;
use std::sync::OnceLock;

/// A value rounded to nearest, with its ternary value.
pub(crate) type Rounded = (Float, Ordering);

/// The errors above, and more, in units.
const EXP_ERROR: u64 = 40;
const WAVE_ERROR: u64 = 60;
const LOG_ERROR: u64 = 250;
const ANGLE_ERROR: u64 = 400;

/// Arguments are less than 2 to this power.
const TOP: i32 = 20;

/// Sines of numbers below 2 to this power, logarithms of numbers as near to 1, and values with more
/// bits are left to MPFR.
const SMALL: i32 = -30;
const MOST: u32 = 200;

/// The last terms of the series.
const LAST_POWER: usize = 13;
const LAST_SINE: usize = 21;
const LAST_COSINE: usize = 22;

/// A constant below one with 64 places more.
pub(crate) struct Long {
    pub high: Fraction,
    pub low: u64,
    double: f64,
}

/// Values that the functions begin with.
pub(crate) struct Tables {
    pub ln_2: Long,
    pub quarter_pi: Long,
    /// `e^(k/2^8)/2`.
    pub powers: Vec<Fraction>,
    /// `e^(k/2^16) − 1`.
    pub small_powers: Vec<Fraction>,
    /// `sin(k/2^8)` and `1 − cos(k/2^8)`.
    pub waves: Vec<[Fraction; 2]>,
    /// `1/k!` from the second on.
    pub inverse_factorials: [Fraction; LAST_COSINE + 1],
}

/// Bits of the entries before they are cut off. Each is a product with the one before: the errors
/// of all that come before are far below a unit.
const BITS: u32 = 384;

fn long(x: &Float) -> Long {
    let rest = Float::with_val(BITS, x << fixed::PLACES).fract();
    Long {
        high: fixed::fraction(x),
        low: fixed::fraction(&rest)[3],
        double: x.to_f64(),
    }
}

/// `e^(k/2^bits)` for k from zero on.
fn powers(bits: u32) -> impl Iterator<Item = Float> {
    let step = (Float::with_val(BITS, 1) >> bits).exp();
    std::iter::successors(Some(Float::with_val(BITS, 1)), move |x| {
        Some(Float::with_val(BITS, x * &step))
    })
}

/// `sin(k/2^8)` and `cos(k/2^8)` for k from zero on.
fn waves() -> impl Iterator<Item = [Float; 2]> {
    let of = |n: u32| Float::with_val(BITS, n);
    let (sine, cosine) = (of(1) >> 8u32).sin_cos(Float::new(BITS));
    std::iter::successors(Some([of(0), of(1)]), move |[s, c]| {
        let turned = Float::with_val(BITS, s * &cosine) + Float::with_val(BITS, c * &sine);
        let rest = Float::with_val(BITS, c * &cosine) - Float::with_val(BITS, s * &sine);
        Some([turned, rest])
    })
}

pub(crate) fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let of = |n: u32| Float::with_val(BITS, n);
        let pi = Float::with_val(BITS, Constant::Pi);
        let mut factorial = Integer::from(1);
        let inverse_factorials = std::array::from_fn(|k| {
            factorial *= k.max(1) as u32;
            match k {
                0 | 1 => [0; 4],
                _ => fixed::fraction(&(of(1) / &factorial)),
            }
        });
        let less_one = |x: Float| fixed::fraction(&(x - 1u32));
        let both = |[sine, cosine]: [Float; 2]| [sine, 1u32 - cosine].map(|x| fixed::fraction(&x));
        Tables {
            ln_2: long(&Float::with_val(BITS, Constant::Log2)),
            quarter_pi: long(&(pi >> 2u32)),
            powers: powers(8)
                .take(178)
                .map(|x| fixed::fraction(&(x >> 1u32)))
                .collect(),
            small_powers: powers(16).take(256).map(less_one).collect(),
            waves: waves().take(202).map(both).collect(),
            inverse_factorials,
        }
    })
}

/// `n c`, cut off.
fn multiple(n: u64, c: &Long) -> Fixed {
    let n = u128::from(n);
    let mut carry = (u128::from(c.low) * n) >> 64;
    let mut found = [0; 5];
    for (place, limb) in found.iter_mut().zip(c.high) {
        carry += u128::from(limb) * n;
        (*place, carry) = (carry as u64, carry >> 64);
    }
    found[4] = carry as u64;
    found
}

/// `x = n c + f` with `0 ≤ f < c`, for x below `2^TOP`.
fn reduced(x: &Fixed, c: &Long) -> (u64, Fraction) {
    let size = x[4] as f64 + x[3] as f64 * 2f64.powi(-64);
    let mut n = (size / c.double) as u64;
    let (mut f, is_below) = minus(x, &multiple(n, c));
    let step = widen(c.high);
    // The quotient may be off by one.
    if is_below {
        n -= 1;
        (f, _) = plus(&f, &step);
    } else if let (rest, false) = minus(&f, &step) {
        n += 1;
        f = rest;
    }
    let [a, b, c, d, _] = f;
    (n, [a, b, c, d])
}

/// `m` and `n` with `e^±x = 2^n m` and `1/2 ≤ m < 1`.
fn power(x: &Fixed, negative: bool) -> Option<(Fraction, i64)> {
    let tables = tables();
    let (n, mut f) = reduced(x, &tables.ln_2);
    let mut n = i64::try_from(n).ok()?;
    if negative {
        // −n ln 2 − f = −(n + 1) ln 2 + (ln 2 − f)
        let (rest, is_below) = minus(&tables.ln_2.high, &f);
        (n, f) = (-n - 1, if is_below { [0; 4] } else { rest });
    }
    let top = f[3];
    let t = tables.powers.get((top >> 56) as usize)?;
    let a = &tables.small_powers[(top >> 48 & 255) as usize];
    let s = [f[0], f[1], f[2], top & ((1 << 48) - 1)];
    let c = &tables.inverse_factorials;
    let series = (2..LAST_POWER)
        .rev()
        .fold(c[LAST_POWER], |sum, k| plus(&c[k], &times(&sum, &s)).0);
    let e = plus(&s, &times(&s, &times(&s, &series))).0;
    let bracket = plus(&plus(a, &e).0, &times(a, &e)).0;
    let (m, is_one) = plus(t, &times(t, &bracket));
    (!is_one && m[3] >> 63 == 1).then_some((m, n + 1))
}

/// The value of a function in words, if the precision and the exponent of the argument are such.
fn is_taken(x: &Float, prec: u32, least: i32) -> bool {
    (32..=MOST).contains(&prec) && x.get_exp().is_some_and(|e| (least..=TOP).contains(&e))
}

fn exp_in_words(x: &Float, prec: u32) -> Option<Rounded> {
    if !is_taken(x, prec, -(MOST as i32)) {
        return None;
    }
    let (m, n) = power(&fixed::of_float(x)?, x.is_sign_negative())?;
    fixed::nearest(&widen(m), EXP_ERROR, n, false, prec)
}

/// A value from 0 to 1 with its sign.
type Signed = (Fraction, bool);

/// `sin x` and `cos x`, either being 1 where its fraction is zero.
fn circle(x: &Float) -> Option<[Signed; 2]> {
    let tables = tables();
    let (n, mut f) = reduced(&fixed::of_float(x)?, &tables.quarter_pi);
    let is_odd = n % 2 == 1;
    if is_odd {
        // −f' + (n + 1) π/4 with f' = π/4 − f.
        let (rest, is_below) = minus(&tables.quarter_pi.high, &f);
        f = if is_below { [0; 4] } else { rest };
    }
    let [sine, rest] = tables.waves.get((f[3] >> 56) as usize)?;
    let s = [f[0], f[1], f[2], f[3] & ((1 << 56) - 1)];
    let square = times(&s, &s);
    let c = &tables.inverse_factorials;
    let series = |last: usize| {
        let places = (2..last).rev().filter(|k| (last - k).is_multiple_of(2));
        places.fold(c[last], |sum, k| minus(&c[k], &times(&sum, &square)).0)
    };
    let small = minus(&s, &times(&s, &times(&square, &series(LAST_SINE)))).0;
    let v = times(&square, &series(LAST_COSINE));
    let less = |a: &Fraction, b: &Fraction| minus(a, b).0;
    let found = plus(
        &less(sine, &times(sine, &v)),
        &less(&small, &times(rest, &small)),
    )
    .0;
    let rest = plus(
        &less(&plus(rest, &v).0, &times(rest, &v)),
        &times(sine, &small),
    )
    .0;
    let cosine = minus(&[0; 4], &rest).0;
    // sin(q π/2 ± f) and cos(q π/2 ± f), the lower sign where n is odd.
    let is_below = x.is_sign_negative();
    Some(match n.div_ceil(2) % 4 {
        0 => [(found, is_odd != is_below), (cosine, false)],
        1 => [(cosine, is_below), (found, !is_odd)],
        2 => [(found, is_odd == is_below), (cosine, true)],
        _ => [(cosine, !is_below), (found, is_odd)],
    })
}

fn rounded((m, negative): &Signed, prec: u32) -> Option<Rounded> {
    fixed::nearest(&widen(*m), WAVE_ERROR, 0, *negative, prec)
}

fn waves_in_words(x: &Float, prec: u32) -> Option<[Signed; 2]> {
    if !is_taken(x, prec, SMALL) {
        return None;
    }
    circle(x)
}

/// A number with its sign.
type SignedFixed = (Fixed, bool);

fn sum(a: &SignedFixed, b: &SignedFixed) -> SignedFixed {
    match (a.1 == b.1, minus(&a.0, &b.0)) {
        (true, _) => (plus(&a.0, &b.0).0, a.1),
        (false, (difference, false)) => (difference, a.1),
        (false, _) => (minus(&b.0, &a.0).0, b.1),
    }
}

/// `2^−e |x|` with the exponent e of x, which is at least 1/2 and below 1.
fn significand(x: &Float) -> Option<Fraction> {
    let [a, b, c, d, _] = fixed::of_float(&(x.clone() >> x.get_exp()?))?;
    Some([a, b, c, d])
}

/// `ln x`.
fn logarithm(x: &Float) -> Option<SignedFixed> {
    /// The square root of 1/2.
    const MIDDLE: f64 = 0.707;
    let e = x.get_exp()?;
    if x.is_sign_negative() || e.unsigned_abs() > 1 << TOP {
        return None;
    }
    // x = 2^whole a with a next to one.
    let m = x.to_f64_exp().0;
    let above = u32::from(m < MIDDLE);
    let whole = i64::from(e) - i64::from(above);
    let y = (m * f64::from(1 << above)).ln();
    if !(y == 0.0 || y.abs() > 2f64.powi(-150)) {
        return None;
    }
    let near = fixed::of_float(&Float::with_val(53, y))?;
    let (p, n) = match y == 0.0 {
        true => ([0, 0, 0, 1 << 63], 1),
        false => power(&near, y > 0.0)?,
    };
    // (1 + δ)/2^up
    let product = times(&significand(x)?, &p);
    let up = u32::try_from(n + i64::from(above)).ok();
    let up = up.filter(|n| (1..=2).contains(n))?;
    let one: Fraction = [0, 0, 0, 1 << (64 - up)];
    let (mut delta, is_below) = minus(&product, &one);
    if is_below {
        delta = minus(&[0; 4], &delta).0;
    }
    let delta = doubled(&delta, up);
    if delta[3] >> 14 != 0 {
        return None;
    }
    let square = times(&delta, &delta);
    let odd = plus(&delta, &over(&times(&square, &delta), 3)).0;
    let even = plus(&halved(&square, 1), &halved(&times(&square, &square), 2)).0;
    // ln(1 + δ) = (δ + δ³/3) − (δ²/2 + δ⁴/4), and of −δ minus the sum.
    let rest = match is_below {
        true => plus(&odd, &even).0,
        false => minus(&odd, &even).0,
    };
    let log_2 = (multiple(whole.unsigned_abs(), &tables().ln_2), whole < 0);
    Some(sum(
        &sum(&log_2, &(near, y < 0.0)),
        &(widen(rest), is_below),
    ))
}

fn log_in_words(x: &Float, prec: u32) -> Option<Rounded> {
    /// Logarithms below 2 to this power have too few bits.
    const LEAST: i32 = 64 * 4 + SMALL;
    if !(32..=MOST).contains(&prec) {
        return None;
    }
    let (found, negative) = logarithm(x)?;
    let is_small = found[4] == 0 && found[3] >> (LEAST - 192) == 0;
    match is_small {
        true => None,
        false => fixed::nearest(&found, LOG_ERROR, 0, negative, prec),
    }
}

fn pow_in_words(x: &Float, y: &Float, prec: u32) -> Option<Rounded> {
    /// Exponents are less than 2 to this power.
    const HIGHEST: i32 = 10;
    if !(32..=MOST).contains(&prec) || y.get_exp()? > HIGHEST {
        return None;
    }
    let (log, negative) = logarithm(x)?;
    let (whole, e) = y.to_integer_exp()?;
    let negative = negative != (whole < 0);
    // y = ±2^−below digits
    let zeros = whole.find_one(0)?;
    let digits = (whole.abs() >> zeros).to_u64()?;
    let below = -(i64::from(e) + i64::from(zeros));
    let (digits, below) = match below {
        ..0 => (digits << -below, 0),
        0..=255 => (digits, below as u32),
        _ => return None,
    };
    let product = fixed::quotient_of_power(&fixed::product(&log, digits), below)?;
    let error = (LOG_ERROR << HIGHEST) + EXP_ERROR + 1;
    if product[4] >> TOP != 0 {
        return None;
    }
    let (m, n) = power(&product, negative)?;
    fixed::nearest(&widen(m), error, n, false, prec)
}

/// `π`, cut off.
fn pi() -> Fixed {
    multiple(4, &tables().quarter_pi)
}

fn atan2_in_words(y: &Float, x: &Float, prec: u32) -> Option<Rounded> {
    let (e, f) = (y.get_exp()?, x.get_exp()?);
    // The angle to one of the axes is not too small.
    if !(32..=MOST).contains(&prec) || e.abs_diff(f) > SMALL.unsigned_abs() {
        return None;
    }
    let top = e.max(f);
    let of = |z: &Float| Some((significand(z)?, top.abs_diff(z.get_exp()?)));
    let [(a, more), (b, less)] = [of(y)?, of(x)?];
    let (a, b) = (halved(&a, more), halved(&b, less));
    let double = |z: &Fraction| z[3] as f64 + z[2] as f64 * 2f64.powi(-64);
    let near = Float::with_val(53, double(&a).atan2(double(&b)));
    let [(sine, _), (cosine, _)] = circle(&near)?;
    // tan(φ − t) = (a cos t − b sin t)/(b cos t + a sin t)
    let (mut up, is_below) = minus(&times(&a, &cosine), &times(&b, &sine));
    if is_below {
        up = minus(&[0; 4], &up).0;
    }
    let (down, carry) = plus(&times(&b, &cosine), &times(&a, &sine));
    let [l, m, n, h] = down;
    let w = fixed::ratio(&up, &[l, m, n, h, carry.into()]);
    if w[3] >> 14 != 0 {
        return None;
    }
    let cube = times(&times(&w, &w), &w);
    let rest = (widen(minus(&w, &over(&cube, 3)).0), is_below);
    let mut angle = sum(&(fixed::of_float(&near)?, false), &rest);
    if x.is_sign_negative() {
        angle = sum(&(pi(), false), &(angle.0, !angle.1));
    }
    (!angle.1).then_some(())?;
    fixed::nearest(&angle.0, ANGLE_ERROR, 0, y.is_sign_negative(), prec)
}

/// `e^x`.
pub(crate) fn exp(x: &Float, prec: u32) -> Rounded {
    exp_in_words(x, prec)
        .unwrap_or_else(|| Float::with_val_round(prec, x.exp_ref(), Round::Nearest))
}

/// `ln x`.
pub(crate) fn log(x: &Float, prec: u32) -> Rounded {
    log_in_words(x, prec).unwrap_or_else(|| Float::with_val_round(prec, x.ln_ref(), Round::Nearest))
}

/// `x^y`.
pub(crate) fn pow(x: &Float, y: &Float, prec: u32) -> Rounded {
    let found = pow_in_words(x, y, prec);
    found.unwrap_or_else(|| Float::with_val_round(prec, x.pow(y), Round::Nearest))
}

/// The angle of the point `(x, y)`.
pub(crate) fn atan2(y: &Float, x: &Float, prec: u32) -> Rounded {
    let found = atan2_in_words(y, x, prec);
    found.unwrap_or_else(|| Float::with_val_round(prec, y.atan2_ref(x), Round::Nearest))
}

/// `atan x`.
pub(crate) fn atan(x: &Float, prec: u32) -> Rounded {
    let found = atan2_in_words(x, &Float::with_val(64, 1), prec);
    found.unwrap_or_else(|| Float::with_val_round(prec, x.atan_ref(), Round::Nearest))
}

/// `sin x`.
pub(crate) fn sin(x: &Float, prec: u32) -> Rounded {
    let found = waves_in_words(x, prec).and_then(|[sine, _]| rounded(&sine, prec));
    found.unwrap_or_else(|| Float::with_val_round(prec, x.sin_ref(), Round::Nearest))
}

/// `cos x`.
pub(crate) fn cos(x: &Float, prec: u32) -> Rounded {
    let found = waves_in_words(x, prec).and_then(|[_, cosine]| rounded(&cosine, prec));
    found.unwrap_or_else(|| Float::with_val_round(prec, x.cos_ref(), Round::Nearest))
}

/// `sin x` and `cos x`.
pub(crate) fn sin_cos(x: &Float, prec: u32) -> [Rounded; 2] {
    let both = waves_in_words(x, prec)
        .and_then(|[sine, cosine]| Some([rounded(&sine, prec)?, rounded(&cosine, prec)?]));
    both.unwrap_or_else(|| {
        let (mut s, mut c) = (Float::new(prec), Float::new(prec));
        let (a, b): (Ordering, Ordering) =
            (&mut s, &mut c).assign_round(x.sin_cos_ref(), Round::Nearest);
        [(s, a), (c, b)]
    })
}

#[cfg(test)]
mod tests;

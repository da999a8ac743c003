//! Functions in doubles, for balls so wide that forty bits bound their values.
//!
//! # Errors
//! Each value is off by less than [`ERROR`] = 2^−44: of itself for [`exp`] and [`atan2`], of one for
//! [`sine_cosine`], and of the larger of both for [`ln`]. With u = 2^−53:
//!
//! * the constants are sums of a part with zeros at its end, so that the multiple of it that is
//!   subtracted is exact, and of a rest; a reduced argument is off by less than 2u;
//! * what is omitted of the series is less than u of the value: the first omitted terms are
//!   `0.79^17/17!`, `0.35^14/14!`, `0.172^20/21` and `0.199^22/23`;
//! * Horner's scheme and what follows take fewer than 60 roundings of numbers not larger than the
//!   value, of less than u each: less than 2^−46 together.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, LN_2, LOG2_E, PI, SQRT_2};

/// Bounds the error of every function here.
pub(super) const ERROR: f64 = 1.0 / (1u64 << 44) as f64;

/// Arguments of [`sine_cosine`] are at most as large.
pub(super) const TURNS: f64 = 65_536.0;

/// Arguments of [`exp`] are at most as large.
pub(super) const EXPONENTS: f64 = 600.0;

/// `Σ c_k x^k` from the highest coefficient to the lowest.
fn horner(x: f64, coefficients: impl IntoIterator<Item = f64>) -> f64 {
    coefficients.into_iter().fold(0.0, |sum, c| sum * x + c)
}

/// `sin x` and `cos x` for `|x| ≤` [`TURNS`].
pub(super) fn sine_cosine(x: f64) -> (f64, f64) {
    // The first 33 bits of π/2, and the rest.
    const HIGH: f64 = 1.570_796_326_734_125_6;
    const LOW: f64 = 6.077_100_506_506_192e-11;
    let n = (x * FRAC_2_PI).round_ties_even();
    let r = (x - n * HIGH) - n * LOW;
    let square = r * r;
    let (mut sine, mut cosine) = (0.0, 0.0);
    for k in (1..=8).rev() {
        let k = f64::from(2 * k);
        sine = (sine + 1.0) * (-square / (k * (k + 1.0)));
        cosine = (cosine + 1.0) * (-square / (k * (k - 1.0)));
    }
    let (sine, cosine) = (r + r * sine, 1.0 + cosine);
    match (n as i64).rem_euclid(4) {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// `e^x` for `|x| ≤` [`EXPONENTS`].
pub(super) fn exp(x: f64) -> f64 {
    // The first 32 bits of ln 2, and the rest.
    const HIGH: f64 = 0.693_147_180_369_123_8;
    const LOW: f64 = 1.908_214_929_270_587_7e-10;
    let k = (x * LOG2_E).round_ties_even();
    let r = (x - k * HIGH) - k * LOW;
    let value = (1..=13)
        .rev()
        .fold(1.0, |sum, k| 1.0 + sum * (r / f64::from(k)));
    value * f64::from_bits(((k as i64 + 1023) as u64) << 52)
}

/// `ln x` for a positive normal number.
pub(super) fn ln(x: f64) -> f64 {
    let mut e = (x.to_bits() >> 52) as i64 - 1023;
    let mut m = f64::from_bits(x.to_bits() << 12 >> 12 | 1023 << 52);
    if m > SQRT_2 {
        (m, e) = (m / 2.0, e + 1);
    }
    let s = (m - 1.0) / (m + 1.0);
    let series = horner(s * s, (0..10).rev().map(|k| 1.0 / f64::from(2 * k + 1)));
    2.0 * s * series + e as f64 * LN_2
}

/// The angle of the point `(x, y)` in `[−π, π]`; none where the quotient may lose bits.
pub(super) fn atan2(y: f64, x: f64) -> Option<f64> {
    let (a, b) = (y.abs(), x.abs());
    let t = a.min(b) / a.max(b);
    if !(t == 0.0 || t > 1e-300) || !a.max(b).is_normal() {
        return None;
    }
    let half = |t: f64| t / (1.0 + (1.0 + t * t).sqrt());
    let t = half(half(t));
    let series = (0..11)
        .rev()
        .map(|k| (1.0 - 2.0 * f64::from(k % 2)) / f64::from(2 * k + 1));
    let mut angle = 4.0 * t * horner(t * t, series);
    if a > b {
        angle = FRAC_PI_2 - angle;
    }
    if x < 0.0 {
        angle = PI - angle;
    }
    Some(angle.copysign(y))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Float;

    /// Numbers of all sizes up to a largest one, and both signs.
    fn numbers(largest: f64) -> impl Iterator<Item = f64> {
        let mut state = 1_u64;
        (0..20_000).map(move |k| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            let x = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            x * if k % 3 == 0 {
                largest
            } else {
                largest.powf(f64::from(k % 40 - 20) / 20.0)
            }
        })
    }

    /// The distance of a value from the one by MPFR.
    fn off(found: f64, due: &Float) -> f64 {
        Float::with_val(200, found - due).to_f64().abs()
    }

    #[test]
    fn errors_are_below_their_bound() {
        let of = |x: f64| Float::with_val(200, x);
        let mut worst = [0_f64; 5];
        for x in numbers(TURNS) {
            let (sine, cosine) = sine_cosine(x);
            worst[0] = worst[0].max(off(sine, &of(x).sin()));
            worst[1] = worst[1].max(off(cosine, &of(x).cos()));
        }
        for x in numbers(EXPONENTS) {
            let due = of(x).exp();
            worst[2] = worst[2].max(off(exp(x), &due) / due.to_f64());
        }
        for x in numbers(1e300) {
            let due = of(x.abs()).ln();
            worst[3] = worst[3].max(off(ln(x.abs()), &due) / due.to_f64().abs().max(1.0));
        }
        for (y, x) in numbers(1e9).zip(numbers(1e4).skip(7)) {
            for (y, x) in [(y, x), (x, y), (y, 0.0), (0.0, y)] {
                let due = of(y).atan2(&of(x));
                let error = off(atan2(y, x).unwrap(), &due) / due.to_f64().abs();
                worst[4] = worst[4].max(if due.is_zero() { 0.0 } else { error });
            }
        }
        for (k, worst) in worst.into_iter().enumerate() {
            // A few units of the last place, of a number that is reduced once.
            assert!(worst < ERROR / 32.0 && worst > 0.0, "{k}: {worst:e}");
        }
        assert_eq!(atan2(1e-310, 1.0), None);
        assert_eq!(atan2(0.0, 0.0), None);
    }
}

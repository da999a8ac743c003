//! Upper bounds of elementary functions, rounded up.

use crate::interval::{product_up, quotient_up, sqrt_up, sum_up};
use mechaudit_reference::Ball;
use rug::float::Round;
use rug::{Float, Rational};

/// π/2, rounded up.
pub(crate) const HALF_PI: f64 = 1.570_796_326_794_896_8;
/// √π, rounded up.
const SQRT_PI: f64 = 1.772_453_850_905_516_4;
/// √e, rounded up.
const SQRT_E: f64 = 1.648_721_270_700_128_3;
/// π, rounded down.
const PI_BELOW: f64 = std::f64::consts::PI;

/// An upper bound of `e^t`.
pub(crate) fn exp_up(t: f64) -> f64 {
    let (e, _) = Float::with_val_round(64, Float::with_val(64, t).exp_ref(), Round::Up);
    e.to_f64_round(Round::Up)
}

/// An upper bound of `x^n`, `x ≥ 0`.
pub(crate) fn power_up(x: f64, n: u32) -> f64 {
    (0..n).fold(1.0, |p, _| product_up(p, x))
}

/// `T_N = Γ(N + ½)/(π r^{2N+1})` for N from n on, from a lower bound of r.
fn terms(n: u32, r: f64) -> impl Iterator<Item = f64> {
    // Γ(N + ½) = √π ½ (3/2) ⋯ (N − ½); each factor with two powers of r.
    let mut p = quotient_up(quotient_up(SQRT_PI, PI_BELOW), r);
    let terms = (0u32..).map(move |k| {
        let more = product_up(p, f64::from(k) + 0.5);
        std::mem::replace(&mut p, quotient_up(quotient_up(more, r), r))
    });
    terms.skip(n as usize)
}

/// `B_N/T_N`, `B_N = √(e (N + 3/2)) T_N` a bound of the remainder `R_N` of N terms of the
/// asymptotic series in the closed quadrant (proved at the head of `special/faddeeva/asymptotic.rs`
/// of the reference).
fn remainder_alone(n: u32) -> f64 {
    product_up(SQRT_E, sqrt_up(f64::from(n) + 1.5))
}

/// `D_N/T_N`, `D_N = √e ((2N − 1) √(N + 3/2) + 2N + 3) T_N` a bound of `|z R_N′|` there.
fn slope_alone(n: u32) -> f64 {
    let n2 = 2.0 * f64::from(n);
    let sum = sum_up(product_up(n2 - 1.0, sqrt_up(f64::from(n) + 1.5)), n2 + 3.0);
    product_up(SQRT_E, sum)
}

/// The least of `f(m) T_m + Σ_{n ≤ k < m} g(k, T_k)` for m from n to n + 12.
fn least_of(n: u32, r: f64, f: impl Fn(u32) -> f64, g: impl Fn(u32, f64) -> f64) -> f64 {
    let (mut sum, mut least) = (0.0, f64::INFINITY);
    for (m, t) in (n..=n + 12).zip(terms(n, r)) {
        least = least.min(sum_up(sum, product_up(f(m), t)));
        sum = sum_up(sum, g(m, t));
    }
    least
}

/// A bound of `R_N`: the terms that follow, of absolute value `T_k` each, and the remainder after
/// some of them.
pub(crate) fn remainder(n: u32, r: f64) -> f64 {
    least_of(n, r, remainder_alone, |_, t| t)
}

/// A bound, divided by the angle from an axis, of the component of `R_N` that vanishes on it: that
/// of term k is `T_k |sin (2k + 1)φ| ≤ (2k + 1) φ T_k`, φ the angle, and for the remainder after
/// some of them as above.
pub(crate) fn remainder_slope(n: u32, r: f64) -> f64 {
    least_of(n, r, slope_alone, |k, t| {
        product_up(2.0 * f64::from(k) + 1.0, t)
    })
}

/// A finite number, exactly.
pub(crate) fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

/// An upper bound of the absolute value of any number of a ball.
pub(crate) fn above(ball: &Ball) -> f64 {
    ball.magnitude().to_f64()
}

#[cfg(test)]
mod tests;

//! Functions of balls in machine words, for arguments of moderate size: accurate to some 118 bits.
//!
//! A guess in doubles is made accurate by one step whose error is of third order. None is given
//! where an argument is out of reach or much of the accuracy would be lost; MPFR serves there.

pub mod complex;

use super::coarse;
use crate::{Ball, Ball128};
use std::sync::OnceLock;

/// An upper bound on the exponent of a number in magnitude.
fn above(x: &Ball128) -> i64 {
    x.exponents()[0].unwrap_or(-(1 << 30))
}

/// Exponents of two below which a correction is small enough.
const CLOSE: i64 = -38;

fn one() -> Ball128 {
    Ball128::integer(1)
}

/// `e^x`.
pub fn exp(x: &Ball128) -> Option<Ball128> {
    x.exp()
}

/// `sinh x`, `cosh x` or their quotient.
fn hyperbolic(x: &Ball128) -> Option<[Ball128; 2]> {
    let up = x.exp()?;
    let down = one().div(&up)?;
    Some([up.sub(&down)?.shift(-1), up.add(&down)?.shift(-1)])
}

/// Returns true if the number is at least 1/4 in magnitude: a difference loses few bits.
fn is_apart(x: &Ball128) -> bool {
    x.exponents()[1].is_some_and(|e| e >= -2)
}

/// `sinh x`.
pub fn sinh(x: &Ball128) -> Option<Ball128> {
    Some(hyperbolic(x).filter(|_| is_apart(x))?[0])
}

/// `cosh x`.
pub fn cosh(x: &Ball128) -> Option<Ball128> {
    Some(hyperbolic(x)?[1])
}

/// `tanh x`.
pub fn tanh(x: &Ball128) -> Option<Ball128> {
    let [sinh, cosh] = hyperbolic(x).filter(|_| is_apart(x))?;
    sinh.div(&cosh)
}

/// `sin x`.
pub fn sin(x: &Ball128) -> Option<Ball128> {
    Some(x.sine_cosine()?[0])
}

/// `cos x`.
pub fn cos(x: &Ball128) -> Option<Ball128> {
    Some(x.sine_cosine()?[1])
}

/// `tan x`.
pub fn tan(x: &Ball128) -> Option<Ball128> {
    let [sine, cosine] = x.sine_cosine()?;
    sine.div(&cosine)
}

/// `ln x = y + 2 artanh t` with `t = (x − e^y)/(x + e^y)`, where `|2 artanh t − 2t| ≤ |t|³` for
/// `|t| ≤ 1/2`. None next to 1.
pub fn log(x: &Ball128) -> Option<Ball128> {
    let [low, high] = x.doubles()?;
    if !(low > 1e-200 && high < 1e200) {
        return None;
    }
    let guess = coarse::ln(low);
    if guess.abs() < 1.0 / 64.0 {
        return None;
    }
    let y = Ball128::exact(guess);
    let near = y.exp()?;
    let t = x.sub(&near)?.div(&x.add(&near)?)?;
    let size = above(&t);
    match size <= CLOSE {
        true => y.add(&t.shift(1))?.widened(3 * size),
        false => None,
    }
}

/// `x^y = e^(y ln x)` for x > 0, where `|y ln x|` is at most 2^8.
pub fn pow(x: &Ball128, y: &Ball128) -> Option<Ball128> {
    let exponent = log(x)?.mul(y)?;
    (above(&exponent) <= 8).then(|| exponent.exp())?
}

/// A double next to W(x) for x ≥ 0, by Halley's method.
fn lambert_guess(x: f64) -> f64 {
    let mut w = match x > 3.0 {
        true => {
            let log = coarse::ln(x);
            log - coarse::ln(log)
        }
        false => x / (1.0 + x),
    };
    for _ in 0..4 {
        let rest = w - x / coarse::exp(w);
        w -= rest / (w + 1.0 - (w + 2.0) * rest / (2.0 * w + 2.0));
    }
    w
}

/// Lambert's W for x ≥ 0.
///
/// With `a = 1 + w` and `d = x e^−w − w` the correction Δ solves `F = (w + Δ) e^Δ − w − d = 0`. For
/// `Δ' = d/a − (a + 1) d²/(2a³)` and `|d| ≤ 2^−10` the terms of F below the third order cancel, and
/// `|F(Δ')| ≤ 4 |d|³/a²`. F rises by at least `3a/4` for `|Δ| ≤ 1/8`: so `|Δ − Δ'| ≤ 8 |d|³`.
pub fn lambertw(x: &Ball128) -> Option<Ball128> {
    let [low, high] = x.doubles()?;
    if !(low > 1e-30 && high < 1e200) {
        return None;
    }
    let guess = lambert_guess(low);
    if !(guess > 0.0) {
        return None;
    }
    let w = Ball128::exact(guess);
    let d = x.mul(&w.negative().exp()?)?.sub(&w)?;
    let a = w.add(&one())?;
    let first = d.div(&a)?;
    let second = first.mul(&first)?.mul(&a.add(&one())?)?.div(&a)?.shift(-1);
    let size = above(&d);
    match size <= CLOSE {
        true => w.add(&first.sub(&second)?)?.widened(3 * size + 3),
        false => None,
    }
}

/// Terms of Stirling's series.
const TERMS: usize = 20;

/// Arguments of Stirling's series are at least as large.
const FAR: f64 = 24.0;

struct Stirling {
    /// `B_2k/(2k (2k − 1))`.
    coefficients: Vec<Ball128>,
    /// `√(2π)`.
    factor: Ball128,
}

fn stirling() -> Option<&'static Stirling> {
    static KNOWN: OnceLock<Option<Stirling>> = OnceLock::new();
    let make = || {
        let all = super::complex::stirling_coefficients(TERMS + 1);
        let of = |c| Ball128::of_ball(&Ball::rational(160, c));
        Some(Stirling {
            coefficients: all.iter().take(TERMS + 1).map(of).collect::<Option<_>>()?,
            factor: Ball128::of_ball(&Ball::pi(160).shift(1).sqrt())?,
        })
    };
    KNOWN.get_or_init(make).as_ref()
}

/// `Γ(x)` for x ≥ 1/2, by Stirling's series for `x + n`, whose remainder is less than the first
/// term omitted (DLMF 5.11(ii)), and by `Γ(x + n) = x (x + 1) … Γ(x)`.
pub fn tgamma(x: &Ball128) -> Option<Ball128> {
    let [low, high] = x.doubles()?;
    if !(low >= 0.5 && high < 1e4) {
        return None;
    }
    let stirling = stirling()?;
    let (mut z, mut place, mut product) = (*x, low, one());
    while place < FAR {
        product = product.mul(&z)?;
        z = z.add(&one())?;
        place = (place + 1.0).next_down();
    }
    let inverse = one().div(&z)?;
    let square = inverse.mul(&inverse)?;
    let (rest, terms) = stirling.coefficients.split_last()?;
    let mut sum = Ball128::ZERO;
    for c in terms.iter().rev() {
        sum = sum.mul(&square)?.add(c)?;
    }
    let omitted = rest.mul(&square.power(TERMS as i32)?)?.mul(&inverse)?;
    let sum = sum.mul(&inverse)?.widened(above(&omitted))?;
    let half = Ball128::exact(0.5);
    let lead = z.sub(&half)?.mul(&log(&z)?)?.sub(&z)?;
    lead.add(&sum)?.exp()?.mul(&stirling.factor)?.div(&product)
}

#[cfg(test)]
mod tests;

//! Functions of complex balls in machine words: principal branches, and accurate beside the modulus.

use super::{CLOSE, FAR, TERMS, above, one, stirling};
use crate::elementary::coarse;
use crate::{Ball128, Complex128};
use std::f64::consts::LN_2;

/// The middle of the doubles around a number; none where it is tiny or huge.
fn middle(x: &Ball128) -> Option<f64> {
    let [low, high] = x.doubles()?;
    Some(0.5 * low + 0.5 * high)
}

/// An upper bound on the exponent of a number in modulus.
fn modulus_above(z: &Complex128) -> i64 {
    above(&z.re).max(above(&z.im)) + 1
}

/// Both parts with `2^k` added to their radii.
fn widened(z: &Complex128, k: i64) -> Option<Complex128> {
    Some(Complex128 {
        re: z.re.widened(k)?,
        im: z.im.widened(k)?,
    })
}

/// `e^z = e^x (cos y + i sin y)`.
pub fn exp(z: &Complex128) -> Option<Complex128> {
    let [im, re] = z.im.circle()?;
    Complex128 { re, im }.scaled(&z.re.exp()?)
}

/// `ln z = w + 2 artanh t` with `t = (z − e^w)/(z + e^w)`, where `|2 artanh t − 2t| ≤ |t|³` for
/// `|t| ≤ 1/2`.
///
/// The imaginary part of w is the angle of a number with the sign of Im z, or between ±π/2 where Re z
/// is positive: so is the angle of z, and no turn lies between them.
pub fn log(z: &Complex128) -> Option<Complex128> {
    if !z.is_off_cut() {
        return None;
    }
    let [x, y] = [middle(&z.re)?, middle(&z.im)?];
    let size = x * x + y * y;
    if !(size > 1e-200 && size < 1e200) {
        return None;
    }
    let w = Complex128 {
        re: Ball128::exact(0.5 * coarse::ln(size)),
        im: Ball128::exact(coarse::atan2(y, x)?),
    };
    let near = exp(&w)?;
    let t = z.sub(&near)?.div(&z.add(&near)?)?;
    let size = modulus_above(&t);
    match size <= CLOSE {
        true => widened(
            &w.add(&Complex128 {
                re: t.re.shift(1),
                im: t.im.shift(1),
            })?,
            3 * size,
        ),
        false => None,
    }
}

/// `z^w = e^(w ln z)`, where `|w ln z|` is at most 2^8.
pub fn pow(z: &Complex128, w: &Complex128) -> Option<Complex128> {
    let exponent = log(z)?.mul(w)?;
    (modulus_above(&exponent) <= 8).then(|| exp(&exponent))?
}

/// Heights of numbers whose real part may be small in Stirling's series.
const HIGH: f64 = 48.0;

/// `Γ(z)` for Re z ≥ 1/2, by Stirling's series for `z + n` and by `Γ(z + n) = z (z + 1) … Γ(z)`.
///
/// With `s = |z|` and m terms the remainder is at most the first term omitted times
/// `(2 s/(s + Re z))^m` (DLMF 5.11.11, with `cos² (θ/2) = (s + Re z)/(2 s)` for the angle θ).
pub fn tgamma(z: &Complex128) -> Option<Complex128> {
    let ([low, high], [bottom, top]) = (z.re.doubles()?, z.im.doubles()?);
    let height = bottom.max(-top).max(0.0);
    if !(low >= 0.5 && high < 1e4 && top.max(-bottom) < 1e4) {
        return None;
    }
    let stirling = stirling()?;
    let (mut far, mut place) = (*z, low);
    let mut product: Option<Complex128> = None;
    while place < FAR && height < HIGH {
        product = Some(match product {
            Some(product) => product.mul(&far)?,
            None => far,
        });
        far.re = far.re.add(&one())?;
        place = (place + 1.0).next_down();
    }
    let inverse = Complex128::real(one()).div(&far)?;
    let square = inverse.mul(&inverse)?;
    let (rest, terms) = stirling.coefficients.split_last()?;
    let mut sum = Complex128::ZERO;
    for c in terms.iter().rev() {
        sum = sum.mul(&square)?;
        sum.re = sum.re.add(c)?;
    }
    // Exponents of two; a hundredth covers the errors of the doubles.
    let least = (place * place + height * height).sqrt();
    let (right, side) = (place + (high - low), top.max(-bottom));
    let most = (right * right + side * side).sqrt();
    let size = coarse::ln(least) / LN_2;
    let turn = 1.0 - coarse::ln(1.0 + place / most) / LN_2;
    let count = (TERMS + 1) as f64;
    let omitted = count * turn - (2.0 * count - 1.0) * size;
    let omitted = above(rest) + (omitted + 0.01).ceil() as i64;
    let sum = widened(&sum.mul(&inverse)?, omitted)?;
    let half = Complex128::real(Ball128::exact(0.5));
    let lead = far.sub(&half)?.mul(&log(&far)?)?.sub(&far)?;
    let found = exp(&lead.add(&sum)?)?.scaled(&stirling.factor)?;
    match product {
        Some(product) => found.div(&product),
        None => Some(found),
    }
}

#[cfg(test)]
mod tests;

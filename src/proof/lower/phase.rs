//! The phase `θ = 2ay` modulo π/2, and the polynomials of the sine and the cosine.
//!
//! Below 2³⁰ the code subtracts `k (H₀ + H₁ + H₂)`, three parts of π/2. It is run over binades of
//! k: with `θ₁ = k H₀ + r`, r any multiple of 2⁻⁵³ of at most [`REDUCED`], and θ₂ any low part of
//! it. That r is so small: k is the integer next to `θ₁ c`, c within `u` of 2/π, so that
//! `|θ₁ − k π/2| ≤ π/4 + 2⁻²²`; and `k |π/2 − H₀| < 2⁻²³`.
//!
//! From 2³⁰ on `2 a |y| = m 2^e` with a whole m below 2¹⁰⁶ is multiplied by 320 binary digits of
//! 2/π in integers; those before them give multiples of four, those after them are less than
//! `2⁻²¹²` of a quarter. Of the fraction three words of 64 bits from the first that is not zero are
//! summed in pairs, at least 129 digits, and the sum is multiplied by a pair for π/2: within
//! `2⁻¹⁰⁰` of the phase, which is below one. The stored digits are compared with those of π.

use crate::ProofError;
use crate::bounds::{above, power_up, rational};
use crate::exact::Exact;
use crate::grid::power_of_two;
use crate::interval::{Interval, hypot_up, larger, product_up, sum_up, up};
use crate::tracked::{Rounding, Setting, Tracked, evaluate};
use mechaudit_reference::Ball;
use mechaudit_solvers::faddeeva::proof::lower::{self as code, Constants};
use rug::{Integer, Rational};

/// u = 2⁻⁵³.
pub(crate) const U: f64 = 1.0 / 9_007_199_254_740_992.0;
const BITS: u32 = 400;
/// Above the largest reduced phase.
pub(super) const REDUCED: f64 = 0.785_400_5;
/// Phases of the short form are below this many quarters.
const SHORT: f64 = 128.0;

/// The distance of a reduced phase from `θ − k π/2`.
pub(super) struct Phase {
    /// As a pair.
    pub error: f64,
    /// Sine and cosine of the short form together.
    pub short: f64,
    /// Boxes that were run.
    pub boxes: usize,
}

/// Returns any number within `r` of zero.
pub(super) fn around_zero(r: f64) -> Tracked {
    let any = Exact::within(Interval::new(-r, r));
    Tracked::any(any, i32::MIN / 4)
}

/// `|π/2 − Σ parts|`.
fn left_of_half_pi(parts: &[f64]) -> f64 {
    let sum: Rational = parts.iter().copied().map(rational).sum();
    above(&(&Ball::pi(BITS).shift(-1) - &Ball::rational(BITS, &sum)))
}

/// `k H₀ + r` with `k` and `r` the coordinates, and `k`.
fn quarters_and_rest(h0: f64, k: [f64; 2], r: [f64; 2]) -> [Exact; 2] {
    let whole = match k[0] == k[1] {
        true => Exact::point(k[0]),
        false => Exact::coordinate(Interval::new(k[0], k[1]), 0),
    };
    let rest = Exact::coordinate(Interval::new(r[0], r[1]), 1);
    [whole * Exact::point(h0) + rest, whole]
}

/// The exponent of what a phase of `k` quarters and more is a multiple of: a quarter of a turn and
/// more of 2⁻⁵³, less is any number.
fn grain(k: f64) -> i32 {
    if k > 0.0 { -53 } else { -1074 }
}

/// [`quarters_and_rest`], with a low part of the phase.
fn reducible(h0: f64, k: [f64; 2], r: [f64; 2]) -> ((Tracked, Tracked), Tracked) {
    let [theta, whole] = quarters_and_rest(h0, k, r);
    let low = around_zero(up(theta.range.magnitude() * U));
    let theta = Tracked::any(theta, grain(k[0]));
    ((theta, low), Tracked::any(whole, 0))
}

/// The reduced phases.
fn reduced() -> [f64; 2] {
    [-REDUCED, REDUCED]
}

/// Returns what up to `most` quarters lack, each of them these parts of π/2.
fn left_of_quarters([_, most]: [f64; 2], parts: &[f64]) -> f64 {
    product_up(most, left_of_half_pi(parts))
}

/// The reduced phases of the short form, in parts that meet.
fn pieces() -> impl Iterator<Item = [f64; 2]> {
    const PIECES: i32 = 48;
    let at = |i: i32| REDUCED * (2.0 * f64::from(i) / f64::from(PIECES) - 1.0);
    (0..PIECES).map(move |i| [at(i), at(i + 1)])
}

/// 0, 1, and the binades from 2 on below `most`.
fn binades(most: f64) -> Vec<[f64; 2]> {
    let mut all = vec![[0.0; 2], [1.0; 2]];
    let mut k = 2.0;
    while k < most {
        all.push([k, 2.0 * k - 1.0]);
        k *= 2.0;
    }
    all
}

impl Phase {
    pub fn of(c: &Constants, rounding: Rounding) -> Result<Phase, ProofError> {
        let [h0, h1, h2] = c.half_pi;
        if (h0 * 2f64.powi(52)).fract() != 0.0 || !(0.0..REDUCED).contains(&(0.5 * h0 + 3e-7)) {
            return Err("the first part of π/2 is not what the lemma needs".into());
        }
        are_digits_of_two_over_pi(c.two_over_pi)?;
        let quarters = code::LIMITS.large_phase * 0.64;
        let mut error: f64 = power_of_two(-100);
        let mut boxes = 0;
        for k in binades(quarters) {
            let ways = evaluate(Setting::new(&[], rounding), || {
                let (theta, k) = reducible(h0, k, reduced());
                let (hi, lo) = code::without_quarters(theta, k);
                hi.exact_sum(lo).error
            })?;
            let left = left_of_quarters(k, &[h0, h1, h2]);
            error = ways
                .into_iter()
                .fold(error, |e, w| larger(e, sum_up(w, left)));
            boxes += 1;
        }
        let mut short: f64 = 0.0;
        for k in binades(SHORT) {
            for rest in pieces() {
                let ways = evaluate(Setting::new(&[], rounding), || {
                    let (theta, k) = reducible(h0, k, rest);
                    let (s, c) = code::sin_cos_short(theta, k);
                    hypot_up(s.result().error, c.result().error)
                })?;
                let left = left_of_quarters(k, &[h0, h1]);
                short = ways
                    .into_iter()
                    .fold(short, |e, w| larger(e, sum_up(w, left)));
                boxes += 1;
            }
        }
        let [_, [sine, cosine]] = polynomials(c);
        Ok(Phase {
            error,
            short: sum_up(short, hypot_up(sine, cosine)),
            boxes,
        })
    }
}

/// # Errors
/// If they are not.
fn are_digits_of_two_over_pi(words: &[u64]) -> Result<(), ProofError> {
    let mut stored = Integer::new();
    for w in words {
        stored = (stored << 64) + *w;
    }
    let places = 64 * words.len() as u32;
    let exact = &Ball::integer(places + 200, 2) * &Ball::pi(places + 200).recip();
    let whole = |x: rug::Float| (x << places).floor().to_integer().expect("finite");
    match whole(exact.lower()) == stored && whole(exact.upper()) == stored {
        true => Ok(()),
        false => Err("the stored digits of 2/π are wrong".into()),
    }
}

/// Returns what the polynomials of the sine and the cosine differ from both by for `|x| ≤`
/// [`REDUCED`]: those of the accurate form and of the others, of the sine and of the cosine.
pub(super) fn polynomials(c: &Constants) -> [[f64; 2]; 2] {
    let sixth = rational(c.sixth[0]) + rational(c.sixth[1]);
    let fifth: Vec<Rational> = c.sin_from_fifth.iter().map(|x| rational(*x)).collect();
    let mut accurate = vec![-sixth];
    accurate.extend(fifth);
    let rounded: Vec<Rational> = c.sin.iter().map(|x| rational(-*x)).collect();
    let cosine: Vec<Rational> = c.cos.iter().map(|x| rational(*x)).collect();
    let cosine = difference(&cosine, 4, 1);
    [accurate, rounded].map(|sine| [difference(&sine, 3, -1), cosine])
}

/// `Σ |c_j − sign (−1)^j/(first + 2j)!| x^{first + 2j}` and the first term left out, which bounds
/// the rest of an alternating series.
fn difference(c: &[Rational], first: u32, sign: i32) -> f64 {
    let mut exact = Rational::from(sign);
    for n in 2..=first {
        exact /= Rational::from(n);
    }
    let (mut sum, mut n) = (0.0, first);
    for stored in c {
        let off = Rational::from(stored - &exact).abs();
        sum = sum_up(sum, product_up(up(off.to_f64()), power_up(REDUCED, n)));
        exact /= -Rational::from((n + 1) * (n + 2));
        n += 2;
    }
    sum_up(
        sum,
        product_up(up(exact.abs().to_f64()), power_up(REDUCED, n)),
    )
}

#[cfg(test)]
mod tests;

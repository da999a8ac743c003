//! W for moderate |z|: Kummer's series of Dawson's function, in the whole plane.
//!
//! # Formula
//! `w(z) = e^{−z²} + (2i/√π) F(z)` (DLMF 7.5.1) with Dawson's function
//! `F(z) = z ₁F₁(1; 3/2; −z²) = z Σ_k (−2z²)^k/(2k+1)!!` (DLMF 7.6.2 at iz, with
//! `F(z) = (√π/(2i)) e^{−z²} erf(iz)`). Put
//! `v' = −2z² = C v` with a number C = c/2^s not much larger than |v'|, so that `|v| ≤ 1`, and `Σ = P + i q S` with `q = Im v = −4xy/C` ([`super::fixed`]). Then
//!
//! ```text
//! Re w = Re e^{−z²} − (2/√π) y (P − (4x²/C) S)
//! Im w = Im e^{−z²} + (2/√π) x (P + (4y²/C) S)
//! ```
//!
//! Beside an axis the small component is thus formed as (small coordinate) × (number of moderate
//! size), and its relative accuracy does not suffer.
//!
//! # Truncation
//! The term of index k is at most `C^k/(2k+1)!!` in P (|v| ≤ 1), and at most k times that in S, because
//! `|Im v^k / q| ≤ k |v|^{k−1} ≤ k`. With `T_k = k C^k/(2k+1)!!` and
//! `T_{k+1}/T_k = C (k+1)/(k (2k+3)) ≤ 1/2` for all k ≥ n both tails are at most `2 T_n`. `T_n` is
//! bounded through `(2n+1)!! = 2^{n+1} Γ(n+3/2)/√π` and `ln Γ(s) ≥ (s − 1/2) ln s − s + ln(2π)/2`
//! (DLMF 5.11.1 with its first omitted term positive, s > 0).
//!
//! # Working precision
//! Both P and the exponential reach `e^{|z|²}` while w is of the order 1/|z| in the upper
//! half-plane: 1.4427 |z|² bits are lost at most, and are added.

use super::argument::Argument;
use super::fixed;
use super::gaussian::Gaussian;
use super::pair::Member;
use crate::{Ball, ComplexBall, Mag};
use rug::Integer;

/// `log2` of an upper bound on `T_n`.
fn tail_log2(c: f64, n: f64) -> f64 {
    let s = n + 1.5;
    let ln_gamma = (s - 0.5) * s.ln() - s + 0.9189385;
    let ln = n * c.ln() + n.ln() - (n + 1.0) * std::f64::consts::LN_2 - ln_gamma + 0.5724;
    ln * std::f64::consts::LOG2_E + 1.0
}

/// The smallest convenient n ≥ 1 with `2 T_n ≤ 2^-bits` and term ratios below one half.
fn terms(c: f64, bits: f64) -> u64 {
    let enough = |n: u64| {
        let x = n as f64;
        c * (x + 1.0) * 2.0 <= x * (2.0 * x + 3.0) && tail_log2(c, x) + 1.0 <= -bits
    };
    let mut high = 8;
    while !enough(high) {
        high *= 2;
    }
    let mut low = high / 2;
    while high - low > 1 + high / 64 {
        let mid = low + (high - low) / 2;
        if enough(mid) {
            high = mid;
        } else {
            low = mid;
        }
    }
    high
}

/// `(c, s)` with `size ≤ c/2^s`, few digits, at most a quarter too large above 1 and a factor of two
/// below (or 2^-32).
fn scale(size: f64) -> (u64, u32) {
    let size = size * (1.0 + 1e-12);
    if size >= 16.0 {
        (size.ceil() as u64, 0)
    } else if size > 1.0 {
        ((size * 4.0).ceil() as u64, 2)
    } else {
        let s = (-size.log2()).floor().clamp(0.0, 32.0);
        // The logarithm may be rounded to the wrong side of an integer.
        (if size * s.exp2() > 1.0 { 2 } else { 1 }, s as u32)
    }
}

/// w, or w − e^{−z²}, at relative precision about 2^-prec of its modulus in the upper half-plane.
/// `|z|²` has to be below 2^31.
pub(super) fn parts(z: &Argument, member: Member, prec: u32) -> ComplexBall {
    let size = z.norm_f64();
    let loss = (size * std::f64::consts::LOG2_E).ceil() as u32;
    let guard = 12 + 2 * (1.0 + size).log2().ceil() as u32;
    let target = prec + loss + guard;
    let inner = target + 16;
    let (x, y) = (z.x.ball(inner), z.y.ball(inner));

    let (c_top, c_down) = scale(2.0 * size);
    let c = c_top as f64 / (c_down as f64).exp2();
    let n = terms(c, f64::from(target));
    let bits = target + 2 * (64 - n.leading_zeros()) / 2 + 4;
    let inverse =
        (&Ball::integer(inner, 1) / &Ball::integer(inner, c_top as i64)).shift(c_down as i32);
    let (xx, yy) = (x.square(), y.square());
    let p = (&(&yy - &xx) * &inverse).shift(1);
    let (x2, y2) = ((&xx * &inverse).shift(2), (&yy * &inverse).shift(2));
    let q2 = (&x2 * &yy).shift(2) * &inverse;
    let (big_p, big_s) = fixed::sum(&p, &q2, bits, n, |k| (c_top, (2 * k + 3) << c_down));
    let tail = Mag::power_of_two(-i64::from(target));
    let (big_p, big_s) = (
        big_p.with_prec(inner).widened(tail),
        big_s.with_prec(inner).widened(tail),
    );

    let factor = Ball::integer(inner, 2) / &Ball::pi(inner).sqrt();
    let re = -((&factor * &y) * &(&big_p - &(&x2 * &big_s)));
    let im = (&factor * &x) * &(&big_p + &(&y2 * &big_s));
    if member == Member::Dawson {
        return ComplexBall::new(re, im);
    }
    let e = Gaussian::new(&x, &y, inner);
    let (ec, es) = e.relative_to(&Integer::new());
    ComplexBall::new(ec + &re, im - &es)
}

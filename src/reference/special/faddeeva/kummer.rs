//! W for moderate |z|: Kummer's series of Dawson's function, in the whole plane.
//!
//! # Formula
//! `w(z) = e^{−z²} + (2i/√π) F(z)` (DLMF 7.5.1) with Dawson's function
//! `F(z) = z ₁F₁(1; 3/2; −z²) = z Σ_k (−2z²)^k/(2k+1)!!` (DLMF 7.6.2 at iz, with
//! `F(z) = (√π/(2i)) e^{−z²} erf(iz)`). Put `v' = −2z² = C v` with a number C = c/2^s not much
//! larger than |v'|, so that `|v| ≤ 1`, and `Σ = P + i q S` with `q = Im v = −4xy/C`
//! ([`super::fixed`]). Then
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
//! The term of index k is at most `C^k/(2k+1)!!` in P (|v| ≤ 1), and at most k times that in S,
//! because `|Im v^k / q| ≤ k |v|^{k−1} ≤ k`. With `T_k = k C^k/(2k+1)!!` and
//! `T_{k+1}/T_k = C (k+1)/(k (2k+3)) ≤ 1/2` for all k ≥ n both tails are at most `2 T_n`. Where
//! that ratio is more than one half at n, `C > n (2n+3)/(2n+2) > n` and `T_n > 5/12`: that is so of
//! n = 1, and `n^{n+1}/(2n+1)!!` grows from 8/15 on. So `2 T_n ≤ 1/2` says that it is not, there
//! and, as it falls, from there on. Any larger C serves for the sum: with `|v'| ≤ c ≤ C < 2c` the
//! terms of P are below `c^k/(2k+1)!!` as well, and those of S, `k C^k |v|^{k−1}/(2k+1)!!`, below
//! `2k` times that. A power of two makes p and q² short; partial sums grow to `e^{C/2}` in place of
//! `e^{|z|²}`, for which digits are added.
//!
//! `T_n` is bounded through `(2n+1)!! = 2^{n+1} Γ(n+3/2)/√π` and `ln Γ(s) ≥ (s − 1/2) ln s − s +
//! ln(2π)/2` (DLMF 5.11.1 with its first omitted term positive, s > 0).
//!
//! # Working precision
//! Both P and the exponential reach `e^{|z|²}` while w is of the order 1/|z| in the upper
//! half-plane: 1.4427 |z|² bits are lost at most, and are added.

use super::argument::{Argument, Member};
use super::fixed;
use super::gaussian::Gaussian;
use crate::{Ball, ComplexBall, Mag};
use rug::Integer;

/// `log2` of an upper bound on `T_n`.
fn tail_log2(c: f64, n: f64) -> f64 {
    let s = n + 1.5;
    let ln_gamma = (s - 0.5) * s.ln() - s + 0.9189385;
    let ln = n * c.ln() + n.ln() - (n + 1.0) * std::f64::consts::LN_2 - ln_gamma + 0.5724;
    ln * std::f64::consts::LOG2_E + 1.0
}

/// The smallest convenient n ≥ 1 with `2 T_n ≤ 2^-bits`, bits > 0: term ratios are below one half
/// there.
fn terms(c: f64, bits: f64) -> u64 {
    let enough = |n: u64| tail_log2(c, n as f64) + 1.0 <= -bits;
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

/// `(c, s)` with `size ≤ c/2^s`, few digits, at most a quarter too large above 1 and a factor of
/// two below (or 2^-32).
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

/// The number `c/2^s`.
fn ratio((c, s): (u64, u32)) -> f64 {
    c as f64 / f64::from(s).exp2()
}

/// Returns the power of two from `c/2^s` on, with which p and q² have as few digits as z², unless
/// full products are cheap or more than an eighth of `bits` digits would be lost to larger terms.
fn short_scale((c, s): (u64, u32), bits: u32) -> (u64, u32) {
    let power = c.next_power_of_two();
    let more = ratio((power - c, s)) / 2.0 * std::f64::consts::LOG2_E;
    match bits >= fixed::MANY && more < f64::from(bits) / 8.0 {
        true => (power, s),
        false => (c, s),
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

    let least = scale(2.0 * size);
    let (c_top, c_down) = short_scale(least, target);
    let doubled = u32::from((c_top, c_down) != least);
    let n = terms(ratio(least), f64::from(target + doubled));
    let growth = (ratio((c_top, c_down)) - ratio(least)) / 2.0 * std::f64::consts::LOG2_E;
    let bits = target + growth.ceil() as u32 + 2 * (64 - n.leading_zeros()) / 2 + 4;
    // Exact if C is a power of two.
    let inverse = match c_top.is_power_of_two() {
        true => Ball::integer(inner, 1).shift(-(c_top.trailing_zeros() as i32)),
        false => &Ball::integer(inner, 1) / &Ball::integer(inner, c_top as i64),
    };
    let inverse = inverse.shift(c_down as i32);
    let (xx, yy) = (x.square(), y.square());
    let p = (&(&yy - &xx) * &inverse).shift(1);
    let (x2, y2) = ((&xx * &inverse).shift(2), (&yy * &inverse).shift(2));
    let q2 = (&x2 * &yy).shift(2) * &inverse;
    let (big_p, big_s) = fixed::sum(&p, &q2, bits, n, |k| (c_top, (2 * k + 3) << c_down));
    let tail = Mag::power_of_two(-i64::from(target));
    let [big_p, big_s] = [big_p, big_s].map(|x| x.with_prec(inner).widened(tail));

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faddeeva::argument::Real;
    use std::f64::consts::LOG2_E;

    /// `log2 (n C^n/(2n+1)!!)`.
    fn exact_log2(c: f64, n: u64) -> f64 {
        let odd: f64 = (1..=n).map(|k| (2.0 * k as f64 + 1.0).ln()).sum();
        ((n as f64).ln() + n as f64 * c.ln() - odd) * LOG2_E
    }

    /// The bound on a term is above it by the bit to spare and what Stirling's formula leaves.
    #[test]
    fn the_tail_is_bounded() {
        for c in [1e-9, 0.25, 1.0, 7.5, 40.0, 1000.0] {
            for n in [1u64, 2, 3, 10, 50, 400, 3000] {
                let more = tail_log2(c, n as f64) - exact_log2(c, n);
                assert!((0.99..1.2).contains(&more), "{c} {n}: {more}");
            }
        }
    }

    /// Where a ratio of terms is above one half, they are not small yet.
    #[test]
    fn small_terms_fall() {
        for n in 1..500u64 {
            let x = n as f64;
            let c = x * (2.0 * x + 3.0) / (2.0 * x + 2.0);
            for c in [c, 1.1 * c, 2.0 * c, 1e3 * c] {
                assert!(exact_log2(c, n) > (0.41f64).log2(), "{c} {n}");
                assert!(tail_log2(c, x) + 1.0 > -0.5);
            }
        }
    }

    /// From the number of terms on, each is at most half of the one before and all add up to less
    /// than asked for; a tenth fewer do not suffice.
    #[test]
    fn terms_suffice_and_are_needed() {
        for c in [1e-9, 0.25, 1.0, 7.5, 40.0, 1000.0] {
            for bits in [2.0, 20.0, 64.0, 300.0, 2000.0] {
                let n = terms(c, bits);
                for k in n..n + 40 {
                    assert!(
                        exact_log2(c, k + 1) <= exact_log2(c, k) - 1.0 + 1e-9,
                        "{c} {bits} {n}"
                    );
                }
                assert!(exact_log2(c, n) + 1.0 <= -bits, "{c} {bits} {n}");
                let fewer = n * 9 / 10;
                let ratio = c * (fewer as f64 + 1.0) / (fewer as f64 * (2.0 * fewer as f64 + 3.0));
                let enough = exact_log2(c, fewer.max(1)) + 3.0 <= -bits && ratio <= 0.5;
                assert!(n <= 8 || !enough, "{c} {bits} {n}");
            }
        }
    }

    #[test]
    fn scales_are_little_too_large() {
        for k in -400..=300 {
            let size = (f64::from(k) / 10.0).exp2();
            let (c, s) = scale(size);
            let more = c as f64 / f64::from(s).exp2() / size;
            let most = match size {
                x if x >= 1.0 => 1.25 + 1e-9,
                x if x >= 2f64.powi(-32) => 2.0 + 1e-9,
                x => 2f64.powi(-32) / x,
            };
            assert!((1.0..=most).contains(&more), "{size}: {c} {s}");
        }
        for size in [0.5, 1.0, 4.0, 15.75, 16.0, 17.0] {
            let (c, s) = scale(size);
            assert!(c as f64 / f64::from(s).exp2() >= size, "{size}");
        }
    }

    /// Any number of bits encloses what the trapezoidal rule gives, with the bits asked for: where
    /// `|v|` is all but 1 and nothing is lost on truncation, beside the axes and off them.
    #[test]
    fn values_are_those_of_the_trapezoidal_rule() {
        let at = |x: f64, y: f64| Argument::new(Real::Double(x), Real::Double(y));
        let q = |x: f64| rug::Rational::from_f64(x).unwrap();
        for norm in [0.1249, 0.49, 3.9999, 8.4999, 20.4999] {
            let r = f64::sqrt(norm);
            for (x, y) in [
                (0.0, r),
                (r, 0.0),
                (r, 1e-9),
                (0.6 * r, 0.8 * r),
                (0.8 * r, -0.6 * r),
            ] {
                let w = crate::faddeeva::trapezoidal::w(&q(x), &q(y), 300);
                let z = ComplexBall::new(Ball::exact(300, x), Ball::exact(300, y));
                let dawson = &w - &(-&z.square()).exp();
                let size = crate::faddeeva::trapezoidal::w(&q(x), &q(y.abs()), 60).magnitude();
                for (member, due) in [(Member::W, &w), (Member::Dawson, &dawson)] {
                    let least = size.max(due.magnitude());
                    for prec in (2..70).chain([200]) {
                        let found = parts(&at(x, y), member, prec);
                        for (found, due) in [(&found.re, &due.re), (&found.im, &due.im)] {
                            // A part that is zero is so exactly.
                            let held =
                                found.contains_ball(due) || found.is_zero() && due.contains_zero();
                            assert!(held, "{x} {y} {prec}: {found:?} {due:?}");
                        }
                        let most = least.shift(-i64::from(prec));
                        assert!(found.radius() <= most, "{x} {y} {prec}: {found:?}");
                    }
                }
            }
        }
    }
}

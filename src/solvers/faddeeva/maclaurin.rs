//! W(z) next to zero.
//!
//! ```text
//! w(z) = Σ (iz)ⁿ/Γ(n/2 + 1)                                             (DLMF 7.6.3)
//! ```
//!
//! In `v = −iz` this is `1 + v (k₁ + k₂v + …)` with real coefficients. With `v² = pv − t` the
//! polynomial is `α + βv` (Knuth, *TAOCP* 2, 4.6.4), and the imaginary part of `v` stays a factor:
//! both components of w keep their relative accuracy beside the axes. There are no fused
//! multiplications, so that any processor runs this without being asked what it can do.

use super::double_double::{fast_two_sum, two_prod};
use super::real::Real;

/// 1/√π.
const INV_SQRT_PI: f64 = 0.564_189_583_547_756_3;

/// `(−1)ⁿ/Γ(n/2 + 1)` for n = 1 … 8.
const K: [f64; 8] = [
    -2.0 * INV_SQRT_PI,
    1.0,
    -4.0 / 3.0 * INV_SQRT_PI,
    1.0 / 2.0,
    -8.0 / 15.0 * INV_SQRT_PI,
    1.0 / 6.0,
    -16.0 / 105.0 * INV_SQRT_PI,
    1.0 / 24.0,
];

/// What is left of `−2/√π` after the first coefficient.
const FIRST_LO: f64 = -2.0 * super::constants::INV_SQRT_PI.lo;

/// Terms of the series.
pub(super) const TERMS: u32 = K.len() as u32 + 1;

/// `k₂v² + k₄v⁴ + k₆v⁶ = α + βv²` for the coefficients from `first` on, every other one, where
/// `v⁴ = pv² − t`.
#[inline(always)]
fn every_other<R: Real>(first: usize, p: R, t: R) -> (R, R) {
    let k = |n: usize| p.like(K[first + n]);
    let b = k(4) + p * k(6);
    (-t * b, (k(2) - t * k(6)) + p * b)
}

/// `v (k₁ + k₂v + …)` with `v² = pv − t`: odd and even terms apart, for half the chain of dependent
/// operations.
#[inline(always)]
fn polynomial<R: Real>((p, t): (R, R), (vr, vi): (R, R)) -> (R, R) {
    let (pp, tt) = (p * p - (t + t), t * t);
    let ((oa, ob), (ea, eb)) = (every_other(0, pp, tt), every_other(1, pp, tt));
    // In powers of v: o = (oa − t ob) + p ob v; k₂v is left to the end with k₁.
    let (oa, ob) = (oa - t * ob, p * ob);
    let (ea, eb) = (ea - t * eb, p * eb);
    // o + v e = α + βv.
    let (alpha, beta) = (oa - t * eb, (ob + ea) + p * eb);
    let beta = p.like(K[1]) + beta;
    let s = p.like(K[0]) + (alpha + p * beta);
    (s * vr - t * beta, s * vi)
}

/// `(Re w, Im w)` at `x + i y` for `|z| < 2⁻⁷`; what is left out is below `0.2 |z|⁸` of a component.
#[inline(always)]
pub(super) fn maclaurin<R: Real>(x: R, y: R) -> (R, R) {
    let (gr, gi) = polynomial((y + y, x * x + y * y), (y, -x));
    (x.like(1.0) + gr, gi)
}

/// `w(iy) = erfcx y` for `|y| < 2⁻⁷`, rounded once at the end. What is rounded before is below
/// `2⁻⁵² y²`, less than the `2⁻⁵³ y` by which the function falls from one number to the next, so that
/// it never grows with y.
#[inline(always)]
pub(super) fn on_imaginary_axis(y: f64) -> f64 {
    let first = two_prod(y, K[0]);
    let mut tail = 0.0;
    for k in K[1..].iter().rev() {
        tail = y.mul_add(tail, *k);
    }
    let tail = (y * y).mul_add(tail, y.mul_add(FIRST_LO, first.lo));
    let sum = fast_two_sum(1.0, first.hi);
    sum.hi + (sum.lo + tail)
}

#[cfg(all(test, feature = "oracle"))]
#[path = "tests/maclaurin.rs"]
mod tests;

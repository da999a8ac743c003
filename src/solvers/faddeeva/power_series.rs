//! W(z) next to zero and far away from it.
//!
//! ```text
//! w(z) = Σ (iz)ⁿ/Γ(n/2 + 1)                                             (DLMF 7.6.3)
//! w(z) ~ i/(√π z) · Σ (2n − 1)!!/2ⁿ z^{−2n}                             (DLMF 7.12.1)
//! ```
//!
//! Both are `h (1 + v (k₁ + k₂v + …))` with real coefficients: `h = 1`, `v = −iz` and
//! `h = i/(√π z)`, `v = 1/z²`. With `v² = pv − t` the polynomial is `α + βv` (Knuth, *TAOCP* 2,
//! 4.6.4), and the imaginary part of `v` stays a factor: both components of w keep their relative
//! accuracy beside the axes. There are no fused multiplications, so that any processor runs this
//! without being asked what it can do.

use super::real::Real;

/// 1/√π.
const INV_SQRT_PI: f64 = 0.564_189_583_547_756_3;

/// `(−1)ⁿ/Γ(n/2 + 1)` for n = 1 … 8.
const ABOUT_ZERO: [f64; 8] = [
    -2.0 * INV_SQRT_PI,
    1.0,
    -4.0 / 3.0 * INV_SQRT_PI,
    1.0 / 2.0,
    -8.0 / 15.0 * INV_SQRT_PI,
    1.0 / 6.0,
    -16.0 / 105.0 * INV_SQRT_PI,
    1.0 / 24.0,
];

/// `(2n − 1)!!/2ⁿ` for n = 1 … 4, exactly.
const ABOUT_INFINITY: [f64; 4] = [0.5, 0.75, 1.875, 6.5625];

/// Terms of either series.
pub(super) const TERMS_NEAR: u32 = ABOUT_ZERO.len() as u32 + 1;
pub(super) const TERMS_FAR: u32 = ABOUT_INFINITY.len() as u32 + 1;

/// `k₀ + k₂v² + … = α + βv²` where the coefficients are those from `first` on, every other one, and
/// `v⁴ = p v² − t`.
#[inline(always)]
fn every_other<R: Real, const N: usize>(k: &[f64; N], first: usize, p: R, t: R) -> (R, R) {
    let like = |n: usize| p.like(k[n]);
    let last = N - 2 + first;
    if last == first + 2 {
        return (like(first), like(last));
    }
    let (mut b1, mut b2) = (like(last - 2) + p * like(last), like(last));
    let mut n = last - 2;
    while n > first + 2 {
        n -= 2;
        let next = p * b1 + (like(n) - t * b2);
        b2 = b1;
        b1 = next;
    }
    (like(first) - t * b2, b1)
}

/// `v (k₁ + k₂v + …)` with `v² = pv − t`: odd and even terms apart, for half the chain of dependent
/// operations.
#[inline(always)]
fn polynomial<R: Real, const N: usize>(k: &[f64; N], (p, t): (R, R), (vr, vi): (R, R)) -> (R, R) {
    let (pp, tt) = (p * p - (t + t), t * t);
    let ((oa, ob), (ea, eb)) = (every_other(k, 0, pp, tt), every_other(k, 1, pp, tt));
    // In powers of v: o = (oa − t ob) + p ob v.
    let (oa, ob) = (oa - t * ob, p * ob);
    let (ea, eb) = (ea - t * eb, p * eb);
    // o + v e = α + βv.
    let (alpha, beta) = (oa - t * eb, (ob + ea) + p * eb);
    let s = alpha + p * beta;
    (s * vr - t * beta, s * vi)
}

/// `(Re w, Im w)` at `x + i y` for `|z| < 2⁻⁷`; what is left out is below `0.2 |z|⁸` of a component.
#[inline(always)]
pub(super) fn near<R: Real>(x: R, y: R) -> (R, R) {
    let (gr, gi) = polynomial(&ABOUT_ZERO, (y + y, x * x + y * y), (y, -x));
    (x.like(1.0) + gr, gi)
}

/// `(Re w, Im w)` at `x + i b`, `b ≥ 0`, for `|z|² ≥ 5000`; what is left out is below
/// `30 |z|⁻¹⁰` of w.
#[inline(always)]
pub(super) fn far<R: Real>(x: R, b: R) -> (R, R) {
    let like = |c: f64| x.like(c);
    // The squares of smaller numbers would be subnormal, which is slow.
    let least = like(1e-140);
    let (m, y) = (x.magnitude().at_least(least), b.at_least(least));
    let (xx, yy) = (m * m, y * y);
    let f = like(INV_SQRT_PI) / (xx + yy);
    let t = f * f * like(std::f64::consts::PI);
    let vr = (xx - yy) * t;
    let vi = x * (y * (like(-2.0) * t));
    let (gr, gi) = polynomial(&ABOUT_INFINITY, (vr + vr, t), (vr, vi));
    let (hr, hi) = (b * f, x * f);
    (hr + (hr * gr - hi * gi), hi + (hr * gi + hi * gr))
}

#[cfg(all(test, feature = "oracle"))]
#[path = "tests/power_series.rs"]
mod tests;

//! W(z) next to zero.
//!
//! ```text
//! w(z) = Σ (iz)ⁿ/Γ(n/2 + 1)                                             (DLMF 7.6.3)
//! ```
//!
//! In `s = −iz = y − ix` the coefficients are real: the sum is `α + βs` with `s² = 2y s − |z|²`.

use super::double_double::{fast_two_sum, two_prod};
use super::real::Real;

/// 2/√π.
const TWO_OVER_SQRT_PI: [f64; 2] = [std::f64::consts::FRAC_2_SQRT_PI, 1.533_545_961_316_588e-17];
/// 1/√π.
const INV_SQRT_PI: f64 = 0.564_189_583_547_756_3;

/// `(−1)ⁿ/Γ(n/2 + 1)` for n = 2 … 9.
const C: [f64; 8] = [
    1.0,
    -4.0 / 3.0 * INV_SQRT_PI,
    1.0 / 2.0,
    -8.0 / 15.0 * INV_SQRT_PI,
    1.0 / 6.0,
    -16.0 / 105.0 * INV_SQRT_PI,
    1.0 / 24.0,
    -32.0 / 945.0 * INV_SQRT_PI,
];

/// Real and imaginary part of `w(a + i y)` for `|z| < 2⁻⁷`.
#[inline(always)]
pub(super) fn maclaurin<R: Real>(a: R, y: R) -> (R, R) {
    let like = |c: f64| a.like(c);
    // s² = p s − t.
    let (p, t) = (y + y, y.fma(y, a * a));
    let minus = -t;
    let (mut b1, mut b2) = (like(C[7]), like(0.0));
    let mut k = 7;
    while k > 1 {
        k -= 1;
        let b = p.fma(b1, minus.fma(b2, like(C[k])));
        b2 = b1;
        b1 = b;
    }
    // c₂ + c₃s + … = α + βs; times s².
    let (alpha, beta) = (minus.fma(b2, like(C[0])), b1);
    // (p s − t)(α + βs) = s(pα + p²β − tβ) − t(α + pβ).
    let factor = p.fma(p.fma(beta, alpha), minus * beta);
    let rest = minus * p.fma(beta, alpha);
    // 1 + c₁s + …: the imaginary part of s is −a.
    let c1 = [like(-TWO_OVER_SQRT_PI[0]), like(-TWO_OVER_SQRT_PI[1])];
    let q = two_prod(c1[0], y);
    let u = fast_two_sum(like(1.0), q.hi);
    let re = u.hi + (u.lo + (q.lo + factor.fma(y, c1[1].fma(y, rest))));
    let q = two_prod(c1[0], -a);
    let im = q.hi + (-a).fma(factor + c1[1], q.lo);
    (re, im)
}

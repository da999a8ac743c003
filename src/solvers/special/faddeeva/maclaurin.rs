//! W(z) next to zero.
//!
//! ```text
//! w(z) = Σ (iz)ⁿ/Γ(n/2 + 1)                                             (DLMF 7.6.3)
//! ```
//!
//! In `v = −iz` this is `1 + k₁v + k₂v² + …` with real coefficients, and with `v² = pv − t` it is
//! `1 + b₁v − t b₂` (Knuth, *TAOCP* 2, 4.6.4), `b_n = k_n + p b_{n+1} − t b_{n+2}`: the imaginary
//! part of v is a factor, and both components of w keep their relative accuracy beside the axes.

use crate::double_double::{fast_two_sum, two_prod};
use crate::real::Real;

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

/// States what is left of `−2/√π` after the first coefficient.
const FIRST_LO: f64 = -2.0 * super::constants::INV_SQRT_PI.lo;

/// `1/m!`, the coefficient of `v^2m`, for m = 1 … 10.
const EVEN: [f64; 10] = {
    let mut table = [1.0; 10];
    let mut factorial = 1.0;
    let mut m = 1;
    while m < 10 {
        factorial *= (m + 1) as f64;
        table[m] = 1.0 / factorial;
        m += 1;
    }
    table
};

/// `−1/Γ(m + 3/2) = −2^{m+1}/(1·3·5⋯(2m + 1) √π)`, that of `v^{2m+1}`, for m = 1 … 9.
const ODD: [f64; 9] = {
    let mut table = [0.0; 9];
    let (mut power, mut product) = (2.0, 1.0);
    let mut m = 0;
    while m < 9 {
        power *= 2.0;
        product *= (2 * m + 3) as f64;
        table[m] = -(power / product * INV_SQRT_PI);
        m += 1;
    }
    table
};

/// `(Re w, Im w)` at `x + i y` for `|z| < 2⁻⁷`; what is left out is below `0.2 |z|⁸` of a
/// component.
#[inline(always)]
pub(super) fn nine_terms<R: Real>(x: R, y: R) -> (R, R) {
    let k = |n: usize| x.like(K[n - 1]);
    let (p, minus) = (y + y, -x.fma(x, y * y));
    let mut next = k(8);
    let mut last = p.fma(next, k(7));
    for n in (2..7).rev() {
        (last, next) = (p.fma(last, minus.fma(next, k(n))), last);
    }
    // b₁ without k₁.
    let rest = p.fma(last, minus * next);
    let small = y.fma(rest, minus * last);
    (x.like(1.0) + y.fma(k(1), small), -x.fma(k(1), x * rest))
}

/// `(Re w, Im w)` at `x + i y` for `|z| < 1/4`; what is left out is below `2⁻⁵⁸` of a component.
///
/// Even and odd powers apart, `w = 1 + c₀v + q (E + vO)` with E and O polynomials in `q = v²`,
/// `q² = sq − t`: half the chain of dependent operations.
#[inline(always)]
pub(super) fn twenty_one_terms<R: Real>(x: R, y: R) -> (R, R) {
    let like = |c: f64| x.like(c);
    let xx = x * x;
    let (q, r2) = (y.fma(y, -xx), y.fma(y, xx));
    let (s, minus) = (q + q, -(r2 * r2));
    let ((e, f), (g, h)) = (
        times_argument(s, minus, &EVEN),
        times_argument(s, minus, &ODD),
    );
    // The remainder of c₀ is added where it costs no operation.
    let (e, g) = (minus * e, minus.fma(g, like(FIRST_LO)));
    // Re v³/y and −Im v³/x.
    let (re3, im3) = (xx.fma(like(-2.0), q), (y * y).fma(like(2.0), q));
    let re = y.fma(re3.fma(h, g), f.fma(q, e));
    let im = (y + y).fma(f, im3.fma(h, g));
    let first = like(K[0]);
    (like(1.0) + y.fma(first, re), -x.fma(first, x * im))
}

/// `α` and `β` with `q Σ c_m q^m = −t α + β q`, where `q² = sq − t`; from s and −t.
#[inline(always)]
fn times_argument<R: Real, const N: usize>(s: R, minus: R, c: &[f64; N]) -> (R, R) {
    let like = |m: usize| s.like(c[m]);
    let (mut last, mut next) = (s.fma(like(N - 1), like(N - 2)), like(N - 1));
    for m in (1..N - 2).rev() {
        (last, next) = (s.fma(last, minus.fma(next, like(m))), last);
    }
    (last, s.fma(last, minus.fma(next, like(0))))
}

/// `w(iy) = erfcx y` for `|y| < 2⁻⁷`, rounded once at the end. What is rounded before is below
/// `2⁻⁵² y²`, less than the `2⁻⁵³ y` by which the function falls from one number to the next, so
/// that it never grows with y.
#[inline(always)]
pub(super) fn on_imaginary_axis<R: Real>(y: R) -> R {
    let like = |c: f64| y.like(c);
    let first = two_prod(y, like(K[0]));
    let mut tail = like(0.0);
    for k in K[1..].iter().rev() {
        tail = y.fma(tail, like(*k));
    }
    let tail = (y * y).fma(tail, y.fma(like(FIRST_LO), first.lo));
    let sum = fast_two_sum(like(1.0), first.hi);
    sum.hi + (sum.lo + tail)
}

#[cfg(test)]
mod tests;

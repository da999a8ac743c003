//! Maclaurin series of odd functions with real coefficients, `f(z) = z (1 + c₁z² + c₂z⁴ + …)`.
//!
//! The polynomial in `q = z²` is summed by Knuth's recurrence (*TAOCP* 2, 4.6.4), which gives its
//! imaginary part with the factor `Im q = 2xy`; so both components of `f` keep their relative
//! accuracy beside the axes and next to zero.

use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use crate::hex::hex;
use crate::real::Real;

/// |z|² up to which the series here are used.
pub(super) const REACH: f64 = 0.5;

/// The coefficients, and what the second one, rounded, lacks.
type Coefficients<const N: usize> = (&'static [f64; N], f64);

/// erf z = (2/√π) f(z).
pub(super) const ERF: Coefficients<16> = (&ERF_TERMS, THIRD_LOW);
/// Dawson's function.
pub(super) const DAWSON: Coefficients<18> = (&DAWSON_TERMS, 2.0 * THIRD_LOW);

/// −1/3 minus its rounded value.
pub(super) const THIRD_LOW: f64 = hex("-0x1.5555555555555p-56");

/// `(−1)ⁿ/(n! (2n + 1))`: erf z = (2/√π) f(z) (DLMF 7.6.1).
const ERF_TERMS: [f64; 16] = {
    let mut c = [1.0; 16];
    let (mut f, mut n) = (1.0, 1);
    while n < 16 {
        f *= -(n as f64);
        c[n] = 1.0 / (f * (2 * n + 1) as f64);
        n += 1;
    }
    c
};

/// `(−2)ⁿ/(2n + 1)!!`: Dawson's function (DLMF 7.6.2 with 7.5.1).
const DAWSON_TERMS: [f64; 18] = {
    let mut c = [1.0; 18];
    // (2n + 1)!! is exact up to n = 13.
    let (mut f, mut two, mut n) = (1.0, 1.0, 1);
    while n < 18 {
        f *= (2 * n + 1) as f64;
        two *= -2.0;
        c[n] = two / f;
        n += 1;
    }
    c
};

/// `x (1 + c₁h + g)`
#[inline(always)]
fn part(x: f64, c: [f64; 2], h: Dd, g: f64) -> Dd {
    let p = two_prod(c[0], h.hi);
    let s = fast_two_sum(1.0, p.hi);
    let lo = c[0].mul_add(h.lo, c[1] * h.hi) + p.lo;
    fast_two_sum(s.hi, s.lo + (lo + g)).mul_f(x)
}

/// Real and imaginary part of `f(x + i y)`; `low` is what `c[1]` lacks.
#[inline(always)]
pub(super) fn odd<const N: usize>((c, low): (&[f64; N], f64), x: f64, y: f64) -> (Dd, Dd) {
    let (xx, yy) = (two_prod(x, x), two_prod(y, y));
    let r2 = xx.hi + yy.hi;
    let t = r2 * r2;
    let s = 2.0 * (x - y) * (x + y);
    let (mut b1, mut b2) = (c[N - 1], 0.0);
    let mut k = N - 1;
    while k > 2 {
        k -= 1;
        let next = s.mul_add(b1, (-t).mul_add(b2, c[k]));
        b2 = b1;
        b1 = next;
    }
    // c₁ + rest is the next one; the product with c₁ is kept apart.
    let (rest, b2) = (s.mul_add(b1, -(t * b2)), b1);
    // x² − 3y² and 3x² − y².
    let triple = |a: Dd, b: Dd| {
        let p = two_prod(-3.0, a.hi);
        let s = two_sum(p.hi, b.hi);
        Dd::new(s.hi, s.lo + (p.lo + (-3.0f64).mul_add(a.lo, b.lo)))
    };
    let (hu, hv) = (triple(yy, xx), -triple(xx, yy));
    let first = [c[1], low];
    (
        part(x, first, hu, hu.hi.mul_add(rest, -(t * b2))),
        part(y, first, hv, hv.hi.mul_add(rest, -(t * b2))),
    )
}

/// `f(x)` on the real axis, |x| ≤ √½; the square's rounding error is made up for.
#[inline(always)]
pub(super) fn odd_real<R: Real, const N: usize>((c, low): (&[f64; N], f64), x: R) -> Dd<R> {
    let like = |c: f64| x.like(c);
    let q = two_prod(x, x);
    let mut p = like(c[N - 1]);
    let mut k = N - 1;
    while k > 2 {
        k -= 1;
        p = q.hi.fma(p, like(c[k]));
    }
    // c₁q with its rounding errors, then the rest.
    let first = two_prod(like(c[1]), q.hi);
    let rest = first.lo + like(c[1]).fma(q.lo, like(low) * q.hi);
    let g = fast_two_sum(first.hi, (q.hi * q.hi).fma(p, rest));
    let h = fast_two_sum(like(1.0), g.hi);
    Dd::new(h.hi, h.lo + g.lo).mul_f(x)
}

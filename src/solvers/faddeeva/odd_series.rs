//! Maclaurin series of odd functions with real coefficients, `f(z) = z (1 + c₁z² + c₂z⁴ + …)`.
//!
//! The polynomial in `q = z²` is summed by Knuth's recurrence (*TAOCP* 2, 4.6.4), which gives its
//! imaginary part with the factor `Im q = 2xy`; so both components of `f` keep their relative
//! accuracy beside the axes and next to zero.

use super::double_double::{Dd, fast_two_sum, two_prod};

/// |z|² up to which the series here are used.
pub(super) const REACH: f64 = 0.5;

/// `(−1)ⁿ/(n! (2n + 1))`: erf z = (2/√π) f(z) (DLMF 7.6.1).
pub(super) const ERF: [f64; 16] = {
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
pub(super) const DAWSON: [f64; 18] = {
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

/// `x (1 + g)`
#[inline(always)]
fn part(x: f64, g: f64) -> Dd {
    fast_two_sum(x, x * g)
}

/// Real and imaginary part of `f(x + i y)`.
#[inline(always)]
pub(super) fn odd<const N: usize>(c: &[f64; N], x: f64, y: f64) -> (Dd, Dd) {
    let (xx, yy) = (x * x, y * y);
    let t = (xx + yy) * (xx + yy);
    let s = 2.0 * (x - y) * (x + y);
    let (mut b1, mut b2) = (c[N - 1], 0.0);
    let mut k = N - 1;
    while k > 1 {
        k -= 1;
        let next = s.mul_add(b1, (-t).mul_add(b2, c[k]));
        b2 = b1;
        b1 = next;
    }
    let gu = (-3.0f64).mul_add(yy, xx).mul_add(b1, -(t * b2));
    let gv = 3.0f64.mul_add(xx, -yy).mul_add(b1, -(t * b2));
    (part(x, gu), part(y, gv))
}

/// `f(x)` on the real axis, |x| ≤ √½; the square's rounding error is made up for.
#[inline(always)]
pub(super) fn odd_real<const N: usize>(c: &[f64; N], x: f64) -> Dd {
    let q = two_prod(x, x);
    let mut p = c[N - 1];
    let mut k = N - 1;
    while k > 2 {
        k -= 1;
        p = q.hi.mul_add(p, c[k]);
    }
    // c₁q with its rounding errors, then the rest.
    let first = two_prod(c[1], q.hi);
    let g = fast_two_sum(first.hi, (q.hi * q.hi).mul_add(p, first.lo + c[1] * q.lo));
    let h = fast_two_sum(1.0, g.hi);
    Dd::new(h.hi, h.lo + g.lo).mul_f(x)
}

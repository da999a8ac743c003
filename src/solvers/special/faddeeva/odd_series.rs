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

/// The coefficients, and what `c₁` and `c₂`, rounded, lack.
type Coefficients<const N: usize> = (&'static [f64; N], [f64; 2]);

/// erf z = (2/√π) f(z).
pub(super) const ERF: Coefficients<16> = (&ERF_TERMS, [THIRD_LOW, TENTH_LOW]);
/// Dawson's function.
pub(super) const DAWSON: Coefficients<18> = (&DAWSON_TERMS, [2.0 * THIRD_LOW, FOUR_FIFTEENTHS_LOW]);

/// −1/3 minus its rounded value.
pub(super) const THIRD_LOW: f64 = hex("-0x1.5555555555555p-56");

/// 1/10 and 4/15 minus their rounded values.
const TENTH_LOW: f64 = hex("-0x1.999999999999ap-58");
const FOUR_FIFTEENTHS_LOW: f64 = hex("0x1.1111111111111p-58");

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

/// The coefficient and what it lacks by a number in two parts.
#[inline(always)]
fn by<R: Real>((c, low): (f64, f64), x: Dd<R>) -> Dd<R> {
    let (c, low) = (x.hi.like(c), x.hi.like(low));
    let p = two_prod(c, x.hi);
    Dd::new(p.hi, c.fma(x.lo, low * x.hi) + p.lo)
}

/// A sum that is not renormalised: enough digits beside a rest of the series in double precision.
#[inline(always)]
fn sum<R: Real>(a: Dd<R>, b: Dd<R>) -> Dd<R> {
    let s = two_sum(a.hi, b.hi);
    Dd::new(s.hi, s.lo + (a.lo + b.lo))
}

/// `b − 3a`: `x² − 3y²` and, negated, `3x² − y²`.
#[inline(always)]
fn triple<R: Real>(a: Dd<R>, b: Dd<R>) -> Dd<R> {
    let minus = a.hi.like(-3.0);
    let p = two_prod(minus, a.hi);
    sum(Dd::new(p.hi, minus.fma(a.lo, p.lo)), b)
}

/// `s = 2(x² − y²)` and `t = (x² + y²)²` of the recurrence, rounded, with what they are rounded
/// from.
#[derive(Clone, Copy)]
struct Powers<R> {
    s: R,
    p: Dd<R>,
    t: R,
    rr: Dd<R>,
}

impl<R: Real> Powers<R> {
    /// `x (1 + c₁h + c₂(hs − t) + …)`: the real part with `h = x² − 3y²`, the imaginary one with y
    /// for x and `h = 3x² − y²`.
    #[inline(always)]
    fn part<const N: usize>(
        self,
        x: R,
        h: Dd<R>,
        (c, low): (&[f64; N], [f64; 2]),
        [first, second]: [R; 2],
    ) -> Dd<R> {
        let hs = two_prod(h.hi, self.s);
        let hs = Dd::new(
            hs.hi,
            h.lo.fma(self.s, x.like(2.0) * (h.hi * self.p.lo)) + hs.lo,
        );
        let one = sum(Dd::from(1.0).like(x), by((c[1], low[0]), h));
        let two = by((c[2], low[1]), sum(hs, -self.rr));
        let three = sum(one, two);
        let rest = h.hi.fma(first, -(self.t * second));
        two_sum(three.hi, three.lo + rest).mul_f(x)
    }
}

/// Real and imaginary part of `f(x + i y)`. Where `Im f` is small beside `y` it is what three terms
/// leave of one another: they are taken in double-double, the rest of the series in double
/// precision.
#[inline(always)]
pub(super) fn odd<R: Real, const N: usize>(
    (c, low): (&[f64; N], [f64; 2]),
    x: R,
    y: R,
) -> (Dd<R>, Dd<R>) {
    let like = |c: f64| x.like(c);
    let (xx, yy) = (two_prod(x, x), two_prod(y, y));
    let (p, r) = (sum(xx, -yy), sum(xx, yy));
    let s = like(2.0) * p.hi;
    let t = r.hi * r.hi;
    let (mut b1, mut b2) = (like(c[N - 1]), like(0.0));
    let mut k = N - 1;
    while k > 3 {
        k -= 1;
        let next = s.fma(b1, (-t).fma(b2, like(c[k])));
        b2 = b1;
        b1 = next;
    }
    // The next one is c₂ + second, and c₁ + sc₂ + first the one after it.
    let second = s.fma(b1, -(t * b2));
    let first = s.fma(second, -(t * b1));
    // (x² + y²)² with its rounding errors.
    let rr = two_prod(r.hi, r.hi);
    let rr = Dd::new(rr.hi, (like(2.0) * r.hi).fma(r.lo, rr.lo));
    let powers = Powers { s, p, t, rr };
    let (c, rest) = ((c, low), [first, second]);
    (
        powers.part(x, triple(yy, xx), c, rest),
        powers.part(y, -triple(xx, yy), c, rest),
    )
}

/// `f(x)` on the real axis, |x| ≤ √½; the square's rounding error is made up for.
#[inline(always)]
pub(super) fn odd_real<R: Real, const N: usize>((c, low): (&[f64; N], [f64; 2]), x: R) -> Dd<R> {
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
    let rest = first.lo + like(c[1]).fma(q.lo, like(low[0]) * q.hi);
    let g = fast_two_sum(first.hi, (q.hi * q.hi).fma(p, rest));
    let h = fast_two_sum(like(1.0), g.hi);
    Dd::new(h.hi, h.lo + g.lo).mul_f(x)
}

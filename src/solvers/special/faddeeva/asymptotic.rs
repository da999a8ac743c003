//! The asymptotic series of W(z) for large |z|.
//!
//! ```text
//! w(z) ~ i/(√π z) · (1 + a₁/z² + a₂/z⁴ + …),   a_n = (2n − 1)!!/2ⁿ      (DLMF 7.12.1)
//! ```
//!
//! The coefficients are real, so that the polynomial in `q = 1/z²` takes two real multiplications
//! for each term (Knuth, *TAOCP* 2, 4.6.4) and its imaginary part comes out with the factor
//! `Im q`: both components of w keep their relative accuracy beside the axes.

use super::constants::{HALF_SQRT_PI, INV_SQRT_PI};
use super::tables::REAL_LINE;
use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use crate::double_double_functions::exp_minus_square;
use crate::lanes::Lanes;
use crate::numbers::One;
use crate::real::{Real, scaled};

/// Coefficients available.
const TERMS: usize = 27;

/// `a_n = (2n − 1)!!/2ⁿ`: every partial product is exact up to `a₁₃`, and rounded afterwards.
const A: [f64; TERMS] = {
    let mut a = [1.0; TERMS];
    let mut n = 1;
    while n < TERMS {
        a[n] = a[n - 1] * (n as f64 - 0.5);
        n += 1;
    }
    a
};

/// `√π`.
const SQRT_PI: f64 = 2.0 * HALF_SQRT_PI.hi;

/// `x (hi + lo)(1 + g)`
#[inline(always)]
fn part<R: Real>(x: R, g: R, hi: R, lo: R) -> Dd<R> {
    let m = two_prod(x, hi);
    fast_two_sum(m.hi, g.fma(m.hi, x.fma(lo, m.lo)))
}

/// `(B, C)` with `a₁q + … + a_N q^N = B q − C t`, where `q² = s q − t`, `N` is even and `c` holds
/// the coefficients.
///
/// Odd and even terms apart, both as polynomials in `q² = ζ`, `ζ² = s₂ζ − t₂`: half the chain of
/// dependent operations.
#[inline(always)]
pub(super) fn polynomial<R: Real, const N: usize>(c: &[f64], s: R, t: R) -> (R, R) {
    let like = |x: f64| s.like(x);
    let (s2, t2) = (s.fma(s, -(t + t)), t * t);
    let minus = -t2;
    let (mut o1, mut o2) = (like(c[N - 1]), like(0.0));
    let (mut e1, mut e2) = (like(c[N]), like(0.0));
    let mut k = N - 2;
    while k > 2 {
        let o = s2.fma(o1, minus.fma(o2, like(c[k - 1])));
        let e = s2.fma(e1, minus.fma(e2, like(c[k])));
        (o2, e2) = (o1, e1);
        (o1, e1) = (o, e);
        k -= 2;
    }
    // a₁ + a₃ζ + … = α + βζ, and the same with the even ones.
    let (oa, ob, ea, eb) = if N > 2 {
        (minus.fma(o2, like(c[1])), o1, minus.fma(e2, like(c[2])), e1)
    } else {
        (o1, o2, e1, e2)
    };
    // In powers of q.
    let (oa, ob) = ((-t).fma(ob, oa), s * ob);
    let (ea, eb) = ((-t).fma(eb, ea), s * eb);
    let b = s.fma(ob + ea, s.fma(s, -t).fma(eb, oa));
    (b, s.fma(eb, ob + ea))
}

/// Real and imaginary part of the series with the terms up to `a_N` for `a = |Re z|`,
/// `b = |Im z|`; `|z|²` between 48 and 2¹⁰⁰⁰.
#[inline(always)]
pub(super) fn series<R: Real, const N: usize>(a: R, b: R) -> (Dd<R>, Dd<R>) {
    let [gu, gv, hi, lo] = factors::<R, N>(a, b);
    (part(b, gu, hi, lo), part(a, gv, hi, lo))
}

/// The same, each part as one number: two roundings, and what the correction adds.
#[inline(always)]
pub(super) fn series_rounded<R: Real, const N: usize>(a: R, b: R) -> (R, R) {
    let (x, y) = (a.raised(LEAST), b.raised(LEAST));
    let [gu, gv, f] = factors_rounded::<R, N>((x * x, y * y), (x.at_least(y), x.at_most(y)));
    let (p, q) = (b * f, a * f);
    (gu.fma(p, p), gv.fma(q, q))
}

/// The same with two terms for `|z| ≥ 1024`: what is left out is below `7a₃ 2⁻⁶⁰`, a tenth of
/// `2⁻⁵³`, of a component.
///
/// With `c = cos 2θ`, θ the argument of z, the real part of `i z̄ q^n/b` is `sin (2n + 1)θ/sin θ`
/// over powers of |z|, for `n = 1, 2` that is `1 + 2c` and `4c² + 2c − 1`; the imaginary part
/// likewise with cosines, `2c − 1` and `4c² − 2c − 1`.
#[inline(always)]
pub(super) fn two_terms<R: Real>(a: R, b: R) -> (R, R) {
    let like = |c: f64| a.like(c);
    let (x, y) = (a.raised(LEAST), b.raised(LEAST));
    let (f, error) = reciprocal(x.at_least(y), x.at_most(y));
    let t = f * like(SQRT_PI);
    let c = (x * x - y * y) * t;
    let (c2, square) = (c + c, (like(4.0) * c).fma(c, like(-1.0)));
    let (h, k) = (t * like(A[1]), t * t * like(A[2]));
    let gu = k.fma(square + c2, h.fma(c2 + like(1.0), error));
    let gv = k.fma(square - c2, h.fma(c2 - like(1.0), error));
    let (p, q) = (b * f, a * f);
    (gu.fma(p, p), gv.fma(q, q))
}

/// The first term alone, which is enough for `|z| ≥ 10^100`, at a point scaled so that its larger
/// coordinate is within [1, 2).
#[inline(always)]
pub(super) fn one_term<R: Real>(a: R, b: R) -> (R, R) {
    let (f, error) = reciprocal(a.at_least(b), a.at_most(b));
    let part = |x: R| error.fma(x * f, x * f);
    (part(b), part(a))
}

/// The same for `a ≥ b`: the real part divided by `b`, and the imaginary part.
#[inline(always)]
pub(super) fn series_beside_real_axis<R: Real, const N: usize>(a: R, b: R) -> (R, R) {
    let y = b.raised(LEAST);
    let [gu, gv, f] = factors_rounded::<R, N>((a * a, y * y), (a, y));
    let q = a * f;
    (gu.fma(f, f), gv.fma(q, q))
}

/// The same for `b` below `2⁻²⁸`, where only the first power of b counts: with `v = 1/a²`
///
/// ```text
/// Im w = (1 + a₁v + a₂v² + …)/(√π a),   Re w/b = (1 + 3a₁v + 5a₂v² + …)/(√π a²)
/// ```
///
/// and the sums are tabulated polynomials.
#[inline(always)]
pub(super) fn series_next_to_real_axis<R: Real>(a: R) -> (R, R) {
    let like = |c: f64| a.like(c);
    let square = two_prod(a, a);
    let f = like(INV_SQRT_PI.hi) / square.hi;
    let rest = (-square.hi).fma(f, like(INV_SQRT_PI.hi));
    let error = (rest + (-f).fma(square.lo, like(INV_SQRT_PI.lo))) * like(SQRT_PI);
    let v = f * like(SQRT_PI);
    let gu = v.fma(by_fours(&REAL_LINE[1], v), error);
    let gv = v.fma(by_fours(&REAL_LINE[0], v), error);
    let q = a * f;
    (gu.fma(f, f), gv.fma(q, q))
}

/// `Σ c_k x^k` by four sums in x⁴: a quarter of the chain of dependent operations.
#[inline(always)]
fn by_fours<R: Real>(c: &[f64; 10], x: R) -> R {
    let at = |k: usize| x.like(c[k]);
    let x2 = x * x;
    let x4 = x2 * x2;
    let p = x4.fma(x4.fma(at(8), at(4)), at(0));
    let q = x4.fma(x4.fma(at(9), at(5)), at(1));
    let s = x4.fma(at(6), at(2));
    let t = x4.fma(at(7), at(3));
    x2.fma(x.fma(t, s), x.fma(q, p))
}

/// Smaller numbers do not count in r², and their squares would be subnormal, which is slow.
const LEAST: f64 = 1e-140;

/// `gu`, `gv` and `f = 1/(√π r²)` as in [`factors`], from a², b² and the larger and the smaller of
/// a and b. `f` is one number; its relative error is part of `gu` and `gv`.
#[inline(always)]
fn factors_rounded<R: Real, const N: usize>((xx, yy): (R, R), (large, small): (R, R)) -> [R; 3] {
    let (f, error) = reciprocal(large, small);
    let [gu, gv] = corrections::<R, N>(xx, yy, f * f * xx.like(std::f64::consts::PI));
    [gu + error, gv + error, f]
}

/// `f = 1/(√π r²)`, rounded, and its relative error, from the larger and the smaller of a and b.
#[inline(always)]
fn reciprocal<R: Real>(large: R, small: R) -> (R, R) {
    let like = |c: f64| large.like(c);
    // r² = hi + lo; the difference is exact (Sterbenz).
    let square = two_prod(large, large);
    let hi = small.fma(small, square.hi);
    let lo = small.fma(small, square.hi - hi) + square.lo;
    let f = like(INV_SQRT_PI.hi) / hi;
    let rest = (-hi).fma(f, like(INV_SQRT_PI.hi)) + (-f).fma(lo, like(INV_SQRT_PI.lo));
    (f, rest * like(SQRT_PI))
}

/// `gu`, `gv` and the two parts of `f = 1/(√π r²)` with `Re w = b f (1 + gu)`,
/// `Im w = a f (1 + gv)`.
#[inline(always)]
fn factors<R: Real, const N: usize>(a: R, b: R) -> [R; 4] {
    let like = |c: f64| a.like(c);
    let (a, b) = (a.raised(LEAST), b.raised(LEAST));
    // r² and 1/(√π r²), as hi + lo.
    let (xx, yy) = (two_prod(a, a), two_prod(b, b));
    let r2 = two_sum(xx.hi, yy.hi);
    let r2_lo = r2.lo + (xx.lo + yy.lo);
    let i0 = like(1.0) / r2.hi;
    let e = (-r2.hi).fma(i0, like(1.0)) - r2_lo * i0;
    let p = two_prod(i0, like(INV_SQRT_PI.hi));
    let inv_lo = p.lo + i0.fma(like(INV_SQRT_PI.lo), p.hi * e);

    let [gu, gv] = corrections::<R, N>(xx.hi, yy.hi, i0 * i0);
    [gu, gv, p.hi, inv_lo]
}

/// `gu` and `gv` from a², b² and `t = 1/r⁴`.
#[inline(always)]
fn corrections<R: Real, const N: usize>(xx: R, yy: R, t: R) -> [R; 2] {
    // q = z̄²/r⁴ satisfies q² = s q − t.
    let s = t.like(2.0) * (xx - yy) * t;
    let (b1, b2) = polynomial::<R, N>(&A, s, t);
    let three = t.like(3.0);
    [
        t * (three * xx - yy).fma(b1, -b2),
        t * (xx - three * yy).fma(b1, -b2),
    ]
}

/// w at `a + i b` without `e^{−z²}`, `4096 ≤ max(a, b)`, both below 10^100, to about 2⁻⁷⁷: the
/// terms 1, 1/(2z²), 3/(4z⁴) and 15/(8z⁶) of the series; the next one is below 2⁻⁹³ of the first.
#[inline(always)]
pub(super) fn four_terms(a: f64, b: f64) -> (Dd, Dd) {
    let r2 = two_prod(a, a) + two_prod(b, b);
    let inv = INV_SQRT_PI.div(r2);
    let t = 1.0 / (r2.hi * r2.hi);
    let s = 2.0 * (a - b) * (a + b) * t;
    let b2 = s.mul_add(A[3], A[2]);
    let b1 = s.mul_add(b2, (-t).mul_add(A[3], A[1]));
    let (aa, bb) = (a * a, b * b);
    let gu = t * (3.0 * aa - bb).mul_add(b1, -b2);
    let gv = t * (aa - 3.0 * bb).mul_add(b1, -b2);
    let part = |x: f64, g: f64| inv.mul_f(x) * Dd::new(1.0, g).normal();
    (part(b, gu), part(a, gv))
}

/// The value at `a − i b`, `4096 ≤ max(a, b) ≤ 2³³²`, where `2e^{−z²}` and the series cancel: in
/// double-double, w(−z) to 2⁻⁷⁷. After it `|2e^{−z²}|`, about.
#[inline(always)]
pub(super) fn large<L: Lanes>(lanes: L, a: f64, b: f64) -> (Dd, Dd, f64) {
    let (u, v) = four_terms(a, b);
    let ((c, s, k), ..) = exp_minus_square(One(lanes), a, b, Dd::ZERO, Dd::ZERO);
    let by = |t: Dd| Dd::new(scaled(t.hi, k + 1.0), scaled(t.lo, k + 1.0));
    (by(c) - u, by(s) + v, scaled(1.0, k + 1.0))
}

#[cfg(test)]
mod tests;

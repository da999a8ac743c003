//! W′(z) in the first quadrant as unevaluated sums, at one point or at several.

use super::branch::ENDS_OF_PAIRS;
use super::branch::modulus_squared;
use super::constants::INV_SQRT_PI;
use super::pairs::{Formulas, Parts};
use super::places::{Choose, Mask, Number, Places, by_ends};
use super::plane::from_erfcx;
use super::quadrant::{CANCELLED, product};
use super::rows::{cell, cell_row, imaginary_axis_row, on_axis, on_real_axis, real_axis_row};
use super::taylor::ComplexRow;
use crate::double_double::{Dd, fast_two_sum, two_prod};
use crate::exponential::{exp_minus_square, exponent, pair_times_power};
use crate::real::{Masked, Real};

/// `(a + i b)(c + i d)`, rounded.
#[inline(always)]
fn times<R: Real>((a, b): (R, R), (c, d): (R, R)) -> (R, R) {
    (a.fma(c, -(b * d)), a.fma(d, b * c))
}

/// The row of the derivative, and the next coefficients, of orders 18 to 20.
///
/// The derivative loses accuracy with the last terms, so the next coefficients are added by
/// `n c_n = −2 (z₀ c_{n−1} + c_{n−2})`, a recurrence unstable only in the long run.
#[inline(always)]
pub(super) fn derived(row: &ComplexRow, centre: (f64, f64)) -> (ComplexRow, [(f64, f64); 3]) {
    let c = &row.0;
    let at = |k: usize| 8 + 8 * (k / 4) + k % 4;
    let mut d = [0.0; 40];
    d[..4].copy_from_slice(&c[4..8]);
    (d[4], d[6]) = (2.0 * c[8], 2.0 * c[12]);
    let mut k = 0;
    while k < 15 {
        let f = (k + 3) as f64;
        d[at(k)] = f * c[at(k + 1)];
        d[at(k) + 4] = f * c[at(k + 1) + 4];
        k += 1;
    }
    // n c_n for n = 18 … 21.
    let mut before = (c[at(14)], c[at(14) + 4]);
    let mut here = (c[at(15)], c[at(15) + 4]);
    let mut next = [(0.0, 0.0); 4];
    for (n, slope) in (18..).zip(next.iter_mut()) {
        let (p, q) = times(centre, here);
        *slope = (-2.0 * (p + before.0), -2.0 * (q + before.1));
        before = here;
        here = (slope.0 / f64::from(n), slope.1 / f64::from(n));
    }
    (d[at(15)], d[at(15) + 4]) = next[0];
    (ComplexRow(d), [next[1], next[2], next[3]])
}

/// The row of the derivative of erfcx about `centre`.
#[inline(always)]
pub(super) fn derived_real(c: &[f64; 20], centre: f64) -> [f64; 20] {
    let mut d = [0.0; 20];
    (d[0], d[1], d[2]) = (c[2], c[3], 2.0 * c[4]);
    let mut k = 0;
    while k < 15 {
        d[4 + k] = (k + 3) as f64 * c[5 + k];
        k += 1;
    }
    // n c_n = 2 (s₀ c_{n−1} + c_{n−2}), n = 18.
    d[19] = 2.0 * centre.mul_add(c[19], c[18]);
    d
}

/// The derivative of rows at distance δ from their centres.
#[inline(always)]
fn complex_derivative<P: Places>(
    places: P,
    row: impl Fn(f64) -> &'static ComplexRow,
    n: Number<P>,
    centre: (Number<P>, Number<P>),
    delta: (Number<P>, Number<P>),
) -> Parts<Number<P>> {
    let ((u, v), next) = places.complex_slopes(row, n, centre, delta);
    let (p, q) = times(delta, next[2]);
    let (p, q) = times(delta, (p + next[1].0, q + next[1].1));
    let square = times(delta, delta);
    let eighth = times(times(square, square), times(square, square));
    let more = times(
        times(times(eighth, eighth), square),
        (p + next[0].0, q + next[0].1),
    );
    (
        fast_two_sum(u.hi, u.lo + more.0),
        fast_two_sum(v.hi, v.lo + more.1),
    )
}

/// Coefficients available.
const TERMS: usize = 36;

/// `(2n + 1) a_n`, `a_n = (2n − 1)!!/2ⁿ`.
const SLOPE: [f64; TERMS] = {
    let mut c = [1.0; TERMS];
    let (mut a, mut n) = (1.0, 1);
    while n < TERMS {
        a *= n as f64 - 0.5;
        c[n] = a * (2 * n + 1) as f64;
        n += 1;
    }
    c
};

/// The derivative of the asymptotic series, `|z|²` between 48 and 10²⁰⁰:
///
/// ```text
/// w′(z) ~ −(i/√π) q (1 + 3 a₁ q + 5 a₂ q² + …),   q = 1/z²
/// ```
#[inline(always)]
pub(super) fn series_derivative<R: Real, const N: usize>(a: R, b: R) -> Parts<R> {
    let like = |c: f64| a.like(c);
    let r2 = two_prod(a, a) + two_prod(b, b);
    let t2 = Dd::new(like(1.0), like(0.0)).div(r2);
    let qr = (-exponent(a, b)) * t2 * t2;
    let qi = two_prod(like(-2.0) * a, b) * t2 * t2;
    let t = t2.hi * t2.hi;
    let s = like(2.0) * qr.hi;
    let (mut b1, mut b2) = (like(SLOPE[N]), like(0.0));
    let mut k = N;
    while k > 2 {
        k -= 1;
        let next = s.fma(b1, (-t).fma(b2, like(SLOPE[k])));
        b2 = b1;
        b1 = next;
    }
    // The sum is 1 + 3a₁q + p + i Im(q) b1; 3a₁q² is formed with all digits, because the real
    // part of q is as small next to the diagonal.
    let (b1, b2) = (s.fma(b1, -(t * b2)), b1);
    let p = qr.hi.fma(b1, -(t * b2));
    let first = (qr * qr - qi * qi) * Dd::new(like(SLOPE[1]), like(0.0));
    let both = like(2.0 * SLOPE[1]);
    let re = qi * Dd::new(qr.hi.fma(b1 + both, p), like(0.0)).add_f(like(1.0));
    let im = qr + first.add_f(qr.hi.fma(p, -(qi.hi * qi.hi * b1)));
    let factor = INV_SQRT_PI.like(a);
    (re * factor, -(im * factor))
}

/// [`series_derivative`] with the number of terms that `|z|` needs, in the places `among`.
#[inline(always)]
pub(super) fn far_derivative<R: Masked>(a: R, b: R, among: R::Mask) -> Parts<R> {
    by_ends!(modulus_squared(a, b), among;
        ENDS_OF_PAIRS[1] => series_derivative::<_, 35>(a, b),
        ENDS_OF_PAIRS[2] => series_derivative::<_, 15>(a, b),
        ENDS_OF_PAIRS[3] => series_derivative::<_, 7>(a, b),
        ENDS_OF_PAIRS[4] => series_derivative::<_, 3>(a, b)
    )
}

/// `(Re w′, Im w′)` at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`, in the places `among`; `true` where a
/// component has lost digits.
#[inline(always)]
pub(super) fn derivative<P: Places>(
    places: P,
    a: Number<P>,
    b: Number<P>,
    among: Mask<P>,
) -> (Parts<Number<P>>, Mask<P>) {
    let like = |c: f64| a.like(c);
    let formulas = Formulas::of(a, b, among);
    let larger = a.at_least(b);
    let mut value = Choose::none(a);
    let mut less = a.except(among, among);
    if a.any(formulas.in_cell) {
        let [n, dx, dy] = cell(a, b);
        let (u, v) = complex_derivative(places, cell_row, n, (a - dx, b - dy), (dx, dy));
        // Next to the origin the slope is large beside the value.
        let part = a.pick(larger.below(like(2.0)), like(0.4), like(CANCELLED));
        let (p, q) = (u.hi.magnitude(), v.hi.magnitude());
        let lost = a.or(p.below(part * q), q.below(part * p));
        less = a.both(formulas.in_cell, lost);
        value = (u, v).or_else(formulas.in_cell, value);
    }
    if a.any(formulas.on_imaginary) {
        // w′(z) = −i f′(−iz), f = erfcx.
        let (n, t) = on_axis(b);
        let slopes = places.real_slopes(imaginary_axis_row, n, b - t, (t, a));
        let (re, im) = from_erfcx(a, slopes);
        value = (im, -re).or_else(formulas.on_imaginary, value);
    }
    if a.any(formulas.on_real) {
        let (n, t) = on_real_axis(a);
        let parts = complex_derivative(places, real_axis_row, n, (a - t, like(0.0)), (t, b));
        value = parts.or_else(formulas.on_real, value);
    }
    if a.any(formulas.beyond) {
        let (u, v) = far_derivative(a, b, formulas.beyond);
        // Next to the diagonal all terms but the first are rounded; from 4096 on only those of
        // third order.
        let (p, q) = (u.hi.magnitude(), v.hi.magnitude());
        let part = a.pick(
            larger.below(like(4096.0)),
            like(1.0 / 32.0),
            p * like(1.0 / 65536.0),
        );
        let lost = a.both(q.below(p * part), like(1.0).below(b));
        less = a.or(
            less,
            a.both(a.except(formulas.beyond, formulas.strip), lost),
        );
        let mut parts = (u, v);
        if a.any(formulas.strip) {
            let (c, s, n) = exp_minus_square(a, b);
            let minus = (Dd::new(-a, like(0.0)), Dd::new(-b, like(0.0)));
            let (p, q, _) = product((c, s), minus);
            let n = n + like(1.0);
            let sum = (u + pair_times_power(p, n), v + pair_times_power(q, n));
            parts = sum.or_else(formulas.strip, parts);
        }
        value = parts.or_else(formulas.beyond, value);
    }
    (value, less)
}

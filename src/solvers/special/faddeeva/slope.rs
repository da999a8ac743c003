//! W′(z) in the first quadrant as unevaluated sums, at one point or at several.

use super::asymptotic::polynomial;
use super::branch::{ENDS_OF_PAIRS, modulus_squared};
use super::constants::INV_SQRT_PI;
use super::pairs::{Formulas, Parts};
use super::places::{Choose, Mask, Number, Places, by_ends};
use super::quadrant::product;
use super::rows::{cell, cell_row, imaginary_axis_row, on_axis, on_real_axis, real_axis_row};
use super::taylor::SLOPE;
use crate::double_double::{Dd, two_prod};
use crate::exponential::{exp_minus_square, exponent, pair_times_power};
use crate::real::{Masked, Real};

/// A component smaller than this part of the other one has lost digits to it: of the terms of the
/// Taylor expansions only those from the third order on are rounded, of those of the series in
/// `1/z²` those from the third on.
const CANCELLED: f64 = 1.0 / 256.0;

/// Coefficients available.
const TERMS: usize = 37;

/// `3a₁`, `a_n = (2n − 1)!!/2ⁿ`.
const FIRST: f64 = 1.5;
/// `(2n + 1) a_n` from the second on.
const COEFFICIENTS: [f64; TERMS] = {
    let mut c = [0.0; TERMS];
    let (mut a, mut n) = (1.0, 1);
    while n < TERMS {
        a *= n as f64 - 0.5;
        if n > 1 {
            c[n] = a * (2 * n + 1) as f64;
        }
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
    let (b1, b2) = polynomial::<R, N>(&COEFFICIENTS, s, t);
    // The sum is 1 + 3a₁q + p + i Im(q) b1; 3a₁q² is formed with all digits, because the real
    // part of q is as small next to the diagonal.
    let p = qr.hi.fma(b1, -(t * b2));
    let first = (qr * qr - qi * qi) * Dd::new(like(FIRST), like(0.0));
    let both = like(2.0 * FIRST);
    let re = qi * Dd::new(qr.hi.fma(b1 + both, p), like(0.0)).add_f(like(1.0));
    let im = qr + first.add_f(qr.hi.fma(p, -(qi.hi * qi.hi * b1)));
    let factor = INV_SQRT_PI.like(a);
    (re * factor, -(im * factor))
}

/// [`series_derivative`] with the number of terms that `|z|` needs, in the places `among`.
#[inline(always)]
pub(super) fn far_derivative<R: Masked>(a: R, b: R, among: R::Mask) -> Parts<R> {
    by_ends!(modulus_squared(a, b), among;
        ENDS_OF_PAIRS[1] => series_derivative::<_, 36>(a, b),
        ENDS_OF_PAIRS[2] => series_derivative::<_, 16>(a, b),
        ENDS_OF_PAIRS[3] => series_derivative::<_, 8>(a, b),
        ENDS_OF_PAIRS[4] => series_derivative::<_, 4>(a, b)
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
        let (u, v) = places.summed_rows::<SLOPE>(cell_row, n, (a - dx, b - dy), (dx, dy));
        let part = like(CANCELLED);
        let (p, q) = (u.hi.magnitude(), v.hi.magnitude());
        let lost = a.or(p.below(part * q), q.below(part * p));
        less = a.both(formulas.in_cell, lost);
        value = (u, v).or_else(formulas.in_cell, value);
    }
    if a.any(formulas.on_imaginary) {
        let (n, t) = on_axis(b);
        let parts = places.summed_real_rows::<SLOPE>(imaginary_axis_row, n, b - t, (t, a));
        value = parts.or_else(formulas.on_imaginary, value);
    }
    if a.any(formulas.on_real) {
        let (n, t) = on_real_axis(a);
        let parts = places.summed_rows::<SLOPE>(real_axis_row, n, (a - t, like(0.0)), (t, b));
        value = parts.or_else(formulas.on_real, value);
    }
    if a.any(formulas.beyond) {
        let (u, v) = far_derivative(a, b, formulas.beyond);
        // Next to the diagonal all terms but the first are rounded; from 4096 on only those of
        // third order.
        let (p, q) = (u.hi.magnitude(), v.hi.magnitude());
        let part = a.pick(
            larger.below(like(4096.0)),
            like(CANCELLED),
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

//! W(z) and W′(z) in the first quadrant as unevaluated sums, for the functions that are built on
//! them.

use super::asymptotic::four_terms;
use super::branch::{
    CELL, IMAGINARY_AXIS, IN_STRIP, REAL_AXIS, ROWS_ON_REAL_AXIS, SERIES_6, SERIES_14, SERIES_26,
    formula_of_pairs, modulus_squared, series_of_pairs,
};
use super::constants::INV_SQRT_PI;
use super::pairs;
use super::places::One;
use super::plane::from_erfcx;
use super::rows::{
    dawson_row, imaginary_axis_row, in_cell, on_axis, on_axis_of_dawson, on_real_axis,
    real_axis_row,
};
use super::taylor::{ComplexRow, RealRow, complex_row, real_row};
use super::trapezoidal;
use crate::double_double::{Dd, fast_two_sum, two_prod};
use crate::double_double_functions as exact;
pub(super) use crate::exponential::{circle, exp_wide, gaussian, pair_times_power, times_power};
use crate::exponential::{exp_minus_square_any, exponent};
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::real::ROUND;

/// A sum smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 6.0;

/// Returns whether a sum has lost digits against one of its two terms.
#[inline(always)]
pub(super) fn lost(sum: Dd, term: Dd) -> bool {
    sum.hi.abs() < CANCELLED * term.hi.abs()
}

/// The binary exponent of `t 2^k`, `n = ROUND + k`; that of zero is very low.
#[inline(always)]
pub(super) fn size(t: f64, n: f64) -> f64 {
    ((t.to_bits() >> 52) & 0x7ff) as f64 - 1023.0 + (n - ROUND)
}

/// The product of two complex numbers; `true` if the terms of a component cancel.
#[inline(always)]
pub(super) fn product((a, b): (Dd, Dd), (c, d): (Dd, Dd)) -> (Dd, Dd, bool) {
    let (ac, ad) = (a * c, a * d);
    let (re, im) = (ac - b * d, ad + b * c);
    (re, im, lost(re, ac) | lost(im, ad))
}

/// A coordinate so small that a function is linear in it, raised by 2³⁰⁰ so that its products keep
/// all digits, and the exponent to subtract again. Where the other one is large, by 2⁶⁰, so that
/// the phase stays small: everything that grows with it has overflowed there.
#[inline(always)]
pub(super) fn lifted(x: f64, other: f64) -> (f64, f64) {
    const SMALL: f64 = hex("0x1p-400");
    const LARGE: f64 = hex("0x1p40");
    const FAR_UP: f64 = hex("0x1p300");
    const UP: f64 = hex("0x1p60");
    if x >= SMALL {
        return (x, 0.0);
    }
    match other < LARGE {
        true => (x * FAR_UP, 300.0),
        false => (x * UP, 60.0),
    }
}

/// `(Re w, Im w)` at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`.
#[inline(always)]
pub(super) fn w<L: Lanes>(lanes: L, a: f64, b: f64) -> (Dd, Dd) {
    pairs::w(One(lanes), a, b, true)
}

/// `(a + i b)(c + i d)`, rounded.
#[inline(always)]
fn times((a, b): (f64, f64), (c, d): (f64, f64)) -> (f64, f64) {
    (a.mul_add(c, -(b * d)), a.mul_add(d, b * c))
}

/// The derivative of a row at distance δ from its centre.
///
/// The derivative loses accuracy with the last terms, so the next coefficients are added by
/// `n c_n = −2 (z₀ c_{n−1} + c_{n−2})`, a recurrence unstable only in the long run.
#[inline(always)]
fn complex_derivative<L: Lanes>(
    lanes: L,
    row: &ComplexRow,
    centre: (f64, f64),
    (dx, dy): (f64, f64),
) -> (Dd, Dd) {
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
    let delta = (dx, dy);
    let (p, q) = times(delta, next[3]);
    let (p, q) = times(delta, (p + next[2].0, q + next[2].1));
    let square = times(delta, delta);
    let eighth = times(times(square, square), times(square, square));
    let more = times(
        times(times(eighth, eighth), square),
        (p + next[1].0, q + next[1].1),
    );
    let (u, v) = complex_row(lanes, &ComplexRow(d), dx, dy);
    (
        fast_two_sum(u.hi, u.lo + more.0),
        fast_two_sum(v.hi, v.lo + more.1),
    )
}

/// The row of the derivative of erfcx about `centre`.
#[inline(always)]
fn derived_real(row: &RealRow, centre: f64) -> RealRow {
    let c = &row.0;
    let mut d = [0.0; 20];
    (d[0], d[1], d[2]) = (c[2], c[3], 2.0 * c[4]);
    let mut k = 0;
    while k < 15 {
        d[4 + k] = (k + 3) as f64 * c[5 + k];
        k += 1;
    }
    // n c_n = 2 (s₀ c_{n−1} + c_{n−2}), n = 18.
    d[19] = 2.0 * centre.mul_add(c[19], c[18]);
    RealRow(d)
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
pub(super) fn series_derivative<const N: usize>(a: f64, b: f64) -> (Dd, Dd) {
    let r2 = two_prod(a, a) + two_prod(b, b);
    let t2 = Dd::from(1.0).div(r2);
    let qr = (-exponent(a, b)) * t2 * t2;
    let qi = two_prod(-2.0 * a, b) * t2 * t2;
    let t = t2.hi * t2.hi;
    let s = 2.0 * qr.hi;
    let (mut b1, mut b2) = (SLOPE[N], 0.0);
    let mut k = N;
    while k > 2 {
        k -= 1;
        let next = s.mul_add(b1, (-t).mul_add(b2, SLOPE[k]));
        b2 = b1;
        b1 = next;
    }
    // The sum is 1 + 3a₁q + p + i Im(q) b1; 3a₁q² is formed with all digits, because the real
    // part of q is as small next to the diagonal.
    let (b1, b2) = (s.mul_add(b1, -(t * b2)), b1);
    let p = qr.hi.mul_add(b1, -(t * b2));
    let first = (qr * qr - qi * qi) * Dd::from(SLOPE[1]);
    let both = 2.0 * SLOPE[1];
    let re = qi * Dd::from(qr.hi.mul_add(b1 + both, p)).add_f(1.0);
    let im = qr + first.add_f(qr.hi.mul_add(p, -(qi.hi * qi.hi * b1)));
    (re * INV_SQRT_PI, -(im * INV_SQRT_PI))
}

/// [`series_derivative`] with the number of terms that `|z|` needs.
#[inline(always)]
pub(super) fn far_derivative(a: f64, b: f64) -> (Dd, Dd) {
    match series_of_pairs(a, b) {
        SERIES_26 => series_derivative::<35>(a, b),
        SERIES_14 => series_derivative::<15>(a, b),
        SERIES_6 => series_derivative::<7>(a, b),
        _ => series_derivative::<3>(a, b),
    }
}

/// `(Re w′, Im w′)` at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`; `true` if a component has lost digits.
#[inline(always)]
pub(super) fn derivative<L: Lanes>(lanes: L, a: f64, b: f64) -> (Dd, Dd, bool) {
    match formula_of_pairs(a, b) {
        CELL => {
            let (row, dx, dy) = in_cell(a, b);
            let (u, v) = complex_derivative(lanes, row, (a - dx, b - dy), (dx, dy));
            // Next to the origin the slope is large beside the value.
            let part = if a.max(b) < 2.0 { 0.4 } else { CANCELLED };
            let (p, q) = (u.hi.abs(), v.hi.abs());
            (u, v, (p < part * q) | (q < part * p))
        }
        IMAGINARY_AXIS => {
            // w′(z) = −i f′(−iz), f = erfcx.
            let (n, t) = on_axis(b);
            let row = derived_real(imaginary_axis_row(n), b - t);
            let (re, im) = from_erfcx(a, real_row(lanes, &row, t, a));
            (im, -re, false)
        }
        REAL_AXIS => {
            let (n, t) = on_real_axis(a);
            let (u, v) = complex_derivative(lanes, real_axis_row(n), (a - t, 0.0), (t, b));
            (u, v, false)
        }
        IN_STRIP => {
            let (u, v) = far_derivative(a, b);
            let (c, s, n) = exp_minus_square_any(a, b);
            let (p, q, _) = product((c, s), (Dd::from(-a), Dd::from(-b)));
            let by = |t: Dd| pair_times_power(t, n + 1.0);
            (u + by(p), v + by(q), false)
        }
        _ => {
            let (u, v) = far_derivative(a, b);
            // Next to the diagonal all terms but the first are rounded; from 4096 on only those of
            // third order.
            let part = if a.max(b) < 4096.0 {
                1.0 / 32.0
            } else {
                u.hi.abs() * (1.0 / 65536.0)
            };
            (u, v, (v.hi.abs() < u.hi.abs() * part) & (b > 1.0))
        }
    }
}

/// `(2/√π) F(t + i b)`, `F` Dawson's function: real part, and imaginary part, `½ ≤ t < 10¹⁰⁰`,
/// `b ≤` [`STRIP`].
#[inline(always)]
pub(super) fn dawson_in_strip<L: Lanes>(lanes: L, t: f64, b: f64) -> (Dd, Dd) {
    if modulus_squared(t, 0.0) < ROWS_ON_REAL_AXIS[1] {
        let (n, dx) = on_axis_of_dawson(t);
        let (re, im) = real_row(lanes, dawson_row(n), dx, b);
        return (re, im.mul_f(b));
    }
    // (2/√π) F = −i (w − e^{−z²}).
    let (u, v) = pairs::far(t, b, true);
    (v, -u)
}

/// w at `a + i b`, `a, b ≥ 0`, `|z| < 10¹⁰⁰`, in double-double; to about 2⁻¹⁰⁰ of the larger
/// component, from 4096 on to 2⁻⁷⁷.
#[inline(always)]
pub(super) fn w_exact<L: Lanes>(lanes: L, a: f64, b: f64) -> (Dd, Dd) {
    if a.max(b) < 4096.0 {
        lanes.call(trapezoidal::Upper { a, b })
    } else {
        four_terms(a, b)
    }
}

/// `e^{−z²}` at `a + i y` in double-double. A function of its own, as [`trapezoidal::Upper`].
struct ExpMinusSquare {
    a: f64,
    y: f64,
}

impl Task for ExpMinusSquare {
    type Output = exact::Gaussian;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> exact::Gaussian {
        exact::exp_minus_square(lanes, self.a, -self.y, Dd::ZERO, Dd::ZERO).0
    }
}

/// `e^{−z²}` at `a + i y` as mantissas and `ROUND` plus the exponent, in double-double where it
/// matters.
#[inline(always)]
pub(super) fn gaussian_exact<L: Lanes>(lanes: L, a: f64, y: f64) -> (Dd, Dd, f64) {
    if exponent(a, y).hi.abs() < 1400.0 {
        lanes.call(ExpMinusSquare { a, y })
    } else {
        gaussian(a, y)
    }
}

//! Which formula computes W(z) where.

use super::asymptotic::{large, series};
use super::double_double::{Dd, fast_two_sum, two_sum};
use super::exponential::{exp, exp_minus_square, exponent, scaled};
use super::tables::{CELL, CELLS, IMAGINARY_AXIS, REAL_AXIS};
use super::taylor::{complex_row, real_row};
use super::{special, trapezoidal, zeros};

/// |z|² from which the asymptotic series is used.
pub(super) const FAR: f64 = 49.0;
/// |z|² from which the series needs 13, 6, 2 terms instead of 23.
pub(super) const TERMS_13: f64 = 100.0;
pub(super) const TERMS_6: f64 = 1000.0;
pub(super) const TERMS_2: f64 = 1e6;
/// |z|² above this is scaled first.
pub(super) const HUGE: f64 = 1e200;
/// Half-width of the strip beside the real axis in which `e^{−z²}` is added to the asymptotic
/// series, and of the first row of cells.
pub(super) const STRIP: f64 = 0.125;
/// Where the fine cells end: the larger of |Re z|, |Im z|.
pub(super) const FINE: f64 = 3.75;
/// Re z from which the strip beside the real axis takes `e^{−x²}` apart.
pub(super) const APART: f64 = 1.125;
/// A component smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 16.0;

/// w in the closed first quadrant, `a² + b² < FAR`, except beside the real axis.
#[inline(always)]
pub(super) fn near(a: f64, b: f64) -> (Dd, Dd) {
    let fine = a.max(b) < FINE;
    let (column, step, base) = if fine {
        (STRIP, 4.0, 0)
    } else {
        (2.0 * STRIP, 2.0, 256)
    };
    if a < column {
        let n = (b * 4.0 + 0.5) as usize;
        let (p, s) = real_row(&IMAGINARY_AXIS[n.min(28)], b - n as f64 * 0.25, a);
        let (m, e) = (-a * s.hi, -a);
        let lo = e.mul_add(s.lo, e.mul_add(s.hi, -m));
        return (p, fast_two_sum(m, lo));
    }
    let (i, j) = ((a * step + 0.5) as usize, (b * step + 0.5) as usize);
    let row = &CELLS[CELL[(base + 16 * j + i) & 511] as usize];
    let unit = 1.0 / step;
    complex_row(row, a - i as f64 * unit, b - j as f64 * unit)
}

/// w beside the real axis, `|y|` below the first row of cells, `APART ≤ a`, `a² + y² < FAR`:
/// `w = e^{−z²} + i D(z)` with a function D that is real on the axis. Returns the terms of the
/// real part and the imaginary part.
#[inline(always)]
pub(super) fn beside_real_axis(a: f64, y: f64) -> (Dd, Dd, Dd) {
    let n = (a * 4.0 + 0.5) as usize;
    let (p, s) = real_row(&REAL_AXIS[n.min(28)], a - n as f64 * 0.25, y);
    let (c, e, k) = exp_minus_square::<false>(a, y);
    let factor = scaled(1.0, k);
    let (c, e) = (c.scale(factor), e.scale(factor));
    let m = -y * s.hi;
    let lo = (-y).mul_add(s.lo, (-y).mul_add(s.hi, -m));
    let v = two_sum(p.hi, e.hi);
    (c, Dd::new(m, lo), fast_two_sum(v.hi, v.lo + (p.lo + e.lo)))
}

/// The asymptotic series with as many terms as |z|² needs.
#[inline(always)]
pub(super) fn far(a: f64, b: f64, r2: f64) -> (Dd, Dd) {
    if r2 < TERMS_13 {
        series::<23>(a, b)
    } else if r2 < TERMS_6 {
        series::<13>(a, b)
    } else if r2 < TERMS_2 {
        series::<6>(a, b)
    } else {
        series::<2>(a, b)
    }
}

/// `e^{y² − a²} cos 2ay` in the strip beyond FAR, where it matters only if `2ay` is small.
#[inline(always)]
pub(super) fn strip_term(a: f64, y: f64) -> f64 {
    let (e, k) = exp(exponent(a, y));
    let t = (2.0 * a * y).abs().min(0.5);
    let tt = t * t;
    let cos = tt.mul_add(tt.mul_add(tt.mul_add(-1.0 / 720.0, 1.0 / 24.0), -0.5), 0.0);
    scaled(e.hi + e.hi.mul_add(cos, e.lo), k.max(-1100))
}

/// Both components of W, added up, and whether either one lost too many digits.
#[inline(always)]
fn reflect(u: Dd, v: Dd, c: Dd, s: Dd, k: i32) -> (f64, f64, bool) {
    if k >= 200 {
        // W(−z) is below half a unit in the last place, whatever the cosine.
        return (scaled(c.hi, k + 1), scaled(s.hi, k + 1), false);
    }
    let factor = scaled(1.0, k + 1);
    let add = |t: Dd, x: Dd| {
        let s = two_sum(t.hi * factor, x.hi);
        s.hi + (s.lo + t.lo.mul_add(factor, x.lo))
    };
    let (re, im) = (add(c, -u), add(s, v));
    let lost = re.abs() < CANCELLED * u.hi || im.abs() < CANCELLED * v.hi;
    (re, im, lost)
}

/// w in the lower half-plane where terms cancel.
#[inline(never)]
fn cancelled(a: f64, b: f64) -> (f64, f64) {
    if let Some(k) = zeros::nearest(a, b) {
        if let Some((re, im)) = zeros::near_zero(k, a, b) {
            return (re.value(), im.value());
        }
    }
    let (re, im) = if a.max(b) < 4096.0 {
        trapezoidal::lower(a, b)
    } else {
        large(a, b)
    };
    (re.value(), im.value())
}

/// `2^64 e^{b² − a²}` is below `u` for certain.
#[inline(always)]
fn negligible(e: f64, u: f64) -> bool {
    let binary = ((u.to_bits() >> 52) & 0x7ff) as f64 - 1023.0;
    e * std::f64::consts::LOG2_E + 66.0 < binary
}

/// `(Re w, Im w)` at `a − i b`, `a, b ≥ 0`, given those of the mirror image `a + i b`.
#[inline(always)]
fn lower(a: f64, b: f64, u: Dd, v: Dd) -> (f64, f64) {
    if negligible(exponent(a, b).hi, u.hi.min(v.hi)) {
        return (-u.hi, v.hi);
    }
    let (c, s, k) = exp_minus_square::<true>(a, -b);
    let (re, im, lost) = reflect(u, v, c, s, k);
    if lost { cancelled(a, b) } else { (re, im) }
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, for any `y`.
#[inline(always)]
pub(super) fn right_half_plane(a: f64, y: f64) -> (f64, f64) {
    let b = y.abs();
    let r2 = a.mul_add(a, b * b);
    if r2 < FAR {
        let strip = if a < FINE { STRIP } else { 2.0 * STRIP };
        if b < strip && a >= APART {
            let (c, t, v) = beside_real_axis(a, y);
            let u = two_sum(c.hi, t.hi);
            let re = u.hi + (u.lo + (c.lo + t.lo));
            if re.abs() < CANCELLED * c.hi {
                return cancelled(a, b);
            }
            return (re, v.hi);
        }
        let (u, v) = near(a, b);
        return if y >= 0.0 {
            (u.hi, v.hi)
        } else {
            lower(a, b, u, v)
        };
    }
    if !(r2 < HUGE) {
        return special::huge(a, y);
    }
    let (u, v) = far(a, b, r2);
    if b < STRIP {
        if a > 27.5 {
            return (if y.is_sign_negative() { -u.hi } else { u.hi }, v.hi);
        }
        let t = strip_term(a, b);
        if y >= 0.0 {
            return (u.hi + t, v.hi);
        }
        let re = t - u.hi;
        if re.abs() < CANCELLED * u.hi {
            return cancelled(a, b);
        }
        return (re, v.hi);
    }
    if y >= 0.0 {
        (u.hi, v.hi)
    } else {
        lower(a, b, u, v)
    }
}

/// `(Re w, Im w)` at `x + i y`.
#[inline(always)]
pub(super) fn w(x: f64, y: f64) -> (f64, f64) {
    let (re, im) = right_half_plane(x.abs(), y);
    // w(−z̄) is the conjugate of w(z).
    (re, if x.is_sign_negative() { -im } else { im })
}

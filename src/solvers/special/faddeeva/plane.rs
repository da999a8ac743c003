//! W(z) on the whole plane, point by point, by the formulas that [`branch`](super::branch) chooses.

use super::asymptotic::{
    large, series, series_beside_real_axis, series_next_to_real_axis, series_rounded, two_terms,
};
use super::branch::{
    CELL, IN_STRIP, LOWER_CELL, MACLAURIN_9, MACLAURIN_21, REAL_AXIS, REAL_LINE, SERIES_2,
    SERIES_4, SERIES_6, SERIES_14, SERIES_26, SURELY_BELOW_HUGE, SURELY_FARTHEST, SURELY_NEAREST,
    TINY, formula_at,
};
use super::long_w::{self, turned, vanishing_part};
use super::maclaurin::{self, nine_terms, twenty_one_terms};
use super::places::One;
use super::reflection::{
    ALONE, DOMINANT, NEGLIGIBLE, close, decay, exponential_dominates, image_dominates, negligible,
    reflect,
};
use super::rows::{
    above_real_axis, below_real_axis, disc_cell, disc_row, imaginary_axis_row, in_cell,
    nearest_zero, on_axis, on_real_axis, real_axis_row, zero_row,
};
use super::taylor::{axis_row, complex_row, complex_row_rounded};
use super::{special, trapezoidal, zeros};
use crate::double_double::{Dd, two_prod};
use crate::exponential::{
    exp_minus_square_any, exp_rounded, exponent_in_strip, gaussian, times_power,
};
use crate::lanes::{Lanes, Task, with_best};
use crate::real::{ROUND, Real, scaled, with_sign_of};

/// Above `2⁵⁵ |e^{−z²}|` in the strip.
const BESIDE: f64 = 2.5e-19;
/// The binary exponent added to both terms there.
const LIFT: f64 = 200.0;
/// The parts of their terms below which components are computed again in double-double: in the
/// strip beside the real axis by rows, and by the series.
const CANCELLED_BESIDE: f64 = 0.15;
const CANCELLED_ROUNDED: f64 = 0.6;
/// Im z below which `|e^{−z²}|` may be beyond e^1000.
const DEEP: f64 = -31.0;

/// Binary exponents of `e^{−z²}` from which both components overflow, however close the phase is to
/// a multiple of π/2.
const OVERFLOWS: f64 = 1200.0;

/// Returns whether the terms of the real part of w cancel beside the real axis: `e^{−x²}` and
/// `y D′(x)`, which is about `y Im w/x`.
#[inline(always)]
pub(super) fn cancels_beside_real_axis<R: Real>(a: R, y: R, re: R, im: R) -> R::Mask {
    let part = -y * im * a.like(CANCELLED_BESIDE);
    (re.magnitude() * a).below(part)
}

/// w in the strip beside the real axis from the asymptotic series and `e^{y² − a²} cos 2ay`, which
/// matters only where `2ay` is so small that the cosine is 1; `true` where the terms cancel.
#[inline(always)]
pub(super) fn in_strip<R: Real>(a: R, y: R) -> (R, R, R::Mask) {
    let series = series_beside_real_axis::<R, 16>(a, y.magnitude());
    with_exponential(series, y, exponent_in_strip(a, y))
}

/// The same next to the real axis.
#[inline(always)]
pub(super) fn on_real_line<R: Real>(a: R, y: R) -> (R, R, R::Mask) {
    let square = two_prod(a, a);
    with_exponential(
        series_next_to_real_axis(a),
        y,
        Dd::new(-square.hi, -square.lo),
    )
}

/// `y u + e^t` and `v`; `true` where the terms cancel.
#[inline(always)]
fn with_exponential<R: Real>((u, v): (R, R), y: R, t: Dd<R>) -> (R, R, R::Mask) {
    let like = |c: f64| y.like(c);
    let part = y * u;
    let negligible = like(BESIDE).below(part.magnitude());
    if y.all(negligible) {
        return (part, v, v.below(like(0.0)));
    }
    // |y| u is at most BESIDE here and u at least 7e-4, so that the phase 2ay is below 2e-14 and
    // its cosine 1. Both terms raised, because operations with subnormal numbers are slow.
    let (e, n) = exp_rounded(t);
    let t = e * (n + like(LIFT)).power_of_two();
    let y = y * like(ROUND + LIFT).power_of_two();
    let re = y.fma(u, t);
    // The terms have opposite signs if y is negative.
    let larger = t.at_least(-(y * u));
    let lost = re.magnitude().below(larger * like(CANCELLED_ROUNDED));
    let re = re * like(ROUND - LIFT).power_of_two();
    (y.pick(negligible, part, re), v, lost)
}

/// w in the lower half-plane where terms cancel, at `a − i b`.
pub(super) struct Cancelled {
    pub a: f64,
    pub b: f64,
}

impl Task for Cancelled {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let Cancelled { a, b } = self;
        let (re, im, e) = if a.max(b) < 4096.0 {
            trapezoidal::lower(One(lanes), a, b)
        } else {
            large(lanes, a, b)
        };
        // w(−z) is about (b + i a)/|z|².
        let (r2, part) = (a.mul_add(a, b * b), vanishing_part(a, b));
        let least = |w: f64, e: f64| part * e.max(w / r2);
        if (re.hi.abs() < least(b, e)) | (im.hi.abs() < least(a, e * turned(a, b))) {
            return long_w::lower(a, b);
        }
        (re.value(), im.value())
    }
}

/// `Re w` at `i b`, `b ≥ 0`, where it must not grow with b: from pairs of `f64`, rounded once.
#[inline(always)]
fn on_imaginary_axis<L: Lanes>(lanes: L, b: f64) -> f64 {
    let re = match formula_at(0.0, b) {
        CELL | MACLAURIN_21 => {
            let (n, t) = on_axis(b);
            axis_row(lanes, imaginary_axis_row(n), t)
        }
        SERIES_26 => series::<_, 26>(0.0, b).0,
        SERIES_14 => series::<_, 14>(0.0, b).0,
        SERIES_6 | SERIES_4 | SERIES_2 => series::<_, 6>(0.0, b).0,
        MACLAURIN_9 => return maclaurin::on_imaginary_axis(b),
        _ => return special::on_imaginary_axis(b),
    };
    re.hi
}

/// `(Re w, Im w)` at `a + i b`, `a ≥ 0`, `b ≥ 0`.
#[inline(always)]
fn upper<L: Lanes>(lanes: L, a: f64, b: f64) -> (f64, f64) {
    if a == 0.0 && b < f64::INFINITY {
        return (on_imaginary_axis(lanes, b), 0.0);
    }
    match formula_at(a, b) {
        CELL => {
            let (row, dx, dy) = in_cell(a, b);
            complex_row_rounded(lanes, row, dx, dy)
        }
        REAL_AXIS => {
            let (n, t) = on_real_axis(a);
            complex_row_rounded(lanes, real_axis_row(n), t, above_real_axis(b))
        }
        IN_STRIP => {
            let (re, im, _) = in_strip(a, b);
            (re, im)
        }
        REAL_LINE => {
            let (re, im, _) = on_real_line(a, b);
            (re, im)
        }
        SERIES_26 => series_rounded::<_, 26>(a, b),
        SERIES_14 => series_rounded::<_, 14>(a, b),
        SERIES_6 => series_rounded::<_, 6>(a, b),
        SERIES_4 => series_rounded::<_, 4>(a, b),
        SERIES_2 => two_terms(a, b),
        MACLAURIN_9 => nine_terms(a, b),
        MACLAURIN_21 => twenty_one_terms(a, b),
        // The others are for the lower half-plane.
        _ => special::huge(a, b),
    }
}

/// Im w, which is +0 at `a = 0`: erfcx falls everywhere, so that Im w grows with a.
#[inline(always)]
fn on_axis_zero(a: f64, im: f64) -> f64 {
    if a == 0.0 { 0.0 } else { im }
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, `y < 0`.
#[inline(always)]
fn lower<L: Lanes>(lanes: L, a: f64, y: f64) -> (f64, f64) {
    // So close to the axis Im w is proportional to a, and the phase 2ay may be subnormal. Further
    // down e^{y²} times the smallest phase is above the range.
    let lift = if a < TINY && y > -40.0 { 60.0 } else { 0.0 };
    let (re, im, n) = below(lanes, a * (lift + ROUND).power_of_two(), y);
    match (n - ROUND, lift) {
        (0.0, 0.0) => (re, im),
        (0.0, _) => (re, on_axis_zero(a, scaled(im, ROUND - lift))),
        _ => (
            times_power(re, n),
            on_axis_zero(a, times_power(im, n - lift)),
        ),
    }
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, `y < 0`, divided by `2^k`, and `ROUND + k`.
#[inline(always)]
fn below<L: Lanes>(lanes: L, a: f64, y: f64) -> (f64, f64, f64) {
    let b = -y;
    let done = |(re, im): (f64, f64)| (re, im, ROUND);
    let unless_lost = |(re, im, lost): (f64, f64, bool)| match lost {
        true => done(lanes.call(Cancelled { a, b })),
        false => (re, im, ROUND),
    };
    let formula = formula_at(a, y);
    let decay = decay(a, y);
    if formula == CELL && decay.abs() > DOMINANT {
        let (row, dx, dy) = in_cell(a, b);
        let image = complex_row_rounded(lanes, row, dx, dy);
        return match decay > 0.0 {
            true => done(image_dominates(image, a, y)),
            false => unless_lost(exponential_dominates(image, a, y)),
        };
    }
    if formula == SERIES_26 && decay > DOMINANT {
        let (u, v) = series_rounded::<_, 26>(a, b);
        return done(match decay > NEGLIGIBLE {
            true => (-u, v),
            false => image_dominates((u, v), a, y),
        });
    }
    if let Some(k) = nearest_zero(a, b) {
        let near = zeros::near_zero(lanes, zero_row(k), a, b);
        return done(match near {
            Some(w) => w,
            None => lanes.call(Cancelled { a, b }),
        });
    }
    let (u, v) = match formula {
        CELL => {
            let (row, dx, dy) = in_cell(a, b);
            complex_row(lanes, row, dx, dy)
        }
        SERIES_26 => series::<_, 26>(a, b),
        SERIES_14 => series::<_, 14>(a, b),
        SERIES_6 => series::<_, 6>(a, b),
        REAL_AXIS => {
            let (n, t) = on_real_axis(a);
            let (re, im) = complex_row(lanes, real_axis_row(n), t, below_real_axis(y));
            let lost = cancels_beside_real_axis(a, y, re.hi, im.hi);
            return unless_lost((re.hi, im.hi, lost));
        }
        MACLAURIN_9 if a == 0.0 => return done((maclaurin::on_imaginary_axis(y), 0.0)),
        MACLAURIN_9 => return done(nine_terms(a, y)),
        MACLAURIN_21 => return done(twenty_one_terms(a, y)),
        LOWER_CELL => {
            let [n, dx, dy] = disc_cell(a, y);
            return done(complex_row_rounded(lanes, disc_row(n), dx, dy));
        }
        IN_STRIP => return unless_lost(in_strip(a, y)),
        REAL_LINE => return unless_lost(on_real_line(a, y)),
        _ => return done(special::huge(a, y)),
    };
    // In the cells, 1 ≤ |z|² < 48, 2⁶⁸ |e^{−z²}| is above 1/2 and u or v below.
    if formula != CELL && negligible(a, b, u.hi, v.hi) {
        return done((-u.hi, v.hi));
    }
    // A subnormal part of z, and so of w, times e^1400 may still be in range.
    let (c, s, n) = match y < DEEP {
        true => gaussian(a, y),
        false => exp_minus_square_any(a, y),
    };
    if n >= ROUND + ALONE {
        // W(−z) is below half a unit in the last place, whatever the cosine.
        let close = close(a, b);
        if (c.hi.abs() < close) | (s.hi.abs() < close) && n < ROUND + OVERFLOWS {
            return done(long_w::lower(a, b));
        }
        return (c.value(), s.value(), n + 1.0);
    }
    unless_lost(reflect((u, v), (c, s, n), close(a, b)))
}

/// The half-planes as functions of their own, so that the points that need few instructions do not
/// make room for the registers of the others. Like [`W`] they have the bits of the point, because
/// these tell which formula it needs: a branch taken wrongly costs the more, the later that is
/// known.
struct Upper(u64, u64);
struct Lower(u64, u64);

impl Task for Upper {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let [x, y] = [self.0, self.1].map(f64::from_bits);
        let (re, im) = upper(lanes, x.abs(), y.abs());
        (re, with_sign_of(im, x))
    }
}

impl Task for Lower {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let [x, y] = [self.0, self.1].map(f64::from_bits);
        let (re, im) = lower(lanes, x.abs(), y);
        (re, with_sign_of(im, x))
    }
}

/// W(z) at `x + i y`, by the bits of x and y.
struct W(u64, u64);

impl Task for W {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        w_of_bits(lanes, self.0, self.1)
    }
}

/// `(Re w, Im w)` at `x + i y`, with the best instructions of this processor.
#[inline(always)]
pub(super) fn w_with_best(x: f64, y: f64) -> (f64, f64) {
    with_best(W(x.to_bits(), y.to_bits()))
}

/// `(Re w, Im w)` at `x + i y`.
#[inline(always)]
pub(super) fn w<L: Lanes>(lanes: L, x: f64, y: f64) -> (f64, f64) {
    w_of_bits(lanes, x.to_bits(), y.to_bits())
}

/// `(Re w, Im w)` at `x + i y`, by the bits of x and y. w(−z̄) is the conjugate of w(z).
#[inline(always)]
fn w_of_bits<L: Lanes>(lanes: L, x: u64, y: u64) -> (f64, f64) {
    // Twice the bits: without the sign.
    const NEAREST: u64 = SURELY_NEAREST.to_bits() << 1;
    const FARTHEST: u64 = SURELY_FARTHEST.to_bits() << 1;
    const BELOW_HUGE: u64 = SURELY_BELOW_HUGE.to_bits() << 1;
    let (p, q) = (x << 1, y << 1);
    let larger = p.max(q);
    if larger < NEAREST && p > 0 {
        return nine_terms(f64::from_bits(x), f64::from_bits(y));
    }
    // Below zero: not −0. A NaN with a minus sign passes too, and gives NaN there as well.
    if y > 1 << 63 {
        return lanes.call(Lower(x, y));
    }
    if larger.wrapping_sub(FARTHEST) < BELOW_HUGE - FARTHEST && p > 0 {
        let x = f64::from_bits(x);
        let (re, im) = two_terms(x.abs(), f64::from_bits(y).abs());
        return (re, with_sign_of(im, x));
    }
    lanes.call(Upper(x, y))
}

//! Which formula computes W(z) where.

use super::asymptotic::{large, series};
use super::double_double::{Dd, fast_two_sum, two_sum};
use super::exponential::{binary_exponent, exp, exp_minus_square, exp_minus_square_any, exponent};
use super::lanes::{Lanes, Task};
use super::real::{ROUND, Real, scaled};
use super::tables::{CELL, CELLS, IMAGINARY_AXIS, REAL_AXIS};
use super::taylor::{complex_row, real_row};
use super::{special, trapezoidal, zeros};

/// |z|² from which the asymptotic series is used.
const FAR: f64 = 49.0;
/// |z|² from which the series needs 13, 6, 2 terms instead of 23.
const TERMS_13: f64 = 100.0;
const TERMS_6: f64 = 1000.0;
const TERMS_2: f64 = 1e6;
/// |z|² above this is scaled first.
const HUGE: f64 = 1e200;
/// Half the distance of the centres of the fine cells; also half the width of the strip beside the real axis
/// in which `e^{−z²}` is added to the asymptotic series.
const STRIP: f64 = 0.125;
/// Where the fine cells end: the larger of |Re z|, |Im z|.
const FINE: f64 = 3.75;
/// Re z from which the strip beside the real axis takes `e^{−z²}` apart.
const APART: f64 = 1.125;
/// Re z beyond which `e^{−z²}` is below every `f64` in the strip.
const GONE: f64 = 27.5;
/// A component smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 16.0;
/// Powers of two from which `2e^{−z²}` stands alone.
pub(super) const ALONE: f64 = 200.0;

/// The formula for W(z) in the closed upper half-plane, or beside the real axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    Cell,
    ImaginaryAxis,
    RealAxis,
    Series23,
    Series13,
    Series6,
    Series2,
    Strip23,
    Strip13,
    Other,
}

impl Kind {
    pub(super) const COUNT: usize = 10;
}

/// The formula at `|z| = a + i b`.
#[inline(always)]
pub(super) fn kind(a: f64, b: f64) -> Kind {
    let r2 = a.mul_add(a, b * b);
    if r2 < FAR {
        let width = if a.max(b) < FINE { STRIP } else { 2.0 * STRIP };
        if a < width {
            Kind::ImaginaryAxis
        } else if (b < width) & (a >= APART) {
            Kind::RealAxis
        } else {
            Kind::Cell
        }
    } else if (b < STRIP) & (a < GONE) {
        if r2 < TERMS_13 {
            Kind::Strip23
        } else {
            Kind::Strip13
        }
    } else if r2 < TERMS_13 {
        Kind::Series23
    } else if r2 < TERMS_6 {
        Kind::Series13
    } else if r2 < TERMS_2 {
        Kind::Series6
    } else if r2 < HUGE {
        Kind::Series2
    } else {
        Kind::Other
    }
}

/// `ROUND` plus the column and row of the cell around `a + i b`, and the distance from its centre.
#[inline(always)]
pub(super) fn cell<R: Real>(a: R, b: R) -> [R; 4] {
    let fine = a.at_least(b).below(a.like(FINE));
    let step = a.pick(fine, a.like(4.0), a.like(2.0));
    let unit = a.pick(fine, a.like(-0.25), a.like(-0.5));
    let round = a.like(ROUND);
    let (i, j) = (a.fma(step, round), b.fma(step, round));
    [i, j, (i - round).fma(unit, a), (j - round).fma(unit, b)]
}

/// The row of the cell in column `i`, row `j`.
#[inline(always)]
pub(super) fn cell_row(a: f64, b: f64, i: f64, j: f64) -> usize {
    let base = if a.max(b) < FINE { 0 } else { 256 };
    let at = base + (j.to_bits() as usize & 15) * 16 + (i.to_bits() as usize & 15);
    CELL[at] as usize
}

/// `ROUND` plus the number of the centre on an axis next to `x`, and the distance from it.
#[inline(always)]
pub(super) fn on_axis<R: Real>(x: R) -> (R, R) {
    let round = x.like(ROUND);
    let n = x.fma(x.like(4.0), round);
    (n, (n - round).fma(x.like(-0.25), x))
}

/// The row of centre `n` on an axis.
#[inline(always)]
pub(super) fn axis_row(n: f64) -> usize {
    (n.to_bits() as usize & 31).min(28)
}

/// `(Re w, Im w)` from the expansion of `w(i s) = erfcx s` about a real centre.
#[inline(always)]
pub(super) fn from_erfcx<R: Real>(a: R, (p, s): (Dd<R>, Dd<R>)) -> (Dd<R>, Dd<R>) {
    let minus = -a;
    let m = minus * s.hi;
    (p, fast_two_sum(m, minus.fma(s.lo, minus.fma(s.hi, -m))))
}

/// w beside the real axis from `e^{−z²}` and the expansion of `D`, real on the axis, with
/// `w = e^{−z²} + i D(z)`; `true` where the terms of the real part cancel.
#[inline(always)]
pub(super) fn from_dawson<R: Real>(a: R, y: R, (p, s): (Dd<R>, Dd<R>)) -> (R, R, R::Mask) {
    let (c, e, n) = exp_minus_square(a, y);
    let factor = n.power_of_two();
    let (c, e) = (
        Dd::new(c.hi * factor, c.lo * factor),
        Dd::new(e.hi * factor, e.lo * factor),
    );
    let minus = -y;
    let m = minus * s.hi;
    let lo = minus.fma(s.lo, minus.fma(s.hi, -m));
    let u = two_sum(c.hi, m);
    let re = u.hi + (u.lo + (c.lo + lo));
    let v = two_sum(p.hi, e.hi);
    let im = v.hi + (v.lo + (p.lo + e.lo));
    (
        re,
        im,
        re.magnitude().below(c.hi.magnitude() * a.like(CANCELLED)),
    )
}

/// w in the strip beside the real axis from the series (`u`, `v` at `a + i b`) and
/// `e^{b² − a²} cos 2ab`, which matters only if `2ab` is small; `true` where the terms cancel.
#[inline(always)]
pub(super) fn in_strip<R: Real>(a: R, y: R, u: R, v: R) -> (R, R, R::Mask) {
    let (e, n) = exp(exponent(a, y));
    let t = ((a + a) * y).magnitude().at_most(a.like(0.5));
    let tt = t * t;
    let cos = tt
        * tt.fma(
            tt.fma(a.like(-1.0 / 720.0), a.like(1.0 / 24.0)),
            a.like(-0.5),
        );
    let t = scaled(
        e.hi + e.hi.fma(cos, e.lo),
        n.at_least(a.like(ROUND - 1100.0)),
    );
    let lower = y.below(a.like(0.0));
    let re = t + y.pick(lower, -u, u);
    (re, v, re.magnitude().below(u * a.like(CANCELLED)))
}

/// `t · factor + x`
#[inline(always)]
fn scaled_sum<R: Real>(t: Dd<R>, factor: R, x: Dd<R>) -> R {
    let s = two_sum(t.hi * factor, x.hi);
    s.hi + (s.lo + t.lo.fma(factor, x.lo))
}

/// `(Re w, Im w)` at `a − i b` from those at `a + i b` and `e^{−z²} = (c + i s) 2^k`, `n = ROUND + k`,
/// `k` below [`ALONE`]; `true` where the terms of a component cancel.
#[inline(always)]
pub(super) fn reflect<R: Real>(
    (u, v): (Dd<R>, Dd<R>),
    (c, s, n): (Dd<R>, Dd<R>, R),
) -> (R, R, R::Mask) {
    let factor = (n + n.like(1.0)).power_of_two();
    let (re, im) = (scaled_sum(c, factor, -u), scaled_sum(s, factor, v));
    let part = n.like(CANCELLED);
    let lost = n.or(
        re.magnitude().below(u.hi * part),
        im.magnitude().below(v.hi * part),
    );
    (re, im, lost)
}

/// Whether `2e^{−z²}` is below 2⁻⁶⁶ of both components of w(−z).
#[inline(always)]
pub(super) fn negligible<R: Real>(a: R, b: R, u: R, v: R) -> R::Mask {
    let e = exponent(a, b).hi.at_least(a.like(-708.0));
    let (_, n) = binary_exponent(e.at_most(a.like(0.0)));
    let small = (n + n.like(68.0)).power_of_two();
    small.below(u.at_most(v))
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
        if let Some(k) = zeros::nearest(a, b)
            && let Some((re, im)) = zeros::near_zero(lanes, k, a, b)
        {
            return (re.value(), im.value());
        }
        let (re, im) = if a.max(b) < 4096.0 {
            trapezoidal::lower(a, b)
        } else {
            large(a, b)
        };
        (re.value(), im.value())
    }
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, for any `y`.
#[inline(always)]
pub(super) fn right_half_plane<L: Lanes>(lanes: L, a: f64, y: f64) -> (f64, f64) {
    let b = y.abs();
    let kind = kind(a, b);
    let lower = y < 0.0;
    let (u, v) = match kind {
        Kind::Cell => {
            let [i, j, dx, dy] = cell(a, b);
            complex_row(lanes, &CELLS[cell_row(a, b, i, j)], dx, dy)
        }
        Kind::ImaginaryAxis => {
            let (n, t) = on_axis(b);
            from_erfcx(a, real_row(lanes, &IMAGINARY_AXIS[axis_row(n)], t, a))
        }
        Kind::RealAxis => {
            let (n, t) = on_axis(a);
            let row = real_row(lanes, &REAL_AXIS[axis_row(n)], t, y);
            let (re, im, lost) = from_dawson(a, y, row);
            return if lost {
                lanes.call(Cancelled { a, b })
            } else {
                (re, im)
            };
        }
        Kind::Series23 => series::<_, 23>(a, b),
        Kind::Series13 => series::<_, 13>(a, b),
        Kind::Series6 => series::<_, 6>(a, b),
        Kind::Series2 => series::<_, 2>(a, b),
        Kind::Strip23 | Kind::Strip13 => {
            let (u, v) = if kind == Kind::Strip23 {
                series::<_, 23>(a, b)
            } else {
                series::<_, 13>(a, b)
            };
            let (re, im, lost) = in_strip(a, y, u.hi, v.hi);
            return if lost {
                lanes.call(Cancelled { a, b })
            } else {
                (re, im)
            };
        }
        Kind::Other => return special::huge(a, y),
    };
    if !lower {
        return (u.hi, v.hi);
    }
    if negligible(a, b, u.hi, v.hi) {
        return (-u.hi, v.hi);
    }
    let (c, s, n) = exp_minus_square_any(a, y);
    if n >= ROUND + ALONE {
        // W(−z) is below half a unit in the last place, whatever the cosine.
        let n = n + 1.0;
        return (scaled(c.value(), n), scaled(s.value(), n));
    }
    let (re, im, lost) = reflect((u, v), (c, s, n));
    if lost {
        lanes.call(Cancelled { a, b })
    } else {
        (re, im)
    }
}

/// `(Re w, Im w)` at `x + i y`.
#[inline(always)]
pub(super) fn w<L: Lanes>(lanes: L, x: f64, y: f64) -> (f64, f64) {
    let (re, im) = right_half_plane(lanes, x.abs(), y);
    // w(−z̄) is the conjugate of w(z).
    (re, if x.is_sign_negative() { -im } else { im })
}

//! Which formula computes W(z) where.

use super::asymptotic::{large, series, series_beside_real_axis};
use super::double_double::{Dd, fast_two_sum, two_sum};
use super::exponential::{
    binary_exponent, exp_minus_square_any, exp_rounded, exponent, exponent_in_strip,
};
use super::lanes::{Lanes, Task};
use super::maclaurin::maclaurin;
use super::real::{ROUND, Real, scaled};
use super::tables::{CELL, CELLS, DISC, IMAGINARY_AXIS, REAL_AXIS};
use super::taylor::{ComplexRow, RealRow, complex_row, real_row};
use super::{special, trapezoidal, zeros};

/// |z|² from which the asymptotic series is used.
const FAR: f64 = 49.0;
/// |z|² from which the series needs 14, 6 terms instead of 24.
const TERMS_14: f64 = 100.0;
const TERMS_6: f64 = 1000.0;
/// |z|² above this is scaled first.
const HUGE: f64 = 1e200;
/// Half the distance of the centres of the fine cells, and half the width of the strip beside the
/// real axis.
/// Just above 1/8: the edge itself, halfway between two centres, is inside; no cell begins there.
const STRIP: f64 = 0.125f64.next_up();
/// Where the fine cells end: the larger of |Re z|, |Im z|.
const FINE: f64 = 3.75;
/// Re z from which the strip has rows of its own, and from which it has the asymptotic series with
/// `e^{−z²}` added.
const APART: f64 = 1.125;
const BEYOND: f64 = 9.0;
/// Re z beyond which `e^{−z²}` is below every `f64` in the strip.
const GONE: f64 = 27.5;
/// |z|² below which the Maclaurin series is used.
const SMALL: f64 = 1.0 / 16384.0;
/// |z|² below which cells of the lower half-plane are tabulated.
const DISC_EDGE: f64 = 1.0;
/// A component smaller than this part of its terms is computed again in double-double.
const CANCELLED: f64 = 1.0 / 8.0;
/// Powers of two from which `2e^{−z²}` stands alone.
pub(super) const ALONE: f64 = 200.0;

/// The formula for W(z). Up to [`Kind::Series6`] it gives `w(a + i|y|)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    Cell,
    ImaginaryAxis,
    Series24,
    Series14,
    Series6,
    Small,
    Disc,
    RealAxis,
    Strip,
    Other,
}

/// A formula for W(z).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Branch {
    /// Maclaurin series.
    Maclaurin {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about the centre of a cell.
    Cell {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about the centre of a cell in the lower half-plane, `|z| < 1`.
    LowerCell {
        /// Terms.
        terms: u32,
    },
    /// Taylor series of erfcx about a centre on the imaginary axis.
    ImaginaryAxis {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about a centre on the real axis, on either side of it.
    RealAxis {
        /// Terms.
        terms: u32,
    },
    /// Asymptotic series and `e^{−z²}`, on either side of the real axis.
    Strip {
        /// Terms.
        terms: u32,
    },
    /// Asymptotic series.
    Asymptotic {
        /// Terms.
        terms: u32,
    },
    /// Taylor series about zero number `zero` (from 1) in the lower half-plane.
    Zero {
        /// The number of the zero, by modulus.
        zero: u32,
        /// Terms.
        terms: u32,
    },
    /// `i/(√π z)`, scaled; and everything that is not finite.
    Huge,
}

/// The formula at `a + i y`, `a ≥ 0`.
pub(super) fn branch(a: f64, y: f64) -> Branch {
    if y < 0.0
        && let Some(k) = zeros::nearest(a, -y)
    {
        return Branch::Zero {
            zero: k as u32 + 1,
            terms: 21,
        };
    }
    match kind(a, y) {
        Kind::Small => Branch::Maclaurin { terms: 10 },
        Kind::Cell => Branch::Cell { terms: 18 },
        Kind::Disc => Branch::LowerCell { terms: 18 },
        Kind::ImaginaryAxis => Branch::ImaginaryAxis { terms: 18 },
        Kind::RealAxis => Branch::RealAxis { terms: 18 },
        Kind::Strip => Branch::Strip { terms: 16 },
        Kind::Series24 => Branch::Asymptotic { terms: 24 },
        Kind::Series14 => Branch::Asymptotic { terms: 14 },
        Kind::Series6 => Branch::Asymptotic { terms: 6 },
        Kind::Other => Branch::Huge,
    }
}

/// Half the width of the strip beside the imaginary axis.
#[inline(always)]
fn axis_width(a: f64, b: f64) -> f64 {
    if a.max(b) < FINE { STRIP } else { 2.0 * STRIP }
}

/// The formula at `a + i y`, `a ≥ 0`.
#[inline(always)]
pub(super) fn kind(a: f64, y: f64) -> Kind {
    let b = y.abs();
    let r2 = a.mul_add(a, b * b);
    if (b < STRIP) & (APART..GONE).contains(&a) {
        if a < BEYOND {
            Kind::RealAxis
        } else {
            Kind::Strip
        }
    } else if r2 < FAR {
        if r2 < SMALL {
            Kind::Small
        } else if (y < 0.0) & (r2 < DISC_EDGE) {
            Kind::Disc
        } else if a < axis_width(a, b) {
            Kind::ImaginaryAxis
        } else {
            Kind::Cell
        }
    } else if r2 < TERMS_14 {
        Kind::Series24
    } else if r2 < TERMS_6 {
        Kind::Series14
    } else if r2 < HUGE {
        Kind::Series6
    } else {
        Kind::Other
    }
}

/// Room for the numbers of all buckets, and two more.
pub(super) const BUCKETS: usize = 32;
/// What is added to the number of the bucket in the lower half-plane.
pub(super) const LOWER: usize = Kind::Other as usize + 1;

/// The bucket as a number, plus `ROUND`: that of the kind, plus [`LOWER`] for the kinds up to
/// [`Kind::Series6`] in the lower half-plane.
#[inline(always)]
pub(super) fn bucket<R: Real>(a: R, y: R) -> R {
    let code = |k: Kind| a.like(ROUND + f64::from(k as u8));
    let under = |x: R, limit: f64, yes: R, no: R| x.pick(x.below(x.like(limit)), yes, no);
    let (zero, b) = (a.like(0.0), y.magnitude());
    let r2 = a.fma(a, b * b);
    let low = y.below(zero);
    let lower = a.pick(low, a.like(LOWER as f64), zero);
    let far = under(r2, TERMS_6, code(Kind::Series14), code(Kind::Series6));
    let far = under(r2, TERMS_14, code(Kind::Series24), far) + lower;
    let far = under(r2, HUGE, far, code(Kind::Other));
    let width = under(a.at_least(b), FINE, a.like(STRIP), a.like(2.0 * STRIP));
    let near = a.pick(a.below(width), code(Kind::ImaginaryAxis), code(Kind::Cell)) + lower;
    let disc = a.pick(low, code(Kind::Disc), near);
    let near = under(r2, DISC_EDGE, disc, near);
    let near = under(r2, SMALL, code(Kind::Small), near);
    let all = under(r2, FAR, near, far);
    let strip = under(a, BEYOND, code(Kind::RealAxis), code(Kind::Strip));
    let strip = under(a, APART, all, under(a, GONE, strip, all));
    under(b, STRIP, strip, all)
}

/// The number of the cell around `a + i b`, plus `ROUND`, and the distance from its centre.
#[inline(always)]
pub(super) fn cell<R: Real>(a: R, b: R) -> [R; 3] {
    let like = |x: f64| a.like(x);
    // Beside the real axis the fine cells go on.
    let fine = a.or(a.at_least(b).below(like(FINE)), b.below(like(2.0 * STRIP)));
    let step = a.pick(fine, like(4.0), like(2.0));
    let unit = a.pick(fine, like(-0.25), like(-0.5));
    let base = a.pick(fine, like(ROUND), like(ROUND + 512.0));
    let round = like(ROUND);
    let (i, j) = (a.fma(step, round) - round, b.fma(step, round) - round);
    [j.fma(like(32.0), i) + base, i.fma(unit, a), j.fma(unit, b)]
}

/// The row of cell number `n`.
#[inline(always)]
pub(super) fn cell_row(n: f64) -> &'static ComplexRow {
    &CELLS[CELL[n.to_bits() as usize & 1023] as usize]
}

/// The number of the centre on the real axis next to `a`, plus `ROUND`, and the distance from it.
#[inline(always)]
pub(super) fn on_real_axis<R: Real>(a: R) -> (R, R) {
    let round = a.like(ROUND);
    let n = a.fma(a.like(16.0), round);
    (n, (n - round).fma(a.like(-0.0625), a))
}

/// The row of centre `n` on the real axis.
#[inline(always)]
pub(super) fn real_axis_row(n: f64) -> &'static ComplexRow {
    &REAL_AXIS[((n.to_bits() as usize & 255).wrapping_sub(18)).min(REAL_AXIS.len() - 1)]
}

/// Whether the terms of the real part of w cancel beside the real axis: `e^{−x²}` and
/// `y D′(x)`, which is about `y Im w/x`.
#[inline(always)]
pub(super) fn cancels_beside_real_axis<R: Real>(a: R, y: R, re: R, im: R) -> R::Mask {
    let part = -y * im * a.like(0.5);
    (re.magnitude() * a).below(part)
}

/// The number of the cell of the lower half-disc around `a + i y`, plus `ROUND`, and the distance
/// from its centre.
#[inline(always)]
pub(super) fn disc_cell<R: Real>(a: R, y: R) -> [R; 3] {
    let (i, dx) = on_axis(a);
    let (j, dy) = on_axis(y);
    let round = a.like(ROUND);
    [(j - round).fma(a.like(-5.0), i), dx, dy]
}

/// The row of cell number `n` of the lower half-disc.
#[inline(always)]
pub(super) fn disc_row(n: f64) -> &'static ComplexRow {
    &DISC[(n.to_bits() as usize & 31).min(24)]
}

/// `ROUND` plus the number of the centre on an axis next to `x`, and the distance from it.
#[inline(always)]
pub(super) fn on_axis<R: Real>(x: R) -> (R, R) {
    let round = x.like(ROUND);
    let n = x.fma(x.like(4.0), round);
    (n, (n - round).fma(x.like(-0.25), x))
}

/// The row of centre `n` on the imaginary axis.
#[inline(always)]
pub(super) fn imaginary_axis_row(n: f64) -> &'static RealRow {
    &IMAGINARY_AXIS[(n.to_bits() as usize & 31).min(28)]
}

/// `(Re w, Im w)` from the expansion of `w(i s) = erfcx s` about a real centre.
#[inline(always)]
pub(super) fn from_erfcx<R: Real>(a: R, (p, s): (Dd<R>, Dd<R>)) -> (Dd<R>, Dd<R>) {
    let minus = -a;
    let m = minus * s.hi;
    (p, fast_two_sum(m, minus.fma(s.lo, minus.fma(s.hi, -m))))
}

/// w in the strip beside the real axis from the asymptotic series and `e^{y² − a²} cos 2ay`, which
/// matters only if `2ay` is small; `true` where the terms cancel.
#[inline(always)]
pub(super) fn in_strip<R: Real>(a: R, y: R) -> (R, R, R::Mask) {
    let (u, v) = series_beside_real_axis::<R, 16>(a, y.magnitude());
    let (e, n) = exp_rounded(exponent_in_strip(a, y));
    let t = ((a + a) * y).magnitude().at_most(a.like(0.5));
    // The square of a smaller number would be subnormal.
    let t = t.at_least(a.like(1e-140));
    let tt = t * t;
    let cos = tt
        * tt.fma(
            tt.fma(a.like(-1.0 / 720.0), a.like(1.0 / 24.0)),
            a.like(-0.5),
        );
    let t = scaled(e.fma(cos, e), n.at_least(a.like(ROUND - 1100.0)));
    let re = y.fma(u, t);
    // t + |y| u is small if either is: y is negative then.
    (re, v, re.magnitude().below(t * a.like(CANCELLED)))
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

/// Whether `2e^{−z²}` is below 2⁻⁶⁶ of both components of w(−z), or below every `f64`.
#[inline(always)]
pub(super) fn negligible<R: Real>(a: R, b: R, u: R, v: R) -> R::Mask {
    let e = exponent(a, b).hi;
    let within = e.at_least(a.like(-708.0)).at_most(a.like(0.0));
    let (_, n) = binary_exponent(within);
    let small = (n + n.like(68.0)).power_of_two();
    a.or(small.below(u.at_most(v)), e.below(a.like(-746.0)))
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
        let (re, im) = if a.max(b) < 4096.0 {
            trapezoidal::lower(lanes, a, b)
        } else {
            large(lanes, a, b)
        };
        (re.value(), im.value())
    }
}

/// `(Re w, Im w)` at `a + i y`, `a ≥ 0`, for any `y`.
#[inline(always)]
pub(super) fn right_half_plane<L: Lanes>(lanes: L, a: f64, y: f64) -> (f64, f64) {
    let b = y.abs();
    let kind = kind(a, y);
    let lower = y < 0.0;
    if lower && let Some(k) = zeros::nearest(a, b) {
        return match zeros::near_zero(lanes, k, a, b) {
            Some(w) => w,
            None => lanes.call(Cancelled { a, b }),
        };
    }
    let (u, v) = match kind {
        Kind::Cell => {
            let [n, dx, dy] = cell(a, b);
            complex_row(lanes, cell_row(n), dx, dy)
        }
        Kind::ImaginaryAxis => {
            let (n, t) = on_axis(b);
            from_erfcx(a, real_row(lanes, imaginary_axis_row(n), t, a))
        }
        Kind::RealAxis => {
            let (n, t) = on_real_axis(a);
            let (re, im) = complex_row(lanes, real_axis_row(n), t, y);
            return if cancels_beside_real_axis(a, y, re.hi, im.hi) {
                lanes.call(Cancelled { a, b })
            } else {
                (re.hi, im.hi)
            };
        }
        Kind::Series24 => series::<_, 24>(a, b),
        Kind::Series14 => series::<_, 14>(a, b),
        Kind::Series6 => series::<_, 6>(a, b),
        Kind::Small => return maclaurin(a, y),
        Kind::Disc => {
            let [n, dx, dy] = disc_cell(a, y);
            let (re, im) = complex_row(lanes, disc_row(n), dx, dy);
            return (re.hi, im.hi);
        }
        Kind::Strip => {
            let (re, im, lost) = in_strip(a, y);
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

//! Knots: where they are, which segment holds a point, and offsets from them without cancellation.

use super::error::CubicSplineError as Error;
use super::lookup::{GROUP, Lookup};
use crate::hex::hex;

/// Knots and ordinates beyond this are refused, so that evaluation cannot overflow.
pub(in crate::splines) const LARGEST: f64 = hex("0x1p1000");

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Knots {}
    impl Sealed for super::UniformKnots {}
}

/// One segment: its ends as offsets from an origin, each in two parts, and the step.
#[derive(Clone, Copy, Debug)]
pub struct Interval {
    origin: f64,
    left: (f64, f64),
    right: (f64, f64),
    pub(in crate::splines) h: f64,
    /// `1/h`.
    pub(in crate::splines) per_h: f64,
}

/// The knots of a spline. Implemented by [`Knots`] and [`UniformKnots`] only.
pub trait Grid: sealed::Sealed + Sync {
    /// The number of segments.
    fn segments(&self) -> usize;
    /// The first and the last knot.
    fn span(&self) -> (f64, f64);
    /// Segment `i`.
    #[doc(hidden)]
    fn interval(&self, i: usize) -> Interval;
    /// Tells whether [`Grid::group`] takes points in any order.
    #[doc(hidden)]
    const GROUPS: bool;
    /// Knot `i`, rounded.
    fn knot(&self, i: usize) -> f64;
    /// `x − x_i` and `x_{i+1} − x`, both with a small relative error and exactly 0 at the knot.
    #[doc(hidden)]
    fn offsets(at: &Interval, x: f64) -> (f64, f64);
    /// Values at some points, bit for bit those found one by one; `None` if one of them needs more
    /// care or the grid has no quicker way. Of points in ascending order `near` is a segment that
    /// does not begin after the first one, and becomes that of the last one.
    #[doc(hidden)]
    fn group<L: Lookup>(
        &self,
        lookup: L,
        y: &[f64],
        bend: &[f64],
        x: &[f64; GROUP],
        near: Option<&mut usize>,
    ) -> Option<[f64; GROUP]>;
    /// The segment that holds `x`, which lies in the span: the one that begins at `x` if `x` is an
    /// interior knot.
    #[doc(hidden)]
    fn locate(&self, x: f64) -> usize;
    /// `h²m/6` of a segment for each unit of stored bend.
    #[doc(hidden)]
    fn curvature_per_bend(&self, h: f64) -> f64;
    /// `m` for each unit of stored bend.
    #[doc(hidden)]
    fn second_per_bend(&self) -> f64;
}

/// Strictly increasing, finite knots.
#[derive(Clone, Debug, PartialEq)]
pub struct Knots(Vec<f64>);

impl Knots {
    /// Checks the knots.
    ///
    /// # Errors
    /// Fewer than two, one that is not finite, one that is not greater than its predecessor, or a
    /// knot beyond 2^1000, or a step that is subnormal.
    pub fn new(x: Vec<f64>) -> Result<Knots, Error> {
        if x.len() < 2 {
            return Err(Error::TooFewKnots {
                needed: 2,
                got: x.len(),
            });
        }
        // Without an early end, so that it becomes vector instructions. What is not finite fails.
        let good = x.windows(2).fold(x[0].abs() <= LARGEST, |all, p| {
            let h = p[1] - p[0];
            all & (h >= f64::MIN_POSITIVE) & (p[1].abs() <= LARGEST)
        });
        if good {
            return Ok(Knots(x));
        }
        if let Some(index) = x.iter().position(|v| !v.is_finite()) {
            return Err(Error::NotFinite {
                name: "knots",
                index,
                value: x[index],
            });
        }
        if let Some(knot) = x.iter().position(|v| v.abs() > LARGEST) {
            return Err(Error::Overflow { knot });
        }
        for (i, pair) in x.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                return Err(Error::NotIncreasing {
                    index: i + 1,
                    previous: pair[0],
                    value: pair[1],
                });
            }
            if !(pair[1] - pair[0]).is_normal() {
                return Err(Error::Overflow { knot: i + 1 });
            }
        }
        Ok(Knots(x))
    }

    /// The knots.
    pub fn as_slice(&self) -> &[f64] {
        &self.0
    }
}

impl Grid for Knots {
    const GROUPS: bool = false;

    fn knot(&self, i: usize) -> f64 {
        self.0[i]
    }

    fn segments(&self) -> usize {
        self.0.len() - 1
    }

    fn span(&self) -> (f64, f64) {
        (self.0[0], self.0[self.0.len() - 1])
    }

    #[inline]
    fn interval(&self, i: usize) -> Interval {
        let (a, b) = (self.0[i], self.0[i + 1]);
        Interval {
            origin: 0.0,
            left: (a, 0.0),
            right: (b, 0.0),
            h: b - a,
            per_h: 1.0 / (b - a),
        }
    }

    #[inline(always)]
    fn offsets(at: &Interval, x: f64) -> (f64, f64) {
        (x - at.left.0, at.right.0 - x)
    }

    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // the loops are over parallel arrays
    fn group<L: Lookup>(
        &self,
        lookup: L,
        y: &[f64],
        bend: &[f64],
        x: &[f64; GROUP],
        near: Option<&mut usize>,
    ) -> Option<[f64; GROUP]> {
        let near = near?;
        let knots = self.0.get(*near..)?.first_chunk::<{ GROUP + 1 }>()?;
        if x[GROUP - 1] >= knots[GROUP] {
            return None;
        }
        // The segment is as many ahead as knots are passed.
        let mut segment = lookup.passed(knots.last_chunk()?, x);
        for segment in &mut segment {
            *segment += *near as u64;
        }
        let [from, to, ..] = lookup.ends(&self.0, &self.0, &segment)?;
        let [y0, y1, p, q] = lookup.ends(y, bend, &segment)?;
        let mut out = [0.0; GROUP];
        for j in 0..GROUP {
            let h = to[j] - from[j];
            let at = fractions((x[j] - from[j], to[j] - x[j]), 1.0 / h);
            let c = h * h / 6.0;
            out[j] = blend(at, (y0[j], y1[j]), (c * p[j], c * q[j]));
        }
        *near = segment[GROUP - 1] as usize;
        Some(out)
    }

    #[inline]
    fn locate(&self, x: f64) -> usize {
        let inner = &self.0[1..self.0.len() - 1];
        inner.partition_point(|&k| k <= x)
    }

    #[inline]
    fn curvature_per_bend(&self, h: f64) -> f64 {
        h * h / 6.0
    }

    fn second_per_bend(&self) -> f64 {
        1.0
    }
}

/// The knots `x_0 + i h`, `i = 0 .. n`, meant exactly: they are held to twice the working
/// precision, not rounded to `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformKnots {
    origin: f64,
    step: f64,
    per_step: f64,
    second_per_bend: f64,
    segments: usize,
    /// The step split in two halves whose products with an index are exact.
    high: f64,
    low: f64,
    last: f64,
}

/// `k` and `w`, each from its own knot, so that it keeps its relative accuracy down to 0; then both
/// divided by their sum, to first order, so that the other one is exactly 1 there.
#[inline(always)]
pub(in crate::splines) fn fractions((a, b): (f64, f64), per_h: f64) -> (f64, f64) {
    let (k, w) = (a * per_h, b * per_h);
    let rest = 1.0 - (k + w);
    (k + k * rest, w + w * rest)
}

/// Eq. (12), with `p` and `q` the second derivatives times `h²/6`.
#[inline(always)]
pub(super) fn blend((k, w): (f64, f64), (y0, y1): (f64, f64), (p, q): (f64, f64)) -> f64 {
    let bend = (p + q) + (w * p + k * q);
    (w * y0 + k * y1) - (k * w) * bend
}

/// `a + b` as a rounded sum and its error, exact for any operands (Knuth).
#[inline(always)]
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let t = s - a;
    (s, (a - (s - t)) + (b - t))
}

impl UniformKnots {
    /// The largest number of segments.
    pub const MAX_SEGMENTS: usize = 1 << 26;

    /// Checks origin, step and number of segments.
    ///
    /// # Errors
    /// No segment or too many, an origin or last knot that is not finite, a step that is not
    /// positive, not normal, or smaller than four units in the last place of the largest knot.
    pub fn new(origin: f64, step: f64, segments: usize) -> Result<UniformKnots, Error> {
        if segments == 0 {
            return Err(Error::TooFewKnots { needed: 2, got: 1 });
        }
        if segments > Self::MAX_SEGMENTS {
            return Err(Error::TooManyKnots { got: segments + 1 });
        }
        if !origin.is_finite() {
            return Err(Error::NotFinite {
                name: "origin",
                index: 0,
                value: origin,
            });
        }
        if !(step.is_normal() && step > 0.0) {
            return Err(Error::Step { value: step });
        }
        let high = f64::from_bits(step.to_bits() & !((1 << 27) - 1));
        let mut grid = UniformKnots {
            origin,
            step,
            per_step: 1.0 / step,
            second_per_bend: 6.0 / step / step,
            segments,
            high,
            low: step - high,
            last: 0.0,
        };
        grid.last = grid.knot(segments);
        if origin.abs() > LARGEST {
            return Err(Error::Overflow { knot: 0 });
        }
        // Also if the knot is not a number because the step overflows.
        if grid.last.is_nan() || grid.last.abs() > LARGEST {
            return Err(Error::Overflow { knot: segments });
        }
        if step < 4.0 * f64::EPSILON * origin.abs().max(grid.last.abs()) {
            return Err(Error::Step { value: step });
        }
        Ok(grid)
    }

    /// The first knot.
    pub fn origin(&self) -> f64 {
        self.origin
    }

    /// The step.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// `i h` in two parts, exactly: 26 bits times at most 27.
    #[inline(always)]
    fn offset(&self, i: f64) -> (f64, f64) {
        (i * self.high, i * self.low)
    }
}

/// `x` seen from the two ends of a segment, `x` and the ends being given from one origin in two
/// parts each. The first difference is exact next to the knot.
#[inline(always)]
fn from_both_ends(x: (f64, f64), left: (f64, f64), right: (f64, f64)) -> (f64, f64) {
    (
        ((x.0 - left.0) - left.1) + x.1,
        ((right.0 - x.0) + right.1) - x.1,
    )
}

impl Grid for UniformKnots {
    const GROUPS: bool = true;

    fn knot(&self, i: usize) -> f64 {
        let (high, low) = self.offset(i as f64);
        let (s, e) = two_sum(high, low);
        let (t, f) = two_sum(self.origin, s);
        t + (f + e)
    }

    fn segments(&self) -> usize {
        self.segments
    }

    fn span(&self) -> (f64, f64) {
        (self.origin, self.last)
    }

    #[inline]
    fn interval(&self, i: usize) -> Interval {
        let i = i as f64;
        Interval {
            origin: self.origin,
            left: self.offset(i),
            right: self.offset(i + 1.0),
            h: self.step,
            per_h: self.per_step,
        }
    }

    #[inline(always)]
    fn offsets(at: &Interval, x: f64) -> (f64, f64) {
        from_both_ends(two_sum(x, -at.origin), at.left, at.right)
    }

    #[inline]
    fn locate(&self, x: f64) -> usize {
        let last = self.segments - 1;
        let i = (((x - self.origin) * self.per_step) as usize).min(last);
        // The product may be off by one next to a knot; the offsets decide.
        let (a, b) = Self::offsets(&self.interval(i), x);
        if i > 0 && a < 0.0 {
            i - 1
        } else if i < last && b <= 0.0 {
            i + 1
        } else {
            i
        }
    }

    /// Every step is a loop of its own over the group, without a branch, so that the compiler can
    /// use vector instructions for all but the loads.
    #[inline(always)]
    #[allow(clippy::needless_range_loop)] // the loops are over parallel arrays
    fn group<L: Lookup>(
        &self,
        lookup: L,
        y: &[f64],
        bend: &[f64],
        x: &[f64; GROUP],
        _: Option<&mut usize>,
    ) -> Option<[f64; GROUP]> {
        // Adding 1.5 · 2^52 rounds to an integer, which then stands in the low bits. The bias makes
        // it the integer below, also at a knot; just below a knot it fails, which is noticed.
        const ROUND: f64 = hex("0x1.8p52");
        const BIAS: f64 = 0.5 - 1e-9;
        let (mut t, mut e) = ([0.0; GROUP], [0.0; GROUP]);
        let (mut a, mut b) = ([0.0; GROUP], [0.0; GROUP]);
        let mut rounded = [0.0f64; GROUP];
        for j in 0..GROUP {
            (t[j], e[j]) = two_sum(x[j], -self.origin);
            rounded[j] = (t[j] * self.per_step - BIAS) + ROUND;
        }
        for j in 0..GROUP {
            let i = rounded[j] - ROUND;
            let (left, right) = (self.offset(i), self.offset(i + 1.0));
            (a[j], b[j]) = from_both_ends((t[j], e[j]), left, right);
        }
        let mut inside = true;
        for j in 0..GROUP {
            inside &= (a[j] >= 0.0) & (b[j] > 0.0);
        }
        if !inside {
            return None;
        }
        let mut segment = [0; GROUP];
        for j in 0..GROUP {
            segment[j] = rounded[j].to_bits().wrapping_sub(ROUND.to_bits());
        }
        let [y0, y1, p, q] = lookup.ends(y, bend, &segment)?;
        let mut out = [0.0; GROUP];
        for j in 0..GROUP {
            let at = fractions((a[j], b[j]), self.per_step);
            out[j] = blend(at, (y0[j], y1[j]), (p[j], q[j]));
        }
        Some(out)
    }

    #[inline]
    fn curvature_per_bend(&self, _: f64) -> f64 {
        1.0
    }

    fn second_per_bend(&self) -> f64 {
        self.second_per_bend
    }
}

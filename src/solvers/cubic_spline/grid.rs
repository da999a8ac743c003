//! Knots: where they are, which segment holds a point, and offsets from them without cancellation.

use super::CubicSplineError as Error;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Knots {}
    impl Sealed for super::UniformKnots {}
}

/// One segment: both ends as unevaluated sums of two floats, and the step.
#[derive(Clone, Copy, Debug)]
pub struct Interval {
    pub(super) left: (f64, f64),
    pub(super) right: (f64, f64),
    pub(super) h: f64,
    /// `1/h`.
    pub(super) per_h: f64,
}

impl Interval {
    /// Whether the right end is greater than `x`.
    #[inline(always)]
    pub(super) fn is_right_of(&self, x: f64) -> bool {
        (x - self.right.0) - self.right.1 < 0.0
    }
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
    /// Segment `i`, given the one before it.
    #[doc(hidden)]
    fn following(&self, i: usize, before: Interval) -> Interval;
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
    /// step that overflows or is subnormal.
    pub fn new(x: Vec<f64>) -> Result<Knots, Error> {
        if x.len() < 2 {
            return Err(Error::TooFewKnots {
                needed: 2,
                got: x.len(),
            });
        }
        if let Some(index) = x.iter().position(|v| !v.is_finite()) {
            return Err(Error::NotFinite {
                name: "knots",
                index,
                value: x[index],
            });
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
            left: (a, 0.0),
            right: (b, 0.0),
            h: b - a,
            per_h: 1.0 / (b - a),
        }
    }

    #[inline]
    fn following(&self, i: usize, _: Interval) -> Interval {
        self.interval(i)
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

/// `a + b` as a rounded sum and its error, exact for any operands (Knuth).
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
        grid.last = grid.knot(segments).0;
        if !grid.last.is_finite() {
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

    /// Knot `i` as an unevaluated sum, the first part being its nearest `f64`.
    #[inline]
    fn knot(&self, i: usize) -> (f64, f64) {
        let i = i as f64;
        // Both products are exact: 26 bits times at most 27.
        let (s, e) = two_sum(i * self.high, i * self.low);
        let (t, f) = two_sum(self.origin, s);
        two_sum(t, f + e)
    }
}

impl Grid for UniformKnots {
    fn segments(&self) -> usize {
        self.segments
    }

    fn span(&self) -> (f64, f64) {
        (self.origin, self.last)
    }

    #[inline]
    fn interval(&self, i: usize) -> Interval {
        Interval {
            left: self.knot(i),
            right: self.knot(i + 1),
            h: self.step,
            per_h: self.per_step,
        }
    }

    #[inline]
    fn following(&self, i: usize, before: Interval) -> Interval {
        Interval {
            left: before.right,
            right: self.knot(i + 1),
            h: self.step,
            per_h: self.per_step,
        }
    }

    #[inline]
    fn locate(&self, x: f64) -> usize {
        let last = self.segments - 1;
        let i = (((x - self.origin) * self.per_step) as usize).min(last);
        // The quotient may be off by one next to a knot; the offsets decide.
        let below = |k: (f64, f64)| (x - k.0) - k.1 < 0.0;
        if i > 0 && below(self.knot(i)) {
            i - 1
        } else if i < last && !below(self.knot(i + 1)) {
            i + 1
        } else {
            i
        }
    }

    #[inline]
    fn curvature_per_bend(&self, _: f64) -> f64 {
        1.0
    }

    fn second_per_bend(&self) -> f64 {
        self.second_per_bend
    }
}

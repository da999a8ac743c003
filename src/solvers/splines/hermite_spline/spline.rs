//! The interpolant.

use super::slopes::{Chords, Slope, Slopes};
use super::{CubicSplineError as Error, EvaluationError, Extrapolation, Jet};
use crate::cubic_spline::{Grid, Knots};
use crate::double_double::Dd;
use crate::splines::cubic_spline::{LARGEST, check_values, fractions};
use crate::splines::piecewise::{Piecewise, Place, Sum};

/// A piecewise cubic with continuous first derivative, whose slopes follow from a few neighbouring
/// points.
///
/// ```
/// use mechaudit_solvers::hermite_spline::{HermiteSpline, Slopes};
/// let (x, y) = (vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.0, 1.0, 1.0]);
/// let s = HermiteSpline::fit(x, y, Slopes::Pchip)?;
/// assert_eq!(s.value(0.5)?, 0.0);
/// assert_eq!(s.value(1.25)?, 0.15625);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct HermiteSpline {
    knots: Knots,
    y: Vec<f64>,
    /// Slopes of the chords.
    delta: Vec<f64>,
    slopes: Vec<Slope>,
    extrapolation: Extrapolation,
}

impl HermiteSpline {
    /// The interpolant through `(x_i, y_i)`. Outside the knots it gives an error until
    /// [`with_extrapolation`](Self::with_extrapolation) says otherwise.
    ///
    /// # Errors
    /// [`CubicSplineError`](Error): fewer than two knots, lengths that differ, numbers that are not
    /// finite, knots that do not increase, overflow.
    pub fn fit(x: Vec<f64>, y: Vec<f64>, slopes: Slopes) -> Result<HermiteSpline, Error> {
        if x.len() != y.len() {
            return Err(Error::Length {
                knots: x.len(),
                values: y.len(),
            });
        }
        let knots = Knots::new(x)?;
        check_values(&y)?;
        let chords = Chords::new(knots.as_slice(), &y);
        let slopes = slopes.at_knots(&chords);
        for (i, (s, h)) in slopes.windows(2).zip(&chords.h).enumerate() {
            let (a, b) = (s[0].over_right.hi, s[1].over_left.hi);
            let derivatives = [
                s[0].slope,
                s[1].slope,
                chords.delta[i],
                2.0 * (a.abs() + b.abs()) / h,
                (a.abs() + b.abs()) / h / h,
            ];
            // Infinities and what is not a number fail this comparison.
            if !derivatives.iter().all(|v| v.abs() <= LARGEST) {
                return Err(Error::Overflow { knot: i });
            }
        }
        Ok(HermiteSpline {
            knots,
            y,
            delta: chords.delta,
            slopes,
            extrapolation: Extrapolation::Error,
        })
    }

    /// The knots.
    pub fn knots(&self) -> &[f64] {
        self.knots.as_slice()
    }

    /// The ordinates.
    pub fn values_at_knots(&self) -> &[f64] {
        &self.y
    }

    /// The slopes at the knots.
    pub fn slopes(&self) -> Vec<f64> {
        self.slopes.iter().map(|s| s.slope).collect()
    }

    /// The behaviour outside the knots.
    pub fn extrapolation(&self) -> Extrapolation {
        self.extrapolation
    }

    /// The same interpolant with another behaviour outside the knots.
    pub fn with_extrapolation(mut self, extrapolation: Extrapolation) -> Self {
        self.extrapolation = extrapolation;
        self
    }

    /// `S(x)`.
    ///
    /// # Errors
    /// `x` is not finite, or outside the knots under [`Extrapolation::Error`]. Far outside, the
    /// result may overflow to an infinity.
    pub fn value(&self, x: f64) -> Result<f64, EvaluationError> {
        self.value_in_batch(0, x)
    }

    /// `S`, `S'`, `S''` and `S'''` at `x`.
    ///
    /// # Errors
    /// As [`HermiteSpline::value`].
    pub fn jet(&self, x: f64) -> Result<Jet, EvaluationError> {
        self.jet_in_batch(0, x)
    }

    /// `S` at points in any order.
    ///
    /// # Errors
    /// Lengths that differ; as [`HermiteSpline::value`] for the first point that fails. `out` is
    /// then partly written.
    pub fn values(&self, x: &[f64], out: &mut [f64]) -> Result<(), EvaluationError> {
        if x.len() != out.len() {
            return Err(EvaluationError::Length {
                points: x.len(),
                room: out.len(),
            });
        }
        for (i, (x, out)) in x.iter().zip(out).enumerate() {
            *out = self.value_in_batch(i, *x)?;
        }
        Ok(())
    }

    /// `S`, `S'`, `S''`, `S'''` at points in any order.
    ///
    /// # Errors
    /// As [`HermiteSpline::value`]; the index is the place in `x`.
    pub fn jets(&self, x: &[f64]) -> Result<Vec<Jet>, EvaluationError> {
        let one = |(i, x): (usize, &f64)| self.jet_in_batch(i, *x);
        x.iter().enumerate().map(one).collect()
    }

    /// `∫ S dx` from `a` to `b`; `b < a` gives the negative of the integral from `b` to `a`.
    /// Linear in the number of knots between the limits.
    ///
    /// # Errors
    /// As [`HermiteSpline::value`], for either limit (index 0 and 1).
    pub fn integral(&self, a: f64, b: f64) -> Result<f64, EvaluationError> {
        self.integral_between(a, b)
    }

    fn value_in_batch(&self, index: usize, x: f64) -> Result<f64, EvaluationError> {
        Ok(match self.place(index, x)? {
            Place::Inside { x, .. } => {
                let i = self.knots.locate(x);
                self.value_at(i, self.fractions(i, x))
            }
            Place::Before => self.outside(x, true).value,
            Place::After => self.outside(x, false).value,
        })
    }

    fn jet_in_batch(&self, index: usize, x: f64) -> Result<Jet, EvaluationError> {
        Ok(match self.place(index, x)? {
            Place::Inside { x, below } => {
                let i = self.knots.locate(x);
                let is_before = below && i > 0 && x == self.knots.knot(i);
                self.jet_of(if is_before { i - 1 } else { i }, x)
            }
            Place::Before => self.outside(x, true),
            Place::After => self.outside(x, false),
        })
    }

    fn fractions(&self, i: usize, x: f64) -> (f64, f64) {
        let at = self.knots.interval(i);
        fractions(Knots::offsets(&at, x), at.per_h)
    }

    /// `S` on segment `i`: the ordinate of the nearer knot and what the cubic adds to it, so that
    /// `S` keeps its relative accuracy near a knot with ordinate 0, even if its slope is 0 as well.
    fn value_at(&self, i: usize, (k, w): (f64, f64)) -> f64 {
        let h = self.knots.interval(i).h;
        let (left, right, delta) = (self.slopes[i], self.slopes[i + 1], self.delta[i]);
        // `3δ − s`, which is exactly 0 where a PCHIP's end slope is limited to 3δ.
        let rest = |over: Dd| 2.0 * delta - over.value();
        let from_left = || {
            let (cubic, square) = (k * k * k * delta, (k * k) * w * rest(right.over_left));
            self.y[i] + h * (k * (w * w) * left.slope + square + cubic)
        };
        let from_right = || {
            let (cubic, square) = (w * w * w * delta, (w * w) * k * rest(left.over_right));
            self.y[i + 1] - h * (w * (k * k) * right.slope + square + cubic)
        };
        if k < w {
            from_left()
        } else if w < k {
            from_right()
        } else {
            // A mirrored spline gives the same.
            0.5 * from_left() + 0.5 * from_right()
        }
    }

    /// The part of `S` that the ordinates make.
    fn of_ordinates(&self, i: usize, (k, w): (f64, f64)) -> f64 {
        (w * w) * (1.0 + 2.0 * k) * self.y[i] + (k * k) * (1.0 + 2.0 * w) * self.y[i + 1]
    }

    /// How much a segment's slope at its left end exceeds the one at its right end. Akima's slopes
    /// are equal by definition where the jumps on both sides of a middle segment are opposite; a
    /// difference of rounded slopes would not vanish there.
    fn slope_loss(&self, i: usize) -> f64 {
        (self.slopes[i].over_right - self.slopes[i + 1].over_left).value()
    }

    fn whole(&self, i: usize) -> f64 {
        let h = self.knots.interval(i).h;
        let bent = h * self.slope_loss(i) / 12.0;
        h * ((0.5 * self.y[i] + 0.5 * self.y[i + 1]) + bent)
    }

    /// The integral over `length` between two points of segment `i`, without a difference of
    /// antiderivatives.
    ///
    /// With the mean slope `s` of the two ends and their half difference `d`, the part of `S` that
    /// the slopes make is `h k w ((w − k) s + d)`, and the first term integrates to a product.
    /// Simpson's rule, which is exact for cubics, does the rest; or all of it, where the slopes as
    /// they are make the smaller terms, as they do near a knot with slope 0.
    fn within(&self, i: usize, a: (f64, f64), b: (f64, f64), length: f64) -> f64 {
        let h = self.knots.interval(i).h;
        let (left, right) = (self.slopes[i], self.slopes[i + 1]);
        let mid = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
        let simpson = |f: &dyn Fn((f64, f64)) -> f64| ((f(a) + f(b)) + 4.0 * f(mid)) / 6.0;
        let both = (left.over_right + right.over_left).value();
        let mean = self.delta[i] + 0.5 * both;
        let half = 0.5 * self.slope_loss(i);
        let product = mean * (b.1 - a.0) * (0.5 * (a.0 * a.1 + b.0 * b.1));
        let apart = product.abs() + simpson(&|(k, w)| k * w * half.abs());
        let together = simpson(&|(k, w)| k * w * (w * left.slope.abs() + k * right.slope.abs()));
        let mean_value = match apart < together {
            true => {
                simpson(&|(k, w)| self.of_ordinates(i, (k, w)) + (k * w) * (h * half)) + h * product
            }
            false => simpson(&|at| self.value_at(i, at)),
        };
        length * mean_value
    }
}

impl Piecewise for HermiteSpline {
    fn ends(&self) -> (f64, f64) {
        self.knots.span()
    }

    fn ordinates(&self) -> &[f64] {
        &self.y
    }

    fn beyond(&self) -> Extrapolation {
        self.extrapolation
    }

    fn jet_of(&self, i: usize, x: f64) -> Jet {
        let (k, w) = self.fractions(i, x);
        let h = self.knots.interval(i).h;
        let (left, right) = (self.slopes[i], self.slopes[i + 1]);
        let (a, b) = (left.over_right, right.over_left);
        let both = a + b;
        let ends = (w * w) * left.slope + (k * k) * right.slope;
        Jet {
            value: self.value_at(i, (k, w)),
            first: ends + 2.0 * (k * w) * (Dd::from(self.delta[i]) - both).value(),
            second: 2.0 * (k * (both + b).value() - w * (both + a).value()) / h,
            third: 6.0 * both.value() / h / h,
        }
    }

    fn add_inside(&self, a: f64, b: f64, sum: &mut Sum) {
        let (i, j) = (self.knots.locate(a), self.knots.locate(b));
        let (start, stop) = (self.fractions(i, a), self.fractions(j, b));
        if i == j {
            sum.add(self.within(i, start, stop, b - a));
            return;
        }
        let h = |i: usize| self.knots.interval(i).h;
        sum.add(self.within(i, start, (1.0, 0.0), start.1 * h(i)));
        for c in i + 1..j {
            sum.add(self.whole(c));
        }
        sum.add(self.within(j, (0.0, 1.0), stop, stop.0 * h(j)));
    }
}

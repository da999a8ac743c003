//! Values, derivatives and integrals at single points.

use super::boundary::Known;
use super::error::EvaluationError as Error;
use super::grid::{Grid, Interval, blend, fractions};
use super::spline::{Extrapolation, Spline};
use crate::splines::piecewise::{Jet, Piecewise, Place, Sum};
use std::marker::PhantomData;

/// The part of an end segment in which `S` and `S'` come from the slope given there. The far
/// ordinate's weight in `S` is about `3k²` there, in (12) it is `k` and most of it cancels; in `S'`
/// the ordinates' weights grow from 0 at the end itself to two thirds of those in (11).
const BESIDE: f64 = 0.125;

/// One segment ready for evaluation.
pub(super) struct Cell<G> {
    at: Interval,
    y0: f64,
    y1: f64,
    /// `h² m_i / 6` and `h² m_{i+1} / 6`.
    p: f64,
    q: f64,
    m0: f64,
    m1: f64,
    grid: PhantomData<G>,
}

impl<G: Grid> Cell<G> {
    #[inline(always)]
    pub(super) fn fractions(&self, x: f64) -> (f64, f64) {
        fractions(G::offsets(&self.at, x), self.at.per_h)
    }

    #[inline(always)]
    fn value_at(&self, at: (f64, f64)) -> f64 {
        blend(at, (self.y0, self.y1), (self.p, self.q))
    }

    /// `S(x)`.
    #[inline(always)]
    pub(super) fn value(&self, x: f64) -> f64 {
        self.value_at(self.fractions(x))
    }

    pub(super) fn jet_at(&self, (k, w): (f64, f64)) -> Jet {
        let bend = (3.0 * k * k - 1.0) * self.q - (3.0 * w * w - 1.0) * self.p;
        Jet {
            value: self.value_at((k, w)),
            first: ((self.y1 - self.y0) + bend) / self.at.h,
            second: w * self.m0 + k * self.m1,
            third: (self.m1 - self.m0) / self.at.h,
        }
    }

    /// `S = y_i + k (h s + k h²/6 (2 m_i + S''))` beside the left end with slope `s`.
    fn value_from_left(&self, (k, w): (f64, f64), slope: f64) -> f64 {
        let second = w * self.p + k * self.q;
        self.y0 + k * (self.at.h * slope + k * (2.0 * self.p + second))
    }

    fn value_from_right(&self, (k, w): (f64, f64), slope: f64) -> f64 {
        let second = w * self.p + k * self.q;
        self.y1 + w * (w * (2.0 * self.q + second) - self.at.h * slope)
    }

    fn whole(&self) -> f64 {
        self.at.h * (0.5 * (self.y0 + self.y1) - 0.25 * (self.p + self.q))
    }
}

/// Between which points (12) and (11) give `S` and `S'`: all but those beside a given slope.
pub(super) fn plain<G: Grid>(grid: &G, known: [Known; 2]) -> (f64, f64) {
    let n = grid.segments();
    let knot = |i: usize| grid.knot(i);
    let margin = |i: usize| BESIDE * (knot(i + 1) - knot(i));
    let given = known.map(|k| matches!(k, Known::First(_)));
    (
        if given[0] {
            knot(0) + margin(0)
        } else {
            f64::NEG_INFINITY
        },
        if given[1] {
            knot(n) - margin(n - 1)
        } else {
            f64::INFINITY
        },
    )
}

impl<G: Grid> Spline<G> {
    /// Value and derivatives with the cubic of segment `i`.
    pub(super) fn jet_on(&self, i: usize, x: f64) -> Jet {
        let cell = self.cell(i);
        let (k, w) = cell.fractions(x);
        let mut jet = cell.jet_at((k, w));
        let [first, last] = self.known;
        match (first, last) {
            (Known::First(s), _) if x < self.plain.0 => {
                jet.value = cell.value_from_left((k, w), s);
                jet.first = s + (k * cell.at.h) * (0.5 * cell.m0 + 0.5 * jet.second);
            }
            (_, Known::First(s)) if x > self.plain.1 => {
                jet.value = cell.value_from_right((k, w), s);
                jet.first = s - (w * cell.at.h) * (0.5 * cell.m1 + 0.5 * jet.second);
            }
            _ => {}
        }
        match (first, last) {
            (Known::Third(t), _) if i < 2 => jet.third = t,
            (_, Known::Third(t)) if i + 2 >= self.grid.segments() => jet.third = t,
            _ => {}
        }
        jet
    }

    #[inline]
    pub(super) fn cell(&self, i: usize) -> Cell<G> {
        let at = self.grid.interval(i);
        let c = self.grid.curvature_per_bend(at.h);
        let f = self.grid.second_per_bend();
        let (b0, b1) = (self.bend[i], self.bend[i + 1]);
        let (p, q) = (c * b0, c * b1);
        Cell {
            at,
            y0: self.y[i],
            y1: self.y[i + 1],
            p,
            q,
            m0: f * b0,
            m1: f * b1,
            grid: PhantomData,
        }
    }

    /// `S` beside an end with a given slope.
    #[cold]
    #[inline(never)]
    fn value_beside(&self, x: f64) -> f64 {
        self.jet_on(self.grid.locate(x), x).value
    }

    /// Returns whether (12) gives `S` at these points.
    #[inline(always)]
    pub(super) fn is_plain(&self, least: f64, greatest: f64) -> bool {
        least >= self.plain.0 && greatest <= self.plain.1
    }

    pub(super) fn value_in_batch(&self, index: usize, x: f64) -> Result<f64, Error> {
        Ok(match self.place(index, x)? {
            Place::Inside { x, .. } if self.is_plain(x, x) => {
                self.cell(self.grid.locate(x)).value(x)
            }
            Place::Inside { x, .. } => self.value_beside(x),
            Place::Before => self.outside(x, true).value,
            Place::After => self.outside(x, false).value,
        })
    }

    /// `S(x)`.
    ///
    /// # Errors
    /// `x` is not finite, or outside the knots under [`Extrapolation::Error`]. Far outside, the
    /// result may overflow to an infinity.
    pub fn value(&self, x: f64) -> Result<f64, Error> {
        self.value_in_batch(0, x)
    }

    /// `S`, `S'`, `S''` and `S'''` at `x`.
    ///
    /// # Errors
    /// As [`Spline::value`].
    pub fn jet(&self, x: f64) -> Result<Jet, Error> {
        Ok(match self.place(0, x)? {
            Place::Inside { x, below } => self.jet_on(self.segment(x, below), x),
            Place::Before => self.outside(x, true),
            Place::After => self.outside(x, false),
        })
    }

    /// `∫ S dx` from `a` to `b`; `b < a` gives the negative of the integral from `b` to `a`.
    /// Linear in the number of knots between the limits.
    ///
    /// # Errors
    /// As [`Spline::value`], for either limit (index 0 and 1).
    pub fn integral(&self, a: f64, b: f64) -> Result<f64, Error> {
        self.integral_between(a, b)
    }

    /// The segment of a point that may lie a little below the float `x`.
    fn segment(&self, x: f64, below: bool) -> usize {
        let i = self.grid.locate(x);
        match below && i > 0 && x == self.grid.knot(i) {
            true => i - 1,
            false => i,
        }
    }

    /// Adds the integral between two points of the span, `a ≤ b`.
    fn inside(&self, a: f64, b: f64, sum: &mut Sum) {
        let (i, j) = (self.grid.locate(a), self.grid.locate(b));
        let (from, to) = (self.cell(i), self.cell(j));
        let (start, stop) = (from.fractions(a), to.fractions(b));
        if i == j {
            sum.add(self.within(i, &from, start, stop, b - a));
            return;
        }
        sum.add(self.within(i, &from, start, (1.0, 0.0), start.1 * from.at.h));
        for c in i + 1..j {
            sum.add(self.cell(c).whole());
        }
        sum.add(self.within(j, &to, (0.0, 1.0), stop, stop.0 * to.at.h));
    }

    /// The integral over `length` between two points of segment `i`, by Simpson's rule, which is
    /// exact for cubics and does not subtract antiderivatives.
    fn within(&self, i: usize, cell: &Cell<G>, a: (f64, f64), b: (f64, f64), length: f64) -> f64 {
        let (begins, ends) = (i == 0, i + 1 == self.grid.segments());
        let value = |(k, w): (f64, f64)| match self.known {
            [Known::First(s), _] if begins && k < BESIDE => cell.value_from_left((k, w), s),
            [_, Known::First(s)] if ends && w < BESIDE => cell.value_from_right((k, w), s),
            _ => cell.value_at((k, w)),
        };
        let mid = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
        length * (value(a) + value(b) + 4.0 * value(mid)) / 6.0
    }
}

impl<G: Grid> Piecewise for Spline<G> {
    #[inline(always)]
    fn ends(&self) -> (f64, f64) {
        self.grid.span()
    }

    fn ordinates(&self) -> &[f64] {
        &self.y
    }

    #[inline(always)]
    fn beyond(&self) -> Extrapolation {
        self.extrapolation
    }

    fn jet_of(&self, segment: usize, x: f64) -> Jet {
        self.jet_on(segment, x)
    }

    fn add_inside(&self, a: f64, b: f64, sum: &mut Sum) {
        self.inside(a, b, sum);
    }
}

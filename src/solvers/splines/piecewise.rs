//! Places and integrals, which do not depend on how the cubics between the knots are held.

use super::cubic_spline::{EvaluationError as Error, Extrapolation};
use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};

/// Value and derivatives at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Jet {
    /// `S`.
    pub value: f64,
    /// `S'`.
    pub first: f64,
    /// `S''`.
    pub second: f64,
    /// `S'''`, of the segment to the right at a knot.
    pub third: f64,
}

/// Where a point lies.
pub(super) enum Place {
    /// Between the knots, after wrapping if that is asked for. `below` says that the exact point
    /// lies a little below its nearest float `x`: at a knot that decides about the segment.
    Inside { x: f64, below: bool },
    /// Before the first knot.
    Before,
    /// After the last knot.
    After,
}

/// Neumaier's compensated sum.
#[derive(Default)]
pub(super) struct Sum {
    sum: f64,
    rest: f64,
}

impl Sum {
    pub(super) fn add(&mut self, x: f64) {
        let s = self.sum + x;
        self.rest += if self.sum.abs() >= x.abs() {
            (self.sum - s) + x
        } else {
            (x - s) + self.sum
        };
        self.sum = s;
    }

    fn value(&self) -> f64 {
        self.sum + self.rest
    }
}

/// A point as `turns (last − first) + x`.
struct Wrapped {
    turns: f64,
    x: f64,
    below: bool,
}

/// Takes whole periods `last − first` off a point in twice the working precision, so that the
/// result is in error by half a unit in its own last place, not in that of the point.
fn wrap(point: f64, first: f64, last: f64) -> Wrapped {
    let period = two_sum(last, -first);
    let mut turns = ((point - first) / period.hi).floor();
    let off = |turns: f64| {
        let whole = two_prod(turns, period.hi);
        let rest = two_sum(point, -whole.hi);
        let lo = rest.lo - whole.lo - turns * period.lo;
        let Dd { hi, lo } = two_sum(rest.hi, lo);
        fast_two_sum(hi, lo)
    };
    let mut at = off(turns);
    // The quotient was rounded, and may have become the next whole number.
    if at.hi < first || at.hi == first && at.lo < 0.0 {
        turns -= 1.0;
        at = off(turns);
    } else if at.hi > last || at.hi == last && at.lo >= 0.0 {
        turns += 1.0;
        at = off(turns);
    }
    Wrapped {
        turns,
        x: at.hi.clamp(first, last),
        below: at.lo < 0.0,
    }
}

/// A function made of a cubic for each segment between knots.
pub(super) trait Piecewise {
    /// The first and the last knot.
    fn ends(&self) -> (f64, f64);
    /// The ordinates.
    fn ordinates(&self) -> &[f64];
    /// The behaviour outside the knots.
    fn beyond(&self) -> Extrapolation;
    /// Value and derivatives with the cubic of a segment.
    fn jet_of(&self, segment: usize, x: f64) -> Jet;
    /// Adds the integral between two points of the span, `a ≤ b`.
    fn add_inside(&self, a: f64, b: f64, sum: &mut Sum);

    #[inline(always)]
    fn place(&self, index: usize, x: f64) -> Result<Place, Error> {
        if !x.is_finite() {
            return Err(Error::NotFinite { index, x });
        }
        let (first, last) = self.ends();
        if first <= x && x <= last {
            return Ok(Place::Inside { x, below: false });
        }
        match self.beyond() {
            Extrapolation::Error => Err(Error::Outside {
                index,
                x,
                first,
                last,
            }),
            Extrapolation::Wrap => {
                let Wrapped { x: at, below, .. } = wrap(x, first, last);
                // The distance overflows only when nothing of the point's place is left.
                if at.is_nan() {
                    return Err(Error::NotFinite { index, x });
                }
                Ok(Place::Inside { x: at, below })
            }
            _ if x < first => Ok(Place::Before),
            _ => Ok(Place::After),
        }
    }

    /// Value and derivatives outside the knots, where no error is due and nothing is wrapped.
    fn outside(&self, x: f64, before: bool) -> Jet {
        let (first, last) = self.ends();
        let y = self.ordinates();
        let (segment, knot, end) = match before {
            true => (0, 0, first),
            false => (y.len() - 2, y.len() - 1, last),
        };
        match self.beyond() {
            Extrapolation::EndPolynomial => self.jet_of(segment, x),
            Extrapolation::Clamp => Jet {
                value: y[knot],
                ..Jet::default()
            },
            _ => {
                let at = self.jet_of(segment, end);
                Jet {
                    value: at.value + at.first * (x - end),
                    first: at.first,
                    ..Jet::default()
                }
            }
        }
    }

    /// The integral from `a` to `b`, of either sign.
    fn integral_between(&self, a: f64, b: f64) -> Result<f64, Error> {
        self.place(0, a)?;
        self.place(1, b)?;
        let sign = if a <= b { 1.0 } else { -1.0 };
        let (a, b) = if a <= b { (a, b) } else { (b, a) };
        let (first, last) = self.ends();
        let mut sum = Sum::default();
        if self.beyond() == Extrapolation::Wrap && (a < first || b > last) {
            // From a to the end of its turn, whole turns, from the start of b's turn to b.
            let (a, b) = (wrap(a, first, last), wrap(b, first, last));
            let whole = b.turns - a.turns;
            if whole == 0.0 {
                self.add_inside(a.x, b.x.max(a.x), &mut sum);
            } else {
                self.add_inside(a.x, last, &mut sum);
                self.add_inside(first, b.x, &mut sum);
                if whole > 1.0 {
                    let mut turn = Sum::default();
                    self.add_inside(first, last, &mut turn);
                    sum.add((whole - 1.0) * turn.value());
                }
            }
            return Ok(sign * sum.value());
        }
        if a < first {
            sum.add(self.tail(a, b.min(first), true));
        }
        if b > last {
            sum.add(self.tail(a.max(last), b, false));
        }
        if a < last && b > first {
            self.add_inside(a.max(first), b.min(last), &mut sum);
        }
        Ok(sign * sum.value())
    }

    /// Simpson's rule on a cubic outside the knots.
    fn tail(&self, a: f64, b: f64, before: bool) -> f64 {
        let f = |x| self.outside(x, before).value;
        (b - a) * (f(a) + 4.0 * f(0.5 * a + 0.5 * b) + f(b)) / 6.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neumaier's example and its like: what a sum loses is kept, whichever term is larger.
    #[test]
    fn sums_keep_what_they_lose() {
        let sum = |terms: &[f64]| {
            let mut s = Sum::default();
            terms.iter().for_each(|x| s.add(*x));
            (s.sum, s.rest)
        };
        assert_eq!(sum(&[1.0, 1e100, 1.0, -1e100]), (0.0, 2.0));
        let big = 2f64.powi(53);
        assert_eq!(sum(&[big, 1.0, 1.0, 1.0]), (big, 3.0));
        assert_eq!(sum(&[1.0, big, 1.0, -big]), (0.0, 2.0));
        assert_eq!(sum(&[0.5, 0.25]), (0.75, 0.0));
    }

    #[test]
    fn whole_periods_are_taken_off_exactly() {
        let at = |point: f64, first: f64, last: f64| {
            let w = wrap(point, first, last);
            (w.turns, w.x, w.below)
        };
        assert_eq!(at(2.25, 0.0, 1.0), (2.0, 0.25, false));
        assert_eq!(at(-0.25, 0.0, 1.0), (-1.0, 0.75, false));
        assert_eq!(at(3.0, 0.0, 1.0), (3.0, 0.0, false));
        assert_eq!(at(-1e-30, 0.0, 1.0), (-1.0, 1.0, true));
        // The period is 0.9 − 5.55·10⁻¹⁸, which is no float.
        assert_eq!(at(9.5, 0.1, 1.0), (10.0, 0.5, false));
        // The float nearest to 1/3 is less than a third by 2⁻⁵⁴/3.
        let third = 1.0 / 3.0;
        assert_eq!(at(1.0, 0.0, third), (3.0, 2f64.powi(-54), false));
        assert!(wrap(f64::MAX, -1.0, 0.0).x.is_finite());
    }
}

//! Coordinates as the fast evaluation takes them.

use super::fixed_point::{PREC, SCALE, fixed};
use crate::faddeeva::argument::Real;
use rug::Float;
use std::ops::Range;

/// Binary exponents of what is not a double: no product of a few of such numbers leaves MPFR's
/// range, and their doubles are finite.
const EXPONENTS: Range<i32> = -(1 << 27)..1024;

/// The modulus of a coordinate: a float with a relative error below 2^-158, and the nearest double.
pub struct Coordinate {
    pub value: Float,
    pub double: f64,
    pub exact: bool,
}

impl Coordinate {
    #[inline]
    pub fn new(x: &Real) -> Option<Coordinate> {
        if let Real::Double(x) = x {
            return Some(Coordinate {
                value: Float::with_val(PREC, x.abs()),
                double: x.abs(),
                exact: true,
            });
        }
        let value = x.ball(PREC).mid().clone().abs();
        if value.get_exp().is_some_and(|e| !EXPONENTS.contains(&e)) {
            return None;
        }
        Some(Coordinate {
            double: value.to_f64(),
            value,
            exact: false,
        })
    }

    /// Twice the coordinate of the nearest centre.
    #[inline]
    pub fn centre(&self) -> f64 {
        (2.0 * self.double).round()
    }

    /// The distance from there in units, wrong by one unit at most. For a double the difference is
    /// exact (Sterbenz, or the centre is zero).
    #[inline]
    pub fn offset(&self) -> Option<i128> {
        let centre = self.centre() / 2.0;
        if self.exact {
            return Some(fixed(self.double - centre));
        }
        let s = Float::with_val(PREC, &self.value - centre) << SCALE;
        s.to_integer()?.to_i128()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    fn of(x: f64) -> Coordinate {
        Coordinate::new(&Real::Double(x)).unwrap()
    }

    #[test]
    fn centres_are_the_nearest_halves() {
        for (x, due) in [
            (0.0, 0.0),
            (0.249, 0.0),
            (0.25, 1.0),
            (-0.7, 1.0),
            (0.75, 2.0),
            (9.7499, 19.0),
        ] {
            assert_eq!(of(x).centre(), due, "{x}");
        }
    }

    /// Of doubles truncated, of other numbers to the nearest unit.
    #[test]
    fn offsets_are_distances_in_units() {
        let unit = 2f64.powi(-(SCALE as i32));
        assert_eq!(of(3.5 * unit).offset(), Some(3));
        assert_eq!(of(0.625).offset(), Some(1 << (SCALE - 3)));
        assert_eq!(of(-2.375).offset(), Some(-1 << (SCALE - 3)));
        for (n, d) in [(1, 3), (-5, 3), (29, 3), (1, 7), (100, 11)] {
            let q = Rational::from((n, d));
            let c = Coordinate::new(&Real::Rational(q.clone())).unwrap();
            assert!(!c.exact);
            let due = q.abs() - Rational::from_f64(c.centre() / 2.0).unwrap();
            let lost = (due << SCALE) - Rational::from(c.offset().unwrap());
            assert!(
                lost.clone().abs() <= Rational::from((1, 2)),
                "{n}/{d}: {lost}"
            );
        }
    }

    #[test]
    fn values_are_moduli() {
        let c = of(-0.3);
        assert!(c.value == 0.3 && c.double == 0.3 && c.exact);
        let c = Coordinate::new(&Real::Root(true, Rational::from(2))).unwrap();
        assert_eq!(c.double, 2f64.sqrt());
        let square: Float = Float::with_val(400, c.value.square_ref()) - 2u32;
        assert!(square.abs() < 2f64.powi(-157));
    }

    /// Whose square, or whose square's reciprocal, would leave the range of floats.
    #[test]
    fn exponents_have_limits() {
        for (e, due) in [
            (-(1 << 27), true),
            (-(1 << 27) - 1, false),
            (1023, true),
            (1024, false),
        ] {
            // In [1/2, 1) times 2^e.
            let x = Float::with_val(80, 0.75) << e;
            assert_eq!(Coordinate::new(&Real::Float(x)).is_some(), due, "{e}");
        }
        let zero = Coordinate::new(&Real::Float(Float::new(64))).unwrap();
        assert!(zero.value.is_zero() && zero.double == 0.0);
    }
}

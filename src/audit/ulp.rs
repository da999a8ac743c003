//! Fractional ulps against an unrounded reference.

use mechaudit_reference::{Ball, Mag};
use rug::Float;
use serde::Serialize;

/// The floating-point format of the code under test: whose ulps, whose largest number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Format {
    /// IEEE 754 binary64, `f64`.
    #[default]
    Double,
    /// IEEE 754 binary32, `f32`.
    Single,
}

impl Format {
    /// Bits of the significand, the leading one included.
    pub const fn precision(self) -> i64 {
        match self {
            Format::Double => 53,
            Format::Single => 24,
        }
    }

    /// The exponent of the smallest positive number.
    pub(super) const fn least(self) -> i64 {
        match self {
            Format::Double => -1074,
            Format::Single => -149,
        }
    }

    /// The smallest normal number.
    pub(super) fn min_positive(self) -> f64 {
        match self {
            Format::Double => f64::MIN_POSITIVE,
            Format::Single => f64::from(f32::MIN_POSITIVE),
        }
    }

    /// The exponent `k` of the unit in the last place of this format, see [`ulp_exponent`].
    pub fn ulp_exponent(self, x: &Float) -> i64 {
        match x.get_exp() {
            Some(e) => (i64::from(e) - self.precision()).max(self.least()),
            None => self.least(),
        }
    }

    /// The largest power of two.
    pub(super) fn largest_power(self) -> Mag {
        Mag::power_of_two(match self {
            Format::Double => 1023,
            Format::Single => 127,
        })
    }

    /// The smallest number that rounds to infinity, half a unit beyond the largest: `2¹⁰²⁴ − 2⁹⁷⁰`
    /// or `2¹²⁸ − 2¹⁰³`.
    pub(super) fn overflow(self) -> Ball {
        let (beyond, half) = match self {
            Format::Double => (1024i32, 970i32),
            Format::Single => (128, 103),
        };
        let edge = (Float::with_val(64, 1) << beyond) - (Float::with_val(64, 1) << half);
        Ball::new(edge, Mag::ZERO)
    }

    /// The nearest number of this format.
    pub fn round(self, x: f64) -> f64 {
        match self {
            Format::Double => x,
            Format::Single => f64::from(x as f32),
        }
    }

    /// The nearest number of this format but zero and infinity, if `x` is neither.
    pub fn representable(self, x: f64) -> f64 {
        match self {
            Format::Single if x != 0.0 && x.is_finite() => {
                let size = x.abs().clamp(2f64.powi(-149), f64::from(f32::MAX));
                self.round(size).copysign(x)
            }
            _ => x,
        }
    }

    /// Makes each number of an input [`Format::representable`].
    pub(super) fn represent(self, input: &mut [f64]) {
        if self != Format::Double {
            input.iter_mut().for_each(|x| *x = self.representable(*x));
        }
    }
}

/// The exponent `k` of the unit in the last place, `ulp(x) = 2^k`: for `|x|` in `[2^e, 2^(e+1))`
/// it is `e − 52`, and never below −1074. Zero has the smallest unit.
///
/// A ball that straddles a power of two takes the exponent of its midpoint.
pub fn ulp_exponent(x: &Float) -> i64 {
    Format::Double.ulp_exponent(x)
}

/// Bounds on `|got − ref|` in ulps of the reference: `(at least, at most)`.
pub fn ulps(got: f64, reference: &Ball) -> (f64, f64) {
    let (lo, hi) = distance(got, reference, Format::Double);
    let k = -ulp_exponent(reference.mid());
    (lo.shift(k).to_f64(), hi.shift(k).to_f64())
}

/// Bounds on `|got − ref|`. Not a number is infinitely far. An infinity stands for all numbers that
/// round to it, the nearest of which counts.
pub(crate) fn distance(got: f64, reference: &Ball, format: Format) -> (Mag, Mag) {
    if got.is_nan() {
        return (Mag::INFINITY, Mag::INFINITY);
    }
    if got.is_infinite() {
        let gap = match got > 0.0 {
            true => format.overflow() - reference,
            false => format.overflow() + reference,
        };
        return match gap.is_finite() {
            true if gap.upper() <= 0 => (Mag::ZERO, Mag::ZERO),
            true => (gap.mignitude(), gap.magnitude()),
            false => (Mag::ZERO, Mag::INFINITY),
        };
    }
    reference.distance_from(got)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn a_third() {
        let third = Ball::rational(200, &Rational::from((1, 3)));
        // fl(1/3) = (2^54 - 1)/3 / 2^54, a third of an ulp below.
        let (lo, hi) = ulps(1.0 / 3.0, &third);
        assert!((lo - 1.0 / 3.0).abs() < 1e-9 && (hi - 1.0 / 3.0).abs() < 1e-9);
        let (lo, _) = ulps((1.0f64 / 3.0).next_up(), &third);
        assert!((lo - 2.0 / 3.0).abs() < 1e-9);
    }

    #[test]
    fn single_precision() {
        let f = Format::Single;
        assert_eq!(f.ulp_exponent(&Float::with_val(53, 1.0)), -23);
        assert_eq!(f.ulp_exponent(&Float::with_val(53, 1e-45)), -149);
        assert_eq!(f.round(0.1), f64::from(0.1f32));
        assert_eq!(f.representable(1e300), f64::from(f32::MAX));
        assert_eq!(f.representable(-1e-300), -(2f64.powi(-149)));
        assert!(f.representable(f64::NAN).is_nan() && f.representable(-0.0) == 0.0);
        assert_eq!(f.representable(f64::INFINITY), f64::INFINITY);
        // Infinity is right from half a unit beyond the largest on.
        let beyond = |x: f64| distance(f64::INFINITY, &Ball::exact(128, x), f).0;
        assert!(beyond(3.402_823_6e38).is_zero() && !beyond(3.4e38).is_zero());
    }

    /// A ball over the border of the range: an infinity may be right, and may be off by what lies
    /// below the border.
    #[test]
    fn an_infinity_next_to_the_border() {
        let edge = Format::Double.overflow();
        let half = Mag::power_of_two(960);
        let (lo, hi) = distance(f64::INFINITY, &edge.widened(half), Format::Double);
        assert!(lo.is_zero() && hi >= half && hi <= half.shift(1));
        let (lo, hi) = distance(f64::NEG_INFINITY, &-edge.widened(half), Format::Double);
        assert!(lo.is_zero() && hi >= half && hi <= half.shift(1));
        let beyond = &edge + &Ball::new(half.shift(1).to_float(), Mag::ZERO);
        let far = distance(f64::INFINITY, &beyond.widened(half), Format::Double);
        assert!(far.0.is_zero() && far.1.is_zero());
        assert_eq!(
            distance(f64::NEG_INFINITY, &beyond, Format::Double)
                .0
                .exponent(),
            Some(1024)
        );
        // Of f32 the border is 2^128 - 2^103.
        let single = Format::Single.overflow().to_f64();
        assert_eq!(single, 2f64.powi(128) - 2f64.powi(103));
    }

    /// A ball that begins at the border is beyond it; a number just below is not, however little.
    #[test]
    fn an_infinity_at_the_border() {
        let edge = Format::Double.overflow().mid().clone();
        let half = Mag::power_of_two(960);
        for sign in [1.0, -1.0] {
            let infinity = sign * f64::INFINITY;
            let at = |by: Float, radius: Mag| {
                let mid = (Float::with_val(1200, &edge) + by) * sign;
                distance(infinity, &Ball::new(mid, radius), Format::Double)
            };
            let zero = Float::new(64);
            let exact = |x: f64| (Mag::from_f64(x), Mag::from_f64(x));
            assert_eq!(at(zero, Mag::ZERO), exact(0.0));
            assert_eq!(at(half.to_float(), half), exact(0.0));
            assert_eq!(at(Float::with_val(64, -0.5), Mag::ZERO), exact(0.5));
        }
    }

    #[test]
    fn the_edges() {
        assert_eq!(ulp_exponent(&Float::with_val(53, 1.0)), -52);
        assert_eq!(ulp_exponent(&Float::with_val(53, 1.0f64.next_down())), -53);
        assert_eq!(ulp_exponent(&Float::with_val(53, f64::from_bits(1))), -1074);
        assert_eq!(ulp_exponent(&Float::with_val(53, 0.0)), -1074);
        let one = Ball::integer(64, 1);
        assert_eq!(ulps(f64::NAN, &one).0, f64::INFINITY);
        assert_eq!(ulps(f64::INFINITY, &one).0, f64::INFINITY);
        assert_eq!(ulps(1.0, &one), (0.0, 0.0));
        assert_eq!(ulps(-0.0, &Ball::integer(64, 0)), (0.0, 0.0));
    }

    /// Exact in 64 bits.
    #[test]
    fn borders_have_a_precision() {
        for format in [Format::Double, Format::Single] {
            let border = format.overflow();
            assert_eq!((border.prec(), border.rad()), (64, Mag::ZERO));
        }
    }
}

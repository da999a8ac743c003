//! The exponential that stands beside the series.

use super::coordinate::Coordinate;
use super::fixed_point::PREC;
use crate::{Ball, Mag};
use rug::Float;

/// `e^{−(x+iy)²} = c − i s`, each with a relative error below 2^-140 and an absolute one of the
/// third result; nothing where t = y² − x² is beyond 2^15, or a coordinate that is not exact beyond
/// 40.
///
/// Exact coordinates: y − x, y + x and their product are rounded once each, so the error of t is
/// below 2^-158 |t| ≤ 2^-143, and the angle 2xy is exact (106 bits). Others are known to 2^-158:
/// the error of y − x is below 2^-151, that of t below 2^-143. The angle has a relative error below
/// 2^-156, and so sin and cos the absolute error 2xy 2^-156, which is doubled.
#[inline]
pub fn gaussian(x: &Coordinate, y: &Coordinate) -> Option<(Float, Float, Mag)> {
    let (a, b) = (&x.value, &y.value);
    let exact = x.exact && y.exact;
    let t = Float::with_val(PREC, b - a) * Float::with_val(PREC, b + a);
    if *t.as_abs() > 1u32 << 15 || !exact && x.double.max(y.double) >= 40.0 {
        return None;
    }
    let e = t.exp();
    let angle = Float::with_val(PREC, a * b) << 1u32;
    let slack = if exact {
        Mag::ZERO
    } else {
        Mag::above(&angle).mul(Mag::above(&e)).shift(-155)
    };
    let (s, c) = angle.sin_cos(Float::new(PREC));
    Some((c * &e, s * e, slack))
}

/// One of the two as a ball.
#[inline]
pub fn ball(f: Float, slack: Mag) -> Ball {
    let error = Mag::above(&f).shift(-140).add(slack);
    Ball::new(f, error)
}

/// A bound on `e^{−Re z²}` for |Im z| ≤ |Re z|, at most one; log₂ e is more than 1.442.
#[inline]
pub fn bound(x: &Coordinate, y: &Coordinate) -> Mag {
    let (x, y) = (x.double * (1.0 - 1e-15), y.double * (1.0 + 1e-15));
    above_power(-1.442 * ((x - y) * (x + y)).max(0.0))
}

/// Returns whether so little is less than 2^-8 of what may be missing from a number of that number
/// of bits.
#[inline]
pub fn negligible(bound: Mag, beside: &Ball, bits: u32) -> bool {
    bound <= beside.mignitude().shift(-i64::from(bits) - 8)
}

/// 2^x or more.
#[inline]
pub fn above_power(x: f64) -> Mag {
    Mag::power_of_two(x.ceil().max(-1e12) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ComplexBall;
    use crate::faddeeva::argument::Real;
    use crate::faddeeva::tests::q;
    use rug::Rational;

    fn double(x: f64) -> Coordinate {
        Coordinate::new(&Real::Double(x)).unwrap()
    }

    fn rational(q: Rational) -> Coordinate {
        Coordinate::new(&Real::Rational(q)).unwrap()
    }

    /// Of the two within 2^-141 of themselves, and the slack of what is not exact.
    #[test]
    fn errors_are_those_of_the_head() {
        let places = [
            (0.0, 1.0),
            (1.0, 0.0),
            (0.3, 0.7),
            (9.5, 1e-3),
            (39.9, 39.8),
            (39.5, 1.0),
            (1.0, 39.0),
            (1e-200, 3.0),
        ];
        for (k, (x, y)) in places.into_iter().enumerate() {
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                // A third of a unit of the last place more: no double.
                let with = |x: f64, d: i32| q(x) + Rational::from((d, 3)) * q(x) / (1i64 << 53);
                let (u, v) = (with(x, dx), with(y, dy));
                let of = |u: &Rational, x: f64, d| match d {
                    0 => double(x),
                    _ => rational(u.clone()),
                };
                let (c, s, slack) = gaussian(&of(&u, x, dx), &of(&v, y, dy)).unwrap();
                let z = ComplexBall::rational(900, &u, &v);
                let e = (-&z.square()).exp();
                for (found, due) in [(c, &e.re), (s, &-&e.im)] {
                    let off = Float::with_val(300, due.mid() - &found).abs();
                    let most = Float::with_val(300, found.abs_ref()) >> 141;
                    let most = most + Float::with_val(300, slack.to_float()) / 2u32;
                    assert!(off <= most, "{k}: {off} {most}");
                }
                let angle = Float::with_val(300, z.re.mid() * z.im.mid());
                let size: Float = (angle * Float::with_val(300, y * y - x * x).exp()) >> 154;
                let slack: Float = Float::with_val(300, slack.to_float());
                match dx + dy {
                    0 => assert!(slack.is_zero()),
                    _ => {
                        let off: Float = (slack - size.clone()).abs();
                        assert!(off <= size * 1e-9, "{k}: {off}");
                    }
                }
            }
        }
    }

    /// A bound of 53 bits on the slack lies above a product of 160.
    #[test]
    fn slack_is_from_above() {
        for n in 1..40 {
            let (x, y) = (Rational::from((n, 7)), Rational::from((n + 1, 11)));
            let (a, b) = (rational(x), rational(y));
            let t = Float::with_val(160, &b.value - &a.value)
                * Float::with_val(160, &b.value + &a.value);
            let size = (Float::with_val(400, &a.value * &b.value) >> 154) * t.exp();
            let (_, _, slack) = gaussian(&a, &b).unwrap();
            let size = size * (1.0 - 2f64.powi(-100));
            assert!(slack.to_float() >= size, "{n}");
        }
    }

    /// t up to 2^15 in modulus; what is not exact below 40.
    #[test]
    fn there_are_limits() {
        // In either order.
        let some = |x: &Coordinate, y: &Coordinate| {
            let found = [gaussian(x, y), gaussian(y, x)].map(|g| g.is_some());
            assert_eq!(found[0], found[1]);
            found[0]
        };
        // (y − x)(y + x) = 128 · 256, and a bit more.
        assert!(some(&double(64.0), &double(192.0)));
        assert!(!some(&double(64.0), &double(192.0f64.next_up())));
        assert!(some(&double(1e9), &double(1e9)));
        let (below, at) = (Rational::from((119, 3)), Rational::from(40));
        let third = || rational(Rational::from((1, 3)));
        for (other, due) in [(below, true), (at, false)] {
            assert_eq!(some(&third(), &rational(other.clone())), due);
            assert_eq!(some(&rational(other), &double(1.0)), due);
        }
        assert!(!some(&third(), &double(50.0)) && some(&third(), &double(39.0)));
    }

    #[test]
    fn balls_have_the_relative_error_and_the_slack() {
        let f = |x: f64| Float::with_val(300, x);
        let long: Float = f(1.5) + (f(1.0) >> 100);
        for (slack, more) in [
            (Mag::ZERO, f(0.0)),
            (Mag::power_of_two(-141), f(1.0) >> 141),
        ] {
            let ball = ball(-long.clone(), slack);
            let found: Float = f(1.0) * ball.rad().to_float();
            let due: Float = (long.clone() >> 140) + more;
            assert!(*ball.mid() == -long.clone());
            assert!(
                found >= due && found <= due.clone() * (1.0 + 1e-12),
                "{found} {due}"
            );
        }
    }

    /// From the true value to two times its power 1442/1443.
    #[test]
    fn bounds_are_near() {
        for (x, y) in [
            (7.0, 3.0),
            (0.5, 0.25),
            (10.0, 0.0),
            (10.0, 9.9),
            (1e5, 1.0),
            (1e3, 999.0),
        ] {
            let due = -(x - y) * (x + y) * std::f64::consts::LOG2_E;
            let found = bound(&double(x), &double(y)).exponent().unwrap() as f64;
            assert!(
                found >= due && found < due * 0.9995 + 1.0,
                "{x} {y}: {found} {due}"
            );
        }
        // Not more than one, on the diagonal and above it.
        for (x, y) in [(3.0, 3.0), (3.0, 7.0), (0.0, 0.0), (1e300, 1e300)] {
            assert_eq!(
                bound(&double(x), &double(y)),
                Mag::power_of_two(0),
                "{x} {y}"
            );
        }
    }

    /// Two numbers that are next to each other and rounded away from each other.
    #[test]
    fn bounds_allow_for_rounded_coordinates() {
        for k in [30, 40, 50] {
            let base: Rational = Rational::from(1) << k;
            let ulp: Rational = Rational::from((1, 100)) << (k - 52);
            let x: Rational = base.clone() + ulp.clone() * 51;
            let y: Rational = base + ulp * 49;
            let t = (x.clone() - &y) * (x.clone() + &y);
            let (x, y) = (rational(x), rational(y));
            assert!(x.double > y.double);
            let due = -t.to_f64() * std::f64::consts::LOG2_E;
            let found = bound(&x, &y).exponent().unwrap() as f64;
            assert!(found >= due, "{k}: {found} {due}");
        }
    }

    /// 2^-8 of 2^-bits of the least that the other may be.
    #[test]
    fn what_may_be_left_out() {
        let beside = Ball::exact(64, -1.5).widened(Mag::from_f64(0.25));
        for (bound, bits, due) in [
            (-18, 10, true),
            (-17, 10, false),
            (-108, 100, true),
            (-107, 100, false),
        ] {
            assert_eq!(
                negligible(Mag::power_of_two(bound), &beside, bits),
                due,
                "{bound}"
            );
        }
        // From 0.75 to 2.25, and a number without a radius.
        let wide = Ball::exact(64, 1.5).widened(Mag::from_f64(0.75));
        assert!(!negligible(Mag::power_of_two(-18), &wide, 10));
        assert!(negligible(
            Mag::power_of_two(-18),
            &Ball::exact(64, 1.0),
            10
        ));
        assert!(!negligible(
            Mag::power_of_two(-500),
            &Ball::exact(64, 0.0),
            10
        ));
    }

    #[test]
    fn powers_are_from_above() {
        for (x, due) in [(2.0, 2), (2.0f64.next_up(), 3), (-2.5, -2), (-0.1, 0)] {
            assert_eq!(above_power(x), Mag::power_of_two(due), "{x}");
        }
        // Exponents that can still be added to.
        for x in [-1e12, -1e15, -1e300, f64::NEG_INFINITY] {
            assert_eq!(above_power(x), Mag::power_of_two(-1_000_000_000_000));
        }
    }
}

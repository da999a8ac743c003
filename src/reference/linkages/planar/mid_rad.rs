//! Real numbers as `f64` midpoint and radius, for bounds that need no digits.
//!
//! A sum or product rounded to nearest is off by at most u = 2⁻⁵³ of its size or by half the
//! smallest subnormal, and so is each of the operations by which a radius is computed, of which
//! there are fewer than eight: a factor of 1 + 16 u and the smallest normal number take them in.
//! A value that is not finite is unbounded.

use super::scalar::Scalar;
use crate::{Ball, Mag};
use rug::Float;

/// The numbers within `rad` of `mid`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MidRad {
    mid: f64,
    rad: f64,
}

const U: f64 = f64::EPSILON / 2.0;

/// Above a radius that was computed in a few operations.
fn above(rad: f64) -> f64 {
    rad * (1.0 + 16.0 * U) + f64::MIN_POSITIVE
}

impl MidRad {
    /// An exact number.
    pub(super) fn exact(mid: f64) -> MidRad {
        MidRad { mid, rad: 0.0 }
    }

    /// Returns what a ball holds.
    pub(super) fn of(b: &Ball) -> MidRad {
        let mid = b.mid().to_f64();
        if *b.mid() == mid && b.rad().is_zero() {
            return MidRad::exact(mid);
        }
        let rad = above(b.rad().to_f64() + mid.abs() * U);
        MidRad { mid, rad }
    }

    fn to_ball(self) -> Ball {
        Ball::exact(64, self.mid).widened(Mag::from_f64(self.rad))
    }

    fn is_zero(self) -> bool {
        self.mid == 0.0 && self.rad == 0.0
    }

    fn sum(mid: f64, a: MidRad, b: MidRad) -> MidRad {
        let rad = above(a.rad + b.rad + mid.abs() * U);
        MidRad { mid, rad }
    }
}

impl Scalar for MidRad {
    fn real(b: &Ball) -> MidRad {
        MidRad::of(b)
    }
    fn plus(&self, other: &MidRad) -> MidRad {
        match (self.is_zero(), other.is_zero()) {
            (true, _) => *other,
            (_, true) => *self,
            _ => MidRad::sum(self.mid + other.mid, *self, *other),
        }
    }
    fn minus(&self, other: &MidRad) -> MidRad {
        let negative = MidRad {
            mid: -other.mid,
            rad: other.rad,
        };
        self.plus(&negative)
    }
    fn times(&self, other: &MidRad) -> MidRad {
        if self.is_zero() || other.is_zero() {
            return MidRad::exact(0.0);
        }
        let mid = self.mid * other.mid;
        let propagated = self.mid.abs() * other.rad + self.rad * (other.mid.abs() + other.rad);
        let rad = above(propagated + mid.abs() * U);
        MidRad { mid, rad }
    }
    fn by(&self, k: &Ball) -> MidRad {
        self.times(&MidRad::of(k))
    }
    fn by_f64(&self, k: f64) -> MidRad {
        self.times(&MidRad::exact(k))
    }
    /// By MPFR, whose results are rounded correctly; both functions are 1-Lipschitz and bounded by
    /// one.
    fn cos_sin(&self) -> (MidRad, MidRad) {
        let (mut sine, mut cosine) = (Float::with_val(53, self.mid), Float::new(53));
        sine.sin_cos_mut(&mut cosine);
        let rad = above(self.rad.min(2.0) + U);
        let [c, s] = [cosine.to_f64(), sine.to_f64()].map(|mid| MidRad { mid, rad });
        (c, s)
    }
    fn over_root(&self) -> MidRad {
        MidRad::of(&self.to_ball().over_root())
    }
    fn size(&self) -> Mag {
        Mag::from_f64(above(self.mid.abs() + self.rad))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A number in a ball about as wide as told, and the ball.
    fn held((mid, wide, part): (f64, i32, f64)) -> (Float, MidRad) {
        let rad = mid.abs() * 2f64.powi(wide);
        let x = Float::with_val(300, rad) * part + mid;
        (x, MidRad { mid, rad })
    }

    fn holds(b: MidRad, x: &Float) -> bool {
        let off = Float::with_val(300, x - b.mid).abs();
        off <= b.rad
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn results_are_held(
            a in (-1e3f64..1e3, -60i32..2, -1.0f64..1.0),
            b in (-1e3f64..1e3, -60i32..2, -1.0f64..1.0),
            k in -1e3f64..1e3,
        ) {
            let ((x, a), (y, b)) = (held(a), held(b));
            prop_assert!(holds(a, &x) && holds(b, &y));
            let wide = |v: Float| Float::with_val(300, v);
            prop_assert!(holds(a.plus(&b), &wide(x.clone() + &y)));
            prop_assert!(holds(a.minus(&b), &wide(x.clone() - &y)));
            prop_assert!(holds(a.times(&b), &wide(x.clone() * &y)));
            prop_assert!(holds(a.by_f64(k), &wide(x.clone() * k)));
            let third = Ball::rational(100, &rug::Rational::from((1, 3)));
            prop_assert!(holds(a.by(&third), &wide(x.clone() / 3)));
            let (c, s) = a.cos_sin();
            prop_assert!(holds(c, &wide(x.clone().cos())) && holds(s, &wide(x.clone().sin())));
            prop_assert!(a.size() >= Mag::below(&x));
            // Wide enough, and no wider than it has to be.
            prop_assert!(a.times(&b).rad <= 1.001 * (a.mid.abs() * b.rad + a.rad * (b.mid.abs() + b.rad))
                + 2.0 * U * (a.mid * b.mid).abs() + 1e-300);
        }
    }

    /// Each part of a radius where nothing else is there to make up for it.
    #[test]
    fn every_part_of_a_radius_is_needed() {
        let small = 2f64.powi(-54);
        let sum = MidRad::exact(1.0).plus(&MidRad::exact(small));
        assert!(sum.mid == 1.0 && sum.rad >= small);
        let one = MidRad { mid: 1.0, rad: 1.0 };
        // Up to 2 · 2.
        let square = one.times(&one);
        assert!(square.mid + square.rad >= 4.0);
        let third = rug::Rational::from((1, 3));
        let ours = MidRad::of(&Ball::rational(100, &third));
        assert!(holds(ours, &Float::with_val(300, &third)));
    }

    /// 1 + 2⁻⁵⁴ is rounded to 1 in f64: the factor in `above` takes it in where no midpoint does.
    #[test]
    fn radii_are_rounded_up() {
        let small = 2f64.powi(-54);
        let (a, b) = (
            MidRad { mid: 1.0, rad: 1.0 },
            MidRad {
                mid: -1.0,
                rad: small,
            },
        );
        let sum = a.plus(&b);
        assert_eq!(sum.mid, 0.0);
        assert!(sum.rad >= Float::with_val(100, 1) + small);
    }

    /// A ball with a midpoint in f64 is no exact number.
    #[test]
    fn a_ball_keeps_its_radius() {
        let wide = MidRad::of(&Ball::exact(64, 1.0).widened(Mag::from_f64(0.25)));
        assert!(wide.rad >= 0.25);
        assert_eq!(MidRad::of(&Ball::exact(64, 1.0)).rad, 0.0);
    }

    /// Zero loses and gains nothing, and what is about zero is not zero.
    #[test]
    fn zero_is_exact() {
        let (zero, wide) = (MidRad::exact(0.0), MidRad { mid: 0.0, rad: 1.0 });
        let unbounded = MidRad::exact(1e300).times(&MidRad::exact(1e300));
        let tenth = MidRad {
            mid: 0.1,
            rad: 1e-30,
        };
        for x in [wide, tenth, unbounded] {
            assert_eq!([zero.times(&x), x.times(&zero)], [zero; 2]);
            assert_eq!([zero.plus(&x), x.plus(&zero), x.minus(&zero)], [x; 3]);
        }
        let five = MidRad::exact(5.0);
        for sum in [wide.plus(&five), five.plus(&wide), five.minus(&wide)] {
            assert!(sum.mid == 5.0 && sum.rad >= 1.0);
        }
        assert!(wide.times(&five).rad >= 5.0 && five.times(&wide).rad >= 5.0);
    }

    /// Cosine and sine of an exact number are off by a rounding, of a wide one by two at most.
    #[test]
    fn cosines_of_exact_and_of_wide_numbers() {
        for x in [1.0, -2.5, 0.7, 40.0] {
            let (c, s) = MidRad::exact(x).cos_sin();
            let due = Float::with_val(300, x).sin_cos(Float::new(300));
            assert!(holds(c, &due.1) && holds(s, &due.0), "{x}");
            assert!(c.rad < 1.001 * U && s.rad < 1.001 * U);
        }
        for rad in [3.0, 1e9, f64::INFINITY] {
            let (c, s) = MidRad { mid: 0.3, rad }.cos_sin();
            assert!([c, s].iter().all(|x| x.rad >= 2.0 && x.rad < 2.001));
        }
    }

    /// An inverse root holds those of both ends, and there is none across zero.
    #[test]
    fn inverse_roots_are_held() {
        let wide = MidRad { mid: 2.0, rad: 0.5 }.over_root();
        for x in [1.5, 2.0, 2.5] {
            let root = Float::with_val(300, x).sqrt().recip();
            assert!(holds(wide, &root), "{x}");
        }
        assert!(wide.rad < 0.3);
        let half = MidRad::exact(4.0).over_root();
        assert!(holds(half, &Float::with_val(300, 0.5)) && half.rad < 4.0 * U);
        let across = MidRad { mid: 1.0, rad: 1.5 }.over_root();
        assert!(!across.size().is_finite());
    }

    #[test]
    fn what_is_not_finite_has_no_bound() {
        let large = MidRad::exact(1e300);
        for b in [
            large.times(&large),
            large.times(&large).minus(&large.times(&large)),
        ] {
            assert!(!b.size().is_finite());
        }
        assert!(!MidRad::exact(f64::NAN).size().is_finite());
        assert!(!MidRad::exact(0.0).size().is_zero());
        // Below the range of f64, and not zero.
        let tiny = Ball::new(Float::with_val(64, 1) >> 1100, Mag::ZERO);
        assert!(
            MidRad::of(&tiny).rad > 0.0
                && MidRad::of(&-tiny).times(&large).size() >= Mag::from_f64(1e-20)
        );
    }
}

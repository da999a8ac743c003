//! Tests of `ball`.

use super::*;
use proptest::prelude::*;

const P: u32 = 60;
const HIGH: u32 = 400;

/// A ball of low precision and a point of high precision inside it.
fn ball() -> impl Strategy<Value = (Ball, Float)> {
    (-1e3f64..1e3, 0u32..60, -1.0f64..1.0).prop_map(|(m, k, t)| {
        let rad = Mag::power_of_two(-i64::from(k));
        let point = Float::with_val(HIGH, t) * rad.to_float() + m;
        (Ball::new(Float::with_val(P, m), rad), point)
    })
}

fn holds(b: &Ball, x: &Float) -> bool {
    // The high-precision value is itself within 2^-300 of the truth.
    b.widened(Mag::power_of_two(-300))
        .contains(&x.to_rational().unwrap())
}

proptest! {
    #[test]
    fn containment((a, x) in ball(), (b, y) in ball()) {
        prop_assert!(holds(&(&a + &b), &Float::with_val(HIGH, &x + &y)));
        prop_assert!(holds(&(&a - &b), &Float::with_val(HIGH, &x - &y)));
        prop_assert!(holds(&(&a * &b), &Float::with_val(HIGH, &x * &y)));
        prop_assert!(holds(&(&a / &b), &Float::with_val(HIGH, &x / &y)));
        prop_assert!(holds(&a.square(), &Float::with_val(HIGH, x.square_ref())));
        prop_assert!(holds(&a.abs(), &Float::with_val(HIGH, x.abs_ref())));
        let (s, c) = a.sin_cos();
        prop_assert!(holds(&s, &Float::with_val(HIGH, x.sin_ref())));
        prop_assert!(holds(&c, &Float::with_val(HIGH, x.cos_ref())));
        if a.is_positive() {
            prop_assert!(holds(&a.sqrt(), &Float::with_val(HIGH, x.sqrt_ref())));
        }
        let u = a.union(&b);
        prop_assert!(u.contains_ball(&a) && u.contains_ball(&b));
    }

    #[test]
    fn angle_containment((a, y) in ball(), (b, x) in ball()) {
        let angle = a.atan2(&b);
        let exact = Float::with_val(HIGH, y.atan2_ref(&x));
        let turn = Float::with_val(HIGH, Constant::Pi) * 2;
        let shifted = [exact.clone(), Float::with_val(HIGH, &exact + &turn), Float::with_val(HIGH, &exact - &turn)];
        prop_assert!(shifted.iter().any(|t| holds(&angle, t)));
    }

    #[test]
    fn radii_are_tight(m in 1.0f64..1e3, n in 1.0f64..1e3) {
        let (a, b) = (Ball::exact(P, m), Ball::exact(P, n));
        prop_assert!((&a + &b).accuracy_bits() >= 58);
        prop_assert!((&a * &b).accuracy_bits() >= 58);
        prop_assert!((&a / &b).accuracy_bits() >= 58);
        prop_assert!(a.sqrt().accuracy_bits() >= 57);
    }
}

#[test]
fn a_ball_that_only_touches_zero_has_no_sign() {
    // The radius is the midpoint, or a unit of 2⁻⁹⁰ more or less.
    let mid = Float::with_val(120, 1) + (Float::with_val(120, 1) >> 90u32);
    let ball = |mid: &Float, rad: f64| Ball::new(mid.clone(), Mag::from_f64(rad));
    let one = Float::with_val(120, 1);
    for sign in [1, -1] {
        let at = |mid: &Float, rad| ball(&Float::with_val(120, mid * sign), rad);
        let signs = |b: &Ball| (b.is_positive(), b.is_negative(), b.contains_zero());
        let apart = (sign > 0, sign < 0, false);
        assert_eq!(signs(&at(&mid, 1.0)), apart);
        assert_eq!(signs(&at(&one, 1.0)), (false, false, true));
        assert_eq!(signs(&at(&mid, 1.0f64.next_up())), (false, false, true));
        assert_eq!(signs(&at(&mid, 0.0)), apart);
    }
    assert!(Ball::integer(120, 0).contains_zero());
}

/// A box whose corner may be the origin has no angle, the next smaller one has.
#[test]
fn angles_end_where_the_box_reaches_the_origin() {
    let one = Mag::from_f64(1.0);
    let sizes = (0..9).map(|k| Mag::from_f64(1.0 - f64::from(k) * f64::EPSILON / 2.0));
    let mut reaching = 0;
    for rad in sizes {
        let rho = rad.mul(rad).sqrt();
        let y = Ball::integer(P, 0).widened(rad);
        let angle = y.atan2(&Ball::integer(P, 1));
        assert_eq!(angle.is_finite(), rho < one, "{rad:?}");
        reaching += u32::from(rho == one);
    }
    assert!(reaching > 0);
    assert!(!Ball::integer(P, 0).atan2(&Ball::integer(P, 0)).is_finite());
}

/// Against differences in MPFR that lose nothing.
#[test]
fn distances_are_exact_and_hold_the_radius() {
    let exact = |m: Mag| Float::with_val(4000, m.to_float());
    let mut on_integers = 0;
    for bits in [53, 64, 65, 100, 128, 129, 300] {
        for k in [-1080, -1022, -3, 0, 1, 1000] {
            let third: Float = Float::with_val(bits, 1) / 3;
            let below = Float::with_val(bits, 1) - (Float::with_val(bits, 1) >> (bits - 1));
            for mid in [third.clone(), below, -third, Float::with_val(bits, 1)] {
                let mid: Float = mid << k;
                let near = mid.to_f64();
                let wrong = [
                    -near,
                    2.0 * near,
                    near / 3.0,
                    0.0,
                    1e-320,
                    f64::MAX,
                    near * 1e9,
                ];
                for x in [near, near.next_up(), near.next_down()]
                    .into_iter()
                    .chain(wrong)
                {
                    let x = x.clamp(f64::MIN, f64::MAX);
                    let rad = Mag::power_of_two(i64::from(k) - 60);
                    let truth = (Float::with_val(4000, x) - &mid).abs();
                    let sharp = Ball::new(mid.clone(), Mag::ZERO);
                    on_integers += u32::from(sharp.on_integers(x));
                    let (low, high) = sharp.distance_from(x);
                    assert!(exact(low) <= truth && truth <= exact(high), "{mid} {x}");
                    let gap = exact(high) - exact(low);
                    assert!(gap <= truth.clone() * 1e-15, "{mid} {x}");
                    let (low, high) = Ball::new(mid.clone(), rad).distance_from(x);
                    let r = exact(rad);
                    let (least, most) = (truth.clone() - &r, truth + &r);
                    assert!(
                        exact(high) >= most && exact(low) <= least.clone().max(&Float::new(64))
                    );
                    assert!(exact(low) > 0 || least <= 1e-15 * r, "{mid} {x}");
                }
            }
        }
    }
    assert!(on_integers > 100, "{on_integers}");
}

/// Bit for bit what bounds with exponents are, in units.
#[test]
fn distances_in_doubles_are_those_of_bounds() {
    let mut found = 0;
    for bits in [53, 64, 65, 100, 160, 300] {
        for k in [-1000, -3, 0, 1, 1000] {
            let third: Float = Float::with_val(bits, 1) / 3;
            let below = Float::with_val(bits, 1) - (Float::with_val(bits, 1) >> (bits - 1));
            for mid in [third.clone(), below, -third, Float::with_val(bits, 1)] {
                let mid: Float = mid << k;
                let near = mid.to_f64();
                let power = (1.5 * near).to_bits() >> 52 << 52;
                let moved =
                    [0.0, 1e-16, -3e-16, 1e-9, -0.25, 0.6, -0.8, 1.1].map(|by| near + near * by);
                for x in moved.into_iter().chain([f64::from_bits(power)]) {
                    for r in [
                        None,
                        Some(-500),
                        Some(-290),
                        Some(-120),
                        Some(-53),
                        Some(-20),
                        Some(-5),
                    ] {
                        let rad =
                            r.map_or(Mag::ZERO, |r| Mag::from_f64(1.1).shift(r + i64::from(k)));
                        let ball = Ball::new(mid.clone(), rad);
                        let Some(apart) = ball.apart_from(x) else {
                            continue;
                        };
                        found += 1;
                        let bound = |x: f64| Mag::from_f64(x).shift(apart.unit);
                        let due = (ball.mignitude(), ball.distance_from(x));
                        let (least, most) = (bound(apart.least), bound(apart.most));
                        assert_eq!((bound(apart.size), (least, most)), due, "{ball:?} {x}");
                        let units = Float::with_val(bits, mid.abs_ref()) >> apart.unit as i32;
                        assert!(units >= 2f64.powi(127) && units < 2f64.powi(128));
                    }
                    let none = [Mag::INFINITY, Mag::power_of_two(i64::from(k) - 3)];
                    let none = none.map(|rad| Ball::new(mid.clone(), rad).apart_from(x));
                    assert_eq!(none, [None, None]);
                }
                let bad = [-near, 0.0, 1e-320, f64::NAN, f64::INFINITY, 4.0 * near];
                let sharp = Ball::new(mid, Mag::ZERO);
                assert!(bad.iter().all(|x| sharp.apart_from(*x).is_none()));
            }
        }
    }
    assert!(found > 3000, "{found}");
}

/// The power of two above a number is at the exact distance, however near it is.
#[test]
fn the_next_power_of_two_is_at_an_exact_distance() {
    for bits in [53, 64, 65, 100, 128, 130, 160, 192, 200, 260, 400] {
        for k in 2..bits as i32 {
            for and in [None, Some(k + 1), Some(k + 60), Some(bits as i32)] {
                let mut mid = Float::with_val(bits, 1) - (Float::with_val(bits, 1) >> k);
                let Some(and) = and.filter(|and| (k..=bits as i32).contains(and)) else {
                    continue;
                };
                mid -= Float::with_val(bits, 1) >> and;
                for rad in [Mag::ZERO, Mag::power_of_two(-100), Mag::power_of_two(-20)] {
                    for sign in [1.0, -1.0] {
                        let ball = Ball::new(mid.clone() * sign, rad);
                        let Some(apart) = ball.apart_from(sign) else {
                            // The difference begins below four limbs.
                            assert!(bits >= 200 && k > 190, "{bits} {k} {and}");
                            continue;
                        };
                        let bound = |x: f64| Mag::from_f64(x).shift(apart.unit);
                        let found = (bound(apart.least), bound(apart.most));
                        assert_eq!(found, ball.distance_from(sign), "{bits} {k} {and}");
                        assert_eq!(bound(apart.size), ball.mignitude());
                    }
                }
            }
        }
    }
}

#[test]
fn exact_stays_exact() {
    let a = Ball::exact(P, 0.75);
    assert!((&a + &a).rad().is_zero());
    assert!((&a * &a).rad().is_zero());
    assert!(Ball::rational(P, &Rational::from((3, 8))).rad().is_zero());
    assert!(!Ball::rational(P, &Rational::from((1, 3))).rad().is_zero());
}

/// Checks that a product below MPFR's least positive number stays inside its ball.
#[test]
fn underflow_is_part_of_the_radius() {
    let power = |e: i32| Ball::new(Float::with_val(64, 1) << e, Mag::ZERO);
    // 3/4 of the least positive number rounds to it, 1/4 of it to zero.
    let three_quarters = Ball::new(Float::with_val(64, 3) << (exp_min() / 2), Mag::ZERO);
    for (a, b) in [
        (three_quarters, power(exp_min() - 3 - exp_min() / 2)),
        (power(exp_min() / 2), power(exp_min() - 3 - exp_min() / 2)),
    ] {
        let product = &a * &b;
        // The exact product is below the least positive number, 2^(exp_min − 1).
        let off = Mag::power_of_two(i64::from(exp_min()) - 3);
        assert!(
            product.mid().is_zero() && !product.is_finite() || product.rad() >= off,
            "{product:?}"
        );
    }
}

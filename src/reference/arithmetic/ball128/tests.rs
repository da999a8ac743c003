//! The operations against exact rational numbers in the operands' balls.

use super::{Ball128, root};
use crate::{Ball, Mag};
use proptest::prelude::*;
use rug::{Float, Integer, Rational};
use std::cmp::Ordering;

/// `m 2^e` as a rational number.
fn rational(m: u128, e: i64) -> Rational {
    let e = i32::try_from(e).unwrap();
    Rational::from(Integer::from(m)) << e
}

/// The number that is `part` radii away from the midpoint.
fn inside(x: &Ball128, part: f64) -> Rational {
    let mid = rational(x.m, x.e);
    let mid = if x.negative { -mid } else { mid };
    let radius = Rational::from_f64(x.r).unwrap() << i32::try_from(x.e).unwrap();
    mid + radius * Rational::from_f64(part).unwrap()
}

fn contains(x: &Ball128, q: &Rational) -> bool {
    let distance = (q - inside(x, 0.0)).abs();
    distance <= Rational::from_f64(x.r).unwrap() << i32::try_from(x.e).unwrap()
}

/// Midpoints with few and with many bits, next to powers of two among them; radii from zero to more
/// than the midpoint.
fn balls() -> impl Strategy<Value = Ball128> {
    let midpoints = prop_oneof![
        any::<u128>(),
        any::<u64>().prop_map(u128::from),
        (0_u32..128).prop_map(|k| 1 << k),
        (1_u32..128).prop_map(|k| (1 << k) - 1),
        (0_u32..128).prop_map(|k| u128::MAX << k),
        Just(0),
    ];
    let radii = prop_oneof![
        Just(0.0),
        0.0..8.0,
        (0_i32..140).prop_map(|k| 1.5 * 2_f64.powi(k)),
        Just(1e-30),
    ];
    let exponents = prop_oneof![-4_i64..4, -140_i64..140, Just(0)];
    (midpoints, radii, exponents, any::<bool>())
        .prop_filter_map("too wide", |(m, r, e, negative)| {
            Ball128::normal(negative && m != 0, m, e, r)
        })
}

fn parts() -> impl Strategy<Value = f64> {
    prop_oneof![Just(-1.0), Just(1.0), Just(0.0), -1.0..1.0]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn sums_differences_and_products_are_enclosed(a in balls(), b in balls(), s in parts(), t in parts()) {
        let (x, y) = (inside(&a, s), inside(&b, t));
        let found = [a.add(&b), a.sub(&b), a.mul(&b)];
        let exact = [
            Rational::from(&x + &y),
            Rational::from(&x - &y),
            Rational::from(&x * &y),
        ];
        for (found, exact) in found.iter().zip(&exact) {
            if let Some(found) = found {
                prop_assert!(contains(found, exact), "{a:?} {b:?} {found:?}");
                prop_assert!(found.m == 0 || found.m >> 127 == 1);
            }
        }
    }

    #[test]
    fn integers_below_are_those_of_all_numbers(a in balls(), s in parts(), k in -70_i64..70) {
        let a = a.shift(k - a.e - 128);
        if let Some(n) = a.floor() {
            prop_assert_eq!(Integer::from(n), inside(&a, s).floor().numer().clone());
        } else if a.is_exact() {
            prop_assert!(a.e + 128 > 62, "{:?}", a);
        }
    }

    #[test]
    fn quotients_are_enclosed(a in balls(), b in balls(), s in parts(), t in parts()) {
        let (x, y) = (inside(&a, s), inside(&b, t));
        if let Some(found) = a.div(&b) {
            prop_assert!(y.cmp0() != Ordering::Equal);
            prop_assert!(contains(&found, &Rational::from(&x / &y)), "{a:?} {b:?} {found:?}");
        }
    }

    #[test]
    fn roots_are_enclosed(a in balls(), s in parts()) {
        if let Some(found) = a.sqrt() {
            let x = inside(&a, s);
            prop_assert!(x.cmp0() != Ordering::Less);
            let radius = Rational::from_f64(found.r).unwrap() << i32::try_from(found.e).unwrap();
            let [low, high] = [inside(&found, 0.0) - &radius, inside(&found, 0.0) + &radius];
            prop_assert!(low.cmp0() == Ordering::Less || Rational::from(low.square_ref()) <= x);
            prop_assert!(Rational::from(high.square_ref()) >= x, "{a:?} {found:?}");
        }
    }

    #[test]
    fn integer_roots_are_exact(m in any::<u128>(), low in any::<u128>()) {
        let x = m | 1 << 126;
        let (s, is_exact) = root(x, low);
        let radicand: Integer = (Integer::from(x) << 128) + Integer::from(low);
        let (expected, rest) = radicand.sqrt_rem(Integer::new());
        prop_assert_eq!(Integer::from(s), expected);
        prop_assert_eq!(is_exact, rest == 0);
    }

    #[test]
    fn powers_are_enclosed(a in balls(), k in -9_i32..9, s in parts()) {
        if let Some(found) = a.power(k) {
            use rug::ops::Pow;
            let x = inside(&a, s);
            prop_assert!(k >= 0 || x.cmp0() != Ordering::Equal);
            prop_assert!(contains(&found, &x.pow(k)), "{a:?} {k} {found:?}");
        }
    }

    #[test]
    fn signs_and_accuracies_hold(a in balls(), s in parts()) {
        let x = inside(&a, s);
        if let Some(sign) = a.sign() {
            prop_assert_eq!(x.cmp0(), sign);
        }
        if let Some(bits) = a.accuracy().filter(|bits| *bits > 0 && *bits < 1000) {
            let radius = Rational::from_f64(a.r).unwrap() << i32::try_from(a.e).unwrap();
            prop_assert!(radius << i32::try_from(bits).unwrap() <= x.abs());
        }
    }

    #[test]
    fn exponents_are_bounds(a in balls(), s in parts()) {
        let x = inside(&a, s).abs();
        let power = |e: i64| Rational::from(1) << i32::try_from(e).unwrap();
        let [upper, lower, radius] = a.exponents();
        prop_assert!(upper.map_or(x == 0, |e| x < power(e)));
        prop_assert!(lower.is_none_or(|e| power(e) <= x));
        prop_assert!(radius.map_or(a.r == 0.0, |e| rational(1, a.e) * Rational::from_f64(a.r).unwrap() < power(e)));
    }

    #[test]
    fn nearest_doubles_are_those_of_all_numbers(a in balls(), s in parts()) {
        if let Some(found) = a.nearest_f64() {
            let x = Float::with_val(600, inside(&a, s));
            prop_assert_eq!(found, x.to_f64());
        }
    }

    #[test]
    fn balls_of_mpfr_are_enclosed(
        a in balls(),
        extra in any::<u64>(),
        s in parts(),
        bits in 32_u32..300,
    ) {
        let mid = Float::with_val(bits, inside(&a, s) + Rational::from((extra, u64::MAX)) / 7);
        let ball = Ball::new(mid, Mag::from_f64(a.r).shift(a.e));
        if let Some(found) = Ball128::of_ball(&ball) {
            let mid = ball.mid().to_rational().unwrap();
            let radius = ball.rad().to_float().to_rational().unwrap();
            for end in [Rational::from(&mid - &radius), mid.clone(), mid + radius] {
                prop_assert!(contains(&found, &end), "{ball:?} {found:?}");
            }
        }
        let back = a.to_ball().unwrap();
        prop_assert_eq!(back.mid().to_rational().unwrap(), inside(&a, 0.0));
        prop_assert_eq!(back.rad(), Mag::from_f64(a.r).shift(a.e));
    }
}

#[test]
fn ties_go_to_the_even_number() {
    let odd = Rational::from(1) + (Rational::from(3) >> 53);
    let tie = Ball128::dyadic(&odd).unwrap();
    assert_eq!(tie.nearest_f64(), Some(1.0 + 2.0 * f64::EPSILON));
    let even = Rational::from(1) + (Rational::from(5) >> 53);
    let tie = Ball128::dyadic(&even).unwrap();
    assert_eq!(tie.nearest_f64(), Some(1.0 + 2.0 * f64::EPSILON));
}

#[test]
fn dyadic_numbers_are_exact_and_others_refused() {
    for x in [0.0, 1.0, -0.1, 5e-324, f64::MAX] {
        let found = Ball128::dyadic(&Rational::from_f64(x).unwrap()).unwrap();
        assert!(found.is_exact());
        if x == 0.0 || x.is_normal() {
            assert_eq!(found.nearest_f64().unwrap_or(x), x);
        }
    }
    assert!(Ball128::dyadic(&Rational::from((1, 3))).is_none());
}

#[test]
fn products_of_wide_factors_are_enclosed() {
    let wide = Ball128::normal(false, 1 << 127, 0, 2_f64.powi(128)).unwrap();
    let end = inside(&wide, 1.0);
    assert!(contains(
        &wide.mul(&wide).unwrap(),
        &Rational::from(&end * &end)
    ));
}

/// A ball that reaches over the middle of two numbers has no nearest one.
#[test]
fn balls_at_the_middle_of_two_numbers_are_undecided() {
    for (below, r, decided) in [(1_u128, 2.0, false), (4, 2.0, true)] {
        let middle = (1_u128 << 127) + (1 << 74);
        for m in [middle - below, middle + below] {
            let ball = Ball128::normal(false, m, 0, r).unwrap();
            assert_eq!(ball.nearest_f64().is_some(), decided, "{m}");
        }
    }
}

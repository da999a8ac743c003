//! Sums with few terms, whose remainders matter, and known values.

use super::super::tests::{boxes_hold, point};
use super::*;

#[test]
fn remainders_are_needed_and_enough() {
    for (x, y) in [(0.5, 14.0), (2.0, 0.0), (-1.5, 3.0), (0.25, -6.0)] {
        let s = point(x, y);
        let due = jet(&s, 3, [60, 40], 200).unwrap();
        for numbers in [[2, 2], [3, 4], [6, 3], [8, 6]] {
            let found = jet(&s, 3, numbers, 200).unwrap();
            for (a, b) in found.iter().zip(&due) {
                assert!(a.overlaps(b), "{s:?} {numbers:?}: {a:?} {b:?}");
                assert!(b.radius() < Mag::power_of_two(-60));
            }
        }
        let close = &jet(&s, 1, [8, 6], 200).unwrap()[0];
        assert!(close.radius() < Mag::from_f64(0.05), "{close:?}");
    }
}

#[test]
fn known_values() {
    let of = |x: f64, y: f64| zeta(&point(x, y), 120).unwrap();
    let sixth = Ball::pi(200).square() / Ball::integer(64, 6);
    assert!(of(2.0, 0.0).re.overlaps(&sixth));
    assert!(of(0.0, 0.0).re.overlaps(&Ball::exact(64, -0.5)));
    let rational = |p: i32, q: i32| Ball::rational(200, &Rational::from((p, q)));
    assert!(of(-1.0, 0.0).re.overlaps(&rational(-1, 12)));
    assert!(of(-7.0, 0.0).re.overlaps(&rational(1, 240)));
    assert!(of(300.0, 2.0).re.overlaps(&Ball::integer(64, 1)));
    // Exactly zero, and so at no neighbour.
    for x in [-2.0f64, -20.0] {
        assert!(of(x, 0.0).re.is_zero() && !of(x.next_up(), 0.0).re.contains_zero());
    }
    assert!(of(-1e6, 0.0).re.is_zero());
    for (x, y) in [(-2.0, 1e-3), (-3.0, 0.0), (-2.5, 0.0), (0.0, 0.0)] {
        assert!(!of(x, y).re.contains_zero(), "{x} {y}");
    }
    let slope = zetaderivative(&Ball::integer(64, 1), &point(-2.0, 0.0), 120).unwrap();
    // ζ'(−2) = −ζ(3)/(4π²)
    let due = -of(3.0, 0.0).re / Ball::pi(200).square().shift(2);
    assert!(slope.re.overlaps(&due) && slope.re.is_negative());
    // ζ'(0) = −ln(2π)/2
    let slope = zetaderivative(&Ball::integer(64, 1), &point(0.0, 0.0), 120).unwrap();
    let due = -real::log(&Ball::pi(200).shift(1), 200).unwrap().shift(-1);
    assert!(slope.re.overlaps(&due) && slope.re.rad() < Mag::power_of_two(-100));
    assert!(matches!(
        zeta(&point(1.0, 0.0), 64),
        Err(NoValue::Undefined(_))
    ));
    let broken = zetaderivative(&Ball::exact(64, 0.5), &point(0.0, 0.0), 120);
    assert!(broken.is_err());
}

/// Both ways agree left of zero, at zeros as well.
#[test]
fn reflection_agrees_with_sums() {
    for (x, y) in [(-8.5, 0.0), (-10.0, 0.0), (-23.25, 0.0), (-14.75, 6.5)] {
        let s = point(x, y);
        let orders = if y == 0.0 { 2 } else { 1 };
        let due = jet(&s, orders, [90, 60], 500).unwrap();
        for (order, due) in due.iter().enumerate() {
            let found = reflected(order, &s, 200).unwrap();
            let small = found.magnitude().shift(-150).max(Mag::power_of_two(-150));
            assert!(
                found.overlaps(due) && found.radius() < small,
                "{s:?}: {found:?} {due:?}"
            );
            assert!(due.radius() < small, "{due:?}");
        }
    }
    // By mpmath.
    let far = zeta(&point(-745.5, 0.0), 120).unwrap().re;
    assert_eq!(
        far.to_decimal(20).as_deref(),
        Some("-6.1346634283986648182e1223")
    );
}

#[test]
fn boxes_hold_values() {
    let middles = [
        (0.5, 14.0),
        (2.0, 0.1),
        (-1.5, 3.0),
        (30.0, 5.0),
        (200.0, 0.0),
        (-9.5, 0.0),
        (-12.0, 4.0),
    ];
    for order in [0, 1].map(|n| Ball::integer(64, n)) {
        let f = |s: &ComplexBall, bits| zetaderivative(&order, s, bits);
        boxes_hold(f, &middles, &[1e-12, 1e-5, 0.01, 0.3]);
    }
}

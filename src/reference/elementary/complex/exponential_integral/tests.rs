//! Series against asymptotic sums, and boxes.

use super::super::tests::{PLACES, at_distances, boxes_hold, point};
use super::*;

#[test]
fn remainders_of_the_sums_are_needed_and_enough() {
    for (x, y) in PLACES {
        for size in [8.0, 12.0] {
            let z = point(size * x, size * y);
            if x > -1.0 {
                let (a, b) = (
                    first(&z, true, 160).unwrap(),
                    first(&z, false, 160).unwrap(),
                );
                assert!(a.overlaps(&b), "{z:?}: {a:?} {b:?}");
                assert!(a.radius() <= b.magnitude().shift(-2), "{z:?}: {a:?}");
            }
            if x >= 0.0 {
                let pair = |is_sine, far| right(is_sine, &z, far, 160).unwrap();
                assert!(pair(true, true).overlaps(&pair(true, false)), "{z:?}");
                assert!(pair(false, true).overlaps(&pair(false, false)), "{z:?}");
                assert!(pair(true, true).radius() <= Mag::from_f64(40.0));
            }
        }
    }
}

/// `Ei(−x) = −E₁(x)`, and the real part of E₁ on its cut.
#[test]
fn the_integrals_are_related() {
    for x in [0.01, 1.0, 30.0, 200.0] {
        let [plus, minus] = [point(x, 0.0), point(-x, 0.0)];
        let (a, b) = (ei(&minus, 120).unwrap(), e1(&plus, 120).unwrap());
        assert!((-a.re).overlaps(&b.re), "{x}");
        let (a, b) = (ei(&plus, 120).unwrap(), e1(&minus, 120).unwrap());
        assert!(
            (-a.re).overlaps(&b.re) && b.im.overlaps(&-Ball::pi(200)),
            "{x}"
        );
    }
    assert!(
        ci(&point(-2.0, 0.0), 64)
            .unwrap()
            .im
            .overlaps(&Ball::pi(200))
    );
    // Far to the right, where all terms have one sign: x e^{−x} Ei(x), by mpmath.
    let due = Float::parse("1.00000095367613540085773613683561648432290468379334220663675");
    let due = Ball::new(Float::with_val(220, due.unwrap()), Mag::power_of_two(-190));
    let x = Ball::integer(64, 1 << 20);
    let value = ei(&ComplexBall::new(x.clone(), exact(64, 0)), 300).unwrap();
    let scaled = &value.re * &x * real::exp(&-&x, 300).unwrap();
    assert!(scaled.overlaps(&due) && scaled.rad() < Mag::power_of_two(-290));
    assert!(ei(&point(0.0, 0.0), 64).is_err() && ci(&point(0.0, 0.0), 64).is_err());
}

#[test]
fn boxes_hold_values() {
    for f in [e1, ei, si, ci] {
        let middles = at_distances([0.0, 2.0, 40.0, 150.0]);
        boxes_hold(f, &middles, &[1e-12, 0.01, 0.3, 2.0]);
    }
}

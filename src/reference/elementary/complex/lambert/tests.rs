//! The equation, the branches, and boxes.

use super::super::tests::{PLACES, at_distances, boxes_hold, point};
use super::*;
use rug::Float;

/// `w e^w` is z again.
fn returns(z: &ComplexBall, w: &ComplexBall) {
    let back = w * &super::super::exp(w, 200).unwrap();
    assert!(back.overlaps(z), "{z:?} {w:?}");
}

#[test]
fn values_solve_the_equation() {
    for (x, y) in PLACES {
        for size in [1e-40, 0.2, 0.4, 3.0, 1e6] {
            let z = point(size * x, size * y);
            let w = lambertw(&z, 120).unwrap();
            returns(&z, &w);
            assert!(w.radius() <= w.magnitude().shift(-100), "{z:?} {w:?}");
            // The principal branch.
            assert!(
                w.im.magnitude() < Mag::from_f64(std::f64::consts::PI.next_up())
                    && (y == 0.0 || w.im.is_positive() == (y > 0.0))
            );
        }
    }
    for x in [-0.3678, -0.2, -1e-3, -1e-60] {
        let x = Ball::exact(64, x);
        let w = real_branch(&x, true, 120).unwrap();
        assert!(w.upper() < -1);
        returns(
            &ComplexBall::new(x, exact(64, 0)),
            &ComplexBall::new(w, exact(64, 0)),
        );
    }
    assert!(matches!(
        real_branch(&Ball::exact(64, -0.4), false, 64),
        Err(NoValue::Undefined(_))
    ));
    assert!(matches!(
        real_branch(&Ball::exact(64, 0.4), true, 64),
        Err(NoValue::Undefined(_))
    ));
}

/// Values of Arb beside the branch point, where W is −1 but for a part far below the precision.
#[test]
fn numbers_beside_the_branch_point_have_two_values() {
    let beside = [
        (
            ("-26508507426831583", 56),
            "-0.9999999971932641197690043657925048291880",
            "-1.000000002806735885482839844951896141344",
        ),
        (
            ("-525055083605898956341513190315239211749778945", 150),
            "-0.9999999999999999999999601591745829097744",
            "-1.000000000000000000000039840825417090226",
        ),
    ];
    for ((m, places), upper, lower) in beside {
        let m = Float::with_val(160, Float::parse(m).unwrap());
        let x = Ball::new(m >> places, Mag::ZERO);
        for (lower, due) in [(false, upper), (true, lower)] {
            let w = real_branch(&x, lower, 64).unwrap();
            let due = Ball::new(
                Float::with_val(140, Float::parse(due).unwrap()),
                Mag::from_f64(3e-40),
            );
            assert!(
                w.overlaps(&due) && w.rad() <= Mag::power_of_two(-62),
                "{x:?} {w:?}"
            );
        }
        let z = ComplexBall::new(x.clone(), exact(64, 0));
        assert!(lambertw(&z, 64).unwrap().im.is_zero());
        // A little above it the value is beside the upper half-line.
        let above = lambertw(&ComplexBall::new(x, Ball::exact(64, 1e-30)), 64).unwrap();
        assert!(above.im.is_positive() && above.radius() <= Mag::power_of_two(-62));
    }
    // The end itself is irrational: this is as near as 64 bits are.
    let below = Ball::exact(64, -0.36787944117144233);
    assert!(matches!(
        real_branch(&below, true, 64),
        Err(NoValue::Undefined(_))
    ));
}

/// Where Newton's map is not certainly a contraction, nothing is proved.
#[test]
fn wide_boxes_are_refused() {
    let wide = point(2.0, 2.0).widened(Mag::from_f64(1.9));
    assert!(value(&wide, false, 64).is_err() && lambertw(&wide, 64).is_ok());
    let next = point(-0.36, 0.0).widened(Mag::from_f64(0.005));
    assert!(value(&next, false, 64).is_err());
}

/// A disc that leaves the range of the branch proves nothing.
#[test]
fn the_range_ends_at_its_boundary() {
    let anywhere = point(0.0, 0.0).widened(Mag::from_f64(100.0));
    let inside =
        |x: f64, y: f64, r: f64| is_in_range(&anywhere, &point(x, y), Mag::from_f64(r), false, 100);
    assert!(inside(0.0, 1.5, 0.01) && inside(-0.9, 0.0, 0.05) && inside(60.0, 3.0, 0.01));
    // −y cot y at 2 is 0.915.
    assert!(inside(0.93, 2.0, 1e-3) && !inside(0.91, 2.0, 1e-3) && !inside(0.93, 2.0, 0.1));
    assert!(!inside(-0.9, 0.0, 0.2) && !inside(90.0, 3.2, 0.01) && !inside(-1.5, 0.0, 0.1));
}

#[test]
fn boxes_hold_values() {
    let middles = at_distances([0.0, 0.3, 1.0, 20.0]);
    boxes_hold(lambertw, &middles, &[1e-12, 0.01, 0.05, 0.3, 9.0]);
}

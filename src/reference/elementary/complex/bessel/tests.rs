//! Series against asymptotic sums whose remainders matter, and identities.

use super::super::tests::{PLACES, at_distances, boxes_hold, point};
use super::*;

#[test]
fn remainders_of_the_sums_are_needed_and_enough() {
    for which in [Bessel::First, Bessel::Modified, Bessel::Scaled] {
        for (p, q) in [(0, 1), (1, 1), (2, 1), (3, 2), (1, 4), (5, 3)] {
            for (x, y) in PLACES {
                for size in [5.0, 8.0, 12.0] {
                    let z = point(size * x, size * y);
                    let order = Order { p, q };
                    if q > 1 && x <= 0.0 {
                        continue;
                    }
                    let a = far(which, order, &z, 160).unwrap();
                    let b = near(which, order, &z, 160).unwrap();
                    let b = if y == 0.0 {
                        ComplexBall::new(b.re, a.im.clone())
                    } else {
                        b
                    };
                    assert!(a.overlaps(&b), "{p}/{q} at {z:?}: {a:?} {b:?}");
                    let due = b.magnitude().max(Mag::power_of_two(-8)).shift(-2);
                    assert!(a.radius() <= due, "{p}/{q} at {z:?}: {a:?}");
                }
            }
        }
    }
}

/// `J_{n−1} + J_{n+1} = (2n/z) J_n`, `I_{n−1} − I_{n+1} = (2n/z) I_n`.
#[test]
fn neighbours_are_related() {
    for (x, y) in PLACES {
        for size in [0.3, 7.0, 50.0, 120.0] {
            let z = point(size * x, size * y);
            for n in [1, 2, 9] {
                let of = |f: fn(&Ball, &ComplexBall, u32) -> ComplexEvaluated, n: i64| {
                    f(&Ball::integer(64, n), &z, 120).unwrap()
                };
                let factor = super::super::recip(&z, 120).unwrap();
                let factor = factor.scaled(&Ball::integer(64, 2 * n));
                let sum = &of(besselj, n - 1) + &of(besselj, n + 1);
                assert!(sum.overlaps(&(&factor * &of(besselj, n))), "{n} {z:?}");
                let sum = &of(besseli, n - 1) - &of(besseli, n + 1);
                assert!(sum.overlaps(&(&factor * &of(besseli, n))), "{n} {z:?}");
                let other = &of(besselie, n) * &super::super::exp(&z, 160).unwrap();
                assert!(other.overlaps(&of(besseli, n)), "{n} {z:?}");
            }
        }
    }
}

#[test]
fn boxes_hold_values() {
    for f in [besselj, besseli, besselie] {
        for n in [0, 1, 4].map(|n| Ball::integer(64, n)) {
            let middles = at_distances([0.0, 3.0, 40.0, 200.0]);
            boxes_hold(|z, bits| f(&n, z, bits), &middles, &[1e-12, 0.01, 0.5, 3.0]);
        }
    }
    let half = Ball::exact(64, 0.5);
    let across = point(-1.0, 0.0).widened(Mag::from_f64(0.1));
    assert!(besselj(&half, &across, 64).is_err());
    assert!(besselj(&half.widened(Mag::from_f64(1e-9)), &point(1.0, 0.0), 64).is_err());
}

/// Between the powers of a modest order and its sums, where terms of the series exceed the range of
/// doubles: values by mpmath.
#[test]
fn large_terms_of_the_series() {
    for (x, due) in [
        (900.0, -0.000_989_701_313_047_769),
        (1000.0, 0.013_889_378_035_385_042),
        (1590.0, 0.019_961_329_044_690_75),
    ] {
        let found = besselj(&Ball::integer(64, 40), &point(x, 0.0), 80).unwrap();
        let error = (found.re.mid().to_f64() - due).abs();
        assert!(
            error < 1e-15 && found.re.rad() < Mag::power_of_two(-70),
            "{x}: {found:?}"
        );
    }
}

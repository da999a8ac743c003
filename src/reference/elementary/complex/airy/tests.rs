//! Series against asymptotic sums, and Wronskians.

use super::super::tests::{PLACES, at_distances, boxes_hold, point};
use super::*;
use crate::Mag;

const ALL: [Which; 4] = [
    Which {
        second: false,
        slope: false,
    },
    Which {
        second: false,
        slope: true,
    },
    Which {
        second: true,
        slope: false,
    },
    Which {
        second: true,
        slope: true,
    },
];

#[test]
fn remainders_of_the_sums_are_needed_and_enough() {
    for which in ALL {
        for (x, y) in PLACES {
            for size in [3.5, 5.0, 7.0] {
                let z = point(size * x, size * y);
                let a = far(which, &z, 160).unwrap().unwrap();
                let b = near(which, &z, 160).unwrap();
                assert!(a.overlaps(&b), "{z:?}: {a:?} {b:?}");
                let due = b.magnitude().max(Mag::power_of_two(-8)).shift(-3);
                assert!(a.radius() <= due, "{z:?}: {a:?}");
            }
        }
    }
}

/// `Ai Bi' − Ai' Bi = 1/π` (DLMF 9.2.7).
#[test]
fn the_wronskian_is_the_inverse_of_pi() {
    for (x, y) in PLACES {
        for size in [0.0, 0.4, 6.0, 30.0] {
            let z = point(size * x, size * y);
            let of = |f: fn(&ComplexBall, u32) -> ComplexEvaluated| f(&z, 200).unwrap();
            let w = &(&of(airyai) * &of(airybiprime)) - &(&of(airyaiprime) * &of(airybi));
            let due = ComplexBall::new(Ball::pi(200).recip(), Ball::integer(64, 0));
            assert!(w.overlaps(&due), "{z:?}");
        }
    }
}

#[test]
fn boxes_hold_values() {
    for f in [airyai, airyaiprime, airybi, airybiprime] {
        let middles = at_distances([0.0, 2.0, 9.0, 30.0]);
        boxes_hold(f, &middles, &[1e-12, 0.01, 0.3, 2.0]);
    }
}

/// Bi overflows at the middle of a box that holds zero.
#[test]
fn an_overflow_is_one_of_the_whole_box() {
    let middle = point(2e6, 0.0);
    let overflow = NoValue::Overflow { negative: false };
    assert_eq!(airybi(&middle, 53).unwrap_err(), overflow);
    let whole = ComplexBall::new(middle.re.widened(Mag::from_f64(3e6)), middle.im.clone());
    assert!(matches!(airybi(&whole, 53), Err(NoValue::Undecided(_))));
}

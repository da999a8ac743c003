//! Periods, the remainder, and the slope.

use super::super::tests::{boxes_hold, point};
use super::*;

#[test]
fn periods_are_one_and_tau() {
    for tau in [point(0.0, 1.0), point(0.5, 0.875), point(-0.25, 0.45)] {
        for (x, y) in [(0.3125, 0.1), (0.25, -0.4), (0.5, 0.0)] {
            for f in [weierstrassp, weierstrasspprime] {
                let value = f(&point(x, y), &tau, 150).unwrap();
                let other = &point(x - 7.0, y) + &tau.scaled(&Ball::integer(64, 3));
                let other = f(&other, &tau, 150).unwrap();
                assert!(
                    value.overlaps(&other),
                    "{x} {y} {tau:?}: {value:?} {other:?}"
                );
                assert!(value.radius() <= value.magnitude().add(Mag::power_of_two(0)).shift(-130));
            }
        }
    }
    let tau = point(0.0, 1.0);
    assert!(matches!(
        weierstrassp(&point(2.0, -1.0), &tau, 64),
        Err(NoValue::Undefined(_))
    ));
    assert!(matches!(
        weierstrassp(&point(0.5, 0.0), &point(0.0, 0.0), 64),
        Err(NoValue::Undefined(_))
    ));
}

#[test]
fn what_is_omitted_is_less_than_its_bound() {
    let of = Mag::from_f64;
    for s in [0.01, 0.5, 0.9] {
        for power in [1, 2] {
            for terms in [30_usize, 60] {
                let term = |m: i32| 4.0 * f64::from(m).powi(power) * f64::powi(s, m) / (1.0 - s);
                let all: f64 = (terms as i32 + 1..3000).map(term).sum();
                let bound = rest(of(s), of(s), terms, power as usize).to_f64();
                assert!(
                    all <= bound && bound <= 3.0 * all,
                    "{s} {power}: {all} {bound}"
                );
            }
        }
    }
}

/// `℘'² = 4℘³ − g₂ ℘ − g₃` with the same g₂ and, for τ = i, g₃ = 0.
#[test]
fn the_slope_obeys_the_equation() {
    let tau = point(0.0, 1.0);
    let invariant = |x: f64, y: f64| {
        let z = point(x, y);
        let p = weierstrassp(&z, &tau, 150).unwrap();
        let slope = weierstrasspprime(&z, &tau, 150).unwrap();
        let cube = (&p.square() * &p).scaled(&Ball::integer(64, 4));
        super::super::div(&(&cube - &slope.square()), &p, 150).unwrap()
    };
    let a = invariant(0.3, 0.1);
    assert!(a.overlaps(&invariant(0.2, -0.4)) && a.overlaps(&invariant(0.4, 0.3)));
    assert!(a.radius() < Mag::power_of_two(-90));
}

#[test]
fn boxes_hold_values() {
    let tau = point(0.1, 0.9);
    for f in [weierstrassp, weierstrasspprime] {
        let middles = [(0.5, 0.5), (0.3, -0.2), (0.1, 0.4)];
        boxes_hold(|z, bits| f(z, &tau, bits), &middles, &[1e-9, 0.01, 0.08]);
    }
}

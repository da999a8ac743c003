//! The elimination, and what becomes of its zeros.

use super::super::tests::zinchenko;
use super::super::{ExactAngle, Linkage};
use super::*;
use rug::Rational;
use std::f64::consts::TAU;

/// The paper's linkage at a crank angle, and its resultant.
fn at(degrees: u32, bits: u32) -> (Linkage, ComplexBall, Resultant) {
    let linkage = Linkage::new(&zinchenko(), bits);
    let phi = ExactAngle::Degrees(Rational::from(degrees)).to_ball(bits);
    let e1 = ComplexBall::unit(&phi);
    let resultant = Resultant::new(&linkage, &e1.scaled(&linkage.l1));
    (linkage, e1, resultant)
}

/// C of every mode is where N/Δ puts it, whether the zeros are isolated coarsely first or not.
#[test]
fn zeros_give_the_modes() {
    for bits in [COARSE, COARSE + 1, 128] {
        let (linkage, e1, resultant) = at(100, bits);
        let zeros = resultant.zeros().unwrap();
        for (theta, lo, hi) in &zeros {
            assert!(lo < theta && theta < hi);
            assert_eq!(theta.prec(), COARSE, "{bits}");
        }
        let modes = linkage.modes_at(&e1, &resultant, zeros).unwrap();
        assert_eq!(modes.len(), resultant.zeros().unwrap().len(), "{bits}");
        for m in &modes {
            let tau = ComplexBall::unit(&m.phi4);
            let c = &linkage.o3 + &resultant.position(&tau).unwrap();
            assert!(c.re.overlaps(&m.configuration.c.re) && c.im.overlaps(&m.configuration.c.im));
        }
        assert!(modes.windows(2).all(|p| p[0].phi4.mid() < p[1].phi4.mid()));
    }
}

/// A zero whose position lies outside the interval in which it is alone proves nothing, and no more
/// does a Δ that may be zero.
#[test]
fn what_does_not_fit_is_undecided() {
    let (linkage, e1, mut resultant) = at(100, 128);
    let zeros = resultant.zeros().unwrap();
    for k in 0..zeros.len() {
        let (theta, lo, hi) = zeros[k].clone();
        let width = Float::with_val(64, &hi - &lo);
        let beside = (
            theta,
            Float::with_val(64, &lo + &width),
            Float::with_val(64, &hi + &width),
        );
        let why = linkage.modes_at(&e1, &resultant, vec![beside]).unwrap_err();
        assert!(
            why.reason.contains("left its isolating interval"),
            "{why:?}"
        );
        assert_eq!(why.bits, 128);
    }
    let tau = ComplexBall::unit(&Ball::exact(128, zeros[0].0.to_f64()));
    for c in &mut resultant.delta.c {
        *c = ComplexBall::new(c.re.clone(), c.im.widened(Mag::from_f64(1e12)));
    }
    assert!(resultant.position(&tau).is_none());
    let why = linkage.modes_at(&e1, &resultant, zeros).unwrap_err();
    assert!(why.reason.contains("degenerates"), "{why:?}");
}

#[test]
fn angles_are_within_an_interval_modulo_turns() {
    let float = |x: f64| Float::with_val(64, x);
    let ball = |x: f64, r: f64| Ball::exact(64, x).widened(Mag::from_f64(r));
    for turn in [-TAU, 0.0, TAU] {
        let inside = |x: f64, r: f64| within(&ball(x + turn, r), &float(1.0), &float(1.5));
        assert!(inside(1.25, 0.001) && inside(1.001, 1e-6) && inside(1.499, 1e-6));
        assert!(!inside(0.9, 0.001) && !inside(1.6, 0.001));
        // Not certainly.
        assert!(!inside(1.0, 0.001) && !inside(1.5, 0.001) && !inside(1.25, 0.3));
        assert!(!inside(1.25, f64::INFINITY));
    }
    assert!(!within(
        &ball(1.25 + 2.0 * TAU, 0.001),
        &float(1.0),
        &float(1.5)
    ));
}

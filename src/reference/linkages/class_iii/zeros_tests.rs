//! Zeros of trigonometric polynomials, and angles within intervals.

use super::super::tests::zinchenko;
use super::super::{ExactAngle, Linkage};
use super::*;
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// `Π (cos(θ − m) − cos d)`, with a zero at every `m ± d`.
fn with_zeros(pairs: &[(f64, f64); 3], bits: u32) -> Trigonometric {
    let exact = |x: f64| Ball::exact(bits, x);
    let factor = |(m, d): &(f64, f64)| {
        let turn = ComplexBall::unit(&exact(*m)).scaled(&exact(0.5));
        let level = ComplexBall::new(-exact(*d).sin_cos().1, exact(0.0));
        Laurent::new(1, vec![turn.clone(), level, turn.conj()])
    };
    let [a, b, c] = pairs.each_ref().map(factor);
    let t = a.mul(&b).mul(&c);
    let c: Vec<ComplexBall> = (0..=3).map(|k| t.at(k).unwrap().clone()).collect();
    let curvature = c.iter().enumerate().fold(Mag::ZERO, |sum, (k, x)| {
        sum.add(x.magnitude().mul(Mag::from_f64(2.0 * (k * k) as f64)))
    });
    Trigonometric { bits, c, curvature }
}

/// Each interval holds one zero, and each zero lies in one; zeros 2^−9 apart are still told apart.
#[test]
fn all_zeros_are_isolated() {
    let mut seed = 1u64;
    let mut unit = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 53) as f64
    };
    for case in 0..60 {
        let narrow = f64::from(case % 6);
        let pairs = [(); 3].map(|()| (TAU * unit(), PI * (0.05 + 0.9 * unit())));
        let mut pairs = pairs;
        pairs[0].1 = (-1.0 - 2.0 * narrow).exp2();
        let t = with_zeros(&pairs, 64);
        let zeros = pairs.map(|(m, d)| [m - d, m + d]).concat();
        let apart = |x: f64, y: f64| {
            let way = (x - y).rem_euclid(TAU);
            way.min(TAU - way)
        };
        let (lo, found) = (-2.71875, t.isolate());
        let near = zeros.iter().any(|z| apart(*z, lo) < 1e-3);
        let Ok(found) = found else {
            assert!(near, "{pairs:?}");
            continue;
        };
        assert_eq!(found.len(), 6, "{pairs:?}");
        for (a, b) in &found {
            let (low, high) = (a.to_f64(), b.to_f64());
            let inside = |z: &&f64| (**z - low).rem_euclid(TAU) < high - low;
            assert_eq!(
                zeros.iter().filter(inside).count(),
                1,
                "{pairs:?} {low} {high}"
            );
            let x = t.approximate(a, b).to_f64();
            assert!(zeros.iter().any(|z| apart(*z, x) < 1e-9), "{pairs:?} {x}");
        }
    }
}

/// A double zero, one on a cut, and none at all.
#[test]
fn double_zeros_are_undecided() {
    let double = with_zeros(&[(1.0, 0.0), (0.3, 0.5), (2.0, 1.0)], 64);
    assert!(double.isolate().is_err());
    let cut = with_zeros(&[(-2.71875 + 0.5, 0.5), (0.3, 0.5), (2.0, 1.0)], 64);
    assert!(cut.isolate().is_err());
    // 5/4 + cos θ in every factor.
    let mut none = with_zeros(&[(1.0, 0.3); 3], 64);
    for (k, c) in [(0, 2.0), (1, 0.3), (2, 0.2), (3, 0.1)] {
        none.c[k] = ComplexBall::new(Ball::exact(64, c), Ball::exact(64, 0.0));
    }
    assert!(none.isolate().unwrap().is_empty());
}

/// T of a linkage, its derivative and the bound on the second: against differences, at many angles.
#[test]
fn slope_and_curvature_of_the_resultant() {
    let linkage = Linkage::new(&zinchenko(), 128);
    let phi = ExactAngle::Degrees(Rational::from(100)).to_ball(128);
    let a = ComplexBall::unit(&phi).scaled(&linkage.l1);
    let t = Resultant::new(&linkage, &a).t;
    let step = (-20f64).exp2();
    let at = |x: f64| t.value(&Float::with_val(128, x));
    let bound = t.curvature.to_f64();
    let mut most = 0.0f64;
    for k in 0..64 {
        let theta = f64::from(k) * TAU / 64.0;
        let (before, here, after) = (at(theta - step), at(theta), at(theta + step));
        let slope = (&after.0 - &before.0).to_f64() / (2.0 * step);
        let second = (&after.1 - &before.1).to_f64() / (2.0 * step);
        assert!((slope - here.1.to_f64()).abs() < 1e-9 * bound, "{theta}");
        assert!(second.abs() <= bound, "{theta}");
        most = most.max(second.abs());
    }
    assert!(most > 0.2 * bound, "{most} {bound}");
    assert!(t.with_prec(64).curvature >= t.curvature);
}

#[test]
fn angles_are_within_an_interval_modulo_turns() {
    let float = |x: f64| Float::with_val(64, x);
    let ball = |x: f64, r: f64| Ball::exact(64, x).widened(Mag::from_f64(r));
    for turn in [-TAU, 0.0, TAU] {
        let inside = |x: f64, r: f64| within(&ball(x + turn, r), &float(1.0), &float(1.5));
        assert!(inside(1.25, 0.001) && inside(1.001, 1e-6) && inside(1.499, 1e-6));
        assert!(!inside(0.9, 0.001) && !inside(1.6, 0.001));
        // Not certainly, or not at all an angle.
        assert!(!inside(1.0, 0.001) && !inside(1.5, 0.001) && !inside(1.25, 0.02));
        assert!(!inside(1.25, f64::INFINITY));
    }
    assert!(!within(
        &ball(1.25 + 2.0 * TAU, 0.001),
        &float(1.0),
        &float(1.5)
    ));
}

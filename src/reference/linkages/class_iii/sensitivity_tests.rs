//! Tests of `sensitivity`.

use super::super::tests::{q, zinchenko};
use super::super::{Body, ExactAngle, Geometry};
use super::*;

const BITS: u32 = 256;
const STEP: u32 = 80;

fn masses() -> Masses {
    let body = |i: usize| Body {
        mass: Rational::from((10 + i as u32, 3)),
        inertia: Rational::from((7 * i as u32 + 2, 5)),
        about_pivot: i == 2,
        radius: Rational::from((3 + 5 * i as u32, 2)),
        angle: ExactAngle::Radians(Rational::from((2 * i as i32 - 3, 4))),
    };
    Masses {
        bodies: std::array::from_fn(body),
        gravity: q("9.81"),
    }
}

/// Outputs at the third mode.
fn outputs(g: &Geometry, phi1: &Rational, masses: &Masses) -> Vec<Ball> {
    let linkage = Linkage::new(g, BITS);
    let modes = linkage.modes(&Ball::rational(BITS, phi1)).unwrap();
    let k = linkage.kinematics(&modes[2].configuration).unwrap();
    let r = linkage.reduce(&k, masses);
    let reduced = [
        r.inertia,
        r.inertia_derivative,
        r.moment,
        r.moment_derivative,
    ];
    let rates = k.angles.into_iter().chain(k.first).chain(k.second);
    rates.chain(reduced).collect()
}

#[test]
fn derivatives_are_limits_of_differences() {
    let mut g = zinchenko();
    g.phi_b = ExactAngle::Radians(q("-0.686"));
    let (phi1, masses) = (q("0.4"), masses());
    let before = outputs(&g, &phi1, &masses);
    let mut due = [0.0; 16];
    let mut moved = |g: &Geometry, phi1: &Rational, masses: &Masses| {
        let after = outputs(g, phi1, masses);
        for ((sum, a), b) in due.iter_mut().zip(&after).zip(&before) {
            *sum += (a - b).shift(STEP as i32).to_f64().abs();
        }
    };
    let up = |x: &mut Rational| *x *= Rational::from(1) + (Rational::from(1) >> STEP);
    let turn = |x: &mut ExactAngle| {
        if let ExactAngle::Radians(x) = x {
            up(x);
        }
    };
    type Change<'a, T> = &'a dyn Fn(&mut T);
    let dimensions: [Change<Geometry>; 11] = [
        &|g| up(&mut g.l1),
        &|g| up(&mut g.l2),
        &|g| up(&mut g.l3),
        &|g| up(&mut g.l4),
        &|g| up(&mut g.l5),
        &|g| up(&mut g.lb),
        &|g| turn(&mut g.phi_b),
        &|g| up(&mut g.o3[0]),
        &|g| up(&mut g.o3[1]),
        &|g| up(&mut g.o5[0]),
        &|g| up(&mut g.o5[1]),
    ];
    for change in dimensions {
        let mut g = g.clone();
        change(&mut g);
        moved(&g, &phi1, &masses);
    }
    let mut later = phi1.clone();
    up(&mut later);
    moved(&g, &later, &masses);
    let of_body: [Change<Body>; 4] = [
        &|b| up(&mut b.mass),
        &|b| up(&mut b.inertia),
        &|b| up(&mut b.radius),
        &|b| turn(&mut b.angle),
    ];
    for i in 0..5 {
        for change in of_body {
            let mut masses = masses.clone();
            change(&mut masses.bodies[i]);
            moved(&g, &phi1, &masses);
        }
    }
    let mut heavier = masses.clone();
    up(&mut heavier.gravity);
    moved(&g, &phi1, &heavier);

    let linkage = Linkage::new(&g, 128);
    let phi = Ball::rational(128, &phi1);
    let at = linkage.placed(&phi, &before[1], &before[3]);
    let found = linkage.conditions(&phi, &at, &masses).unwrap();
    let all = [found.angles, found.first, found.second, found.reduced].concat();
    for (i, (found, due)) in all.iter().zip(due).enumerate() {
        assert!(
            (found.to_f64() / due - 1.0).abs() < 1e-14,
            "{i}: {found:?} {due}"
        );
    }
    let angles = linkage.angle_conditions(&phi, &at).unwrap();
    assert_eq!(angles, found.angles);
}

#[test]
fn a_singular_position_has_no_conditions() {
    let linkage = Linkage::new(&zinchenko(), 128);
    // C and D as if links 3, 4 and 5 were in line: not a configuration, but singular.
    let wide = Ball::new(rug::Float::with_val(128, 0.3), Mag::from_f64(4.0));
    let at = linkage.placed(&Ball::integer(128, 0), &wide, &wide);
    assert!(
        linkage
            .angle_conditions(&Ball::integer(128, 0), &at)
            .is_none()
    );
}

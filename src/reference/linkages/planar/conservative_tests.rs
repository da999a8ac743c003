//! Motion from rest against closed forms, and the other statements about it.

use super::energy::Forces;
use super::tests::{BITS, ball, cranked, four_bar, guess, meets, origin, oscillator};
use super::{Attachment, Body, Joint, Mechanism};
use crate::class_iii::tests::q;
use crate::{Ball, Mag};
use rug::Rational;

/// Times ascend from above zero.
#[test]
fn times_that_do_not_ascend_are_refused() {
    let (linkage, forces) = oscillator();
    let refused = |times: &[&str]| {
        let times: Vec<Rational> = times.iter().map(|t| q(t)).collect();
        let course = linkage.from_rest(&ball("0"), &guess(&[0.0, 0.0]), &forces, &times);
        course.unwrap_err().reason
    };
    for times in [
        &["0"][..],
        &["-0.5"],
        &["0", "0.5"],
        &["-0.5", "0.5"],
        &["0.5", "0.4"],
        &["0.5", "0.5"],
        &["0.2", "0.5", "0.4"],
    ] {
        let reason = refused(times);
        assert_eq!(
            reason, "the times are not positive and ascending",
            "{times:?}"
        );
    }
}

/// From b0 = 1/8 the oscillator's force is 2, its mass 2: `b = 3/8 − cos 2t/4`, and
/// `W/(b − b0) = 3 − 4 (b + b0)`.
#[test]
fn an_oscillator_from_elsewhere() {
    let (linkage, forces) = oscillator();
    let run = |times: &[&str]| {
        let times: Vec<Rational> = times.iter().map(|t| q(t)).collect();
        linkage
            .from_rest(&ball("0.125"), &guess(&[0.0, 0.125]), &forces, &times)
            .unwrap()
    };
    let course = run(&["0.3", "1.2"]);
    meets(&course.first_acceleration, &ball("1"));
    for m in &course.moments {
        let (_, c) = Ball::rational(BITS, &m.time).shift(1).sin_cos();
        meets(&m.drive, &(ball("0.375") - c.shift(-2)));
        meets(&m.rates.drive[1], &c);
    }
    // The last panel ends beyond 1.2 s and before the turning point b = 5/8.
    let last = course.moments[1].drive.to_f64();
    assert!(course.least_force < 2.5 - 4.0 * last && course.least_force > 0.0);
    // From 1/16 after the start on, reached at cos 2t = 3/4, there is one panel more.
    assert_eq!(run(&["0.37"]).panels, 2);
    assert!(run(&["1.2"]).panels > 2);
}

/// A wheel with a moment of inertia of 2 about its centre under the torque 3: `ψ = 3/4 t²`.
#[test]
fn a_wheel_has_its_inertia() {
    let mut wheel = Body::massless("wheel");
    (wheel.mass, wheel.inertia) = (q("5"), q("2"));
    let joints = vec![Joint::Pin {
        a: Attachment::ground(origin()),
        b: Attachment::body(0, origin()),
    }];
    let linkage = cranked(&Mechanism::new(vec![wheel], joints).unwrap());
    let forces = Forces {
        drive: q("3"),
        springs: Vec::new(),
        gravity: [q("0"), q("-9.75")],
    };
    let at = linkage.position(&ball("0"), &guess(&[0.0])).unwrap();
    let load = super::energy::Load::new(linkage.mechanism(), &forces, BITS);
    let rates = linkage.rates(&at).unwrap();
    meets(&load.inertia(&linkage.fine.pose(at.x), &rates), &ball("2"));
    let course = linkage
        .from_rest(&ball("0"), &guess(&[0.0]), &forces, &[q("0.5"), q("2")])
        .unwrap();
    meets(&course.first_acceleration, &ball("1.5"));
    for (m, time) in course.moments.iter().zip(["0.5", "2"].map(ball)) {
        meets(&m.drive, &(ball("0.75") * time.square()));
        meets(&m.rates.drive[0], &(ball("1.5") * &time));
        meets(&m.rates.drive[1], &ball("1.5"));
        meets(&m.energy, &(ball("2.25") * time.square()));
    }
}

/// In free motion no force on the drive is missing: the acceleration is that of Lagrange's
/// equations, with an inertia that depends on the position.
#[test]
fn a_four_bar_moves_freely() {
    let linkage = cranked(&four_bar());
    let forces = Forces {
        drive: q("5"),
        springs: Vec::new(),
        gravity: [q("0"), q("-2")],
    };
    let course = linkage
        .from_rest(&ball("0.9"), &guess(&[0.9, 0.5, 1.6]), &forces, &[q("0.8")])
        .unwrap();
    let m = &course.moments[0];
    let missing = m.multipliers.last().unwrap();
    assert!(missing.contains_zero() && missing.magnitude() < Mag::power_of_two(-80));
    // The energy from the bodies' speeds.
    let series = linkage.series(&m.position, 2).unwrap();
    let inertia = linkage.reduced_inertia(&series);
    let speed = &m.rates.drive[0];
    let slope = inertia[1].to_f64();
    assert!(speed.to_f64() > 0.1 && slope > 1.0, "{speed:?} {slope}");
    meets(&m.energy.shift(1), &(&inertia[0] * &speed.square()));
}

//! Tests of `reduction`.

use super::super::found;
use super::*;

/// One at that crank speed and zero at others.
fn only_at(speed: i64, omega1: &Ball) -> Ball {
    let there = (omega1 - &Ball::integer(BITS, speed)).contains_zero();
    Ball::integer(BITS, i64::from(there))
}

#[test]
fn planted_faults_are_found() {
    let sample = Sample::new().unwrap();
    let lost = |due: &[&str], plant: fn(&mut Forms)| {
        found(PRINTED, |f| findings(f, &sample), due, plant);
    };
    lost(&[], |_| ());
    lost(&["formula-3"], |f| {
        f.energy = |s, b| (PRINTED.energy)(s, b) - &b.i[0]
    });
    lost(&["formula-3"], |f| f.mass = |i, l1| i / l1);
    // I_1 kept: no longer the recorded error.
    lost(&["formula-4"], |f| {
        f.inertia = |s, b| (PRINTED.inertia)(s, b) + &b.i[0]
    });
    lost(&["formula-4"], |f| {
        f.inertia = |s, b| (PRINTED.inertia)(s, b) * s.omega1.square()
    });
    // The factor restored.
    lost(&["formula-5"], |f| {
        f.derivative = |s, b| &(PRINTED.derivative)(s, b) / &s.omega1.square()
    });
    // One term lost, of the smallest link.
    lost(&["formula-5"], |f| {
        f.derivative = |s, b| {
            let term = &b.i[4] * &s.omega[3] * &s.omega_slope[3];
            (PRINTED.derivative)(s, b) - term.shift(1)
        }
    });
    lost(&["formula-6"], |f| {
        f.power = |p, v, c, w| (PRINTED.power)(p, v, c, &w.abs())
    });
    // Wrong at one of the crank speeds alone.
    lost(&["formula-6"], |f| {
        f.power = |p, v, c, w| (PRINTED.power)(p, v, c, w) + only_at(1, w)
    });
    lost(&["formula-6"], |f| {
        f.power = |p, v, c, w| (PRINTED.power)(p, v, c, w) + only_at(-2, w)
    });
    lost(&["formula-7"], |f| {
        f.moment = |s, b| -(PRINTED.moment)(s, b)
    });
    // Right in centimetres at the crank speed 1: no longer the recorded error.
    lost(&["formula-7"], |f| {
        f.moment = |s, b| {
            let factor = match (&s.v[0] - &ball("3")).is_positive() {
                true => Ball::integer(BITS, 1) - ball("0.99") * only_at(1, &s.omega1),
                false => Ball::integer(BITS, 1),
            };
            (PRINTED.moment)(s, b) * factor
        }
    });
    lost(&["formula-7"], |f| {
        f.moment = |s, b| &(PRINTED.moment)(s, b) / &s.omega1
    });
}

#[test]
fn the_mean_value_test_sees_a_wrong_derivative() {
    let sample = Sample::new().unwrap();
    let (quotient, slope) = mean_value(&sample).unwrap();
    assert!(quotient.overlaps(&slope));
    let wrong = &slope + &Ball::rational(BITS, &number("1e-20"));
    assert!(!quotient.overlaps(&wrong));
}

/// Two wide enclosures that overlap say nothing.
#[test]
fn enclosures_have_to_be_narrow() {
    let ball = |radius: f64| Ball::integer(BITS, 1).widened(Mag::from_f64(radius));
    for (quotient, slope, due) in [
        (0.9e-20, 0.9e-20, Outcome::Holds),
        (0.9e-20, 1.1e-20, Outcome::Undecided),
        (1.1e-20, 0.9e-20, Outcome::Undecided),
    ] {
        assert_eq!(consistent(&(ball(quotient), ball(slope))), due);
    }
    let apart = (ball(1e-30), ball(1e-30) + ball(1e-30));
    assert_eq!(consistent(&apart), Outcome::Fails);
}

#[test]
fn one_inertia_that_is_not_positive_is_found() {
    let mut all = masses(Rockers::Steiner, &some_crank());
    assert!(positive(&all));
    all.bodies[4].inertia = Rational::new();
    assert!(!positive(&all));
}

/// Three values for each variable of degree 2.
#[test]
fn the_reduced_mass_is_tried_on_the_whole_grid() {
    assert_eq!(same_energy(&PRINTED).points, 9);
}

//! Tests of `reduction`.

use super::super::found;
use super::*;

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
    lost(&["formula-7"], |f| {
        f.moment = |s, b| -(PRINTED.moment)(s, b)
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

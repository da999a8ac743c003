//! The steady cycle: one turn, Newton's step, when it has settled, what is handed back.

use super::*;
use crate::run_up::{ConstantInertia, Drive, Motor, Resistance, TableReading, TorqueTable};
use crate::units::{AngularVelocity, Inertia, Torque};

fn off() -> Drive {
    Drive::direct(Motor::Off)
}

#[test]
fn newtons_step() {
    // Where P(ψ) = 6 + (ψ − 6)/2 the line meets its cycle at once, from either side.
    for psi in [4.0, 5.0, 9.0] {
        let after = 6.0 + 0.5 * (psi - 6.0);
        assert_eq!(newton(psi, after - psi, 0.5), Some(6.0));
        assert_eq!(newton(-psi, psi - after, 0.5), Some(-6.0));
    }
    // Not farther than twice as fast or half as fast.
    assert_eq!(newton(4.0, 5.0, 0.5), Some(8.0));
    assert_eq!(newton(-4.0, -5.0, 0.5), Some(-8.0));
    assert_eq!(newton(4.0, -1.5, 0.5), Some(2.0));
    assert_eq!(newton(-4.0, 1.5, 0.5), Some(-2.0));
    assert_eq!(newton(0.25, 1.0, 0.5), Some(0.5));
    assert_eq!(newton(0.25, -0.1, 0.5), Some(0.125));
    // Not to rest nor into the other direction.
    assert_eq!(newton(4.0, -2.0, 0.5), None);
    assert_eq!(newton(4.0, -2.5, 0.5), None);
    assert_eq!(newton(-4.0, 2.5, 0.5), None);
    assert_eq!(newton(-4.0, 9.0, 0.5), None);
    // Not beside a neutral cycle, which it is at a slope of one.
    assert_eq!(newton(4.0, 1.0, 0.9), None);
    assert_eq!(newton(4.0, 1.0, 0.9f64.next_down()), Some(8.0));
    assert_eq!(newton(4.0, 0.0, 1.0), None);
    assert_eq!(newton(4.0, 1e-3, 1.0), None);
    assert_eq!(newton(4.0, -1e-3, 1.5), None);
    assert_eq!(newton(4.0, 1.0, f64::NAN), None);
}

/// Four tolerances of the speed, or no less than half of the last change and a thousand of them.
#[test]
fn when_the_speed_repeats() {
    let (tolerance, inf) = (0.5f64.powi(40), f64::INFINITY);
    for psi in [8.0f64, -8.0, 0.125] {
        let one = tolerance * psi.abs();
        for sign in [1.0, -1.0] {
            let is =
                |change: f64, last: f64| settled(sign * change * one, last * one, tolerance, psi);
            assert!(is(0.0, inf) && is(4.0, inf) && !is(4.5, inf) && !is(1000.0, inf));
            // Still shrinking.
            assert!(!is(500.0, 1000.5) && !is(500.0, -1000.5) && !is(20.0, 100.0));
            assert!(is(500.0, 1000.0) && is(500.0, -1000.0) && is(20.0, 10.0));
            assert!(is(1000.0, 10.0) && !is(1000.5, 10.0) && !is(1e6, 1e6));
            assert!(is(3.0, 100.0));
        }
    }
}

/// Slowed down to the speed of a motor that hardly turns.
#[test]
fn a_turn_without_end_is_too_slow() {
    let rotor = ConstantInertia(1.0);
    let speed = AngularVelocity::from_rad_per_s(1e-4);
    for sign in [1.0, -1.0] {
        let motor = Motor::linear(Torque::from_n_m(5e-5), speed).unwrap();
        let (none, free) = (Inertia::from_kg_m2(0.0), Resistance::default());
        let drive = Drive::new(motor, sign, none, none, free).unwrap();
        let equation = Equation::new(&rotor, &drive);
        let found = steady_cycle(&equation, 0.0, 0.5 * sign, Settings::default());
        let limit = 1000.0 * TAU / 0.5;
        assert_eq!(found, Err(CycleError::Slow { limit }));
    }
}

/// Without any torque every speed is a cycle. Nothing is slower or faster than the start.
#[test]
fn free_motion_is_a_cycle() {
    let (rotor, drive) = (ConstantInertia(2.0), off());
    for psi in [3.0, -3.0] {
        let c = steady_cycle(
            &Equation::new(&rotor, &drive),
            0.75,
            psi,
            Settings::default(),
        );
        let c = c.unwrap();
        assert_eq!((c.psi, c.mismatch, c.fluctuation), (psi, 0.0, 0.0));
        assert_eq!((c.least, c.most), ((psi, 0.75), (psi, 0.75)));
        assert_eq!((c.kinetic_energy, c.multiplier), (9.0, 1.0));
        assert_eq!((c.work, c.iterations), ([0.0; 3], 1));
        assert!((c.period - TAU / 3.0).abs() < 1e-14);
        assert_eq!(c.mean, psi.signum() * TAU / c.period);
        // One turn to find that it is one and one to look for its extrema.
        assert_eq!(c.counts.retaken, 2);
    }
}

/// A turn along a motor's table stops at each kink once, and where it ends.
#[test]
fn a_turn_stops_at_the_kinks_on_its_way() {
    let rotor = ConstantInertia(1.0);
    for sign in [1.0, -1.0] {
        for torque in [1.0, -1.0] {
            let table: Vec<(f64, f64)> = [-9.0, -4.0, -3.5, -3.25, -3.0, 3.0, 3.25, 3.5, 4.0, 9.0]
                .map(|w| (w, sign * torque))
                .to_vec();
            let table = TorqueTable::new(&table, TableReading::Linear).unwrap();
            let drive = Drive::direct(Motor::Table(table));
            let equation = Equation::new(&rotor, &drive);
            // ψ² = ψ_0² ± 2 · 2π.
            let (psi, stops): (f64, u64) = match torque > 0.0 {
                true => (2.0, 4),
                false => (4.5, 4),
            };
            let due = (psi * psi + 2.0 * torque * TAU).sqrt();
            let l = lap(&equation, Settings::default(), 1.0, sign * psi, false).unwrap();
            assert!((l.psi - sign * due).abs() < 1e-10, "{} {due}", l.psi);
            assert_eq!(l.counts.retaken, stops + 1, "{sign} {torque}");
            let (least, most) = match l.psi > sign * psi {
                true => ((sign * psi, 1.0), (l.psi, 1.0 + sign * TAU)),
                false => ((l.psi, 1.0 + sign * TAU), (sign * psi, 1.0)),
            };
            assert_eq!((l.least, l.most), (least, most));
        }
    }
}

/// Where the motor's torque at the crank belongs to the direction of motion, a turn against it ends
/// at rest.
#[test]
fn a_turn_against_the_motor_stalls() {
    let rotor = ConstantInertia(1.0);
    for sign in [1.0, -1.0] {
        let motor = Motor::constant(Torque::from_n_m(-2.0 * sign)).unwrap();
        let drive = Drive::direct(motor);
        let psi = 3.0 * sign;
        let found = steady_cycle(
            &Equation::new(&rotor, &drive),
            0.0,
            psi,
            Settings::default(),
        );
        let Err(CycleError::Stalled { phi, t, psi: from }) = found else {
            panic!("{found:?}")
        };
        assert!((phi - sign * 2.25).abs() < 1e-12 && (t - 1.5).abs() < 1e-12);
        assert_eq!(from, psi);
    }
}

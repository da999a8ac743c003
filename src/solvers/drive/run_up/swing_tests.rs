//! Runs through standstill: swings with known periods, friction that ends them, motors whose torque
//! changes with time.

use super::*;
use crate::units::{Inertia, Torque};
use std::f64::consts::{PI, TAU};

/// I = 1 kg·m² and a moment by the angle.
struct Weighted<F: Fn(f64) -> f64>(F);

impl<F: Fn(f64) -> f64> ReducedModel for Weighted<F> {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        Ok(Coefficients {
            moment: self.0(phi),
            ..ConstantInertia(1.0).coefficients(phi)?
        })
    }
}

fn drive(motor: Motor, constant: f64) -> Drive {
    let none = Inertia::from_kg_m2(0.0);
    let resistance = Resistance {
        constant: Torque::from_n_m(constant),
        ..Resistance::default()
    };
    Drive::new(motor, 1.0, none, none, resistance).unwrap()
}

fn plan(phi: f64, psi: f64, duration: f64) -> Plan {
    Plan {
        psi,
        settings: Settings {
            tolerance: 1e-12,
            ..Settings::default()
        },
        ..Plan::new(phi, duration)
    }
}

fn rests(motion: &Motion) -> Vec<(f64, f64)> {
    let rests = motion.events.iter().filter(|e| e.kind == EventKind::Rest);
    rests.map(|e| (e.t, e.phi)).collect()
}

/// A pendulum with `φ'' = −w² sin φ` let go at φ_0 has the period `2π/(w M(1, cos ½φ_0))`, M the
/// arithmetic-geometric mean of Gauss, and passes the bottom at `2 w sin ½φ_0`.
#[test]
fn a_pendulum_swings_with_its_period() {
    let mean = |mut a: f64, mut b: f64| -> f64 {
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        a
    };
    for (w, start) in [(1.0f64, 0.1f64), (3.0, 2.0), (2.0, 3.0), (2.0, -1.5)] {
        let model = Weighted(|phi: f64| -w * w * phi.sin());
        let drive = drive(Motor::Off, 0.0);
        let period = TAU / (w * mean(1.0, (0.5 * start).cos()));
        for method in Method::ALL {
            let mut plan = plan(start, 0.0, 3.25 * period);
            plan.settings.method = method;
            plan.settings.tolerance = if method == Method::Radau5 {
                1e-10
            } else {
                1e-12
            };
            let motion = run(&Equation::new(&model, &drive), &plan).unwrap();
            assert_eq!(motion.outcome, Outcome::TimeUp);
            let found = rests(&motion);
            assert_eq!(found.len(), 6, "{method:?} {start}");
            let near = if method == Method::Radau5 { 1e-6 } else { 1e-7 };
            for (k, (t, phi)) in found.iter().enumerate() {
                let (due, side) = (0.5 * period * (k + 1) as f64, [-1.0, 1.0][k % 2]);
                assert!(
                    (t - due).abs() < near * due,
                    "{method:?} {start}: {t} {due}"
                );
                assert!((phi - side * start).abs() < near, "{phi}");
            }
            let speed = 2.0 * w * (0.5 * start).sin().abs();
            assert!((motion.end.psi.abs() - speed).abs() < 1e-6 * speed);
            let energy = w * w * (1.0 - start.cos());
            // Some hundreds of steps, each within the tolerance.
            let allowed = 1e3 * plan.settings.tolerance * (1.0 + energy);
            assert!(motion.end.balance.abs() < allowed, "{method:?} {start}");
            assert!(motion.turns.is_empty());
        }
    }
}

/// A spring of k N·m/rad against dry friction c: each half swing of `π/√k` is 2 c/k shorter, until
/// the spring no longer overcomes it.
#[test]
fn dry_friction_ends_a_swing() {
    let model = Weighted(|phi: f64| -4.0 * phi);
    let drive = drive(Motor::Off, 0.5);
    let motion = run(&Equation::new(&model, &drive), &plan(1.05, 0.0, 100.0)).unwrap();
    let found = rests(&motion);
    let due = [-0.8, 0.55, -0.3, 0.05];
    assert_eq!(found.len(), due.len());
    for (k, ((t, phi), due)) in found.iter().zip(due).enumerate() {
        assert!((t - 0.5 * PI * (k + 1) as f64).abs() < 1e-9 && (phi - due).abs() < 1e-9);
    }
    let Outcome::Stalled { torque } = motion.outcome else {
        panic!("{:?}", motion.outcome);
    };
    assert!((torque + 0.2).abs() < 1e-8 && motion.end.psi == 0.0);
    assert!(motion.end.balance.abs() < 1e-10);
}

/// Thrown against a constant moment: `φ = 5 t − ½ t²` turns back at 12.5 rad, short of two turns.
/// The angle of the start is passed at one turn, at that turn again, which is no turn, at none and
/// at minus one.
#[test]
fn an_angle_passed_again_is_no_turn() {
    let model = Weighted(|_| -1.0);
    let drive = drive(Motor::Off, 0.0);
    let mut plan = plan(0.0, 5.0, 11.5);
    // Speeds at one turn, up and down, are alike but for the sign.
    plan.settled = Some(1e-3);
    let motion = run(&Equation::new(&model, &drive), &plan).unwrap();
    let at = |phi: f64, side: f64| 5.0 + side * (25.0 - 2.0 * phi).sqrt();
    let turns = [at(TAU, -1.0), at(0.0, 1.0), at(-TAU, 1.0)];
    let seen: Vec<(EventKind, f64)> = motion.events.iter().map(|e| (e.kind, e.t)).collect();
    let due = [
        (EventKind::Turn(1), turns[0]),
        (EventKind::Rest, 5.0),
        (EventKind::Turn(0), turns[1]),
        (EventKind::Turn(-1), turns[2]),
    ];
    assert_eq!(seen.len(), due.len(), "{seen:?}");
    for ((kind, t), (due, at)) in seen.iter().zip(due) {
        assert_eq!(*kind, due);
        assert!((t - at).abs() < 1e-9);
    }
    let means = [
        TAU / turns[0],
        -TAU / (turns[1] - at(TAU, 1.0)),
        -TAU / (turns[2] - turns[1]),
    ];
    for (turn, due) in motion.turns.iter().zip(means) {
        assert!((turn.mean - due).abs() < 1e-9, "{turn:?}");
        assert!(turn.imbalance.abs() < 1e-9);
    }
    assert_eq!(motion.outcome, Outcome::TimeUp);
}

/// Weights that a motor does not hold turn the crank back; a table of speeds from standstill on
/// does not say how.
#[test]
fn a_motor_that_is_overcome_is_turned_back() {
    let model = Weighted(|_| -5.0);
    let constant = drive(Motor::constant(Torque::from_n_m(2.0)).unwrap(), 0.0);
    let motion = run(&Equation::new(&model, &constant), &plan(0.0, 4.0, 3.0)).unwrap();
    assert_eq!(motion.outcome, Outcome::TimeUp);
    assert_eq!(rests(&motion).len(), 1);
    assert!((motion.end.psi + 3.0 * (3.0 - 4.0 / 3.0)).abs() < 1e-10);
    let table = TorqueTable::new(&[(0.0, 2.0), (9.0, 2.0)], TableReading::Linear).unwrap();
    let table = drive(Motor::Table(table), 0.0);
    let motion = run(&Equation::new(&model, &table), &plan(0.0, 4.0, 3.0)).unwrap();
    assert_eq!(motion.outcome, Outcome::Stalled { torque: -3.0 });
    assert!((motion.end.t - 4.0 / 3.0).abs() < 1e-12);
}

fn timed(points: &[(f64, f64)], constant: f64) -> Drive {
    drive(Motor::Timed(TimedTorque::new(points).unwrap()), constant)
}

/// `M = 3 t` up to 2 s: `ψ = 1.5 t²` to there, and 6 rad/s² on; against friction of 1.5 N·m from
/// 0.5 s on. While the crank waits, friction takes all of the torque.
#[test]
fn a_soft_start_goes_on_once_the_torque_is_enough() {
    let model = Weighted(|_| 0.0);
    let points = [(0.0, 0.0), (2.0, 6.0)];
    for method in Method::ALL {
        let mut plan = plan(0.0, 0.0, 3.0);
        plan.settings.method = method;
        plan.settings.tolerance = if method == Method::Radau5 {
            1e-10
        } else {
            1e-12
        };
        plan.sampling = Some(0.125);
        let free = timed(&points, 0.0);
        let motion = run(&Equation::new(&model, &free), &plan).unwrap();
        assert_eq!(motion.samples.len(), 25);
        for s in &motion.samples {
            let due = match s.t <= 2.0 {
                true => 1.5 * s.t * s.t,
                false => 6.0 + 6.0 * (s.t - 2.0),
            };
            assert!(
                (s.psi - due).abs() < 1e-7,
                "{method:?} {}: {} {due}",
                s.t,
                s.psi
            );
            assert!((s.motor - 3.0 * s.t.min(2.0)).abs() < 1e-12);
        }
        let held = timed(&points, 1.5);
        let motion = run(&Equation::new(&model, &held), &plan).unwrap();
        assert_eq!(motion.samples.len(), 25);
        for s in motion.samples.iter().filter(|s| s.t <= 2.0) {
            let moving = (s.t - 0.5).max(0.0);
            assert!(
                (s.psi - 1.5 * moving * moving).abs() < 1e-7,
                "{method:?} {s:?}"
            );
            if s.t <= 0.5 {
                assert_eq!((s.psi, s.acceleration, s.resistance), (0.0, 0.0, -s.motor));
            }
        }
        assert!(motion.end.balance.abs() < 1e-7);
    }
}

/// A pulse, rest, and a pulse the other way; without the second the crank stays where it is.
#[test]
fn a_crank_at_rest_waits_for_its_motor() {
    let model = Weighted(|_| 0.0);
    let pulse = [(0.0, 0.0), (1.0, 4.0), (2.0, 0.0), (6.0, 0.0), (7.0, -4.0)];
    let motion = run(
        &Equation::new(&model, &timed(&pulse, 1.0)),
        &plan(0.0, 0.0, 7.0),
    )
    .unwrap();
    // Let go at 0.25 s; 4 t − 1 up to 1 s, 7 − 4 t to 2 s, then −1: at rest where the speed is used
    // up.
    let speed = 2.0 * 0.75 * 0.75 + (7.0 - 2.0 * 3.0);
    let found = rests(&motion);
    assert_eq!(found.len(), 1);
    assert!((found[0].0 - 2.0 - speed).abs() < 1e-8, "{found:?} {speed}");
    assert!((motion.end.psi + 2.0 * 0.75 * 0.75).abs() < 1e-7);
    assert_eq!(motion.outcome, Outcome::TimeUp);
    let motion = run(
        &Equation::new(&model, &timed(&pulse[..4], 1.0)),
        &plan(0.0, 0.0, 9.0),
    )
    .unwrap();
    assert_eq!(motion.outcome, Outcome::Stalled { torque: 0.0 });
    // Never enough.
    let motion = run(
        &Equation::new(&model, &timed(&pulse, 5.0)),
        &plan(0.0, 0.0, 9.0),
    )
    .unwrap();
    assert_eq!(
        (motion.outcome, motion.end.t),
        (Outcome::Stalled { torque: 0.0 }, 0.0)
    );
}

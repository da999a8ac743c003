//! Describes what a run makes of the integration: neighbours, samples, events, turns, outcomes.

use super::*;
use crate::run_up::{
    Coefficients, ConstantInertia, Drive, Method, ModelError, Motor, ReducedModel, Resistance,
    Settings,
};
use crate::units::Torque;

/// I = 1 kg·m², a constant moment, and a constant that stands for dI/dφ: where it is not zero the
/// energy is not kept.
#[derive(Clone, Copy)]
struct Simple {
    moment: f64,
    derivative: f64,
    dead: &'static [f64],
}

const FREE: Simple = Simple {
    moment: 0.0,
    derivative: 0.0,
    dead: &[],
};

impl ReducedModel for Simple {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        Ok(Coefficients {
            moment: self.moment,
            inertia_derivative: self.derivative,
            ..ConstantInertia(1.0).coefficients(phi)?
        })
    }
    fn dead_positions(&self) -> &[f64] {
        self.dead
    }
}

fn off() -> Drive {
    Drive::direct(Motor::Off)
}

fn constant(torque: f64) -> Drive {
    Drive::direct(Motor::constant(Torque::from_n_m(torque)).unwrap())
}

fn from(phi: f64, psi: f64, duration: f64) -> Plan {
    Plan {
        psi,
        ..Plan::new(phi, duration)
    }
}

fn with_run<T>(model: &Simple, drive: &Drive, plan: &Plan, ask: impl FnOnce(&mut Run) -> T) -> T {
    let equation = Equation::new(model, drive);
    ask(&mut Run::begin(&equation, plan, 1.0).unwrap())
}

/// An angle within 1e-12 (1 + |φ|) is φ itself, the bounds included.
#[test]
fn what_counts_as_the_angle_itself() {
    assert_eq!(neighbours(&[100.0], 101.0), (100.0, 100.0 + TAU));
    let around = |a: f64| (a - TAU, a + TAU);
    assert_eq!(neighbours(&[5e-13], 0.0), around(5e-13));
    assert_eq!(neighbours(&[-1e-12], 0.0), around(-1e-12));
    let below = (-1e-12f64).next_down();
    assert_eq!(neighbours(&[below], 0.0), (below, below + TAU));
    // From 5 on, where 2π and the angle have the same last place and 2π less is exact.
    let edge = 5.0 + 1e-12 * 6.0;
    assert_eq!(neighbours(&[edge], 5.0), around(edge));
    let above = edge.next_up();
    assert_eq!(neighbours(&[above], 5.0), (above - TAU, above));
}

#[test]
fn neighbours_among_whole_turns() {
    let angles = [0.5, 2.0, 5.0];
    for turns in [-4.0, -1.0, 0.0, 3.0] {
        let off = turns * TAU;
        let check = |phi: f64, low: f64, high: f64| {
            let (a, b) = neighbours(&angles, phi + off);
            assert!(
                (a - low - off).abs() < 1e-13 && (b - high - off).abs() < 1e-13,
                "{a} {b}"
            );
        };
        check(1.0, 0.5, 2.0);
        check(3.0, 2.0, 5.0);
        check(0.1, 5.0 - TAU, 0.5);
        check(6.0, 5.0, 0.5 + TAU);
        // One that it stands on is neither before nor after.
        check(2.0, 0.5, 5.0);
        check(2.0 + 1e-14, 0.5, 5.0);
        check(2.0 + 1e-9, 2.0, 5.0);
        check(2.0 - 1e-9, 0.5, 2.0);
    }
    assert_eq!(neighbours(&[], 1.0), (f64::NEG_INFINITY, f64::INFINITY));
    let (a, b) = neighbours(&[1.0], 1.0);
    assert!((a - (1.0 - TAU)).abs() < 1e-15 && (b - (1.0 + TAU)).abs() < 1e-15);
}

/// A speed within 1e-14 |ψ| is ψ itself, the bounds included.
#[test]
fn what_counts_as_the_speed_itself() {
    let here = 1e-14 * 1000.0;
    let (low, high) = (1000.0 - here, 1000.0 + here);
    let speeds = [3.0, low, 1000.0, high, 2000.0];
    assert_eq!(between(&speeds, 1000.0), (3.0, 2000.0));
    let speeds = [3.0, low.next_down(), high.next_up(), 2000.0];
    assert_eq!(between(&speeds, 1000.0), (speeds[1], speeds[2]));
    let free = (f64::NEG_INFINITY, f64::INFINITY);
    assert_eq!(between(&[1000.0], 1000.0), free);
}

/// From rest the crank goes with the torque, not against its motor.
#[test]
fn directions_from_rest() {
    let way = |torque: f64, moment: f64| {
        let model = Simple { moment, ..FREE };
        let drive = constant(torque);
        direction(&Equation::new(&model, &drive), &Plan::new(0.0, 1.0)).unwrap()
    };
    // Without a motor the weights alone.
    assert_eq!((way(0.0, 2.0), way(0.0, -2.0)), (Ok(1.0), Ok(-1.0)));
    assert_eq!((way(3.0, -2.0), way(3.0, 2.0)), (Ok(1.0), Ok(1.0)));
    assert_eq!((way(-3.0, 2.0), way(-3.0, -2.0)), (Ok(-1.0), Ok(-1.0)));
    assert_eq!((way(3.0, -5.0), way(-3.0, 5.0)), (Err(-2.0), Err(2.0)));
    assert_eq!((way(0.0, 0.0), way(3.0, -3.0)), (Err(0.0), Err(0.0)));
}

/// A run that stays at rest says with what torque: here friction of 4 N·m holds the crank.
#[test]
fn the_torque_at_rest() {
    let model = Simple {
        moment: -5.0,
        ..FREE
    };
    let none = crate::units::Inertia::from_kg_m2(0.0);
    let friction = Resistance {
        constant: Torque::from_n_m(4.0),
        ..Resistance::default()
    };
    let motor = Motor::constant(Torque::from_n_m(2.0)).unwrap();
    let drive = Drive::new(motor, 1.0, none, none, friction).unwrap();
    let motion = run(&Equation::new(&model, &drive), &from(0.0, 4.0, 9.0)).unwrap();
    assert_eq!(motion.outcome, Outcome::Stalled { torque: -3.0 });
    assert!((motion.end.t - 4.0 / 7.0).abs() < 1e-14);
    assert_eq!(motion.events.last().unwrap().kind, EventKind::Rest);
}

/// Samples are at whole multiples of the step and at the end, whether steps end there or not.
#[test]
fn samples_are_at_their_times() {
    let (model, drive) = (FREE, constant(2.0));
    let equation = Equation::new(&model, &drive);
    let counts = |method, sampling, duration| {
        let plan = Plan {
            sampling,
            settings: Settings {
                method,
                ..Settings::default()
            },
            ..Plan::new(0.0, duration)
        };
        let motion = run(&equation, &plan).unwrap();
        assert_eq!(motion.outcome, Outcome::TimeUp);
        for s in &motion.samples {
            // ψ = 2t and φ = t².
            let apart = (s.psi - 2.0 * s.t).abs().max((s.phi - s.t * s.t).abs());
            assert!(apart < 1e-11, "{method:?}: {s:?}");
        }
        let times: Vec<f64> = motion.samples.iter().map(|s| s.t).collect();
        (times, motion.counts)
    };
    for method in Method::ALL {
        let (times, with) = counts(method, Some(0.25), 1.125);
        assert_eq!(times, [0.0, 0.25, 0.5, 0.75, 1.0, 1.125]);
        let (times, _) = counts(method, Some(0.25), 1.0);
        assert_eq!(times, [0.0, 0.25, 0.5, 0.75, 1.0]);
        let (times, without) = counts(method, None, 1.125);
        assert!(times.is_empty());
        let apart = method.ends_steps_at_samples();
        assert_eq!(apart, method == Method::Dop853);
        // Where they are read between the ends of the steps, the steps do not heed them.
        assert_eq!(with.steps != without.steps, apart, "{method:?}");
    }
}

/// Passages of dead positions and of the angle at the start, with the number of the turn.
#[test]
fn passages_and_turns() {
    let model = Simple {
        dead: &[0.5, 4.0],
        ..FREE
    };
    let drive = off();
    for sign in [1.0, -1.0] {
        let plan = from(1.0, sign * 4.0, 3.5 * TAU / 4.0);
        let motion = run(&Equation::new(&model, &drive), &plan).unwrap();
        let seen: Vec<EventKind> = motion.events.iter().map(|e| e.kind).collect();
        let (dead, turn) = (EventKind::DeadPosition, EventKind::Turn);
        let n = |k: i64| turn(sign as i64 * k);
        let due = [dead, dead, n(1), dead, dead, n(2), dead, dead, n(3), dead];
        assert_eq!(seen, due);
        assert_eq!(motion.counts.retaken, 10);
        assert_eq!(motion.turns.len(), 3);
        for (k, turn) in motion.turns.iter().enumerate() {
            let t = (k + 1) as f64 * TAU / 4.0;
            assert!((turn.t - t).abs() < 1e-13 && turn.imbalance.abs() < 1e-12);
            assert!((turn.mean - sign * 4.0).abs() < 1e-12);
        }
    }
}

/// An angle is known again after many turns, and one beside zero.
#[test]
fn angles_are_known_again() {
    let model = Simple {
        dead: &[5e-13],
        ..FREE
    };
    with_run(&model, &off(), &from(2.4, 1.0, 1.0), |run| {
        for (phi, kinds) in [
            (2.4 + 1e4 * TAU, vec![EventKind::Turn(10_000)]),
            (2.4 + 12_345.0 * TAU, vec![EventKind::Turn(12_345)]),
            (2.4 + 98_765.0 * TAU, vec![EventKind::Turn(98_765)]),
            (2.4 - 3.0 * TAU, vec![EventKind::Turn(-3)]),
            (0.0, vec![EventKind::DeadPosition]),
            (-2.4, vec![]),
            (3.5, vec![]),
        ] {
            run.events.clear();
            assert_eq!(run.passed(phi), None);
            let found: Vec<EventKind> = run.events.iter().map(|e| e.kind).collect();
            assert_eq!(found, kinds, "{phi}");
        }
        // As the next one after the last, rounded once more with each turn.
        for turns in 50_000..50_020 {
            let (_, phi) = neighbours(&[2.4], 2.4 + f64::from(turns - 1) * TAU);
            run.events.clear();
            run.passed(phi);
            assert_eq!(run.events[0].kind, EventKind::Turn(turns.into()), "{phi}");
        }
    });
}

#[test]
fn events_are_kept_up_to_a_number() {
    with_run(&FREE, &off(), &from(0.0, 1.0, 1.0), |run| {
        run.event(EventKind::Target);
        let (t, phi, psi, kind) = (0.0, 0.0, 1.0, EventKind::Target);
        assert_eq!(run.events, [Event { t, phi, psi, kind }]);
        run.events = vec![run.events[0]; MOST_EVENTS - 1];
        run.event(EventKind::Rest);
        assert_eq!(run.events.len(), MOST_EVENTS);
        run.event(EventKind::Rest);
        assert_eq!(run.events.len(), MOST_EVENTS);
    });
}

/// With a constant for dI/dφ the energy falls by `exp(−d 2π)` a turn: `dψ/dφ = −d ψ/2`.
#[test]
fn the_imbalance_of_each_turn() {
    let d = 0.01;
    let model = Simple {
        derivative: d,
        ..FREE
    };
    let drive = off();
    let motion = run(&Equation::new(&model, &drive), &from(0.0, 4.0, 5.5)).unwrap();
    assert_eq!(motion.turns.len(), 3);
    let energy = |turns: i32| 8.0 * (-d * TAU * f64::from(turns)).exp();
    for (k, turn) in motion.turns.iter().enumerate() {
        let due = energy(k as i32 + 1) - energy(k as i32);
        assert!((turn.imbalance - due).abs() < 1e-8, "{turn:?} {due}");
    }
}

/// Two turns repeat if their speeds differ by less than the fraction asked for: here they differ by
/// `exp(d π) − 1`, 3.1909e-2, of the latter one.
#[test]
fn when_a_run_has_settled() {
    let model = Simple {
        derivative: 0.01,
        ..FREE
    };
    let drive = off();
    for psi in [0.25, 10.0] {
        let settled = |fraction| {
            let plan = Plan {
                settled: Some(fraction),
                ..from(0.0, psi, 1.5 * TAU / psi)
            };
            run(&Equation::new(&model, &drive), &plan).unwrap().outcome
        };
        assert!(matches!(settled(0.0320), Outcome::Settled { .. }));
        assert_eq!(settled(0.0318), Outcome::TimeUp);
    }
}

/// Captured is what settles short of a target or of the pull-out speed, in the direction of it.
#[test]
fn settled_or_captured() {
    let model = FREE;
    let outcome = |drive: &Drive, psi: f64, target: Option<f64>| {
        let plan = Plan {
            settled: Some(1e-6),
            target,
            ..from(0.0, psi, 100.0)
        };
        match run(&Equation::new(&model, drive), &plan).unwrap().outcome {
            Outcome::Settled { mean } => (mean, false),
            Outcome::Captured { mean } => (mean, true),
            o => panic!("{o:?}"),
        }
    };
    let drive = off();
    for sign in [1.0, -1.0] {
        let of = |target: f64| outcome(&drive, sign * 4.0, Some(sign * target)).1;
        assert!(of(9.0) && !of(3.0) && !of(-9.0) && !of(-3.0) && !of(0.0));
        // Exactly as fast is not short.
        let (mean, captured) = outcome(&drive, sign * 4.0, None);
        assert!(!captured && (mean - sign * 4.0).abs() < 1e-13);
        assert!(!of(sign * mean));
    }
}

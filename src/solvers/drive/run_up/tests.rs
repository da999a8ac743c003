//! Motions with known answers.

use super::dyad_model::tests::{four_bar, slider_crank};
use super::model::tests::{START, sand_screen};
use super::*;
use crate::units::{Angle, AngularVelocity, Inertia, Torque};
use std::f64::consts::TAU;

fn kloss(synchronous: f64, rated: f64) -> Motor {
    let w = AngularVelocity::from_rad_per_s(synchronous);
    Motor::Kloss(Kloss::rated(w, Torque::from_n_m(rated), 2.2, 0.05).unwrap())
}

fn settings(method: Method, tolerance: f64) -> Settings {
    Settings {
        tolerance,
        method,
        ..Settings::default()
    }
}

fn tight() -> Settings {
    settings(Method::default(), 1e-12)
}

/// Without weights: free motion.
struct Weightless<'a>(&'a dyn ReducedModel);

impl ReducedModel for Weightless<'_> {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        let c = self.0.coefficients(phi)?;
        Ok(Coefficients { moment: 0.0, ..c })
    }
    fn knots(&self) -> &[f64] {
        self.0.knots()
    }
}

/// Crank speed of the sand screen at some times, from rest at 14.426° under ω_c = 10 rad/s,
/// M_n = 200 N·m, k = 2.2, s_n = 0.05: two methods in 50-digit arithmetic agree to 25 digits.
const KNOWN: [(f64, f64); 4] = [
    (0.01, 9.893_806_153_974_392),
    (0.1, 9.654_357_617_467_618),
    (1.0, 9.504_285_733_743_605),
    (3.0, 9.704_704_223_655_904),
];

#[test]
fn every_method_meets_the_known_speeds() {
    let model = sand_screen();
    let drive = Drive::direct(kloss(10.0, 200.0));
    let equation = Equation::new(&model, &drive);
    for (method, tolerance, allowed) in [
        (Method::Dop853, 1e-12, 1e-12),
        (Method::Dop853, 1e-8, 1e-8),
        (Method::Verner98, 1e-12, 1e-12),
        (Method::Radau5, 1e-12, 1e-10),
        (Method::Radau5, 1e-7, 1e-6),
    ] {
        for (t, psi) in KNOWN {
            let plan = Plan {
                settings: settings(method, tolerance),
                ..Plan::new(START, t)
            };
            let motion = run(&equation, &plan).unwrap();
            let error = (motion.end.psi - psi).abs();
            assert!(error < allowed, "{method:?} {tolerance:e} {t}: {error:e}");
            assert_eq!(motion.end.t, t);
            assert_eq!(motion.outcome, Outcome::TimeUp);
        }
    }
}

/// Samples, dense or at ends of steps, against a finer run.
#[test]
fn methods_agree_at_every_sample() {
    let model = sand_screen();
    let drive = Drive::direct(kloss(10.0, 200.0));
    let equation = Equation::new(&model, &drive);
    let motion = |s| {
        let plan = Plan {
            settings: s,
            sampling: Some(1e-3),
            ..Plan::new(START, 3.0)
        };
        run(&equation, &plan).unwrap()
    };
    let finest = motion(settings(Method::Verner98, 1e-13));
    for (method, tolerance, allowed) in [
        (Method::Verner98, 1e-12, 1e-11),
        (Method::Dop853, 1e-12, 1e-11),
        (Method::Radau5, 1e-12, 1e-8),
    ] {
        let a = motion(settings(method, tolerance));
        assert_eq!((a.samples.len(), finest.samples.len()), (3001, 3001));
        let apart = a.samples.iter().zip(&finest.samples).map(|(a, b)| {
            assert_eq!(a.t, b.t);
            (a.psi - b.psi).abs()
        });
        let apart = apart.fold(0.0, f64::max);
        println!(
            "{method:?}: {apart:.1e} rad/s from the finest, {:?}",
            a.counts
        );
        assert!(apart < allowed, "{method:?}: {apart:e}");
    }
    let a = &finest;
    assert!(a.samples.iter().all(|s| s.balance.abs() < 1e-9));
    // Nearly five turns, two dead positions each.
    let of = |kind| a.events.iter().filter(|e| e.kind == kind).count();
    assert_eq!(a.turns.len(), 4);
    assert_eq!(of(EventKind::DeadPosition), 10);
}

/// No load, constant inertia: `t = (I ω_c / 2 M_k) (S_k ln(S_0/S) + (S_0² − S²)/(2 S_k))`.
#[test]
fn closed_form_of_a_bare_rotor() {
    let (mk, i, wc, sk) = (22.0, 0.9, 157.0, 0.2);
    let motor = Kloss::critical(
        AngularVelocity::from_rad_per_s(wc),
        Torque::from_n_m(mk),
        sk,
    );
    let drive = Drive::direct(Motor::Kloss(motor.unwrap()));
    let rotor = ConstantInertia(i);
    let equation = Equation::new(&rotor, &drive);
    let due = 0.045_260_687_015_233_54;
    let time = |s0: f64, s: f64| {
        i * wc / (2.0 * mk) * (sk * (s0 / s).ln() + (s0 * s0 - s * s) / (2.0 * sk))
    };
    assert!((time(1.0, due) - 10.0).abs() < 1e-13);
    for method in Method::ALL {
        let s = settings(method, 1e-12);
        let allowed = if method == Method::Radau5 {
            1e-10
        } else {
            1e-12
        };
        let plan = Plan {
            settings: s,
            ..Plan::new(0.0, 10.0)
        };
        let slip = 1.0 - run(&equation, &plan).unwrap().end.psi / wc;
        assert!((slip - due).abs() < allowed, "{method:?}: {slip}");
        // From plugging (backwards at half speed is left out: the run would end at rest) and
        // from beyond synchronous speed, where the motor brakes as a generator.
        for (s0, s1) in [(0.9, 0.1), (-0.6, -0.05)] {
            let plan = Plan {
                psi: wc * (1.0 - s0),
                target: Some(wc * (1.0 - s1)),
                settings: s,
                ..Plan::new(0.0, 100.0)
            };
            let motion = run(&equation, &plan).unwrap();
            assert_eq!(motion.outcome, Outcome::Target);
            let error = (motion.end.t - time(s0, s1)).abs();
            assert!(error < 1e2 * allowed, "{method:?} {s0}: {error:e}");
        }
    }
}

/// Free motion: energy is kept where dI_n/dφ belongs to I_n, and lost by the hybrid at the known
/// rate.
#[test]
fn free_motion_keeps_or_loses_energy() {
    let exact = sand_screen();
    let drive = Drive::direct(Motor::Off);
    let splined = Splined::new(&exact, START, 12).unwrap();
    let hybrid = |n| Hybrid::new(sand_screen(), START, n).unwrap();
    let (h12, h48) = (hybrid(12), hybrid(48));
    let models: [(&dyn ReducedModel, f64, f64); 4] = [
        // Some hundred steps a turn, each allowed 1e-12; worst found 2.1e-12.
        (&exact, 1.0, 1e-11),
        (&splined, 1.0, 1e-11),
        (&h12, 0.880_234_866_6, 1e-10),
        (&h48, 0.999_868_96, 5e-9),
    ];
    for (k, (model, factor, allowed)) in models.into_iter().enumerate() {
        let free = Weightless(model);
        let plan = Plan {
            psi: 10.0,
            settings: tight(),
            ..Plan::new(START, 45.0)
        };
        let motion = run(&Equation::new(&free, &drive), &plan).unwrap();
        assert!(motion.turns.len() >= 3);
        let mut before = 10.0;
        for turn in &motion.turns {
            let found = turn.psi / before;
            assert!((found - factor).abs() < allowed, "{k}: {found}");
            before = turn.psi;
        }
    }
}

#[test]
fn the_steady_cycle_is_that_of_a_long_run() {
    let model = sand_screen();
    let drive = Drive::direct(kloss(10.0, 200.0));
    let equation = Equation::new(&model, &drive);
    let cycle = steady_cycle(&equation, START, 10.0, tight()).unwrap();
    assert!((cycle.mean - 9.985_72).abs() < 1e-5, "{cycle:?}");
    assert!((cycle.fluctuation - 0.141_03).abs() < 1e-5);
    assert!((cycle.least.0 - 9.3641).abs() < 1e-4 && (cycle.most.0 - 10.7724).abs() < 1e-4);
    assert!(cycle.mismatch < 1e-11);
    // Weights return what they take; then so does the motor.
    assert!(cycle.work.iter().all(|w| w.abs() < 1e-9), "{cycle:?}");
    let plan = Plan {
        settled: Some(1e-10),
        settings: tight(),
        ..Plan::new(START, 20.0)
    };
    let motion = run(&equation, &plan).unwrap();
    let Outcome::Settled { mean } = motion.outcome else {
        panic!("{:?}", motion.outcome)
    };
    assert!((mean - cycle.mean).abs() < 1e-9);
    assert!((motion.end.psi - cycle.psi).abs() < 1e-9);
}

/// With a heavy flywheel the disturbance dies slowly and the multiplier can be watched.
#[test]
fn the_multiplier_is_what_is_left_of_a_disturbance() {
    let model = four_bar();
    let drive = Drive::direct(kloss(30.0, 10.0))
        .with_flywheel(Inertia::from_kg_m2(5.0))
        .unwrap();
    let equation = Equation::new(&model, &drive);
    let cycle = steady_cycle(&equation, 0.0, 29.0, tight()).unwrap();
    assert!(
        cycle.multiplier > 0.1 && cycle.multiplier < 0.9,
        "{cycle:?}"
    );
    let after = |psi: f64| {
        let plan = Plan {
            psi,
            settings: tight(),
            ..Plan::new(0.0, 1.5 * cycle.period)
        };
        run(&equation, &plan).unwrap().turns[0].psi
    };
    let h = 1e-3;
    let slope = (after(cycle.psi + h) - after(cycle.psi - h)) / (2.0 * h);
    assert!((slope - cycle.multiplier).abs() < 1e-6, "{slope}");
}

#[test]
fn a_flywheel_evens_the_run() {
    let model = slider_crank();
    let drive = Drive::direct(kloss(30.0, 3.0));
    let equation = Equation::new(&model, &drive);
    let bare = steady_cycle(&equation, 0.3, 29.0, Settings::default()).unwrap();
    let wanted = 0.25 * bare.fluctuation;
    let found = flywheel(&equation, 0.3, 29.0, wanted, Settings::default()).unwrap();
    assert!(found.inertia > 0.0);
    let with = drive
        .with_flywheel(Inertia::from_kg_m2(found.inertia))
        .unwrap();
    let again = steady_cycle(&Equation::new(&model, &with), 0.3, 29.0, tight()).unwrap();
    assert!((again.fluctuation / wanted - 1.0).abs() < 1e-5, "{again:?}");
    let none = flywheel(&equation, 0.3, 29.0, 1.9, Settings::default()).unwrap();
    assert_eq!(none.inertia, 0.0);
    let e = flywheel(&equation, 0.3, 29.0, 0.0, Settings::default()).unwrap_err();
    assert_eq!(e, FlywheelError::Fluctuation { value: 0.0 });
}

#[test]
fn a_weak_motor_stalls_and_is_not_waited_for() {
    let model = sand_screen();
    // From rest at its own height the screen comes round however weak the motor, but not against
    // friction.
    let r = Resistance {
        constant: Torque::from_n_m(10.0),
        ..Resistance::default()
    };
    let none = Inertia::from_kg_m2(0.0);
    let drive = Drive::new(kloss(10.0, 5.0), 1.0, none, none, r).unwrap();
    let equation = Equation::new(&model, &drive);
    let motion = run(&equation, &Plan::new(START, 1000.0)).unwrap();
    let Outcome::Stalled { torque } = motion.outcome else {
        panic!("{:?}", motion.outcome)
    };
    assert!(
        torque < 0.0 && motion.end.psi == 0.0 && motion.end.t < 10.0,
        "{motion:?}"
    );
    assert!(matches!(
        steady_cycle(&equation, START, 1.0, Settings::default()),
        Err(CycleError::Stalled { .. })
    ));
    // At 200 degrees on the weights pull back harder than the motor pulls: it does not start.
    let motion = run(&equation, &Plan::new(START + 5.2, 1000.0)).unwrap();
    assert!(matches!(motion.outcome, Outcome::Stalled { torque } if torque < -50.0));
    assert_eq!((motion.end.t, motion.counts.steps), (0.0, 0));
}

/// A fan-like load whose curve crosses the motor's below the pull-out torque.
#[test]
fn a_captured_run_is_told_from_a_settled_one() {
    let rotor = ConstantInertia(0.9);
    let motor = kloss(157.0, 10.0);
    let with = |viscous_n_m_s| {
        let r = Resistance {
            viscous_n_m_s,
            ..Resistance::default()
        };
        let none = Inertia::from_kg_m2(0.0);
        let drive = Drive::new(motor.clone(), 1.0, none, none, r).unwrap();
        let plan = Plan {
            settled: Some(1e-9),
            ..Plan::new(0.0, 1e4)
        };
        let motion = run(&Equation::new(&rotor, &drive), &plan).unwrap();
        (motion.outcome, drive)
    };
    let (outcome, drive) = with(0.3);
    let Outcome::Captured { mean } = outcome else {
        panic!("{outcome:?}")
    };
    let (m, _) = drive.motor_torque(mean).unwrap();
    assert!((m - 0.3 * mean).abs() < 1e-5, "{mean}");
    assert!(matches!(with(0.02).0, Outcome::Settled { mean } if mean > 150.0));
}

#[test]
fn run_down_against_resistance() {
    let rotor = ConstantInertia(2.0);
    let r = Resistance {
        constant: Torque::from_n_m(3.0),
        viscous_n_m_s: 0.5,
        quadratic_n_m_s2: 0.0,
    };
    let none = Inertia::from_kg_m2(0.0);
    for psi in [20.0, -20.0] {
        let drive = Drive::new(Motor::Off, 1.0, none, none, r).unwrap();
        let plan = Plan {
            psi,
            settings: tight(),
            ..Plan::new(0.0, 100.0)
        };
        let motion = run(&Equation::new(&rotor, &drive), &plan).unwrap();
        // I ψ' = −c0 − c1 ψ: at rest after (I/c1) ln(1 + c1 ψ0/c0).
        let due = 2.0 / 0.5 * (1.0 + 0.5 * 20.0 / 3.0f64).ln();
        assert!((motion.end.t - due).abs() < 1e-10, "{}", motion.end.t);
        assert_eq!(motion.outcome, Outcome::Stalled { torque: 0.0 });
        assert!(motion.end.balance.abs() < 1e-9);
        assert_eq!(motion.turns.len(), (motion.end.phi.abs() / TAU) as usize);
    }
}

/// A piecewise straight curve has kinks; each is a stop, so the order of the method survives.
#[test]
fn tabulated_and_straight_characteristics() {
    let w = AngularVelocity::from_rad_per_s(100.0);
    let rotor = ConstantInertia(0.5);
    let straight = Drive::direct(Motor::linear(Torque::from_n_m(40.0), w).unwrap());
    let points: Vec<(f64, f64)> = (0..=7)
        .map(|k| (20.0 * f64::from(k), 40.0 - 8.0 * f64::from(k)))
        .collect();
    let plan = Plan {
        settings: tight(),
        ..Plan::new(0.0, 2.0)
    };
    let due = 100.0 * (1.0 - (-2.0f64 * 40.0 / (0.5 * 100.0)).exp());
    let end = |d: &Drive| run(&Equation::new(&rotor, d), &plan).unwrap().end.psi;
    assert!((end(&straight) - due).abs() < 1e-10);
    for reading in [TableReading::Linear, TableReading::Cubic] {
        let table = Drive::direct(Motor::Table(TorqueTable::new(&points, reading).unwrap()));
        assert!((end(&table) - due).abs() < 1e-10, "{reading:?}");
    }
    // Two slopes: 40 − ω up to 20, then 30 − ω/2.
    let kinked = [(0.0, 40.0), (20.0, 20.0), (60.0, 0.0)];
    let table = TorqueTable::new(&kinked, TableReading::Linear).unwrap();
    let drive = Drive::direct(Motor::Table(table));
    let t1 = 0.5 * (40.0f64 / 20.0).ln();
    let due = 60.0 - 40.0 * (-(2.0 - t1)).exp();
    assert!((end(&drive) - due).abs() < 1e-10);
}

#[test]
fn bad_requests_and_used_up_budgets_are_typed() {
    let model = sand_screen();
    let drive = Drive::direct(kloss(10.0, 200.0));
    let equation = Equation::new(&model, &drive);
    let good = Plan::new(START, 1.0);
    let with = |change: &dyn Fn(&mut Plan)| {
        let mut plan = good.clone();
        change(&mut plan);
        run(&equation, &plan).unwrap_err()
    };
    let refused = |part: &str, change: &dyn Fn(&mut Plan)| {
        let e = with(change);
        assert!(matches!(e, RunError::Settings(_)), "{e}");
        assert!(e.to_string().contains(part), "{part}: {e}");
    };
    for bad in [f64::NAN, f64::INFINITY] {
        refused("angle at the start", &|p| p.phi = bad);
        refused("speed at the start", &|p| p.psi = bad);
        refused("duration", &|p| p.duration = bad);
        refused("target", &|p| p.target = Some(bad));
        refused("sampling", &|p| p.sampling = Some(bad));
        refused("tolerance", &|p| p.settings.tolerance = bad);
    }
    refused("duration", &|p| p.duration = 0.0);
    refused("ten million", &|p| p.sampling = Some(1e-9));
    refused("1e-14", &|p| p.settings.tolerance = 1e-16);
    let e = with(&|p| p.settings.max_steps = 100);
    assert!(matches!(e, RunError::Budget { steps: 100, .. }), "{e}");
    let e = with(&|p| p.phi = 2e6);
    assert!(matches!(e, RunError::Equation { .. }), "{e}");
    // Nothing to accelerate.
    let e = run(&Equation::new(&ConstantInertia(0.0), &drive), &good).unwrap_err();
    assert!(e.to_string().contains("must be positive"), "{e}");
    // Beyond its table a motor has no torque.
    let table = TorqueTable::new(&[(0.0, 50.0), (5.0, 50.0)], TableReading::Linear).unwrap();
    let drive = Drive::direct(Motor::Table(table));
    let e = run(&Equation::new(&ConstantInertia(1.0), &drive), &good).unwrap_err();
    assert!(e.to_string().contains("tabulated from 0 to 5"), "{e}");
    let e = steady_cycle(&equation, START, 0.0, Settings::default()).unwrap_err();
    assert_eq!(e, CycleError::NoSpeed { psi: 0.0 });
}

/// A crank that cannot turn fully ends the run with the angle.
#[test]
fn a_fold_ends_the_run() {
    use crate::class_iii::tests::zinchenko;
    use crate::class_iii::{ClassIii, Geometry};
    use crate::reduction::tests::recovered;
    let mut values = zinchenko().geometry().named_values().map(|n| n.1);
    values[0] = 0.45;
    let linkage = ClassIii::new(Geometry::from_values(&values)).unwrap();
    let modes = linkage.assembly_modes(Angle::from_rad(START)).modes;
    let start = linkage
        .state_near(Angle::from_rad(START), modes[0])
        .unwrap();
    let model = ClassIiiModel::new(linkage, recovered(), start);
    let drive = Drive::direct(Motor::constant(Torque::from_n_m(1000.0)).unwrap());
    let result = run(&Equation::new(&model, &drive), &Plan::new(START, 100.0));
    let ended = match &result {
        Ok(m) => matches!(m.outcome, Outcome::Stalled { .. }),
        Err(e) => matches!(e, RunError::Equation { .. }),
    };
    assert!(ended, "{result:?}");
}

/// A motor a hundred thousand times too strong for its rotor: the slip decays within a microsecond.
#[test]
fn a_stiff_run_goes_on_with_radaus_method() {
    let (speed, torque) = (AngularVelocity::from_rad_per_s(10.0), Torque::from_n_m(1e6));
    let motor = Kloss::rated(speed, torque, 2.2, 0.05).expect("a motor");
    let drive = Drive::direct(Motor::Kloss(motor));
    let rotor = ConstantInertia(0.5);
    let equation = Equation::new(&rotor, &drive);
    let plan = |method, switch_when_stiff| Plan {
        sampling: Some(0.01),
        settings: Settings {
            method,
            switch_when_stiff,
            max_steps: 20_000,
            ..Settings::default()
        },
        ..Plan::new(0.0, 1.0)
    };
    let due = run(&equation, &plan(Method::Radau5, false)).expect("by Radau");
    assert_eq!(due.stiff_from, None);
    for method in [Method::Verner98, Method::Dop853] {
        let switched = run(&equation, &plan(method, true)).expect("a switch");
        let from = switched.stiff_from.expect("stiff");
        assert!(from < 1e-3, "{from}");
        assert!(switched.counts.steps < 3000, "{:?}", switched.counts);
        assert!((switched.end.psi - due.end.psi).abs() < 1e-9);
        assert_eq!(switched.samples.len(), 101);
        let e = run(&equation, &plan(method, false)).unwrap_err();
        assert!(matches!(e, RunError::Stiff { .. }), "{e}");
        assert!(e.to_string().contains("radau5"), "{e}");
    }
    // With a motor of its size the same rotor is not stiff.
    let motor = Kloss::rated(speed, Torque::from_n_m(10.0), 2.2, 0.05).expect("a motor");
    let drive = Drive::direct(Motor::Kloss(motor));
    let plan = plan(Method::Verner98, true);
    let motion = run(&Equation::new(&rotor, &drive), &plan).expect("a motion");
    assert_eq!(motion.stiff_from, None);
}

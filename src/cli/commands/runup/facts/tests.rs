use super::*;
use mechaudit::machine::Source;
use mechaudit::machine::run_up::Overrides;
use mechaudit::solvers::run_up::{CycleError, Flywheel, FlywheelError, Sample, Turn};
use std::f64::consts::{PI, TAU};

const FOUR_BAR: &str = include_str!("../../../../../examples/four-bar-run-up.toml");

/// The crank-rocker of the example with some of its lines changed.
fn machine(changes: &[(&str, &str)]) -> Machine {
    let mut text = FOUR_BAR.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    Machine::read(&Source::toml(text), Overrides::default()).unwrap()
}

/// A run from 90 degrees to five turns later, 2.5 s long.
fn motion(outcome: Outcome) -> Motion {
    let at = |t: f64, phi: f64, psi: f64| Sample {
        t,
        phi,
        psi,
        ..Sample::default()
    };
    let mut end = at(2.5, PI / 2.0 + 5.0 * TAU, 12.25);
    end.balance = -3e-9;
    Motion {
        start: at(0.0, PI / 2.0, 1.0),
        end,
        samples: Vec::new(),
        events: Vec::new(),
        turns: Vec::new(),
        outcome,
        counts: Counts {
            steps: 101,
            rejected: 7,
            retaken: 3,
            evaluations: 1616,
        },
        stiff_from: None,
    }
}

fn cycle() -> Cycle {
    Cycle {
        psi: 30.5,
        period: 0.2,
        mean: 31.25,
        least: (30.0, -PI / 2.0),
        most: (32.5, TAU + PI / 4.0),
        fluctuation: 0.08,
        multiplier: 0.001_25,
        work: [6.0, -0.5, -5.5],
        kinetic_energy: 250.0,
        mismatch: 1e-12,
        iterations: 4,
        counts: Counts::default(),
    }
}

fn cycle_value() -> Value {
    json!({
        "omega_at_start_angle_rad_per_s": 30.5,
        "period_s": 0.2,
        "mean_rad_per_s": 31.25,
        "least_rad_per_s": 30.0,
        "least_at_phi1_deg": -90.0,
        "most_rad_per_s": 32.5,
        "most_at_phi1_deg": 405.0,
        "coefficient_of_fluctuation": 0.08,
        "multiplier": 0.001_25,
        "work_motor_J": 6.0,
        "work_weights_J": -0.5,
        "work_load_J": -5.5,
        "mismatch_rad_per_s": 1e-12,
        "iterations": 4,
    })
}

fn wheel(inertia: f64) -> Flywheel {
    Flywheel {
        inertia,
        cycle: cycle(),
        counts: Counts::default(),
    }
}

const NONE: Steady = Steady {
    cycle: None,
    flywheel: None,
    wanted: f64::NAN,
};

fn refused() -> FlywheelError {
    FlywheelError::Fluctuation { value: 7.0 }
}

fn stalled() -> CycleError {
    CycleError::Stalled {
        psi: 2.0,
        phi: 1.0,
        t: 0.5,
    }
}

#[test]
fn cycles_and_flywheels_have_a_line_each() {
    assert!(steady_lines(&NONE).is_empty());
    let lines = |cycle, flywheel| {
        steady_lines(&Steady {
            cycle,
            flywheel,
            wanted: 0.05,
        })
    };
    let found = "steady cycle: 31.250000 rad/s in the mean, from 30.000000 (at 270.00 deg) to \
                 32.500000 rad/s (at 45.00 deg), coefficient of fluctuation 0.080000, 1.250e-3 of a \
                 disturbance left after a turn";
    assert_eq!(lines(Some(Ok(cycle())), None), [found]);
    assert_eq!(
        lines(Some(Err(stalled())), Some(Err(refused()))),
        [stalled().to_string(), format!("no flywheel: {}", refused()),]
    );
    // The words of an error are not told before it.
    let lost = CycleError::NotFound {
        iterations: 50,
        change: 1e-300,
    };
    assert_eq!(
        lines(Some(Err(lost)), None),
        [
            "no steady cycle found in 50 iterations: the speed at the section still changes by 1e-300 rad/s in a turn"
        ]
    );
    for (inertia, due) in [
        (
            0.0,
            "flywheel: none is needed for a coefficient of fluctuation of 0.05",
        ),
        (
            1.0,
            "flywheel: 1.0000 kg·m² more at the crank give a coefficient of fluctuation of 0.05",
        ),
    ] {
        assert_eq!(lines(None, Some(Ok(wheel(inertia)))), [due]);
    }
}

/// Rotor and flywheel count; less than a twentieth of the largest inertia is little.
#[test]
fn little_inertia_is_warned_of() {
    let bare = machine(&[("rotor_inertia = \"0.02 kg m^2\"", "")]);
    // At the crank 25 times as much.
    let geared = machine(&[]);
    assert!((geared.drive.inertia() - 0.5).abs() < 1e-12);
    let warned = |machine: &Machine, least: f64, most: f64| {
        let range = InertiaRange {
            least,
            least_at: TAU + PI / 18.0,
            most,
        };
        light(machine, &range)
    };
    for (least, most) in [(0.05, 1.0), (0.051, 1.0), (1.0, 19.0), (f64::NAN, 1.0)] {
        assert_eq!(warned(&bare, least, most), None, "{least} {most}");
    }
    assert_eq!(warned(&geared, 0.1, 11.4), None);
    let text = warned(&bare, 0.04, 1.0).unwrap();
    let due = "warning: the reduced inertia falls to 0.04000 kg·m² at phi1 = 10.000 deg, 4.00 % of \
               its largest value 1.0000 kg·m² (I_1 = 0: the file gives neither ";
    assert!(text.starts_with(due), "{text}");
    let text = warned(&geared, 0.1, 19.5).unwrap();
    let due = "warning: the reduced inertia falls to 0.60000 kg·m² at phi1 = 10.000 deg, 3.00 % of \
               its largest value 20.0000 kg·m² (near a dead position ";
    assert!(text.starts_with(due), "{text}");
    assert!(
        text.ends_with(
            "have little inertia); the speed there follows the torque within milliseconds"
        )
    );
}

#[test]
fn how_a_run_ends_is_a_line() {
    let loaded = machine(&[]);
    let free = machine(&[("constant = \"2 N m\"\n", "")]);
    let captured = "captured after 2.500000 s and 5.000 turns: the motion repeats at 11.500000 \
                    rad/s in the mean, below the motor's pull-out torque or the target speed, and \
                    does not get past";
    for (outcome, due) in [
        (
            Outcome::TimeUp,
            "the time is over after 2.500000 s and 5.000 turns at 12.250000 rad/s",
        ),
        (
            Outcome::Target,
            "the target speed 12.250000 rad/s is reached after 2.500000 s and 5.000 turns",
        ),
        (
            Outcome::Settled { mean: 11.5 },
            "the motion repeats after 2.500000 s and 5.000 turns: 11.500000 rad/s in the mean",
        ),
        (Outcome::Captured { mean: 11.5 }, captured),
    ] {
        assert_eq!(ending(&loaded, &motion(outcome)), due);
    }
    let rest = motion(Outcome::Stalled { torque: 1.5 });
    let due = "stalled: the crank comes to rest after 2.500000 s and 5.000 turns at phi1 = 90.000 \
               deg, where motor and weights give 1.500000 N m together";
    assert_eq!(ending(&free, &rest), due);
    let load = " against a constant load of 2.000000 N m";
    assert_eq!(ending(&loaded, &rest), format!("{due}{load}"));
    let held = Motion {
        end: rest.start,
        ..rest.clone()
    };
    let due = "stalled: the crank does not start at phi1 = 90.000 deg, motor and weights give \
               1.500000 N m together";
    assert_eq!(ending(&free, &held), due);
    assert_eq!(ending(&loaded, &held), format!("{due}{load}"));
}

/// A method that the user has chosen stays.
#[test]
fn stiffness_and_cost_are_said() {
    let open = machine(&[]);
    let chosen = machine(&[("step = \"2 ms\"", "method = \"dop853\"\ntolerance = 1e-8")]);
    let hybrid = machine(&[("step = \"2 ms\"", "coefficients = \"hybrid\"")]);
    let smooth = motion(Outcome::TimeUp);
    let stiff_motion = Motion {
        stiff_from: Some(0.125),
        ..smooth.clone()
    };
    assert_eq!(
        (stiff(&open, &smooth), stiff(&chosen, &smooth)),
        (None, None)
    );
    assert_eq!(
        stiff(&open, &stiff_motion).unwrap(),
        "stiff from 1.250e-1 s on: radau5 took over from verner98"
    );
    assert_eq!(
        stiff(&chosen, &stiff_motion).unwrap(),
        "stiff from 1.250e-1 s on: stability alone keeps the steps of dop853 short; --method radau5 needs far fewer"
    );
    let counts = "101 steps, 7 rejected, 3 taken again at events, 1616 evaluations; energy balance -3.000e-9 J";
    let tolerance = open.plan.settings.tolerance;
    let due = [
        format!("verner98 at tolerance {tolerance:e}: {counts}"),
        format!("verner98, then radau5, at tolerance {tolerance:e}: {counts}"),
        format!("dop853 at tolerance 1e-8: {counts}"),
        format!("dop853 at tolerance 1e-8: {counts}"),
    ];
    let all = [
        (&open, &smooth),
        (&open, &stiff_motion),
        (&chosen, &smooth),
        (&chosen, &stiff_motion),
    ];
    assert_eq!(all.map(|(machine, motion)| cost(machine, motion)), due);
    assert_eq!(
        cost(&hybrid, &smooth),
        format!(
            "{}; the hybrid's dI_n/dphi is not the derivative of its I_n, so energy is not kept",
            due[0]
        )
    );
}

#[test]
fn a_json_file_begins_with_all_that_is_known() {
    let event = |kind, t| Event {
        t,
        phi: PI,
        psi: 2.0,
        kind,
    };
    let mut run = motion(Outcome::Settled { mean: 11.5 });
    run.events = vec![
        event(EventKind::DeadPosition, 0.25),
        event(EventKind::Turn(2), 0.5),
        event(EventKind::Target, 0.75),
        event(EventKind::Rest, 1.0),
    ];
    run.turns = vec![Turn {
        t: 0.5,
        psi: 12.0,
        mean: 12.5,
        imbalance: 1e-9,
    }];
    let steady = Steady {
        cycle: Some(Ok(cycle())),
        flywheel: Some(Ok(wheel(3.5))),
        wanted: 0.05,
    };
    let geared = machine(&[("step = \"2 ms\"", "tolerance = 1e-9")]);
    let event = |kind: &str, turn: Option<i64>, t: f64| json!({ "kind": kind, "turn": turn, "t_s": t, "phi1_deg": 180.0, "omega_rad_per_s": 2.0 });
    let inertia = geared.drive.inertia();
    let due = json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "type": "four-bar",
        "name": "crank-rocker, run-up",
        "motor": "table",
        "inertia_at_crank_kg_m2": inertia,
        "coefficients": "exact",
        "nodes": null,
        "method": "verner98",
        "tolerance": 1e-9,
        "stiff_from_s": null,
        "outcome": { "kind": "settled", "mean_rad_per_s": 11.5, "torque_N_m": null },
        "warning": "light",
        "counts": { "steps": 101, "rejected": 7, "retaken": 3, "evaluations": 1616 },
        "events": [
            event("dead_position", None, 0.25),
            event("turn", Some(2), 0.5),
            event("target_speed", None, 0.75),
            event("rest", None, 1.0),
        ],
        "turns": [{
            "t_s": 0.5,
            "omega_rad_per_s": 12.0,
            "mean_rad_per_s": 12.5,
            "energy_imbalance_J": 1e-9,
        }],
        "steady_cycle": cycle_value(),
        "flywheel": { "fluctuation": 0.05, "inertia_kg_m2": 3.5, "cycle": cycle_value() },
    });
    assert_eq!(
        Value::Object(json(&geared, &run, &steady, Some("light"))),
        due
    );
}

#[test]
fn json_names_outcomes_and_what_was_not_found() {
    let splined = machine(&[("step = \"2 ms\"", "coefficients = \"splines\"\nnodes = 12")]);
    for (outcome, due) in [
        (Outcome::TimeUp, json!(["time_up", null, null])),
        (Outcome::Target, json!(["target", null, null])),
        (
            Outcome::Captured { mean: 3.0 },
            json!(["captured", 3.0, null]),
        ),
        (
            Outcome::Stalled { torque: 4.0 },
            json!(["stalled", null, 4.0]),
        ),
    ] {
        let run = Motion {
            stiff_from: Some(0.5),
            ..motion(outcome)
        };
        let found = json(&splined, &run, &NONE, None);
        let [o, steady, wheel] = ["outcome", "steady_cycle", "flywheel"].map(|k| &found[k]);
        let o = json!([o["kind"], o["mean_rad_per_s"], o["torque_N_m"]]);
        assert_eq!(o, due);
        assert!(steady.is_null() && wheel.is_null() && found["warning"].is_null());
        assert_eq!(found["nodes"], 12);
        assert_eq!(found["coefficients"], "splines");
        assert_eq!(found["stiff_from_s"], 0.5);
    }
    let lost = Steady {
        cycle: Some(Err(stalled())),
        flywheel: Some(Err(refused())),
        wanted: 7.0,
    };
    let found = json(&splined, &motion(Outcome::TimeUp), &lost, None);
    assert_eq!(found["steady_cycle"]["error"], stalled().to_string());
    assert_eq!(found["flywheel"]["error"], refused().to_string());
}

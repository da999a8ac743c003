use super::*;
use crate::gallery::Gallery;
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

/// The words of an error are not told before it.
#[test]
fn cycles_and_flywheels_have_a_line_each() {
    assert!(steady_lines(&NONE).is_empty());
    let mut all = Gallery::default();
    let lost = CycleError::NotFound {
        iterations: 50,
        change: 1e-300,
    };
    for (cycle, flywheel) in [
        (Some(Ok(cycle())), None),
        (Some(Err(stalled())), Some(Err(refused()))),
        (Some(Err(lost)), None),
        (None, Some(Ok(wheel(0.0)))),
        (None, Some(Ok(wheel(1.0)))),
    ] {
        let steady = Steady {
            cycle,
            flywheel,
            wanted: 0.05,
        };
        all.add("lines", steady_lines(&steady).join("\n"));
    }
    all.pin("steady-cycles");
}

/// A method that the user has chosen stays.
#[test]
fn ends_and_costs() {
    let mut all = Gallery::default();
    let open = machine(&[]);
    let free = machine(&[("constant = \"2 N m\"\n", "")]);
    let chosen = machine(&[("step = \"2 ms\"", "method = \"dop853\"\ntolerance = 1e-8")]);
    let hybrid = machine(&[("step = \"2 ms\"", "coefficients = \"hybrid\"")]);
    for outcome in [
        Outcome::TimeUp,
        Outcome::Target,
        Outcome::Settled { mean: 11.5 },
        Outcome::Captured { mean: 11.5 },
        Outcome::Stalled { torque: 1.5 },
    ] {
        let mut run = motion(outcome);
        all.add("run", ending(&open, &run));
        run.end = run.start;
        all.add("from its start", ending(&free, &run));
    }
    let mut run = motion(Outcome::TimeUp);
    for from in [None, Some(0.125)] {
        run.stiff_from = from;
        for machine in [&open, &chosen, &hybrid] {
            let stiff = stiff(machine, &run).unwrap_or_default();
            all.add(
                format!("stiff from {from:?}"),
                format!("{}\n{stiff}", cost(machine, &run)),
            );
        }
    }
    all.pin("run-ends");
}

#[test]
fn json_files_hold_all_that_is_known() {
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
    let mut all = Gallery::default();
    let geared = machine(&[("step = \"2 ms\"", "tolerance = 1e-9")]);
    all.add_json(
        "settled",
        json(&geared, &run, &steady, Some("light")).into(),
    );
    let splined = machine(&[("step = \"2 ms\"", "coefficients = \"splines\"\nnodes = 12")]);
    for outcome in [
        Outcome::TimeUp,
        Outcome::Target,
        Outcome::Captured { mean: 3.0 },
        Outcome::Stalled { torque: 4.0 },
    ] {
        let run = Motion {
            stiff_from: Some(0.5),
            ..motion(outcome)
        };
        let found = json(&splined, &run, &NONE, None);
        let of = [
            "outcome",
            "steady_cycle",
            "flywheel",
            "warning",
            "nodes",
            "coefficients",
        ];
        all.add("not found", json!(of.map(|key| &found[key])).to_string());
    }
    let lost = Steady {
        cycle: Some(Err(stalled())),
        flywheel: Some(Err(refused())),
        wanted: 7.0,
    };
    let found = json(&splined, &motion(Outcome::TimeUp), &lost, None);
    all.add(
        "errors",
        json!([found["steady_cycle"], found["flywheel"]]).to_string(),
    );
    all.pin("run-facts");
}

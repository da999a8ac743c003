//! The effect on the motion of leaving out the exact dI_n/dφ: (1) and (2) integrated with the exact
//! coefficients, with splines, and with the paper's mixture of both.
//!
//! The paper names no motor. That of the example `sand-screen-run-up.toml` has synchronous speed 10
//! rad/s, rated torque 200 N·m, overload factor 2.2 and rated slip 0.05, at the crank.

use crate::machine::{
    Source,
    run_up::{Coefficients, Machine, Overrides},
};
use crate::papers::file::Measured;
use crate::solvers::run_up::{
    Cycle, Drive, Equation, Motion, Motor, Plan, Settings, run, steady_cycle,
};
use crate::solvers::units::Inertia;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Synchronous speed of the motor, rad/s.
const SYNCHRONOUS: f64 = 10.0;
/// An estimate of the inertia that the rotor of a small geared motor adds at the crank, kg·m².
const ROTOR: f64 = 1.4;
/// Far below every figure; the free turns come out to 1e-11.
const TOLERANCE: f64 = 1e-11;
/// Until when it runs up, and from when on it is steady, in seconds.
const RUNNING_UP: f64 = 0.7;
const STEADY: f64 = 2.0;
/// Moments of the run at which speeds are compared: worst errors are those found at them.
const MOMENTS: f64 = 30_000.0;
/// The exact coefficients, then splines and the mixture for the paper's number of nodes and for one
/// at each of its rows.
const WAYS: [(&str, Coefficients, usize); 5] = [
    ("exact", Coefficients::Exact, 12),
    ("s12", Coefficients::Splines, 12),
    ("s48", Coefficients::Splines, 48),
    ("h12", Coefficients::Hybrid, 12),
    ("h48", Coefficients::Hybrid, 48),
];

/// The motion under the motor, its steady cycle, and the free motion.
struct Motions {
    motion: Motion,
    cycle: Cycle,
    /// Factor of the speed in a free turn.
    free: f64,
    /// Worst difference of the speed during a free turn found with a consistent pair, as a
    /// fraction: there the speed goes as `I_n^(−1/2)`.
    within: f64,
}

const EXAMPLE: &str = include_str!("../../../examples/sand-screen-run-up.toml");

fn machine(text: &str, coefficients: Coefficients, nodes: usize) -> Option<Machine> {
    let overrides = Overrides {
        coefficients: Some(coefficients),
        nodes: Some(nodes),
        ..Overrides::default()
    };
    let mut machine = Machine::read(&Source::toml(text), overrides).ok()?;
    machine.plan.sampling = Some(machine.plan.duration / MOMENTS);
    machine.plan.settings = Settings {
        tolerance: TOLERANCE,
        ..Settings::default()
    };
    Some(machine)
}

fn motions((_, coefficients, nodes): (&str, Coefficients, usize)) -> Option<Motions> {
    let weightless = EXAMPLE.replace("9.81 m/s^2", "0 m/s^2");
    let weightless = machine(&weightless, coefficients, nodes)?;
    let machine = machine(EXAMPLE, coefficients, nodes)?;
    let (model, plan) = (machine.reduced().ok()?, &machine.plan);
    let equation = Equation::new(&*model, &machine.drive);
    let free = Plan {
        psi: SYNCHRONOUS,
        settled: Some(f64::MAX),
        settings: plan.settings,
        // The turn takes under ten seconds, however the speed falls with growing I_n.
        ..Plan::new(plan.phi, 60.0)
    };
    let (weightless, off) = (weightless.reduced().ok()?, Drive::direct(Motor::Off));
    let free = run(&Equation::new(&*weightless, &off), &free).ok()?;
    let within = |k: u32| {
        let phi = plan.phi + TAU * f64::from(k) / 3600.0;
        let [exact, own] = [&*machine.model, &*model].map(|m| m.coefficients(phi));
        Some(((exact.ok()?.inertia / own.ok()?.inertia).sqrt() - 1.0).abs())
    };
    let within: Vec<f64> = (0..3600).map(within).collect::<Option<_>>()?;
    Some(Motions {
        motion: run(&equation, plan).ok()?,
        cycle: steady_cycle(&equation, plan.phi, SYNCHRONOUS, plan.settings).ok()?,
        free: free.turns.first()?.psi / SYNCHRONOUS,
        within: within.into_iter().fold(0.0, f64::max),
    })
}

/// The time to 9.5 rad/s from rest with an inertia added at the crank, in seconds.
fn start_time(rotor: f64) -> Option<f64> {
    let machine = machine(EXAMPLE, Coefficients::Exact, 12)?;
    let rotor = Inertia::from_kg_m2(rotor);
    let drive = machine.drive.with_flywheel(rotor).ok()?;
    let plan = Plan {
        target: Some(9.5),
        sampling: None,
        ..machine.plan
    };
    let motion = run(&Equation::new(&*machine.model, &drive), &plan);
    motion.ok().map(|m| m.end.t)
}

/// Worst difference of the speeds of two motions between two times.
fn worst(own: &Motion, exact: &Motion, [from, to]: [f64; 2]) -> f64 {
    let pairs = own.samples.iter().zip(&exact.samples);
    let within = pairs.filter(|(a, _)| a.t >= from && a.t <= to);
    within.fold(0.0f64, |m, (a, b)| m.max((a.psi - b.psi).abs()))
}

/// Integrates all motions. A quantity that is undecided stays unknown.
pub(super) fn measure(measured: &mut Measured) {
    let all: Option<Vec<Motions>> = WAYS.par_iter().map(|way| motions(*way)).collect();
    let Some(all) = all else { return };
    for ((name, ..), own) in WAYS.iter().zip(&all) {
        let off = |stretch| worst(&own.motion, &all[0].motion, stretch);
        for (key, value) in [
            ("run_up", off([0.0, RUNNING_UP])),
            ("steady", off([STEADY, f64::MAX])),
            ("period", own.cycle.period),
            ("spread", own.cycle.fluctuation),
            ("mean", own.cycle.mean),
            ("least", own.cycle.least.0),
            ("most", own.cycle.most.0),
            ("work", own.cycle.work[0]),
            ("calls", own.motion.counts.evaluations as f64),
            ("free", own.free),
            ("within", own.within),
        ] {
            measured.set(format!("{name}_{key}"), value);
        }
    }
    measured.set("start", start_time(0.0).unwrap_or(f64::NAN));
    measured.set("start_rotor", start_time(ROTOR).unwrap_or(f64::NAN));
    measured.set("rotor", ROTOR);
    measured.set("moments", MOMENTS);
    measured.set("synchronous", SYNCHRONOUS);
}

/// Returns true if a quantity is measured of each motion alike.
#[cfg(test)]
pub(super) fn is_of_motion(name: &str) -> bool {
    WAYS.iter()
        .any(|way| name.starts_with(&format!("{}_", way.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::run_up::{Counts, Outcome, Sample};

    /// Speeds are compared up to 0.7 s and from 2 s on, ends included, and of either sign.
    #[test]
    fn speeds_are_compared_in_two_stretches() {
        let motion = |speeds: [f64; 6]| {
            let times = [0.0, 0.7, 0.71, 1.99, 2.0, 3.0].into_iter();
            let sample = |(t, psi)| Sample {
                t,
                psi,
                ..Sample::default()
            };
            Motion {
                start: Sample::default(),
                end: Sample::default(),
                samples: times.zip(speeds).map(sample).collect(),
                events: Vec::new(),
                turns: Vec::new(),
                outcome: Outcome::TimeUp,
                counts: Counts::default(),
                stiff_from: None,
            }
        };
        let exact = motion([1.0; 6]);
        let of = |speeds, stretch| worst(&motion(speeds), &exact, stretch);
        for (speeds, run_up, steady) in [
            ([1.0, 0.5, 9.0, 9.0, 1.0, 0.75], 0.5, 0.25),
            ([1.125, 1.0, 9.0, 9.0, 1.25, 1.0], 0.125, 0.25),
        ] {
            assert_eq!(of(speeds, [0.0, RUNNING_UP]), run_up);
            assert_eq!(of(speeds, [STEADY, f64::MAX]), steady);
        }
    }
}

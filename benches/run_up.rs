//! Measures an evaluation of the equation of motion under the three coefficient models, the time
//! that the exact dI_n/dphi adds to I_n and M_o, and whole runs.
//!
//! `cargo bench --bench run_up`. Items are evaluations, except in `runs`.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use mechaudit::solvers::class_iii::{ClassIii, State};
use mechaudit::solvers::reduction::Masses;
use mechaudit::solvers::run_up::{
    ClassIiiModel, Drive, Equation, Hybrid, Kloss, Method, Motor, Plan, ReducedModel, Settings,
    Splined, run,
};
use mechaudit::solvers::units::{Angle, AngularVelocity, Torque};
use mechaudit_cli::papers::zinchenko::data::solver_start;
use std::f64::consts::TAU;

fn main() {
    divan::main();
}

/// Crank angles of one turn.
const ANGLES: usize = 1000;

fn model() -> (ClassIiiModel, f64) {
    let (linkage, masses, start) = solver_start();
    (ClassIiiModel::new(linkage, masses, start), start.phi1)
}

fn motor() -> Drive {
    let w = AngularVelocity::from_rad_per_s(10.0);
    let motor = Kloss::rated(w, Torque::from_n_m(200.0), 2.2, 0.05).expect("a motor");
    Drive::direct(Motor::Kloss(motor))
}

fn states() -> (ClassIii, Masses, Vec<State>) {
    let (linkage, masses, start) = solver_start();
    let angles = (0..ANGLES).map(|k| Angle::from_rad(start.phi1 + TAU * k as f64 / ANGLES as f64));
    let states = linkage.sweep(&start, angles).expect("a crank that turns");
    (linkage, masses, states)
}

/// The parts of an evaluation, positions at hand.
mod parts {
    use super::*;

    /// Velocities: matrix, factors, one solution.
    #[divan::bench]
    fn a_velocities(bencher: Bencher) {
        let (linkage, _, states) = states();
        bencher.counter(ItemsCount::new(ANGLES)).bench(|| {
            let v = |s: &State| {
                linkage
                    .velocities(Angle::from_rad(s.phi1), s.positions)
                    .expect("regular")
                    .first[2]
            };
            black_box(&states).iter().map(v).sum::<f64>()
        });
    }

    /// Velocities, I_n and M_o: what the paper would leave.
    #[divan::bench]
    fn b_inertia_and_moment(bencher: Bencher) {
        let (linkage, masses, states) = states();
        bencher.counter(ItemsCount::new(ANGLES)).bench(|| {
            let f = |s: &State| {
                let v = linkage
                    .velocities(Angle::from_rad(s.phi1), s.positions)
                    .expect("regular");
                let (i, m) = masses.inertia_and_moment(&v);
                i + m
            };
            black_box(&states).iter().map(f).sum::<f64>()
        });
    }

    /// The same and the accelerations on the same factors.
    #[divan::bench]
    fn c_and_accelerations(bencher: Bencher) {
        let (linkage, masses, states) = states();
        bencher.counter(ItemsCount::new(ANGLES)).bench(|| {
            let f = |s: &State| {
                let v = linkage
                    .velocities(Angle::from_rad(s.phi1), s.positions)
                    .expect("regular");
                let (i, m) = masses.inertia_and_moment(&v);
                i + m + v.accelerations().expect("regular")[2]
            };
            black_box(&states).iter().map(f).sum::<f64>()
        });
    }

    /// I_n, dI_n/dphi, M_o and dM_o/dphi, with determinant, condition and pressure angle.
    #[divan::bench]
    fn d_everything(bencher: Bencher) {
        let (linkage, masses, states) = states();
        bencher.counter(ItemsCount::new(ANGLES)).bench(|| {
            let f = |s: &State| {
                let s = linkage
                    .state(Angle::from_rad(s.phi1), s.positions)
                    .expect("regular");
                let r = masses.reduce(&s);
                r.inertia_kg_m2 + r.moment_n_m + r.inertia_derivative_kg_m2
            };
            black_box(&states).iter().map(f).sum::<f64>()
        });
    }
}

/// Coefficients at 1000 angles in a row, positions followed.
mod coefficients {
    use super::*;

    fn turn(bencher: Bencher, model: &dyn ReducedModel, first: f64) {
        let mut turns = 0.0;
        bencher.counter(ItemsCount::new(ANGLES)).bench_local(|| {
            let from = first + TAU * turns;
            turns = (turns + 1.0) % 1000.0;
            (0..ANGLES)
                .map(|k| {
                    let phi = from + TAU * k as f64 / ANGLES as f64;
                    model.coefficients(phi).expect("regular").inertia_derivative
                })
                .sum::<f64>()
        });
    }

    #[divan::bench]
    fn exact(bencher: Bencher) {
        let (model, first) = model();
        turn(bencher, &model, first);
    }

    #[divan::bench]
    fn splines(bencher: Bencher) {
        let (model, first) = model();
        turn(
            bencher,
            &Splined::new(&model, first, 48).expect("splines"),
            first,
        );
    }

    #[divan::bench]
    fn hybrid(bencher: Bencher) {
        let (model, first) = model();
        turn(
            bencher,
            &Hybrid::new(model, first, 48).expect("splines"),
            first,
        );
    }
}

/// Three seconds of the run-up at a tolerance of 1e-12.
#[divan::bench(args = Method::ALL)]
fn runs(bencher: Bencher, method: &Method) {
    let (model, phi) = model();
    let drive = motor();
    let equation = Equation::new(&model, &drive);
    let plan = Plan {
        settings: Settings {
            tolerance: 1e-12,
            method: *method,
            ..Settings::default()
        },
        ..Plan::new(phi, 3.0)
    };
    bencher.bench_local(|| run(&equation, &plan).expect("a motion").end.psi);
}

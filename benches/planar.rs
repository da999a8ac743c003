//! Planar mechanisms of any structure beside the special solver of the class-III linkage, in one
//! run.
//!
//! `cargo bench --bench planar`. Items are values of the drive.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::solvers::planar::dynamics::Settings;
use mechaudit::solvers::planar::{Loads, State};
use mechaudit::solvers::units::Angle;
use mechaudit_cli::machine::planar::{self, Machine, Moving};
use mechaudit_cli::machine::{Linkage, Source};
use mechaudit_cli::papers::zinchenko::data::solver_start;
use std::f64::consts::TAU;

fn main() {
    divan::main();
}

fn machine(text: &str) -> (Machine, State) {
    let linkage = Linkage::read(&Source::toml(text)).expect("an example");
    let Linkage::Planar(machine) = linkage else {
        unreachable!("a planar mechanism")
    };
    let start = machine.start.at.expect("a start").to_radians();
    let branch = planar::choose(&machine, start, None).expect("a branch");
    (*machine, branch.start)
}

const SAND_SCREEN: &str = include_str!("../examples/sand-screen-bodies.toml");
const BUTTERFLY: &str = include_str!("../examples/double-butterfly.toml");
const STEPHENSON: &str = include_str!("../examples/stephenson-3.toml");

const DAMPED: &str = include_str!("../examples/motion/four-bar-damped.toml");

/// A damped four-bar at 10⁴ times over 5 s, at a tolerance of 1e-12.
#[divan::bench]
fn motion(bencher: Bencher) {
    let moving = Moving::read(&Source::toml(DAMPED)).expect("an example");
    let times: Vec<f64> = (0..=10_000).map(|k| 5e-4 * f64::from(k)).collect();
    let settings = Settings {
        accelerations: false,
        ..Settings::default()
    };
    bencher
        .counter(ItemsCount::new(times.len()))
        .bench_local(|| {
            let mut sum = 0.0;
            let end = moving.run(&times, settings, |m| sum += moving.dynamics.angle(m, 1)[0]);
            end.expect("a motion");
            sum
        });
}

/// Rows of the sand screen with I_n, dI_n and M_o over a turn: the special solver.
#[divan::bench(args = [48, 1000, 100_000])]
fn special_rows(bencher: Bencher, n: usize) {
    let (linkage, masses, start) = solver_start();
    let angle = |k: usize| Angle::from_rad(start.phi1 + TAU * k as f64 / n as f64);
    bencher.counter(ItemsCount::new(n)).bench(|| {
        let rows = linkage
            .rows(&masses, &start, (0..n).map(angle))
            .expect("a crank that turns");
        rows.iter().map(|r| r.reduced.inertia_kg_m2).sum::<f64>()
    });
}

fn reduced(machine: &Machine, loads: &Loads, start: &State, n: usize) -> f64 {
    let from = machine.solver.drive_of(start);
    let drives = (0..n).map(|k| from + TAU * k as f64 / n as f64);
    let mut sum = 0.0;
    let end = machine.solver.each(start, drives, |state| {
        sum += loads.reduce(&machine.solver, state).inertia;
    });
    end.expect("a crank that turns");
    sum
}

/// The same as bodies and joints.
#[divan::bench(args = [48, 1000, 100_000])]
fn general_rows(bencher: Bencher, n: usize) {
    let (machine, start) = machine(SAND_SCREEN);
    let loads = machine.loads_on(&start).expect("masses");
    bencher
        .counter(ItemsCount::new(n))
        .bench(|| reduced(&machine, &loads, &start, n));
}

/// Forces in the joints at one position.
#[divan::bench]
fn reactions(bencher: Bencher) {
    let (machine, start) = machine(SAND_SCREEN);
    let loads = machine.loads_on(&start).expect("masses");
    let one = || {
        loads
            .reactions(&machine.solver, divan::black_box(&start), 1.0, 0.0)
            .map(|r| r.drive)
    };
    bencher.counter(ItemsCount::new(1usize)).bench(one);
}

/// All assembly modes of the sand screen: the special solver.
#[divan::bench]
fn special_modes(bencher: Bencher) {
    let (linkage, _, start) = solver_start();
    bencher
        .counter(ItemsCount::new(1usize))
        .bench(|| linkage.assembly_modes(Angle::from_rad(divan::black_box(start.phi1))));
}

/// All assembly modes: a triad, and the eight-bar's group of six.
#[divan::bench(args = ["stephenson-3", "double-butterfly"])]
fn general_modes(bencher: Bencher, name: &str) {
    let text = if name == "stephenson-3" {
        STEPHENSON
    } else {
        BUTTERFLY
    };
    let (machine, start) = machine(text);
    let drive = machine.solver.drive_of(&start);
    bencher
        .counter(ItemsCount::new(1usize))
        .bench(|| machine.solver.assembly_modes(divan::black_box(drive)));
}

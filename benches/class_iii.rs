//! Class-III linkage: one crank angle in a sweep (positions on the branch, rates, reduced
//! quantities), all assembly modes, and certified rows.
//!
//! `cargo bench --bench class_iii`. Items are crank angles.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::solvers::class_iii::State;
use mechaudit::solvers::reduction::Row;
use mechaudit::solvers::units::Angle;
use mechaudit_cli::papers::zinchenko::data::{self, solver_start};
use std::f64::consts::TAU;

fn main() {
    divan::main();
}

fn angles(start: &State, n: usize) -> Vec<Angle> {
    (0..n)
        .map(|k| Angle::from_rad(start.phi1 + TAU * k as f64 / n as f64))
        .collect()
}

/// A full row at each of n crank angles over a turn, one core.
#[divan::bench(args = [48, 1000, 100_000])]
fn rows(bencher: Bencher, n: usize) {
    let (linkage, masses, start) = solver_start();
    let angles = angles(&start, n);
    bencher.counter(ItemsCount::new(n)).bench(|| -> Vec<Row> {
        linkage
            .rows(&masses, &start, angles.iter().copied())
            .expect("a crank that turns")
    });
}

/// The same on all cores.
#[divan::bench(args = [100_000])]
fn rows_parallel(bencher: Bencher, n: usize) {
    let (linkage, masses, start) = solver_start();
    let angles = angles(&start, n);
    bencher.counter(ItemsCount::new(n)).bench(|| {
        let states = linkage
            .sweep_parallel(&start, &angles)
            .expect("a crank that turns");
        masses.reduce_parallel(&states)
    });
}

/// All assembly modes at one crank angle.
#[divan::bench]
fn assembly_modes(bencher: Bencher) {
    let (linkage, _, start) = solver_start();
    bencher
        .counter(ItemsCount::new(1usize))
        .bench(|| linkage.assembly_modes(Angle::from_rad(divan::black_box(start.phi1))));
}

mod certified {
    use super::*;
    use rug::Rational;

    /// Certified rows over a turn, each followed with proof from the one before.
    #[divan::bench(args = [(48, 50), (1000, 50), (1000, 16), (100, 1000)])]
    fn rows(bencher: Bencher, (n, digits): (usize, u32)) {
        let bits = (f64::from(digits) * 3.33) as u32 + 48;
        let (linkage, start) = data::start(bits).expect("decided");
        let masses = data::recovered();
        let angle =
            |k: usize| data::row_angle(&Rational::from((48 * k as u32, n as u32))).to_ball(bits);
        bencher.counter(ItemsCount::new(n)).bench(|| {
            let mut here = start.clone();
            let mut at = angle(0);
            let mut worst = i64::MAX;
            for k in 1..=n {
                let next = angle(k);
                here = linkage.follow(&here, &at, &next).expect("decided");
                let kinematics = linkage.kinematics(&here).expect("decided");
                let reduced = linkage.reduce(&kinematics, &masses);
                worst = worst.min(reduced.inertia.accuracy_bits());
                at = next;
            }
            assert!(
                worst as f64 > f64::from(digits) * std::f64::consts::LOG2_10,
                "{worst} bits"
            );
            worst
        });
    }

    /// Every assembly mode with the proof that there are no others.
    #[divan::bench]
    fn assembly_modes(bencher: Bencher) {
        let (linkage, _) = data::start(192).expect("decided");
        let phi1 = data::row_angle(&Rational::new()).to_ball(192);
        bencher
            .counter(ItemsCount::new(1usize))
            .bench(|| linkage.modes(divan::black_box(&phi1)).expect("decided"));
    }
}

//! Natural cubic spline: fit at 10⁶ uniform knots, values at 10⁷ sorted points. Single-threaded
//! unless the name says parallel.
//!
//! Values go to a buffer in use already. Into a new `Vec` the 80 MB have to come from the system
//! first, which takes longer than the evaluation: `compare_scipy.py` measures both, and the loop
//! `out[i] = 2 x[i]` in both as a floor.

use divan::{Bencher, black_box};
use mechaudit::solvers::cubic_spline::{Boundary, CubicSpline, UniformCubicSpline};
use mechaudit::solvers::tridiagonal::Sweep;

const KNOTS: usize = 1_000_000;
const POINTS: usize = 10_000_000;

fn main() {
    divan::main();
}

fn ordinates() -> Vec<f64> {
    (0..KNOTS).map(|i| (i as f64 * 0.01).sin()).collect()
}

fn points() -> Vec<f64> {
    let step = (KNOTS - 1) as f64 / POINTS as f64;
    (0..POINTS).map(|i| i as f64 * step).collect()
}

fn uniform() -> UniformCubicSpline {
    UniformCubicSpline::fit(0.0, 1.0, ordinates(), Boundary::NATURAL).expect("a spline")
}

#[divan::bench(sample_count = 20)]
fn fit_uniform(bencher: Bencher) {
    bencher
        .with_inputs(ordinates)
        .bench_values(|y| UniformCubicSpline::fit(0.0, 1.0, y, Boundary::NATURAL));
}

#[divan::bench(sample_count = 20)]
fn fit_any_knots(bencher: Bencher) {
    let x: Vec<f64> = (0..KNOTS).map(|i| i as f64).collect();
    bencher
        .with_inputs(|| (x.clone(), ordinates()))
        .bench_values(|(x, y)| CubicSpline::fit(x, y, Boundary::NATURAL));
}

#[divan::bench(sample_count = 10)]
fn sweep_solve(bencher: Bencher) {
    let band = vec![1.0; KNOTS - 1];
    let a = Sweep::factor(&band, &vec![4.0; KNOTS], &band).expect("dominant");
    bencher
        .with_inputs(ordinates)
        .bench_values(|mut d| a.solve_in_place(&mut d).map(|()| d));
}

#[divan::bench(sample_count = 10)]
fn values_sorted(bencher: Bencher) {
    let (s, x) = (uniform(), points());
    let mut out = vec![0.0; POINTS];
    bencher.bench_local(|| s.values_sorted(black_box(&x), &mut out));
}

#[divan::bench(sample_count = 10)]
fn values_any_order(bencher: Bencher) {
    let (s, x) = (uniform(), points());
    let mut out = vec![0.0; POINTS];
    bencher.bench_local(|| s.values(black_box(&x), &mut out));
}

#[cfg(feature = "parallel")]
#[divan::bench(sample_count = 10)]
fn values_sorted_parallel(bencher: Bencher) {
    let (s, x) = (uniform(), points());
    let mut out = vec![0.0; POINTS];
    bencher.bench_local(|| s.par_values_sorted(black_box(&x), &mut out));
}

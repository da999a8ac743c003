//! "The largest error of S'_In against dI_n/dφ is 0.119": what that compares, and the true errors.

use super::data;
use super::recipe::exact_nodes;
use super::tables::{DIFFERENCE, INERTIA_SLOPE};
use crate::papers::file::{Measured, Quantity};
use crate::papers::number::Number;
use crate::reference::{Ball, Undecided};
use crate::solvers::cubic_spline::{Boundary, UniformCubicSpline};
use std::f64::consts::TAU;

/// Points of the fine grid in one turn: worst errors are those found on it.
const FINE: usize = 3840;
/// Numbers of nodes, each a divisor of the fine grid.
const NODES: [usize; 4] = [12, 24, 48, 96];

/// I_n, dI_n/dφ, M_o and dM_o/dφ on the fine grid.
type Fine = [Vec<f64>; 4];

fn fine() -> Fine {
    let (_, masses, _) = data::solver_start();
    let mut all = Fine::default();
    for state in data::states(FINE) {
        let r = masses.reduce(&state);
        let slopes = [r.inertia_derivative_kg_m2, r.moment_derivative_n_m];
        let row = [r.inertia_kg_m2, slopes[0], r.moment_n_m, slopes[1]];
        all.iter_mut()
            .zip(row)
            .for_each(|(column, x)| column.push(x));
    }
    all
}

/// The spline through `nodes` of the fine grid's values, and its derivative, on the grid.
fn splined(values: &[f64], nodes: usize) -> [Vec<f64>; 2] {
    let stride = FINE / nodes;
    let y = (0..=nodes).map(|j| values[j * stride % FINE]).collect();
    let spline = UniformCubicSpline::fit(0.0, TAU / nodes as f64, y, Boundary::Periodic)
        .expect("a periodic spline through finite values");
    let jet = |k: usize| {
        spline
            .jet(k as f64 * (TAU / FINE as f64))
            .expect("within the turn")
    };
    let (value, slope) = (0..FINE).map(jet).map(|j| (j.value, j.first)).unzip();
    [value, slope]
}

/// The largest difference at every `stride`-th point.
fn worst(a: &[f64], b: &[f64], stride: usize) -> f64 {
    let pairs = a.iter().zip(b).step_by(stride);
    pairs.fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

/// `∮ S'_In / I_n dφ` with the slope from a spline and the exact I_n: zero if the two belonged
/// together. In free motion the crank's speed is multiplied by `exp(−½ ∮)` each turn.
///
/// The trapezoidal rule on the fine grid, which holds the spline's knots. The integrand and its
/// derivative are continuous, so that the error has the powers 4, 6, … of the step, of which
/// Richardson's extrapolation takes two away.
fn hybrid_integral(slope: &[f64], inertia: &[f64]) -> f64 {
    let f: Vec<f64> = slope.iter().zip(inertia).map(|(s, i)| s / i).collect();
    let h = TAU / FINE as f64;
    let [a, b, c] = [1, 2, 4].map(|k| f.iter().step_by(k).sum::<f64>() * h * k as f64);
    let [fine, coarse] = [a + (a - b) / 15.0, b + (b - c) / 15.0];
    fine + (fine - coarse) / 63.0
}

/// The errors of the splines, against the exact quantities on the fine grid and certified at the
/// 48 rows, and the largest printed one.
pub(super) fn measure(
    printed: &[Vec<Number>],
    columns: &[Vec<Ball>],
    bits: u32,
    measured: &mut Measured,
) -> Result<(), Undecided> {
    let largest = printed[DIFFERENCE].iter().enumerate();
    let size = |number: &Number| number.value.value.clone().abs();
    let largest = largest
        .max_by_key(|(_, number)| size(number))
        .expect("rows");
    measured.set("printed_row", largest.0 as f64);
    measured.add("printed_worst", Quantity::Printed(largest.1.clone()));
    let [_, exact, _] = exact_nodes(&data::recovered(), 48, bits)?;
    let errors = exact.iter().zip(&columns[INERTIA_SLOPE]);
    let errors = errors.map(|(d, s)| (s - d).abs()).enumerate();
    let (row, error) = errors
        .max_by(|a, b| a.1.mid().total_cmp(b.1.mid()))
        .expect("rows");
    measured.set("true_row", row as f64);
    measured.add("true_worst", Quantity::Number(error));
    let fine @ [inertia, derivative, moment, moment_slope] = &fine();
    measured.set("grid", FINE as f64);
    for n in NODES {
        let [value, slope] = splined(inertia, n);
        measured.set(format!("nodes_{n}"), worst(&slope, derivative, FINE / n));
        measured.set(format!("slope_{n}"), worst(&slope, derivative, 1));
        measured.set(format!("loop_{n}"), hybrid_integral(&slope, inertia));
        measured.set(format!("inertia_{n}"), worst(&value, inertia, 1));
    }
    let [of_derivative, of_moment] = [&fine[1], &fine[2]].map(|y| splined(y, NODES[0]));
    measured.set("derivative_12", worst(&of_derivative[0], derivative, 1));
    measured.set("moment_12", worst(&of_moment[0], moment, 1));
    measured.set("moment_slope_12", worst(&of_moment[1], moment_slope, 1));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_fall_with_the_nodes() {
        let [inertia, derivative, ..] = fine();
        for (n, due, within) in [(12, 0.105, 2e-3), (24, 9.96e-3, 3e-4), (48, 1.21e-3, 1e-5)] {
            let found = worst(&splined(&inertia, n)[1], &derivative, 1);
            assert!((found - due).abs() < within, "{n}: {found}");
        }
        let at_nodes = worst(&splined(&inertia, 48)[1], &derivative, FINE / 48);
        assert!((at_nodes - 2.8e-4).abs() < 1e-5, "{at_nodes}");
    }

    #[test]
    fn the_hybrid_loses_speed() {
        let [inertia, ..] = fine();
        let of = |n| hybrid_integral(&splined(&inertia, n)[1], &inertia);
        assert!((of(12) - 0.255_133_026_431_421_6).abs() < 1e-12);
        assert!(((-0.5 * of(48)).exp() - 0.999_868_96).abs() < 1e-7);
    }

    #[test]
    fn the_worst_difference_is_of_either_sign() {
        assert_eq!(worst(&[1.0, 1.0, 2.0], &[0.5, 3.0, 1.5], 1), 2.0);
        assert_eq!(worst(&[1.0, 1.0, 2.0], &[0.5, 3.0, 1.75], 2), 0.5);
    }
}

//! The twelve nodes of M_o that the printed columns imply.
//!
//! They are slightly wrong, and no mass parameter can be the reason: the moment of weights on fixed
//! mass points is `−dU/dφ1`, so its mean over a turn is zero whatever the masses, centres, gravity
//! and angles. The mean of N equally spaced nodes then is the trapezoidal rule's error, which is
//! certified to be far below the printed digits. The printed nodes have a mean that rounding cannot
//! explain.

use super::design::{TURN, least_squares, read, spline_rows};
use super::recipe::NODES;
use super::tables::{MOMENT, ROWS};
use crate::papers::file::{Measured, Quantity};
use crate::papers::number::Number;
use crate::reference::Ball;
use nalgebra::{DMatrix, DVector};

/// Rounds of reweighting, after which the nodes have come to rest, and the least weight, which
/// keeps entries that happened to be hit exactly.
const ROUNDS: usize = 400;
const FLOOR: f64 = 1e-9;
/// Entries at most that may be left out.
const MOST_LEFT_OUT: usize = 8;

/// Fits the nodes to the columns M_o and S'_Mo and compares them with the exact ones; returns them
/// in N·m, rounded to 1e-6. Entries that least squares leaves off by more than one unit are left
/// out, worst first; then Lawson's reweighting turns the fit into the minimax one, because a
/// correctly rounded entry is off by at most half a unit and nothing more is known.
pub(super) fn fit(printed: &[Vec<Number>], exact: &[Ball], measured: &mut Measured) -> Vec<f64> {
    let designs = [false, true].map(|slope| spline_rows(NODES, 0, slope));
    let rows: Vec<[f64; 3]> = printed[MOMENT..MOMENT + 2]
        .iter()
        .flatten()
        .map(read)
        .collect();
    let n = rows.len();
    let a = DMatrix::from_fn(n, NODES, |i, j| designs[i / ROWS][(i % ROWS % TURN, j)]);
    let b = DVector::from_fn(n, |i, _| rows[i][0]);
    // A fit, and what it is off by in units of the last digit; zero without a weight.
    let fitted = |weights: &[f64]| {
        let sigma = DVector::from_fn(n, |i, _| rows[i][2] / weights[i].sqrt());
        let fit = least_squares(&a, &b, &sigma);
        let off = &a * &fit.x - &b;
        let units = |i: usize| {
            if weights[i] > 0.0 {
                (off[i] / rows[i][1]).abs()
            } else {
                0.0
            }
        };
        (fit, (0..n).map(units).collect::<Vec<f64>>())
    };
    let largest = |u: &[f64]| u.iter().copied().fold(0.0, f64::max);
    let mut weights = vec![1.0; n];
    let (first, mut units) = loop {
        let (fit, units) = fitted(&weights);
        let left_out = weights.iter().filter(|w| **w == 0.0).count();
        if largest(&units) <= 1.0 || left_out == MOST_LEFT_OUT {
            measured.set("left_out", left_out as f64);
            break (fit, units);
        }
        let worst = (0..n).max_by(|&i, &j| units[i].total_cmp(&units[j]));
        weights[worst.expect("rows")] = 0.0;
    };
    let mut best = (largest(&units), first.x.clone());
    for _ in 0..ROUNDS {
        let total: f64 = weights.iter().zip(&units).map(|(w, u)| w * u).sum();
        for (w, u) in weights.iter_mut().zip(&units).filter(|(w, _)| **w > 0.0) {
            *w = (*w * u * n as f64 / total).max(FLOOR);
        }
        let (fit, next) = fitted(&weights);
        units = next;
        if largest(&units) < best.0 {
            best = (largest(&units), fit.x);
        }
    }
    measured.set("worst_units", best.0);
    measured.set(
        "node_sd",
        largest(first.covariance.diagonal().map(f64::sqrt).as_slice()),
    );
    let nodes: Vec<f64> = best.1.iter().map(|x| (x * 1e6).round() / 1e6).collect();
    let off: Vec<f64> = nodes
        .iter()
        .zip(exact)
        .map(|(f, e)| f - e.to_f64())
        .collect();
    for (j, off) in off.iter().enumerate() {
        measured.set(format!("off_{j}"), 1e4 * off);
    }
    measured.set(
        "off_worst",
        off.iter().fold(0.0, |m: f64, x| m.max(x.abs())),
    );
    means(printed, exact, measured);
    nodes
}

/// The means of the exact and of the printed nodes, and the latter's deviation by rounding.
fn means(printed: &[Vec<Number>], exact: &[Ball], measured: &mut Measured) {
    let sum = exact
        .iter()
        .skip(1)
        .fold(exact[0].clone(), |sum, x| sum + x);
    let mean = &sum / &Ball::integer(sum.prec(), NODES as i64);
    measured.add("nodes_mean", Quantity::Number(mean));
    let nodes = printed[MOMENT]
        .iter()
        .take(TURN)
        .step_by(TURN / NODES)
        .map(read);
    let [total, variance] = nodes.fold([0.0; 2], |[a, b], [x, _, sd]| [a + x, b + sd * sd]);
    measured.set("printed_mean", total / NODES as f64);
    measured.set("mean_sd", variance.sqrt() / NODES as f64);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twelve entries of three decimals: their mean is known to a unit over 12.
    #[test]
    fn means_are_of_twelve_nodes() {
        let mut printed = super::super::tables::printed();
        for k in 0..NODES {
            printed[MOMENT][4 * k].value.value = rug::Rational::from((k * k) as u32);
        }
        let exact: Vec<Ball> = (1..=12).map(|k| Ball::integer(64, k)).collect();
        let mut measured = Measured::default();
        means(&printed, &exact, &mut measured);
        // (0 + 1 + 4 + … + 121)/12.
        for (name, due) in [
            ("nodes_mean", 6.5),
            ("printed_mean", 506.0 / 12.0),
            ("mean_sd", 1e-3 / 12.0),
        ] {
            let found = match &measured.quantities[name] {
                Quantity::Number(x) => x.to_f64(),
                Quantity::Exact(x) => x.to_f64(),
                other => panic!("{name}: {other:?}"),
            };
            assert!((found - due).abs() < 1e-12, "{name}");
        }
    }
}

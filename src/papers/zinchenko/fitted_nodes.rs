//! The twelve nodes of M_o that the printed columns imply.

use super::design::{Fit, TURN, least_squares, rounding_deviation, spline_rows};
use super::recipe::NODES;
use super::tables::{Column, Printed, column};
use nalgebra::{DMatrix, DVector};

/// Nodes of M_o fitted to its two printed columns.
#[derive(Clone, Debug)]
pub(super) struct FittedMoment {
    /// Node values in N·m, rounded to 1e-6.
    pub nodes: [f64; NODES],
    /// Standard deviations of the least-squares nodes from rounding alone.
    pub deviations: [f64; NODES],
    /// The largest deviation of the entries fitted, in units of the last digit.
    pub worst_units: f64,
    /// Entries left out because no nodes bring them within one unit, as (column, row).
    pub left_out: Vec<(Column, usize)>,
}

/// Rounds of reweighting, after which the nodes have come to rest, and the least weight, which
/// keeps entries that happened to be hit exactly.
const ROUNDS: usize = 400;
const FLOOR: f64 = 1e-9;

/// One printed entry as an equation for the nodes.
struct Equation {
    design: DVector<f64>,
    printed: f64,
    unit: f64,
    place: (Column, usize),
}

/// The equations of both columns, without those left out.
fn equations(printed: &[Printed], left_out: &[(Column, usize)]) -> Vec<Equation> {
    let value = spline_rows(NODES, 0, false);
    let slope = spline_rows(NODES, 0, true);
    let mut all = Vec::new();
    for (c, design) in [(Column::Moment, &value), (Column::MomentSlope, &slope)] {
        for e in column(printed, c) {
            if !left_out.contains(&(c, e.row)) {
                all.push(Equation {
                    design: design.row(e.row % TURN).transpose(),
                    printed: e.to_f64(),
                    unit: e.unit(),
                    place: (c, e.row),
                });
            }
        }
    }
    all
}

/// A weighted fit; residuals come in units of the last printed digit.
fn fit_weighted(rows: &[Equation], weights: &[f64]) -> (Fit, Vec<f64>) {
    let a = DMatrix::from_fn(rows.len(), NODES, |i, j| rows[i].design[j]);
    let b = DVector::from_fn(rows.len(), |i, _| rows[i].printed);
    let sigma = DVector::from_fn(rows.len(), |i, _| {
        rounding_deviation(rows[i].unit) / weights[i].sqrt()
    });
    let fit = least_squares(&a, &b, &sigma);
    let off = &a * &fit.x - &b;
    let units = (0..rows.len())
        .map(|i| (off[i] / rows[i].unit).abs())
        .collect();
    (fit, units)
}

/// Fits the nodes to the columns M_o and S'_Mo. Entries that least squares leaves off by more than
/// one unit are left out, worst first; then Lawson's reweighting turns the fit into the minimax
/// one, because a correctly rounded entry is off by at most half a unit and nothing more is known.
pub(super) fn fit(printed: &[Printed]) -> FittedMoment {
    let mut left_out: Vec<(Column, usize)> = Vec::new();
    loop {
        let rows = equations(printed, &left_out);
        let mut weights = vec![1.0; rows.len()];
        let (first, mut units) = fit_weighted(&rows, &weights);
        let worst = (0..rows.len()).max_by(|&i, &j| units[i].total_cmp(&units[j]));
        if let Some(i) = worst
            && units[i] > 1.0
            && left_out.len() < 8
        {
            left_out.push(rows[i].place);
            continue;
        }
        let largest = |u: &[f64]| u.iter().copied().fold(0.0, f64::max);
        let mut best = (largest(&units), first.x.clone());
        for _ in 0..ROUNDS {
            let total: f64 = weights.iter().zip(&units).map(|(w, u)| w * u).sum();
            for (w, u) in weights.iter_mut().zip(&units) {
                *w = (*w * u * rows.len() as f64 / total).max(FLOOR);
            }
            let (fit, next) = fit_weighted(&rows, &weights);
            units = next;
            if largest(&units) < best.0 {
                best = (largest(&units), fit.x);
            }
        }
        return FittedMoment {
            nodes: std::array::from_fn(|j| (best.1[j] * 1e6).round() / 1e6),
            deviations: std::array::from_fn(|j| first.covariance[(j, j)].sqrt()),
            worst_units: best.0,
            left_out,
        };
    }
}

//! The twelve nodes of M_o that the printed columns imply.

use super::design::{TURN, least_squares, rounding_deviation, spline_rows};
use super::recipe::NODES;
use super::tables::{Column, Printed, column};
use nalgebra::{DMatrix, DVector};

/// Nodes of M_o fitted to its two printed columns.
#[derive(Clone, Debug)]
pub(super) struct FittedMoment {
    /// Node values in N·m, rounded to 1e-6.
    pub nodes: [f64; NODES],
    /// Their standard deviations from rounding alone.
    pub deviations: [f64; NODES],
    /// Entries left out because no nodes bring them within one unit, as (column, row).
    pub left_out: Vec<(Column, usize)>,
}

/// One printed entry as an equation for the nodes.
struct Equation {
    design: DVector<f64>,
    printed: f64,
    unit: f64,
    place: (Column, usize),
}

/// Fits the nodes to the columns M_o and S'_Mo by weighted least squares; entries that stay off by
/// more than one unit are left out, worst first, and the fit is repeated.
pub(super) fn fit(printed: &[Printed]) -> FittedMoment {
    let value = spline_rows(NODES, 0, false);
    let slope = spline_rows(NODES, 0, true);
    let mut left_out: Vec<(Column, usize)> = Vec::new();
    loop {
        let mut rows: Vec<Equation> = Vec::new();
        for (c, design) in [(Column::Moment, &value), (Column::MomentSlope, &slope)] {
            for e in column(printed, c) {
                if !left_out.contains(&(c, e.row)) {
                    rows.push(Equation {
                        design: design.row(e.row % TURN).transpose(),
                        printed: e.to_f64(),
                        unit: e.unit(),
                        place: (c, e.row),
                    });
                }
            }
        }
        let a = DMatrix::from_fn(rows.len(), NODES, |i, j| rows[i].design[j]);
        let b = DVector::from_fn(rows.len(), |i, _| rows[i].printed);
        let sigma = DVector::from_fn(rows.len(), |i, _| rounding_deviation(rows[i].unit));
        let fit = least_squares(&a, &b, &sigma);
        let units = |i: usize| (fit.residuals[i] * sigma[i] / rows[i].unit).abs();
        let worst = (0..rows.len()).max_by(|&i, &j| units(i).total_cmp(&units(j)));
        match worst {
            Some(i) if units(i) > 1.0 && left_out.len() < 8 => left_out.push(rows[i].place),
            _ => {
                return FittedMoment {
                    nodes: std::array::from_fn(|j| (fit.x[j] * 1e6).round() / 1e6),
                    deviations: std::array::from_fn(|j| fit.covariance[(j, j)].sqrt()),
                    left_out,
                };
            }
        }
    }
}

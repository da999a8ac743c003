//! Least-squares designs: how the values of a periodic cubic spline at the table's rows depend on
//! its nodes.

use crate::papers::number::Number;
use crate::reference::nearest_f64;
use crate::solvers::cubic_spline::{Boundary, UniformCubicSpline};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;

/// Different rows of the tables in one turn.
pub(super) const TURN: usize = 48;

/// The value of a printed number, a unit of its last digit, and the standard deviation of rounding
/// to that unit.
pub(super) fn read(number: &Number) -> [f64; 3] {
    let [value, unit] = [&number.value.value, &number.value.unit()].map(nearest_f64);
    [value, unit, unit / 12f64.sqrt()]
}

/// The entries of a turn in some columns, and their standard deviations of rounding.
pub(super) fn observed(columns: &[Vec<Number>]) -> [DVector<f64>; 2] {
    let all = columns.iter().flat_map(|c| c[..TURN].iter().map(read));
    let all: Vec<[f64; 3]> = all.collect();
    [0, 2].map(|part| DVector::from_fn(all.len(), |i, _| all[i][part]))
}

/// The matrix that takes the values at `n` equally spaced nodes, the first of them at row
/// `offset`, to the spline (or its derivative, per radian) at the 48 rows.
pub(super) fn spline_rows(n: usize, offset: usize, slope: bool) -> DMatrix<f64> {
    let h = TAU / n as f64;
    let mut matrix = DMatrix::zeros(TURN, n);
    for node in 0..n {
        let mut y = vec![0.0; n + 1];
        y[node] = 1.0;
        y[n] = y[0];
        let spline = UniformCubicSpline::fit(0.0, h, y, Boundary::Periodic)
            .expect("a periodic spline through finite values");
        for row in 0..TURN {
            let x = ((row + TURN - offset) % TURN) as f64 * (TAU / TURN as f64);
            let jet = spline.jet(x).expect("a row within the turn");
            matrix[(row, node)] = if slope { jet.first } else { jet.value };
        }
    }
    matrix
}

/// A weighted linear least-squares fit.
pub(super) struct Fit {
    /// The parameters.
    pub x: DVector<f64>,
    /// Residuals divided by their standard deviations.
    pub residuals: DVector<f64>,
    /// Covariance of the parameters.
    pub covariance: DMatrix<f64>,
}

/// Solves `min ‖(A x − b)/σ‖` by the singular value decomposition. Directions with a singular value
/// below `1e-10` of the largest are left at zero and have infinite variance.
pub(super) fn least_squares(a: &DMatrix<f64>, b: &DVector<f64>, sigma: &DVector<f64>) -> Fit {
    let mut weighted = a.clone();
    let mut right = b.clone();
    for i in 0..a.nrows() {
        weighted.row_mut(i).scale_mut(1.0 / sigma[i]);
        right[i] /= sigma[i];
    }
    let svd = weighted.clone().svd(true, true);
    let (u, vt) = (svd.u.expect("requested"), svd.v_t.expect("requested"));
    let s = &svd.singular_values;
    let least = s.max() * 1e-10;
    let n = a.ncols();
    let mut x = DVector::zeros(n);
    let mut covariance = DMatrix::zeros(n, n);
    for k in 0..s.len() {
        let v = vt.row(k).transpose();
        if s[k] > least {
            x += &v * (u.column(k).dot(&right) / s[k]);
            covariance += &v * v.transpose() / (s[k] * s[k]);
        } else {
            // Only where the direction takes part.
            for i in 0..n {
                if v[i].abs() > 1e-6 {
                    covariance[(i, i)] = f64::INFINITY;
                }
            }
        }
    }
    Fit {
        residuals: &weighted * &x - right,
        x,
        covariance,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_design_interpolates() {
        let a = spline_rows(12, 0, false);
        for node in 0..12 {
            for row in (0..TURN).step_by(4) {
                let due = if row == 4 * node { 1.0 } else { 0.0 };
                assert!((a[(row, node)] - due).abs() < 1e-15);
            }
        }
        // A constant has no slope.
        let s = spline_rows(12, 3, true);
        assert!((&s * DVector::from_element(12, 1.0)).amax() < 1e-14);
    }

    #[test]
    fn a_line_is_fitted() {
        let a = DMatrix::from_fn(5, 2, |i, j| (i as f64).powi(j as i32));
        let b = DVector::from_fn(5, |i, _| 2.0 - 3.0 * i as f64);
        let fit = least_squares(&a, &b, &DVector::from_element(5, 0.1));
        assert!((fit.x[0] - 2.0).abs() < 1e-12 && (fit.x[1] + 3.0).abs() < 1e-12);
        assert!(fit.residuals.amax() < 1e-10);
        // Variance of the slope: σ²/Σ(i − 2)².
        assert!((fit.covariance[(1, 1)] - 0.01 / 10.0).abs() < 1e-12);
    }

    #[test]
    fn an_undetermined_direction_has_infinite_variance() {
        let a = DMatrix::from_fn(5, 2, |i, _| 1.0 + i as f64);
        let fit = least_squares(
            &a,
            &DVector::from_element(5, 1.0),
            &DVector::from_element(5, 1.0),
        );
        assert!(fit.covariance[(0, 0)].is_infinite());
    }

    /// A row counts by what it is off in deviations: the mean of 1 and 4 with the deviations 1 and
    /// 2 is (1 + 1)/(1 + 1/4), its variance 1/(1 + 1/4).
    #[test]
    fn rows_are_weighted_by_their_deviations() {
        let a = DMatrix::from_element(2, 1, 1.0);
        let b = DVector::from_column_slice(&[1.0, 4.0]);
        let fit = least_squares(&a, &b, &DVector::from_column_slice(&[1.0, 2.0]));
        assert!((fit.x[0] - 1.6).abs() < 1e-12 && (fit.covariance[(0, 0)] - 0.8).abs() < 1e-12);
        assert!((fit.residuals[0] - 0.6).abs() < 1e-12 && (fit.residuals[1] + 1.2).abs() < 1e-12);
    }

    /// Only parameters that take part in it.
    #[test]
    fn a_direction_that_is_not_seen_leaves_the_others() {
        let a = DMatrix::from_fn(5, 3, |i, j| match j {
            0 => i as f64,
            _ => 1.0,
        });
        let b = DVector::from_fn(5, |i, _| 3.0 * i as f64 + 2.0);
        let fit = least_squares(&a, &b, &DVector::from_element(5, 1.0));
        // Σ(i − 2)² = 10.
        assert!((fit.x[0] - 3.0).abs() < 1e-12 && (fit.covariance[(0, 0)] - 0.1).abs() < 1e-12);
        assert!((fit.x[1] - 1.0).abs() < 1e-12 && (fit.x[2] - 1.0).abs() < 1e-12);
        assert!(fit.covariance[(1, 1)].is_infinite() && fit.covariance[(2, 2)].is_infinite());
    }

    /// A node's spline one row on is that of a design one row on; slopes are its derivative.
    #[test]
    fn nodes_may_be_moved_by_rows() {
        let (here, moved) = (spline_rows(12, 0, false), spline_rows(12, 3, false));
        for row in 0..TURN {
            assert_eq!(moved.row((row + 3) % TURN), here.row(row));
        }
        let slope = spline_rows(12, 0, true);
        // A cosine through twelve nodes.
        let nodes = DVector::from_fn(12, |j, _| (TAU * j as f64 / 12.0).cos());
        for row in 0..TURN {
            let x = TAU * row as f64 / 48.0;
            assert!(((&here * &nodes)[row] - x.cos()).abs() < 1e-3, "{row}");
            assert!(((&slope * &nodes)[row] + x.sin()).abs() < 1e-2, "{row}");
        }
        let [value, unit, deviation] = read(&Number::read("-1.25"));
        assert_eq!((value, unit), (-1.25, 0.01));
        assert!((deviation - 1e-2 / 12f64.sqrt()).abs() < 1e-17);
    }
}

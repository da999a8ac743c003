//! The M_o nodes are slightly wrong, and no mass parameter can be the reason.
//!
//! The moment of weights on fixed mass points is `−dU/dφ1`, so its mean over a turn is zero
//! whatever the masses, centres, gravity and angles. The mean of N equally spaced nodes then is
//! the trapezoidal rule's error, which is certified here to be far below the printed digits. The
//! printed nodes have a mean that rounding cannot explain.

use super::design::rounding_deviation;
use super::fitted_nodes::FittedMoment;
use super::recipe::{NODES, Nodes};
use super::tables::{Column, Printed, column};
use crate::reference::Ball;

/// The two means and the node errors.
#[derive(Clone, Debug)]
pub(super) struct MomentResidual {
    /// Certified mean of the exact nodes, N·m.
    pub exact_mean: Ball,
    /// Mean of the printed node entries (rows 0, 4, …, 44), N·m.
    pub printed_mean: f64,
    /// Standard deviation of that mean by rounding, N·m.
    pub mean_deviation: f64,
    /// Fitted minus exact node values, N·m.
    pub errors: [f64; NODES],
}

pub(super) fn moment_residual(
    printed: &[Printed],
    exact: &Nodes,
    fitted: &FittedMoment,
) -> MomentResidual {
    let bits = exact.moment[0].prec();
    let sum = exact
        .moment
        .iter()
        .fold(Ball::integer(bits, 0), |s, m| s + m);
    let entries = column(printed, Column::Moment);
    let nodes: Vec<&&Printed> = entries.iter().take(48).step_by(4).collect();
    let n = NODES as f64;
    let variance: f64 = nodes
        .iter()
        .map(|e| rounding_deviation(e.unit()).powi(2))
        .sum();
    MomentResidual {
        exact_mean: &sum / &Ball::integer(bits, NODES as i64),
        printed_mean: nodes.iter().map(|e| e.to_f64()).sum::<f64>() / n,
        mean_deviation: variance.sqrt() / n,
        errors: std::array::from_fn(|j| fitted.nodes[j] - exact.moment[j].to_f64()),
    }
}

#[cfg(test)]
mod tests {
    use super::super::tables::printed;
    use super::*;

    /// Twelve entries of three decimals: their mean is known to a unit over 12.
    #[test]
    fn means_are_of_twelve_nodes() {
        let of = |k: usize| Ball::integer(64, k as i64);
        let exact = Nodes {
            inertia: Vec::new(),
            derivative: Vec::new(),
            moment: (1..=NODES).map(of).collect(),
        };
        let fitted = FittedMoment {
            nodes: std::array::from_fn(|j| 0.5 * j as f64),
            deviations: [0.0; NODES],
            worst_units: 0.0,
            left_out: Vec::new(),
        };
        let mut printed = printed();
        let nodes =
            |p: &&mut Printed| p.column == Column::Moment && p.row < 48 && p.row.is_multiple_of(4);
        for (k, p) in printed.iter_mut().filter(nodes).enumerate() {
            p.number.value.value = rug::Rational::from((k * k) as u32);
        }
        let found = moment_residual(&printed, &exact, &fitted);
        assert_eq!(found.exact_mean.to_f64(), 6.5);
        // (0 + 1 + 4 + … + 121)/12.
        assert!((found.printed_mean - 506.0 / 12.0).abs() < 1e-12);
        assert!(
            (found.mean_deviation - 1e-3 / 12.0).abs() < 1e-12,
            "{}",
            found.mean_deviation
        );
        for (j, e) in found.errors.iter().enumerate() {
            assert_eq!(*e, -0.5 * j as f64 - 1.0);
        }
    }
}

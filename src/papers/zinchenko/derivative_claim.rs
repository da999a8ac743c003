//! "The largest error of S'_In against dI_n/dφ is 0.119": what that compares, and the true errors.

use super::data::{self, MassParameters};
use super::recovery::node_states;
use crate::reference::Ball;
use crate::reference::Undecided;
use crate::solvers::cubic_spline::{Boundary, UniformCubicSpline};
use crate::solvers::reduction::Reduced;
use rug::Rational;
use std::f64::consts::TAU;

/// Points of the fine grid in one turn: worst errors are those found on it.
pub(super) const FINE: usize = 3840;

/// Errors of the splines through N exact nodes, against the exact quantities.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeErrors {
    pub nodes: usize,
    /// Worst |S'_In − dI_n/dφ| at the nodes.
    pub slope_at_nodes: f64,
    /// Worst |S'_In − dI_n/dφ| found on the fine grid.
    pub slope: f64,
    /// Worst |S_In − I_n| found on the fine grid.
    pub inertia: f64,
    /// Worst |S_dIn − dI_n/dφ|.
    pub derivative: f64,
    /// Worst |S_Mo − M_o|.
    pub moment: f64,
    /// Worst |S'_Mo − dM_o/dφ|.
    pub moment_slope: f64,
}

/// The exact quantities (f64) on the fine grid.
pub(super) struct Fine {
    rows: Vec<Reduced>,
}

/// A spline through every so many of the fine grid's values.
fn spline(values: &[f64], nodes: usize) -> UniformCubicSpline {
    let stride = values.len() / nodes;
    let y = (0..=nodes)
        .map(|j| values[j * stride % values.len()])
        .collect();
    UniformCubicSpline::fit(0.0, TAU / nodes as f64, y, Boundary::Periodic)
        .expect("a periodic spline through finite values")
}

fn worst(pairs: impl Iterator<Item = (f64, f64)>) -> f64 {
    pairs.fold(0.0, |m, (a, b)| m.max((a - b).abs()))
}

impl Fine {
    pub(super) fn new() -> Fine {
        let masses = MassParameters::new(data::RECOVERED).masses();
        Fine {
            rows: node_states(FINE).iter().map(|s| masses.reduce(s)).collect(),
        }
    }

    fn column(&self, f: fn(&Reduced) -> f64) -> Vec<f64> {
        self.rows.iter().map(f).collect()
    }

    /// The errors with `nodes` nodes (a divisor of the fine grid).
    pub(super) fn errors(&self, nodes: usize) -> NodeErrors {
        let inertia = self.column(|r| r.inertia_kg_m2);
        let derivative = self.column(|r| r.inertia_derivative_kg_m2);
        let moment = self.column(|r| r.moment_n_m);
        let moment_slope = self.column(|r| r.moment_derivative_n_m);
        let on_grid = |s: &UniformCubicSpline| {
            (0..FINE)
                .map(|k| {
                    s.jet(k as f64 * (TAU / FINE as f64))
                        .expect("within the turn")
                })
                .collect::<Vec<_>>()
        };
        let si = on_grid(&spline(&inertia, nodes));
        let sd = on_grid(&spline(&derivative, nodes));
        let sm = on_grid(&spline(&moment, nodes));
        let stride = FINE / nodes;
        let at = |k: usize| (si[k].first, derivative[k]);
        NodeErrors {
            nodes,
            slope_at_nodes: worst((0..FINE).step_by(stride).map(at)),
            slope: worst((0..FINE).map(at)),
            inertia: worst((0..FINE).map(|k| (si[k].value, inertia[k]))),
            derivative: worst((0..FINE).map(|k| (sd[k].value, derivative[k]))),
            moment: worst((0..FINE).map(|k| (sm[k].value, moment[k]))),
            moment_slope: worst((0..FINE).map(|k| (sm[k].first, moment_slope[k]))),
        }
    }

    /// `∮ S'_In / I_n dφ` with the slope from `nodes` nodes and the exact I_n: zero if the two
    /// belonged together. In free motion the crank's speed is multiplied by `exp(−½ ∮)` each turn.
    ///
    /// Romberg's extrapolation of the trapezoidal rule with steps 1, 2, 4, 8 and 16 of the fine
    /// grid; the spline's knots lie on all of them, so the Euler-Maclaurin expansion holds from
    /// knot to knot.
    pub(super) fn hybrid_integral(&self, nodes: usize) -> f64 {
        let inertia = self.column(|r| r.inertia_kg_m2);
        let s = spline(&inertia, nodes);
        let h = TAU / FINE as f64;
        let f: Vec<f64> = (0..FINE)
            .map(|k| s.jet(k as f64 * h).expect("within the turn").first / inertia[k])
            .collect();
        let trapezoid = |stride: usize| f.iter().step_by(stride).sum::<f64>() * h * stride as f64;
        let mut level: Vec<f64> = [1, 2, 4, 8, 16].map(trapezoid).to_vec();
        let mut power = 4.0;
        while level.len() > 1 {
            level = level
                .windows(2)
                .map(|w| w[0] + (w[0] - w[1]) / (power - 1.0))
                .collect();
            power *= 4.0;
        }
        level[0]
    }
}

/// The certified |S'_In − dI_n/dφ| at the 48 rows, from the exact values there.
pub(super) fn true_errors(slopes: &[Ball], bits: u32) -> Result<Vec<Ball>, Undecided> {
    let exact = super::recipe::exact_nodes(&data::masses(data::RECOVERED), 48, bits)?;
    Ok(exact
        .derivative
        .iter()
        .zip(slopes)
        .map(|(d, s)| (s - d).abs())
        .collect())
}

/// Crank angle of a row in degrees.
pub(super) fn degrees(row: usize) -> f64 {
    (data::decimal(data::START_DEG) + Rational::from(data::STEP_DEG) * row as u32).to_f64()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_fall_with_the_nodes() {
        let fine = Fine::new();
        let e: Vec<NodeErrors> = [12, 24, 48, 96].map(|n| fine.errors(n)).to_vec();
        assert!((e[0].slope - 0.105).abs() < 2e-3, "{:?}", e[0]);
        assert!((e[1].slope - 9.96e-3).abs() < 3e-4, "{:?}", e[1]);
        assert!((e[2].slope - 1.21e-3).abs() < 1e-5, "{:?}", e[2]);
        assert!((e[2].slope_at_nodes - 2.8e-4).abs() < 1e-5, "{:?}", e[2]);
    }

    #[test]
    fn the_hybrid_loses_speed() {
        let fine = Fine::new();
        let i = fine.hybrid_integral(12);
        assert!((i - 0.255_133_026_431_421_6).abs() < 1e-12, "{i}");
        assert!(((-0.5 * fine.hybrid_integral(48)).exp() - 0.999_868_96).abs() < 1e-7);
    }

    #[test]
    fn rows_are_seven_and_a_half_degrees_apart() {
        for (row, due) in [(0, 14.426), (2, 29.426), (48, 374.426)] {
            assert!((degrees(row) - due).abs() < 1e-12, "{row}");
        }
    }

    #[test]
    fn the_worst_difference_is_of_either_sign() {
        assert_eq!(worst([(1.0, 0.5), (1.0, 3.0), (2.0, 1.5)].into_iter()), 2.0);
        assert_eq!(worst([(1.0, 0.75)].into_iter()), 0.25);
    }
}

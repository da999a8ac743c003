//! Approximate coefficients: periodic cubic splines through N nodes of I_n and M_o.
//!
//! [`Splined`] takes I_n and dI_n/dφ from one spline, so that dI_n/dφ is the derivative of the
//! I_n in use and `½ I_n ψ²` changes by the work done and nothing else. [`Hybrid`] is what
//! Zinchenko (2008, conclusions) recommends: I_n and M_o exactly, by (4) and (7), and in the place
//! of dI_n/dφ by (5) the derivative S' of a spline through N values of I_n. S' is not the
//! derivative of that I_n, and in free motion (`M_d = M_o = 0`)
//!
//! ```text
//! dψ/dφ = −½ ψ S'/I_n,   so a turn multiplies ψ by exp(−½ ∮ S'/I_n dφ)
//! ```
//!
//! instead of by 1.

use super::model::{Coefficients, ModelError, ReducedModel, checked_angle};
use crate::cubic_spline::{Boundary, CubicSplineError, Extrapolation, Grid, UniformCubicSpline};
use std::f64::consts::TAU;

/// Nodes of the splines at most: each of them is the end of a step of every turn, so that more take
/// longer than a run with exact coefficients.
pub const MOST_NODES: usize = 100_000;

/// Why there are no splines.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SplinedError {
    /// Fewer than three nodes.
    #[error("{nodes} nodes over a turn, at least 3 are needed")]
    TooFewNodes {
        /// The number given.
        nodes: usize,
    },
    /// More than [`MOST_NODES`].
    #[error("{nodes:e} nodes over a turn, at most {MOST_NODES} are taken")]
    TooManyNodes {
        /// The number given.
        nodes: usize,
    },
    /// A node has no value, or the linkage is not back after one turn.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The values at the nodes have no spline.
    #[error(transparent)]
    Spline(#[from] CubicSplineError),
}

/// Periodic cubic splines of I_n and M_o.
#[derive(Clone, Debug)]
pub struct Splined {
    inertia: UniformCubicSpline,
    moment: UniformCubicSpline,
    first: f64,
    knots: Vec<f64>,
    dead: Vec<f64>,
}

impl Splined {
    /// Splines through the exact values at `nodes` equally spaced crank angles, the first of them
    /// `first` (radians).
    ///
    /// # Errors
    /// [`SplinedError`].
    pub fn new(
        model: &dyn ReducedModel,
        first: f64,
        nodes: usize,
    ) -> Result<Splined, SplinedError> {
        if nodes < 3 {
            return Err(SplinedError::TooFewNodes { nodes });
        }
        if nodes > MOST_NODES {
            return Err(SplinedError::TooManyNodes { nodes });
        }
        let step = TAU / nodes as f64;
        let values: Vec<Coefficients> = (0..=nodes)
            .map(|j| model.coefficients(first + step * j as f64))
            .collect::<Result<_, _>>()?;
        // A branch may need several turns to close.
        let (start, end) = (values[0], values[nodes]);
        let off = |a: f64, b: f64| (a - b).abs() > 1e-9 * (a.abs() + b.abs() + 1e-3);
        if off(start.inertia, end.inertia) || off(start.moment, end.moment) {
            return Err(ModelError::NotPeriodic.into());
        }
        let spline = |f: fn(&Coefficients) -> f64| {
            let mut y: Vec<f64> = values.iter().map(f).collect();
            y[nodes] = y[0];
            // From 0 to one turn, so that whole turns are taken off the offset from the first node.
            UniformCubicSpline::fit(0.0, step, y, Boundary::Periodic)
                .map(|s| s.with_extrapolation(Extrapolation::Wrap))
        };
        let inertia = spline(|c| c.inertia)?;
        let knots = (0..nodes).map(|j| first + inertia.grid().knot(j)).collect();
        Ok(Splined {
            inertia,
            moment: spline(|c| c.moment)?,
            first,
            knots,
            dead: model.dead_positions().to_vec(),
        })
    }

    /// The spline of I_n over the offset from the first node, in radians.
    pub fn inertia(&self) -> &UniformCubicSpline {
        &self.inertia
    }

    /// The spline of M_o over the offset from the first node, in radians.
    pub fn moment(&self) -> &UniformCubicSpline {
        &self.moment
    }
}

impl ReducedModel for Splined {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        let x = checked_angle(phi)? - self.first;
        let refused = |_| ModelError::Angle { phi };
        let i = self.inertia.jet(x).map_err(refused)?;
        Ok(Coefficients {
            inertia: i.value,
            inertia_derivative: i.first,
            moment: self.moment.value(x).map_err(refused)?,
        })
    }

    fn knots(&self) -> &[f64] {
        &self.knots
    }

    fn dead_positions(&self) -> &[f64] {
        &self.dead
    }
}

/// Exact I_n and M_o beside the derivative of a spline of I_n.
#[derive(Clone, Debug)]
pub struct Hybrid<M> {
    exact: M,
    spline: Splined,
}

impl<M: ReducedModel> Hybrid<M> {
    /// The spline's derivative from `nodes` nodes, the first at `first` (radians), in the place of
    /// the exact one.
    ///
    /// # Errors
    /// [`SplinedError`].
    pub fn new(exact: M, first: f64, nodes: usize) -> Result<Hybrid<M>, SplinedError> {
        let spline = Splined::new(&exact, first, nodes)?;
        Ok(Hybrid { exact, spline })
    }
}

impl<M: ReducedModel> ReducedModel for Hybrid<M> {
    fn coefficients(&self, phi: f64) -> Result<Coefficients, ModelError> {
        Ok(Coefficients {
            inertia_derivative: self.spline.coefficients(phi)?.inertia_derivative,
            ..self.exact.coefficients(phi)?
        })
    }

    fn knots(&self) -> &[f64] {
        self.spline.knots()
    }

    fn dead_positions(&self) -> &[f64] {
        self.exact.dead_positions()
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::tests::{START, sand_screen};
    use super::*;

    #[test]
    fn splines_pass_through_the_nodes_and_come_round() {
        let model = sand_screen();
        let splined = Splined::new(&model, START, 12).unwrap();
        for j in 0..12 {
            let phi = START + TAU * f64::from(j) / 12.0;
            let (a, b) = (
                splined.coefficients(phi).unwrap(),
                model.coefficients(phi).unwrap(),
            );
            assert!((a.inertia - b.inertia).abs() < 1e-12);
            assert!((a.moment - b.moment).abs() < 1e-11);
            let round = splined.coefficients(phi + 5.0 * TAU).unwrap();
            assert!((a.inertia - round.inertia).abs() < 1e-12);
            assert!((a.inertia_derivative - round.inertia_derivative).abs() < 1e-11);
        }
        // Row 2 of the paper's Table 2, first half: S' at 7.5 degrees after the first node.
        let row = splined.coefficients(START + 7.5f64.to_radians()).unwrap();
        assert!(
            (row.inertia - 0.153).abs() < 5e-4 && (row.inertia_derivative - 1.748).abs() < 6e-4
        );
        assert_eq!(splined.knots().len(), 12);
        let e = Splined::new(&model, START, 2).unwrap_err();
        assert_eq!(e, SplinedError::TooFewNodes { nodes: 2 });
        // Refused before any of them has a value.
        let nodes = 100_000_000_000_000;
        let e = Splined::new(&model, START, nodes).unwrap_err();
        assert_eq!(e, SplinedError::TooManyNodes { nodes });
    }
}

//! How the printed columns were made: periodic cubic splines through N nodes, read every 7.5°.

use super::data;
use super::tables::{Column, ROWS, Source};
use crate::reference::class_iii::Masses;
use crate::reference::cubic_spline::{PeriodicUniform, periodic_uniform};
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Nodes of the paper's splines.
pub(super) const NODES: usize = 12;

/// I_n, dI_n/dφ and M_o at equally spaced crank angles, from row 0 on.
#[derive(Clone, Debug)]
pub(super) struct Nodes {
    pub inertia: Vec<Ball>,
    pub derivative: Vec<Ball>,
    pub moment: Vec<Ball>,
}

/// The certified values at `n` nodes over the turn, followed along the paper's branch.
pub(super) fn exact_nodes(masses: &Masses, n: usize, bits: u32) -> Result<Nodes, Undecided> {
    let (linkage, start) = data::start(bits)?;
    let mut nodes = Nodes {
        inertia: Vec::new(),
        derivative: Vec::new(),
        moment: Vec::new(),
    };
    let angle = |j: usize| {
        let row = Rational::from((48 * j as u32, n as u32));
        data::row_angle(&row).to_ball(bits)
    };
    let mut here = start;
    for j in 0..n {
        if j > 0 {
            here = linkage
                .follow(&here, &angle(j - 1), &angle(j))
                .ok_or_else(|| Undecided {
                    bits,
                    reason: format!("the branch could not be followed to node {j}"),
                })?;
        }
        let k = linkage.kinematics(&here)?;
        let r = linkage.reduce(&k, masses);
        nodes.inertia.push(r.inertia);
        nodes.derivative.push(r.inertia_derivative);
        nodes.moment.push(r.moment);
    }
    Ok(nodes)
}

/// The splines through the nodes.
pub(super) struct Splines {
    nodes: usize,
    inertia: PeriodicUniform,
    derivative: PeriodicUniform,
    moment: PeriodicUniform,
}

impl Splines {
    pub(super) fn new(nodes: &Nodes) -> Splines {
        let n = nodes.inertia.len();
        let bits = nodes.inertia[0].prec();
        let h = &Ball::pi(bits).shift(1) / &Ball::integer(bits, n as i64);
        let spline = |y: &[Ball]| periodic_uniform(y, &h).expect("at least one node");
        Splines {
            nodes: n,
            inertia: spline(&nodes.inertia),
            derivative: spline(&nodes.derivative),
            moment: spline(&nodes.moment),
        }
    }

    /// The value that the recipe puts into a column at a row.
    pub(super) fn entry(&self, column: Column, row: usize) -> Ball {
        let at = Rational::from(((row % 48 * self.nodes) as u32, 48));
        let segment = at.clone().floor().to_f64() as usize;
        let k = at.fract_floor(Default::default()).0;
        let read = |s: &PeriodicUniform, slope: bool| {
            if slope {
                s.derivative(segment, &k)
            } else {
                s.value(segment, &k)
            }
        };
        match column.source() {
            Source::Inertia(slope) => read(&self.inertia, slope),
            Source::Derivative(slope) => read(&self.derivative, slope),
            Source::Moment(slope) => read(&self.moment, slope),
            Source::Difference => read(&self.derivative, false) - read(&self.inertia, true),
        }
    }

    /// Every column, in the order of [`Column::ALL`].
    pub(super) fn columns(&self) -> Vec<Vec<Ball>> {
        let column = |c: &Column| (0..ROWS).map(|row| self.entry(*c, row)).collect();
        Column::ALL.iter().map(column).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::cubic_spline::{Boundary, UniformCubicSpline};

    /// The solvers' spline through the same nodes gives the same columns.
    #[test]
    fn columns_are_read_off_the_splines_of_the_nodes() {
        let bits = 128;
        let values = [3, -1, 4, 1, -5, 9, 2, -6, 5, 3, -5, 8];
        let shifted = |by: usize| -> Vec<i64> { (0..12).map(|j| values[(j + by) % 12]).collect() };
        let balls = |by: usize| {
            shifted(by)
                .into_iter()
                .map(|x| Ball::integer(bits, x))
                .collect()
        };
        let splines = Splines::new(&Nodes {
            inertia: balls(0),
            derivative: balls(1),
            moment: balls(5),
        });
        let tau = std::f64::consts::TAU;
        let solver = |by: usize| {
            let mut y: Vec<f64> = shifted(by).into_iter().map(|x| x as f64).collect();
            y.push(y[0]);
            UniformCubicSpline::fit(0.0, tau / 12.0, y, Boundary::Periodic).unwrap()
        };
        let [inertia, derivative, moment] = [0, 1, 5].map(solver);
        let all = splines.columns();
        assert_eq!(all.len(), Column::ALL.len());
        for (c, column) in Column::ALL.iter().zip(&all) {
            assert_eq!(column.len(), ROWS);
            for (row, found) in column.iter().enumerate() {
                let jet = |s: &UniformCubicSpline| s.jet((row % 48) as f64 * tau / 48.0).unwrap();
                let due = match c {
                    Column::Inertia => jet(&inertia).value,
                    Column::InertiaSlope | Column::InertiaSlope3 => jet(&inertia).first,
                    Column::Derivative | Column::Derivative3 => jet(&derivative).value,
                    Column::DerivativeSlope => jet(&derivative).first,
                    Column::Moment => jet(&moment).value,
                    Column::MomentSlope => jet(&moment).first,
                    Column::Difference => jet(&derivative).value - jet(&inertia).first,
                };
                assert!((found.to_f64() - due).abs() < 1e-11, "{c:?} {row}");
            }
        }
    }

    #[test]
    fn exact_nodes_are_at_equal_angles() {
        let exact = exact_nodes(&data::masses(data::RECOVERED), NODES, 96).unwrap();
        let own = data::MassParameters::new(data::RECOVERED).masses();
        let states = super::super::recovery::node_states(NODES);
        assert_eq!(exact.inertia.len(), NODES);
        for (j, state) in states.iter().enumerate() {
            let due = own.reduce(state);
            for (found, due) in [
                (&exact.inertia[j], due.inertia_kg_m2),
                (&exact.derivative[j], due.inertia_derivative_kg_m2),
                (&exact.moment[j], due.moment_n_m),
            ] {
                assert!((found.to_f64() - due).abs() < 1e-8, "{j}: {found:?} {due}");
            }
        }
    }
}

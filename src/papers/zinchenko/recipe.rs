//! How the printed columns were made: periodic cubic splines through N nodes, read every 7.5°.

use super::data;
use super::tables::{COLUMNS, ROWS, source};
use crate::reference::class_iii::Masses;
use crate::reference::cubic_spline::periodic_uniform;
use crate::reference::{Ball, Undecided};
use rug::Rational;

/// Nodes of the paper's splines.
pub(super) const NODES: usize = 12;

/// I_n, dI_n/dφ and M_o at equally spaced crank angles, from row 0 on.
pub(super) type Nodes = [Vec<Ball>; 3];

/// The certified values at `n` nodes over the turn, followed along the paper's branch.
pub(super) fn exact_nodes(masses: &Masses, n: usize, bits: u32) -> Result<Nodes, Undecided> {
    let (linkage, start) = data::start(bits)?;
    let mut nodes = Nodes::default();
    let angle = |j: usize| data::row_angle(&Rational::from((48 * j, n))).to_ball(bits);
    let mut here = start;
    for j in 0..n {
        if j > 0 {
            let next = linkage.follow(&here, &angle(j - 1), &angle(j));
            let reason = "the branch could not be followed to the next node";
            here = next.ok_or_else(|| Undecided::new(bits, reason))?;
        }
        let r = linkage.reduce(&linkage.kinematics(&here)?, masses);
        let values = [r.inertia, r.inertia_derivative, r.moment];
        nodes
            .iter_mut()
            .zip(values)
            .for_each(|(all, x)| all.push(x));
    }
    Ok(nodes)
}

/// Every column that the recipe makes of the nodes.
pub(super) fn columns(nodes: &Nodes) -> Vec<Vec<Ball>> {
    let n = nodes[0].len();
    let bits = nodes[0][0].prec();
    let h = &Ball::pi(bits).shift(1) / &Ball::integer(bits, n as i64);
    let splines = nodes
        .each_ref()
        .map(|y| periodic_uniform(y, &h).expect("at least one node"));
    let entry = |c: usize, row: usize| {
        let at = row % 48 * n;
        let (segment, k) = (at / 48, Rational::from((at % 48, 48)));
        let read = |(quantity, slope): (usize, bool)| match slope {
            true => splines[quantity].derivative(segment, &k),
            false => splines[quantity].value(segment, &k),
        };
        // The last column is the difference of the two before it.
        source(c).map_or_else(|| read((1, false)) - read((0, true)), read)
    };
    let column = |c: usize| (0..ROWS).map(|row| entry(c, row)).collect();
    (0..COLUMNS.len()).map(column).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solvers::cubic_spline::{Boundary, UniformCubicSpline};

    /// The solvers' spline through the same nodes gives the same columns.
    #[test]
    fn columns_are_read_off_the_splines_of_the_nodes() {
        let values = [3, -1, 4, 1, -5, 9, 2, -6, 5, 3, -5, 8];
        let shifted = |by: usize| -> Vec<i64> { (0..12).map(|j| values[(j + by) % 12]).collect() };
        let balls = |by: usize| {
            shifted(by)
                .into_iter()
                .map(|x| Ball::integer(128, x))
                .collect()
        };
        let all = columns(&[0, 1, 5].map(balls));
        let tau = std::f64::consts::TAU;
        let [inertia, derivative, moment] = [0, 1, 5].map(|by| {
            let mut y: Vec<f64> = shifted(by).into_iter().map(|x| x as f64).collect();
            y.push(y[0]);
            UniformCubicSpline::fit(0.0, tau / 12.0, y, Boundary::Periodic).unwrap()
        });
        assert_eq!(all.len(), COLUMNS.len());
        for (c, column) in all.iter().enumerate() {
            assert_eq!(column.len(), ROWS);
            for (row, found) in column.iter().enumerate() {
                let jet = |s: &UniformCubicSpline| s.jet((row % 48) as f64 * tau / 48.0).unwrap();
                let due = match c {
                    0 => jet(&inertia).value,
                    1 | 7 => jet(&inertia).first,
                    2 | 6 => jet(&derivative).value,
                    3 => jet(&derivative).first,
                    4 => jet(&moment).value,
                    5 => jet(&moment).first,
                    _ => jet(&derivative).value - jet(&inertia).first,
                };
                assert!((found.to_f64() - due).abs() < 1e-11, "{c} {row}");
            }
        }
    }

    #[test]
    fn exact_nodes_are_at_equal_angles() {
        let exact = exact_nodes(&data::recovered(), NODES, 96).unwrap();
        let (_, masses, _) = data::solver_start();
        for (j, state) in data::states(NODES).iter().enumerate() {
            let due = masses.reduce(state);
            let due = [
                due.inertia_kg_m2,
                due.inertia_derivative_kg_m2,
                due.moment_n_m,
            ];
            for (found, due) in exact.iter().zip(due) {
                assert!(
                    (found[j].to_f64() - due).abs() < 1e-8,
                    "{j}: {found:?} {due}"
                );
            }
        }
    }
}

//! The sand screen over one turn of its crank.

use super::data::{MassParameters, PRINTED, RECOVERED, START_DEG};
use super::recovery::node_states;
use super::tables::{Column, Printed, column, printed};
use crate::motion::{Course, Motion, class_iii};
use crate::solvers::reduction::Reduced;

/// Positions of a turn: fifteen to each of the paper's rows.
const POSITIONS: usize = 720;
/// Rows of the paper's tables.
const ROWS: usize = 48;

/// The sand screen on the paper's assembly mode, with I_n, dI_n/dφ and M_o for the printed and for
/// the recovered centres of mass, and the printed columns at the paper's 48 crank angles.
pub fn motion() -> Motion {
    let states = node_states(POSITIONS);
    let table = printed();
    let start: f64 = START_DEG.parse().expect("a decimal in the source");
    let degrees = |k: usize, n: usize| start + 360.0 * k as f64 / n as f64;
    let reduced = [("recovered", RECOVERED), ("as printed", PRINTED)].map(|(name, centres)| {
        let masses = MassParameters::new(centres).masses();
        let rows: Vec<Reduced> = states.iter().map(|s| masses.reduce(s)).collect();
        (name, rows)
    });
    let course = |name: &str, unit: &str, of: fn(&Reduced) -> f64, printed_as: Column| Course {
        name: name.into(),
        unit: unit.into(),
        variants: reduced
            .iter()
            .map(|(v, rows)| (v.to_string(), rows.iter().map(of).collect()))
            .collect(),
        printed: nodes(&table, printed_as)
            .enumerate()
            .map(|(k, value)| (degrees(k, ROWS), value))
            .collect(),
    };
    let linkage = super::data::solver_linkage();
    let values = (0..POSITIONS).map(|k| degrees(k, POSITIONS)).collect();
    Motion {
        name: "Sand screen".into(),
        courses: vec![
            course("I_n", "kg·m²", |r| r.inertia_kg_m2, Column::Inertia),
            course(
                "dI_n/dφ",
                "kg·m²/rad",
                |r| r.inertia_derivative_kg_m2,
                Column::Derivative,
            ),
            course("M_o", "N·m", |r| r.moment_n_m, Column::Moment),
        ],
        ..class_iii(&linkage, &states, values)
    }
}

/// A printed column of one turn; the last row repeats the first.
fn nodes(table: &[Printed], of: Column) -> impl Iterator<Item = f64> {
    let entries = column(table, of).into_iter().take(ROWS);
    entries.map(|e| e.to_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_keep_their_lengths_and_printed_values_lie_on_the_curve() {
        let motion = motion();
        let at = |p: usize, k: usize| motion.points[p].at(k);
        for [a, b] in &motion.links {
            let length = |k: usize| {
                let (p, q) = (at(*a, k), at(*b, k));
                (p[0] - q[0]).hypot(p[1] - q[1])
            };
            for k in 0..POSITIONS {
                assert!((length(k) - length(0)).abs() < 1e-13, "{a}-{b} at {k}");
            }
        }
        // The paper's rows are values of splines through twelve nodes (see `recipe`), which stray
        // from the curve of the recovered centres by less than a hundredth of its size.
        for course in &motion.courses[..2] {
            let curve = &course.variants[0].1;
            let size = curve.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            let far = |(k, p): (usize, &(f64, f64))| (p.1 - curve[15 * k]).abs() / size;
            let far = course
                .printed
                .iter()
                .enumerate()
                .map(far)
                .fold(0.0, f64::max);
            assert!(far < 1e-2, "{}: {far}", course.name);
        }
    }
}

//! The sand screen over one turn of its crank.

use super::data::{self, START_DEG};
use super::recovery::Parameters;
use super::tables::{INERTIA, MOMENT, printed};
use crate::motion::{Course, Motion, class_iii};
use crate::solvers::reduction::Reduced;

/// Positions of a turn: fifteen to each of the paper's rows.
const POSITIONS: usize = 720;
/// Rows of the paper's tables.
const ROWS: usize = 48;

/// The sand screen on the paper's assembly mode, with I_n, dI_n/dφ and M_o for the printed and for
/// the recovered centres of mass, and the printed columns at the paper's 48 crank angles.
pub fn motion() -> Motion {
    let states = data::states(POSITIONS);
    let table = printed();
    let start: f64 = START_DEG.parse().expect("a decimal in the source");
    let degrees = |k: usize, n: usize| start + 360.0 * k as f64 / n as f64;
    let (linkage, recovered, _) = data::solver_start();
    let as_printed = Parameters::new(&data::printed()).masses();
    let reduced = [("recovered", recovered), ("as printed", as_printed)]
        .map(|(name, m)| (name, states.iter().map(|s| m.reduce(s)).collect::<Vec<_>>()));
    // The last row of a printed column repeats the first.
    let course = |name: &str, unit: &str, of: fn(&Reduced) -> f64, column: usize| Course {
        name: name.into(),
        unit: unit.into(),
        variants: reduced
            .iter()
            .map(|(v, rows)| (v.to_string(), rows.iter().map(of).collect()))
            .collect(),
        printed: (0..ROWS)
            .map(|k| (degrees(k, ROWS), table[column][k].value.value.to_f64()))
            .collect(),
    };
    let values = (0..POSITIONS).map(|k| degrees(k, POSITIONS)).collect();
    let derivative = |r: &Reduced| r.inertia_derivative_kg_m2;
    Motion {
        name: "Sand screen".into(),
        courses: vec![
            course("I_n", "kg·m²", |r| r.inertia_kg_m2, INERTIA),
            course("dI_n/dφ", "kg·m²/rad", derivative, INERTIA + 2),
            course("M_o", "N·m", |r| r.moment_n_m, MOMENT),
        ],
        ..class_iii(&linkage, &states, values)
    }
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

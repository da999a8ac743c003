//! A branch in motion.

use super::{Branch, Linkage, Reach, path};
use crate::motion::{Drive, Motion, Point};
use crate::solvers::class_iii::{ContinuationError, State};
use crate::solvers::units::Angle;
use std::f64::consts::TAU;

/// Positions of the branch over the turns after which it closes, from `shown` on; or over its whole range, with
/// `shown` among them. Also the number of `shown`.
///
/// # Errors
/// Why the branch could not be followed so far.
pub fn positions(
    linkage: &Linkage,
    branch: &Branch,
    n: u32,
    shown: &State,
) -> Result<(Vec<State>, usize), ContinuationError> {
    let Reach::Whole { turns } = branch.reach else {
        let mut all = path(linkage, branch, n)?;
        let k = all.partition_point(|s| s.phi1 < shown.phi1);
        if all.get(k).is_none_or(|s| s.phi1 != shown.phi1) {
            all.insert(k, *shown);
        }
        return Ok((all, k));
    };
    let whole = TAU * f64::from(turns.unwrap_or(1));
    let angle = |k| Angle::from_rad(shown.phi1 + whole * f64::from(k) / f64::from(n));
    let all = linkage.solver.sweep(shown, (0..n).map(angle));
    Ok((all.map_err(|(_, e)| e)?, 0))
}

/// The linkage at these positions, without quantities; `closed` if the first follows the last.
pub fn motion(linkage: &Linkage, states: &[State], start: usize, closed: bool) -> Motion {
    let g = linkage.solver.geometry();
    let pivots = [
        ("O1", [0.0; 2]),
        ("O3", [g.x3.m(), g.y3.m()]),
        ("O5", [g.x5.m(), g.y5.m()]),
    ];
    let mut points: Vec<Point> = pivots.map(|(label, at)| Point::fixed(label, at)).into();
    points.extend(
        ["A", "B", "C", "D"].iter().enumerate().map(|(i, label)| {
            Point::moving(*label, states.iter().map(|s| s.joints()[i]).collect())
        }),
    );
    Motion {
        name: linkage
            .name
            .clone()
            .unwrap_or_else(|| "class-III linkage".into()),
        drive: Drive {
            symbol: "φ1",
            unit: "°",
            values: states.iter().map(|s| s.phi1.to_degrees()).collect(),
        },
        closed,
        start,
        points,
        links: vec![[0, 3], [3, 4], [1, 5], [2, 6]],
        plates: vec![vec![4, 5, 6]],
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: Vec::new(),
    }
}

//! An assembly in motion.

use super::{Dyad, Position, Shape, range};
use crate::motion::{Drive, Motion, Point};

/// The crank angles in degrees over a turn from `shown` on, or over the range that holds the start with `shown`
/// among them where it lies in it. Also the number of `shown`, 0 where it lies outside, and whether it is a turn.
pub fn drives(dyad: &Dyad, n: u32, shown: f64) -> (Vec<f64>, usize, bool) {
    let ([from, to], whole) = range(dyad);
    if whole {
        let all = (0..n).map(|k| shown + 360.0 * f64::from(k) / f64::from(n));
        return (all.collect(), 0, true);
    }
    let at = |k| from + (to - from) * f64::from(k) / f64::from(n);
    let mut all: Vec<f64> = (0..=n).map(at).collect();
    let shown = from + (shown - from).rem_euclid(360.0);
    if shown > to {
        return (all, 0, false);
    }
    let k = all.partition_point(|d| *d < shown);
    if all.get(k).is_none_or(|d| *d != shown) {
        all.insert(k, shown);
    }
    (all, k, false)
}

/// The linkage at these positions, without quantities; `closed` if the first follows the last.
pub fn motion(dyad: &Dyad, positions: &[Position], start: usize, closed: bool) -> Motion {
    let joint = |i: usize| positions.iter().map(|p| p.joints_m[i]).collect();
    let mut motion = Motion {
        name: dyad
            .name
            .clone()
            .unwrap_or_else(|| dyad.shape.type_name().into()),
        drive: Drive {
            symbol: "φ1",
            unit: "°",
            values: positions.iter().map(|p| p.crank_deg).collect(),
        },
        closed,
        start,
        points: vec![
            Point::fixed("O1", [0.0; 2]),
            Point::moving("A", joint(0)),
            Point::moving("B", joint(1)),
        ],
        links: vec![[0, 1], [1, 2]],
        plates: Vec::new(),
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: Vec::new(),
    };
    match &dyad.shape {
        Shape::FourBar { solver, .. } => {
            let pivot = motion.add(Point::fixed("O3", [solver.frame().m(), 0.0]));
            motion.links.push([2, pivot]);
        }
        Shape::SliderCrank { solver, .. } => {
            let angle = solver.direction().rad();
            let places: Vec<([f64; 2], f64)> =
                positions.iter().map(|p| (p.joints_m[1], angle)).collect();
            motion.add_guide(&places);
            motion.add_block(&places);
        }
    }
    motion
}

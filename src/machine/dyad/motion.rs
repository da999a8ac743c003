//! An assembly in motion.

use super::{Dyad, Position, Shape, range};
use crate::machine::reach::insert_shown;
use crate::motion::{Drive, Motion, Point};

/// The crank angles in degrees over a turn from `shown` on, or over the range that holds the start
/// with `shown` among them where it lies in it. Also the number of `shown`, 0 where it lies
/// outside, and whether it is a turn.
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
    let k = insert_shown(&mut all, shown, |d| *d);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{Linkage, Source};

    fn four_bar(lengths: [u32; 4]) -> Dyad {
        let [a, b, c, d] = lengths;
        let text = format!(
            "type = \"four-bar\"\n[geometry]\ncrank = \"{a} m\"\ncoupler = \"{b} m\"\n\
             rocker = \"{c} m\"\nframe = \"{d} m\""
        );
        match Linkage::read(&Source::toml(text)).unwrap() {
            Linkage::Dyad(dyad) => *dyad,
            _ => unreachable!("a dyad"),
        }
    }

    #[test]
    fn a_rocker_swings_over_its_range_and_a_crank_turns() {
        let crank = four_bar([10, 40, 30, 35]);
        assert_eq!(
            drives(&crank, 4, 30.0),
            (vec![30.0, 120.0, 210.0, 300.0], 0, true)
        );
        // It comes no further than where coupler and rocker are in line.
        let rocker = four_bar([30, 30, 30, 35]);
        let limit = f64::acos((30f64.powi(2) + 35f64.powi(2) - 60f64.powi(2)) / 2100.0);
        let limit = limit.to_degrees();
        let (all, k, turns) = drives(&rocker, 4, 1.0);
        assert!(!turns && all.is_sorted_by(|a, b| a < b), "{all:?}");
        for (got, due) in all
            .iter()
            .zip([-limit, -0.5 * limit, 0.0, 1.0, 0.5 * limit, limit])
        {
            assert!((got - due).abs() < 1e-9, "{all:?}");
        }
        assert_eq!((all.len(), k, all[k]), (6, 3, 1.0));
        // One that is among them already, and one out of reach.
        let again = drives(&rocker, 4, all[0]);
        assert_eq!((again.0.len(), again.1), (5, 0));
        let (all, k, turns) = drives(&rocker, 4, 180.0);
        assert_eq!((all.len(), k, turns), (5, 0, false));
    }
}

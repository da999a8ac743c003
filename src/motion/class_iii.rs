//! The bodies of a linkage of class III in motion.

use super::{Drive, Motion, Point};
use crate::solvers::class_iii::{ClassIii, State};

/// The linkage at these positions, from the first on, without quantities; `degrees` are the crank
/// angles that are shown.
pub fn class_iii(solver: &ClassIii, states: &[State], degrees: Vec<f64>) -> Motion {
    let g = solver.geometry();
    let pivots = [
        ("O1", [0.0; 2]),
        ("O3", [g.x3.m(), g.y3.m()]),
        ("O5", [g.x5.m(), g.y5.m()]),
    ];
    let path = |i: usize| states.iter().map(|s| s.joints()[i]).collect();
    let joints = ["A", "B", "C", "D"].iter().enumerate();
    let fixed = pivots.map(|(label, at)| Point::fixed(label, at));
    let moving = joints.map(|(i, label)| Point::moving(*label, path(i)));
    Motion {
        name: "class-III linkage".into(),
        drive: Drive {
            symbol: "φ1",
            unit: "°",
            values: degrees,
        },
        closed: true,
        start: 0,
        points: fixed.into_iter().chain(moving).collect(),
        links: vec![[0, 3], [3, 4], [1, 5], [2, 6]],
        plates: vec![vec![4, 5, 6]],
        guides: Vec::new(),
        wheels: Vec::new(),
        courses: Vec::new(),
    }
}

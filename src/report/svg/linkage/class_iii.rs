//! A linkage of class III at several positions, with the paths of its joints.

use super::scene::{Bar, Joint, Pivot, Pose, Scene};
use crate::machine::class_iii::{Branch, Linkage};
use crate::solvers::class_iii::State;

/// The drawing as text; `path` is that of the branch.
pub fn class_iii(linkage: &Linkage, branch: &Branch, path: &[State]) -> String {
    let g = linkage.solver.geometry();
    let [o1, o3, o5] = [[0.0; 2], [g.x3.m(), g.y3.m()], [g.x5.m(), g.y5.m()]];
    let pivot = |label: &str, at, joint| Pivot {
        label: label.into(),
        at,
        joint: Some(joint),
    };
    let moving = ["B", "C", "D"].iter().enumerate();
    let moving = moving.map(|(k, label)| Joint::new(label, k));
    let joints: Vec<Joint> = [Joint::crank("A", "#8a8f98")]
        .into_iter()
        .chain(moving)
        .collect();
    let pose = |s: &State| {
        let [a, b, c, d] = s.joints();
        let bars = [
            ("1", [o1, a]),
            ("2", [a, b]),
            ("3", [o3, c]),
            ("5", [o5, d]),
        ];
        Pose {
            drive: s.phi1.to_degrees(),
            joints: vec![a, b, c, d],
            bars: bars.map(|(label, ends)| Bar { label, ends }).to_vec(),
            plates: vec![("4", vec![b, c, d])],
            blocks: Vec::new(),
        }
    };
    let scene = Scene {
        drive: ["at φ1 =", "°", "45°"],
        name: linkage.name.as_deref().unwrap_or("class-III linkage"),
        pivots: &[pivot("O1", o1, 0), pivot("O3", o3, 2), pivot("O5", o5, 3)],
        joints: &joints,
        guide: None,
        path: &path.iter().map(pose).collect::<Vec<_>>(),
        whole: branch.reach.is_whole(),
    };
    scene.draw()
}

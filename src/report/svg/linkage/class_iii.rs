//! A linkage of class III at several positions, with the paths of its joints.

use super::scene::{Bar, Joint, Pivot, Pose, Scene};
use crate::machine::class_iii::{Branch, Linkage, Reach};
use crate::solvers::class_iii::State;

/// The drawing as text; `path` is that of the branch.
pub fn class_iii(linkage: &Linkage, branch: &Branch, path: &[State]) -> String {
    let g = linkage.solver.geometry();
    let [o1, o3, o5] = [[0.0; 2], [g.x3.m(), g.y3.m()], [g.x5.m(), g.y5.m()]];
    let pivot = |label, at, joint| Pivot { label, at, joint };
    let joints = [
        ("A", "#8a8f98"),
        ("B", "#c2571a"),
        ("C", "#1f6fb2"),
        ("D", "#2f8f4e"),
    ];
    let pose = |s: &State| {
        let [a, b, c, d] = s.joints();
        let bars = [
            ("1", [o1, a]),
            ("2", [a, b]),
            ("3", [o3, c]),
            ("5", [o5, d]),
        ];
        Pose {
            crank_deg: s.phi1.to_degrees(),
            joints: vec![a, b, c, d],
            bars: bars.map(|(label, ends)| Bar { label, ends }).to_vec(),
            plate: Some(("4", [b, c, d])),
        }
    };
    let scene = Scene {
        name: linkage.name.as_deref().unwrap_or("class-III linkage"),
        pivots: &[pivot("O1", o1, 0), pivot("O3", o3, 2), pivot("O5", o5, 3)],
        joints: &joints.map(|(label, colour)| Joint { label, colour }),
        guide: None,
        path: &path.iter().map(pose).collect::<Vec<_>>(),
        whole: matches!(branch.reach, Reach::Whole { .. }),
    };
    scene.draw()
}

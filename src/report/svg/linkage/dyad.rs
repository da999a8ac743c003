//! A four-bar linkage or slider-crank at several positions, with the paths of its joints.

use super::SAMPLES;
use super::scene::{Bar, Joint, Pivot, Pose, Scene};
use crate::machine::dyad::{Dyad, Position, Shape, path};
use crate::solvers::dyad::Assembly;

/// The drawing as text.
pub fn dyad(dyad: &Dyad, assembly: Assembly) -> String {
    let (path, whole) = path(dyad, assembly, SAMPLES);
    let o1 = [0.0, 0.0];
    let (o3, guide) = match &dyad.shape {
        Shape::FourBar { solver, .. } => (Some([solver.frame().m(), 0.0]), None),
        Shape::SliderCrank { solver, .. } => (None, Some(solver.direction().rad())),
    };
    let pose = |p: &Position| {
        let [a, b] = p.joints_m;
        let links = [("1", [o1, a]), ("2", [a, b])];
        let links = links.into_iter().chain(o3.map(|o3| ("3", [b, o3])));
        Pose {
            drive: p.crank_deg,
            joints: vec![a, b],
            bars: links.map(|(label, ends)| Bar { label, ends }).collect(),
            plates: Vec::new(),
            blocks: Vec::new(),
        }
    };
    let pivot = |label: &str, at, joint| Pivot {
        label: label.into(),
        at,
        joint: Some(joint),
    };
    let pivots: Vec<Pivot> = [pivot("O1", o1, 0)]
        .into_iter()
        .chain(o3.map(|o3| pivot("O3", o3, 1)))
        .collect();
    let scene = Scene {
        drive: ["at φ1 =", "°", "45°"],
        name: dyad.name.as_deref().unwrap_or(dyad.shape.type_name()),
        pivots: &pivots,
        joints: &[Joint::crank("A", "#c2571a"), Joint::new("B", 1)],
        guide,
        path: &path.iter().map(pose).collect::<Vec<_>>(),
        whole,
    };
    scene.draw()
}

//! A four-bar linkage or slider-crank at several positions, with the paths of its joints.

use mechaudit::machine::dyad::{Dyad, Shape, Turn, turn};
use mechaudit::reference::nearest_f64;
use mechaudit::report::svg::scene::{Bar, Joint, Pivot, Point, Pose, Scene};
use mechaudit::solvers::dyad::Assembly;
use mechaudit::solvers::units::Angle;

/// Positions that the paths are drawn through.
const SAMPLES: u32 = 720;

/// The crank's end and the joint at the dyad's other end.
fn joints(shape: &Shape, phi: Angle, assembly: Assembly) -> Option<[Point; 2]> {
    let (sin, cos) = phi.rad().sin_cos();
    let (a, b) = match shape {
        Shape::FourBar { solver, .. } => {
            let m = solver.position(phi, assembly).ok()?;
            (solver.crank().m(), m.joint.position_m)
        }
        Shape::SliderCrank { solver, .. } => {
            let m = solver.position(phi, assembly).ok()?;
            let (e, (s, c)) = (solver.offset().m(), solver.direction().rad().sin_cos());
            let x = m.slider_m;
            (solver.crank().m(), [x * c - e * s, x * s + e * c])
        }
    };
    Some([[a * cos, a * sin], b])
}

/// The crank angles drawn: a turn, or the range that holds the start, or the first one.
fn range(dyad: &Dyad) -> ([f64; 2], bool) {
    let start = dyad.start.as_ref().map_or(0.0, nearest_f64);
    match turn(&dyad.shape) {
        Turn::Full { .. } => ([start, start + 360.0], true),
        Turn::Parts(parts) => {
            let holds = |p: &&[f64; 2]| (start - p[0]).rem_euclid(360.0) <= p[1] - p[0];
            let part = parts.iter().find(holds).or(parts.first());
            (part.copied().unwrap_or([start, start]), false)
        }
    }
}

/// The drawing as text.
pub fn draw(dyad: &Dyad, assembly: Assembly) -> String {
    let ([from, to], whole) = range(dyad);
    let o1 = [0.0, 0.0];
    let (o3, guide) = match &dyad.shape {
        Shape::FourBar { solver, .. } => (Some([solver.frame().m(), 0.0]), None),
        Shape::SliderCrank { solver, .. } => (None, Some(solver.direction().rad())),
    };
    let pose = |k: u32| {
        let crank_deg = from + (to - from) * f64::from(k) / f64::from(SAMPLES);
        let [a, b] = joints(&dyad.shape, Angle::from_deg(crank_deg), assembly)?;
        let links = [("1", [o1, a]), ("2", [a, b])];
        let links = links.into_iter().chain(o3.map(|o3| ("3", [b, o3])));
        Some(Pose {
            crank_deg,
            joints: vec![a, b],
            bars: links.map(|(label, ends)| Bar { label, ends }).collect(),
            plate: None,
        })
    };
    let pivot = |label, at, joint| Pivot { label, at, joint };
    let pivots: Vec<Pivot> = [pivot("O1", o1, 0)]
        .into_iter()
        .chain(o3.map(|o3| pivot("O3", o3, 1)))
        .collect();
    let scene = Scene {
        name: dyad.name.as_deref().unwrap_or(dyad.shape.type_name()),
        pivots: &pivots,
        joints: &[("A", "#c2571a"), ("B", "#1f6fb2")]
            .map(|(label, colour)| Joint { label, colour }),
        guide,
        path: &(0..=SAMPLES).filter_map(pose).collect::<Vec<_>>(),
        whole,
    };
    scene.draw()
}

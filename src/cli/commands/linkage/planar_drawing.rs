//! A mechanism at several positions, with the paths of its points.

use mechaudit::machine::planar::{Branch, MARGIN, Machine, Reach};
use mechaudit::report::svg::mechanism::{Pose, Scene, Shape};
use mechaudit::solvers::planar::State;
use std::f64::consts::TAU;

/// Positions that the paths are drawn through.
const SAMPLES: u32 = 720;

/// The drawing as text.
pub fn draw(machine: &Machine, branch: &Branch) -> String {
    let solver = &machine.solver;
    let from = machine.outer(solver.drive_of(&branch.start));
    let (low, high, whole) = match (branch.reach, machine.window) {
        (Reach::Whole { .. }, _) => (from, from + TAU, true),
        (Reach::Part { low, high }, window) => {
            let [a, b] = window.map_or([from; 2], |w| [w[0], w[1]]);
            let low = low.map_or(a, |e| e.drive + MARGIN);
            (low, high.map_or(b, |e| e.drive - MARGIN), false)
        }
    };
    let mut here = branch.start.clone();
    let mut poses = Vec::new();
    for k in 0..=SAMPLES {
        let drive = low + (high - low) * f64::from(k) / f64::from(SAMPLES);
        let (next, error) = solver.follow_as_far(&here, machine.inner(drive));
        here = next;
        if error.is_none() {
            poses.push(pose(machine, &here, drive));
        }
    }
    let names = machine.points.iter().map(|(n, _)| n.clone());
    let fixed = machine.outlines[0]
        .iter()
        .map(|(n, p)| (n.clone(), p.at.map(|x| x.m())));
    let scene = Scene {
        name: machine.name.as_deref().unwrap_or("mechanism"),
        unit: if machine.rotary() { "°" } else { " m" },
        fixed: &fixed.collect::<Vec<_>>(),
        points: &names.collect::<Vec<_>>(),
        poses: &poses,
        whole,
    };
    scene.draw()
}

fn pose(machine: &Machine, state: &State, drive: f64) -> Pose {
    let at = |p| machine.solver.point(state, p).r;
    let shapes = machine.outlines[1..].iter().map(|points| Shape {
        corners: points.iter().map(|(_, p)| at(p)).collect(),
    });
    Pose {
        drive: if machine.rotary() {
            drive.to_degrees()
        } else {
            drive
        },
        points: machine.points.iter().map(|(_, p)| at(p)).collect(),
        shapes: shapes.collect(),
    }
}

//! A mechanism at several positions, with the paths of its points.

use super::SAMPLES;
use crate::machine::planar::{Branch, Machine, Reach, path};
use crate::report::svg::mechanism::{Pose, Scene, Shape};
use crate::solvers::planar::State;

/// The drawing as text.
pub fn planar(machine: &Machine, branch: &Branch) -> String {
    let path = path(machine, branch, SAMPLES);
    let poses = path
        .iter()
        .map(|(drive, state)| pose(machine, state, *drive));
    let names = machine.points.iter().map(|(n, _)| n.clone());
    let fixed = machine.outlines[0]
        .iter()
        .map(|(n, p)| (n.clone(), p.at.map(|x| x.m())));
    let scene = Scene {
        name: machine.name.as_deref().unwrap_or("mechanism"),
        unit: if machine.rotary() { "°" } else { " m" },
        fixed: &fixed.collect::<Vec<_>>(),
        points: &names.collect::<Vec<_>>(),
        poses: &poses.collect::<Vec<_>>(),
        whole: matches!(branch.reach, Reach::Whole { .. }),
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

//! A mechanism of bodies and joints at several positions, with the paths of its points.

use super::SAMPLES;
use super::scene::{Bar, Joint, Pivot, Pose, Scene};
use crate::machine::planar::{Branch, Machine, path};
use crate::solvers::planar::State;

/// The drawing as text.
pub fn planar(machine: &Machine, branch: &Branch) -> String {
    let path = path(machine, branch, SAMPLES);
    let poses = path
        .iter()
        .map(|(drive, state)| pose(machine, state, *drive));
    let names = machine.points.iter().enumerate();
    let pivots = machine.outlines[0].iter().map(|(label, p)| Pivot {
        label: label.clone(),
        at: p.at.map(|x| x.m()),
        joint: None,
    });
    let unit = if machine.rotary() { "°" } else { " m" };
    let scene = Scene {
        name: machine.name.as_deref().unwrap_or("mechanism"),
        drive: ["drive at", unit, "eighth of a turn"],
        pivots: &pivots.collect::<Vec<_>>(),
        joints: &names
            .map(|(k, (n, _))| Joint::new(n, k))
            .collect::<Vec<_>>(),
        guide: None,
        path: &poses.collect::<Vec<_>>(),
        whole: branch.reach.is_whole(),
    };
    scene.draw()
}

fn pose(machine: &Machine, state: &State, drive: f64) -> Pose {
    let at = |p| machine.solver.point(state, p).r;
    let mut pose = Pose {
        drive: if machine.rotary() {
            drive.to_degrees()
        } else {
            drive
        },
        joints: machine.points.iter().map(|(_, p)| at(p)).collect(),
        bars: Vec::new(),
        plates: Vec::new(),
        blocks: Vec::new(),
    };
    for points in &machine.outlines[1..] {
        let corners: Vec<_> = points.iter().map(|(_, p)| at(p)).collect();
        match corners[..] {
            [] => {}
            [point] => pose.blocks.push(point),
            [a, b] => pose.bars.push(Bar {
                label: "",
                ends: [a, b],
            }),
            _ => pose.plates.push(("", corners)),
        }
    }
    pose
}

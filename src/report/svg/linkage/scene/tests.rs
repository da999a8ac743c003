//! Tests of `scene`.

use super::super::super::style::tests::whole;
use super::*;
use crate::report::gallery::Gallery;

const CRANK: [&str; 3] = ["at φ1 =", "°", "45°"];

/// A slider-crank of unit lengths over a turn, drawn.
pub fn drawn(name: &str, whole: bool) -> String {
    let pose = |k: u32| {
        let (sin, cos) = (f64::from(k) * 45.0).to_radians().sin_cos();
        let (a, b) = ([cos, sin], [2.0 * cos, 0.0]);
        Pose {
            drive: f64::from(k) * 45.0,
            joints: vec![a, b],
            bars: vec![Bar {
                label: "1",
                ends: [a, b],
            }],
            plates: vec![("4", vec![a, b, [0.0, 0.0]])],
            blocks: Vec::new(),
        }
    };
    let scene = Scene {
        name,
        drive: CRANK,
        pivots: &[Pivot {
            label: "O1".into(),
            at: [0.0, 0.0],
            joint: Some(0),
        }],
        joints: &[Joint::crank("A", "#c2571a"), Joint::new("B", 1)],
        guide: Some(0.0),
        path: &(0..=8).map(pose).collect::<Vec<_>>(),
        whole,
    };
    scene.draw()
}

/// However fine the path is.
#[test]
fn positions_are_chosen_by_eighths() {
    let chosen = |n: u32, whole| {
        let pose = |k: u32| Pose {
            drive: f64::from(k),
            joints: Vec::new(),
            bars: Vec::new(),
            plates: Vec::new(),
            blocks: Vec::new(),
        };
        let path: Vec<Pose> = (0..n).map(pose).collect();
        let scene = Scene {
            name: "",
            drive: CRANK,
            pivots: &[],
            joints: &[],
            guide: None,
            path: &path,
            whole,
        };
        let all = scene.chosen();
        all.iter().map(|p| p.drive as u32).collect::<Vec<_>>()
    };
    assert_eq!(chosen(17, true), [0, 2, 4, 6, 8, 10, 12, 14]);
    assert_eq!(chosen(17, false), [8, 0, 4, 12, 16]);
    assert_eq!(chosen(8, true), [0, 0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(chosen(3, false), [0, 1, 2]);
    assert!(chosen(0, true).is_empty());
}

/// A crank from (0, 0) to (k, −1), a bar from there to (4.6 + 2 k, −3), and a plate, of which a
/// metre is 100 pixels.
fn scaled(guide: Option<f64>, up: f64) -> String {
    let pose = |k: u32| {
        let k = f64::from(k);
        let (a, b) = ([k, -up], [4.6 + 2.0 * k, -3.0]);
        let bar = |label, ends| Bar { label, ends };
        Pose {
            drive: 10.0 * k,
            joints: vec![a, b],
            bars: vec![bar("1", [[0.0, 0.0], a]), bar("2", [a, b])],
            plates: vec![("4", vec![[0.0, 0.0], [3.0, 0.0], [0.0, -3.0]])],
            blocks: Vec::new(),
        }
    };
    let scene = Scene {
        name: "a scene",
        drive: CRANK,
        pivots: &[Pivot {
            label: "O1".into(),
            at: [0.0, 0.0],
            joint: Some(0),
        }],
        joints: &[Joint::crank("A", "#c2571a"), Joint::new("B", 1)],
        guide,
        path: &(0..3).map(pose).collect::<Vec<_>>(),
        whole: false,
    };
    scene.draw()
}

/// Two bodies of points: one of one point, one of four with an inner corner.
fn of_bodies() -> String {
    let names = ["A", "B", "C", "D", "E", "F"];
    let pose = |k: u32| Pose {
        drive: f64::from(k),
        joints: (0..6).map(|n| [f64::from(k), f64::from(n)]).collect(),
        bars: vec![Bar {
            label: "",
            ends: [[0.0, 0.0], [f64::from(k), 1.0]],
        }],
        plates: vec![("", vec![[0.0, 0.0], [3.0, 0.0], [0.5, 0.5], [0.0, 3.0]])],
        blocks: vec![[f64::from(k), 2.0]],
    };
    let joints = names.iter().enumerate().map(|(k, n)| Joint::new(n, k));
    let pivot = |label: &str, at| Pivot {
        label: label.into(),
        at,
        joint: None,
    };
    let scene = Scene {
        name: "crank & more",
        drive: ["drive at", " m", "eighth of a turn"],
        pivots: &[pivot("O", [0.0, 0.0]), pivot("P", [8.6, 5.0])],
        joints: &joints.collect::<Vec<_>>(),
        guide: None,
        path: &[pose(0), pose(1)],
        whole: false,
    };
    scene.draw()
}

/// A turn with its start and a range with its middle before faint positions; links that stand on
/// their pivot and that hang; a slider on guides of both slopes; numbers beside bars.
#[test]
fn scenes() {
    let mut all = Gallery::default();
    for svg in [
        drawn("crank & slider", true),
        drawn("part", false),
        of_bodies(),
    ] {
        whole(&svg);
        all.add(
            svg.split("</title>")
                .next()
                .unwrap()
                .split("<title>")
                .nth(1)
                .unwrap(),
            &svg,
        );
    }
    for (degrees, up) in [
        (None, 1.0),
        (None, 0.0),
        (Some(30.0), 1.0),
        (Some(150.0), 1.0),
    ] {
        let guide = degrees.map(f64::to_radians);
        all.add(format!("guide {degrees:?}, {up} m up"), scaled(guide, up));
    }
    let view = View::new([[0.0, 0.0], [8.6, 8.6]].into_iter());
    for ends in [
        [[0.0, 0.0], [4.0, 3.0]],
        [[4.0, 3.0], [0.0, 0.0]],
        [[0.0, 3.0], [4.0, 0.0]],
        [[0.0, 0.0], [2.0, 0.0]],
        [[0.0, 0.0], [0.0, 2.0]],
        [[0.0, 0.0], [0.0, 0.0]],
    ] {
        let svg = number(&view, &Bar { label: "1", ends });
        all.add(format!("bar {ends:?}"), svg.into_string());
    }
    all.pin("scenes");
}

//! Tests of `mechanism`.

use super::super::panel::tests::{attributes, texts};
use super::super::style::tests::whole;
use super::*;

#[test]
fn a_scene_is_drawn_with_every_text_escaped() {
    let pose = |k: u32| {
        let (sin, cos) = (f64::from(k) * 45.0).to_radians().sin_cos();
        Pose {
            drive: f64::from(k) * 45.0,
            points: vec![[cos, sin]],
            shapes: vec![
                Shape {
                    corners: vec![[0.0, 0.0], [cos, sin]],
                },
                Shape {
                    corners: vec![[0.0, 0.0], [cos, sin], [1.0, 1.0], [0.5, 0.6]],
                },
                Shape {
                    corners: vec![[cos, sin]],
                },
            ],
        }
    };
    let scene = Scene {
        name: "crank & more",
        unit: "°",
        fixed: &[("O".into(), [0.0, 0.0])],
        points: &["A".into()],
        poses: &(0..=8).map(pose).collect::<Vec<_>>(),
        whole: true,
    };
    let text = scene.draw();
    whole(&text);
    for part in [
        "<title>crank &amp; more</title>",
        "drive at 0.000°, every eighth",
        "paths of A<",
    ] {
        assert!(text.contains(part), "{part} is missing in {text}");
    }
    assert_eq!(text.matches("opacity=\"0.16\"").count(), 7);
}

/// A moving point for each name, from (0, 0) on; a metre is 100 pixels.
fn scaled(names: &[&str], poses: u32, whole: bool) -> String {
    let pose = |k: u32| {
        let at = |x: f64, y: f64| [x, y];
        let k = f64::from(k);
        Pose {
            drive: 10.0 * k,
            points: (0..names.len()).map(|n| at(k, n as f64)).collect(),
            shapes: vec![
                Shape {
                    corners: vec![at(0.0, 0.0), at(k, 1.0)],
                },
                // The inner corner is not of the outline.
                Shape {
                    corners: vec![at(0.0, 0.0), at(3.0, 0.0), at(0.5, 0.5), at(0.0, 3.0)],
                },
                Shape {
                    corners: vec![at(k, 2.0)],
                },
                Shape { corners: vec![] },
            ],
        }
    };
    let names: Vec<String> = names.iter().map(|n| n.to_string()).collect();
    let scene = Scene {
        name: "a scene",
        unit: " m",
        fixed: &[("O".into(), [0.0, 0.0]), ("P".into(), [8.6, 5.0])],
        points: &names,
        poses: &(0..poses).map(pose).collect::<Vec<_>>(),
        whole,
    };
    scene.draw()
}

#[test]
fn every_part_stands_where_it_is() {
    let svg = scaled(&["A", "B"], 2, false);
    // From (70, 626).
    assert!(svg.contains("viewBox=\"0 0 1000 696\""), "{svg}");
    let (x, y) = (attributes(&svg, "text", "x"), attributes(&svg, "text", "y"));
    let labels: Vec<((&str, &str), &str)> = texts(&svg).into_iter().zip(x).zip(y).collect();
    assert_eq!(
        labels[2..],
        [
            (("O", "88.0"), "644.0"),
            (("P", "948.0"), "144.0"),
            (("A", "79.0"), "617.0"),
            (("B", "79.0"), "517.0"),
        ]
    );
    assert!(svg.contains("drive at 0.000 m, from 0.00 m to 10.00 m faint; paths of A, B<"));
    assert_eq!(
        attributes(&svg, "polyline", "points"),
        [
            "70.00,626.00 170.00,526.00",
            "70.00,626.00 170.00,626.00",
            "70.00,526.00 170.00,526.00",
            "70.00,626.00 70.00,526.00",
        ]
    );
    let corners = attributes(&svg, "polygon", "points");
    assert_eq!(corners, ["70.00,626.00 370.00,626.00 70.00,326.00"; 2]);
    let blocks = attributes(&svg, "rect", "x")
        .into_iter()
        .zip(attributes(&svg, "rect", "y"));
    let blocks: Vec<_> = blocks.collect();
    assert_eq!(blocks, [("156.0", "417.0"), ("56.0", "417.0")]);
    let circles = attributes(&svg, "circle", "cx")
        .into_iter()
        .zip(attributes(&svg, "circle", "cy"));
    assert_eq!(
        circles.collect::<Vec<_>>(),
        [
            ("70.0", "626.0"),
            ("930.0", "126.0"),
            ("70.0", "626.0"),
            ("70.0", "526.0")
        ]
    );
    let ground = attributes(&svg, "path", "d");
    let (hatches, ground): (Vec<&str>, Vec<&str>) = ground
        .iter()
        .map(|d| &**d)
        .partition(|d| d.ends_with("l-7 8"));
    let due = [
        "M70.0 626.0l-13 22h26z",
        "M48.0 648.0h44",
        "M930.0 126.0l-13 22h26z",
        "M908.0 148.0h44",
    ];
    assert_eq!(ground, due);
    assert_eq!(hatches.len(), 2 * 6);
    assert_eq!(
        (hatches[0], hatches[11]),
        ("M52.0 648.0l-7 8", "M952.0 148.0l-7 8")
    );
    let groups: Vec<_> = svg
        .lines()
        .filter(|l| l.contains("opacity=") && l.starts_with("<g "))
        .collect();
    let seen = |l: &str| {
        (
            l.contains("opacity=\"0.16\""),
            l.contains("stroke-width=\"4\""),
        )
    };
    let seen: Vec<_> = groups.into_iter().map(seen).collect();
    assert_eq!(seen, [(true, false), (false, true)]);
}

#[test]
fn the_sixth_path_has_the_colour_of_the_first() {
    let svg = scaled(&["A", "B", "C", "D", "E", "F"], 2, true);
    let paths: Vec<&str> = svg
        .lines()
        .filter(|l| l.contains("stroke-width=\"1.6\"") && l.contains("polyline"))
        .collect();
    let colours: Vec<&str> = paths
        .iter()
        .map(|l| attributes(l, "polyline", "stroke")[0])
        .collect();
    let due = [&PATHS[..], &PATHS[..1]].concat();
    assert_eq!(colours, due);
    let dots: Vec<&str> = attributes(&svg, "circle", "stroke");
    assert_eq!(dots, due);
}

/// However fine the range is.
#[test]
fn positions_are_chosen_by_eighths() {
    let chosen = |n: u32, whole| {
        let pose = |k: u32| Pose {
            drive: f64::from(k),
            points: Vec::new(),
            shapes: Vec::new(),
        };
        let poses: Vec<Pose> = (0..n).map(pose).collect();
        let scene = Scene {
            name: "",
            unit: "",
            fixed: &[],
            points: &[],
            poses: &poses,
            whole,
        };
        let all = scene.chosen();
        all.iter().map(|p| p.drive as u32).collect::<Vec<_>>()
    };
    assert_eq!(chosen(17, true), [0, 2, 4, 6, 8, 10, 12, 14]);
    assert_eq!(chosen(17, false), [8, 0, 4, 12, 16]);
    assert_eq!(chosen(8, true), [0, 0, 1, 2, 3, 4, 5, 6]);
    assert_eq!(chosen(7, false), [0, 1, 2, 3, 4, 5, 6]);
    assert!(chosen(0, true).is_empty());
}

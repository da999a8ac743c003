//! Tests of `scene`.

use super::super::super::panel::tests::attributes;
use super::super::super::style::tests::whole;
use super::*;

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

#[test]
fn a_turn_leads_with_its_start_and_a_range_with_its_middle() {
    let turn = drawn("crank & slider", true);
    self::whole(&turn);
    for part in [
        "<title>crank &amp; slider</title>",
        "at φ1 = 0.000°, every 45° faint; paths of A (dashed), B<",
    ] {
        assert!(turn.contains(part), "{part} is missing in {turn}");
    }
    assert_eq!(turn.matches("opacity=\"0.16\"").count(), 7);
    let part = drawn("part", false);
    assert!(part.contains("at φ1 = 180.000°, from 0.00° to 360.00° faint"));
    assert_eq!(part.matches("opacity=\"0.16\"").count(), 4);
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

/// Label and place of each text but the title's and the legend's.
fn labels(svg: &str) -> Vec<(&str, &str, &str)> {
    let (x, y) = (attributes(svg, "text", "x"), attributes(svg, "text", "y"));
    let texts = super::super::super::panel::tests::texts(svg);
    let all = texts.into_iter().zip(x).zip(y).skip(2);
    all.map(|((text, x), y)| (text, x, y)).collect()
}

#[test]
fn every_part_stands_where_it_is() {
    let svg = scaled(None, 1.0);
    assert!(svg.contains("viewBox=\"0 0 1000 496\""), "{svg}");
    assert_eq!(
        labels(&svg),
        [
            ("O1", "96.0", "111.0"),
            ("1", "55.0", "181.0"),
            // Fifteen pixels from the middle of the bar, on its upper side, and five for half a
            // letter.
            ("2", "306.0", "317.2"),
            ("4", "170.0", "231.0"),
            ("A", "81.0", "216.0"),
            ("B", "541.0", "416.0"),
        ]
    );
    let circles: Vec<(&str, &str)> = attributes(&svg, "circle", "cx")
        .into_iter()
        .zip(attributes(&svg, "circle", "cy"))
        .collect();
    let due = [("70.0", "126.0"), ("70.0", "226.0"), ("530.0", "426.0")];
    assert_eq!(circles, due);
    let widths = attributes(&svg, "circle", "stroke-width");
    assert_eq!(widths, ["1.6", "3", "3"]);
    // Bars of the faint positions, the paths of the joints, the first position.
    assert_eq!(
        attributes(&svg, "polyline", "points"),
        [
            "70.00,126.00 170.00,226.00",
            "170.00,226.00 730.00,426.00",
            "70.00,126.00 270.00,226.00",
            "270.00,226.00 930.00,426.00",
            "70.00,226.00 170.00,226.00 270.00,226.00",
            "530.00,426.00 730.00,426.00 930.00,426.00",
            "70.00,126.00 70.00,226.00",
            "70.00,226.00 530.00,426.00",
        ]
    );
    let dashed = svg.matches("stroke-dasharray=\"3 4\"").count();
    assert_eq!(dashed, 1);
    let first = svg
        .lines()
        .find(|l| l.contains("70.00,226.00 170.00,226.00 270"));
    assert!(first.unwrap().contains("stroke-dasharray=\"3 4\""), "{svg}");
    let corners = attributes(&svg, "polygon", "points");
    assert_eq!(corners, ["70.00,126.00 370.00,126.00 70.00,426.00"; 3]);
    let groups = attributes(&svg, "g", "stroke-width");
    assert_eq!(groups, ["1.6", "2", "2", "4"]);
    assert_eq!(svg.matches("opacity=\"0.16\"").count(), 2);
    assert_eq!(svg.matches(" opacity=\"1\"").count(), 1);
    assert!(svg.contains("at φ1 = 0.000°, from 0.00° to 20.00° faint"));
}

/// Under its pivot, above it where the link hangs.
#[test]
fn the_ground_is_on_the_other_side_of_the_link() {
    for (up, base, letter, hatch) in [(1.0, 104.0, 111.0, -8), (0.0, 148.0, 145.0, 8)] {
        let svg = scaled(None, up);
        let paths = attributes(&svg, "path", "d");
        let mut due = vec![
            format!("M70.0 126.0L57.0 {base:.1}h26z"),
            format!("M48.0 {base:.1}h44"),
        ];
        due.extend((0..6).map(|k| format!("M{}.0 {base:.1}l-7 {hatch}", 52 + 8 * k)));
        assert_eq!(paths, due);
        assert_eq!(labels(&svg)[0], ("O1", "96.0", &*format!("{letter:.1}")));
    }
}

/// Half a length of 48 and half a width of 28 to each side, turned with the guide, its letter above
/// it.
#[test]
fn a_slider_is_a_block_on_its_guide() {
    let svg = scaled(Some(30f64.to_radians()), 1.0);
    let of = |name: &str| attributes(&svg, "rect", name);
    assert_eq!(of("x"), ["706.0", "906.0", "506.0"]);
    assert_eq!(of("y"), ["412.0"; 3]);
    // The first one is the paper.
    assert_eq!(of("width"), ["100%", "48", "48", "48"]);
    assert_eq!(of("height"), ["100%", "28", "28", "28"]);
    assert_eq!(
        of("transform"),
        [
            "rotate(-30.000 730.0 426.0)",
            "rotate(-30.000 930.0 426.0)",
            "rotate(-30.000 530.0 426.0)"
        ]
    );
    let all = labels(&svg);
    assert_eq!(
        all[all.len() - 2..],
        [("A", "81.0", "216.0"), ("B", "541.0", "396.0")]
    );
    // Forty pixels beyond both ends: 34.64 across and 20 up.
    let guide = attributes(&svg, "path", "d").into_iter().next_back();
    assert_eq!(guide, Some("M495.4 446.0L964.6 406.0"));
    let down = scaled(Some(150f64.to_radians()), 1.0);
    let guide = attributes(&down, "path", "d").into_iter().next_back();
    assert_eq!(guide, Some("M964.6 446.0L495.4 406.0"));
}

/// Whichever end comes first, and where a bar is upright or has no length.
#[test]
fn the_number_of_a_bar_is_beside_its_middle() {
    let view = View::new([[0.0, 0.0], [8.6, 8.6]].into_iter());
    let at = |ends: [Point; 2]| {
        let svg = number(&view, &Bar { label: "1", ends }).into_string();
        let part = |name| attributes(&svg, "text", name)[0].to_string();
        (part("x"), part("y"))
    };
    let due = |x: &str, y: &str| (x.to_string(), y.to_string());
    // In pixels from (70, 986); a slope of three to four has a normal of four to three.
    let (low, high) = ([0.0, 0.0], [4.0, 3.0]);
    assert_eq!(at([low, high]), due("261.0", "829.0"));
    assert_eq!(at([high, low]), due("261.0", "829.0"));
    let fall = [[0.0, 3.0], [4.0, 0.0]];
    assert_eq!(at(fall), due("279.0", "829.0"));
    assert_eq!(at([low, [2.0, 0.0]]), due("170.0", "976.0"));
    assert_eq!(at([low, [0.0, 2.0]]), due("85.0", "891.0"));
    assert_eq!(at([low, low]), due("70.0", "991.0"));
}

/// A body of one point is a block, one without a point nothing, and of more than three the outline
/// has no inner corner. A mechanism of bodies has no numbers, and its ground is always below.
#[test]
fn bodies_are_drawn_by_their_points() {
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
    let svg = scene.draw();
    whole(&svg);
    let legend = "drive at 0.000 m, from 0.00 m to 1.00 m faint; paths of A, B, C, D, E, F<";
    assert!(svg.contains(legend), "{svg}");
    assert!(svg.contains("<title>crank &amp; more</title>"));
    // From (70, 626).
    let texts: Vec<&str> = labels(&svg).iter().map(|l| l.0).collect();
    assert_eq!(texts, [&["O", "P"][..], &names].concat());
    let corners = attributes(&svg, "polygon", "points");
    assert_eq!(corners, ["70.00,626.00 370.00,626.00 70.00,326.00"; 2]);
    assert_eq!(attributes(&svg, "rect", "x"), ["156.0", "56.0"]);
    assert_eq!(attributes(&svg, "rect", "y"), ["417.0"; 2]);
    assert!(
        svg.contains("L57.0 648.0h26z") && svg.contains("L917.0 148.0h26z"),
        "{svg}"
    );
    // The sixth path has the colour of the first.
    let paths: Vec<&str> = attributes(&svg, "circle", "stroke").split_off(2);
    assert_eq!(paths, [&PATHS[..], &PATHS[..1]].concat());
}

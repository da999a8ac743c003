use super::*;
use crate::cli::commands::linkage::tests::read;
use crate::gallery::Gallery;
use mechaudit::machine::{Linkage, planar};
use std::f64::consts::{PI, TAU};

const BOOM: &str = include_str!("../../../../../examples/cylinder-boom.toml");
const WATT: &str = include_str!("../../../../../examples/watt-1.toml");

/// Bars A–B, B–C and C–D between the pins A and D of the ground, driven at A.
fn four_bar([a, b, c, d]: [[i32; 2]; 4]) -> String {
    let at = |[x, y]: [i32; 2]| format!("[\"{x} m\", \"{y} m\"]");
    let mut text = format!(
        "type = \"planar\"\nname = \"mine\"\n[points]\nA = {}\nB = {}\nC = {}\nD = {}\n\
         [ground]\ndrawn = [\"A\", \"D\"]\n",
        at(a),
        at(b),
        at(c),
        at(d)
    );
    for (name, ends) in [("crank", "AB"), ("coupler", "BC"), ("rocker", "DC")] {
        let (from, to) = ends.split_at(1);
        text += &format!("[[body]]\nname = \"{name}\"\ndrawn = [\"{from}\", \"{to}\"]\n");
    }
    for pin in ["A", "B", "C", "D"] {
        text += &format!("[[joint]]\nkind = \"pin\"\npoint = \"{pin}\"\n");
    }
    text + "[drive]\nbody = \"crank\"\nspeed = \"60 rpm\"\n"
}

/// Lengths of 1, √13, √10 and 4 m.
fn rocking() -> String {
    four_bar([[0, 0], [0, 1], [3, 3], [4, 0]])
}

fn machine(text: &str) -> Box<Machine> {
    match read(text) {
        Linkage::Planar(machine) => machine,
        _ => unreachable!("bodies and joints"),
    }
}

fn branch(machine: &Machine) -> Branch {
    let at = machine.start.at.unwrap_or(0.0);
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    planar::choose(machine, at, None).unwrap()
}

#[test]
fn groups_have_names() {
    let group = |kind, bodies: &[usize]| Group {
        bodies: bodies.to_vec(),
        kind,
        order: 2,
    };
    for (kind, bodies, due) in [
        (GroupKind::Driver, &[1][..], "driver"),
        (GroupKind::Single, &[1], "one body"),
        (GroupKind::Assur { class: 2 }, &[1, 2], "dyad"),
        (
            GroupKind::Assur { class: 2 },
            &[1, 2, 3],
            "Assur group of class 2",
        ),
        (
            GroupKind::Assur { class: 2 },
            &[1],
            "Assur group of class 2",
        ),
        (
            GroupKind::Assur { class: 3 },
            &[1, 2],
            "Assur group of class 3",
        ),
    ] {
        assert_eq!(kind_word(&group(kind, bodies)), due);
    }
}

/// A four-bar, one that is flat, and a boom, on branches that turn and that end.
#[test]
fn branches() {
    let mut all = Gallery::default();
    let flat = machine(&four_bar([[0, 0], [1, 0], [6, 0], [3, 0]]));
    all.add("flat", lines(&flat).join("\n"));
    all.add_json("drawing of the flat", drawing(&flat));
    let (turning, boom) = (machine(&rocking()), machine(BOOM));
    all.add("four-bar", lines(&turning).join("\n"));
    all.add_json(
        "four-bar",
        of_branch(&turning, &branch(&turning), &[]).into(),
    );
    all.add_json("boom", of_branch(&boom, &branch(&boom), &[]).into());
    let end = |drive, kind| Some(End { drive, kind });
    let fold = |drive| end(drive, Some(SingularKind::Fold));
    let change = end(PI, Some(SingularKind::ChangePoint));
    let whole = |turns| Reach::Whole { turns };
    let part = |low, high| Reach::Part { low, high };
    for (machine, reach) in [
        (&turning, whole(Some(1))),
        (&turning, whole(Some(2))),
        (&turning, whole(None)),
        (&turning, part(fold(-PI / 2.0), change)),
        (&turning, part(fold(0.0), end(PI, None))),
        (&boom, part(None, None)),
        (&boom, part(fold(0.95), None)),
        (&boom, part(None, fold(1.25))),
    ] {
        let branch = Branch {
            reach,
            ..branch(machine)
        };
        let facts = of_branch(machine, &branch, &[]);
        let of = ["drive_range", "full_rotation", "turns_to_close"].map(|key| &facts[key]);
        all.add(range_line(machine, &branch), json!(of).to_string());
    }
    all.pin("branches");
}

/// Those of a linkage, and ends that are not refined.
#[test]
fn maps_of_branches() {
    let mut all = Gallery::default();
    let watt = machine(WATT);
    let drives = (0..=6).map(|k| watt.inner(TAU * f64::from(k) / 6.0));
    let map = watt.solver.trace_branches(&drives.collect::<Vec<_>>());
    assert!(map.complete && !map.ends.is_empty());
    let rounded = |line: String| {
        let digits = |word: &str| match word.parse::<f64>() {
            Ok(x) => format!("{x:.6}"),
            Err(_) => word.to_owned(),
        };
        line.split(' ').map(digits).collect::<Vec<_>>().join(" ")
    };
    let lines = map_lines(&watt, &map).into_iter().map(rounded);
    all.add("Watt's", lines.collect::<Vec<_>>().join("\n"));
    for (found, end) in of_map(&watt, &map, &[])["ends"]
        .as_array()
        .unwrap()
        .iter()
        .zip(&map.ends)
    {
        let fold = watt.outer(end.at.as_ref().unwrap().drive).to_degrees();
        assert_eq!(
            (&found["kind"], &found["drive_deg"]),
            (&json!("fold"), &json!(fold))
        );
    }
    let end = |branches: &[usize], begins| BranchEnd {
        at: None,
        drive: 1.25,
        branches: branches.to_vec(),
        begins,
    };
    let made = BranchMap {
        rows: Vec::new(),
        branches: 4,
        ends: vec![
            end(&[3], true),
            end(&[3], false),
            end(&[2, 0], true),
            end(&[3, 1], false),
        ],
        complete: false,
        unmatched: 1,
    };
    let boom = machine(BOOM);
    all.add("made up", map_lines(&boom, &made).join("\n"));
    all.add_json("made up", of_map(&boom, &made, &[]).into());
    all.pin("branch-maps");
}

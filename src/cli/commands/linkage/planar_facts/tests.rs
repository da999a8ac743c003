use super::*;
use crate::cli::commands::linkage::tests::read;
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
fn a_four_bar_has_a_driver_and_a_dyad() {
    let machine = machine(&rocking());
    let groups = "one degree of freedom; groups in the order of solving: crank (driver); coupler, rocker (dyad, order 2)";
    assert_eq!(lines(&machine), [groups]);
    let found = of_branch(&machine, &branch(&machine), &[]);
    let due = json!({
        "schema_version": 1,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "type": "planar",
        "name": "mine",
        "bodies": [machine.bodies[0], "crank", "coupler", "rocker"],
        "joints": ["A", "B", "C", "D"],
        "groups": [
            { "kind": "driver", "class": null, "order": 1, "bodies": ["crank"] },
            { "kind": "assur", "class": 2, "order": 2, "bodies": ["coupler", "rocker"] },
        ],
        "drawing": {
            "velocities": 9,
            "equations": 8,
            "rank": 8,
            "mobility": "regular",
            "freedoms_at_most": 1,
            "redundant": 0,
            "redundant_among": [],
            "movable": ["crank", "coupler", "rocker"],
        },
        "drive_speed_rad_per_s": TAU,
        "drive_acceleration_rad_per_s2": 0.0,
        "branch": found["branch"],
        "modes_at_start": 2,
        "modes_complete": true,
        "full_rotation": true,
        "turns_to_close": 1,
        "drive_range": null,
        "rows_left_out": [],
    });
    assert_eq!(Value::Object(found), due);
}

/// All on one line: one equation follows from the others.
#[test]
fn a_flat_four_bar_has_a_redundant_equation() {
    let machine = machine(&four_bar([[0, 0], [1, 0], [6, 0], [3, 0]]));
    let found = drawing(&machine);
    let part = |key: &str| found[key].clone();
    assert_eq!((part("rank"), part("redundant")), (json!(7), json!(1)));
    assert_eq!(
        part("redundant_among"),
        json!(["crank", "coupler", "rocker"])
    );
    assert!(lines(&machine)[1].contains("rank 7 of 8 equations for 9 velocities"));
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

#[test]
fn how_far_a_branch_reaches() {
    let (turning, boom) = (machine(&rocking()), machine(BOOM));
    let with = |machine: &Machine, reach: Reach| {
        let branch = Branch {
            reach,
            ..branch(machine)
        };
        (
            range_line(machine, &branch),
            of_branch(machine, &branch, &[]),
        )
    };
    let fold = |drive| {
        Some(End {
            drive,
            kind: Some(SingularKind::Fold),
        })
    };
    let change = Some(End {
        drive: PI,
        kind: Some(SingularKind::ChangePoint),
    });
    let unknown = Some(End {
        drive: PI,
        kind: None,
    });
    let whole = |turns| Reach::Whole { turns };
    let part = |low, high| Reach::Part { low, high };
    for (machine, reach, line, range) in [
        (
            &turning,
            whole(Some(1)),
            "the drive turns fully on this branch",
            Value::Null,
        ),
        (
            &turning,
            whole(Some(2)),
            "the drive turns fully on this branch; the mechanism is back in its position after 2 turns",
            Value::Null,
        ),
        (
            &turning,
            whole(None),
            "the drive turns fully on this branch, and the mechanism does not come back",
            Value::Null,
        ),
        (
            &turning,
            part(fold(-PI / 2.0), change),
            "the branch reaches from -90 deg (fold) to 180 deg (change point)",
            json!({
                "from": { "drive_deg": -90.0, "kind": "fold" },
                "to": { "drive_deg": 180.0, "kind": "change point" },
            }),
        ),
        (
            &turning,
            part(fold(0.0), unknown),
            "the branch reaches from 0 deg (fold) to 180 deg (singular position)",
            json!({
                "from": { "drive_deg": 0.0, "kind": "fold" },
                "to": { "drive_deg": 180.0, "kind": "singular position" },
            }),
        ),
        (
            &boom,
            part(None, None),
            "the branch reaches from 0.9 m to 1.4 m",
            json!({ "from": null, "to": null }),
        ),
        (
            &boom,
            part(fold(0.95), None),
            "the branch reaches from 0.95 m (fold) to 1.4 m",
            json!({ "from": { "drive_m": 0.95, "kind": "fold" }, "to": null }),
        ),
        (
            &boom,
            part(None, fold(1.25)),
            "the branch reaches from 0.9 m to 1.25 m (fold)",
            json!({ "from": null, "to": { "drive_m": 1.25, "kind": "fold" } }),
        ),
    ] {
        let (found, facts) = with(machine, reach);
        assert_eq!(found, line);
        assert_eq!(facts["drive_range"], range, "{line}");
        assert_eq!(facts["full_rotation"], range.is_null(), "{line}");
    }
    let (_, facts) = with(&boom, part(None, None));
    assert_eq!(facts["drive_speed_m_per_s"], 0.05);
    assert_eq!(facts["drive_acceleration_m_per_s2"], 0.0);
    assert!(facts["drawing"].is_null());
}

#[test]
fn branches_begin_and_end() {
    let machine = machine(WATT);
    let drives: Vec<f64> = (0..=6)
        .map(|k| machine.inner(TAU * f64::from(k) / 6.0))
        .collect();
    let map = machine.solver.trace_branches(&drives);
    let counts = || map.rows.iter().map(Vec::len);
    let (least, most) = (counts().min().unwrap(), counts().max().unwrap());
    let all = map_lines(&machine, &map);
    let due = format!(
        "{} branches, from {least} to {most} assembly modes at a value of the drive, all that there are",
        map.branches
    );
    assert!(map.complete && all[0] == due, "{all:?}");
    assert_eq!(all.len(), 1 + map.ends.len());
    for (line, end) in all[1..].iter().zip(&map.ends) {
        assert!(
            line.starts_with("fold at ") && line.contains(" deg: branch"),
            "{line}"
        );
        let due = match (end.branches.len(), end.begins) {
            (1, true) => " begins there",
            (1, false) => " ends there",
            (_, true) => " begin there",
            (_, false) => " end there",
        };
        assert!(line.ends_with(due), "{line}");
    }
    let facts = of_map(&machine, &map, &[]);
    assert_eq!(facts["branches"], map.branches);
    assert_eq!(
        (&facts["modes_complete"], &facts["unmatched"]),
        (&json!(true), &json!(0))
    );
    let ends = facts["ends"].as_array().unwrap();
    assert!(!ends.is_empty() && ends.len() == map.ends.len());
    for (found, end) in ends.iter().zip(&map.ends) {
        let fold = machine.outer(end.at.as_ref().unwrap().drive).to_degrees();
        assert_eq!(
            (&found["kind"], &found["drive_deg"]),
            (&json!("fold"), &json!(fold))
        );
        assert_eq!(
            (&found["branches"], &found["begins"]),
            (&json!(end.branches), &json!(end.begins))
        );
    }
    // Ends that are not refined, in degrees and metres.
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
    let boom = self::machine(BOOM);
    assert_eq!(
        map_lines(&boom, &made),
        [
            "4 branches found, from 0 to 0 assembly modes at a value of the drive; there may be more",
            "1 positions were found by continuation or by the search for all modes, but not by both",
            "singular position at 1.25 m: branch 3 begins there",
            "singular position at 1.25 m: branch 3 ends there",
            "singular position at 1.25 m: branches 0 and 2 begin there",
            "singular position at 1.25 m: branches 1 and 3 end there",
        ]
    );
    let facts = of_map(&boom, &made, &[]);
    assert_eq!(
        (&facts["modes_complete"], &facts["unmatched"]),
        (&json!(false), &json!(1))
    );
    let due =
        json!({ "drive_m": 1.25, "kind": "singular position", "branches": [2, 0], "begins": true });
    assert_eq!(facts["ends"][2], due);
}

//! Facts that stand beside the rows.

use super::super::facts;
use super::*;

#[test]
fn facts_of_a_branch() {
    let moving = SCREEN.replace(
        "\"1 rad/s\"",
        "\"2 rad/s\"\ncrank_acceleration = \"-3 rad/s^2\"",
    );
    let linkage = screen(&moving);
    let whole = branch(&linkage);
    let found = facts::of_branch(&linkage, &whole);
    for (key, due) in [
        ("schema_version", json!(1)),
        ("mechaudit_version", json!(env!("CARGO_PKG_VERSION"))),
        ("type", json!("class-iii")),
        ("name", json!(linkage.name)),
        ("crank_speed_rad_per_s", json!(2.0)),
        ("crank_acceleration_rad_per_s2", json!(-3.0)),
        ("branch", json!(whole.mode)),
        ("full_rotation", json!(true)),
        ("turns_to_close", json!(1)),
        ("crank_range", Value::Null),
    ] {
        assert_eq!(found[key], due, "{key}");
    }
    let dead = found["dead_positions"].as_array().unwrap();
    let dead: Vec<(f64, bool)> = dead
        .iter()
        .map(|d| {
            (
                d["phi1_deg"].as_f64().unwrap(),
                d["stretched"].as_bool().unwrap(),
            )
        })
        .collect();
    assert!((dead[0].0 - 14.426).abs() < 1e-3 && dead[0].1);
    assert!((dead[1].0 - 196.014).abs() < 1e-3 && !dead[1].1);
    let turns = |turns| Branch {
        reach: Reach::Whole { turns },
        ..whole.clone()
    };
    let end = |phi1: f64, phi4: f64| End {
        phi1,
        reached: 0.0,
        phi4,
    };
    let part = Branch {
        reach: Reach::Part {
            low: end(-FRAC_PI_2, 1.0),
            high: end(PI, 2.0),
        },
        dead: Vec::new(),
        ..whole.clone()
    };
    let found = facts::of_branch(&linkage, &part);
    assert_eq!(found["full_rotation"], false);
    assert!(found["turns_to_close"].is_null());
    let due = json!({
        "from": { "phi1_deg": -90.0, "phi4_deg": 1f64.to_degrees() },
        "to": { "phi1_deg": 180.0, "phi4_deg": 2f64.to_degrees() },
    });
    assert_eq!(found["crank_range"], due);
    for (branch, due) in [
        (turns(Some(1)), "the crank turns fully on this branch"),
        (
            turns(Some(3)),
            "the crank turns fully on this branch; the linkage is back in its position after 3 turns",
        ),
        (
            turns(None),
            "the crank turns fully on this branch, at least 12 times",
        ),
        (
            part.clone(),
            "the crank cannot turn fully on this branch: it reaches from -90.000000 deg to 180.000000 deg, where assembly modes merge",
        ),
    ] {
        assert_eq!(facts::range_line(&branch), due);
    }
    assert_eq!(facts::dead_line(&part), None);
    let line = facts::dead_line(&whole).unwrap();
    assert!(
        line.starts_with("dead positions, crank and link 2 in line, at 14.426"),
        "{line}"
    );
    assert!(
        line.contains(" deg (stretched), 196.014") && line.ends_with(" deg (folded)"),
        "{line}"
    );
}

/// Grashof's types by the sums of the shortest and longest links and of the others.
#[test]
fn facts_of_dyads() {
    let facts = |dyad: &Dyad, assemblies: &[mechaudit::solvers::dyad::Assembly]| {
        Value::Object(dyad_facts::json(dyad, assemblies, &[]))
    };
    for (lengths, kind, full, points) in [
        ([1.0, 4.0, 3.0, 3.5], "crank-rocker", true, false),
        ([3.0, 4.0, 1.0, 3.5], "rocker-crank", false, false),
        ([3.0, 4.0, 3.5, 1.0], "double-crank", true, false),
        ([3.0, 1.0, 4.0, 3.5], "double-rocker", false, false),
        ([3.0, 4.0, 3.0, 3.5], "triple-rocker", false, false),
        ([2.0, 5.0, 2.0, 5.0], "change-point", true, true),
    ] {
        let dyad = four_bar(lengths);
        let found = facts(&dyad, &ASSEMBLIES);
        assert_eq!(found["grashof_type"], kind);
        assert_eq!(found["full_rotation"], full, "{kind}");
        assert_eq!(found["change_points"], points, "{kind}");
        assert_eq!(found["crank_ranges"].is_null(), full, "{kind}");
        assert_eq!(found["branches"].as_array().unwrap().len(), 2);
        assert_eq!(found["type"], "four-bar");
        assert_eq!(found["schema_version"], 1);
        assert_eq!(found["mechaudit_version"], env!("CARGO_PKG_VERSION"));
        let line = &dyad_facts::lines(&dyad, &ASSEMBLIES)[0];
        let due = match (full, points) {
            (true, false) => "; the crank turns fully",
            (true, true) => {
                "; the crank turns fully, through singular positions where the assembly may change"
            }
            _ => "; the crank cannot turn fully: it reaches from ",
        };
        assert!(
            line.starts_with(&format!("four-bar, {kind} by Grashof's rule{due}")),
            "{line}"
        );
        assert!(!full || line.ends_with(due), "{line}");
    }
    // Crank 1, rod 3 and no offset: dead centres at 0 and 180 degrees, at 4 m and 2 m ahead.
    let slider = dyad_of("slider-crank", "crank = \"1 m\"\nrod = \"3 m\"\n");
    let found = facts(&slider, &ASSEMBLIES[..1]);
    assert_eq!(
        (&found["stroke_m"], &found["name"]),
        (&json!(2.0), &Value::Null)
    );
    assert!(found.get("grashof_type").is_none() && found.get("crank_speed_rad_per_s").is_none());
    let ahead = &found["branches"][0];
    assert_eq!(
        (&ahead["branch"], &ahead["assembly"]),
        (&json!(0), &json!("positive"))
    );
    assert!(ahead.get("swing_deg").is_none());
    let lines = dyad_facts::lines(&slider, &ASSEMBLIES);
    assert_eq!(lines.len(), 3, "{lines:?}");
    assert_eq!(
        lines[0],
        "slider-crank with a stroke of 2.000000000 m; the crank turns fully"
    );
    assert!(
        lines[1].starts_with("branch 0 (positive assembly): dead centres at phi1 = "),
        "{lines:?}"
    );
    assert!(
        lines[1].contains("slider at 4.000000000 m")
            && lines[1].contains("slider at 2.000000000 m")
    );
    assert!(
        lines[2].starts_with("branch 1 (negative assembly): dead centres at phi1 = "),
        "{lines:?}"
    );
    assert!(
        lines[2].contains("slider at -4.000000000 m")
            && lines[2].contains("slider at -2.000000000 m")
    );
    // A rod that is too short: sin φ1 from −1/2 to 1/2.
    let short = dyad_of("slider-crank", "crank = \"2 m\"\nrod = \"1 m\"\n");
    let found = facts(&short, &ASSEMBLIES);
    assert!(found["stroke_m"].is_null());
    for (part, due) in [(0, [-30.0, 30.0]), (1, [150.0, 210.0])] {
        for (key, due) in ["from_deg", "to_deg"].into_iter().zip(due) {
            let x = found["crank_ranges"][part][key].as_f64().unwrap();
            assert!((x - due).abs() < 1e-9, "{x}");
        }
    }
    let lines = dyad_facts::lines(&short, &ASSEMBLIES);
    assert!(lines[0].starts_with("slider-crank; the crank cannot turn fully: it reaches from -30.000000 deg to 30.000000 deg and from 150.000000 deg"), "{lines:?}");
    // A crank-rocker whose crank has a speed.
    let text = "type = \"four-bar\"\nname = \"mine\"\ncrank_speed = \"2 rad/s\"\ncrank_acceleration = \"-3 rad/s^2\"\n\
                [geometry]\ncrank = \"1 m\"\ncoupler = \"4 m\"\nrocker = \"3 m\"\nframe = \"3.5 m\"\n";
    let machine::Linkage::Dyad(moving) = read(text) else {
        unreachable!("a dyad")
    };
    let found = facts(&moving, &ASSEMBLIES[1..]);
    assert_eq!(found["name"], "mine");
    assert_eq!(found["crank_speed_rad_per_s"], 2.0);
    assert_eq!(found["crank_acceleration_rad_per_s2"], -3.0);
    let branch = &found["branches"][0];
    assert_eq!(
        (&branch["branch"], &branch["assembly"]),
        (&json!(1), &json!("negative"))
    );
    // The rocker between both dead positions, by the law of cosines.
    let angle = |side: f64| ((3.0 * 3.0 + 3.5 * 3.5 - side * side) / (2.0 * 3.0 * 3.5)).acos();
    let swing = (angle(5.0) - angle(3.0)).to_degrees();
    assert!((branch["swing_deg"].as_f64().unwrap() - swing).abs() < 1e-9);
    assert_eq!(branch["dead_positions"].as_array().unwrap().len(), 2);
    let lines = dyad_facts::lines(&moving, &ASSEMBLIES[1..]);
    assert!(
        lines.len() == 2 && lines[1].ends_with(&format!("; the rocker swings {swing:.6} deg")),
        "{lines:?}"
    );
    assert!(
        lines[1].starts_with("branch 1 (negative assembly): dead positions at phi1 = "),
        "{lines:?}"
    );
}

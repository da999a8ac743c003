//! Facts that stand beside the rows.

use super::super::facts;
use super::*;
use crate::gallery::Gallery;

/// Numbers to nine digits: the last ones are of no interest here.
fn rounded(value: Value) -> Value {
    match value {
        Value::Number(n) if n.is_f64() => {
            let digits = format!("{:.8e}", n.as_f64().unwrap());
            json!(digits.parse::<f64>().unwrap())
        }
        Value::Array(all) => all.into_iter().map(rounded).collect(),
        Value::Object(all) => all.into_iter().map(|(k, v)| (k, rounded(v))).collect(),
        other => other,
    }
}

#[test]
fn facts_of_a_branch() {
    let moving = SCREEN.replace(
        "\"1 rad/s\"",
        "\"2 rad/s\"\ncrank_acceleration = \"-3 rad/s^2\"",
    );
    let linkage = screen(&moving);
    let whole = branch(&linkage);
    let end = |phi1: f64, phi4: f64| End {
        phi1,
        reached: 0.0,
        phi4,
    };
    let part = Reach::Part {
        low: end(-FRAC_PI_2, 1.0),
        high: end(PI, 2.0),
    };
    let turns = |turns| Reach::Whole { turns };
    let mut all = Gallery::default();
    all.add_json("whole", rounded(facts::of_branch(&linkage, &whole).into()));
    for reach in [turns(Some(1)), turns(Some(3)), turns(None), part] {
        let mut branch = Branch {
            reach,
            ..whole.clone()
        };
        let facts = facts::of_branch(&linkage, &branch);
        let of = ["crank_range", "full_rotation", "turns_to_close"].map(|key| facts[key].clone());
        all.add(facts::range_line(&branch), rounded(json!(of)).to_string());
        branch.dead.clear();
        assert_eq!(facts::dead_line(&branch), None);
    }
    let line = facts::dead_line(&whole).unwrap();
    assert!(
        line.starts_with("dead positions, crank and link 2 in line, at 14.426")
            && line.contains(" deg (stretched), 196.014")
            && line.ends_with(" deg (folded)"),
        "{line}"
    );
    all.pin("class-iii-facts");
}

/// Grashof's types by the sums of the shortest and longest links and of the others; slider-cranks
/// that turn and that do not.
#[test]
fn facts_of_dyads() {
    let mut all = Gallery::default();
    let mut add = |name: &str, dyad: &Dyad| {
        let facts = dyad_facts::json(dyad, &ASSEMBLIES, &[]);
        all.add_json(name, rounded(facts.into()));
        all.add(name, dyad_facts::lines(dyad, &ASSEMBLIES).join("\n"));
    };
    for lengths in [
        [1.0, 4.0, 3.0, 3.5],
        [3.0, 4.0, 1.0, 3.5],
        [3.0, 4.0, 3.5, 1.0],
        [3.0, 1.0, 4.0, 3.5],
        [3.0, 4.0, 3.0, 3.5],
        [2.0, 5.0, 2.0, 5.0],
    ] {
        add(&format!("{lengths:?}"), &four_bar(lengths));
    }
    for (crank, rod) in [(1, 3), (2, 1)] {
        let lengths = format!("crank = \"{crank} m\"\nrod = \"{rod} m\"\n");
        add(
            &format!("crank {crank}, rod {rod}"),
            &dyad_of("slider-crank", &lengths),
        );
    }
    let text = "type = \"four-bar\"\nname = \"mine\"\ncrank_speed = \"2 rad/s\"\n\
                crank_acceleration = \"-3 rad/s^2\"\n[geometry]\ncrank = \"1 m\"\n\
                coupler = \"4 m\"\nrocker = \"3 m\"\nframe = \"3.5 m\"\n";
    let machine::Linkage::Dyad(moving) = read(text) else {
        unreachable!("a dyad")
    };
    add("moving", &moving);
    // The rocker between both dead positions, by the law of cosines.
    let angle = |side: f64| ((3.0 * 3.0 + 3.5 * 3.5 - side * side) / (2.0 * 3.0 * 3.5)).acos();
    let swing = (angle(5.0) - angle(3.0)).to_degrees();
    let found = dyad_facts::json(&moving, &ASSEMBLIES[1..], &[]);
    let found = found["branches"][0]["swing_deg"].as_f64().unwrap();
    assert!((found - swing).abs() < 1e-9);
    all.pin("dyad-facts");
}

//! Tests of what `mechaudit linkage` proves of drawings by ranks.

use crate::common::{command, refused, run_on, said, words};

/// Bodies by the letters of their points, the first driven; everything drawn, every letter on two
/// bodies a pin.
fn drawn(ground: &str, bodies: &[&str], points: &[(char, [i32; 2])]) -> String {
    let letters = |b: &str| {
        let all: Vec<String> = b.chars().map(|c| format!("\"{c}\"")).collect();
        all.join(", ")
    };
    let mut text = String::from("type = \"planar\"\n[points]\n");
    for (name, [x, y]) in points {
        text += &format!("{name} = [\"{x} m\", \"{y} m\"]\n");
    }
    text += &format!("[ground]\ndrawn = [{}]\n", letters(ground));
    for b in bodies {
        text += &format!("[[body]]\nname = \"{b}\"\ndrawn = [{}]\n", letters(b));
    }
    for (name, _) in points {
        text += &format!("[[joint]]\nkind = \"pin\"\npoint = \"{name}\"\n");
    }
    text + &format!("[drive]\nbody = \"{}\"\n", bodies[0])
}

/// Files that a count refuses say what ranks prove of their drawings.
#[test]
fn drawings_that_are_refused_are_decided_by_rank() {
    let cranks = |c: [i32; 2]| {
        let points = [('A', [0, 0]), ('B', [2, 0]), ('C', c)];
        let more = [('D', [1, 3]), ('E', [3, 3]), ('F', [6, 4])];
        drawn("ABC", &["AD", "BE", "CF", "DEF"], &[points, more].concat())
    };
    let run = |text: &str| run_on(text, &words("linkage -"));
    refused(
        &run(&cranks([5, 1])),
        "as drawn, proved: rank 11 of 12 equations for 12 velocities, it moves, with one degree of freedom; \
         1 redundant among AD, BE, CF, DEF",
    );
    refused(
        &run(&cranks([4, -2])),
        "undecided whether it moves, with at most one degree of freedom; 1 redundant among",
    );
    refused(
        &run(&cranks([5, 0])),
        "as drawn, proved: rank 12 of 12 equations for 12 velocities, nothing can move",
    );
    let triangle = [('A', [0, 0]), ('B', [4, 0]), ('C', [1, 3])];
    let d = run(&drawn("AB", &["AC", "BC"], &triangle));
    refused(&d, "locked: ");
    refused(
        &d,
        "rank 6 of 6 equations for 6 velocities, nothing can move",
    );
    let chain = [
        ('A', [0, 0]),
        ('B', [9, 0]),
        ('C', [1, 3]),
        ('D', [4, 5]),
        ('E', [8, 4]),
    ];
    refused(
        &run(&drawn("AB", &["AC", "CD", "DE", "EB"], &chain)),
        "as drawn, proved: rank 10 of 10 equations for 12 velocities, 2 degrees of freedom",
    );
}

/// A drawing that is accepted has its ranks in the JSON, and a line where it is singular.
#[test]
fn ranks_of_drawings() {
    let d = command("linkage examples/double-butterfly.toml --step-deg 180 --format json");
    let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    let drawing = &json["drawing"];
    assert_eq!(
        (&drawing["rank"], &drawing["equations"]),
        (&20.into(), &20.into())
    );
    assert_eq!(drawing["mobility"], "regular");
    assert!(!d.err.contains("as drawn"), "{}", d.err);
    let d = command("linkage examples/jansen-leg.toml --step-deg 180 --format json");
    let json: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert!(json["drawing"].is_null());
    // A four-bar between its singular positions, and with all bars on one line.
    let bent = [('A', [0, 0]), ('B', [4, 0]), ('C', [0, 1]), ('D', [4, 3])];
    let d = run_on(
        drawn("AB", &["AC", "CD", "DB"], &bent),
        &words("linkage - --step-deg 90"),
    );
    assert!(!d.err.contains("as drawn"), "{}", d.err);
    let flat = [('A', [0, 0]), ('B', [3, 0]), ('C', [1, 0]), ('D', [6, 0])];
    let d = run_on(
        drawn("AB", &["AC", "CD", "DB"], &flat),
        &words("linkage - --step-deg 90"),
    );
    said(
        &d,
        "as drawn, proved: rank 7 of 8 equations for 9 velocities",
    );
    said(&d, "1 redundant among AC, CD, DB");
}

use super::super::tests::{args, read};
use super::*;
use mechaudit::machine::Linkage;

const WATT: &str = include_str!("../../../../../examples/watt-1.toml");
const BOOM: &str = include_str!("../../../../../examples/cylinder-boom.toml");
const QUICK: &str = include_str!("../../../../../examples/quick-return.toml");

fn mechanism(text: &str) -> Box<Machine> {
    match read(text) {
        Linkage::Planar(machine) => machine,
        _ => unreachable!("bodies and joints"),
    }
}

#[test]
fn a_range_has_as_many_rows_as_steps_fit_into_it() {
    for (to, due) in [
        (2.0, &[2.0][..]),
        (2.4, &[2.0]),
        (2.5, &[2.0, 2.5]),
        (3.5 - 4e-10, &[2.0, 2.5, 3.0, 3.5]),
        (3.5 - 6e-10, &[2.0, 2.5, 3.0]),
        (3.9, &[2.0, 2.5, 3.0, 3.5]),
    ] {
        let found: Vec<f64> = displacements([2.0, to, 0.5]).collect();
        assert_eq!(found, due, "to {to}");
    }
}

#[test]
fn modes_are_counted_in_words() {
    let machine = mechanism(WATT);
    let at = machine.start.at.unwrap_or(0.0).to_radians();
    let branch = planar::choose(&machine, at, Some(0)).unwrap();
    let said = |modes: usize, complete: bool| {
        let branch = Branch {
            modes,
            complete,
            ..branch.clone()
        };
        facts::modes_line(&machine, &branch)
    };
    let one = said(1, true);
    assert!(one.starts_with("1 assembly mode at "), "{one}");
    assert!(
        one.ends_with(", all that there are; this is number 0"),
        "{one}"
    );
    let some = said(3, false);
    assert!(some.starts_with("3 assembly modes found at "), "{some}");
    assert!(
        some.ends_with("; there may be more; this is number 0"),
        "{some}"
    );
}

/// A mode that floating point has lost, or has twice, is no proof that these are all.
#[test]
fn another_number_of_modes_is_open() {
    let machine = mechanism(WATT);
    let certifier = Certifier::new(&machine, 15).unwrap();
    let at = machine.start.at.unwrap_or(0.0);
    let values = Values(
        vec![(at, at.to_radians())],
        Rational::from_f64(at).into_iter().collect(),
    );
    let map = machine
        .solver
        .trace_branches(&[machine.inner(at.to_radians())]);
    assert!(map.rows[0].len() > 1);
    assert_eq!(prove_counts(&certifier, &values, &map), 0);
    let mut fewer = map.clone();
    fewer.rows[0].pop();
    assert_eq!(prove_counts(&certifier, &values, &fewer), 1);
    let mut more = map.clone();
    more.rows[0].extend_from_within(..1);
    assert_eq!(prove_counts(&certifier, &values, &more), 1);
    // Positions that only one of the searches found are told.
    let said = |map: &BranchMap| facts::map_lines(&machine, map).join("\n");
    assert!(!said(&map).contains("but not by both"));
    let unmatched = BranchMap {
        unmatched: 2,
        ..map
    };
    assert!(said(&unmatched).contains("2 positions were found by continuation or"));
}

/// The file's own start, in degrees or metres, unless a number is asked for at the first value.
#[test]
fn where_a_branch_is_chosen() {
    let at_30 = format!("{WATT}\n[start]\nat = \"30 deg\"\n");
    for (text, line, due) in [
        (&*at_30, "", std::f64::consts::PI / 6.0),
        (&at_30, "--branch 1", 0.25),
        (BOOM, "", 1.0),
        (BOOM, "--branch 0", 0.25),
    ] {
        let found = start(&args(line), &mechanism(text), 0.25);
        assert!((found - due).abs() < 1e-15, "{line}: {found}");
    }
}

/// Degrees from those asked for or the file's start; displacements from the file alone.
#[test]
fn the_values_of_the_drive() {
    let at_30 = mechanism(&format!("{WATT}\n[start]\nat = \"30 deg\"\n"));
    let boom = mechanism(BOOM);
    let Values(found, exact) = Values::new(&args("--step-deg 90"), &at_30).unwrap();
    assert_eq!(exact, [30, 120, 210, 300]);
    let degrees: Vec<f64> = found.iter().map(|v| v.0).collect();
    assert_eq!(degrees, [30.0, 120.0, 210.0, 300.0]);
    assert!(found.iter().all(|(d, r)| *r == d.to_radians()));
    let Values(_, exact) =
        Values::new(&args("--from-deg 5 --to-deg 15 --step-deg 5"), &at_30).unwrap();
    assert_eq!(exact, [5, 10, 15]);
    let Values(found, exact) = Values::new(&args(""), &boom).unwrap();
    let exact: Vec<String> = exact.iter().map(decimal).collect();
    assert!(found.len() == 11 && exact.len() == 11);
    assert_eq!([&*exact[1], &exact[10]], ["0.95", "1.4"]);
    assert_eq!((found[0], found[2]), ((0.9, 0.9), (1.0, 1.0)));
    for line in ["--from-deg 1", "--to-deg 1", "--from-deg 1 --to-deg 2"] {
        assert!(Values::new(&args(line), &boom).is_err(), "{line}");
    }
}

#[test]
fn undecided_cells_are_counted() {
    let cells = [
        Cell::Undecided,
        Cell::Count(0),
        Cell::Undecided,
        Cell::Float(0.0),
    ];
    assert_eq!((undecided_in(&cells), undecided_in(&cells[1..2])), (2, 0));
}

/// Reactions need masses or loads as well as a speed, and have no digits.
#[test]
fn reactions_need_loads_and_a_speed() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.csv");
    let run = |text: &str, line: &str| {
        let line = format!("{line} --step-deg 90 --output {}", file.display());
        linkage(&args(&line), &mechanism(text))
    };
    let slow = QUICK.replace("speed = \"60 rpm\"", "");
    let moving = format!("{WATT}speed = \"60 rpm\"\n");
    for (text, line, due) in [
        (QUICK, "--reactions", true),
        (QUICK, "", true),
        (&*slow, "--reactions", false),
        (&slow, "", true),
        (&moving, "--reactions", false),
        (&moving, "", true),
        (WATT, "--reactions", false),
        (WATT, "--digits 5 --from-deg 0 --to-deg 0", true),
        (
            WATT,
            "--digits 5 --from-deg 0 --to-deg 0 --reactions",
            false,
        ),
    ] {
        let found = run(text, line);
        assert_eq!(found.is_ok(), due, "{line}: {found:?}");
    }
}

/// At 0 degrees, at 1 at the start and at 2: those that the branch reaches, with its number.
#[test]
fn rows_of_a_branch_and_of_all() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.json");
    let run = |line: &str| {
        let line = format!("{line} --format json --output {}", file.display());
        let outcome = linkage(&args(&line), &mechanism(WATT)).unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        let found: serde_json::Value = serde_json::from_str(&text).unwrap();
        (outcome, found)
    };
    // The drawing's position, to which the branch belongs.
    let crank = 2f64.atan2(1.0).to_degrees();
    for digits in ["", "--digits 12"] {
        let (outcome, found) = run(&format!("--step-deg 60 {digits}"));
        assert_eq!(outcome, Outcome::AsExpected);
        let ends = &found["drive_range"];
        let end = |key: &str| ends[key]["drive_deg"].as_f64().unwrap();
        let rows = found["rows"].as_array().unwrap();
        let at = |row: &serde_json::Value| match &row["phi_deg"] {
            serde_json::Value::String(text) => text.parse().unwrap(),
            other => other.as_f64().unwrap(),
        };
        assert!(!rows.is_empty() && rows.len() < 6, "{found}");
        for row in rows {
            assert_eq!(row["branch"], found["branch"]);
            let turned = end("from") + (at(row) - end("from")).rem_euclid(360.0);
            assert!(turned <= end("to"), "{row}");
        }
        let turned = end("from") + (crank - end("from")).rem_euclid(360.0);
        assert!(turned <= end("to"), "{ends}");
    }
    let (outcome, found) = run("--all-branches --step-deg 60 --digits 9");
    assert_eq!(outcome, Outcome::AsExpected);
    let rows = found["rows"].as_array().unwrap();
    let count = found["branches"].as_u64().unwrap();
    let numbers: std::collections::BTreeSet<u64> =
        rows.iter().map(|r| r["branch"].as_u64().unwrap()).collect();
    assert_eq!(numbers, (0..count).collect());
    assert!(rows.len() > 6 && found["modes_complete"] == true);
}

/// Certified rows of a change point, of a drive by displacement, and of slides, whose modes are not
/// counted.
#[test]
fn certified_rows_of_every_kind() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.json");
    let run = |text: &str, line: &str| {
        let line = format!("{line} --format json --output {}", file.display());
        let outcome = linkage(&args(&line), &mechanism(text)).unwrap();
        let text = std::fs::read_to_string(&file).unwrap();
        let found: serde_json::Value = serde_json::from_str(&text).unwrap();
        (outcome, found["rows"].as_array().unwrap().clone())
    };
    let pins =
        ["A", "B", "C", "D"].map(|p| format!("[[joint]]\nkind = \"pin\"\npoint = \"{p}\"\n"));
    let links = [
        ("crank", "AB", 1),
        ("coupler", "BC", 2),
        ("rocker", "DC", 4),
    ]
    .map(|(n, e, l)| {
        let (a, b) = e.split_at(1);
        format!("[[body]]\nname = \"{n}\"\nends = [\"{a}\", \"{b}\"]\nlength = \"{l} m\"\n")
    });
    let four_bar = format!(
        "type = \"planar\"\n[ground.points]\nA = [\"0 m\", \"0 m\"]\nD = [\"5 m\", \"0 m\"]\n{}{}[drive]\nbody = \"crank\"\n",
        links.concat(),
        pins.concat()
    );
    let (outcome, rows) = run(
        &four_bar,
        "--branch 0 --from-deg 170 --to-deg 190 --step-deg 10 --digits 12",
    );
    assert_eq!((outcome, rows.len()), (Outcome::Finding, 3));
    let there = &rows[1];
    assert_eq!(there["phi_deg"], "180");
    assert_eq!(
        (&there["coupler_deg"], &there["rocker_deg"]),
        (&"0".into(), &"180.000000000".into())
    );
    assert!(there["dcoupler_dphi"].is_null());
    assert!(rows[0]["dcoupler_dphi"].is_string() && rows[2]["dcoupler_dphi"].is_string());
    let (outcome, rows) = run(BOOM, "--digits 9");
    assert_eq!((outcome, rows.len()), (Outcome::AsExpected, 11));
    assert_eq!(
        (&rows[1]["s_m"], &rows[1]["ds_cylinder_ds"]),
        (&"0.95".into(), &"1.00000000".into())
    );
    let (outcome, rows) = run(QUICK, "--all-branches --step-deg 50 --digits 9");
    assert!(outcome == Outcome::Finding && rows.len() >= 8);
    assert!(rows.iter().all(|r| r["s_guide_m"].is_string()));
}

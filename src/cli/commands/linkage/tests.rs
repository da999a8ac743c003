use super::*;
use crate::cli::args::{Args, Command};
use clap::Parser;
use mechaudit::machine::Source;
use mechaudit::machine::class_iii::{End, Reach};
use mechaudit::machine::dyad::{ASSEMBLIES, Dyad};
use mechaudit::machine::{class_iii, planar as mechanisms};
use mechaudit::motion::Motion;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub const SCREEN: &str = include_str!("../../../../examples/sand-screen.toml");
const SHORT: &str = include_str!("../../../../examples/no-full-turn.toml");
const WATT_2: &str = include_str!("../../../../examples/watt-2.toml");
const CELL: &str = include_str!("../../../../examples/peaucellier-cell.toml");
const BOOM: &str = include_str!("../../../../examples/cylinder-boom.toml");

/// The arguments of `linkage` with a file that nobody reads.
pub fn args(line: &str) -> LinkageArgs {
    let words = ["mechaudit", "linkage", "made-up.toml"].into_iter();
    match Args::parse_from(words.chain(line.split_whitespace())).command {
        Some(Command::Linkage(args)) => args,
        _ => unreachable!("a linkage"),
    }
}

pub fn read(text: &str) -> machine::Linkage {
    machine::Linkage::read(&Source::toml(text)).unwrap()
}

fn screen(text: &str) -> Box<Linkage> {
    match read(text) {
        machine::Linkage::ClassIii(linkage) => linkage,
        _ => unreachable!("a linkage of class III"),
    }
}

fn dyad_of(kind: &str, lengths: &str) -> Box<Dyad> {
    match read(&format!("type = \"{kind}\"\n[geometry]\n{lengths}")) {
        machine::Linkage::Dyad(dyad) => dyad,
        _ => unreachable!("a dyad"),
    }
}

fn four_bar([crank, coupler, rocker, frame]: [f64; 4]) -> Box<Dyad> {
    let lengths = format!(
        "crank = \"{crank} m\"\ncoupler = \"{coupler} m\"\nrocker = \"{rocker} m\"\nframe = \"{frame} m\"\n"
    );
    dyad_of("four-bar", &lengths)
}

fn branch(linkage: &Linkage) -> Branch {
    let start = linkage.start_degrees().unwrap_or_default();
    class_iii::choose(&linkage.solver, &start, None, &linkage.start).unwrap()
}

/// What is shown first, in degrees.
fn shown_first(motion: &Motion) -> f64 {
    motion.drive.values[motion.start]
}

#[test]
fn the_crank_angles_of_no_window_are_a_turn_in_48() {
    let grid = args("").grid(None).unwrap();
    assert_eq!((&grid.from, grid.count), (&Rational::new(), 48));
    assert_eq!(grid.angle(1), Rational::from((15, 2)));
    let from_start = args("").grid(Some(Rational::from(14))).unwrap();
    assert_eq!(from_start.angle(2), 29);
    // So many rows, and fewer where all branches are kept.
    let many = |line: &str| args(line).grid(None).is_ok();
    assert!(many("--step-deg 1 --to-deg 9999999") && !many("--step-deg 1 --to-deg 10000000"));
    assert!(many("--all-branches --step-deg 1 --to-deg 99999"));
    assert!(!many("--all-branches --step-deg 1 --to-deg 100000"));
}

#[test]
fn what_does_not_go_together() {
    for (line, due) in [
        ("", true),
        ("--all-branches", true),
        ("--svg d", true),
        ("--dxf d", true),
        ("--format html", true),
        ("--digits 5", true),
        ("--digits 5 --svg d --dxf d", true),
        ("--all-branches --digits 5", true),
        ("--all-branches --svg d", false),
        ("--all-branches --dxf d", false),
        ("--all-branches --format html", false),
        ("--digits 5 --format html", false),
        ("--digits 5 --format json", true),
    ] {
        assert_eq!(args(line).consistent().is_ok(), due, "{line}");
    }
    for (line, due) in [("", true), ("--paths", false), ("--reactions", false)] {
        assert_eq!(args(line).only_planar().is_ok(), due, "{line}");
    }
}

/// A length is that of the drawing where no column has one.
#[test]
fn units_of_the_columns() {
    let columns = |line: &str, names: &[&str]| {
        let names = names.iter().map(|n| n.to_string()).collect();
        args(line).columns(names, false).map(|c| c.names)
    };
    let angles = ["phi1_deg", "branch"];
    let both = ["phi1_deg", "slider_m"];
    assert_eq!(
        columns("--units rad", &angles).unwrap(),
        ["phi1_rad", "branch"]
    );
    assert!(columns("--units mm", &angles).is_err());
    assert!(columns("--units kg --dxf d", &angles).is_err());
    assert_eq!(columns("--units mm --dxf d", &angles).unwrap(), angles);
    assert_eq!(
        columns("--units mm --dxf d", &both).unwrap(),
        ["phi1_deg", "slider_mm"]
    );
    let found = columns("--units mm,rad --dxf d", &angles).unwrap();
    assert_eq!(found, ["phi1_rad", "branch"]);
}

#[test]
fn units_of_length() {
    for unit in ["m", "mm", " in ", "um"] {
        assert!(shown::is_length(unit), "{unit}");
    }
    for unit in ["deg", "kg", "m/s", "", "furlong"] {
        assert!(!shown::is_length(unit), "{unit}");
    }
}

#[test]
fn windows_of_a_linkage_of_class_iii() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let columns = || Columns::from(class_iii::names(&linkage, false));
    let shown = |line: &str, branch: &Branch| {
        let args = args(line);
        let grid = args.grid(linkage.start_degrees()).unwrap();
        let (plan, columns) = (plan(&grid, branch), columns());
        let motion = shown::class_iii(&args, &linkage, branch, Some((&plan, &columns))).unwrap();
        assert!(motion.courses.len() > 3);
        let lengths = motion.courses.iter().map(|c| c.variants[0].1.len());
        assert!(lengths.into_iter().all(|n| n == motion.drive.values.len()));
        motion
    };
    // All that there is: 720 positions of the turn, from the file's start on.
    let all = shown("", &whole);
    assert_eq!(
        (all.drive.values.len(), all.start, all.closed),
        (720, 0, true)
    );
    assert!((shown_first(&all) - 14.426).abs() < 1e-9);
    let turns = |turns| Branch {
        reach: Reach::Whole { turns },
        ..whole.clone()
    };
    for (line, turned, due) in [
        ("--step-deg 90", Some(1), true),
        ("--from-deg 5 --step-deg 90", Some(1), true),
        ("--to-deg 300 --step-deg 90", Some(1), false),
        ("--step-deg 90", Some(2), false),
        ("--step-deg 90", None, false),
        ("--to-deg 300 --step-deg 90", Some(2), false),
    ] {
        let motion = shown(line, &turns(turned));
        assert_eq!((motion.closed, motion.start), (due, 0), "{line}");
    }
    let motion = shown("--from-deg 5 --to-deg 185 --step-deg 45", &whole);
    let due = [5.0, 50.0, 95.0, 140.0, 185.0];
    let near = |a: &[f64], b: &[f64]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
    };
    assert!(
        near(&motion.drive.values, &due),
        "{:?}",
        motion.drive.values
    );
}

/// Two turns are asked for, of a crank that does not turn: every position once, by its angle.
#[test]
fn a_part_of_a_turn_is_in_order() {
    let linkage = screen(SHORT);
    let part = branch(&linkage);
    let columns = Columns::from(class_iii::names(&linkage, false));
    let window = args("--from-deg 0 --to-deg 720 --step-deg 30");
    let plan = plan(&window.grid(None).unwrap(), &part);
    let motion = shown::class_iii(&window, &linkage, &part, Some((&plan, &columns))).unwrap();
    assert!(!motion.closed);
    // From -96.6 to more than 173 degrees.
    let due: Vec<f64> = (-3..=5).map(|k| 30.0 * f64::from(k)).collect();
    let found = &motion.drive.values;
    assert!(
        found.len() == due.len() && found.iter().zip(&due).all(|(a, b)| (a - b).abs() < 1e-9),
        "{found:?}"
    );
    let all = args("");
    let motion = shown::class_iii(&all, &linkage, &part, Some((&plan, &columns))).unwrap();
    assert!(!motion.closed && motion.drive.values.len() > 700);
}

/// At `--from-deg` on the branch's own count of turns, or at the start.
#[test]
fn a_position_of_a_linkage_of_class_iii() {
    for (text, line, due) in [
        (SCREEN, "", Some(14.426)),
        (SCREEN, "--from-deg 100", Some(100.0)),
        (SHORT, "", Some(14.426)),
        (SHORT, "--from-deg 300", Some(-60.0)),
        (SHORT, "--from-deg -60", Some(-60.0)),
        (SHORT, "--from-deg 200", None),
    ] {
        let linkage = screen(text);
        let found = shown::class_iii(&args(line), &linkage, &branch(&linkage), None);
        match (&found, due) {
            (Ok(motion), Some(due)) => {
                let first = shown_first(motion);
                assert!((first - due).abs() < 1e-9, "{line}: {first}");
                assert!(motion.courses.is_empty());
            }
            _ => assert!(found.is_err() && due.is_none(), "{line}"),
        }
    }
}

#[test]
fn angles_on_the_branchs_own_count_of_turns() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let end = |reached: f64| End {
        phi1: reached,
        reached,
        phi4: 0.0,
    };
    let part = Branch {
        reach: Reach::Part {
            low: end(-1.0),
            high: end(1.0),
        },
        ..whole.clone()
    };
    for angle in [-7.0, 0.0, 40.0] {
        assert_eq!(shown::on_branch(angle, &whole), Some(angle));
    }
    for (angle, due) in [
        (1.0, Some(1.0)),
        (-1.0, Some(-1.0)),
        (0.5, Some(0.5)),
        (0.5 + TAU, Some(0.5)),
        (-0.5 - 2.0 * TAU, Some(-0.5)),
        (1.01, None),
        (-1.01, None),
        (PI, None),
    ] {
        let found = shown::on_branch(angle, &part);
        let same = match (found, due) {
            (Some(a), Some(b)) => f64::abs(a - b) < 1e-12,
            _ => found == due,
        };
        assert!(same, "{angle}: {found:?}");
    }
}

#[test]
fn windows_of_dyads() {
    let rocking = four_bar([1.0, 4.0, 3.0, 3.5]);
    // It reaches from 15.4 to 344.6 degrees.
    let held = four_bar([3.0, 4.0, 3.0, 3.5]);
    let shown = |line: &str, dyad: &Dyad| {
        let args = args(line);
        let grid = args.grid(dyad.start.clone()).unwrap();
        let columns = Columns::from(mechaudit::machine::dyad::names(dyad));
        let motion = shown::dyad(&args, dyad, ASSEMBLIES[0], Some((&grid, &columns))).unwrap();
        assert!(motion.courses.len() > 3);
        motion
    };
    for (line, dyad, due, closed) in [
        (
            "--step-deg 90",
            &rocking,
            &[0.0, 90.0, 180.0, 270.0][..],
            true,
        ),
        (
            "--step-deg 90 --to-deg 180",
            &rocking,
            &[0.0, 90.0, 180.0],
            false,
        ),
        (
            "--step-deg 90 --from-deg -90",
            &rocking,
            &[-90.0, 0.0, 90.0, 180.0],
            true,
        ),
        // Where it is, however it is counted.
        (
            "--step-deg 60 --from-deg -180 --to-deg 180",
            &held,
            &[60.0, 120.0, 180.0, 240.0, 300.0],
            false,
        ),
        (
            "--step-deg 60 --from-deg 360 --to-deg 480",
            &held,
            &[60.0, 120.0],
            false,
        ),
        ("--step-deg 120", &held, &[120.0, 240.0], false),
    ] {
        let motion = shown(line, dyad);
        let found = &motion.drive.values;
        let same = found.iter().zip(due).all(|(a, b)| f64::abs(a - b) < 1e-9);
        assert!(same && found.len() == due.len(), "{line}: {found:?}");
        assert_eq!((motion.closed, motion.start), (closed, 0), "{line}");
    }
    let motion = shown("", &rocking);
    assert_eq!((motion.drive.values.len(), motion.closed), (720, true));
    assert_eq!(shown_first(&motion), 0.0);
    let motion = shown("", &held);
    assert!(!motion.closed && motion.drive.values.len() > 700);
}

#[test]
fn a_position_of_a_dyad() {
    let rocking = four_bar([1.0, 4.0, 3.0, 3.5]);
    let held = four_bar([3.0, 4.0, 3.0, 3.5]);
    for (dyad, line, due) in [
        (&rocking, "", Some(0.0)),
        (&rocking, "--from-deg 75", Some(75.0)),
        (&held, "--from-deg 100", Some(100.0)),
        (&held, "--from-deg -100", Some(260.0)),
        (&held, "--from-deg 0", None),
    ] {
        let found = shown::dyad(&args(line), dyad, ASSEMBLIES[1], None);
        match (&found, due) {
            (Ok(motion), Some(due)) => {
                assert!((shown_first(motion) - due).abs() < 1e-9, "{line}");
                assert!(motion.courses.is_empty());
            }
            _ => assert!(found.is_err() && due.is_none(), "{line}"),
        }
    }
    // Nobody has asked for 0 degrees, where it does not reach.
    let motion = shown::dyad(&args(""), &held, ASSEMBLIES[0], None).unwrap();
    assert!((15.0..17.0).contains(&shown_first(&motion)));
}

fn mechanism(text: &str) -> (Box<mechanisms::Machine>, mechanisms::Branch) {
    let machine::Linkage::Planar(machine) = read(text) else {
        unreachable!("bodies and joints")
    };
    let at = machine.start.at.unwrap_or(0.0);
    let at = if machine.rotary() {
        at.to_radians()
    } else {
        at
    };
    let branch = mechanisms::choose(&machine, at, None).unwrap();
    (machine, branch)
}

/// The motion over what `line` asks for, with the values of the drive in degrees or metres.
fn mechanism_shown(text: &str, line: &str, turns: Option<Option<u32>>) -> Motion {
    let (machine, mut branch) = mechanism(text);
    if let Some(turns) = turns {
        branch.reach = mechanisms::Reach::Whole { turns };
    }
    let args = args(line);
    let grid = args
        .grid(machine.start.at.and_then(Rational::from_f64))
        .unwrap();
    let degrees = (0..grid.count as i64).map(|k| nearest_f64(&grid.angle(k)));
    let drives: Vec<(f64, f64)> = degrees.map(|d| (d, d.to_radians())).collect();
    let columns = mechanisms::Columns {
        paths: false,
        reactions: false,
    };
    let window = shown::Window {
        drives: &drives,
        named: &Columns::from(mechanisms::names(&machine, columns)),
        columns,
    };
    let motion = shown::planar(&args, &machine, &branch, Some(window)).unwrap();
    assert!(motion.courses.len() > 3);
    motion
}

#[test]
fn windows_of_mechanisms() {
    for (line, turned, due) in [
        ("--step-deg 90", Some(1), true),
        ("--from-deg 5 --step-deg 90", Some(1), true),
        ("--to-deg 300 --step-deg 90", Some(1), false),
        ("--step-deg 90", Some(2), false),
        ("--step-deg 90", None, false),
        ("--to-deg 300 --step-deg 90", Some(2), false),
    ] {
        let motion = mechanism_shown(WATT_2, line, Some(turned));
        assert_eq!((motion.closed, motion.start), (due, 0), "{line}");
    }
    let motion = mechanism_shown(WATT_2, "--from-deg 5 --to-deg 185 --step-deg 45", None);
    let due = [5.0, 50.0, 95.0, 140.0, 185.0];
    let found = &motion.drive.values;
    assert!(
        found.len() == 5 && found.iter().zip(due).all(|(a, b)| (a - b).abs() < 1e-9),
        "{found:?}"
    );
    // From the start on, all round.
    let all = mechanism_shown(WATT_2, "", None);
    assert_eq!((all.drive.values.len(), all.closed), (720, true));
    // Two turns of a crank that does not turn: each position once.
    let part = mechanism_shown(CELL, "--from-deg 0 --to-deg 720 --step-deg 30", None);
    let found = &part.drive.values;
    assert!(
        found.len() > 2 && found.windows(2).all(|w| (w[1] - w[0] - 30.0).abs() < 1e-6),
        "{found:?}"
    );
    assert!(!part.closed);
    // A displacement has no window of angles.
    let boom = |line| mechanism_shown(BOOM, line, None).drive.values;
    let all = boom("");
    assert!(all.len() > 700 && (all[0] - 0.9).abs() < 1e-9);
    assert_eq!(boom("--step-deg 90"), all);
}

#[test]
fn a_position_of_a_mechanism() {
    for (text, line, due) in [
        (WATT_2, "--from-deg 75", Some(75.0)),
        (CELL, "--from-deg 30", Some(30.0)),
        (CELL, "--from-deg 390", Some(30.0)),
        (CELL, "--from-deg 170", None),
        (BOOM, "", Some(1.0)),
    ] {
        let (machine, branch) = mechanism(text);
        let found = shown::planar(&args(line), &machine, &branch, None);
        match (&found, due) {
            (Ok(motion), Some(due)) => {
                let first = shown_first(motion);
                assert!((first - due).abs() < 1e-9, "{line}: {first}");
                assert!(motion.courses.is_empty());
            }
            _ => assert!(found.is_err() && due.is_none(), "{line}"),
        }
    }
}

#[test]
fn a_page_without_positions_is_refused() {
    let linkage = screen(SCREEN);
    let whole = branch(&linkage);
    let mut motion = shown::class_iii(&args("--from-deg 0"), &linkage, &whole, None).unwrap();
    let mut out = Vec::new();
    assert_eq!(
        shown::page(&mut out, &motion, &[]).unwrap(),
        Outcome::AsExpected
    );
    assert!(out.starts_with(b"<!doctype html>") || out.starts_with(b"<!DOCTYPE html>"));
    motion.drive.values.clear();
    out.clear();
    assert!(shown::page(&mut out, &motion, &[]).is_err() && out.is_empty());
}

/// The rows of a linkage of class III and what stands beside them, by way of a file.
fn written(text: &str, line: &str) -> (Outcome, Value) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("rows.json");
    let line = format!("{line} --format json --output {}", file.display());
    let outcome = of_class_iii(&args(&line), &screen(text)).unwrap();
    let text = std::fs::read_to_string(&file).unwrap();
    (outcome, serde_json::from_str(&text).unwrap())
}

fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

/// Far from the start, too, and round the turn.
#[test]
fn certified_rows_are_those_in_floating_point() {
    for line in ["--from-deg 100 --to-deg 160 --step-deg 30", "--step-deg 72"] {
        let (_, floats) = written(SCREEN, line);
        let (outcome, digits) = written(SCREEN, &format!("{line} --digits 12"));
        assert_eq!(outcome, Outcome::AsExpected);
        let [floats, digits] = [&floats, &digits].map(|v| v["rows"].as_array().unwrap());
        assert_eq!(floats.len(), digits.len());
        for (a, b) in floats.iter().zip(digits) {
            for name in ["phi1_deg", "phi2_deg", "phi4_deg"] {
                let (a, b) = (number(&a[name]), number(&b[name]));
                assert!((a - b).abs() < 1e-9, "{line} {name}: {a} {b}");
            }
        }
    }
}

/// Every mode at every angle, those of a fold by the numbers of both branches.
#[test]
fn all_branches_of_a_linkage_of_class_iii() {
    let (outcome, found) = written(SHORT, "--all-branches --step-deg 30");
    assert_eq!(outcome, Outcome::AsExpected);
    let rows = found["rows"].as_array().unwrap();
    let count = found["branches"].as_u64().unwrap();
    let numbers: std::collections::BTreeSet<u64> =
        rows.iter().map(|r| r["branch"].as_u64().unwrap()).collect();
    assert_eq!(numbers, (0..count).collect());
    let folds = found["folds"].as_array().unwrap();
    assert!(!folds.is_empty());
    for fold in folds {
        assert_eq!(fold["branches"].as_array().unwrap().len(), 2, "{fold}");
        assert!(fold["phi1_deg"].is_number() && fold["phi4_deg"].is_number());
        assert!(fold["begins"].is_boolean());
    }
    // The crank's end turns about the origin, whatever the mode: with digits there are the same rows.
    let (outcome, digits) = written(SHORT, "--all-branches --step-deg 90 --digits 9");
    let (_, floats) = written(SHORT, "--all-branches --step-deg 90");
    assert_eq!(outcome, Outcome::AsExpected);
    let [floats, digits] = [&floats, &digits].map(|v| v["rows"].as_array().unwrap());
    assert_eq!(floats.len(), digits.len());
    for (a, b) in floats.iter().zip(digits) {
        assert_eq!(a["branch"], b["branch"]);
        let (a, b) = (number(&a["phi4_deg"]), number(&b["phi4_deg"]));
        assert!((a - b).abs() < 1e-6, "{a} {b}");
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
        Value::Object(dyad_facts::json(dyad, assemblies))
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

use super::*;
use crate::cli::args::{Args, Command};
use clap::Parser;
use mechaudit::machine::Source;
use mechaudit::machine::class_iii::{End, Reach};
use mechaudit::machine::dyad::{ASSEMBLIES, Dyad};
use mechaudit::machine::{class_iii, planar as mechanisms};
use mechaudit::motion::Motion;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

mod facts;
mod shown;

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

/// The position shown first, in degrees.
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
    // The number of rows has a limit, which is lower where all branches are kept.
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
        assert_eq!(args(line).not_of_class_iii().is_ok(), due, "{line}");
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
    // The crank's end turns about the origin, whatever the mode: with digits there are the same
    // rows.
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

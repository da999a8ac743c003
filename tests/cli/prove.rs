//! Proofs of error bounds on the command line.

use crate::common::{command, refused, run, text};
use serde_json::Value;
use tempfile::tempdir;

#[test]
fn options_that_do_not_belong_to_a_proof_are_refused() {
    for (line, said) in [
        ("prove erf --norm 2", "--norm is for faddeeva alone"),
        ("prove erf --part lower", "--part is for faddeeva alone"),
        ("prove erf --within 3", "--within is for faddeeva alone"),
        (
            "prove faddeeva --part real --norm 3",
            "--norm is for faddeeva alone",
        ),
        ("prove erf --component nan", "must be a positive number"),
        ("prove gamma", "possible values: faddeeva, erf"),
        ("prove faddeeva --within -1", "must be a positive number"),
        (
            "prove faddeeva --part lower --norm 3",
            "--norm is for the upper half-plane",
        ),
        (
            "prove faddeeva --part lower --component 3",
            "--component is for the upper half-plane",
        ),
    ] {
        refused(&command(line), said);
    }
}

/// The bound is that of the method's audit, and the intervals of the file are those that are
/// counted.
#[test]
fn a_proof_on_the_real_line() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("boxes.csv");
    let d = run(&["prove", "erf", "--format", "json", "--boxes", text(&file)]);
    assert_eq!(d.code, 0, "{}", d.err);
    let found: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(found["proved"], true);
    let rows = std::fs::read_to_string(&file).unwrap().lines().count() - 1;
    let counted = found["formulas"].as_array().unwrap().iter();
    let counted: u64 = counted.map(|f| f["intervals"].as_u64().unwrap()).sum();
    assert_eq!(rows as u64, counted);
    let audit = command("audit erf --cases 1 --format json").out;
    let audit: Value = serde_json::from_str(&audit).unwrap();
    let proved = audit["methods"][0]["proved"][0]["ulps"].as_f64().unwrap();
    assert!(
        found["ulps"]["bound"].as_f64().unwrap() <= proved,
        "{found}"
    );
}

/// All four of them, each as it is proved alone.
#[test]
fn the_real_line_is_four_proofs() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("intervals.csv");
    let d = run(&[
        "prove",
        "faddeeva",
        "--part",
        "real",
        // The theorem itself is a test of the proofs.
        "--component",
        "2",
        "--format",
        "json",
        "--boxes",
        text(&file),
    ]);
    assert_eq!(d.code, 0, "{}", d.err);
    let found: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(found["proved"], true);
    let all = found["functions"].as_array().unwrap();
    let names: Vec<&str> = all
        .iter()
        .map(|f| f["function"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["erf", "erfc", "erfcx", "dawson"]);
    let lines = std::fs::read_to_string(&file).unwrap();
    for f in all {
        let begins = format!("{},", f["function"].as_str().unwrap());
        let rows = lines.lines().filter(|l| l.starts_with(&begins)).count();
        assert_eq!(f["intervals"].as_u64().unwrap(), rows as u64);
    }
}

//! `mechaudit regenerate`, and the files it makes as somebody without this crate reads them.

use crate::common::{csv, names, refused, run, text, words};
use mechaudit::methods;
use mechaudit::reference::{Ball, Decimal, HexFloat};
use std::path::{Path, PathBuf};
use tempfile::{TempDir, tempdir};

const VALUES: &str = "reference/values";

fn sources() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Folders like those of the sources, with one file of values.
fn copy(name: &str, change: impl Fn(&str) -> String) -> (TempDir, PathBuf) {
    let root = tempdir().unwrap();
    for folder in [
        VALUES,
        "reference/published",
        "src/solvers/special/faddeeva",
    ] {
        std::fs::create_dir_all(root.path().join(folder)).unwrap();
    }
    let file = Path::new(VALUES).join(format!("{name}.csv"));
    let held = std::fs::read_to_string(sources().join(&file)).unwrap();
    let path = root.path().join(file);
    std::fs::write(&path, change(&held)).unwrap();
    (root, path)
}

#[test]
fn what_is_held_is_what_the_references_give() {
    let some = words(
        "slider-crank erfcx zinchenko-errata arithmetic-tables faddeeva-constants faddeeva-tables \
         faddeeva-relatives-tables",
    );
    let d = run(&[&["regenerate", "--check"][..], &some].concat());
    assert_eq!((d.code, d.err.as_str()), (0, ""), "{}", d.out);
    assert!(
        d.out.contains("7 of 7 files are what the references give"),
        "{}",
        d.out
    );
}

#[test]
fn a_tampered_file_is_named_with_its_first_line_that_differs() {
    let check = |root: &TempDir| {
        run(&[
            "regenerate",
            "--check",
            "--root",
            text(root.path()),
            "slider-crank",
        ])
    };
    let at = |change: &dyn Fn(&str) -> String| {
        let (root, path) = copy("slider-crank", change);
        let before = std::fs::read_to_string(&path).unwrap();
        let d = check(&root);
        assert_eq!(d.code, 1, "{}{}", d.out, d.err);
        assert_eq!(
            std::fs::read_to_string(&path).unwrap(),
            before,
            "nothing is written"
        );
        d.out
    };
    let due = std::fs::read_to_string(sources().join(VALUES).join("slider-crank.csv")).unwrap();
    let last = due.lines().count();
    // A digit in the last line.
    let out = at(&|held| format!("{}7\n", held.trim_end()));
    assert!(
        out.contains(&format!("slider-crank.csv: line {last}, column")),
        "{out}"
    );
    assert!(out.contains("does not match the digest"), "{out}");
    // The header alone: the digest of the content still holds.
    let seed = 1 + due.lines().position(|l| l == "# seed: 1").expect("a seed");
    let out = at(&|held| held.replace("# seed: 1", "# seed: 2"));
    assert!(
        out.contains(&format!("slider-crank.csv: line {seed}, column 9")),
        "{out}"
    );
    assert!(!out.contains("digest"), "{out}");
    let out = at(&|held| held.replace("SHA-256 of all lines below", "SHA-1"));
    assert!(out.contains("there is no digest in its header"), "{out}");
    let (root, path) = copy("slider-crank", str::to_string);
    assert_eq!(check(&root).code, 0);
    std::fs::remove_file(path).unwrap();
    let d = check(&root);
    assert!(
        d.code == 1 && d.out.contains("it is not there"),
        "{}",
        d.out
    );
}

#[test]
fn files_are_made_anew() {
    let (root, path) = copy("slider-crank", |_| "stale".into());
    let write = || run(&["regenerate", "--root", text(root.path()), "slider-crank"]);
    let d = write();
    assert!(
        d.code == 0 && d.out.contains("slider-crank.csv: written"),
        "{}",
        d.out
    );
    let due = std::fs::read(sources().join(VALUES).join("slider-crank.csv")).unwrap();
    assert!(std::fs::read(&path).unwrap() == due);
    assert_eq!(names(path.parent().unwrap()), ["slider-crank.csv"]);
    assert!(write().out.contains("as held"));
}

#[test]
fn bad_usage() {
    refused(
        &run(&["regenerate", "--check", "no-such-file"]),
        "there is no generated file \"no-such-file\"; there are: tridiagonal, ",
    );
    refused(
        &run(&["regenerate", "--check", "--root", "examples"]),
        "examples holds no reference/values",
    );
}

#[test]
fn every_method_has_values_and_every_file_is_small() {
    let mut due: Vec<String> = methods::registry()
        .iter()
        .map(|m| format!("{}.csv", m.name()))
        .collect();
    due.push("sand-screen-run-up.csv".into());
    due.push("andrews-motion.csv".into());
    due.push("n-four-bar-motion.csv".into());
    due.sort();
    let folder = sources().join(VALUES);
    assert_eq!(names(&folder), due);
    for name in due {
        let size = std::fs::metadata(folder.join(&name)).unwrap().len();
        assert!(size < 60_000, "{name}: {size} bytes");
    }
}

/// As somebody with nothing but a file reads it: the solver is within its radius and a few ulps.
#[test]
fn values_can_be_tested_against() {
    let method = methods::find("faddeeva").unwrap();
    let path = sources().join(VALUES).join("faddeeva.csv");
    let (head, rows) = csv(&std::fs::read_to_string(path).unwrap());
    assert_eq!(
        head,
        ["region", "case", "input", "value", "radius", "condition"]
    );
    let mut tested = 0;
    for row in rows {
        let input = row[2].split(' ').map(|x| match HexFloat::parse(x) {
            Ok(x) => x.to_f64(),
            Err(_) => x.parse().expect("inf or nan"),
        });
        let input: Vec<f64> = input.collect();
        let mechaudit::audit::SolverAnswer::Values(got) = method.solve(&input) else {
            panic!("{row:?}");
        };
        let (values, radii) = (row[3].split(' '), row[4].split(' '));
        for ((value, radius), got) in values.zip(radii).zip(got) {
            if ["nan", "inf", "-inf"].contains(&value) {
                assert_eq!(value.parse::<f64>().unwrap().is_nan(), got.is_nan());
                continue;
            }
            let exactly = |text: &str| Decimal::parse(text).unwrap().value;
            let due = Ball::rational(128, &exactly(value));
            let radius = Ball::rational(128, &exactly(radius));
            let size = due.to_f64().abs();
            if got.is_finite() && size > 1e-290 {
                let off = (Ball::exact(128, got) - &due).abs();
                let allowed = Ball::exact(128, 4.0 * f64::EPSILON * size) + &radius;
                assert!(off.upper() <= allowed.lower(), "{row:?}");
                assert!(radius.to_f64() <= 1e-20 * size, "{row:?}");
                tested += 1;
            }
        }
    }
    assert!(tested > 100, "{tested}");
}

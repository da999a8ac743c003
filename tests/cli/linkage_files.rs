//! `mechaudit linkage`: files that are refused, files that are written.

use crate::common::{cells, drawing, names, refused, run, text};
use crate::linkage::{linkage_of, screen};
use std::path::PathBuf;
use tempfile::tempdir;

#[test]
fn bad_files() {
    fn bad(text: impl AsRef<[u8]>, part: &str) {
        refused(&linkage_of(text, &["--step-deg", "10"]), part);
    }
    bad(b"", "the file is empty");
    bad(b" \n\t\n", "the file is empty");
    bad(b"name = \"\xff\xfe\"", "not UTF-8");
    bad(b"[geometry", "line 1");
    bad(b"{\"geometry\": ", "line 1");
    bad(
        b"name = \"x\"",
        "type is missing: it is \"class-iii\", \"four-bar\"",
    );
    bad(b"type = \"class-iii\"", "[geometry] is missing");
    let changes = r#"
        l5 = "48.5 cm" |                    | geometry.l5 is missing
        l5 = "48.5 cm" | l5 = 48.5          | write for instance "48.5 cm"
        l5 = "48.5 cm" | l5 = nan           | geometry.l5
        l5 = "48.5 cm" | l5 = "nan cm"      | geometry.l5
        l5 = "48.5 cm" | l5 = "48.5 kg"     | is not a length
        l5 = "48.5 cm" | l5 = "1e400 cm"    | l5 = inf is not a finite number
        l5 = "48.5 cm" | l5 = true          | a string with a number and its unit
        l5 =           | l7 = "1 cm"\nl5 =  | unknown field `l7`
        "550 kg"       | "-550 kg"          | mass of link 4 = -550 kg must not be negative
        "18 kg m^2"    | "18 kg"            | is not a moment of inertia
        [bodies.5]     | [bodies.9]         | [bodies.9]
        class-iii      | class-ix           | type = "class-ix"
    "#;
    for [from, to, part] in cells(changes) {
        bad(screen(&from, &to), &part);
    }
    bad(
        include_bytes!("../../examples/unassemblable.toml"),
        "cannot be assembled",
    );
    refused(
        &run(&["linkage", "no/such/file.toml", "--step-deg", "1"]),
        "no/such/file.toml",
    );
    refused(
        &run(&["linkage", "examples", "--step-deg", "1"]),
        "examples",
    );
}

#[test]
fn bad_steps_and_windows() {
    let with = |args: &[&str]| run(&[&["linkage", "examples/sand-screen.toml"], args].concat());
    for step in ["0", "-1", "-0.0"] {
        refused(&with(&["--step-deg", step]), "--step-deg must be positive");
    }
    for step in ["nan", "inf", "x", ""] {
        refused(&with(&["--step-deg", step]), "--step-deg");
    }
    refused(
        &with(&["--step-deg", "1e-9"]),
        "more than 10000000 crank angles",
    );
    refused(&with(&["--step-deg", "1e-99999"]), "take a larger step");
    refused(
        &with(&["--step-deg", "1e-4", "--all-branches"]),
        "more than 100000",
    );
    refused(
        &with(&["--step-deg", "1", "--from-deg", "9", "--to-deg", "8"]),
        "--to-deg 8",
    );
    // Without a step: every 7.5 degrees.
    let d = with(&[]);
    assert_eq!((d.code, d.out.lines().count()), (0, 49));
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let folder = tempdir().unwrap();
    let at = folder.path().join("rows.csv");
    let args = ["linkage", "examples/sand-screen.toml", "--step-deg", "60"];
    let d = run(&[&args[..], &["--output", text(&at)]].concat());
    assert_eq!((d.code, d.out.as_str()), (0, ""));
    let direct = run(&args);
    assert_eq!(std::fs::read_to_string(&at).unwrap(), direct.out);
    assert_eq!(names(folder.path()), ["rows.csv"]);
    // A refusal leaves the old file alone.
    let bad = [
        "linkage",
        "examples/unassemblable.toml",
        "--step-deg",
        "60",
        "--output",
        text(&at),
    ];
    refused(&run(&bad), "cannot be assembled");
    assert_eq!(std::fs::read_to_string(&at).unwrap(), direct.out);
    assert_eq!(names(folder.path()), ["rows.csv"]);
    let nowhere: PathBuf = folder.path().join("missing").join("rows.csv");
    refused(
        &run(&[&args[..], &["--output", text(&nowhere)]].concat()),
        "cannot write",
    );
}

#[test]
fn the_pictures_beside_the_examples_are_whole() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/pictures");
    let files = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path());
    let svgs = files.map(|f| std::fs::read_to_string(f).unwrap());
    assert_eq!(svgs.filter(|svg| !drawing(svg).is_empty()).count(), 10);
}

#[test]
fn a_drawing_folder_that_cannot_be_made_stops_the_run_before_any_row() {
    for file in ["examples/sand-screen.toml", "examples/four-bar.toml"] {
        let d = run(&["linkage", file, "--svg", "README.md"]);
        refused(&d, "cannot make the folder README.md");
    }
}

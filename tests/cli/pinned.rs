//! Outputs that are the same from run to run, by their digests: a change has to be meant.
//!
//! The numbers are tested elsewhere. Here layouts, drawings and pages are held, whose marks
//! no other test names. To see what has changed, run the command before and after.

use crate::common::{Done, command, digest, pin, text};
use std::fmt::Write;
use std::path::Path;
use tempfile::tempdir;

/// A line for the output, one for the messages, and one for each file in the folder that `{}`
/// stands for.
fn outputs(name: &str, lines: &[&str]) {
    let mut all = String::new();
    for line in lines {
        let folder = tempdir().unwrap();
        let at = text(folder.path());
        let Done { code, out, err } = command(&line.replace("{}", at));
        let [out, err] = [out, err].map(|t| t.replace(at, "{}"));
        let timed = |line: &&str| !line.contains("cases a second");
        let out: String = out.split_inclusive('\n').filter(timed).collect();
        writeln!(all, "{line}").unwrap();
        writeln!(all, "  {code}, {}, {}", digest(out), digest(err)).unwrap();
        let files = std::fs::read_dir(folder.path()).unwrap();
        let mut files: Vec<_> = files.map(|f| f.unwrap().path()).collect();
        files.sort();
        for file in files {
            let name = file.file_name().map(Path::new).unwrap();
            let bytes = std::fs::read(&file).unwrap();
            writeln!(all, "  {}: {}", name.display(), digest(bytes)).unwrap();
        }
    }
    pin(name, &all);
}

#[test]
fn linkages() {
    let drawn = [
        "sand-screen",
        "four-bar",
        "slider-crank",
        "jansen-leg",
        "double-butterfly",
        "peaucellier-cell",
        "rack-and-wheel",
        "quick-return",
        "watt-1",
        "stephenson-3",
        "cylinder-boom",
        "sand-screen-bodies",
    ];
    let drawn = drawn.map(|name| {
        format!("linkage examples/{name}.toml --step-deg 30 --svg {{}} --dxf {{}} --format html")
    });
    let drawn = drawn.iter().map(String::as_str);
    let rows = [
        "linkage examples/no-full-turn.toml --all-branches --step-deg 30",
        "linkage examples/double-butterfly.toml --all-branches --step-deg 60",
        "linkage examples/n-four-bar.toml --step-deg 60",
        "linkage examples/andrews.toml --step-deg 60",
        "linkage examples/sand-screen-rotor.toml --step-deg 60 --format csv",
        "linkage examples/watt-2.toml --step-deg 60 --digits 30",
        "linkage examples/sand-screen.toml --step-deg 60 --digits 30",
        "linkage examples/slider-crank.toml --step-deg 60 --digits 30",
        "linkage examples/jansen-leg.toml --step-deg 60 --paths --units in,deg",
        "linkage examples/jansen-leg.toml --step-deg 90 --format json",
        "linkage examples/andrews.toml --step-deg 90 --format json",
        "linkage examples/sand-screen.toml --step-deg 90 --format json",
        "linkage examples/slider-crank.toml --step-deg 90 --format json",
        "linkage examples/unassemblable.toml",
    ];
    outputs("cli-linkages", &drawn.chain(rows).collect::<Vec<_>>());
}

#[test]
fn motions_in_time() {
    outputs(
        "cli-motions",
        &[
            "runup examples/four-bar-run-up.toml --svg {}",
            "runup examples/sand-screen-run-up.toml --svg {}",
            "chirp examples/chirp-run-up.toml --svg {}",
            "chirp examples/chirp-run-up.toml --harmonics 12 --svg {}",
            "chirp examples/chirp-run-down.toml --format csv",
            "chirp examples/chirp-run-up.toml --rows spectrum --units mm,deg",
            "chirp examples/chirp-run-up.toml --rows chart",
            "chirp examples/chirp-run-up.toml --rows spectrum --format json",
            "runup examples/four-bar-run-up.toml --format json",
        ],
    );
}

#[test]
fn audits() {
    outputs(
        "cli-audits",
        &[
            "list",
            "list --format json",
            "describe faddeeva",
            "describe slider-crank",
            "describe cubic-spline-clamped",
            "describe planar-linkage",
            "describe cam-law",
            "audit four-bar --cases 2",
            "audit cam-law --cases 2",
            "audit planar-reactions --cases 1",
            "audit faddeeva --cases 1 --format html",
            "audit cubic-spline-uniform --cases 1 --format html",
            "audit tridiagonal --cases 2 --format junit",
            "audit planar-reactions --cases 1 --format csv",
            "audit cam-law --cases 2 --format json",
            "points four-bar --count 3",
            "hunt slider-crank --evals 300 --hard {}",
            "converge spline-clamped",
            "converge spline-natural",
            "converge spline-not-a-knot --format json",
            "converge run-up-dop853-rotor",
        ],
    );
}

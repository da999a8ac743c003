//! The examples in other languages, each where its language is installed.

use std::path::Path;
use std::process::{Command, Stdio};

const PROGRAM: &str = env!("CARGO_BIN_EXE_mechaudit");
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Returns true if a program is there; says that the test is skipped if it is not.
fn there(program: &str) -> bool {
    let found = Command::new(program)
        .arg("--version")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    let found = found.is_ok_and(|s| s.success());
    if !found {
        eprintln!("skipped: {program} is not installed");
    }
    found
}

fn succeeds(command: &mut Command) -> String {
    let done = command.current_dir(ROOT).output().unwrap();
    let [out, err] = [done.stdout, done.stderr].map(|s| String::from_utf8_lossy(&s).into_owned());
    assert!(done.status.success(), "{command:?}\n{out}{err}");
    out
}

/// The whole command line of an audit that has to pass.
fn passes(arguments: &[&str]) -> String {
    succeeds(Command::new(PROGRAM).arg("audit").args(arguments))
}

/// With the program where a shell finds it.
fn with_program(command: &str) -> Command {
    let folder = Path::new(PROGRAM).parent().unwrap();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut c = Command::new(command);
    c.env("PATH", format!("{}:{path}", folder.display()));
    c
}

#[test]
fn a_candidate_in_cpp() {
    if !there("c++") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("four_bar");
    let flags = ["-std=c++17", "-O2", "-Wall", "-Wextra", "-Werror", "-o"];
    succeeds(
        Command::new("c++")
            .args(flags)
            .arg(&target)
            .arg("examples/candidates/four_bar.cpp"),
    );
    let exec = target.to_str().unwrap();
    let out = passes(&["four-bar", "--region", "crank-rocker", "--exec", exec]);
    assert!(out.contains("four-bar in C++ 1.0"), "{out}");
}

#[test]
fn a_candidate_in_rust_in_binary_frames() {
    let folder = tempfile::tempdir().unwrap();
    let target = folder.path().join("cyclic");
    succeeds(
        Command::new("rustc")
            .args(["--edition", "2024", "-O", "-D", "warnings", "-o"])
            .arg(&target)
            .arg("examples/candidates/cyclic_tridiagonal.rs"),
    );
    let exec = target.to_str().unwrap();
    let out = passes(&["cyclic-tridiagonal", "--binary", "--exec", exec]);
    assert!(out.contains("cyclic sweep in Rust 1.0"), "{out}");
}

#[test]
fn a_candidate_in_julia() {
    if !there("julia") {
        return;
    }
    let exec = "julia --startup-file=no examples/candidates/tridiagonal.jl";
    let region = ["--region", "well-scaled", "--cases", "50"];
    passes(&[&["tridiagonal"], &region[..], &["--exec", exec]].concat());
}

#[test]
fn an_audit_within_ctest() {
    if !there("cmake") || !there("cc") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let built = folder.path().to_str().unwrap();
    succeeds(with_program("cmake").args(["-S", "examples/audit-in-c", "-B", built]));
    succeeds(with_program("cmake").args(["--build", built]));
    let out = succeeds(with_program("ctest").args(["--test-dir", built, "--output-on-failure"]));
    assert!(
        out.contains("100% tests passed, 0 tests failed out of 2"),
        "{out}"
    );
}

#[test]
fn an_audit_within_pytest() {
    if !there("pytest") {
        return;
    }
    let out = succeeds(with_program("pytest").args([
        "-p",
        "no:cacheprovider",
        "examples/audit-in-python",
    ]));
    assert!(out.contains("2 passed"), "{out}");
}

#[test]
fn an_audit_within_julias_tests() {
    if !there("julia") {
        return;
    }
    let script = "examples/audit-in-julia/test/runtests.jl";
    succeeds(with_program("julia").args([
        "--startup-file=no",
        "--project=examples/audit-in-julia",
        script,
    ]));
}

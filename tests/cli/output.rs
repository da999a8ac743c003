//! `--output` and `--svg`: what is there already stays what it is.
#![cfg(unix)]

use crate::common::{done, names, program, refused, run, text};
use std::fs::{self, Permissions};
use std::io::Read;
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::path::Path;
use std::process::Command;

const POINTS: [&str; 4] = ["points", "tridiagonal", "--count", "1"];

fn points_to(path: &Path) -> crate::common::Done {
    run(&[&POINTS[..], &["--output", text(path)]].concat())
}

/// The form of the points.
fn expected() -> String {
    let d = run(&POINTS);
    assert_eq!(d.code, 0, "{}", d.err);
    d.out
}

fn written(path: &Path) {
    let d = points_to(path);
    assert_eq!((d.code, d.out.as_str(), d.err.as_str()), (0, "", ""));
}

fn file(folder: &Path, name: &str, mode: u32) -> std::path::PathBuf {
    let path = folder.join(name);
    fs::write(&path, "before").unwrap();
    fs::set_permissions(&path, Permissions::from_mode(mode)).unwrap();
    path
}

fn mode(path: &Path) -> u32 {
    fs::metadata(path).unwrap().mode() & 0o7777
}

#[test]
fn a_file_keeps_its_mode_and_owner() {
    let folder = tempfile::tempdir().unwrap();
    for bits in [0o600, 0o640, 0o755] {
        let path = file(folder.path(), "file", bits);
        // Another owner, if the test may give it one.
        let given = chown(&path, Some(4321), Some(4322)).is_ok();
        written(&path);
        assert_eq!(fs::read_to_string(&path).unwrap(), expected());
        assert_eq!(mode(&path), bits);
        let known = fs::metadata(&path).unwrap();
        assert!(!given || (known.uid(), known.gid()) == (4321, 4322));
        fs::remove_file(path).unwrap();
    }
    assert!(names(folder.path()).is_empty());
}

/// Whoever reads it has either all of the old one or all of the new.
#[test]
fn a_file_is_replaced_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "file", 0o644);
    let mut reader = fs::File::open(&path).unwrap();
    written(&path);
    let mut read = String::new();
    reader.read_to_string(&mut read).unwrap();
    assert_eq!(read, "before");
    assert_eq!(fs::read_to_string(&path).unwrap(), expected());
}

#[test]
fn a_file_keeps_its_other_names() {
    let folder = tempfile::tempdir().unwrap();
    let path = file(folder.path(), "one", 0o644);
    let other = folder.path().join("other");
    fs::hard_link(&path, &other).unwrap();
    written(&path);
    assert_eq!(fs::read_to_string(other).unwrap(), expected());
    assert_eq!(names(folder.path()), ["one", "other"]);
}

#[test]
fn a_link_is_written_through() {
    let folder = tempfile::tempdir().unwrap();
    let within = |name| folder.path().join(name);
    fs::create_dir(within("far")).unwrap();
    let target = file(&within("far"), "target", 0o640);
    symlink("far/target", within("second")).unwrap();
    symlink("second", within("first")).unwrap();
    symlink("far/new", within("dangling")).unwrap();
    symlink("round", within("round")).unwrap();
    written(&within("first"));
    written(&within("dangling"));
    for name in ["first", "second", "dangling"] {
        assert!(within(name).is_symlink(), "{name}");
    }
    for path in [&target, &within("far/new")] {
        assert_eq!(fs::read_to_string(path).unwrap(), expected());
    }
    assert_eq!(mode(&target), 0o640);
    assert_eq!(names(&within("far")), ["new", "target"]);
    refused(&points_to(&within("round")), "too many symbolic links");
}

#[test]
fn a_device_stays_one() {
    let folder = tempfile::tempdir().unwrap();
    // By way of a link, which is what a program that replaces things would replace.
    for (device, code) in [("/dev/null", 0), ("/dev/full", 2)] {
        if !Path::new(device).exists() {
            continue;
        }
        let link = folder.path().join("link");
        symlink(device, &link).unwrap();
        let d = points_to(&link);
        assert_eq!(d.code, code, "{}", d.err);
        let due = format!("mechaudit: cannot write {}: ", text(&link));
        assert!(code == 0 || d.err.starts_with(&due), "{}", d.err);
        assert!(link.is_symlink());
        fs::remove_file(link).unwrap();
    }
}

/// Whatever is written, and in whichever form: the message names the output, and no input.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_said_of_the_output() {
    let folder = tempfile::tempdir().unwrap();
    let [points, answers] = ["points", "answers"].map(|n| folder.path().join(n));
    fs::write(&points, "1,1\n").unwrap();
    fs::write(&answers, "1,1\n").unwrap();
    let judge = format!(
        "judge erf --inputs {} --values {}",
        text(&points),
        text(&answers)
    );
    for line in [
        "linkage examples/four-bar.toml --step-deg 30",
        "linkage examples/four-bar.toml --step-deg 30 --format json",
        "linkage examples/four-bar.toml --step-deg 30 --format html",
        "linkage examples/sand-screen.toml --step-deg 30",
        "linkage examples/jansen-leg.toml --step-deg 30",
        "linkage examples/jansen-leg.toml --step-deg 30 --format json",
        "chirp examples/chirp-run-up.toml --harmonics 4",
        "chirp examples/chirp-run-up.toml --harmonics 4 --rows spectrum",
        "points erf --count 300",
        "audit tridiagonal --cases 1 --region well-scaled --format csv",
        "audit tridiagonal --cases 1 --region well-scaled --format json",
        "audit tridiagonal --cases 1 --region well-scaled --format html",
        "paper pmksweb --format csv",
        &judge,
        &format!("{judge} --format csv"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        let d = run(&[&words[..], &["--output", "/dev/full"]].concat());
        refused(
            &d,
            "mechaudit: cannot write /dev/full: No space left on device",
        );
        let standard = program()
            .args(&words)
            .stdout(fs::File::create("/dev/full").unwrap())
            .output();
        let d = done(standard.unwrap());
        let due = "mechaudit: cannot write standard output: No space left on device";
        assert_eq!(d.code, 2, "{line}: {}", d.err);
        assert!(
            d.err.lines().last().is_some_and(|l| l.starts_with(due)),
            "{line}: {}",
            d.err
        );
    }
}

#[test]
fn a_pipe_is_written_to() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&path).status().unwrap();
    assert!(made.success());
    let reader = Command::new("timeout")
        .args(["20", "cat", text(&path)])
        .stdout(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    written(&path);
    let read = done(reader.wait_with_output().unwrap());
    assert_eq!(read.out, expected());
    assert_eq!(names(folder.path()), ["pipe"]);
    // As a shell's >(command) is handed over.
    let script = "\"$0\" points tridiagonal --count 1 --output /dev/fd/3 3>&1 >&2 | cat";
    let mut shell = Command::new("sh");
    let shell = shell.args(["-c", script, env!("CARGO_BIN_EXE_mechaudit")]);
    let d = done(shell.output().unwrap());
    assert_eq!((d.out, d.err), (expected(), String::new()));
}

/// The contents of an open file stay.
#[test]
fn standard_output_by_its_names() {
    let folder = tempfile::tempdir().unwrap();
    let d = run(&[&POINTS[..], &["--output", "-"]].concat());
    assert_eq!((d.code, d.out), (0, expected()));
    assert!(!Path::new("-").exists());
    let path = file(folder.path(), "file", 0o644);
    let output = fs::OpenOptions::new().append(true).open(&path).unwrap();
    let link = folder.path().join("link");
    symlink("/dev/stdout", &link).unwrap();
    let mut program = program();
    let program = program.args(POINTS).args(["--output", text(&link)]);
    assert!(program.stdout(output).status().unwrap().success());
    assert_eq!(
        fs::read_to_string(&path).unwrap(),
        format!("before{}", expected())
    );
}

#[test]
fn what_cannot_be_written_is_refused_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let within = |name: &str| folder.path().join(name);
    let (begun, long) = (within("begun"), "a".repeat(300));
    let program = format!("sh -c 'touch {}'", text(&begun));
    let locked = file(folder.path(), "locked", 0o444);
    fs::create_dir(within("folder")).unwrap();
    for (path, part) in [
        (&locked, "it is read-only"),
        (&within("folder"), "it is a folder"),
        (&within("none/file"), "No such file"),
        (&locked.join("file"), "Not a directory"),
        (&within(&long), "name too long"),
    ] {
        let args = ["audit", "tridiagonal", "--exec", &program, "--output"];
        refused(&run(&[&args[..], &[text(path)]].concat()), part);
        refused(&points_to(path), part);
    }
    // A form that shows no changes, too.
    let args = [
        "audit",
        "tridiagonal",
        "--exec",
        &program,
        "--baseline",
        "none",
    ];
    refused(
        &run(&[&args[..], &["--format", "html"]].concat()),
        "text and json",
    );
    assert!(!begun.exists());
    assert_eq!(fs::read_to_string(&locked).unwrap(), "before");
}

#[test]
fn drawings_that_cannot_be_written_leave_everything_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let rows = folder.path().join("rows");
    let drawings = folder.path().join("drawings");
    fs::create_dir(&drawings).unwrap();
    for (command, example, drawing) in [
        ("linkage", "examples/sand-screen.toml", "reduced.svg"),
        ("linkage", "examples/slider-crank.toml", "mechanism.svg"),
        ("chirp", "examples/chirp-run-up.toml", "history.svg"),
        ("runup", "examples/sand-screen-run-up.toml", "run-up.svg"),
    ] {
        let locked = file(&drawings, drawing, 0o444);
        let args = [command, example, "--svg", text(&drawings), "--output"];
        let d = run(&[&args[..], &[text(&rows)]].concat());
        refused(&d, "it is read-only");
        assert_eq!(names(&drawings), [drawing]);
        fs::remove_file(locked).unwrap();
    }
    assert_eq!(names(folder.path()), ["drawings"]);
}

/// A program's audit goes where any other does.
#[test]
fn an_audit_of_a_program_goes_to_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("audit.json");
    let args = ["audit", "tridiagonal", "--cases", "1", "--exec", "true"];
    let more = ["--format", "json", "--output", text(&path)];
    let d = run(&[&args[..], &more].concat());
    assert_eq!((d.code, d.out.as_str()), (1, ""), "{}", d.err);
    let v: serde_json::Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    assert_eq!(v["methods"][0]["candidate"]["answered"], 0);
}

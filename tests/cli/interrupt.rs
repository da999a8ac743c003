//! The first Ctrl-C: a whole report of what is judged until then, and exit code 130.
#![cfg(unix)]

use crate::common::{self, Done, done, text};
use serde_json::Value;
use std::io::Write;
use std::os::unix::process::ExitStatusExt;
use std::process::{Child, Command};
use std::time::Duration;

const MANY: &str = "200000";

/// Waits until the program listens to Ctrl-C.
fn listening(child: &Child) {
    let pause = |ms| std::thread::sleep(Duration::from_millis(ms));
    let status = format!("/proc/{}/status", child.id());
    let listens = || {
        let text = std::fs::read_to_string(&status).ok()?;
        let mask = text.lines().find_map(|l| l.strip_prefix("SigCgt:"))?;
        let mask = u64::from_str_radix(mask.trim(), 16).ok()?;
        Some(mask & 1 << (2 - 1) != 0)
    };
    match listens() {
        // No Linux.
        None => pause(1000),
        Some(_) => (0..1000)
            .take_while(|_| listens() == Some(false))
            .for_each(|_| pause(2)),
    }
}

fn interrupt(child: &Child) {
    send(child, "-INT");
}

fn send(child: &Child, signal: &str) {
    let pid = child.id().to_string();
    let sent = Command::new("kill").args([signal, &pid]).status().unwrap();
    assert!(sent.success());
}

/// Time to judge something.
const PAUSE: Duration = Duration::from_millis(300);

/// Starts it, interrupts it once and waits for its end.
fn interrupted(args: &[&str]) -> Done {
    interrupted_after(PAUSE, args)
}

fn interrupted_after(pause: Duration, args: &[&str]) -> Done {
    let child = common::start(args);
    listening(&child);
    std::thread::sleep(pause);
    interrupt(&child);
    let d = done(child.wait_with_output().unwrap());
    assert_eq!(d.code, 130, "{args:?}: {}{}", d.out, d.err);
    d
}

fn json(d: &Done) -> Value {
    let v: Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(v["interrupted"], true, "{v}");
    v
}

/// The cases of the only method.
fn cases(v: &Value) -> (u64, u64) {
    let m = &v["methods"][0];
    assert_eq!(m["interrupted"], true);
    let count = |key: &str| m[key].as_u64().unwrap();
    (count("cases"), count("passed"))
}

#[test]
fn an_audit_in_every_form() {
    let audit = ["audit", "faddeeva", "--cases", MANY];
    let form = |f| interrupted(&[&audit[..], &["--format", f]].concat());
    let v = json(&form("json"));
    let (judged, passed) = cases(&v);
    assert!(judged > 0 && judged == passed);
    assert_eq!(v["passed"], false);
    let d = form("text");
    assert!(d.out.contains("interrupted"), "{}", d.out);
    assert!(d.out.contains("Interrupted: "), "{}", d.out);
    let d = form("html");
    assert!(d.out.trim_end().ends_with("</html>"));
    assert!(d.out.contains("interrupted"), "{}", d.out);
    let d = form("junit");
    let report = quick_junit::Report::deserialize_from_str(&d.out).unwrap();
    assert_eq!(report.test_suites[0].failures, 1, "{}", d.out);
    assert!(d.out.contains("interrupted"), "{}", d.out);
}

#[test]
fn a_file_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("audit.json");
    interrupted(&[
        "audit",
        "--cases",
        MANY,
        "--format",
        "json",
        "--output",
        text(&path),
    ]);
    let v: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(v["interrupted"], true);
    assert_eq!(common::names(folder.path()), ["audit.json"]);
}

/// Answers come, and then none for longer than anybody waits.
#[test]
fn a_program_under_audit_is_ended() {
    let program = "sh -c 'for i in 1 2 3; do read x; echo refuse; done; sleep 60'";
    let d = interrupted(&[
        "audit", "faddeeva", "--cases", MANY, "--exec", program, "--format", "json",
    ]);
    let v = json(&d);
    assert_eq!(
        (
            v["methods"][0]["candidate"]["answered"].as_u64(),
            v["passed"].as_bool()
        ),
        (Some(3), Some(false))
    );
    // Inputs that it was not asked about are no failures of its.
    assert_eq!(cases(&v).0, 3);
    let d = interrupted(&["audit", "faddeeva", "--cases", MANY, "--exec", program]);
    assert!(d.out.contains("interrupted"), "{}", d.out);
}

#[test]
fn judging_waits_for_no_more_answers() {
    let inputs = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(
        inputs.path(),
        "0x0p+0,0x0p+0\n0x1p+0,0x0p+0\n0x1p+0,0x1p+0\n",
    )
    .unwrap();
    let args = [
        "judge",
        "faddeeva",
        "--inputs",
        text(inputs.path()),
        "--values",
        "-",
    ];
    let mut child = common::start(&[&args[..], &["--format", "json"]].concat());
    let mut stdin = child.stdin.take().unwrap();
    stdin.write_all(b"1,0\n").unwrap();
    listening(&child);
    std::thread::sleep(PAUSE);
    interrupt(&child);
    let d = done(child.wait_with_output().unwrap());
    drop(stdin);
    assert_eq!(d.code, 130, "{}{}", d.out, d.err);
    let v = json(&d);
    assert_eq!(cases(&v), (1, 1));
    let trouble = &v["methods"][0]["candidate"]["trouble"];
    assert_eq!(trouble, "Interrupted after 1 answers.");
}

#[test]
fn a_hunt_says_what_it_found() {
    let d = interrupted(&["hunt", "faddeeva", "--evals", "2000000"]);
    assert!(d.out.contains("interrupted"), "{}", d.out);
    assert!(d.out.contains("of budget"), "{}", d.out);
}

#[test]
fn convergence_and_everything() {
    // All of it takes a quarter of a second.
    let args = ["converge", "--format", "json"];
    let v = json(&interrupted_after(Duration::ZERO, &args));
    assert!(v["approximations"].is_array());
    let d = interrupted_after(Duration::ZERO, &["converge"]);
    let last = d.out.lines().last().unwrap();
    assert!(
        last.starts_with("Interrupted: ") && last.ends_with(" approximations."),
        "{}",
        d.out
    );
    let d = interrupted(&["--cases", MANY]);
    // The verdict is the first line; papers are read to their end before any method begins.
    let verdict = "Interrupted: 0 papers with 0 findings; 0 methods pass, 0 cases.";
    assert!(d.out.starts_with(verdict), "{}", d.out);
}

/// A program that listens to nothing is ended by the second one.
#[test]
fn the_second_ends_at_once() {
    let child = common::start(&["audit", "run-up", "--cases", MANY, "--format", "json"]);
    listening(&child);
    std::thread::sleep(PAUSE);
    interrupt(&child);
    interrupt(&child);
    let d = done(child.wait_with_output().unwrap());
    assert_eq!(d.code, 130);
    // Nothing, or all of it.
    assert!(d.out.is_empty() || serde_json::from_str::<Value>(&d.out).is_ok());
}

/// Not even one that cannot be caught; whoever waits for the program learns which it was.
#[cfg(target_os = "linux")]
#[test]
fn no_signal_leaves_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("points");
    let points = ["points", "faddeeva", "--count", "500000"];
    let audit = ["audit", "faddeeva", "--cases", "500000"];
    for (args, signals) in [(&points, 0..4), (&audit, 1..4)] {
        for (signal, number) in &[("-INT", 2), ("-TERM", 15), ("-HUP", 1), ("-KILL", 9)][signals] {
            if common::is_ignored(signal) {
                continue;
            }
            let mut child = common::start(&[&args[..], &["--output", text(&path)]].concat());
            std::thread::sleep(PAUSE);
            send(&child, signal);
            let status = child.wait().unwrap();
            assert_eq!(
                status.signal(),
                Some(*number),
                "{args:?} {signal}: {status}"
            );
            let left = common::names(folder.path());
            assert!(left.is_empty(), "{args:?} {signal}: {left:?}");
        }
    }
}

/// `nohup` has its way.
#[cfg(target_os = "linux")]
#[test]
fn an_ignored_hang_up_stays_ignored() {
    let program = env!("CARGO_BIN_EXE_mechaudit");
    let script = "trap '' HUP; exec \"$0\" audit faddeeva --cases 500000";
    let mut child = Command::new("sh")
        .args(["-c", script, program])
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(PAUSE);
    listening(&child);
    send(&child, "-HUP");
    std::thread::sleep(PAUSE);
    assert!(child.try_wait().unwrap().is_none());
    child.kill().unwrap();
    child.wait().unwrap();
}

/// Also where whoever runs the tests ignores hang-ups: `env` gives them back.
#[cfg(target_os = "linux")]
#[test]
fn every_signal_that_ends_the_program_is_listened_to() {
    let env = |words: &[&str]| {
        let mut env = Command::new("env");
        env.arg("--default-signal=HUP").args(words);
        env.stdout(std::process::Stdio::null())
            .stderr(std::process::Stdio::null());
        env
    };
    if !env(&["true"]).status().is_ok_and(|s| s.success()) {
        return common::skipped("env --default-signal");
    }
    let program = env!("CARGO_BIN_EXE_mechaudit");
    let mut child = env(&[program, "audit", "faddeeva", "--cases", "500000"])
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let listens = |signal: u32| {
        let text = std::fs::read_to_string(&status).unwrap();
        let mask = text
            .lines()
            .find_map(|l| l.strip_prefix("SigCgt:"))
            .unwrap();
        u64::from_str_radix(mask.trim(), 16).unwrap() & 1 << (signal - 1) != 0
    };
    let mut patience = 500;
    while ![1, 2, 15].into_iter().all(listens) && patience > 0 {
        patience -= 1;
        std::thread::sleep(Duration::from_millis(5));
    }
    let all = [1, 2, 15].map(listens);
    child.kill().unwrap();
    child.wait().unwrap();
    assert_eq!(all, [true; 3]);
}

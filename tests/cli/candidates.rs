//! Programs in other languages under audit, good and bad ones.

use crate::common::{cells, command, file, refused, run, run_on, skipped};
use serde_json::Value;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const PROGRAM: &str = env!("CARGO_BIN_EXE_mechaudit");
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// An audit of `faddeeva` by a shell script in which `$W` is a right program: 45 check points and
/// five cases.
fn script(text: &str, more: &[&str]) -> (i32, Value) {
    let command = format!(
        "sh -c '{}'",
        text.replace("$W", &format!("{PROGRAM} eval faddeeva"))
    );
    let mut args = vec!["audit", "faddeeva", "--region", "mid", "--cases", "50"];
    args.extend(["--format", "json", "--exec", &command]);
    args.extend(more);
    let d = run(&args);
    let json = serde_json::from_str(&d.out).unwrap_or_else(|e| panic!("{e}: {}{}", d.out, d.err));
    (d.code, json)
}

/// (answers, cases, cases passed, what is said of the program)
fn counts(v: &Value) -> (u64, u64, u64, String) {
    let m = &v["methods"][0];
    let number = |x: &Value| x.as_u64().unwrap();
    let candidate = &m["candidate"];
    let trouble = candidate["trouble"].as_str().unwrap_or("").to_string();
    (
        number(&candidate["answered"]),
        number(&m["cases"]),
        number(&m["passed"]),
        trouble,
    )
}

#[test]
fn a_right_program_passes() {
    let (code, v) = script("exec $W", &[]);
    assert_eq!((code, counts(&v)), (0, (50, 50, 50, String::new())));
    assert_eq!(v["passed"], true);
    assert_eq!(v["methods"][0]["laws"].as_array().unwrap().len(), 0);
    let d = run(&[
        "audit",
        "faddeeva",
        "--cases",
        "5",
        "--exec",
        &format!("{PROGRAM} eval faddeeva"),
    ]);
    assert_eq!((d.code, d.err.as_str()), (0, ""), "{}", d.out);
    assert!(
        d.out.starts_with("faddeeva") && d.out.contains("pass"),
        "{}",
        d.out
    );
}

#[test]
fn nothing_judged_is_lost() {
    for (what, text, answered, passed, said) in [
        (
            "short",
            "$W | head -n 7",
            7,
            7,
            "exit status 0; 43 of 50 inputs are unanswered",
        ),
        (
            "crash",
            "head -n 4 | $W; kill -SEGV $$",
            4,
            4,
            "killed by signal 11; 46 of 50",
        ),
        ("status", "$W; exit 3", 50, 50, "then ended: exit status 3."),
        (
            "more",
            "$W; echo 1,2",
            50,
            50,
            "one more line than there are inputs",
        ),
        (
            "endless",
            "yes 1,2",
            50,
            0,
            "one more line than there are inputs",
        ),
        ("malformed", "$W | sed 3s/.*/what/", 50, 49, ""),
        ("too few values", "$W | sed 3s/,.*//", 50, 49, ""),
        ("blank", "$W | sed 3s/.*//", 50, 49, ""),
        ("comments", "echo \"# hello\"; $W", 50, 50, ""),
        (
            "wrong refusal",
            "$W | sed \"3s/.*/refuse singular/\"",
            50,
            49,
            "",
        ),
        ("nothing", "true", 0, 0, "50 of 50 inputs are unanswered"),
        (
            "deaf",
            "exec <&-; echo 1,2",
            1,
            0,
            "49 of 50 inputs are unanswered",
        ),
    ] {
        let (code, v) = script(text, &[]);
        let (a, cases, p, trouble) = counts(&v);
        assert_eq!((a, cases, p), (answered, 50, passed), "{what}: {trouble}");
        assert!(trouble.contains(said), "{what}: {trouble}");
        assert_eq!(trouble.is_empty(), said.is_empty(), "{what}: {trouble}");
        let good = what == "comments";
        assert_eq!(
            (code, &v["passed"]),
            (i32::from(!good), &Value::from(good)),
            "{what}"
        );
        let failures = v["methods"][0]["failures"].as_array().unwrap();
        let left_out = v["methods"][0]["failures_left_out"].as_u64().unwrap();
        assert_eq!(failures.len() as u64 + left_out, cases - p, "{what}");
        for f in failures {
            assert!(f["judgement"]["reason"].is_string(), "{what}: {f}");
            let again = f["reproduce"].as_str().unwrap();
            assert!(
                again.contains("--case") && again.contains("--exec"),
                "{again}"
            );
        }
    }
}

#[test]
fn a_silent_program_is_ended() {
    let start = Instant::now();
    for (text, answered) in [
        ("sleep 1000", 0),
        ("head -n 3 | $W; sleep 1000", 3),
        // A line without an end.
        ("tr \"\\\\000\" 1 < /dev/zero", 0),
        // The output is closed, the program goes on.
        ("$W; exec >&-; sleep 1000", 50),
    ] {
        let (code, v) = script(text, &["--timeout", "0.5"]);
        let (a, cases, passed, trouble) = counts(&v);
        assert_eq!(
            (code, a, cases, passed),
            (1, answered, 50, answered),
            "{text}: {trouble}"
        );
        assert!(trouble.contains("0.5 s"), "{text}: {trouble}");
    }
    assert!(start.elapsed() < Duration::from_secs(60));
}

/// Waits until a process that wrote its number into a file has ended, for that long at most.
#[cfg(target_os = "linux")]
fn is_gone(file: &Path) -> bool {
    let written = || {
        std::fs::read_to_string(file)
            .ok()?
            .trim()
            .parse::<u32>()
            .ok()
    };
    let number = patient(|| written().is_some()).then(written).flatten();
    let number = number.expect("the process was started");
    let stat = format!("/proc/{number}/stat");
    // A process that nobody waits for stays as Z.
    patient(|| std::fs::read_to_string(&stat).map_or(true, |t| t.contains(") Z ")))
}

#[cfg(target_os = "linux")]
fn patient(mut done: impl FnMut() -> bool) -> bool {
    let pause = || std::thread::sleep(Duration::from_millis(10));
    (0..1000).any(|_| done() || (pause(), false).1)
}

/// It keeps the outputs of program and audit open.
#[cfg(target_os = "linux")]
#[test]
fn what_a_program_leaves_behind_is_ended() {
    let folder = tempfile::tempdir().unwrap();
    let left = folder.path().join("left");
    let behind = format!("sleep 777 & echo $! > {}", left.to_str().unwrap());
    for (text, answered, good) in [
        (format!("{behind}; exec $W"), 50, true),
        (format!("{behind}; $W"), 50, true),
        (format!("{behind}; $W; exit 3"), 50, false),
        // Nothing is open.
        (
            format!("exec 3>&1 >&- 2>&-; {behind}; $W >&3 3>&-"),
            50,
            true,
        ),
        (format!("{behind}; kill -9 $$"), 0, false),
    ] {
        let start = Instant::now();
        let (code, v) = script(&text, &["--timeout", "5"]);
        let (a, cases, passed, trouble) = counts(&v);
        assert_eq!((a, cases, passed), (answered, 50, answered), "{text}");
        assert_eq!((code == 0, trouble.is_empty()), (good, good), "{trouble}");
        assert!(is_gone(&left), "{text}");
        assert!(
            answered == 0 || start.elapsed() < Duration::from_secs(5),
            "{text}"
        );
        std::fs::remove_file(&left).unwrap();
    }
}

/// Whatever ends the audit, the program ends with it.
#[cfg(target_os = "linux")]
#[test]
fn a_program_does_not_outlive_its_audit() {
    let folder = tempfile::tempdir().unwrap();
    let own = folder.path().join("own");
    let left = folder.path().join("left");
    let (own_text, left_text) = (own.to_str().unwrap(), left.to_str().unwrap());
    let command =
        format!("sh -c 'sleep 777 & echo $! > {left_text}; echo $$ > {own_text}; sleep 778'");
    for signal in ["-INT", "-TERM", "-HUP", "-KILL"] {
        #[cfg(target_os = "linux")]
        if crate::common::is_ignored(signal) {
            continue;
        }
        let mut audit = Command::new(PROGRAM)
            .args(["audit", "tridiagonal", "--cases", "1", "--exec", &command])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        assert!(patient(|| own.exists() && left.exists()));
        let number = audit.id().to_string();
        let sent = Command::new("kill").args([signal, &number]).status();
        assert!(sent.unwrap().success());
        assert!(!audit.wait().unwrap().success());
        assert!(is_gone(&own) && is_gone(&left), "{signal}");
        std::fs::remove_file(&own).unwrap();
        std::fs::remove_file(&left).unwrap();
    }
}

#[test]
fn what_cannot_be_run_is_bad_usage() {
    let usage = "
        --exec /no/such/program        | cannot start \"/no/such/program\"
        --exec 'open                   | --exec
        --exec true --timeout 0        | --timeout
        --exec true --ulps 0           | --ulps
        --exec true --outputs Re       | faddeeva has no output \"Re\"
        --decimal                      | --exec
        --exec true --region nowhere   | has no region
    ";
    for [args, part] in cells(usage) {
        refused(&command(&format!("audit faddeeva {args}")), &part);
    }
    let nothing = run(&["audit", "faddeeva", "--exec", ""]);
    refused(&nothing, "--exec needs a command");
    let spaced = ["audit", "faddeeva", "--exec", "true", "--outputs", "Re Z"];
    refused(&run(&spaced), "faddeeva has no output \"Re Z\"");
}

#[test]
fn files_of_inputs_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str, text: &str| file(&folder, name, text);
    let points = run(&["points", "faddeeva", "--count", "3", "--seed", "5"]).out;
    let inputs = file("points", &points);
    let right = run_on(&points, &["eval", "faddeeva"]).out;
    let judge = |values: &str, more: &[&str]| {
        let values = file("values", values);
        let args = [
            "judge", "faddeeva", "--inputs", &inputs, "--values", &values,
        ];
        run(&[&args[..], more].concat())
    };
    let d = judge(&right, &[]);
    assert_eq!((d.code, d.err.as_str()), (0, ""), "{}", d.out);
    let n = points.lines().filter(|l| !l.starts_with('#')).count();
    assert!(d.out.contains(&format!(" of {n} cases")), "{}", d.out);

    // A wrong value says where it stands and how to look at it again.
    let place = 1
        + points
            .lines()
            .position(|l| l.starts_with("# region lower "))
            .unwrap()
        + 1;
    let before = points
        .lines()
        .take(place - 1)
        .filter(|l| !l.starts_with('#'))
        .count();
    let mut lines: Vec<&str> = right.lines().collect();
    lines[before] = "1.5,-0x1p-3";
    let d = judge(&lines.join("\n"), &[]);
    assert_eq!(d.code, 1);
    for part in ["faddeeva / lower", "0x", "±", &format!("--line {place}\n")] {
        assert!(d.out.contains(part), "{part} is missing in {}", d.out);
    }
    let d = judge(&lines.join("\n"), &["--line", &place.to_string()]);
    assert!(
        d.code == 1 && d.out.contains("faddeeva / lower"),
        "{}",
        d.out
    );
    let d = judge(&lines.join("\n"), &["--line", &(place + 1).to_string()]);
    assert_eq!(d.code, 0, "{}", d.out);

    lines.truncate(10);
    let d = judge(&lines.join("\n"), &[]);
    assert!(
        d.code == 1 && d.out.contains("the values end after 10 answers"),
        "{}",
        d.out
    );
    let d = judge(&format!("{right}1,2\n"), &[]);
    assert!(
        d.code == 1 && d.out.contains("more values than"),
        "{}",
        d.out
    );
    // One component alone.
    let real: Vec<&str> = right
        .lines()
        .map(|l| l.split(',').next().unwrap())
        .collect();
    assert_eq!(judge(&real.join("\n"), &["--outputs", "Re W"]).code, 0);

    let bad = file("bad", "1,2\n1,x\n");
    let values = file("values", &right);
    for (from, part) in [(bad.as_str(), "line 2"), ("/no/such/file", "cannot read")] {
        let d = run(&["judge", "faddeeva", "--inputs", from, "--values", &values]);
        assert!(d.code == 2 && d.err.contains(part), "{}", d.err);
    }
}

#[test]
fn a_point_is_the_audits_case() {
    let d = command("points run-up --region moving --seed 3 --case 2 --decimal");
    let line = d.out.lines().find(|l| !l.starts_with('#')).unwrap();
    let shown: Vec<f64> = line.split(',').map(|f| f.parse().unwrap()).collect();
    let method = mechaudit::methods::find("run-up").unwrap();
    let settings = mechaudit::audit::Settings {
        seed: 3,
        ..Default::default()
    };
    let cases = mechaudit::audit::Cases::new(&*method, &settings);
    assert_eq!(cases.in_region("moving", 2).unwrap().input, shown);
}

fn there(program: &str) -> bool {
    let found = Command::new(program)
        .arg("--version")
        .stdout(Stdio::null())
        .status();
    let found = found.is_ok_and(|s| s.success());
    if !found {
        skipped(program);
    }
    found
}

fn compiled(compiler: &str, source: &str, folder: &Path) -> String {
    let target = folder.join("candidate");
    let status = Command::new(compiler)
        .args(["-O2", "-Wall", "-Wextra", "-Werror", "-o"])
        .args([
            &target,
            &Path::new(ROOT).join("examples/candidates").join(source),
        ])
        .arg("-lm")
        .status()
        .unwrap();
    assert!(status.success());
    target.to_str().unwrap().to_string()
}

#[test]
fn the_example_in_c() {
    if !there("cc") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let candidate = compiled("cc", "tridiagonal.c", folder.path());
    let d = run(&["audit", "tridiagonal", "--exec", &candidate]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
}

#[test]
fn the_example_in_fortran() {
    if !there("gfortran") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let candidate = compiled("gfortran", "slider_crank.f90", folder.path());
    let d = run(&["audit", "slider-crank", "--decimal", "--exec", &candidate]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
}

#[test]
fn the_example_in_python() {
    if !there("python3") {
        return;
    }
    let audit = |command: &str, region: &str, ulps: &str| {
        let args = [
            "audit", "faddeeva", "--cases", "100", "--region", region, "--ulps", ulps,
        ];
        run(&[&args[..], &["--exec", command]].concat())
    };
    let plain = "python3 examples/candidates/faddeeva.py --plain";
    let d = audit(plain, "mid", "1e6");
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let d = audit(plain, "near-zeros", "1e6");
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    let scipy = Command::new("python3")
        .args(["-c", "import scipy"])
        .stderr(Stdio::null())
        .status();
    if scipy.is_ok_and(|s| s.success()) {
        let program = "python3 examples/candidates/faddeeva.py";
        let d = audit(program, "mid", "1e4");
        assert_eq!(d.code, 0, "{}{}", d.out, d.err);
        // The book says: about half of the cases.
        let d = run(&["audit", "faddeeva", "--exec", program, "--format", "json"]);
        let (_, cases, passed, _) = counts(&serde_json::from_str(&d.out).unwrap());
        let share = passed as f64 / cases as f64;
        assert!((0.4..0.6).contains(&share), "{passed} of {cases}");
    } else {
        skipped("scipy");
    }
}

/// As the text says; the others are counted, by kind and region.
#[test]
fn json_lists_the_first_failures() {
    let audit = |format: &str| {
        let wrong = format!("sh -c '{PROGRAM} eval faddeeva | sed s/^/1/'");
        run(&[
            "audit", "faddeeva", "--region", "mid", "--cases", "1200", "--format", format,
            "--exec", &wrong,
        ])
    };
    let v: Value = serde_json::from_str(&audit("json").out).unwrap();
    let m = &v["methods"][0];
    let failed = m["cases"].as_u64().unwrap() - m["passed"].as_u64().unwrap();
    assert!(failed > 1000, "{failed}");
    assert_eq!(m["failures"].as_array().unwrap().len(), 500);
    assert_eq!(m["failures_left_out"], failed - 500);
    assert_eq!(m["regions"][0]["kinds"]["unreadable"], failed);
    let text = audit("text").out;
    let more = format!(
        "{} more failing cases; --format json lists the first 500 of each region.",
        failed - 10
    );
    assert!(text.contains(&more), "{text}");
    // Large numbers have an exponent.
    let (code, v) = script("$W | sed s/.*/1e160,1e160/", &[]);
    let reason = v["methods"][0]["failures"][0]["judgement"]["reason"]
        .as_str()
        .unwrap();
    assert!(
        code == 1 && reason.len() < 100 && reason.contains("is 1e160, expected"),
        "{reason}"
    );
    let text = run(&[
        "audit",
        "faddeeva",
        "--region",
        "mid",
        "--cases",
        "5",
        "--exec",
        &format!("sh -c '{PROGRAM} eval faddeeva | sed s/.*/1e160,1e160/'"),
    ]);
    let table: String = text.out.lines().take(5).collect();
    assert!(
        table.contains("Re W") && !table.contains("inf"),
        "{}",
        text.out
    );
}

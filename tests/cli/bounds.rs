//! Every number that sets an amount of work: what cannot end is refused at once, with the limit.

use crate::common::{cells, command, file, refused, run, said, words};
use std::time::{Duration, Instant};

/// A refusal, and nobody waits for it.
fn refused_at_once(line: &str, part: &str) {
    let begin = Instant::now();
    refused(&command(line), part);
    // A busy machine is given time; the work itself takes years.
    assert!(begin.elapsed() < Duration::from_secs(60), "{line}");
}

fn read_example(name: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    std::fs::read_to_string(format!("{folder}/{name}")).unwrap()
}

#[test]
fn arguments_that_ask_for_too_much() {
    let run_up = "runup examples/sand-screen-run-up.toml --coefficients splines --nodes";
    for nodes in ["1e8", "1e14", "100001", "18446744073709551615"] {
        let due = "must be a whole number from 3 to 100000";
        refused_at_once(&format!("{run_up} {nodes}"), due);
    }
    let lines = "
        linkage examples/four-bar.toml --step-deg 1e-300 | more than 10000000 crank angles
        linkage examples/jansen-leg.toml --step-deg 1e-9 | more than 10000000 crank angles
        linkage examples/sand-screen.toml --digits 1e6 | from 1 to 1000
        eval erf --digits 1e6 | from 1 to 10000
        eval erf --threads 1e6 | from 1 to 1024
        runup examples/four-bar-run-up.toml --tolerance 1e-300 | between 1e-14 and 1e-2
        chirp examples/chirp-chart.toml --harmonics 1e9 | from 1 to 100000
        prove erf --component 1e-9 | must be at least 0.5: rounding the exact value
        prove faddeeva --component 1e-9 | must be at least 0.5
        prove faddeeva --norm 0.49 | must be at least 0.5
        prove faddeeva --within 1e-320 | no rectangle lies below it
        prove faddeeva --part lower --within 1e-320 | no rectangle lies below it
        hunt erf --evals 1e15 | years; more than 30 days
        audit erf --cases 1e15 | years; more than 30 days
        audit --cases 1e15 | years; more than 30 days
        compare erf --exec true --cases 1e15 | years; more than 30 days
        points erf --count 1e15 | more than 30 days or 1e12 bytes
        campaign plan examples/campaign.toml --shards 1e9 --output none | from 1 to 1000000
        --cases 99999999999999 | years; more than 30 days
        audit erf --cases 99999999999999 --exec cat | years; more than 30 days
    ";
    for [line, part] in cells(lines) {
        refused_at_once(&line, &part);
    }
}

#[test]
fn files_that_ask_for_too_much() {
    let folder = tempfile::tempdir().unwrap();
    let change = |example: &str, from: &str, to: &str| {
        let text = read_example(example);
        assert!(text.contains(from), "{from}");
        file(&folder, "made.toml", &text.replace(from, to))
    };
    let files = r#"
        runup | four-bar-run-up.toml | duration = "2 s" | duration = "1e300 s" | ten million samples
        runup | four-bar-run-up.toml | step = "2 ms" | step = "1e-300 s" | ten million samples
        runup | four-bar-run-up.toml | step = "2 ms" | coefficients = "splines"\nnodes = 100000000 | 1e8 nodes over a turn, at most 100000 are taken
        chirp | chirp-run-up.toml | duration = "12 s" | duration = "1e300 s" | at most 1e10 rows
        chirp | chirp-chart.toml | step = 0.1 | step = 1e-300 | at most 1e5 points
        chirp | chirp-chart.toml | step = 0.1 | step = 0.0002 | with 100000 harmonics take about
    "#;
    for [command, example, from, to, part] in cells(files) {
        let path = change(&example, &from, &to);
        let more: &[&str] = match part.contains("harmonics") {
            true => &["--harmonics", "1e5"],
            false => &[],
        };
        let begin = Instant::now();
        refused(
            &run(&[&[command.as_str(), path.as_str()], more].concat()),
            &part,
        );
        assert!(begin.elapsed() < Duration::from_secs(60), "{part}");
    }
    let plan = file(
        &folder,
        "plan.toml",
        "name = \"large\"\n[[part]]\nmethods = [\"erf\"]\ncases = 9000000000000000000\n",
    );
    let output = folder.path().join("campaign");
    let args = [
        "campaign",
        "plan",
        &plan,
        "--output",
        output.to_str().unwrap(),
    ];
    refused(
        &run(&args),
        "judgements are more than the 1e15 of a campaign",
    );
    assert!(!output.exists());
}

/// A target that is closer than the default is not refused: the proof says what it takes at most.
#[test]
fn a_closer_target_is_told_of() {
    let mut child = crate::common::start(&words("prove erf --component 0.5"));
    let mut said_so = String::new();
    let mut err = std::io::BufReader::new(child.stderr.take().unwrap());
    std::io::BufRead::read_line(&mut err, &mut said_so).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    let due = "erf: the target is closer than the default; it takes 3e7 rectangles or intervals at most, about ";
    assert!(
        said_so.starts_with(&format!("mechaudit: {due}")),
        "{said_so}"
    );
}

/// Checks every message.
#[test]
fn a_message_that_repeats_itself_is_found() {
    for (line, good) in [
        ("mechaudit: no steady cycle found in 50 iterations", true),
        (
            "mechaudit: no steady cycle: no steady cycle found in 50 iterations",
            false,
        ),
        (
            "mechaudit: cannot read a.toml: cannot read a.toml, it is a folder",
            false,
        ),
        ("mechaudit: line 3: the length is 1e300 m", true),
        (
            "mechaudit: line 3: the length is 1000000000000000000000000000000 m",
            false,
        ),
    ] {
        let found = std::panic::catch_unwind(|| crate::common::well_said(line));
        assert_eq!(found.is_ok(), good, "{line}");
    }
}

#[test]
fn numbers_in_messages_have_an_exponent() {
    let folder = tempfile::tempdir().unwrap();
    for (example, from) in [
        ("four-bar.toml", "crank = \""),
        ("sand-screen.toml", "l1 = \""),
    ] {
        let text = read_example(example);
        for length in ["1e300 m", "-1e300 m", "1e-300 m"] {
            let at = text.find(from).unwrap() + from.len();
            let end = at + text[at..].find('"').unwrap();
            let path = file(
                &folder,
                "made.toml",
                &format!("{}{length}{}", &text[..at], &text[end..]),
            );
            let d = run(&["linkage", &path]);
            refused(&d, length.split_whitespace().next().unwrap());
            assert!(d.err.len() < 250, "{}", d.err);
        }
    }
    let d = command("runup examples/four-bar-run-up.toml --tolerance 1e300");
    said(&d, "the tolerance 1e300 must lie between 1e-14 and 1e-2");
}

//! `mechaudit identity` as its user meets it.

use crate::common::{refused, run, run_on, start};
use std::io::{BufRead, BufReader, Write};

#[test]
fn equations_are_decided_in_order() {
    let input = "# an example\n\nsin(2*x) = 2*sin(x)*cos(x)\nx = 2*x\n";
    let d = run_on(input, &["identity"]);
    assert_eq!((d.code, d.err.as_str()), (1, ""));
    let lines: Vec<&str> = d.out.lines().collect();
    assert_eq!(lines.len(), 2);
    assert_eq!(lines[0], "proved");
    assert!(lines[1].starts_with("refuted at x = "), "{}", lines[1]);
    let d = run_on("exp(i*pi) = -1", &["identity"]);
    assert_eq!((d.code, &*d.out, &*d.err), (0, "proved\n", ""));
}

#[test]
fn definitions_and_objects() {
    let args = "identity --format json --define";
    let args: Vec<&str> = args.split(' ').collect();
    let args = [&args[..], &["c = a + b", "--define", "t: y = -y"]].concat();
    let d = run_on("c^2 - a*(a + 2*b) = b^2\nD(y, t) = -y\n", &args);
    assert_eq!((d.code, d.err.as_str()), (0, ""));
    for (line, number) in d.out.lines().zip([1, 2]) {
        let found: serde_json::Value = serde_json::from_str(line).unwrap();
        assert_eq!(found["outcome"], "proved");
        assert_eq!(found["line"], number);
    }
    assert_eq!(d.out.lines().count(), 2);
}

#[test]
fn bad_input_is_one_line() {
    let d = run_on("x = )", &["identity"]);
    refused(&d, "line 1 (\"x = )\"): character 5: unexpected ')'");
    refused(&run_on("", &["identity"]), "no equation on standard input");
    let d = run_on("x = x", &["identity", "--define", "x == 1"]);
    refused(&d, "--define \"x == 1\": character 4: unexpected '='");
    refused(
        &run(&["identity", "x = x"]),
        "see mechaudit identity --help",
    );
    let d = run_on("1 = 1\n2 = \n3 = 3\n", &["identity"]);
    assert_eq!((d.code, &*d.out), (2, "proved\n"));
    assert_eq!(d.err.lines().count(), 1, "{}", d.err);
}

/// Whoever waits for an answer before the next question gets it.
#[test]
fn an_answer_is_not_held_back() {
    let mut child = start(&["identity"]);
    let mut stdin = child.stdin.take().unwrap();
    let mut answers = BufReader::new(child.stdout.take().unwrap()).lines();
    for _ in 0..3 {
        stdin.write_all(b"x - x = 0\n").unwrap();
        assert_eq!(answers.next().unwrap().unwrap(), "proved");
    }
    drop(stdin);
    assert!(answers.next().is_none());
    assert!(child.wait().unwrap().success());
}

//! Initial value problems: certified motions against those of mpmath, simulations judged, and files
//! that are refused.

use crate::common::{command, csv, file, refused, run, run_on, said};
use std::collections::BTreeMap;
use tempfile::tempdir;

const FOLDER: &str = "examples/studies/motion";

/// Values of mpmath to 30 digits.
const WITNESS: &str = include_str!("../../reference/independent/initial_value.csv");

/// Stiff problems with the last time that a test can wait for; the witness has later ones too.
const STIFF: [(&str, &str, f64); 4] = [
    ("hires", "", 321.8122),
    ("prothero-robinson", "", 10.0),
    ("robertson", "", 0.4),
    ("van-der-pol", "100", 100.0),
];

/// The values of a problem by time and state.
type Values = BTreeMap<String, Vec<(String, String)>>;

/// Problems with their inputs, in the order of the file.
fn witness() -> BTreeMap<(String, String), Values> {
    let mut all: BTreeMap<(String, String), Values> = BTreeMap::new();
    for row in csv(WITNESS).1 {
        let [problem, input, time, state, value] = row.try_into().unwrap();
        let values = all.entry((problem, input)).or_default();
        values.entry(time).or_default().push((state, value));
    }
    all
}

/// Returns true if two decimals agree to that many significant digits, but for one unit of the
/// last.
pub fn agree(a: &str, b: &str, digits: i32) -> bool {
    let exact = |text: &str| mechaudit::reference::Decimal::parse(text).unwrap().value;
    let (a, b) = (exact(a), exact(b));
    let ten = rug::Rational::from(10);
    let unit = rug::Rational::from(b.abs_ref());
    let mut allowed = unit;
    for _ in 0..digits - 1 {
        allowed /= &ten;
    }
    rug::Rational::from(&a - &b).abs() <= allowed
}

#[test]
fn certified_motions_are_those_of_mpmath() {
    let mut compared = 0;
    for ((problem, input), values) in witness() {
        let stiff = STIFF
            .iter()
            .find(|stiff| (stiff.0, stiff.1) == (problem.as_str(), input.as_str()));
        let (digits, until) = stiff.map_or((25, f64::INFINITY), |stiff| (15, stiff.2));
        // Times in the order of their size.
        let number = |time: &str| time.parse::<f64>().unwrap();
        let mut times: Vec<&str> = values.keys().map(String::as_str).collect();
        times.retain(|time| number(time) <= until);
        times.sort_by(|a, b| number(a).total_cmp(&number(b)));
        let path = format!("{FOLDER}/{problem}.toml");
        let set = format!("mu={input}");
        let joined = times.join(",");
        let precision = digits.to_string();
        let mut args = vec![
            "motion", &path, "--times", &joined, "--digits", &precision, "--format", "csv",
        ];
        if !input.is_empty() {
            args.extend(["--set", &set]);
        }
        let d = run(&args);
        assert_eq!(d.code, 0, "{problem} {input}: {}{}", d.out, d.err);
        let (head, rows) = csv(&d.out);
        for (row, time) in rows.iter().zip(times) {
            for (state, due) in &values[time] {
                let k = head.iter().position(|h| h == state).unwrap();
                assert!(
                    agree(&row[k], due, digits),
                    "{problem} {input}, {state} at {time}: {} {due}",
                    row[k]
                );
                compared += 1;
            }
        }
    }
    assert!(compared > 50, "{compared}");
}

const SWING: &str = r#"
title = "a swing"
[ode]
[ode.states]
x = { start = "1", rate = "v", unit = "m", budget = "1e-6 absolute", why = "a test" }
v = { start = "0", rate = "-x", budget = "1e-6 absolute", why = "a test" }
[outputs]
energy = { is = "x^2 + v^2", budget = "4 ulp", why = "a test" }
"#;

/// x = cos t: values by hand, in every form.
#[test]
fn a_motion_has_a_row_for_each_time() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "swing.toml", SWING);
    let d = run(&["motion", &path, "--times", "0:1:1/2", "--digits", "10"]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let lines: Vec<Vec<&str>> = d
        .out
        .lines()
        .map(|l| l.split_whitespace().collect())
        .collect();
    assert_eq!(lines[0], ["t", "x", "[m]", "v", "energy"]);
    assert_eq!(lines[1], ["0", "1.000000000", "0", "1.000000000"]);
    assert_eq!(
        lines[2],
        ["0.5", "0.8775825619", "-0.4794255386", "1.000000000"]
    );
    assert_eq!(
        lines[3],
        ["1", "0.5403023059", "-0.8414709848", "1.000000000"]
    );
    let d = run(&[
        "motion", &path, "--times", "1", "--digits", "5", "--format", "csv",
    ]);
    assert_eq!(d.out, "t,x,v,energy\n1,0.54030,-0.84147,1.0000\n");
    let d = run(&["motion", &path, "--times", "1/3,1", "--format", "json"]);
    let v: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(
        (&v["digits"], &v["units"]["x"], &v["rows"][0]["t"]),
        (&15.into(), &"m".into(), &"1/3".into())
    );
    let d = run(&["motion", &path, "--times", "0:6:0.1", "--format", "html"]);
    assert!(
        d.out.starts_with("<!doctype html>") && d.out.contains("0.995004165278026"),
        "{}",
        d.err
    );
    let d = run_on("0.5\n1\n", &["eval", &path, "--digits", "10"]);
    assert_eq!(
        d.out,
        "0.8775825619,-0.4794255386,1.000000000\n0.5403023059,-0.8414709848,1.000000000\n"
    );
}

#[test]
fn what_is_no_motion_is_refused() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "swing.toml", SWING);
    for (times, due) in [
        ("-1:1:1", "the time -1 comes before the start 0"),
        ("0:1", "is neither a time nor FIRST:LAST:STEP"),
        ("1,0", "the times do not increase at 0"),
    ] {
        refused(&run(&["motion", &path, "--times", times]), due);
    }
    refused(
        &run(&["motion", &path, "--times", "1", "--set", "m=1"]),
        "there is no such input",
    );
    refused(
        &run(&["motion", &path, "--times", "1", "--set", "t=1"]),
        "the time is set by --times",
    );
    let van_der_pol = format!("{FOLDER}/van-der-pol.toml");
    refused(
        &run(&["motion", &van_der_pol, "--times", "1"]),
        "the input mu has no value: --set mu=NUMBER",
    );
    refused(
        &run(&["motion", "examples/studies/kepler.toml", "--times", "1"]),
        "the study states no initial value problem: [ode]",
    );
    refused(
        &run_on("-1\n", &["eval", &path, "--digits", "5"]),
        "the time -1 comes before the start 0",
    );
    let no_rate = file(&folder, "no-rate.toml", "[ode.states]\nx = { start = 1 }\n");
    refused(
        &run(&["motion", &no_rate, "--times", "1"]),
        "line 2, column 5: the state x has no rate",
    );
    let pole = file(
        &folder,
        "pole.toml",
        "[ode.states]\nx = { start = 0, rate = \"1/x\" }\n",
    );
    refused(
        &run(&["motion", &pole, "--times", "1"]),
        "the rate of x at the start is undefined",
    );
}

/// 1/(1 − t): known before its pole, undecided beyond it.
#[test]
fn a_blow_up_is_undecided_with_the_time_reached() {
    let folder = tempdir().unwrap();
    let path = file(
        &folder,
        "riccati.toml",
        "[ode.states]\nx = { start = 1, rate = \"x^2\" }\n",
    );
    let d = run(&[
        "motion", &path, "--times", "0.5,2,3", "--digits", "10", "--format", "csv",
    ]);
    assert_eq!(d.code, 1, "{}", d.err);
    assert_eq!(d.out, "t,x\n0.5,2.000000000\n2,undecided\n3,undecided\n");
    said(&d, "x is undecided from t = 2 on");
    assert_eq!(d.err.lines().count(), 1, "{}", d.err);
}

/// A simulation by Euler's method with a step of 1/1000, and the solution itself.
#[test]
fn a_simulation_is_judged_row_by_row() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "swing.toml", SWING);
    let (mut good, mut bad) = (String::from("v,t,x [mm]\n"), String::from("t,x,v\n"));
    let (mut x, mut v) = (1.0f64, 0.0f64);
    for k in 0..=2000 {
        let t = f64::from(k) / 1000.0;
        if k % 100 == 0 {
            good += &format!("{},{t},{}\n", -t.sin(), 1000.0 * t.cos());
            bad += &format!("{t},{x},{v}\n");
        }
        (x, v) = (x + v / 1000.0, v - x / 1000.0);
    }
    let [good, bad] =
        [("good.csv", good), ("bad.csv", bad)].map(|(name, text)| file(&folder, name, &text));
    let judge =
        |table: &str, form: &str| run(&["judge", &path, "--table", table, "--format", form]);
    let d = judge(&good, "text");
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    assert!(
        d.out
            .contains("pass  42 of 42 entries within budget; 21 rows, t from 0 to 2"),
        "{}",
        d.out
    );
    let d = judge(&bad, "text");
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    assert!(d.out.contains("FAIL"), "{}", d.out);
    // Errors of Euler's method are t/2000 times the amplitude.
    let line = d
        .out
        .lines()
        .find(|l| l.trim_start().starts_with("x "))
        .unwrap();
    let fields: Vec<&str> = line.split_whitespace().collect();
    assert_eq!((fields[2], fields[6]), ("2.00", "0.100"), "{line}");
    let d = judge(&bad, "csv");
    let (head, rows) = csv(&d.out);
    assert_eq!(
        head.join(","),
        "line,t,output,printed,reference,error,of_budget,verdict"
    );
    assert_eq!(rows.len(), 42);
    assert_eq!(rows[0][7], "pass");
    assert_eq!(rows[41][7], "over");
    let d = judge(&bad, "json");
    let value: serde_json::Value = serde_json::from_str(&d.out).unwrap();
    assert_eq!(
        (&value["rows"], &value["passed"]),
        (&21.into(), &false.into())
    );
    let error = value["columns"][0]["error"].as_f64().unwrap();
    assert!((error - 4.2e-4).abs() < 1e-5, "{error}");
    let d = judge(&bad, "html");
    assert!(
        d.out.contains("decimal logarithm of the error"),
        "{}",
        d.err
    );
    // A NaN is no number, wherever it stands.
    // An empty field is how many programs write it.
    let empty = file(&folder, "empty.csv", "t,x\n0,1\n1,\n");
    let d = judge(&empty, "csv");
    assert_eq!(d.code, 1);
    assert_eq!(csv(&d.out).1[1][7], "wrong_kind", "{}", d.out);
    let nan = file(&folder, "nan.csv", "t,x\n1,nan\n");
    let d = judge(&nan, "csv");
    assert_eq!(d.code, 1);
    assert!(d.out.ends_with(",wrong_kind\n"), "{}", d.out);
    let early = file(&folder, "early.csv", "t,x\n-1,1\n");
    assert_eq!(judge(&early, "text").code, 1);
    refused(&judge(&good, "junit"), "--format junit");
}

/// A leapfrog in a shell's arithmetic tool is an integrator like others.
#[test]
#[cfg(unix)]
fn an_integrator_is_audited_as_a_candidate() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "swing.toml", SWING);
    let good = "awk '{ printf \"%.17g,%.17g,1\\n\", cos($1), -sin($1); fflush() }'";
    let d = run(&["audit", &path, "--cases", "5", "--exec", good]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let bad = "awk '{ printf \"%.17g,%.17g,1\\n\", cos($1) + 1e-5, -sin($1); fflush() }'";
    let d = run(&["audit", &path, "--cases", "5", "--exec", bad]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    let d = command(&format!("describe {path}"));
    assert!(d.out.contains("energy"), "{}", d.out);
}

/// One line of inputs, and a row of states for each time.
#[test]
fn a_whole_trajectory_is_one_answer() {
    let folder = tempdir().unwrap();
    let text = r#"
[inputs]
k = { from = "1", to = "2" }
[ode]
times = "0:1:1/4,3"
[ode.states]
x = { start = "1", rate = "-k*x", budget = "1e-12 relative", why = "a test" }
"#;
    let path = file(&folder, "decay.toml", text);
    let program = |row: &str| {
        let times = "split(\"0 0.25 0.5 0.75 1 3\", t, \" \")";
        format!(
            "awk '{{ {times}; for (i = 1; i <= 6; i++) printf {row}, exp(-$1*t[i]); fflush() }}'"
        )
    };
    let audit = |row: &str| {
        let program = program(row);
        run(&[
            "audit",
            &path,
            "--cases",
            "20",
            "--decimal",
            "--exec",
            &program,
        ])
    };
    let d = audit("\"%.17g\\n\"");
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    // All on one line; then a row that is wrong.
    let d = audit("(i < 6 ? \"%.17g,\" : \"%.17g\\n\")");
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    let d = audit("(i == 4 ? \"%.7g\\n\" : \"%.17g\\n\")");
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    let d = run_on("1\n", &["eval", &path, "--digits", "6"]);
    assert_eq!(
        d.out,
        "1.00000,0.778801,0.606531,0.472367,0.367879,0.0497871\n"
    );
    let d = run(&[
        "motion", &path, "--set", "k=2", "--times", "1", "--format", "csv", "--digits", "5",
    ]);
    assert_eq!(d.out, "t,x\n1,0.13534\n");
    for (times, said_so) in [
        ("0:1", "neither a time nor FIRST:LAST:STEP"),
        ("-1,1", "comes before the start"),
        ("0:1:1e-5", "at most 10000 rows"),
        ("1,1", "do not increase"),
    ] {
        let path = file(&folder, "bad.toml", &text.replace("0:1:1/4,3", times));
        let d = run(&["describe", &path]);
        assert_eq!(d.code, 2, "{times}");
        assert!(
            d.err.contains(said_so) && d.err.contains("line 5"),
            "{}",
            d.err
        );
    }
}

//! Files of studies in the place of methods: every command takes them.

use crate::common::{
    Done, done, file, markup, needs_nothing_else, program, refused, run, run_on, said, text,
};
use crate::reports::against;
use serde_json::Value;
use std::fs;
use tempfile::{TempDir, tempdir};

const DIFFERENCE: &str = r#"
title  = "Difference of square roots"
source = "R. W. Hamming, Numerical Methods for Scientists and Engineers, 1973"
[inputs]
x = { from = 1, to = 1e12, spacing = "log", unit = "m" }
[outputs]
y = { is = "sqrt(x + 1) - sqrt(x)", budget = "4 ulp", why = "three roundings of the rewrite" }
[solver.direct]
y = "sqrt(x + 1) - sqrt(x)"
[solver.stable]
y = "1/(sqrt(x + 1) + sqrt(x))"
"#;

const WITHOUT_SOLVER: &str = r#"
[inputs]
e = { from = 0, to = 0.9 }
[outputs]
l = { is = "log(e - 1/2)", unit = "kg" }
m = { is = "e + 1" }
"#;

const CORES: &str = "
(FPCore (x) :name \"a/b#c d\" :pre (<= 1 x 1000) (- (sqrt (+ x 1)) (sqrt x)))
(FPCore (x y) :name \"second\" :pre (and (<= 1 x 10) (<= 1 y 10)) (/ x (+ x y)))
";

const DEPENDENT: &str = "The solver direct and the definition of y are the same formula";

/// A program that answers well, and keeps its answers back until its input ends.
const STABLE: &str = "awk -F, '{ y[NR] = 1 / (sqrt($1 + 1) + sqrt($1)) } \
                      END { for (i = 1; i <= NR; i++) printf \"%.17g\\n\", y[i] }'";

fn study(folder: &TempDir) -> String {
    file(folder, "difference.toml", DIFFERENCE)
}

fn json(done: &Done) -> Value {
    serde_json::from_str(&done.out).unwrap_or_else(|e| panic!("{e}: {}", done.out))
}

/// Text, JSON, JUnit, CSV and a page have the names and units of the inputs, the remarks, and the
/// command that judges a case again.
#[test]
fn reports_know_the_names_of_a_study() {
    let folder = tempdir().unwrap();
    let path = study(&folder);
    let audit = |more: &[&str]| run(&[&["audit", &path, "--cases", "10"], more].concat());
    let d = audit(&[]);
    assert_eq!(d.code, 1, "{}", d.err);
    let flat = d.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(flat.contains(DEPENDENT), "{flat}");
    assert!(
        d.out
            .lines()
            .any(|l| l.trim_start().starts_with("x      m ")),
        "{}",
        d.out
    );
    let whole = json(&audit(&["--format", "json"]));
    assert_eq!(against("audit.schema.json", &whole), Vec::<String>::new());
    let method = &whole["methods"][0];
    assert!(
        method["remarks"][0]
            .as_str()
            .unwrap()
            .starts_with(DEPENDENT)
    );
    assert!(!method["source"].as_str().unwrap().contains(DEPENDENT));
    let failures = method["failures"].as_array().unwrap();
    assert!(
        failures
            .iter()
            .all(|f| f["input_names"] == serde_json::json!(["x"]))
    );
    let page = audit(&["--format", "html"]).out;
    needs_nothing_else(&page);
    assert!(markup(&page).contains(DEPENDENT), "{page}");
    assert!(page.contains("[\"x\",\"m\","), "the dialog names inputs");
    let junit = audit(&["--format", "junit"]).out;
    assert!(junit.contains("x      m "), "{junit}");
    assert_eq!(audit(&["--format", "csv"]).code, 1);
    // The other solver is within the budget, and its cases are judged again as they were.
    let stable = audit(&["--solver", "stable", "--ulps", "0.01", "--format", "json"]);
    let again = json(&stable)["methods"][0]["failures"][0]["reproduce"].clone();
    let again = again.as_str().unwrap();
    assert!(again.ends_with(" --solver stable"), "{again}");
    let words = shell_words::split(again).unwrap();
    let d = done(program().args(&words[1..]).output().unwrap());
    assert_eq!(d.code, 1, "{}", d.err);
    assert_eq!(audit(&["--solver", "stable"]).code, 0);
}

#[test]
fn studies_are_described_and_listed() {
    let folder = tempdir().unwrap();
    let path = study(&folder);
    let d = run(&["describe", &path]);
    assert!(d.code == 0 && d.out.contains("remarks "), "{}", d.out);
    let d = run(&["describe", &path, "--format", "json"]);
    assert!(
        json(&d)["remarks"][0]
            .as_str()
            .unwrap()
            .starts_with(DEPENDENT)
    );
    let d = run(&["list", &path]);
    assert!(
        d.code == 0 && d.out.contains("Difference of square roots"),
        "{}",
        d.out
    );
    let cores = file(&folder, "some cores.fpcore", CORES);
    let d = run(&["describe", &format!("{cores}#second")]);
    assert!(
        d.code == 0 && d.out.contains("some cores.fpcore#second"),
        "{}",
        d.out
    );
    let d = run(&["audit", &cores, "--cases", "5", "--format", "json"]);
    let whole = json(&d);
    let methods = whole["methods"].as_array().unwrap();
    assert_eq!(methods.len(), 2);
    // A word for a shell, whatever the file and the core are called.
    let again = methods[0]["worst"][0]["reproduce"].as_str().unwrap();
    let words = shell_words::split(again).unwrap();
    assert_eq!(words[2], format!("{cores}#a/b#c d"));
    let d = done(program().args(&words[1..]).output().unwrap());
    assert!(d.code < 2, "{}", d.err);
}

/// A program may keep its answers back; its end before the last answer is a finding, and so is a
/// share above the budget.
#[cfg(unix)]
#[test]
fn hunts_take_studies_and_programs() {
    let folder = tempdir().unwrap();
    let path = study(&folder);
    let hunt = |more: &[&str]| run(&[&["hunt", &path, "--evals", "300"], more].concat());
    let hard = folder.path().join("hard");
    fs::create_dir(&hard).unwrap();
    let d = hunt(&["--hard", text(&hard)]);
    assert_eq!(d.code, 1, "{}", d.err);
    said(
        &Done {
            err: d.out.clone(),
            ..d
        },
        "1 added to",
    );
    assert!(hard.join("difference.csv").is_file());
    let again = run(&["audit", &path, "--hard", text(&hard), "--hard-case", "1"]);
    assert!(
        again.out.contains("--hard-case 1"),
        "{}{}",
        again.out,
        again.err
    );
    let d = hunt(&["--exec", STABLE]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
    assert!(
        d.out.contains(" 300 answers") && d.out.contains("--exec "),
        "{}",
        d.out
    );
    let d = hunt(&["--exec", "head -n 3"]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    assert!(
        d.out.contains("the first input without an answer"),
        "{}",
        d.out
    );
    refused(&hunt(&["--exec", "no-such-program-here"]), "cannot start");
    // Methods that are built in, too: what is recorded of their own solver excuses no program.
    let d = run(&[
        "hunt",
        "erf",
        "--evals",
        "60",
        "--exec",
        "sed -e 's/.*/0.5,0.5/'",
    ]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    assert!(d.out.contains(" new "), "{}", d.out);
}

/// One line, exit code 2; with a program there is something to judge.
#[test]
fn a_study_without_a_solver_needs_a_program() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "open.toml", WITHOUT_SOLVER);
    for args in [
        vec!["audit", &path],
        vec!["hunt", &path],
        vec!["compare", &path, "--exec", "cat", "--with", "ours"],
    ] {
        refused(&run(&args), "states no solver");
    }
    refused(&run_on("1\n", &["eval", &path]), "states no solver");
    refused(&run(&["converge", &path]), "there is no approximation");
    let plan = format!("name = \"x\"\n[[part]]\nmethods = [{path:?}]\ncases = 1\n");
    let plan = file(&folder, "plan.toml", &plan);
    let into = folder.path().join("campaign");
    let d = run(&["campaign", "plan", &plan, "--output", text(&into)]);
    refused(&d, "states no solver");
    let d = run(&[
        "audit",
        &path,
        "--cases",
        "3",
        "--exec",
        "sed -e 's/.*/nan 1/'",
    ]);
    assert_eq!(d.code, 1, "{}", d.err);
}

/// Values that are undefined or exactly zero are answers; the reason stands on standard error.
#[test]
fn values_of_studies() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "open.toml", WITHOUT_SOLVER);
    let d = run_on("3/2\n0x1p-2\n", &["eval", &path, "--digits", "12"]);
    assert_eq!(
        (d.code, d.out.as_str()),
        (0, "0,2.50000000000\nnan,1.25000000000\n"),
        "{}",
        d.err
    );
    assert!(
        d.err.contains("line 2") && d.err.contains("log"),
        "{}",
        d.err
    );
    let path = study(&folder);
    let d = run_on("0.5625\n-2\n", &["eval", &path]);
    assert_eq!((d.code, d.out.as_str()), (0, "0x1p-1\nnan\n"), "{}", d.err);
    assert!(
        d.err.contains("y is undefined") && d.err.contains("sqrt"),
        "{}",
        d.err
    );
    refused(&run_on("1/0\n", &["eval", &path]), "1/0");
}

/// A table is made again byte for byte, from whatever folder, agrees with itself, and holds NaN
/// where a value is undefined.
#[test]
fn tables_of_certified_values() {
    let folder = tempdir().unwrap();
    let path = file(&folder, "open.toml", WITHOUT_SOLVER);
    let table = folder.path().join("values.csv");
    let table = text(&table);
    let points = ["--count", "5", "--digits", "25", "--output", table];
    let made = |path: &str, more: &[&str]| {
        let mut program = program();
        program.current_dir(folder.path());
        program.args(["points", path]).args(points).args(more);
        done(program.output().unwrap())
    };
    assert_eq!(made(&path, &[]).code, 0);
    let before = fs::read_to_string(table).unwrap();
    assert!(before.lines().any(|l| l == "e,l [kg],m"), "{before}");
    assert!(before.contains(",nan,"), "{before}");
    assert_eq!(made("open.toml", &["--check"]).code, 0);
    let d = run(&["judge", &path, "--table", table]);
    assert!(
        d.code == 0 && d.out.contains("entries agree"),
        "{}{}",
        d.out,
        d.err
    );
    let wrong = before.replacen(",nan,", ",0.5,", 1);
    fs::write(table, &wrong).unwrap();
    let d = made("open.toml", &["--check"]);
    assert_eq!(d.code, 1);
    assert!(
        d.err.contains("is not what this command writes"),
        "{}",
        d.err
    );
    assert_eq!(fs::read_to_string(table).unwrap(), wrong);
    assert_eq!(run(&["judge", &path, "--table", table]).code, 1);
    // Methods that are built in have their tables as well.
    let d = run(&[
        "points", "erf", "--region", "mid", "--count", "3", "--digits", "20",
    ]);
    assert_eq!(d.code, 0, "{}", d.err);
    let into = file(&folder, "erf.csv", &d.out);
    let d = run(&["judge", "erf", "--table", &into]);
    assert_eq!(d.code, 0, "{}{}", d.out, d.err);
}

#[cfg(unix)]
#[test]
fn programs_are_compared_on_a_study() {
    let folder = tempdir().unwrap();
    let path = study(&folder);
    let d = run(&[
        "compare",
        &path,
        "--exec",
        STABLE,
        "--exec",
        "sed -e 's/.*/1/'",
        "--cases",
        "5",
        "--no-speed",
        "--format",
        "json",
    ]);
    assert_eq!(d.code, 1, "{}", d.err);
    assert_eq!(
        against("compare.schema.json", &json(&d)),
        Vec::<String>::new()
    );
}

/// Shards find the study from another folder, and refuse it once its text is another.
#[test]
fn campaigns_take_studies() {
    let folder = tempdir().unwrap();
    let path = study(&folder);
    let plan = "name = \"x\"\n[[part]]\nmethods = [\"difference.toml\"]\ncases = 5\n";
    file(&folder, "plan.toml", plan);
    let into = folder.path().join("campaign");
    let into = text(&into);
    let mut planned = program();
    planned.current_dir(folder.path());
    planned.args([
        "campaign",
        "plan",
        "plan.toml",
        "--shards",
        "2",
        "--output",
        into,
    ]);
    let d = done(planned.output().unwrap());
    assert_eq!(d.code, 0, "{}", d.err);
    let d = run(&["campaign", "run", into]);
    assert_eq!(d.code, 0, "{}", d.err);
    let d = run(&["campaign", "merge", into]);
    assert_eq!(d.code, 1, "{}", d.err);
    assert_eq!(
        json(&d)["parts"][0]["found"]["worst"][0]["input_names"][0],
        "x"
    );
    fs::write(&path, format!("{DIFFERENCE}\n# Another text.\n")).unwrap();
    refused(&run(&["campaign", "merge", into]), "of another program");
}

//! Studies as their user meets them: the examples with their solvers and candidates, certified
//! digits against those of mpmath, and files that are refused.

use crate::common::{Done, file, refused, run, run_on, said};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const FOLDER: &str = "examples/studies";

fn example(name: &str) -> String {
    match name.split_once('#') {
        Some((file, core)) => format!("{FOLDER}/{file}.fpcore#{core}"),
        None => format!("{FOLDER}/{name}.toml"),
    }
}

fn audit(study: &str, more: &[&str]) -> Done {
    run(&[&["audit", study, "--cases", "4"], more].concat())
}

/// A study, whether its solver `naive` passes and whether `stable` does, and its candidate in
/// Python.
const EXAMPLES: [(&str, &[(&str, i32)]); 11] = [
    ("cancellation", &[("naive", 1), ("stable", 0)]),
    ("quadratic", &[("naive", 1), ("stable", 0)]),
    ("kepler", &[("naive", 1), ("stable", 0)]),
    ("pendulum", &[("naive", 1), ("stable", 0)]),
    ("colebrook", &[("naive", 1), ("stable", 0)]),
    ("four-bar", &[("stable", 0)]),
    ("haversine", &[("naive", 1), ("stable", 0)]),
    ("ndtr", &[("naive", 1), ("stable", 0)]),
    ("erfinv", &[("naive", 1), ("stable", 0)]),
    ("pchip", &[("naive", 1), ("stable", 0)]),
    ("textbook#versine", &[("body", 1)]),
];

#[test]
fn stable_solvers_pass_and_naive_ones_do_not() {
    for (name, solvers) in EXAMPLES {
        for (solver, code) in solvers {
            let d = audit(&example(name), &["--solver", solver]);
            assert_eq!(d.code, *code, "{name} {solver}\n{}{}", d.out, d.err);
            let verdict = if *code == 0 { "  pass  " } else { "  FAIL  " };
            let head = d.out.lines().next().unwrap();
            assert!(head.starts_with(&example(name)), "{head}");
            assert!(head.contains(verdict), "{head}");
            assert!(!d.out.contains("undecided  "), "{name}\n{}", d.out);
        }
    }
    for core in ["logistic", "log-ratio"] {
        let d = audit(&example(&format!("textbook#{core}")), &[]);
        assert_eq!(d.code, 0, "{core}\n{}{}", d.out, d.err);
    }
}

#[test]
#[cfg(unix)]
fn candidates_in_python_pass() {
    let python = std::process::Command::new("python3").arg("-V").output();
    if !python.is_ok_and(|o| o.status.success()) {
        return crate::common::skipped("python3");
    }
    let others = ["voigt", "hilbert", "spring-mass"];
    let names = EXAMPLES.iter().map(|e| e.0).chain(others);
    for name in names {
        let stem = name.rsplit('#').next().unwrap();
        let exec = format!("python3 {FOLDER}/candidates/{stem}.py");
        let d = audit(&example(name), &["--exec", &exec]);
        assert_eq!(d.code, 0, "{name}\n{}{}", d.out, d.err);
    }
}

/// Inputs, and outputs to 30 digits by mpmath 1.3.0 with 60 digits: `ellipk`, `erfc`, `erfinv`,
/// `findroot` and the elementary functions.
const DIGITS: [(&str, &str, &str); 16] = [
    (
        "hilbert",
        "1,1/2,1/3,1/4,1/5,1/2,1/3,1/4,1/5,1/6,1/3,1/4,1/5,1/6,1/7,1/4,1/5,1/6,1/7,1/8,\
         1/5,1/6,1/7,1/8,1/9,1,0,0,0,0",
        "25.0000000000000000000000000000,-300.000000000000000000000000000,\
         1050.00000000000000000000000000,-1400.00000000000000000000000000,\
         630.000000000000000000000000000",
    ),
    (
        "spring-mass",
        "3,-1,-1,2,2,0,0,1",
        "1.00000000000000000000000000000,2.50000000000000000000000000000",
    ),
    (
        "cancellation",
        "1e10",
        "0.00000499999999987500000000625000000",
    ),
    (
        "quadratic",
        "1e6,1e-3",
        "5.00000000000000125000000000000e-10",
    ),
    ("kepler", "1,0.5", "1.49870113351784831405798549726"),
    ("pendulum", "3,1", "5.15894768956106873603978340255"),
    ("colebrook", "1e5,1e-4", "7.34939248695361032261800884603"),
    (
        "four-bar",
        "0.7,0.2,1,0.8",
        "1.69621820895366945114314831682",
    ),
    (
        "haversine",
        "0.5,0.500001,1e-7",
        "0.00000100384336792249776057486038158",
    ),
    (
        "ndtr",
        "-20",
        "2.75362411860623369507562278086e-89,-203.917155371097263936804458655",
    ),
    ("erfinv", "-0.75", "-0.813419847597618541690289359893"),
    (
        "voigt",
        "0.5,1,2",
        "0.242355446715784943367168211294,0.257979380008474952234626227583",
    ),
    ("pchip", "1,2,3,5", "3.64864864864864864864864864865"),
    (
        "textbook#versine",
        "1e-3",
        "0.000000499999958333334722222197420635",
    ),
    (
        "textbook#logistic",
        "-20",
        "2.06115361819020358143086212947e-9",
    ),
    (
        "textbook#log-ratio",
        "0.25",
        "0.510825623765990683205514096304",
    ),
];

#[test]
fn certified_digits_are_those_of_mpmath() {
    for (name, input, due) in DIGITS {
        let d = run_on(
            format!("{input}\n"),
            &["eval", &example(name), "--digits", "30"],
        );
        assert_eq!((d.code, d.out.trim()), (0, due), "{name}: {}", d.err);
    }
}

#[test]
fn a_study_is_described_and_its_points_are_drawn() {
    let kepler = example("kepler");
    let d = run(&["describe", &kepler]);
    assert_eq!(d.code, 0, "{}", d.err);
    let text = d.out.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "The name e is declared and hides the constant.",
        "8 u (1 + cond)",
        "a Newton step ends with a residual of a few roundings",
        "M rad",
    ] {
        assert!(text.contains(part), "{part:?} is missing in\n{}", d.out);
    }
    let d = run(&["points", &kepler, "--region", "domain", "--count", "3"]);
    let rows: Vec<&str> = d.out.lines().filter(|l| !l.starts_with('#')).collect();
    assert_eq!((d.code, rows.len()), (0, 3), "{}{}", d.out, d.err);
    assert!(rows.iter().all(|row| row.split(',').count() == 2));
    let again = run(&["points", &kepler, "--region", "domain", "--count", "3"]);
    assert_eq!(d.out, again.out);
}

#[test]
fn a_printed_table_is_judged_by_a_study() {
    let folder = TempDir::new().unwrap();
    // The last digit of the second row is wrong.
    let table = file(&folder, "t.csv", "M,e,E\n1,0.5,1.49870\n1,0.25,1.23124\n");
    let d = run(&["judge", &example("kepler"), "--table", &table]);
    assert_eq!(d.code, 1, "{}{}", d.out, d.err);
    assert!(d.out.contains("1 of 2 entries do not agree"), "{}", d.out);
}

#[test]
fn every_core_of_a_file_is_audited() {
    let file = format!("{FOLDER}/textbook.fpcore");
    let d = audit(&file, &["--format", "csv"]);
    assert_eq!(d.code, 1, "{}", d.err);
    for core in ["versine", "logistic", "log-ratio"] {
        let head = format!("{file}#{core},");
        let rows = d.out.lines().filter(|l| l.starts_with(&head));
        assert!(rows.count() > 1, "{core} is missing in\n{}", d.out);
    }
    let d = audit(&format!("{file}#versin"), &[]);
    refused(
        &d,
        "there is no core \"versin\" (did you mean \"versine\"?)",
    );
}

#[test]
fn zero_undefined_and_undecided_are_answers() {
    let folder = TempDir::new().unwrap();
    let text = "[inputs]\nx = { from = 0, to = 1 }\n[outputs]\n\
                zero = \"sqrt(2)*sqrt(3) - sqrt(6)\"\nnone = \"log(x - 1)\"\ntwice = \"2*x\"\n";
    let path = file(&folder, "study.toml", text);
    let d = run_on("0.5\n", &["eval", &path, "--digits", "10"]);
    assert_eq!(
        (d.code, d.out.trim()),
        (0, "0,nan,1.000000000"),
        "{}",
        d.err
    );
}

/// The fault, the file, and the words of the message.
fn bad() -> Vec<(&'static str, String, &'static str)> {
    let study =
        |output: &str| format!("[inputs]\nx = {{ from = 0, to = 1 }}\n[outputs]\ny = {output}\n");
    let formula = |text: &str| study(&format!("{{ is = \"{text}\" }}"));
    let many = |text: &str| text.repeat(100_000);
    vec![
        (
            "name.toml",
            formula("sin(xx)"),
            "line 4, column 17: the name xx is not declared (did you mean \"x\"?)",
        ),
        (
            "function.toml",
            formula("sqr(x)"),
            "line 4, column 13: the name sqr is not declared (did you mean \"sqrt\"?)",
        ),
        (
            "arity.toml",
            formula("atan2(x)"),
            "line 4, column 13: atan2 takes 2 arguments, not 1",
        ),
        (
            "bracket.toml",
            formula("sin(x"),
            "line 4, column 18: expected ')'",
        ),
        (
            "empty.toml",
            "[inputs]\nx = { from = 2, to = 1 }\n[outputs]\ny = \"x\"\n".into(),
            "the range of x is empty: 2 to 1",
        ),
        (
            "where.toml",
            format!("where = \"x < 0 and x > 1\"\n{}", formula("x")),
            "line 1, column 9: no input was found that satisfies the conditions of domain: (x < 0) and (x > 1)",
        ),
        (
            "key.toml",
            study("{ is = \"x\", bugdet = \"2 ulp\" }"),
            "there is no key \"bugdet\" (did you mean \"budget\"?)",
        ),
        (
            "table.toml",
            "[input]\n[outputs]\ny = \"1\"\n".into(),
            "there is no key \"input\" (did you mean \"inputs\"?)",
        ),
        (
            "budget.toml",
            study("{ is = \"x\", budget = \"2 pounds\" }"),
            "the budget \"2 pounds\" is none of",
        ),
        (
            "cycle.toml",
            formula("y + x"),
            "the definition of y leads back to y",
        ),
        (
            "condition.toml",
            formula("x < 1"),
            "the output y is a condition, not a number",
        ),
        ("complex.toml", formula("x + i"), "the output y is complex"),
        (
            "root.toml",
            study("{ root_of = \"y - x\" }"),
            "the root y needs between",
        ),
        (
            "solver.toml",
            study("\"x\"\n[solver.s]\nz = \"x\""),
            "the solver s has no formula for y",
        ),
        (
            "outputs.toml",
            "[inputs]\nx = {}\n".into(),
            "a study has at least one output",
        ),
        (
            "nested.toml",
            formula(&format!("{}x{}", many("("), many(")"))),
            "too many brackets",
        ),
        (
            "lists.toml",
            study(&format!("{}1{}", many("["), many("]"))),
            "recurs",
        ),
        (
            "powers.toml",
            formula(&format!("{}x", many("x^"))),
            "too many powers",
        ),
        (
            "nested.fpcore",
            format!("(FPCore (x) {}x{})", many("(sin "), many(")")),
            "too many brackets",
        ),
        (
            "open.fpcore",
            "(FPCore (x) (sin x)".into(),
            "a bracket that is not closed",
        ),
        (
            "name.fpcore",
            "(FPCore (width)\n (sin widht))".into(),
            "line 2, column 7: the name widht is not bound (did you mean \"width\"?)",
        ),
        (
            "operator.fpcore",
            "(FPCore (x) (sqr x))".into(),
            "line 1, column 14: there is no operator sqr (did you mean \"sqrt\"?)",
        ),
        (
            "empty.fpcore",
            "(FPCore (x) :pre (< 2 x 1) x)".into(),
            "line 1, column 18: the range of x is empty: 2 to 1",
        ),
        (
            "where.fpcore",
            "(FPCore (x y) :pre (and (<= 0 x 1) (<= 0 y 1) (> x y) (> y x)) x)".into(),
            "line 1, column 20: no input was found that satisfies the conditions of domain: ",
        ),
        (
            "long.toml",
            format!("{}#{}", formula("x"), "a".repeat(10_000_000)),
            "the file is longer than 4194304 bytes",
        ),
        (
            "long.fpcore",
            format!(";{}", "a".repeat(10_000_000)),
            "the file is longer than 4194304 bytes",
        ),
    ]
}

#[test]
fn bad_files_are_refused_in_one_line() {
    let folder = TempDir::new().unwrap();
    for (name, text, why) in bad() {
        let path = file(&folder, name, &text);
        let begin = Instant::now();
        for command in ["audit", "describe"] {
            let d = run(&[command, &path]);
            refused(&d, why);
            said(&d, name);
            assert!(d.err.len() < 1000, "{}", d.err);
        }
        // Generous: other tests run at the same time.
        assert!(begin.elapsed() < Duration::from_secs(20), "{name}");
    }
    let d = audit(&example("kepler"), &["--solver", "stabel"]);
    refused(
        &d,
        "there is no solver \"stabel\" (did you mean \"stable\"?)",
    );
    refused(&audit(&example("voigt"), &[]), "states no solver");
    refused(&run(&["audit", "missing.toml"]), "cannot read the file");
}

/// A body that asks for another format is no solver, and what is not read is said where a core is
/// missing.
#[test]
fn bodies_in_other_formats_are_no_solvers() {
    let folder = TempDir::new().unwrap();
    let cores = "(FPCore long (x) :precision binary80 (/ x 3))\n(FPCore bad (x) (tensor 1 2))";
    let path = file(&folder, "formats.fpcore", cores);
    let long = format!("{path}#long");
    let d = run_on("1\n", &["eval", &long, "--digits", "5"]);
    assert_eq!((d.code, d.out.as_str()), (0, "0.33333\n"), "{}", d.err);
    refused(&run_on("1\n", &["eval", &long]), "solver");
    let bad = run(&["describe", &format!("{path}#bad")]);
    refused(&bad, "one that is not read: line 2");
}

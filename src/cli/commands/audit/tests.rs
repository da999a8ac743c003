use super::*;

#[test]
fn rates_are_those_of_a_core() {
    assert_eq!(
        rate_of(1000, 2.0, 1),
        "500 cases a second on each of 1 core"
    );
    assert_eq!(
        rate_of(80_000, 2.0, 4),
        "10e3 cases a second on each of 4 cores"
    );
    assert_eq!(
        rate_of(79_992, 2.0, 4),
        "9999 cases a second on each of 4 cores"
    );
    assert_eq!(rate_of(0, 0.0, 2), "0 cases a second on each of 2 cores");
}

/// Judging takes time, that of all methods together; a page that is ended before its last part is
/// not whole.
#[test]
fn methods_one_after_the_other() {
    let settings = Settings {
        cases_per_region: 1,
        ..Settings::default()
    };
    let progress = Progress::new();
    let mut panel = Panel::new(&progress);
    let mut before = 0.0;
    let mut reports = Vec::new();
    for name in ["slider-crank", "four-bar"] {
        let method = lookup::method(name).unwrap();
        reports.push(panel.judge(&*method, &settings));
        let seconds = panel.seconds;
        assert!(seconds > before, "{name}: {seconds} s after {before} s");
        before = seconds;
    }
    let cases = reports[0].cases + reports[1].cases;
    let each = cases as f64 / before / rayon::current_num_threads() as f64;
    let said = panel.rate(&reports);
    assert!(
        each > 1e4 || said.starts_with(&format!("{each:.0} cases")),
        "{said}"
    );
    let ended = |extras: ReportExtras| {
        let mut reports = reports.clone();
        mark_incomplete(&extras, &mut reports);
        [reports[0].interrupted, reports[1].interrupted]
    };
    assert_eq!(ended(ReportExtras::default()), [false, true]);
    let whole = ReportExtras {
        approximations: Some(Vec::new()),
        ..ReportExtras::default()
    };
    assert_eq!(ended(whole), [false, false]);
}

use crate::cli::args::{Args, Command};
use crate::cli::ran;
use clap::Parser;
use serde_json::Value;
use std::path::Path;

fn arguments(words: &[&str]) -> AuditArgs {
    let read = Args::try_parse_from([&["mechaudit", "audit"], words].concat());
    match read.unwrap().command {
        Some(Command::Audit(args)) => args,
        other => panic!("{other:?}"),
    }
}

/// An audit that writes a file: what it came to, and the file.
fn audited(words: &[&str]) -> (Outcome, String) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report");
    let output = ["--output", file.to_str().unwrap()];
    let outcome = ran(&[&["audit"], words, &output].concat()).unwrap();
    (outcome, std::fs::read_to_string(file).unwrap())
}

fn refused(words: &[&str]) -> String {
    let found = ran(&[&["audit"], words].concat());
    found
        .map(|_| panic!("{words:?} is done"))
        .unwrap_or_else(|e: Failure| e.to_string())
}

fn json(words: &[&str]) -> Value {
    let (_, text) = audited(&[words, &["--format", "json"]].concat());
    serde_json::from_str(&text).unwrap()
}

#[test]
fn an_outcome_has_its_end() {
    for (outcome, due) in [
        (Outcome::AsExpected, End::AsExpected),
        (Outcome::Finding, End::NotAsExpected),
        (Outcome::Interrupted, End::Interrupted),
    ] {
        assert!(end(outcome) == due);
    }
}

/// The command of a case says how it was judged.
#[test]
fn options_that_change_a_verdict_are_in_the_command_of_a_case() {
    let of = |words: &[&str]| {
        let args = arguments(&[&["erf"], words].concat());
        reproduce_command(candidate(&args).as_ref(), selection(&args))
    };
    assert_eq!(of(&["--cases", "5", "--region", "mid"]), "");
    let program = ["--exec", "./my w", "--decimal"];
    assert_eq!(of(&program), " --exec './my w' --decimal");
    assert_eq!(of(&["--exec", "w", "--binary"]), " --exec w --binary");
    let strict = [
        "--outputs",
        "Re erf,Im erf",
        "--ulps",
        "2",
        "--normwise",
        "0.5",
        "--single",
    ];
    assert_eq!(
        of(&strict),
        " --outputs 'Re erf,Im erf' --ulps 2.0 --normwise 0.5 --single"
    );
    let limits = ["--relative", "1e-9", "--absolute", "0.25"];
    assert_eq!(of(&limits), " --relative 1e-9 --absolute 0.25");
    let place = ["--ordinary", "--region", "mid", "--region", "small"];
    assert_eq!(of(&place), "");
    assert_eq!(
        of(&[&place[..], &["--box", "Re z=0..1"]].concat()),
        " --region mid --region small --ordinary"
    );
}

/// The report of a single input shows everything that is known of it.
#[test]
fn an_input_is_judged_by_itself() {
    let v = json(&["erf", "--at", "0.5,-0.25"]);
    let m = &v["methods"][0];
    assert_eq!(
        (&m["cases"], &m["regions"][0]["name"]),
        (&1.into(), &"given".into())
    );
    assert_eq!(
        m["worst"][0]["case"]["input"],
        serde_json::json!([0.5, -0.25])
    );
    let (outcome, text) = audited(&["erf", "--at", "0.5,-0.25"]);
    assert_eq!(outcome, Outcome::AsExpected);
    // One case is no sum of cases.
    assert!(!text.contains("1 case"), "{text}");
    // In single precision the nearest number that it has.
    let v = json(&["erf", "--at", "0.1,0", "--single"]);
    let single = f64::from(0.1_f32);
    assert_eq!(v["methods"][0]["worst"][0]["case"]["input"][0], single);
    for (numbers, n) in [("1", "1 number"), ("1,2,3", "3 numbers")] {
        let why = refused(&["erf", "--at", numbers]);
        let due = format!("--at: {n} cannot be an input of erf, which is: Re z, Im z");
        assert_eq!(why, due);
    }
}

#[test]
fn one_case_is_that_of_its_place() {
    let method = lookup::method("erf").unwrap();
    let settings = Settings::default();
    let cases = Cases::new(&*method, &settings);
    let input = |words: &[&str]| {
        let v = json(&[&["erf"], words].concat());
        let m = &v["methods"][0];
        assert_eq!(m["cases"], 1, "{words:?}");
        let input = m["worst"][0]["case"]["input"].as_array().unwrap();
        input
            .iter()
            .map(|x| x.as_f64().unwrap())
            .collect::<Vec<_>>()
    };
    // Numbers read from JSON may be off in their last digit.
    let near = |a: Vec<f64>, b: &[f64]| {
        let same = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-15 * b.abs();
        assert!(
            a.len() == b.len() && a.iter().zip(b).all(same),
            "{a:?} for {b:?}"
        );
    };
    let drawn = cases.in_region("mid", 3).unwrap().input;
    near(input(&["--region", "mid", "--case", "3"]), &drawn);
    let hard = cases.hard_case(1).unwrap().input;
    near(input(&["--hard-case", "1"]), &hard);
    let points = method.domain().check_points;
    let finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
    let point = points.iter().find(|p| finite(&p.input)).unwrap();
    near(input(&["--check-point", point.name]), &point.input);
    assert_eq!(
        refused(&["erf", "--case", "3"]),
        "--case: of which region? Give --region, --box or --near"
    );
    assert_eq!(
        refused(&["erf", "--region", "mid", "--region", "small", "--case", "3"]),
        "--case: of which of the regions? Give one"
    );
    let why = refused(&["erff"]);
    assert!(
        why.starts_with("there is no method \"erff\" (did you mean \"erf\"?)"),
        "{why}"
    );
}

/// Check points, hard cases and regions are what is judged, or the regions alone that are asked
/// for.
#[test]
fn regions_are_those_asked_for() {
    let names = |words: &[&str]| {
        let v = json(&[&["erf", "--cases", "1"], words].concat());
        let regions = v["methods"][0]["regions"].as_array().unwrap().clone();
        regions
            .into_iter()
            .map(|r| r["name"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(&["--region", "mid"]), ["mid"]);
    let two = names(&["--region", "small", "--region", "mid"]);
    assert!(
        two.len() == 2 && two.iter().all(|r| r == "mid" || r == "small"),
        "{two:?}"
    );
    let (all, ordinary) = (names(&[]), names(&["--ordinary"]));
    assert!(
        all.contains(&"check-points".to_owned()) && all.len() > 4,
        "{all:?}"
    );
    assert!(ordinary.len() < all.len() && ordinary.len() > 2);
    assert_eq!(names(&["--box", "Re z=0..1,Im z=0..1"]), ["box"]);
    // Numbers that a box does not name are drawn from the regions.
    assert_eq!(names(&["--box", "Re z=0..1", "--region", "mid"]), ["mid"]);
    assert_eq!(names(&["--near", "0.5,0.5", "--radius", "0.1"]), ["near"]);
}

/// A page has a map of the errors, other forms if it is asked for.
#[test]
fn maps_are_on_pages_and_where_they_are_asked_for() {
    let mapped = |words: &[&str]| {
        let all = [&["erf", "--region", "mid", "--cases", "1"], words].concat();
        json(&all)["methods"][0]["map"].is_object()
    };
    assert!(!mapped(&[]) && mapped(&["--maps"]));
    let settings =
        |words: &[&str]| super::settings(&arguments(&[&["erf"], words].concat())).unwrap();
    for (words, maps, points) in [
        (&["--format", "html"][..], true, report::POINTS),
        (&["--format", "html", "--exec", "w"], false, report::POINTS),
        (&["--exec", "w"], false, 0),
        (&["--format", "csv"], false, 0),
        (&["--format", "json", "--maps"], true, 0),
    ] {
        let s = settings(words);
        assert_eq!((s.maps, s.points), (maps, points), "{words:?}");
    }
}

/// Of the points of a map only those are waited for that are judged.
#[test]
fn work_is_the_cases_and_the_points_of_a_map() {
    let method = lookup::method("erf").unwrap();
    let settings = |maps: bool| Settings {
        maps,
        cases_per_region: 2,
        ..Settings::default()
    };
    let cases = Cases::new(&*method, &settings(false)).len();
    assert_eq!(work(&*method, &settings(false)), cases as u64);
    let points = map_points(&*method).unwrap();
    assert_eq!(work(&*method, &settings(true)), (cases + points) as u64);
    let plain = lookup::method("slider-crank").unwrap();
    assert!(map_points(&*plain).is_none());
    let cases = Cases::new(&*plain, &settings(true)).len();
    assert_eq!(work(&*plain, &settings(true)), cases as u64);
}

/// Every form of the report is of the same audit.
#[test]
fn an_audit_is_written_in_the_form_asked_for() {
    let of = |format: &str| {
        let (outcome, text) = audited(&["slider-crank", "--cases", "1", "--format", format]);
        assert_eq!(outcome, Outcome::AsExpected, "{format}");
        text
    };
    let text = of("text");
    assert!(
        text.starts_with("slider-crank") && text.lines().last().unwrap().contains("1 method"),
        "{text}"
    );
    assert!(of("csv").starts_with("method,"));
    assert!(of("junit").starts_with("<?xml"));
    assert!(of("html").starts_with("<!doctype html>"));
    let v: Value = serde_json::from_str(&of("json")).unwrap();
    assert!(v["passed"] == true && v["baseline"].is_null());
}

/// Text and JSON show the changes since an earlier report.
#[test]
fn changes_since_a_baseline_are_said() {
    let folder = tempfile::tempdir().unwrap();
    let before = folder.path().join("before.json");
    let name = before.to_str().unwrap();
    let case = ["erf", "--region", "mid", "--cases", "2"];
    ran(&[
        &["audit"],
        &case[..],
        &["--format", "json", "--output", name],
    ]
    .concat())
    .unwrap();
    let since = [&case[..], &["--baseline", name]].concat();
    assert!(json(&since)["baseline"].is_object() || json(&since)["baseline"].is_array());
    let (plain, text) = (audited(&case).1, audited(&since).1);
    assert!(
        text.starts_with(&plain) && text.len() > plain.len(),
        "{text}"
    );
    let html = [&since[..], &["--format", "html"]].concat();
    assert_eq!(
        refused(&html),
        "--baseline: changes are shown in text and json"
    );
    assert!(report::baseline(None, AuditFormat::Html).unwrap().is_none());
    assert!(report::baseline(Some(Path::new("none")), AuditFormat::Text).is_err());
}

/// The sum stands below several cases, and below a report that was ended early.
#[test]
fn one_case_needs_no_sum() {
    let settings = Settings {
        cases_per_region: 2,
        ..Settings::default()
    };
    let method = lookup::method("slider-crank").unwrap();
    let case = Cases::new(&*method, &settings).get(0);
    let single = audit_one(&*method, case, None, &settings);
    let many = Panel::new(&Progress::new()).judge(&*method, &settings);
    let shown = |reports: &[MethodReport]| {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("report");
        let output = Output::open(Some(&file)).unwrap();
        let outcome = report::write(reports, AuditFormat::Text, output, &ReportExtras::default());
        (outcome.unwrap(), std::fs::read_to_string(file).unwrap())
    };
    let ends = |text: &str, reports: &[MethodReport], mark: &str| {
        text.ends_with(&format!("\n{mark}{}.\n", totals(reports)))
    };
    let one = [single.clone()];
    let (outcome, plain) = shown(&one);
    assert_eq!(outcome, Outcome::AsExpected);
    let due = text::style::plain(&report::in_words(&single));
    assert_eq!(plain, format!("{due}\n"));
    let all = [many.clone()];
    assert!(ends(&shown(&all).1, &all, ""));
    for report in [single, many] {
        let cut = [MethodReport {
            interrupted: true,
            ..report
        }];
        let (outcome, said) = shown(&cut);
        assert_eq!(outcome, Outcome::Interrupted);
        assert!(ends(&said, &cut, "Interrupted: "), "{said}");
    }
}

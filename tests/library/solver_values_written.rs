//! Certified values for the solvers alone: `tests/solver_values/`.
//!
//! `cargo test --release --test library solver_values_written -- --ignored` writes the files anew;
//! `src/solvers/tests` holds the solvers to them without GMP or MPFR.

use mechaudit::audit::{Case, CaseReport, Cases, Limit, Method, Origin, Settings, Verdict};
use mechaudit::audit::{SolverAnswer, judge_case};
use mechaudit::methods::registry;
use std::collections::HashMap;
use std::fmt::Write;
use std::path::PathBuf;

const HEADER: &str = "place,input,value,allowed\n";

/// How much worse than the worst of its region at the time of writing a value may be. It never may
/// be over budget.
const SLACK: f64 = 2.0;

fn path(method: &dyn Method) -> PathBuf {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/solver_values");
    PathBuf::from(folder).join(format!("{}.csv", method.name()))
}

/// Few cases of methods with long inputs, many of functions of a point.
fn per_region(method: &dyn Method) -> u64 {
    match method.name() {
        "run-up" => 1,
        "planar-linkage" | "planar-reduction" | "planar-reactions" => 3,
        "class-iii" | "class-iii-assembly-modes" => 8,
        "faddeeva" => 50,
        _ if of_a_point(method) => 30,
        _ => 14,
    }
}

fn of_a_point(method: &dyn Method) -> bool {
    method.inputs().len() == 2 && method.inputs()[1].name.contains("Im")
}

/// Points on both axes and on rays between them, from the subnormal to the huge: every formula on
/// both sides of every seam of the moduli.
fn rays() -> Vec<Vec<f64>> {
    let mut all = Vec::new();
    let tiny = [5e-324, 1e-310, 1e-200, 1e-100, 1e-20, 1e-8, 1e-4, 2e-3];
    let usual = (1..=60).map(|k| f64::from(k) * 0.127);
    let large = [
        7.7, 8.4, 10.3, 12.2, 15.1, 20.0, 26.1, 27.3, 38.5, 71.0, 1e3, 1e5, 1e8, 1e20,
    ];
    let huge = [1e99, 1e101, 1e154, 1e200, 1e300, 1e308];
    let moduli = tiny.into_iter().chain(usual).chain(large).chain(huge);
    for (k, r) in moduli.enumerate() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        all.push(vec![sign * r, 0.0]);
        all.push(vec![0.0, sign * r]);
        // A direction that turns from modulus to modulus.
        let (s, c) = (0.7 * k as f64).sin_cos();
        all.push(vec![r * c, r * s]);
    }
    all
}

fn cases(method: &dyn Method) -> Vec<Case> {
    let settings = Settings {
        cases_per_region: per_region(method),
        ..Settings::default()
    };
    let cases = Cases::new(method, &settings);
    let mut all: Vec<Case> = (0..cases.len()).map(|i| cases.get(i)).collect();
    if of_a_point(method) {
        all.extend(rays().into_iter().enumerate().map(|(i, input)| Case {
            method: method.name(),
            region: "ray",
            input,
            origin: Origin::Line {
                number: i as u64 + 1,
            },
        }));
    }
    all
}

fn place(case: &Case) -> String {
    match &case.origin {
        Origin::CheckPoint { name } => (*name).into(),
        Origin::Random { index, .. } => format!("{}-{index}", case.region),
        Origin::Hard { number, .. } => format!("hard-{number}"),
        Origin::Line { number } => format!("{}-{number}", case.region),
        Origin::Given | Origin::Box { .. } | Origin::Near { .. } => {
            unreachable!("no case of a domain")
        }
    }
}

fn ulp(x: f64) -> f64 {
    let x = x.abs().min(f64::MAX.next_down());
    x.next_up() - x
}

/// What the budget allows each value.
fn budget(method: &dyn Method, case: &Case, values: &[f64]) -> Vec<f64> {
    let outputs = method.outputs();
    let needed = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    let finite = case.input.iter().all(|x| x.is_finite());
    let conditions = if needed && finite {
        method.conditions(&case.input)
    } else {
        None
    };
    let size = |i: usize| values[i].abs() + conditions.as_ref().map_or(f64::NAN, |c| c[i]);
    let u = f64::EPSILON / 2.0;
    (0..values.len())
        .map(|i| match outputs[i % outputs.len()].budget.limit {
            Limit::Ulps(k) => k * ulp(values[i]),
            Limit::Conditioned(k) => k * u * size(i),
            Limit::Normwise(k) => {
                let is_one = |i: &usize| {
                    matches!(outputs[i % outputs.len()].budget.limit, Limit::Normwise(_))
                };
                let all = (0..values.len()).filter(is_one);
                k * u * all.map(size).fold(0.0, f64::max)
            }
            other => unreachable!("no method's own limit: {other}"),
        })
        .collect()
}

fn numbers(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|x| format!("{x:?}")).collect();
    texts.join(" ")
}

/// The values to 20 digits, where every one is certified.
fn digits(report: &CaseReport) -> Option<Vec<String>> {
    let Some(SolverAnswer::Values(got)) = &report.answer else {
        return None;
    };
    let texts = report
        .reference
        .iter()
        .zip(got)
        .map(|(text, got)| match text {
            Some(text) => Some(text.clone()),
            // Far below every number, of either sign.
            None => (*got == 0.0).then(|| "0".into()),
        });
    texts.collect()
}

fn line(report: &CaseReport, value: &str, allowed: &str) -> String {
    format!(
        "{},{},{value},{allowed}\n",
        place(&report.case),
        numbers(&report.case.input)
    )
}

fn computed(method: &dyn Method) -> String {
    let settings = Settings::default();
    let reports: Vec<CaseReport> = cases(method)
        .into_iter()
        .map(|case| {
            let answer = mechaudit::audit::answer_of(method, &case.input);
            judge_case(method, case, answer, &settings)
        })
        .collect();
    // The worst share of the budget in each region, by output.
    let mut worst: HashMap<(&str, &str), f64> = HashMap::new();
    for r in &reports {
        for c in &r.judgement.components {
            let share = worst.entry((r.case.region, c.output)).or_default();
            *share = share.max(c.of_budget);
        }
    }
    let outputs = method.outputs();
    let mut text = String::from(HEADER);
    for r in &reports {
        let known = matches!(r.case.origin, Origin::Hard { .. });
        assert!(
            known || r.judgement.verdict == Verdict::Pass,
            "{}",
            place(&r.case)
        );
        if let Some(word) = r.answer.as_ref().and_then(SolverAnswer::refusal) {
            text += &line(r, &format!("refused: {word}"), "");
            continue;
        }
        let Some(digits) = digits(r) else {
            continue;
        };
        let values: Vec<f64> = digits
            .iter()
            .map(|d| d.parse().expect("a number"))
            .collect();
        let mut allowed = String::new();
        for (i, b) in budget(method, &r.case, &values).iter().enumerate() {
            let o = &outputs[i % outputs.len()];
            let k = o.budget.limit.factor();
            // At least a unit in the last place.
            let least = match o.budget.limit {
                Limit::Ulps(_) => 1.0 / k,
                _ => 2.0 / k,
            };
            let found = worst[&(r.case.region, o.name)];
            let share = (SLACK * found).max(least).min(1f64.max(1.01 * found));
            let separator = if i == 0 { "" } else { " " };
            let _ = write!(
                allowed,
                "{separator}{:.2e}",
                (1.006 * share * b).max(5e-324)
            );
        }
        text += &line(r, &digits.join(" "), &allowed);
    }
    text
}

/// Input and values of each line, without what is allowed: that depends on the platform's
/// elementary functions.
fn facts(text: &str) -> Vec<&str> {
    text.lines()
        .map(|l| l.rsplit_once(',').expect("four columns").0)
        .collect()
}

#[test]
fn as_recorded() {
    for method in registry() {
        // Enclosing motions takes minutes; tests/run_up_values.rs compares some.
        if method.name() == "run-up" {
            continue;
        }
        let recorded = std::fs::read_to_string(path(&*method)).expect("recorded");
        let recorded = facts(&recorded);
        for (i, case) in cases(&*method).into_iter().enumerate().step_by(29) {
            let name = place(&case);
            let answer = mechaudit::audit::answer_of(&*method, &case.input);
            let report = judge_case(&*method, case, answer, &Settings::default());
            let Some(digits) = digits(&report) else {
                continue;
            };
            let line = line(&report, &digits.join(" "), "");
            let line = line.trim_end().trim_end_matches(',');
            assert!(
                recorded.contains(&line),
                "{} {name}, case {i}",
                method.name()
            );
        }
    }
}

#[test]
#[ignore = "writes the files"]
fn write() {
    for method in registry() {
        let path = path(&*method);
        // Enclosed motions: tests/run_up_values.rs.
        if method.name() == "run-up" {
            continue;
        }
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("made");
        std::fs::write(&path, computed(&*method)).expect("written");
    }
}

//! The solvers' values bit by bit, a digest for each method and region.
//!
//! A digest that changes says that a value changed, not that it became worse. The test names the
//! blocks of cases that changed, judges some of each and says how they stand to their budgets. The
//! Faddeeva family is left out: its bits, on many more points, are those of
//! `tests/solver_values/bits.csv`.

use crate::pinned::{Digest, cut, drawn};
use mechaudit::audit::{Case, Method, Settings, answer_of, judge_case};
use mechaudit::methods::registry;
use std::collections::HashSet;
use std::fmt::Write;

/// Cases that are judged of a block that has changed.
const JUDGED: usize = 5;

/// Methods that use no function of the system's mathematical library.
fn is_portable(name: &str) -> bool {
    name.contains("tridiagonal")
        || name.starts_with("cubic-spline")
        || ["pchip", "akima", "modified-akima"].contains(&name)
}

/// Methods whose bits `tests/solver_values/bits.csv` holds.
const FADDEEVA: [&str; 9] = [
    "faddeeva",
    "faddeeva-derivative",
    "erf",
    "erfc",
    "erfcx",
    "erfi",
    "dawson",
    "voigt",
    "voigt-hwhm",
];

fn per_region(name: &str) -> u64 {
    match name {
        "run-up" => 4,
        _ if name.starts_with("planar") => 12,
        _ if name.starts_with("class-iii") => 60,
        _ => 200,
    }
}

/// The cases of a region, their inputs cut: the last bits of a draw come from the system's
/// logarithm.
fn blocks(method: &dyn Method) -> Vec<Vec<Case>> {
    let cases = drawn(method, per_region(method.name()));
    let blocks = cases.chunk_by(|a, b| a.region == b.region);
    let blocks = blocks.filter(|b| b[0].region != "hard");
    let kept = |case: &Case| match case.region {
        "check-points" => case.clone(),
        _ => Case {
            input: case.input.iter().map(|x| cut(*x)).collect(),
            ..case.clone()
        },
    };
    blocks.map(|b| b.iter().map(kept).collect()).collect()
}

fn line(method: &dyn Method, block: &[Case]) -> String {
    let mut digest = Digest::new();
    for case in block {
        digest.add(answer_of(method, &case.input));
    }
    let name = method.name();
    format!(
        "{name}, {}: {} cases, {}",
        block[0].region,
        block.len(),
        digest.text()
    )
}

/// How some cases of a block stand to their budgets.
fn standing(method: &dyn Method, block: &[Case]) -> String {
    let worst = block.iter().step_by(block.len().div_ceil(JUDGED)).map(|c| {
        let answer = answer_of(method, &c.input);
        let judged = judge_case(method, c.clone(), answer, &Settings::default()).judgement;
        let shares = judged.components.iter().map(|c| c.of_budget);
        (judged.verdict, shares.fold(0.0, f64::max))
    });
    let worst: Vec<String> = worst
        .map(|(v, share)| format!("{v:?} {share:.2}"))
        .collect();
    worst.join(", ")
}

/// A digest of the elementary functions that this platform has.
fn elementary() -> String {
    let mut digest = Digest::new();
    for k in 0..4000 {
        let x = 0.37 + f64::from(k) * 0.001_953_125 * 1.618;
        let values = [x.sin(), x.cos(), (x / 8.0).exp(), x.ln(), x.atan2(1.3)];
        digest.add(values.map(f64::to_bits));
        let values = [
            x.tan(),
            (x / 9.0).acos(),
            x.hypot(0.7),
            x.powf(0.3),
            x.cbrt(),
        ];
        digest.add(values.map(f64::to_bits));
    }
    digest.text()
}

/// Compares with a snapshot. Of blocks that have changed it says first how accurate they are.
fn hold(name: &str, head: &str, chosen: impl Fn(&str) -> bool) {
    let held = format!("{}/snapshots/{name}.snap", env!("CARGO_MANIFEST_DIR"));
    let held = std::fs::read_to_string(held).unwrap_or_default();
    let known: HashSet<&str> = held.lines().collect();
    let mut text = String::from(head);
    for method in registry().iter().filter(|m| chosen(m.name())) {
        for block in blocks(&**method) {
            let line = line(&**method, &block);
            if !known.contains(&line[..]) {
                let said = standing(&**method, &block);
                eprintln!("other bits: {line}");
                eprintln!("    verdicts and shares of budgets of some of these cases: {said}");
                eprintln!("    `mechaudit audit {}` judges more", method.name());
            }
            writeln!(text, "{line}").expect("text");
        }
    }
    crate::pin(name, &text);
}

#[test]
fn of_arithmetic_alone() {
    hold("solver-bits", "", is_portable);
}

/// These bits depend on the platform's elementary functions; where they are others than at the time
/// of writing, nothing can be compared.
#[test]
fn of_elementary_functions() {
    let head = format!("elementary functions: {}\n", elementary());
    let held = include_str!("../../snapshots/solver-bits-elementary.snap");
    let rewritten = std::env::var("INSTA_UPDATE").is_ok_and(|v| v == "always");
    if held.contains(&head) || rewritten {
        let chosen = |name: &str| !is_portable(name) && !FADDEEVA.contains(&name);
        hold("solver-bits-elementary", &head, chosen);
    } else {
        eprintln!("not compared: this platform has other elementary functions");
    }
}

//! Tests of `summary`.

use super::super::method::tests::{fabricated as method, passing};
use super::super::paper::tests::fabricated as paper_report;
use super::super::style::plain;
use super::*;
use crate::report::gallery::Gallery;

/// News of laws and cases, those that are not shown counted; nothing new without a heading; each
/// width down to where a title is cut between words.
#[test]
fn summaries() {
    let mut all = Gallery::default();
    for failed in [3, 4] {
        let mut report = method();
        report.total.passed = report.total.cases - failed;
        all.add(
            format!("news of {failed}"),
            news(&[paper_report()], &[report], 80),
        );
    }
    let mut report = method();
    (report.failures, report.worst) = (Vec::new(), Vec::new());
    let mut holding = report.laws[0].clone();
    (holding.name, holding.worst) = ("another", 0.5);
    report.laws.push(holding);
    report.laws[0].worst = f64::NAN;
    all.add("news of a law", news(&[], &[report.clone()], 80));
    report.laws[0].worst_case = method().failures[0].case.clone().into();
    all.add("with its worst case", news(&[], &[report.clone()], 80));
    all.add("no news", news(&[], &[passing()], 80));
    (report.interrupted, report.method) = (true, "a-method-whose-name-is-as-long-1");
    for width in [40, 60, 80] {
        let reports = [method(), passing(), report.clone()];
        all.add(format!("methods on {width}"), methods(&reports, width));
    }
    let mut long = paper_report();
    long.findings[1].title = "ω is too large ".repeat(9);
    for width in [60, 80, 140] {
        let text = paper(&long, width);
        assert!(
            plain(&text).lines().all(|l| l.chars().count() <= width),
            "{text}"
        );
        all.add(format!("paper on {width}"), text);
    }
    for (end, of) in [
        (End::NotAsExpected, &[method()][..]),
        (End::AsExpected, &[passing(), passing()]),
        (End::Interrupted, &[]),
    ] {
        let mut one = paper_report();
        one.findings.truncate(2 - of.len().min(1));
        all.add("everything", everything((end, "1.5 s"), &[one], of, 80));
    }
    all.add(
        "nothing",
        everything((End::AsExpected, "1.5 s"), &[], &[], 200),
    );
    all.pin("summaries");
}

#[test]
fn a_title_is_cut_between_words() {
    for (room, due) in [
        (11, "one two six"),
        (10, "one two …"),
        (9, "one two …"),
        (8, "one …"),
        (1, "one …"),
    ] {
        assert_eq!(first_line("one two six", room), due, "{room}");
    }
}

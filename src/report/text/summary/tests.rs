//! Tests of `summary`.

use super::super::method::tests::{fabricated as method, passing};
use super::super::paper::tests::fabricated as paper_report;
use super::super::style::plain;
use super::*;

#[test]
fn what_is_over_budget_or_not_as_recorded_is_shown() {
    let text = plain(&news(&[paper_report()], &[method()], 80));
    for part in [
        "NOT AS RECORDED",
        "✗ The step is small enough",
        "a-method",
        "over budget",
        "reproduce  mechaudit audit a-method --region wide --seed 1 --case 17",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    // A recorded finding is no news.
    assert!(!text.contains("The mass of link 4"), "{text}");
}

#[test]
fn failing_cases_that_are_not_shown_are_counted() {
    for (failed, more) in [
        (3, None),
        (4, Some("\n  1 more: mechaudit audit a-method\n")),
    ] {
        let mut report = method();
        report.total.passed = report.total.cases - failed;
        let text = plain(&news(&[], &[report], 80));
        assert_eq!(text.contains(" more: "), more.is_some(), "{text}");
        assert!(text.contains(more.unwrap_or_default()), "{text}");
    }
}

#[test]
fn a_law_that_fails_is_news() {
    let mut report = method();
    report.laws[0].worst = f64::NAN;
    let text = plain(&news(&[], &[report], 80));
    assert!(text.contains("law energy does not hold"), "{text}");
}

#[test]
fn a_passing_method_is_no_news() {
    assert_eq!(news(&[], &[passing()], 80), "");
}

#[test]
fn a_line_for_each_method() {
    let mut passing = passing();
    passing.method = "a-method-whose-name-is-as-long-1";
    let reports = [method(), passing];
    let text = plain(&methods(&reports, 80));
    let lines: Vec<&str> = text.lines().collect();
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(words(lines[1]), "a-method 400 7.25 – 175.0 % FAIL: 1");
    assert!(lines[2].ends_with("pass"), "{text}");
    for width in [40, 60, 80] {
        let text = plain(&methods(&reports, width));
        let longest = text.lines().map(|l| l.chars().count()).max().unwrap();
        assert!(longest <= width.max(54) && text.contains("FAIL"), "{text}");
    }
}

#[test]
fn a_line_for_each_finding() {
    let mut report = paper_report();
    report.findings[1].title = "ω is too large ".repeat(9);
    for width in [60, 80, 140] {
        let text = plain(&paper(&report, width));
        assert!(text.contains("\n  + The mass of link 4 is not printed\n"));
        assert!(!text.contains("It follows from"), "{text}");
        assert!(
            text.contains("\n  ✗ ω is") && text.lines().count() == 4,
            "{text}"
        );
        assert!(text.lines().all(|l| l.chars().count() <= width), "{text}");
    }
    report.findings[1].title = "ω is too large".into();
    assert!(plain(&paper(&report, 18)).contains("✗ ω is too large\n"));
    assert!(!plain(&paper(&report, 17)).contains("large"));
}

#[test]
fn the_verdict_comes_first_and_the_way_to_details_last() {
    let (papers, methods) = ([paper_report()], [method()]);
    let text = everything((End::NotAsExpected, "1.5 s"), &papers, &methods, 80);
    let text = plain(&text);
    let place = |part: &str| text.find(part).unwrap_or_else(|| panic!("{part}\n{text}"));
    let order = [
        "NOT as expected: 1 paper with 2 findings; 0 of 1 methods pass, 1 of 400 cases\nfailed.\n",
        "seed 1, ",
        "1.5 s\n",
        "New or over budget\n",
        "NOT AS RECORDED",
        "reproduce",
        "method  ",
        "nobody: A. Nobody (1900), 2 findings, 1 NOT as recorded\n",
        "Details: ",
    ];
    let places: Vec<usize> = order.iter().map(|p| place(p)).collect();
    assert!(places.is_sorted() && places[0] == 0, "{places:?}\n{text}");
    let commands = |l: &&str| !l.contains("reproduce");
    let mut lines = text.lines().filter(commands);
    assert!(lines.all(|l| l.chars().count() <= 80), "{text}");
}

#[test]
fn the_verdict_says_what_came_of_it_and_how() {
    for (end, word, style) in [
        (End::AsExpected, "All as expected", GOOD),
        (End::NotAsExpected, "NOT as expected", BAD),
        (End::Interrupted, "Interrupted", BAD),
    ] {
        let text = verdict(end, "1 method", &["seed 1".into(), "2 s".into()], 80);
        let head = format!("{}: 1 method.\n", paint(style, word));
        let tail = format!("{}\n{}\n", paint(DIM, "seed 1"), paint(DIM, "2 s"));
        assert_eq!(text, head + &tail);
    }
}

#[test]
fn nothing_new_has_no_heading() {
    let mut report = paper_report();
    report.findings.remove(1);
    let (papers, mut methods) = ([report], vec![passing(); 2]);
    methods[1].settings.seed = 9;
    let text = plain(&everything(
        (End::AsExpected, "1.5 s"),
        &papers,
        &methods,
        200,
    ));
    let start = "All as expected: 1 paper with 1 finding; 2 methods pass, 800 cases.\nseed 1, ";
    assert!(text.starts_with(start), "{text}");
    assert!(
        !text.contains("New or over budget") && !text.contains("seed 9"),
        "{text}"
    );
    let text = plain(&everything((End::AsExpected, "1.5 s"), &[], &[], 200));
    assert!(text.starts_with(
        "All as expected: 0 papers with 0 findings; 0 methods pass, 0 cases.\n1.5 s\n"
    ));
}

#[test]
fn news_of_a_law_have_its_worst_case() {
    let mut report = method();
    report.laws[0].worst = 2.0;
    report.failures.clear();
    report.worst.clear();
    let mut holding = report.laws[0].clone();
    (holding.name, holding.worst) = ("another", 0.5);
    report.laws.push(holding);
    let text = plain(&news(&[], &[report.clone()], 80));
    let due = "\na-method\n  law energy does not hold: The sum is constant within 4 ulp.\n";
    assert_eq!(text, due);
    report.laws[0].worst_case = method().failures[0].case.clone().into();
    let text = plain(&news(&[], &[report], 80));
    let again = "    reproduce  mechaudit audit a-method --region wide --seed 1 --case 17\n";
    assert_eq!(text, format!("{due}{again}"));
}

#[test]
fn an_interrupted_method_has_no_count() {
    let mut report = method();
    report.interrupted = true;
    let text = plain(&methods(&[report], 80));
    assert!(text.ends_with("  interrupted\n"), "{text}");
    assert!(
        text.starts_with("method    cases  ulps  u(1+cond)  of budget  verdict\n"),
        "{text}"
    );
}

#[test]
fn a_title_is_cut_between_words() {
    for (room, due) in [
        (11, "one two six"),
        (10, "one two …"),
        (9, "one two …"),
        (8, "one …"),
        (5, "one …"),
        (1, "one …"),
    ] {
        assert_eq!(first_line("one two six", room), due, "{room}");
    }
    let mut report = paper_report();
    report.findings.truncate(1);
    report.findings[0].as_recorded = false;
    let text = plain(&paper(&report, 80));
    let due = "nobody: A. Nobody (1900), 1 finding, 1 NOT as recorded\n  1 recovered\n  + The mass of link 4 is not printed\n";
    assert_eq!(text, due);
}

//! The report of everything in brief: what failed or is new, a line for each method and finding.

use super::method::failing;
use super::style::{self, BAD, BOLD, DIM, GOOD, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use super::{case, paper as papers};
use crate::audit::MethodReport;
use crate::papers::PaperReport;
use crate::report::words::audit as of;
use crate::report::words::audit::{Worst, holds, settings, share, totals};
use crate::report::words::numbers::{count, percent};
use crate::report::words::paper::{kinds, mark, recorded};

/// Failing cases shown for each method.
const FAILURES_SHOWN: usize = 3;

/// What is not as recorded: findings that changed, cases over budget, laws that do not hold.
pub fn news(papers: &[PaperReport], methods: &[MethodReport], width: usize) -> String {
    let mut out = String::new();
    for paper in papers {
        for finding in paper.findings.iter().filter(|f| !f.as_recorded) {
            out.push_str(&papers::finding(finding, width));
        }
    }
    for report in methods.iter().filter(|r| !r.passed()) {
        out.push_str(&format!("\n{}\n", paint(BOLD, report.method)));
        for failure in failing(report, FAILURES_SHOWN) {
            out.push_str(&case::text(failure, &report.again(&failure.case), width));
        }
        let failed = report.failed() as usize;
        if failed > FAILURES_SHOWN {
            let more = format!(
                "{} more: mechaudit audit {}",
                failed - FAILURES_SHOWN,
                report.method
            );
            out.push_str(&paragraph(&more, 2, width));
        }
        for law in report.laws.iter().filter(|l| !holds(l)) {
            let text = format!("law {} does not hold: {}", law.name, law.statement);
            out.push_str(&paragraph(&paint(BAD, &text), 2, width));
            if let Some(worst) = &law.worst_case {
                out.push_str(&format!("    reproduce  {}\n", report.again(worst)));
            }
        }
    }
    out
}

/// A line for each method: cases, the worst error found in ulps and in u (1 + condition), and the
/// largest share of a budget, each over all outputs.
pub fn methods(reports: &[MethodReport], width: usize) -> String {
    let header = [
        "method",
        "cases",
        "ulps",
        "u(1+cond)",
        "of budget",
        "verdict",
    ];
    let mut table = Table::new(&header, &[0, 5]);
    for report in reports {
        let (word, tone) = of::verdict(report);
        let failed = report.failed();
        let word = match (report.interrupted, failed) {
            (false, 1..) => format!("{word}: {failed}"),
            _ => word.into(),
        };
        let worst = Worst::of(report);
        table.row(vec![
            (report.method.into(), BOLD),
            (report.cases.to_string(), PLAIN),
            (worst.ulps, PLAIN),
            (worst.conditioned, PLAIN),
            (percent(worst.of_budget), style::of(share(worst.of_budget))),
            (word, style::of(tone)),
        ]);
    }
    let dispensable = ["of budget", "u(1+cond)", "ulps"];
    table.fitted(width, &dispensable).render(0)
}

/// The findings of a paper, a line each.
pub fn paper(report: &PaperReport, width: usize) -> String {
    let p = &report.paper;
    let year = p.year.map_or(String::new(), |y| format!(" ({y})"));
    let changed = report.findings.iter().filter(|f| !f.as_recorded).count();
    let head = format!(
        "{}: {}{year}, {}, {}",
        p.key,
        p.authors,
        count(report.findings.len(), "finding"),
        recorded(changed)
    );
    let mut out = format!("{}\n", paint(BOLD, &wrap(&head, 0, width)));
    out.push_str(&paint(DIM, paragraph(&kinds(report), 2, width).trim_end()));
    out.push('\n');
    for f in &report.findings {
        let (sign, _, tone) = mark(f.verdict);
        let title = first_line(&f.title, width.saturating_sub(4));
        out.push_str(&format!("  {} {title}\n", paint(style::of(tone), sign)));
    }
    out
}

/// As many words as there is room for, with an ellipsis where some are left out.
fn first_line(text: &str, room: usize) -> String {
    let all = wrap(text, 0, room);
    match all.contains('\n') {
        false => all,
        true => {
            let short = wrap(text, 0, room.saturating_sub(2));
            format!("{} …", short.lines().next().unwrap_or_default())
        }
    }
}

/// What came of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Everything as expected.
    AsExpected,
    /// Something is over budget, or not as recorded.
    NotAsExpected,
    /// The user has ended it.
    Interrupted,
}

/// What came of it in a line, and how it was done below.
pub fn verdict(end: End, what: &str, how: &[String], width: usize) -> String {
    let (word, style) = match end {
        End::AsExpected => ("All as expected", GOOD),
        End::NotAsExpected => ("NOT as expected", BAD),
        End::Interrupted => ("Interrupted", BAD),
    };
    let line = wrap(&format!("{word}: {what}."), 0, width);
    let mut out = format!("{}{}\n", paint(style, word), &line[word.len()..]);
    for line in how {
        out.push_str(&format!("{}\n", paint(DIM, &wrap(line, 0, width))));
    }
    out
}

/// Everything in brief: the verdict, what is new or over budget, a line for each method and each
/// finding, and where the rest is.
pub fn everything(
    (end, time): (End, &str),
    papers: &[PaperReport],
    methods: &[MethodReport],
    width: usize,
) -> String {
    let found: usize = papers.iter().map(|p| p.findings.len()).sum();
    let what = format!(
        "{} with {}; {}",
        count(papers.len(), "paper"),
        count(found, "finding"),
        totals(methods)
    );
    let settings = methods.first().map(|m| settings(&m.settings));
    let how: Vec<String> = settings.into_iter().chain([time.into()]).collect();
    let mut out = verdict(end, &what, &how, width);
    let news = news(papers, methods, width);
    if !news.is_empty() {
        out.push_str(&format!("\n{}\n{news}", paint(BAD, "New or over budget")));
    }
    out.push_str(&format!("\n{}", self::methods(methods, width)));
    for report in papers {
        out.push_str(&format!("\n{}", paper(report, width)));
    }
    let more = "Details: mechaudit --verbose, mechaudit paper NAME, mechaudit audit METHOD";
    out.push_str(&format!("\n{}\n", paint(DIM, more)));
    out
}

#[cfg(test)]
mod tests {
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
        // What is as recorded is no news.
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
            "NOT as expected: 1 paper with 2 findings; 0 of 1 methods pass, 399 of 400 cases.\n",
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
}

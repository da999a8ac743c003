//! The report of everything in brief: what failed or is new, a line for each method and finding.

use super::case;
use super::text::{
    BAD, BOLD, DIM, DOUBT, GOOD, PLAIN, Table, paint, paragraph, percent, short, wrap,
};
use super::text_paper;
use mechaudit::audit::{Case, MethodReport, OutputStatistics};
use mechaudit::papers::PaperReport;

/// Failing cases shown for each method.
const FAILURES_SHOWN: usize = 3;

/// What is not as recorded: findings that changed, cases over budget, laws that do not hold.
pub fn news(papers: &[PaperReport], methods: &[MethodReport], width: usize) -> String {
    let mut out = String::new();
    for paper in papers {
        for finding in paper.findings.iter().filter(|f| !f.as_recorded) {
            out.push_str(&text_paper::finding(finding, width));
        }
    }
    for report in methods.iter().filter(|r| !r.passed()) {
        let reproduce = |c: &Case| c.reproduce();
        out.push_str(&format!("\n{}\n", paint(BOLD, report.method)));
        for failure in report.failures.iter().take(FAILURES_SHOWN) {
            out.push_str(&case::text(failure, &reproduce(&failure.case), width));
        }
        let failed = report.cases - report.passed;
        if failed > FAILURES_SHOWN {
            let more = format!(
                "{} more: mechaudit audit {}",
                failed - FAILURES_SHOWN,
                report.method
            );
            out.push_str(&paragraph(&more, 2, width));
        }
        for law in report.laws.iter().filter(|l| !(l.worst <= 1.0)) {
            let text = format!("law {} does not hold: {}", law.name, law.statement);
            out.push_str(&paragraph(&paint(BAD, &text), 2, width));
            if let Some(worst) = &law.worst_case {
                out.push_str(&format!("    reproduce  {}\n", worst.reproduce()));
            }
        }
    }
    out
}

/// A line for each method: cases, and the output that comes closest to its budget with its worst
/// error in ulps.
pub fn methods(reports: &[MethodReport]) -> String {
    let mut table = Table::new(
        &["method", "verdict", "cases", "of budget", "at", "ulps"],
        &[0, 1, 4],
    );
    for report in reports {
        let (word, style) = match report.passed() {
            true => ("pass", GOOD),
            false if report.interrupted => ("interrupted", BAD),
            false => ("FAIL", BAD),
        };
        let cases = match report.cases - report.passed {
            0 => report.cases.to_string(),
            _ => format!("{} of {}", report.passed, report.cases),
        };
        let mut row = vec![
            (report.method.to_string(), BOLD),
            (word.into(), style),
            (cases, PLAIN),
        ];
        let closest = report
            .outputs
            .iter()
            .max_by(|a, b| a.max_of_budget.total_cmp(&b.max_of_budget));
        row.extend(match closest {
            Some(output) => share(output),
            None => std::array::from_fn(|_| ("–".to_string(), DIM)),
        });
        table.row(row);
    }
    table.render(0)
}

/// The output's share of its budget, its name and its worst error.
fn share(output: &OutputStatistics) -> [(String, anstyle::Style); 3] {
    let style = match output.max_of_budget {
        x if x <= 0.5 => PLAIN,
        x if x <= 1.0 => DOUBT,
        _ => BAD,
    };
    let ulps = match output.ulps.count {
        0 => "–".to_string(),
        _ => short(output.ulps.max),
    };
    [
        (percent(output.max_of_budget), style),
        (output.name.into(), PLAIN),
        (ulps, PLAIN),
    ]
}

/// The findings of a paper, a line each.
pub fn paper(report: &PaperReport, width: usize) -> String {
    let p = &report.paper;
    let year = p.year.map_or(String::new(), |y| format!(" ({y})"));
    let head = format!("{}{year}, mechaudit paper {}", p.authors, p.key);
    let mut out = format!("{}\n", paint(BOLD, &wrap(&head, 0, width)));
    out.push_str(&paragraph(&text_paper::counts(report), 0, width));
    for f in &report.findings {
        let (sign, words, style) = text_paper::mark(f.verdict);
        let line = wrap(&format!("{} [{words}]", f.title), 4, width);
        out.push_str(&format!("  {} {line}\n", paint(style, sign)));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::super::text_method::tests::fabricated as method;
    use super::super::text_paper::tests::fabricated as paper_report;
    use super::*;

    fn plain(text: &str) -> String {
        anstream::adapter::strip_str(text).to_string()
    }

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
    fn a_law_that_fails_is_news() {
        let mut report = method();
        report.laws[0].worst = f64::NAN;
        let text = plain(&news(&[], &[report], 80));
        assert!(text.contains("law energy does not hold"), "{text}");
    }

    #[test]
    fn a_passing_method_is_no_news() {
        let mut report = method();
        report.passed = report.cases;
        report.failures.clear();
        assert_eq!(news(&[], &[report], 80), "");
    }

    #[test]
    fn a_line_for_each_method_with_the_output_nearest_its_budget() {
        let text = plain(&methods(&[method()]));
        let line = text.lines().nth(1).unwrap();
        for part in ["a-method", "FAIL", "399 of 400", "175.0 %", "phi2", "7.25"] {
            assert!(line.contains(part), "{part} is missing in\n{text}");
        }
    }

    #[test]
    fn a_line_for_each_finding() {
        let text = plain(&paper(&paper_report(), 100));
        assert!(text.contains("  + The mass of link 4 is not printed [recovered]\n"));
        assert!(!text.contains("It follows from"), "{text}");
        assert!(text.lines().all(|l| l.chars().count() <= 100), "{text}");
    }
}

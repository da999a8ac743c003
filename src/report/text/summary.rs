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

/// The changes against the record: findings that changed, cases over budget, laws that do not hold.
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
            out.push_str(&case::text(
                failure,
                &report.layout,
                &report.reproduce_command(&failure.case),
                width,
            ));
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
                out.push_str(&format!(
                    "    reproduce  {}\n",
                    report.reproduce_command(worst)
                ));
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
    let changed = report.findings.iter().filter(|f| !f.as_recorded).count();
    let findings = count(report.findings.len(), "finding");
    let parts = [p.by(), Some(findings), Some(recorded(changed))];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    let head = format!("{}: {}", p.key, parts.join(", "));
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

/// The outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Everything as expected.
    AsExpected,
    /// Something is over budget, or not as recorded.
    NotAsExpected,
    /// The user has ended it.
    Interrupted,
}

/// The outcome in a line, and how it was reached below.
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
mod tests;

//! A method's report for people.

use super::case;
use super::style::{self, BAD, BOLD, DIM, PLAIN, paint, paragraph, wrap};
use super::table::Table;
use crate::audit::{
    CaseReport, ErrorMap, Kinds, MethodReport, OutputStatistics, RegionReport, Spread, Verdict,
};
use crate::report::words::audit::{
    budgets, candidate, cases, holds, kinds, mark, proved, share, undecided, verdict,
};
use crate::report::words::numbers::{percent, short, short_if};
use anstyle::Style;

/// Failing cases printed in full for each method.
const FAILURES_SHOWN: usize = 10;
/// Outputs up to which a region in which cases fail has a line for each of them.
const FEW: usize = 4;

/// The report of one method.
pub fn method(report: &MethodReport, width: usize) -> String {
    let mut out = heading(report, width);
    out.push_str(&outputs(report, width));
    out.push_str(&regions(report, width));
    let open = undecided(&report.total);
    if !open.is_empty() {
        out.push_str(&paragraph(&open, 2, width));
    }
    out.push_str(&laws(report, width));
    if let Some(map) = &report.map {
        out.push_str(&paragraph(&on_the_map(map), 2, width));
    }
    let shown = failing(report, FAILURES_SHOWN);
    for failure in &shown {
        out.push('\n');
        out.push_str(&case::text(
            failure,
            &report.layout,
            &report.reproduce_command(&failure.case),
            width,
        ));
    }
    let left = report.failed().saturating_sub(shown.len() as u64);
    if left > 0 && !shown.is_empty() {
        let text =
            format!("{left} more failing cases; --format json lists the first 500 of each region.");
        out.push_str(&paragraph(&text, 2, width));
    }
    out.push_str(&trouble(report, width));
    out
}

/// The report of a single case.
pub fn single(report: &MethodReport, only: &CaseReport, width: usize) -> String {
    let mut out = case::text(
        only,
        &report.layout,
        &report.reproduce_command(&only.case),
        width,
    );
    let line = |label: &str, text: &str| format!("    {label:<10} {}\n", wrap(text, 15, width));
    out.push_str(&line("budget", &budgets(report)));
    if let Some(c) = &report.candidate {
        out.push_str(&line("candidate", &candidate(c)));
    }
    for remark in &report.remarks {
        out.push_str(&line("remark", remark));
    }
    for law in report.laws.iter().filter(|l| l.cases > 0) {
        let style = if holds(law) { BOLD } else { BAD };
        let (name, share) = (paint(style, law.name), percent(law.worst));
        out.push_str(&format!(
            "    law        {name}: {share} of what is allowed\n"
        ));
    }
    out.push_str(&trouble(report, width));
    out
}

/// Failures other than wrong answers.
fn trouble(report: &MethodReport, width: usize) -> String {
    let trouble = report.candidate.as_ref().and_then(|c| c.trouble.as_ref());
    let text = trouble.map(|t| paragraph(t, 2, width));
    text.map_or(String::new(), |t| format!("{}\n", paint(BAD, t.trim_end())))
}

/// The failing cases to look at first: the worst over budget, those of each wrong kind, and then
/// others; each once.
pub fn failing(report: &MethodReport, most: usize) -> Vec<&CaseReport> {
    let over = report.worst.iter();
    let over = over.filter(|c| c.judgement.verdict != Verdict::Pass && !is_recorded(report, c));
    let all = over.chain(&report.wrong).chain(&report.failures);
    let mut chosen: Vec<&CaseReport> = Vec::new();
    for case in all {
        let same =
            |c: &&CaseReport| c.case.region == case.case.region && c.case.order(&case.case).is_eq();
        if chosen.len() < most && !chosen.iter().any(same) {
            chosen.push(case);
        }
    }
    chosen
}

/// Returns true if a case over budget is a recorded one: it is in no list of failures.
fn is_recorded(report: &MethodReport, case: &CaseReport) -> bool {
    case.case.region == "hard"
        && report.recorded > 0
        && !report
            .failures
            .iter()
            .any(|f| f.case.order(&case.case).is_eq())
}

fn heading(report: &MethodReport, width: usize) -> String {
    let (word, tone) = verdict(report);
    let count = cases(report);
    let used = report.method.chars().count() + word.len() + 2 + count.len();
    let gap = width.saturating_sub(used).max(2);
    let line = |label: &str, text: &str| format!("  {label:<10} {}\n", wrap(text, 13, width));
    let mut out = format!(
        "{}{}{}  {count}\n{}",
        paint(BOLD, report.method),
        " ".repeat(gap),
        paint(style::of(tone), word),
        paragraph(report.summary, 2, width)
    );
    if let Some(c) = &report.candidate {
        out.push_str(&line("candidate", &candidate(c)));
    }
    out.push_str(&line("budget", &budgets(report)));
    for bound in &report.proved {
        out.push_str(&line("proved", &proved(bound)));
    }
    for remark in &report.remarks {
        out.push_str(&line("remark", remark));
    }
    out
}

/// The errors of a row.
fn errors(s: &Spread) -> [(String, Style); 4] {
    let number = |x: f64| (short_if(s.count > 0, x), PLAIN);
    let max = match s.beyond {
        0 => number(s.max),
        _ => (">1e308".into(), BAD),
    };
    [max, number(s.p99), number(s.median), number(s.rms)]
}

fn wrong(of: &Kinds) -> (String, Style) {
    match of.total() {
        0 => ("–".into(), DIM),
        _ => (kinds(of), BAD),
    }
}

fn outputs(report: &MethodReport, width: usize) -> String {
    let header = [
        "output",
        "values",
        "worst ulps",
        "p99",
        "median",
        "RMS",
        "u(1+cond)",
        "of budget",
        "condition",
        "wrong",
    ];
    let mut table = Table::new(&header, &[0, 9]);
    for s in report.outputs() {
        let mut row = vec![(s.name.into(), PLAIN), (s.values.to_string(), DIM)];
        row.extend(errors(&s.ulps));
        row.push((short_if(s.conditioned.count > 0, s.conditioned.max), PLAIN));
        row.push((percent(s.max_of_budget), style::of(share(s.max_of_budget))));
        row.push((short(s.max_condition), DIM));
        row.push(wrong(&s.kinds));
        table.row(row);
    }
    if let Some(norm) = &report.total.normwise {
        let u = |x: f64| (short_if(norm.count > 0, x), PLAIN);
        let mut row = vec![("norm, in u".into(), PLAIN), (norm.count.to_string(), DIM)];
        row.extend([u(norm.max), u(norm.p99), u(norm.median), u(norm.rms)]);
        row.extend(["", "", "", ""].map(|t| (t.into(), PLAIN)));
        table.row(row);
    }
    let dispensable = ["condition", "median", "RMS", "p99"];
    let mut out = table
        .fitted(width.saturating_sub(2), &dispensable)
        .render(2);
    for s in report.outputs() {
        if let Some(parts) = s.parts {
            let (method, rounding) = (short(parts.method), short(parts.rounding));
            out.push_str(&format!(
                "  worst {}: {method} ulps of the method, {rounding} of rounding\n",
                s.name
            ));
        }
    }
    out
}

/// A line for each region, with the largest figures of all outputs; where cases fail, a line for
/// each output if there are few.
fn regions(report: &MethodReport, width: usize) -> String {
    if report.regions.len() < 2 {
        return String::new();
    }
    let each = |r: &RegionReport| r.failed() > 0 && (2..=FEW).contains(&r.outputs.len());
    let named = report.regions.iter().any(each);
    let header = [
        "region",
        "cases",
        "failed",
        if named { "output" } else { "" },
        "worst ulps",
        "p99",
        "median",
        "RMS",
        "norm, u",
        "of budget",
        "wrong",
    ];
    let mut table = Table::new(&header, &[0, 3, 10]);
    for r in &report.regions {
        let failed = match r.failed() {
            0 => ("–".into(), DIM),
            n => (n.to_string(), BAD),
        };
        let norm = r.normwise.filter(|n| n.count > 0);
        let norm = norm.map_or("–".into(), |n| short(n.max));
        let first = [
            (r.name.to_string(), PLAIN),
            (r.cases.to_string(), DIM),
            failed,
        ];
        let lines: Vec<(&str, Spread, f64)> = match each(r) {
            true => (r.outputs.iter().map(|o| (o.name, o.ulps, o.max_of_budget))).collect(),
            false => vec![("", of_all(&r.outputs), r.max_of_budget)],
        };
        for (k, (name, ulps, of_budget)) in lines.iter().enumerate() {
            let blank = || (String::new(), PLAIN);
            let mut row = match k {
                0 => first.to_vec(),
                _ => vec![blank(), blank(), blank()],
            };
            row.push(((*name).into(), PLAIN));
            row.extend(errors(ulps));
            row.push(match k {
                0 => (norm.clone(), PLAIN),
                _ => blank(),
            });
            row.push((percent(*of_budget), style::of(share(*of_budget))));
            row.push(if k == 0 { wrong(&r.kinds) } else { blank() });
            table.row(row);
        }
    }
    let dispensable = ["median", "RMS", "p99", "norm, u"];
    table
        .fitted(width.saturating_sub(2), &dispensable)
        .render(2)
}

/// The largest of each figure over all outputs.
fn of_all(outputs: &[OutputStatistics]) -> Spread {
    let mut all = Spread::default();
    for s in outputs.iter().map(|o| o.ulps) {
        all.count += s.count;
        all.beyond += s.beyond;
        all.max = all.max.max(s.max);
        all.p99 = all.p99.max(s.p99);
        all.median = all.median.max(s.median);
        all.rms = all.rms.max(s.rms);
    }
    all
}

/// Describes an error map in a line.
fn on_the_map(map: &ErrorMap) -> String {
    let worst = |o: &crate::audit::MapOutput| {
        let ulps = o.ulps.iter().copied().fold(0.0, f64::max);
        format!("{} {}", o.name, short(ulps))
    };
    let worst: Vec<String> = map.outputs.iter().map(worst).collect();
    format!(
        "map of {} points: worst ulps {}; {} points do not pass",
        map.points(),
        worst.join(", "),
        map.not_passed
    )
}

fn laws(report: &MethodReport, width: usize) -> String {
    let mut out = String::new();
    for law in &report.laws {
        let (mark, tone) = mark(law);
        let text = format!(
            "{}: {} (worst residual {} of what is allowed, {} cases)",
            law.name,
            law.statement,
            percent(law.worst),
            law.cases
        );
        out.push_str(&format!("  {} ", paint(style::of(tone), mark)));
        out.push_str(&wrap(&text, 4, width));
        out.push('\n');
        if !holds(law)
            && let Some(worst) = &law.worst_case
        {
            out.push_str(&case::input(worst, &report.layout, 4));
            out.push_str(&format!(
                "    reproduce  {}\n",
                report.reproduce_command(worst)
            ));
        }
    }
    out
}

#[cfg(test)]
pub(crate) mod tests;

//! A paper's entries as CSV, one line for each printed entry and variant of the data; the statistics of
//! an audit as CSV, one line for each region and output.

use super::words::paper::entry;
use crate::audit::{Comparison, Kind, MethodReport, OutputStatistics, RegionReport, Spread};
use crate::papers::PaperReport;
use std::io::Write;

/// The columns of [`audit`] before the wrong kinds.
const AUDIT: [&str; 33] = [
    "method",
    "candidate",
    "region",
    "output",
    "budget",
    "cases",
    "passed",
    "recorded",
    "over",
    "undecided",
    "reference_failed",
    "values",
    "worst_ulps",
    "p99_ulps",
    "median_ulps",
    "rms_ulps",
    "beyond_ulps",
    "worst_u_1_plus_cond",
    "p99_u_1_plus_cond",
    "median_u_1_plus_cond",
    "rms_u_1_plus_cond",
    "worst_normwise_u",
    "p99_normwise_u",
    "median_normwise_u",
    "rms_normwise_u",
    "max_of_budget",
    "max_condition",
    "wrong",
    "worst_output_of_budget",
    "interrupted",
    "seed",
    "cases_per_region",
    "reproduce_worst",
];

/// Writes the statistics of audits: for each method and region (`all` last) a line for all outputs
/// (`all`), which has the normwise errors and the wrong kinds of whole answers, and a line for each
/// output. A field without a number is empty.
pub fn audit(reports: &[MethodReport], out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    let kinds = Kind::ALL.iter().map(|k| k.key());
    csv.write_record(AUDIT.into_iter().chain(kinds))?;
    for report in reports {
        for region in report.regions.iter().chain([&report.total]) {
            csv.write_record(line(report, region, None))?;
            for output in &region.outputs {
                csv.write_record(line(report, region, Some(output)))?;
            }
        }
    }
    Ok(csv.flush()?)
}

/// Worst, 99th percentile, median and root mean square.
fn figures(spread: Option<&Spread>) -> [String; 4] {
    match spread.filter(|s| s.count > 0) {
        Some(s) => [s.max, s.p99, s.median, s.rms].map(|x| format!("{x:e}")),
        None => Default::default(),
    }
}

fn line(
    report: &MethodReport,
    region: &RegionReport,
    output: Option<&OutputStatistics>,
) -> Vec<String> {
    let limit = |o: &OutputStatistics| {
        let own = report.budgets.iter().find(|b| b.name == o.name);
        own.map_or(String::new(), |b| b.budget.limit.to_string())
    };
    let norm = report.norm_budget;
    let norm = norm.map_or(String::new(), |n| n.shown(report.format));
    let candidate = report.candidate.as_ref();
    let mut fields = vec![
        report.method.to_string(),
        candidate.map_or(String::new(), |c| c.name.clone()),
        region.name.into(),
        output.map_or("all", |o| o.name).into(),
        output.map_or(norm, limit),
    ];
    let counts = [
        region.cases,
        region.passed,
        region.recorded,
        region.over,
        region.undecided,
        region.reference_failed,
    ];
    fields.extend(counts.map(|n| n.to_string()));
    fields.push(output.map_or(String::new(), |o| o.values.to_string()));
    fields.extend(figures(output.map(|o| &o.ulps)));
    fields.push(output.map_or(String::new(), |o| o.ulps.beyond.to_string()));
    fields.extend(figures(output.map(|o| &o.conditioned)));
    let norm = output.is_none().then_some(region.normwise.as_ref());
    fields.extend(figures(norm.flatten()));
    let worst = match output {
        Some(o) => (o.max_of_budget, o.worst.as_ref()),
        None => (region.max_of_budget, region.worst.as_ref()),
    };
    fields.push(format!("{:e}", worst.0));
    let kinds = output.map_or(&region.kinds, |o| &o.kinds);
    fields.push(output.map_or(String::new(), |o| format!("{:e}", o.max_condition)));
    fields.push(kinds.total().to_string());
    let largest = region.outputs.iter().max_by(|a, b| {
        let share = |o: &OutputStatistics| o.max_of_budget;
        share(a).total_cmp(&share(b))
    });
    let largest = largest.filter(|_| output.is_none());
    fields.push(largest.map_or(String::new(), |o| o.name.into()));
    fields.push(report.interrupted.to_string());
    fields.push(report.settings.seed.to_string());
    fields.push(report.settings.cases_per_region.to_string());
    fields.push(worst.1.map_or(String::new(), |case| report.again(case)));
    fields.extend(Kind::ALL.map(|k| kinds[k].to_string()));
    fields
}

/// Writes a comparison: a line for each region (`all` last) and candidate.
pub fn comparison(found: &Comparison, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "method",
        "region",
        "candidate",
        "best",
        "cases",
        "failed",
        "wrong",
        "of_budget",
        "times_the_best",
        "worst_ulps",
        "rms_ulps",
        "ns_per_answer",
        "start_up_ms",
    ])?;
    let number = |x: f64| format!("{x:e}");
    let some = |x: Option<f64>| x.map_or(String::new(), number);
    for contest in &found.regions {
        for (c, s) in found.candidates.iter().zip(&contest.standings) {
            csv.write_record([
                found.method.to_string(),
                contest.region.into(),
                c.name.clone(),
                s.best.to_string(),
                s.cases.to_string(),
                s.failed.to_string(),
                s.wrong.to_string(),
                number(s.of_budget),
                some(s.ratio),
                number(s.worst_ulps),
                number(s.rms_ulps),
                some(c.speed.map(|s| s.ns_per_answer)),
                some(c.speed.and_then(|s| s.start_up_ms)),
            ])?;
        }
    }
    Ok(csv.flush()?)
}

/// Writes the entries.
pub fn paper(report: &PaperReport, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record([
        "table",
        "row",
        "column",
        "printed",
        "variant",
        "recomputed",
        "units_in_last_digit",
        "verdict",
    ])?;
    for e in &report.entries {
        for (variant, r) in &e.variants {
            csv.write_record([
                &e.table.to_string(),
                &e.row.to_string(),
                e.column,
                &e.printed,
                variant,
                &r.recomputed,
                &r.units_in_last_digit.to_string(),
                entry(r.verdict),
            ])?;
        }
    }
    Ok(csv.flush()?)
}

#[cfg(test)]
#[path = "csv_tests.rs"]
mod tests;

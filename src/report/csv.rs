//! A paper's entries as CSV, one line for each printed entry and variant of the data; the
//! statistics of an audit as CSV, one line for each region and output.

use super::words::paper::entry;
use crate::audit::{
    Compared, Comparison, Kind, MethodReport, OutputStatistics, RegionReport, Spread, Standing,
};
use crate::papers::{Entry, PaperReport, VariantJudgement};
use std::io::Write;

/// A column: its name, and a row's field.
pub(super) type Column<T> = (&'static str, fn(&T) -> String);

/// Writes a line of names, then one for each row.
pub(super) fn table<T>(
    columns: &[Column<T>],
    rows: impl IntoIterator<Item = T>,
    out: &mut dyn Write,
) -> Result<(), ::csv::Error> {
    let mut csv = ::csv::Writer::from_writer(out);
    csv.write_record(columns.iter().map(|c| c.0))?;
    for row in rows {
        csv.write_record(columns.iter().map(|c| c.1(&row)))?;
    }
    Ok(csv.flush()?)
}

/// A number, or nothing.
pub(super) fn number(x: Option<f64>) -> String {
    x.map_or(String::new(), |x| format!("{x:e}"))
}

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
    fields.push(number(Some(worst.0)));
    let kinds = output.map_or(&region.kinds, |o| &o.kinds);
    fields.push(number(output.map(|o| o.max_condition)));
    fields.push(kinds.total().to_string());
    let outputs = region.outputs.iter().filter(|o| !o.max_of_budget.is_nan());
    let largest = outputs.max_by(|a, b| a.max_of_budget.total_cmp(&b.max_of_budget));
    let largest = largest.filter(|_| output.is_none());
    fields.push(largest.map_or(String::new(), |o| o.name.into()));
    fields.push(report.interrupted.to_string());
    fields.push(report.settings.seed.to_string());
    fields.push(report.settings.cases_per_region.to_string());
    fields.push(
        worst
            .1
            .map_or(String::new(), |case| report.reproduce_command(case)),
    );
    fields.extend(Kind::ALL.map(|k| kinds[k].to_string()));
    fields
}

/// Writes a comparison: a line for each region (`all` last) and candidate.
pub fn comparison(found: &Comparison, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let rows = found.regions.iter().flat_map(|contest| {
        let each = found.candidates.iter().zip(&contest.standings);
        each.map(move |(c, s)| ([found.method, contest.region], c, s))
    });
    let columns: [Column<([&str; 2], &Compared, &Standing)>; 13] = [
        ("method", |([method, _], ..)| method.to_string()),
        ("region", |([_, region], ..)| region.to_string()),
        ("candidate", |(_, c, _)| c.name.clone()),
        ("best", |(.., s)| s.best.to_string()),
        ("cases", |(.., s)| s.cases.to_string()),
        ("failed", |(.., s)| s.failed.to_string()),
        ("wrong", |(.., s)| s.wrong.to_string()),
        ("of_budget", |(.., s)| number(Some(s.of_budget))),
        ("times_the_best", |(.., s)| number(s.ratio)),
        ("worst_ulps", |(.., s)| number(Some(s.worst_ulps))),
        ("rms_ulps", |(.., s)| number(Some(s.rms_ulps))),
        ("ns_per_answer", |(_, c, _)| {
            number(c.speed.map(|s| s.ns_per_answer))
        }),
        ("start_up_ms", |(_, c, _)| {
            number(c.speed.and_then(|s| s.start_up_ms))
        }),
    ];
    table(&columns, rows, out)
}

/// Writes the entries.
pub fn paper(report: &PaperReport, out: &mut dyn Write) -> Result<(), ::csv::Error> {
    let entries = report.entries.iter();
    let rows = entries.flat_map(|e| e.variants.iter().map(move |(variant, r)| (e, variant, r)));
    let columns: [Column<(&Entry, &&str, &VariantJudgement)>; 8] = [
        ("table", |(e, ..)| e.table.to_string()),
        ("row", |(e, ..)| e.row.to_string()),
        ("column", |(e, ..)| e.column.to_string()),
        ("printed", |(e, ..)| e.printed.clone()),
        ("variant", |(_, variant, _)| variant.to_string()),
        ("recomputed", |(.., r)| r.recomputed.clone()),
        ("units_in_last_digit", |(.., r)| {
            r.units_in_last_digit.to_string()
        }),
        ("verdict", |(.., r)| entry(r.verdict).into()),
    ];
    table(&columns, rows, out)
}

#[cfg(test)]
mod tests;

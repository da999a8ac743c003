//! Reports of audits, written in the selected form.

use crate::cli::args::AuditFormat;
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json};
use crate::cli::terminal::width;
use mechaudit::audit::{ConvergenceReport, MethodReport, Uncertified};
use mechaudit::report::baseline::Baseline;
use mechaudit::report::words::audit::{all_pass, totals};
use mechaudit::report::{csv, html, json, junit, text};
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// The number of cases of each region that a page shows, passed or not.
pub const POINTS: usize = 48;

/// The parts of a report beside the verdicts.
#[derive(Default)]
pub struct ReportExtras {
    /// The convergence of approximations, for a page of everything.
    pub approximations: Option<Vec<Result<ConvergenceReport, Uncertified>>>,
    /// An earlier report.
    pub baseline: Option<Baseline>,
}

/// The size of the largest baseline in bytes.
const WHOLE: u64 = 1 << 30;

/// Reads the report of an earlier run.
pub fn read_baseline(path: &Path) -> Result<Baseline, Failure> {
    let refused = |e: std::io::Error| Failure::cannot("read", path, e);
    let mut text = String::new();
    let file = File::open(path).map_err(refused)?;
    file.take(WHOLE)
        .read_to_string(&mut text)
        .map_err(refused)?;
    Baseline::read(&text).map_err(|e| Failure::in_file(path, e))
}

/// Returns the earlier report that the arguments name, for the forms that show changes.
pub fn baseline(path: Option<&Path>, format: AuditFormat) -> Result<Option<Baseline>, Failure> {
    match (path, format) {
        (None, _) => Ok(None),
        (Some(path), AuditFormat::Text | AuditFormat::Json) => read_baseline(path).map(Some),
        _ => Err(Failure::new(
            "--baseline: changes are shown in text and json",
        )),
    }
}

/// Writes reports. The text of a single case shows everything that is known of it.
pub fn write(
    reports: &[MethodReport],
    format: AuditFormat,
    output: Output,
    extras: &ReportExtras,
) -> Result<Outcome, Failure> {
    let changes = extras.baseline.as_ref().map(|b| b.changes(reports));
    let stopped = reports.iter().any(|r| r.interrupted);
    let outcome = Outcome::unless_interrupted(stopped, all_pass(reports));
    match format {
        AuditFormat::Text => output.write(|out| {
            for report in reports {
                writeln!(out, "{}", in_words(report))?;
            }
            if reports.iter().any(|r| r.cases > 1 || r.interrupted) {
                let mark = if stopped { "Interrupted: " } else { "" };
                writeln!(out, "{mark}{}.", totals(reports))?;
            }
            if let Some(changes) = &changes {
                write!(out, "{}", text::comparison::changes(changes, width()))?;
            }
            Ok(())
        })?,
        AuditFormat::Json => {
            let mut value = json::document(reports, stopped);
            if let Some(changes) = &changes {
                value["baseline"] = serde_json::json!(changes);
            }
            write_json(output, &value)?;
        }
        AuditFormat::Csv => output.write(|out| Ok(csv::audit(reports, out)?))?,
        AuditFormat::Junit => {
            let text = junit::document(reports).map_err(|e| Failure::new(e.to_string()))?;
            output.write(|out| Ok(writeln!(out, "{text}")?))?;
        }
        AuditFormat::Html => {
            let approximations = extras.approximations.as_deref();
            let page = html::audit::page(reports, approximations, changes.as_ref(), stopped);
            output.text(&page)?;
        }
    }
    Ok(outcome)
}

/// Formats a report as text, without the last end of line.
pub fn in_words(report: &MethodReport) -> String {
    let mut known = report.wrong.iter().chain(&report.worst);
    let text = match (report.cases, known.next()) {
        (1, Some(only)) => text::method::single(report, only, width()),
        _ => text::method::method(report, width()),
    };
    text.trim_end_matches('\n').to_string()
}

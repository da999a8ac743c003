//! Reports of audits written in the form asked for, whosever code was audited.

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

/// Cases of each region that a page shows whatever they are.
pub const POINTS: usize = 48;

/// The convergence of approximations, for a page of everything.
pub type Approximations = Option<Vec<Result<ConvergenceReport, Uncertified>>>;

/// What a report shows besides the verdicts.
#[derive(Default)]
pub struct Besides {
    /// Of approximations.
    pub approximations: Approximations,
    /// An earlier report.
    pub baseline: Option<Baseline>,
}

/// The longest baseline.
const WHOLE: u64 = 1 << 30;

/// A report of an earlier run.
pub fn read(path: &Path) -> Result<Baseline, Failure> {
    let refused = |e: std::io::Error| Failure::cannot("read", path, e);
    let mut text = String::new();
    let file = File::open(path).map_err(refused)?;
    file.take(WHOLE)
        .read_to_string(&mut text)
        .map_err(refused)?;
    Baseline::read(&text).map_err(|e| Failure::in_file(path, e))
}

/// The earlier report that the arguments name, for forms that show what has changed.
pub fn baseline(path: Option<&Path>, format: AuditFormat) -> Result<Option<Baseline>, Failure> {
    match (path, format) {
        (None, _) => Ok(None),
        (Some(path), AuditFormat::Text | AuditFormat::Json) => read(path).map(Some),
        _ => Err(Failure::new(
            "--baseline: changes are shown in text and json",
        )),
    }
}

/// Writes them. Text of one case is all that is known of it.
pub fn write(
    reports: &[MethodReport],
    format: AuditFormat,
    output: Output,
    besides: &Besides,
) -> Result<Outcome, Failure> {
    let changes = besides.baseline.as_ref().map(|b| b.changes(reports));
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
            let approximations = besides.approximations.as_deref();
            let page = html::audit::page(reports, approximations, changes.as_ref(), stopped);
            output.text(&page)?;
        }
    }
    Ok(outcome)
}

/// A report as text, without the last end of line.
pub fn in_words(report: &MethodReport) -> String {
    let mut known = report.wrong.iter().chain(&report.worst);
    let text = match (report.cases, known.next()) {
        (1, Some(only)) => text::method::single(report, only, width()),
        _ => text::method::method(report, width()),
    };
    text.trim_end_matches('\n').to_string()
}

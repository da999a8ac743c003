//! One paper's report in the form asked for.

mod ledger;

use crate::cli::args::{PaperArgs, PaperFormat};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::Output;
use crate::cli::progress::Progress;
use crate::cli::{commands::audit, complain, terminal};
use mechaudit::papers;
use mechaudit::report::{csv, html, text};

/// No paper of that key.
pub fn unknown(key: &str) -> Failure {
    Failure::no_such("paper", key, &papers::keys())
}

/// Audits the paper and writes its report.
pub fn paper(args: &PaperArgs) -> Result<Outcome, Failure> {
    if args.ledger {
        return ledger::ledger(args);
    }
    if matches!(args.format, PaperFormat::Latex | PaperFormat::Errata) {
        return Err(Failure::new("this form is one of the ledger: add --ledger"));
    }
    let output = Output::open(args.output.as_deref())?;
    let progress = Progress::new();
    let report = audit::paper(&args.key, &progress).ok_or_else(|| unknown(&args.key))?;
    progress.clear();
    let report = match report {
        Ok(report) => report,
        Err(e) => {
            complain(&format!("paper {}: {e}", args.key));
            return Ok(Outcome::Finding);
        }
    };
    let width = match output.is_standard() {
        true => terminal::width(),
        false => 100,
    };
    output.write(|out| match args.format {
        PaperFormat::Text => Ok(write!(out, "{}", text::paper::paper(&report, width))?),
        PaperFormat::Json => {
            serde_json::to_writer_pretty(&mut *out, &report)?;
            Ok(writeln!(out)?)
        }
        PaperFormat::Csv => Ok(csv::paper(&report, out)?),
        PaperFormat::Latex | PaperFormat::Errata => Ok(()),
        PaperFormat::Html => Ok(out.write_all(
            html::paper::page(&report, papers::motion_of(&args.key).as_ref()).as_bytes(),
        )?),
    })?;
    Ok(Outcome::of(report.as_recorded()))
}

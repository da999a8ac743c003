//! What judging somebody's program has in common, wherever its answers come from.

use crate::cli::args::{ScopeArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::{Output, write_json};
use crate::cli::process::interrupt;
use crate::cli::terminal::width;
use mechaudit::audit::{
    Case, CaseReport, Limit, Method, MethodReport, Settings, SolverAnswer, Tally, Variant,
    judge_case_briefly,
};
use mechaudit::report::text::style::{BAD, paint, paragraph};
use mechaudit::report::{json as in_json, text};
use rayon::prelude::*;
use serde_json::json;
use std::time::{Duration, Instant};

/// Failing cases kept of a run; the rest are counted. JSON lists all, text a few.
pub fn failures_kept(format: TextOrJson) -> usize {
    match format {
        TextOrJson::Json => usize::MAX,
        TextOrJson::Text => 100,
    }
}

/// Answers judged side by side.
pub const BATCH: usize = 1024;

/// The method with the outputs and the limit asked for.
pub fn scoped<'a>(method: &'a dyn Method, scope: &ScopeArgs) -> Result<Variant<'a>, Failure> {
    let mut variant = Variant::new(method);
    if let Some(names) = &scope.outputs {
        variant = variant.outputs(names)?;
    }
    if let Some(k) = scope.ulps {
        variant = variant.limit(Limit::Ulps(k));
    }
    Ok(variant)
}

/// How long a batch is still judged after the user has asked to stop.
const GRACE: Duration = Duration::from_secs(1);

/// Judges a batch on all cores and counts it in its order. The tally is interrupted if the user asked
/// to stop before its end.
pub fn judge_batch(
    method: &dyn Method,
    settings: &Settings,
    batch: Vec<(Case, SolverAnswer)>,
    tally: &mut Tally,
) {
    let due = batch.len();
    let start = Instant::now();
    let judged: Vec<CaseReport> = batch
        .into_par_iter()
        .filter(|_| !interrupt::asked() || start.elapsed() < GRACE)
        .map(|(case, answer)| judge_case_briefly(method, case, answer, settings))
        .collect();
    if judged.len() < due {
        tally.interrupt();
    }
    judged.into_iter().for_each(|report| tally.add(report));
}

/// What came of a program's answers.
pub struct Judged {
    /// The verdicts, unanswered cases among them.
    pub report: MethodReport,
    /// Answers there were.
    pub answered: usize,
    /// What went wrong besides the answers.
    pub trouble: Option<String>,
}

impl Judged {
    /// Writes the report. `again` gives the command that judges a case again.
    pub fn write(
        &self,
        output: Output,
        format: TextOrJson,
        again: &dyn Fn(&Case) -> String,
    ) -> Result<Outcome, Failure> {
        let good = self.report.passed() && self.trouble.is_none();
        match format {
            TextOrJson::Text => output.write(|out| {
                if let ([only], 1) = (self.report.failures.as_slice(), self.report.cases) {
                    write!(
                        out,
                        "{}",
                        text::case::text(only, &again(&only.case), width())
                    )?;
                } else {
                    write!(
                        out,
                        "{}",
                        text::method::method(&self.report, again, width())
                    )?;
                }
                if let Some(trouble) = &self.trouble {
                    let text = paragraph(trouble, 2, width());
                    write!(out, "{}", paint(BAD, text.trim_end()))?;
                    writeln!(out)?;
                }
                Ok(())
            })?,
            TextOrJson::Json => {
                let value = json!({
                "mechaudit_version": env!("CARGO_PKG_VERSION"),
                "passed": good,
                "interrupted": self.report.interrupted,
                "answered": self.answered,
                "trouble": self.trouble,
                "methods": [in_json::method(&self.report, again)],
                });
                write_json(output, &value)?;
            }
        }
        Ok(Outcome::unless_interrupted(self.report.interrupted, good))
    }
}

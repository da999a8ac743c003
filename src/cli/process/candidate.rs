//! What judging somebody's program has in common, wherever its answers come from.

use crate::cli::args::ScopeArgs;
use crate::cli::failure::Failure;
use crate::cli::process::interrupt;
use mechaudit::audit::{
    Case, CaseReport, Limit, Method, Settings, SolverAnswer, Tally, Variant, judge_case_briefly,
};
use rayon::prelude::*;
use std::time::{Duration, Instant};

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
    judged.iter().for_each(|report| tally.add(report));
}

/// The scope as options.
pub fn words(scope: &ScopeArgs) -> Vec<String> {
    let mut words = Vec::new();
    if let Some(names) = &scope.outputs {
        let names = names.join(",");
        words.extend(["--outputs".to_string(), shell_words::quote(&names).into()]);
    }
    if let Some(k) = scope.ulps {
        words.extend(["--ulps".to_string(), format!("{k}")]);
    }
    words
}

//! What judging somebody's program has in common, wherever its answers come from.

use crate::cli::process::interrupt;
use mechaudit::audit::{
    Case, CaseReport, Method, Settings, SolverAnswer, Tally, judge_case_briefly,
};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// Answers judged side by side.
pub const BATCH: usize = 1024;

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

//! What judging somebody's program has in common, wherever its answers come from.

use crate::cli::process::interrupt;
use mechaudit::audit::{Answered, Panel};
use std::time::{Duration, Instant};

/// Answers judged side by side.
pub const BATCH: usize = 1024;

/// How long a batch is still judged after the user has asked to stop.
const GRACE: Duration = Duration::from_secs(1);

/// Judges a batch of so many answers on all cores, each block of them made where it is judged; false if the user asked
/// to stop before its end.
pub fn judge_batch(panel: &Panel, total: usize, answered: &Answered) -> bool {
    let start = Instant::now();
    panel.judge(total, answered, &|| {
        !interrupt::asked() || start.elapsed() < GRACE
    })
}

//! The window of a start too short to be seen beside the rest of the run.

use mechaudit::solvers::run_up::Sample;

/// A rise of the speed within this part of the run shows as a vertical line.
const SHORT: f64 = 0.04;

/// How long a start is that the drawing of the whole run would show as a vertical line: somewhat
/// longer than the speed takes to come to where it stays in the second half of the run.
pub fn short_start(samples: &[Sample]) -> Option<f64> {
    let end = samples.last()?.t;
    let later = samples.iter().filter(|s| 2.0 * s.t >= end);
    let (low, high) = later.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), s| {
        (a.min(s.psi), b.max(s.psi))
    });
    let there = samples.iter().find(|s| (low..=high).contains(&s.psi))?.t;
    if !(there > 0.0 && there < SHORT * end) {
        return None;
    }
    // One significant digit, and no longer than the run.
    let decade = 10f64.powf((2.0 * there).log10().floor());
    Some(((2.0 * there / decade).ceil() * decade).min(end))
}

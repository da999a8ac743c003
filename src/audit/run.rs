//! Runs a method over its domain.

use super::answer::SolverAnswer;
use super::case::{Case, Cases};
use super::judged::{answer_of, judge_case};
use super::maps::error_map;
use super::method::Method;
use super::panel::Panel;
use super::parts::error_parts;
use super::report::MethodReport;
use super::settings::Settings;
use super::tally::Tally;
use std::sync::atomic::{AtomicBool, Ordering};

/// Audits a method over its whole domain, on all cores. `progress` is called once for each case,
/// and for each point of its map.
pub fn audit_method(
    method: &dyn Method,
    settings: &Settings,
    progress: &(dyn Fn() + Sync),
) -> MethodReport {
    audit_method_until(method, settings, progress, &AtomicBool::new(false))
}

/// [`audit_method`], ended early once `stop` is set: the report then holds the cases judged until
/// then, says that it was interrupted, and does not pass.
pub fn audit_method_until(
    method: &dyn Method,
    settings: &Settings,
    progress: &(dyn Fn() + Sync),
    stop: &AtomicBool,
) -> MethodReport {
    let cases = Cases::new(method, settings);
    let panel = Panel::new(method, settings);
    let case = |i: u64| cases.get(i as usize);
    let tick = |judged: u64| (0..judged).for_each(|_| progress());
    let whole = panel.audit(cases.len() as u64, &case, &tick, stop);
    let mut tally = panel.into_tally();
    if !whole {
        tally.interrupt();
    }
    let mut map = None;
    if settings.maps && !tally.is_interrupted() {
        map = error_map(method, settings, progress, stop);
        if map.is_none() && stop.load(Ordering::Relaxed) {
            tally.interrupt();
        }
    }
    let mut report = tally.finish(method);
    report.map = map;
    for (i, output) in report.total.outputs.iter_mut().enumerate() {
        let worst = output.worst.as_ref().filter(|_| !report.interrupted);
        output.parts =
            worst.and_then(|case| error_parts(method, &case.input, i, settings.first_bits));
    }
    report
}

/// Audits one case, at which the code under test gave `answer`, or the method's own solver if there
/// is none.
pub fn audit_one(
    method: &dyn Method,
    case: Case,
    answer: Option<SolverAnswer>,
    settings: &Settings,
) -> MethodReport {
    let answer = answer.unwrap_or_else(|| answer_of(method, &case.input));
    let report = judge_case(method, case, answer, settings);
    let mut tally = Tally::new(method, settings);
    let laws = method.laws();
    let residuals: Vec<Option<f64>> = laws
        .iter()
        .map(|l| (l.residual)(&report.case.input))
        .collect();
    tally.laws(&report.case, &residuals);
    tally.add(&report);
    tally.finish(method)
}

#[cfg(test)]
mod tests;

//! The judgement of one case.

use super::answer::SolverAnswer;
use super::budget::Limit;
use super::case::Case;
use super::case_report::CaseReport;
use super::method::{Method, Output};
use super::referee::Judge;
use super::settings::Settings;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Returns the answer of the method's own solver; a panic is a failure to answer.
pub fn answer_of(method: &dyn Method, input: &[f64]) -> SolverAnswer {
    catch_unwind(AssertUnwindSafe(|| method.solve(input))).unwrap_or_else(|panic| {
        let text = panic
            .downcast_ref::<&str>()
            .copied()
            .or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        SolverAnswer::Fails(match text {
            Some(text) => format!("panicked: {text}"),
            None => "panicked".into(),
        })
    })
}

/// Audits one case: the precision doubles until the judge can decide.
pub fn audit_case(method: &dyn Method, case: Case, settings: &Settings) -> CaseReport {
    let answer = answer_of(method, &case.input);
    judge_case(method, case, answer, settings)
}

/// Judges an answer, wherever it came from; the precision doubles until the judge can decide.
pub fn judge_case(
    method: &dyn Method,
    case: Case,
    answer: SolverAnswer,
    settings: &Settings,
) -> CaseReport {
    judge(method, case, answer, settings, true)
}

/// [`judge_case`], without the reference's digits where the case passes.
pub fn judge_case_briefly(
    method: &dyn Method,
    case: Case,
    answer: SolverAnswer,
    settings: &Settings,
) -> CaseReport {
    judge(method, case, answer, settings, false).written()
}

/// The same case with everything that is known of it: the reference's digits, the condition
/// numbers, the solver's formula.
pub(super) fn complete(method: &dyn Method, report: CaseReport, settings: &Settings) -> CaseReport {
    /// Numbers of an input up to which condition numbers by differences cost little.
    const FEW: usize = 16;
    // A table's entries are judged as printed.
    let printed = |o: &Output| matches!(o.budget.limit, Limit::LastDigit(_));
    let Some(answer) = report.answer.clone() else {
        return report;
    };
    if method.outputs().iter().any(printed) {
        return report;
    }
    let settings = Settings {
        conditions: settings.conditions || report.case.input.len() <= FEW,
        ..settings.clone()
    };
    let branch = method.branch(&report.case.input);
    let whole = judge(method, report.case, answer, &settings, true);
    CaseReport { branch, ..whole }
}

fn judge(
    method: &dyn Method,
    case: Case,
    answer: SolverAnswer,
    settings: &Settings,
    digits: bool,
) -> CaseReport {
    Judge::new(method, settings).judge(case, answer, digits)
}

//! One case, judged.

use super::answer::{Proof, ReferenceAnswer, SolverAnswer};
use super::budget::Limit;
use super::case::Case;
use super::judge::Judgement;
use super::method::{BranchAt, Method, Output};
use super::referee::Judge;
use super::settings::Settings;
use mechaudit_reference::Mag;
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// One case with its judgement.
#[derive(Clone, Debug, Serialize)]
pub struct CaseReport {
    /// The case.
    pub case: Case,
    /// What the solver answered.
    #[serde(skip)]
    pub answer: Option<SolverAnswer>,
    /// The judgement.
    pub judgement: Judgement,
    /// The working precision that decided.
    pub bits: u32,
    /// The reference's values to 20 digits, where it certifies them.
    pub reference: Vec<Option<String>>,
    /// Bounds on the distance from the reference's midpoints to the true values.
    pub radii: Vec<f64>,
    /// Why the reference holds.
    pub proof: Option<Proof>,
    /// Where the case stands among the formulas of the method's own solver, if that is known.
    pub branch: Option<BranchAt>,
    /// The reference whose digits are not written out yet: they cost as much as a judgement, and few cases are kept.
    #[serde(skip)]
    pub unwritten: Option<ReferenceAnswer>,
}

impl CaseReport {
    /// With the reference's digits, if there is one to write.
    pub(super) fn written(mut self) -> CaseReport {
        if let Some(reference) = self.unwritten.take() {
            (self.reference, self.radii, self.proof) = decimals(&reference);
        }
        self
    }
}

/// The reference's values to 20 digits, their radii, and why they hold.
pub(super) fn decimals(
    reference: &ReferenceAnswer,
) -> (Vec<Option<String>>, Vec<f64>, Option<Proof>) {
    match reference {
        ReferenceAnswer::Values(r) => (
            r.values.iter().map(|b| b.to_decimal(20)).collect(),
            r.values.iter().map(|b| b.rad().to_f64()).collect(),
            Some(r.proof),
        ),
        ReferenceAnswer::Dues(dues, proof) => (
            dues.iter().map(|d| d.to_decimal(20)).collect(),
            dues.iter()
                .map(|d| d.number().map_or(Mag::ZERO, |b| b.rad()).to_f64())
                .collect(),
            Some(*proof),
        ),
        _ => (Vec::new(), Vec::new(), None),
    }
}

/// What the method's own solver answers; a panic is a failure to answer.
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

/// The same case with everything that is known of it: the reference's digits, the condition numbers,
/// the solver's formula.
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

//! A case that a tally keeps.

use super::answer::SolverAnswer;
use super::case::Case;
use super::case_report::{CaseReport, Judged};
use super::judged::judge_case_briefly;
use super::method::Method;
use super::settings::Settings;

/// A case with its answer. What came from a file is judged again when it is shown: the judgement
/// follows from case, answer and settings.
#[derive(Clone, Debug)]
pub(super) enum Kept {
    /// Judged here.
    Judged(Box<CaseReport>),
    /// Read.
    Read(Box<(Case, SolverAnswer)>),
}

impl Kept {
    pub(super) fn of(report: &impl Judged) -> Kept {
        Kept::Judged(Box::new(report.report()))
    }

    pub(super) fn case(&self) -> &Case {
        match self {
            Kept::Judged(report) => &report.case,
            Kept::Read(read) => &read.0,
        }
    }

    /// The answer, where it is known.
    pub(super) fn answer(&self) -> Option<&SolverAnswer> {
        match self {
            Kept::Judged(report) => report.answer.as_ref(),
            Kept::Read(read) => Some(&read.1),
        }
    }

    /// With its judgement.
    pub(super) fn report(self, method: &dyn Method, settings: &Settings) -> CaseReport {
        match self {
            Kept::Judged(report) => report.written(),
            Kept::Read(read) => {
                let (case, answer) = *read;
                judge_case_briefly(method, case, answer, settings)
            }
        }
    }
}

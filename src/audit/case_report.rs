//! One case, judged.

use super::answer::{Proof, ReferenceAnswer, SolverAnswer};
use super::case::Case;
use super::judge::Judgement;
use super::method::BranchAt;
use mechaudit_reference::Mag;
use serde::Serialize;

/// One case with its judgement.
#[derive(Clone, Debug, Serialize)]
pub struct CaseReport {
    /// The case.
    pub case: Case,
    /// The answer of the solver.
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
    /// The proof that the reference holds.
    pub proof: Option<Proof>,
    /// Where the case stands among the formulas of the method's own solver, if that is known.
    pub branch: Option<BranchAt>,
    /// The reference whose digits are not written out yet: they cost as much as a judgement, and
    /// few cases are kept.
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

/// A judgement that is counted: of most cases no [`CaseReport`] is made.
#[derive(Clone)]
pub(super) struct Brief {
    pub(super) judgement: Judgement,
    /// The working precision that decided.
    pub(super) bits: u32,
    /// The reference, where it is of interest.
    pub(super) reference: Option<ReferenceAnswer>,
}

impl Brief {
    pub(super) fn report(self, case: Case, answer: SolverAnswer) -> CaseReport {
        CaseReport {
            case,
            answer: Some(answer),
            judgement: self.judgement,
            bits: self.bits,
            reference: Vec::new(),
            radii: Vec::new(),
            proof: None,
            branch: None,
            unwritten: self.reference,
        }
    }
}

/// A case to be counted, with its judgement.
pub(super) trait Judged {
    fn case(&self) -> &Case;
    fn judgement(&self) -> &Judgement;
    /// Returns it to be kept.
    fn report(&self) -> CaseReport;
}

impl Judged for CaseReport {
    fn case(&self) -> &Case {
        &self.case
    }
    fn judgement(&self) -> &Judgement {
        &self.judgement
    }
    fn report(&self) -> CaseReport {
        self.clone()
    }
}

impl Judged for (&Case, &SolverAnswer, &Brief) {
    fn case(&self) -> &Case {
        self.0
    }
    fn judgement(&self) -> &Judgement {
        &self.2.judgement
    }
    fn report(&self) -> CaseReport {
        self.2.clone().report(self.0.clone(), self.1.clone())
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
        ReferenceAnswer::Expected(expected, proof) => (
            expected.iter().map(|d| d.to_decimal(20)).collect(),
            expected
                .iter()
                .map(|d| d.number().map_or(Mag::ZERO, |b| b.rad()).to_f64())
                .collect(),
            Some(*proof),
        ),
        _ => (Vec::new(), Vec::new(), None),
    }
}

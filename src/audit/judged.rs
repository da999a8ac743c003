//! One case, judged.

use super::answer::{Proof, ReferenceAnswer, SolverAnswer};
use super::budget::{Limit, NormBudget};
use super::case::Case;
use super::judge::{Judgement, Rules, Verdict, judge_by};
use super::layout::Layout;
use super::method::{BranchAt, Method, Output};
use super::settings::Settings;
use super::ulp::Format;
use mechaudit_reference::Mag;
use rug::Rational;
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

/// [`judge_case`], without the reference's digits where the case passes: they cost as much as a
/// judgement.
pub fn judge_case_briefly(
    method: &dyn Method,
    case: Case,
    answer: SolverAnswer,
    settings: &Settings,
) -> CaseReport {
    judge(method, case, answer, settings, false)
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
    always_digits: bool,
) -> CaseReport {
    Referee::new(method, case, settings).judge_last(answer, always_digits)
}

/// Judges answers to one case: what was computed of the reference serves them all.
pub struct Referee<'a> {
    method: &'a dyn Method,
    case: Case,
    settings: &'a Settings,
    outputs: Vec<Output>,
    norm: Option<NormBudget>,
    exact: Option<Vec<Rational>>,
    signs: Vec<Option<bool>>,
    /// By precision, doubled from one to the next.
    references: Vec<ReferenceAnswer>,
    conditions: Option<Option<Vec<f64>>>,
}

impl<'a> Referee<'a> {
    /// For answers to this case.
    pub fn new(method: &'a dyn Method, case: Case, settings: &'a Settings) -> Referee<'a> {
        Referee {
            exact: case.input.iter().map(|&x| Rational::from_f64(x)).collect(),
            signs: method.signs_of_zero(&case.input),
            outputs: method.outputs(),
            norm: method.norm_budget(),
            method,
            case,
            settings,
            references: Vec::new(),
            conditions: None,
        }
    }

    /// Computes the reference at the next precision.
    fn next(&mut self, bits: u32) {
        let (method, input) = (self.method, &self.case.input);
        let reference = match &self.exact {
            Some(x) => method.reference(x, bits),
            None => method.reference_not_finite(input),
        };
        let asked = |o: &Output| o.budget.limit.needs_conditions();
        let conditional = self.settings.conditions || self.outputs.iter().any(asked);
        let finite = self.exact.is_some();
        self.conditions
            .get_or_insert_with(|| match finite && conditional {
                true => method.conditions_beside(input, &reference),
                false => None,
            });
        self.references
            .push(reference.with_signs_of_zero(&self.signs));
    }

    /// Judges an answer; the precision doubles until that can be decided. Without `digits` the
    /// reference's are left out where it passes: they cost as much as a judgement.
    pub fn judge(&mut self, answer: SolverAnswer, digits: bool) -> CaseReport {
        let decided = self.decide(answer);
        decided.report(self.case.clone(), &self.references, digits)
    }

    /// [`Referee::judge`], for the last answer.
    pub fn judge_last(mut self, answer: SolverAnswer, digits: bool) -> CaseReport {
        let decided = self.decide(answer);
        decided.report(self.case, &self.references, digits)
    }

    fn decide(&mut self, answer: SolverAnswer) -> Decided {
        let format = self.method.format();
        let answer = match answer {
            SolverAnswer::Values(v) if format != Format::Double => {
                SolverAnswer::Values(v.into_iter().map(|x| format.round(x)).collect())
            }
            other => other,
        };
        let mut bits = self.settings.first_bits;
        let mut level = 0;
        loop {
            if level == self.references.len() {
                self.next(bits);
            }
            let reference = &self.references[level];
            let rules = Rules {
                outputs: &self.outputs,
                norm: self.norm.as_ref(),
                format,
            };
            let conditions = self.conditions.as_ref().and_then(|c| c.as_deref());
            let mut judgement = judge_by(&rules, &answer, reference, conditions);
            if judgement.verdict == Verdict::Undecided && bits < self.settings.last_bits {
                bits *= 2;
                level += 1;
                continue;
            }
            if let (SolverAnswer::Values(got), Some(due)) = (&answer, reference.len())
                && got.len() != due
                && let Some(reason) = &mut judgement.reason
            {
                // Which they are, and in which order.
                reason.push_str(&format!(": {}", Layout::new(self.method).answer()));
            }
            return Decided {
                answer,
                judgement,
                bits,
                level,
            };
        }
    }
}

/// A judgement, and the reference that decided it.
struct Decided {
    answer: SolverAnswer,
    judgement: Judgement,
    bits: u32,
    level: usize,
}

impl Decided {
    fn report(self, case: Case, references: &[ReferenceAnswer], digits: bool) -> CaseReport {
        let brief = self.judgement.verdict == Verdict::Pass && !digits;
        let (reference, radii, proof) = match brief {
            true => (Vec::new(), Vec::new(), None),
            false => decimals(&references[self.level]),
        };
        CaseReport {
            case,
            answer: Some(self.answer),
            judgement: self.judgement,
            bits: self.bits,
            reference,
            radii,
            proof,
            branch: None,
        }
    }
}

/// The reference's values to 20 digits, their radii, and why they hold.
fn decimals(reference: &ReferenceAnswer) -> (Vec<Option<String>>, Vec<f64>, Option<Proof>) {
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

#[cfg(test)]
mod tests;

//! Runs a method over its domain.

use super::case::{Case, Cases};
use super::judge::{Judgement, Verdict, judge_with_norm};
use super::layout::Layout;
use super::maps::error_map;
use super::method::{Method, Proof, ReferenceAnswer, SolverAnswer};
use super::parts::error_parts;
use super::tally::{MethodReport, Tally};
use mechaudit_reference::Mag;
use rayon::prelude::*;
use rug::Rational;
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, Ordering};

/// The settings of a run; all of them are printed with it.
#[derive(Clone, Debug, Serialize)]
pub struct Settings {
    /// Key of the random stream.
    pub seed: u64,
    /// Random cases drawn in each region.
    pub cases_per_region: u64,
    /// Working precision the references start from, in bits.
    pub first_bits: u32,
    /// Working precision at which an open case is called undecided, in bits.
    pub last_bits: u32,
    /// Whether functions of a complex variable are mapped besides; see [`error_map`].
    pub maps: bool,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 1,
            cases_per_region: 200,
            first_bits: 128,
            last_bits: 2048,
            maps: false,
        }
    }
}

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

fn judge(
    method: &dyn Method,
    case: Case,
    answer: SolverAnswer,
    settings: &Settings,
    always_digits: bool,
) -> CaseReport {
    let exact: Option<Vec<Rational>> = case.input.iter().map(|&x| Rational::from_f64(x)).collect();
    let outputs = method.outputs();
    let norm = method.norm_budget();
    let conditional = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    let mut conditions = None;
    let signs = method.signs_of_zero(&case.input);
    let mut bits = settings.first_bits;
    loop {
        let reference = match &exact {
            Some(x) => method.reference(x, bits),
            None => method.reference_not_finite(&case.input),
        };
        let c = conditions
            .get_or_insert_with(|| match exact.is_some() && conditional {
                true => method.conditions_beside(&case.input, &reference),
                false => None,
            })
            .as_deref();
        let reference = reference.with_signs_of_zero(&signs);
        let mut judgement = judge_with_norm(&outputs, norm.as_ref(), &answer, &reference, c);
        if let (SolverAnswer::Values(got), Some(due)) = (&answer, reference.len())
            && got.len() != due
            && let Some(reason) = &mut judgement.reason
        {
            // Which they are, and in which order.
            reason.push_str(&format!(": {}", Layout::new(method).answer()));
        }
        if judgement.verdict == Verdict::Undecided && bits < settings.last_bits {
            bits *= 2;
            continue;
        }
        let brief = judgement.verdict == Verdict::Pass && !always_digits;
        let (values, radii, proof) = match &reference {
            _ if brief => (Vec::new(), Vec::new(), None),
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
        };
        return CaseReport {
            case,
            answer: Some(answer),
            judgement,
            bits,
            reference: values,
            radii,
            proof,
        };
    }
}

/// Cases judged side by side before they are counted.
const CHUNK: usize = 1024;

/// Audits a method over its whole domain, on all cores. `progress` is called once for each case, and
/// for each point of its map.
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
    let laws = method.laws();
    let mut tally = Tally::new(method, usize::MAX);
    for start in (0..cases.len()).step_by(CHUNK) {
        let end = cases.len().min(start + CHUNK);
        let judged: Vec<_> = (start..end)
            .into_par_iter()
            .filter(|_| !stop.load(Ordering::Relaxed))
            .map(|i| {
                let case = cases.get(i);
                let answer = answer_of(method, &case.input);
                let report = judge_case_briefly(method, case, answer, settings);
                let held = laws.iter().map(|l| (l.residual)(&report.case.input));
                let residuals: Vec<Option<f64>> = held.collect();
                progress();
                (report, residuals)
            })
            .collect();
        for (report, residuals) in judged {
            tally.laws(&report.case, &residuals);
            tally.add(report);
        }
        if stop.load(Ordering::Relaxed) {
            tally.interrupt();
            break;
        }
    }
    let mut map = None;
    if settings.maps && !tally.is_interrupted() {
        map = error_map(method, settings, progress, stop);
        if map.is_none() && stop.load(Ordering::Relaxed) {
            tally.interrupt();
        }
    }
    let mut report = tally.finish(method, settings);
    report.map = map;
    for (i, output) in report.outputs.iter_mut().enumerate() {
        let worst = output.worst.as_ref().filter(|_| !report.interrupted);
        output.parts =
            worst.and_then(|case| error_parts(method, &case.input, i, settings.first_bits));
    }
    report
}

//! Answers against the reference, at the precision that decides.

use super::answer::{ReferenceAnswer, SolverAnswer};
use super::budget::NormBudget;
use super::case::Case;
use super::case_report::{Brief, CaseReport};
use super::exact::Exact;
use super::judge::{Judgement, Rules, Verdict, judge_by};
use super::layout::Layout;
use super::method::{Method, Output};
use super::reason::Reason;
use super::settings::Settings;
use super::ulp::Format;

/// Judges answers to a method's cases: facts that all of them share are computed once.
pub struct Judge<'a> {
    method: &'a dyn Method,
    settings: &'a Settings,
    outputs: Vec<Output>,
    norm: Option<NormBudget>,
    format: Format,
    /// True if a budget or the settings ask for condition numbers.
    conditional: bool,
}

impl<'a> Judge<'a> {
    /// For cases of this method.
    pub fn new(method: &'a dyn Method, settings: &'a Settings) -> Judge<'a> {
        let outputs = method.outputs();
        let asked = |o: &Output| o.budget.limit.needs_conditions();
        Judge {
            conditional: settings.conditions || outputs.iter().any(asked),
            norm: method.norm_budget(),
            format: method.format(),
            outputs,
            method,
            settings,
        }
    }

    /// Judges the answer to a case; the precision doubles until that can be decided, and once more
    /// where what decides is wide. Without `digits` the reference's are left out: they cost as much
    /// as a judgement.
    pub fn judge(&self, case: Case, answer: SolverAnswer, digits: bool) -> CaseReport {
        self.referee(case).judge_last(answer, digits)
    }

    /// [`Judge::judge`] without digits, in little space: of most cases no more is kept than counts.
    pub(super) fn judge_briefly(&self, case: &Case, answer: &mut SolverAnswer) -> Brief {
        self.represent(answer);
        let mut known = Known::new(&case.input);
        let decided = self.decide(&case.input, &mut known, answer);
        let shown = decided.shows(false);
        Brief {
            judgement: decided.judgement,
            bits: decided.bits,
            reference: shown.then(|| known.references.take(decided.level)),
        }
    }

    /// For several answers to one case.
    pub fn referee(&self, case: Case) -> Referee<'_> {
        Referee {
            known: Known::new(&case.input),
            judge: self,
            case,
        }
    }

    /// Rounds an answer to the method's format.
    fn represent(&self, answer: &mut SolverAnswer) {
        if let SolverAnswer::Values(v) = answer
            && self.format != Format::Double
        {
            v.iter_mut().for_each(|x| *x = self.format.round(*x));
        }
    }

    /// Computes the reference at the next precision.
    fn next(&self, input: &[f64], known: &mut Known, bits: u32) {
        let method = self.method;
        let reference = match &known.exact {
            Some(x) => method.reference(x.numbers(), bits),
            None => method.reference_not_finite(input),
        };
        // A finer reference may give them where this one does not.
        if known.conditions.is_none() && self.conditional && known.exact.is_some() {
            known.conditions = method.conditions_beside(input, &reference);
        }
        let signs = || method.signs_of_zero(input);
        known.references.push(reference.with_signs_of_zero(signs));
    }

    fn decide(&self, input: &[f64], known: &mut Known, answer: &SolverAnswer) -> Decided {
        let Judge {
            method,
            settings,
            format,
            ..
        } = *self;
        let rules = Rules {
            outputs: &self.outputs,
            norm: self.norm.as_ref(),
            format,
        };
        let allowed = answer.refusal().and_then(|word| {
            let allowed = method.may_refuse(known.exact.as_ref()?.numbers());
            allowed.filter(|allowed| *allowed == word)
        });
        // By the reference with the `level`-th number of bits, or as the refusal that is allowed.
        let mut judged = |bits: u32, level: usize| {
            if level == known.references.len() {
                self.next(input, known, bits);
            }
            let conditions = known.conditions.as_deref();
            match allowed {
                Some(word) => judge_by(&rules, answer, &ReferenceAnswer::Refuses(word), conditions),
                None => judge_by(&rules, answer, known.references.get(level), conditions),
            }
        };
        let (mut bits, mut level) = (settings.first_bits, 0);
        let mut judgement = judged(bits, level);
        while judgement.verdict == Verdict::Undecided && bits < settings.last_bits {
            (bits, level) = (2 * bits, level + 1);
            judgement = judged(bits, level);
        }
        // The first reference that decides may be so wide that its own error is what a report would
        // show.
        if judgement.wide && judgement.is_measured() && bits < settings.last_bits {
            let closer = judged(2 * bits, level + 1);
            if closer.is_measured() {
                (judgement, bits, level) = (closer, 2 * bits, level + 1);
            }
        }
        if let (SolverAnswer::Values(got), Some(expected)) =
            (answer, known.references.get(level).len())
            && got.len() != expected
            && let Some(reason) = &mut judgement.reason
        {
            // Which they are, and in which order.
            *reason = Reason::Words(format!("{reason}: {}", Layout::new(method).answer()));
        }
        Decided {
            judgement,
            bits,
            level,
        }
    }
}

/// By precision, doubled from one to the next. The first one decides as a rule: it takes no memory
/// of its own.
#[derive(Default)]
struct References {
    first: Option<ReferenceAnswer>,
    more: Vec<ReferenceAnswer>,
}

impl References {
    fn len(&self) -> usize {
        usize::from(self.first.is_some()) + self.more.len()
    }

    fn push(&mut self, reference: ReferenceAnswer) {
        match self.first {
            None => self.first = Some(reference),
            Some(_) => self.more.push(reference),
        }
    }

    fn get(&self, level: usize) -> &ReferenceAnswer {
        match &self.first {
            Some(first) if level == 0 => first,
            _ => &self.more[level - 1],
        }
    }

    /// The one of that level, the last use of them.
    fn take(mut self, level: usize) -> ReferenceAnswer {
        match self.first {
            Some(first) if level == 0 => first,
            _ => self.more.swap_remove(level - 1),
        }
    }
}

/// The findings about a case, shared by all answers to it.
struct Known {
    exact: Option<Exact>,
    references: References,
    conditions: Option<Vec<f64>>,
}

impl Known {
    fn new(input: &[f64]) -> Known {
        Known {
            exact: Exact::new(input),
            references: References::default(),
            conditions: None,
        }
    }
}

/// Judges answers to one case: what was computed of the reference serves them all.
pub struct Referee<'a> {
    judge: &'a Judge<'a>,
    case: Case,
    known: Known,
}

impl Referee<'_> {
    /// [`Judge::judge`], for an answer after which others may come.
    pub fn judge(&mut self, answer: SolverAnswer, digits: bool) -> CaseReport {
        let (answer, decided) = self.decide(answer);
        let reference = decided
            .shows(digits)
            .then(|| self.known.references.get(decided.level).clone());
        decided.report(self.case.clone(), answer, reference, digits)
    }

    /// [`Referee::judge`], for the last answer.
    pub fn judge_last(mut self, answer: SolverAnswer, digits: bool) -> CaseReport {
        let (answer, decided) = self.decide(answer);
        let reference = decided
            .shows(digits)
            .then(|| self.known.references.take(decided.level));
        decided.report(self.case, answer, reference, digits)
    }

    fn decide(&mut self, mut answer: SolverAnswer) -> (SolverAnswer, Decided) {
        self.judge.represent(&mut answer);
        let (input, known) = (&self.case.input, &mut self.known);
        let decided = self.judge.decide(input, known, &answer);
        (answer, decided)
    }
}

/// A judgement, and the reference that decided it.
struct Decided {
    judgement: Judgement,
    bits: u32,
    level: usize,
}

impl Decided {
    /// Returns true if the reference is of interest.
    fn shows(&self, digits: bool) -> bool {
        digits || self.judgement.verdict != Verdict::Pass
    }

    fn report(
        self,
        case: Case,
        answer: SolverAnswer,
        reference: Option<ReferenceAnswer>,
        digits: bool,
    ) -> CaseReport {
        let brief = Brief {
            judgement: self.judgement,
            bits: self.bits,
            reference,
        };
        let report = brief.report(case, answer);
        if digits { report.written() } else { report }
    }
}

#[cfg(test)]
mod tests;

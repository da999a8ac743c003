//! The judge: one solver answer against one reference answer.

use super::answer::{ReferenceAnswer, SolverAnswer};
use super::budget::{Limit, NormBudget};
use super::expected::{Due, Expected, Values};
use super::kind::Kind;
use super::method::Output;
use super::reason::{Fault, Reason, written};
use super::ulp::Format;
use mechaudit_reference::{Ball, Mag};
use serde::{Deserialize, Serialize};

mod norm;
mod passing;

use norm::{Squares, output_scales};
use passing::passing;

/// The outcome of one comparison. Only [`Verdict::Pass`] passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Certainly within the budget.
    Pass,
    /// The reference could not be decided against the budget.
    Undecided,
    /// Certainly over the budget.
    Over,
    /// A value where an error is due, an error where a value is due, NaN or an infinity where it is
    /// not due (or not there where it is), or a different number of values.
    WrongKind,
    /// The reference failed.
    OracleError,
}

/// One value judged.
#[derive(Clone, Debug, Serialize)]
pub struct ComponentJudgement {
    /// The output it belongs to.
    pub output: &'static str,
    /// The verdict.
    pub verdict: Verdict,
    /// In which way it is of the wrong kind, if it is.
    pub kind: Option<Kind>,
    /// The error in ulps of the reference, an upper bound; NaN where the reference cannot be told
    /// from zero, whose ulps mean nothing, and where no number is due.
    pub ulps: f64,
    /// The error in units of `2⁻⁵³ (|ref| + Σ_j |x_j ∂ref/∂x_j|)`, an upper bound; NaN without
    /// condition numbers.
    pub conditioned: f64,
    /// The error divided by what the budget allows, an upper bound.
    pub of_budget: f64,
    /// The condition number `Σ_j |x_j ∂f/∂x_j| / |f|`.
    pub condition: f64,
}

/// All values judged.
#[derive(Clone, Debug, Serialize)]
pub struct Judgement {
    /// The worst verdict.
    pub verdict: Verdict,
    /// The reason why it is not a pass, if it is not.
    pub reason: Option<Reason>,
    /// In which way it is of the wrong kind, if it is: the first value's that is.
    pub kind: Option<Kind>,
    /// One entry for each value.
    pub components: Vec<ComponentJudgement>,
    /// `‖got − ref‖₂ / max(‖ref‖₂, N)` in units of u, N the smallest normal number, an upper bound;
    /// over all values, so of meaning only where they share a unit. NaN unless all values are due
    /// as numbers.
    pub normwise: f64,
    /// The share of its budget that the norm of all errors takes up, an upper bound; NaN where
    /// there is no such budget or no norm.
    pub norm_of_budget: f64,
    /// True if a share of more than a sixteenth is, by more than half, the width of the reference:
    /// what the bounds on an error have in common says less than what they do not.
    #[serde(skip)]
    pub wide: bool,
}

impl Judgement {
    fn whole(verdict: Verdict, kind: Option<Kind>, reason: String) -> Judgement {
        Judgement {
            verdict,
            reason: Some(reason.into()),
            kind,
            components: Vec::new(),
            normwise: f64::INFINITY,
            norm_of_budget: f64::NAN,
            wide: false,
        }
    }

    fn wrong(kind: Kind, reason: String) -> Judgement {
        Judgement::whole(Verdict::WrongKind, Some(kind), reason)
    }

    /// Returns the reason why it is not a pass, in words.
    pub fn why(&self) -> Option<String> {
        self.reason.as_ref().map(Reason::to_string)
    }

    /// Returns true if the errors can be measured: the answer is right in kind, and the reference
    /// decided.
    pub fn is_measured(&self) -> bool {
        matches!(self.verdict, Verdict::Pass | Verdict::Over)
    }

    /// The largest share of a budget that a value or the norm takes up; infinite where a value is
    /// wrong in kind or its error has no bound.
    pub fn share(&self) -> f64 {
        if self.components.is_empty() && self.verdict != Verdict::Pass {
            return f64::INFINITY;
        }
        let shares = self.components.iter().map(|c| match c.of_budget {
            x if x.is_nan() => f64::INFINITY,
            x => x,
        });
        // NaN is less than any number here.
        shares.fold(0.0, f64::max).max(self.norm_of_budget)
    }
}

/// The rules by which an answer is judged.
#[derive(Clone, Copy, Debug)]
pub struct Rules<'a> {
    /// The outputs with their budgets.
    pub outputs: &'a [Output],
    /// The budget of the norm of all errors.
    pub norm: Option<&'a NormBudget>,
    /// The format of the numbers.
    pub format: Format,
}

/// Judges `answer` against `reference`.
///
/// `conditions` holds `Σ_j |x_j ∂f_i/∂x_j|` for each value. Without it every limit that needs it
/// is undecided.
///
/// Values beyond the range of `f64` are due as infinities: an infinite answer is as wrong as the
/// nearest number that rounds to it, so it passes from half a unit beyond the largest `f64` on and,
/// within the budget, just below.
pub fn judge(
    outputs: &[Output],
    answer: &SolverAnswer,
    reference: &ReferenceAnswer,
    conditions: Option<&[f64]>,
) -> Judgement {
    judge_with_norm(outputs, None, answer, reference, conditions)
}

/// [`judge`], and the norm of all errors against a budget of its own.
pub fn judge_with_norm(
    outputs: &[Output],
    norm: Option<&NormBudget>,
    answer: &SolverAnswer,
    reference: &ReferenceAnswer,
    conditions: Option<&[f64]>,
) -> Judgement {
    let rules = Rules {
        outputs,
        norm,
        format: Format::Double,
    };
    judge_by(&rules, answer, reference, conditions)
}

/// [`judge`] by all there is to judge by.
pub fn judge_by(
    rules: &Rules,
    answer: &SolverAnswer,
    reference: &ReferenceAnswer,
    conditions: Option<&[f64]>,
) -> Judgement {
    use ReferenceAnswer as R;
    let outputs = rules.outputs;
    let (got, values) = match (answer, reference) {
        (_, R::Failed(why)) => return Judgement::whole(Verdict::OracleError, None, why.clone()),
        // A missing answer is wrong, whatever is expected.
        (SolverAnswer::Unanswered(why), _) => {
            return Judgement::wrong(Kind::Unanswered, beside(why, reference));
        }
        (_, R::Undecided(why)) => return Judgement::whole(Verdict::Undecided, None, why.clone()),
        (SolverAnswer::Fails(why), _) => {
            return Judgement::wrong(Kind::Unreadable, beside(why, reference));
        }
        (SolverAnswer::Refuses(_) | SolverAnswer::Declines(_), _) => {
            return judge_refusal(answer.refusal(), reference);
        }
        (SolverAnswer::Values(got), R::Refuses(_)) => {
            return Judgement::wrong(Kind::Value, beside(&listed(got), reference));
        }
        (SolverAnswer::Values(got), R::Values(r)) => (got, Values::Numbers(&r.values)),
        (SolverAnswer::Values(got), R::Expected(expected, _)) => (got, Values::Expected(expected)),
    };
    if outputs.is_empty() || got.len() != values.len() {
        let reason = format!("{}, expected {}", counted(got.len()), counted(values.len()));
        return Judgement::wrong(Kind::Missing, reason);
    }
    let conditions = conditions.filter(|c| c.len() == values.len());
    let passing = match conditions {
        None => passing(rules, got, values),
        Some(_) => None,
    };
    passing.unwrap_or_else(|| judge_values(rules, got, values, conditions))
}

/// Judges values, as many as are due.
fn judge_values(
    rules: &Rules,
    got: &[f64],
    values: Values,
    conditions: Option<&[f64]>,
) -> Judgement {
    let outputs = rules.outputs;
    let scales = output_scales(outputs, values, conditions);
    let mut components = Vec::with_capacity(got.len());
    let mut worst = (Verdict::Pass, None, None);
    let mut squares = Squares::default();
    let mut wide = false;
    for (i, (&g, expected)) in got.iter().zip(values.iter()).enumerate() {
        let o = i % outputs.len();
        let (lo, hi) = expected.distance(g, rules.format);
        let size = expected.number().map(Ball::mignitude);
        squares.add(size, lo, hi);
        let place = Place {
            output: &outputs[o],
            condition: conditions.map(|c| c[i]),
            size: size.unwrap_or(Mag::ZERO),
            scale: scales.get(o).copied().unwrap_or((Mag::ZERO, Mag::ZERO)),
            format: rules.format,
        };
        let c = component(g, expected, [lo, hi], place);
        wide |= c.of_budget > 1.0 / 16.0 && lo.shift(1) < hi;
        if c.verdict > worst.0 {
            let fault = match c.verdict {
                Verdict::WrongKind => Fault::Kind,
                Verdict::Over => Fault::Over(c.of_budget),
                _ => Fault::Open,
            };
            let reason = Reason::Value {
                output: outputs[o].name,
                number: i,
                got: g,
                expected: expected.nearest(),
                fault,
            };
            worst = (c.verdict, c.kind, Some(reason));
        }
        components.push(c);
    }
    let numbers = got.iter().all(|g| g.is_finite());
    let norms = squares.norms(rules.format);
    let mut norm_of_budget = f64::NAN;
    if let Some(budget) = rules.norm.filter(|_| numbers && squares.numbers) {
        let (verdict, share) = squares.verdict(norms, budget, rules.format);
        norm_of_budget = share;
        if verdict > worst.0 {
            let open = match verdict {
                Verdict::Over => "",
                _ => ": the reference cannot decide it",
            };
            let reason = format!(
                "the norm of the errors is {share:.3e} times its budget, expected at most 1{open}"
            );
            worst = (verdict, None, Some(reason.into()));
        }
    }
    Judgement {
        verdict: worst.0,
        kind: worst.1,
        reason: worst.2,
        components,
        normwise: squares.normwise(norms, rules.format),
        norm_of_budget,
        wide,
    }
}

/// A refusal, named or not, against a reference that decided.
fn judge_refusal(word: Option<&str>, reference: &ReferenceAnswer) -> Judgement {
    let named = word.map_or("a refusal".into(), |w| format!("the refusal {w:?}"));
    match reference {
        ReferenceAnswer::Refuses(expected) if word.is_none_or(|w| w == *expected) => Judgement {
            verdict: Verdict::Pass,
            reason: None,
            kind: None,
            components: Vec::new(),
            normwise: 0.0,
            norm_of_budget: f64::NAN,
            wide: false,
        },
        _ => Judgement::wrong(Kind::Refusal, beside(&named, reference)),
    }
}

/// The answer found and the answer expected.
fn beside(came: &str, reference: &ReferenceAnswer) -> String {
    let expected = match reference {
        ReferenceAnswer::Refuses(word) => format!("the refusal {word:?}"),
        ReferenceAnswer::Values(r) => {
            listed(&r.values.iter().map(Ball::to_f64).collect::<Vec<f64>>())
        }
        ReferenceAnswer::Expected(expected, _) => {
            listed(&expected.iter().map(Expected::nearest).collect::<Vec<f64>>())
        }
        ReferenceAnswer::Undecided(_) | ReferenceAnswer::Failed(_) => return came.into(),
    };
    format!("{came}, expected {expected}")
}

/// A few values, or how many there are.
fn listed(values: &[f64]) -> String {
    const FEW: usize = 3;
    match values.len() {
        1..=FEW => {
            let each: Vec<String> = values.iter().map(|x| written(*x)).collect();
            each.join(", ")
        }
        n => counted(n),
    }
}

fn counted(values: usize) -> String {
    match values {
        1 => "1 value".into(),
        n => format!("{n} values"),
    }
}

/// The parts of the error that a limit allows.
struct Terms {
    limit: Limit,
    factor: Mag,
    size: Mag,
    condition: Option<f64>,
    half: Mag,
    ulp: i64,
    u: i64,
}

impl Terms {
    /// The allowed error, by sums and products from above; from below for the certainly allowed
    /// one.
    #[inline]
    fn bound(
        &self,
        scale: Mag,
        mul: impl Fn(Mag, Mag) -> Mag,
        add: impl Fn(Mag, Mag) -> Mag,
    ) -> Option<Mag> {
        let Terms {
            factor, size, half, ..
        } = *self;
        // k roundings of numbers of this size.
        let roundings = |of: Mag| match of.is_zero() {
            true => Mag::ZERO,
            false => mul(factor, of.shift(self.u).max(half)),
        };
        match (self.limit, self.condition) {
            (Limit::Ulps(_), _) => Some(factor.shift(self.ulp)),
            (Limit::Conditioned(_), Some(c)) => Some(roundings(add(size, Mag::from_f64(c)))),
            (Limit::Normwise(_), Some(_)) => Some(roundings(scale)),
            (Limit::Relative(_), _) => Some(mul(factor, size).max(half)),
            (Limit::Absolute(_), _) => Some(factor),
            (Limit::RelativeOrAbsolute(_, a), _) => {
                Some(mul(factor, size).max(half).max(Mag::from_f64(a)))
            }
            (Limit::OfNorm(_), _) => Some(mul(factor, scale).max(half)),
            _ => None,
        }
    }
}

/// Where a value stands, and what it is measured by.
#[derive(Clone, Copy)]
struct Place<'a> {
    output: &'a Output,
    condition: Option<f64>,
    /// A lower bound on the reference.
    size: Mag,
    /// Rounded down and up.
    scale: (Mag, Mag),
    format: Format,
}

/// Returns the fault of a value that is known to be of the wrong kind.
fn wrong_kind(got: f64, expected: Due) -> Kind {
    match got {
        g if g.is_nan() => Kind::Nan,
        g if expected.wrong_zero(g) => Kind::WrongZero,
        g if g.is_infinite() => Kind::Infinity,
        _ => Kind::Finite,
    }
}

/// Judges a value whose error is between the two bounds.
fn component(got: f64, expected: Due, [lo, hi]: [Mag; 2], place: Place) -> ComponentJudgement {
    let Place {
        output,
        condition,
        size,
        scale,
        format,
    } = place;
    let limit = output.budget.limit;
    let Some(reference) = expected.number() else {
        let (verdict, of_budget) = match lo.is_zero() {
            true => (Verdict::Pass, 0.0),
            false => (Verdict::WrongKind, f64::INFINITY),
        };
        return ComponentJudgement {
            output: output.name,
            verdict,
            kind: (verdict == Verdict::WrongKind).then(|| wrong_kind(got, expected)),
            ulps: f64::NAN,
            conditioned: f64::NAN,
            of_budget,
            condition: f64::NAN,
        };
    };
    let ulp = format.ulp_exponent(reference.mid());
    let u = -format.precision();
    // The error that the rounding of a subnormal number may add.
    let half = Mag::power_of_two(format.least() - 1);
    // An infinite or absurd condition number allows nothing rather than everything.
    let condition = condition.filter(|c| c.is_finite());
    let relative = condition.map_or(f64::NAN, |c| {
        if size.is_zero() {
            f64::INFINITY
        } else {
            Mag::from_f64(c).div(size).to_f64()
        }
    });
    let factor = Mag::from_f64(limit.factor());
    let terms = Terms {
        limit,
        factor,
        size,
        condition,
        half,
        ulp,
        u,
    };
    let allowed = terms.bound(scale.1, Mag::mul, Mag::add);
    let certain = terms.bound(scale.0, Mag::mul_below, Mag::add_below);
    let verdict = match allowed {
        _ if got.is_nan() || expected.wrong_zero(got) => Verdict::WrongKind,
        _ if !reference.is_finite() => Verdict::Undecided,
        _ if certain.is_some_and(|a| hi <= a) => Verdict::Pass,
        // An infinity for a number or a number for an infinity.
        Some(a) if lo > a && (got.is_infinite() || overflows(reference, format)) => {
            Verdict::WrongKind
        }
        Some(a) if lo > a => Verdict::Over,
        _ => Verdict::Undecided,
    };
    let conditioned = condition.map_or(f64::NAN, |c| {
        hi.div(size.add(Mag::from_f64(c)).shift(u)).to_f64()
    });
    let ulps = if size.is_zero() {
        f64::NAN
    } else {
        hi.shift(-ulp).to_f64()
    };
    ComponentJudgement {
        output: output.name,
        verdict,
        kind: (verdict == Verdict::WrongKind).then(|| wrong_kind(got, expected)),
        ulps,
        conditioned,
        of_budget: allowed.map_or(f64::INFINITY, |a| hi.div(a).to_f64()),
        condition: relative,
    }
}

/// Returns true if the number certainly rounds to an infinity.
fn overflows(reference: &Ball, format: Format) -> bool {
    if reference.magnitude() < format.largest_power() {
        return false;
    }
    (&reference.abs() - &format.overflow()).lower() >= 0
}

#[cfg(test)]
mod tests;

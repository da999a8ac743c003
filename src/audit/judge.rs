//! The judge: one solver answer against one reference answer.

use super::budget::Limit;
use super::method::{Output, ReferenceAnswer, SolverAnswer};
use super::ulp::{distance, ulp_exponent};
use crate::reference::{Ball, Mag};
use serde::Serialize;

/// The outcome of one comparison. Only [`Verdict::Pass`] passes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Certainly within the budget.
    Pass,
    /// The reference could not be decided against the budget.
    Undecided,
    /// Certainly over the budget.
    Over,
    /// A value where an error is due, an error where a value is due, NaN, an infinity, or a
    /// different number of values.
    WrongKind,
    /// The reference failed.
    OracleError,
}

/// One value judged.
#[derive(Clone, Debug, Serialize)]
pub struct ComponentJudgement {
    /// The verdict.
    pub verdict: Verdict,
    /// The error in ulps of the reference, an upper bound; NaN where the reference cannot be told
    /// from zero, whose ulps mean nothing.
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
    /// Why it is not a pass, if it is not.
    pub reason: Option<String>,
    /// One entry for each value.
    pub components: Vec<ComponentJudgement>,
    /// `‖got − ref‖₂ / ‖ref‖₂` in units of 2⁻⁵³, an upper bound; over all values, so of meaning
    /// only where they share a unit.
    pub normwise: f64,
}

impl Judgement {
    fn whole(verdict: Verdict, reason: String) -> Judgement {
        Judgement {
            verdict,
            reason: Some(reason),
            components: Vec::new(),
            normwise: f64::INFINITY,
        }
    }
}

/// Judges `answer` against `reference`.
///
/// `conditions` holds `Σ_j |x_j ∂f_i/∂x_j|` for each value. Without it every limit that needs it
/// is undecided.
pub fn judge(
    outputs: &[Output],
    answer: &SolverAnswer,
    reference: &ReferenceAnswer,
    conditions: Option<&[f64]>,
) -> Judgement {
    use ReferenceAnswer as R;
    let (got, values) = match (answer, reference) {
        (_, R::Failed(why)) => return Judgement::whole(Verdict::OracleError, why.clone()),
        (_, R::Undecided(why)) => return Judgement::whole(Verdict::Undecided, why.clone()),
        (SolverAnswer::Refuses(a), R::Refuses(b)) if a == b => {
            return Judgement {
                verdict: Verdict::Pass,
                reason: None,
                components: Vec::new(),
                normwise: 0.0,
            };
        }
        (SolverAnswer::Refuses(a), R::Refuses(b)) => {
            return Judgement::whole(
                Verdict::WrongKind,
                format!("refused as {a:?}, the reference as {b:?}"),
            );
        }
        (SolverAnswer::Refuses(a), R::Values(_)) => {
            return Judgement::whole(
                Verdict::WrongKind,
                format!("refused as {a:?} where values exist"),
            );
        }
        (SolverAnswer::Values(_), R::Refuses(b)) => {
            return Judgement::whole(
                Verdict::WrongKind,
                format!("values given where the reference refuses as {b:?}"),
            );
        }
        (SolverAnswer::Values(got), R::Values(r)) => (got, &r.values),
    };
    if outputs.is_empty() || got.len() != values.len() {
        let reason = format!("{} values where {} are due", got.len(), values.len());
        return Judgement::whole(Verdict::WrongKind, reason);
    }
    let conditions = conditions.filter(|c| c.len() == values.len());
    let scales = output_scales(outputs.len(), values, conditions);
    let mut components = Vec::with_capacity(got.len());
    let mut worst = (Verdict::Pass, None);
    let (mut error2, mut norm2) = (Mag::ZERO, Mag::ZERO);
    for (i, (&g, r)) in got.iter().zip(values).enumerate() {
        let o = i % outputs.len();
        let (lo, hi) = distance(g, r);
        error2 = error2.add(hi.mul(hi));
        let low = r.mignitude();
        norm2 = norm2.add(low.mul(low));
        let c = component(
            g,
            r,
            lo,
            hi,
            outputs[o].budget.limit,
            conditions.map(|c| c[i]),
            scales[o],
        );
        if c.verdict > worst.0 {
            let place = format!("{} (value {i})", outputs[o].name);
            let reason = match c.verdict {
                Verdict::WrongKind => format!("{place} is {g}"),
                Verdict::Over => format!("{place} is {:.3} times its budget off", c.of_budget),
                _ => format!("{place} cannot be decided against its budget"),
            };
            worst = (c.verdict, Some(reason));
        }
        components.push(c);
    }
    let normwise = error2.sqrt().div(norm2.sqrt()).shift(53).to_f64();
    Judgement {
        verdict: worst.0,
        reason: worst.1,
        components,
        normwise,
    }
}

/// `max_i (|ref_i| + cond_i)` for each output, for the normwise limits.
fn output_scales(outputs: usize, values: &[Ball], conditions: Option<&[f64]>) -> Vec<Mag> {
    let mut scales = vec![Mag::ZERO; outputs];
    for (i, v) in values.iter().enumerate() {
        let c = conditions.map_or(Mag::ZERO, |c| Mag::from_f64(c[i]));
        scales[i % outputs] = scales[i % outputs].max(v.mignitude().add(c));
    }
    scales
}

fn component(
    got: f64,
    reference: &Ball,
    lo: Mag,
    hi: Mag,
    limit: Limit,
    condition: Option<f64>,
    scale: Mag,
) -> ComponentJudgement {
    let ulp = ulp_exponent(reference.mid());
    let size = reference.mignitude();
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
    let allowed = match (limit, condition) {
        (Limit::Ulps(_), _) => Some(factor.shift(ulp)),
        (Limit::Conditioned(_), Some(c)) => Some(factor.mul(size.add(Mag::from_f64(c))).shift(-53)),
        (Limit::Normwise(_), Some(_)) => Some(factor.mul(scale).shift(-53)),
        _ => None,
    };
    let verdict = if !got.is_finite() {
        Verdict::WrongKind
    } else {
        match allowed {
            _ if !reference.is_finite() => Verdict::Undecided,
            Some(a) if hi <= a => Verdict::Pass,
            Some(a) if lo > a => Verdict::Over,
            _ => Verdict::Undecided,
        }
    };
    let conditioned = condition.map_or(f64::NAN, |c| {
        hi.div(size.add(Mag::from_f64(c)).shift(-53)).to_f64()
    });
    let ulps = if size.is_zero() {
        f64::NAN
    } else {
        hi.shift(-ulp).to_f64()
    };
    ComponentJudgement {
        verdict,
        ulps,
        conditioned,
        of_budget: allowed.map_or(f64::INFINITY, |a| hi.div(a).to_f64()),
        condition: relative,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Budget, Proof, Reference};
    use rug::Float;

    fn outputs(limit: Limit) -> Vec<Output> {
        vec![Output {
            name: "x",
            unit: "1",
            budget: Budget::new(limit, "planted"),
        }]
    }

    fn truth() -> Vec<f64> {
        vec![1.25, -3.0e-5, 7.0e8]
    }

    fn exact(values: &[f64]) -> ReferenceAnswer {
        ReferenceAnswer::Values(Reference {
            values: values.iter().map(|&x| Ball::exact(128, x)).collect(),
            proof: Proof::Exact,
        })
    }

    fn verdict(got: Vec<f64>, limit: Limit) -> Verdict {
        let c = [1.25, 3.0e-5, 7.0e8];
        judge(
            &outputs(limit),
            &SolverAnswer::Values(got),
            &exact(&truth()),
            Some(&c),
        )
        .verdict
    }

    const LIMITS: [Limit; 3] = [
        Limit::Ulps(4.0),
        Limit::Conditioned(4.0),
        Limit::Normwise(4.0),
    ];

    #[test]
    fn the_truth_passes() {
        for limit in LIMITS {
            assert_eq!(verdict(truth(), limit), Verdict::Pass);
        }
    }

    #[test]
    fn planted_faults_fail_under_every_limit() {
        for limit in LIMITS {
            for (fault, verdict_due) in [
                (f64::NAN, Verdict::WrongKind),
                (f64::INFINITY, Verdict::WrongKind),
                (f64::NEG_INFINITY, Verdict::WrongKind),
            ] {
                for i in 0..3 {
                    let mut got = truth();
                    got[i] = fault;
                    assert_eq!(verdict(got, limit), verdict_due);
                }
            }
            let mut swapped = truth();
            swapped.swap(0, 2);
            assert_eq!(verdict(swapped, limit), Verdict::Over);
            let mut sign = truth();
            sign[2] = -sign[2];
            assert_eq!(verdict(sign, limit), Verdict::Over);
            assert_eq!(verdict(truth()[..2].to_vec(), limit), Verdict::WrongKind);
            assert_eq!(verdict(vec![], limit), Verdict::WrongKind);
        }
        // A wrong sign on the small value is lost in a norm, and only there.
        let mut sign = truth();
        sign[1] = -sign[1];
        assert_eq!(verdict(sign.clone(), Limit::Ulps(4.0)), Verdict::Over);
        assert_eq!(verdict(sign, Limit::Conditioned(4.0)), Verdict::Over);
    }

    #[test]
    fn one_ulp_over_the_budget_fails() {
        let shifted = |k: u64| vec![f64::from_bits(1.25f64.to_bits() + k), -3.0e-5, 7.0e8];
        assert_eq!(verdict(shifted(4), Limit::Ulps(4.0)), Verdict::Pass);
        assert_eq!(verdict(shifted(5), Limit::Ulps(4.0)), Verdict::Over);
        // 1.25 + cond 1.25 is 2.5, and 2^-53 · 2.5 is 1.25 ulps of 1.25.
        assert_eq!(verdict(shifted(5), Limit::Conditioned(4.0)), Verdict::Pass);
        assert_eq!(verdict(shifted(6), Limit::Conditioned(4.0)), Verdict::Over);
    }

    #[test]
    fn a_reference_that_proves_nothing_passes_nothing() {
        let o = outputs(Limit::Ulps(4.0));
        let got = SolverAnswer::Values(vec![1.0]);
        let infinite = ReferenceAnswer::Values(Reference {
            values: vec![Ball::new(Float::with_val(64, 1.0), Mag::INFINITY)],
            proof: Proof::Exact,
        });
        assert_eq!(judge(&o, &got, &infinite, None).verdict, Verdict::Undecided);
        let coarse = ReferenceAnswer::Values(Reference {
            values: vec![Ball::new(Float::with_val(64, 1.0), Mag::from_f64(1e-15))],
            proof: Proof::Exact,
        });
        assert_eq!(judge(&o, &got, &coarse, None).verdict, Verdict::Undecided);
        let undecided = ReferenceAnswer::Undecided("planted".into());
        assert_eq!(
            judge(&o, &got, &undecided, None).verdict,
            Verdict::Undecided
        );
        let failed = ReferenceAnswer::Failed("planted".into());
        assert_eq!(judge(&o, &got, &failed, None).verdict, Verdict::OracleError);
        let refused = SolverAnswer::Refuses("singular");
        assert_eq!(
            judge(&o, &refused, &failed, None).verdict,
            Verdict::OracleError
        );
    }

    #[test]
    fn refusals_have_to_match() {
        let o = outputs(Limit::Ulps(4.0));
        let singular = ReferenceAnswer::Refuses("singular");
        let refused = SolverAnswer::Refuses("singular");
        let other = SolverAnswer::Refuses("not finite");
        assert_eq!(judge(&o, &refused, &singular, None).verdict, Verdict::Pass);
        assert_eq!(
            judge(&o, &other, &singular, None).verdict,
            Verdict::WrongKind
        );
        assert_eq!(
            judge(&o, &refused, &exact(&[1.0]), None).verdict,
            Verdict::WrongKind
        );
        let value = SolverAnswer::Values(vec![1.0]);
        assert_eq!(
            judge(&o, &value, &singular, None).verdict,
            Verdict::WrongKind
        );
    }

    #[test]
    fn missing_or_infinite_conditions_do_not_pass() {
        let o = outputs(Limit::Conditioned(4.0));
        let got = SolverAnswer::Values(vec![2.0]);
        let r = exact(&[1.0]);
        assert_eq!(judge(&o, &got, &r, None).verdict, Verdict::Undecided);
        assert_eq!(
            judge(&o, &got, &r, Some(&[f64::INFINITY])).verdict,
            Verdict::Undecided
        );
        assert_eq!(
            judge(&o, &got, &r, Some(&[f64::NAN])).verdict,
            Verdict::Undecided
        );
        assert_eq!(
            judge(&o, &got, &r, Some(&[1.0, 1.0])).verdict,
            Verdict::Undecided
        );
        assert_eq!(judge(&o, &got, &r, Some(&[1.0])).verdict, Verdict::Over);
    }
}

//! Runs a method over its domain and gathers what was found.

use super::case::{Case, Origin};
use super::domain::Draw;
use super::judge::{ComponentJudgement, Judgement, Verdict, judge_with_norm};
use super::method::{Method, Proof, ReferenceAnswer, SolverAnswer};
use rayon::prelude::*;
use rug::Rational;
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};

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
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 1,
            cases_per_region: 200,
            first_bits: 128,
            last_bits: 2048,
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
    /// Why the reference holds.
    pub proof: Option<Proof>,
}

/// What was found for one output.
#[derive(Clone, Debug, Serialize)]
pub struct OutputStatistics {
    /// The output.
    pub name: &'static str,
    /// Values judged.
    pub values: usize,
    /// Errors in ulps, over the values that are not zero.
    pub ulps: Spread,
    /// Errors in units of `2⁻⁵³ (|ref| + Σ_j |x_j ∂ref/∂x_j|)`: what is left of them when each
    /// input's last half-ulp is forgiven. Nothing where no condition numbers are asked for.
    pub conditioned: Spread,
    /// Largest share of the budget found.
    pub max_of_budget: f64,
    /// Largest finite condition number met.
    pub max_condition: f64,
    /// The case with the largest share of the budget.
    pub worst: Option<Case>,
}

/// How errors are spread; zeros if there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Number of errors.
    pub count: usize,
    /// The largest found.
    pub max: f64,
    /// 99th percentile (nearest rank).
    pub p99: f64,
    /// Root mean square.
    pub rms: f64,
}

impl Spread {
    /// Of all values that are numbers.
    fn of(values: impl Iterator<Item = f64>) -> Spread {
        let mut sorted: Vec<f64> = values.filter(|v| !v.is_nan()).collect();
        sorted.sort_by(f64::total_cmp);
        let Some(&max) = sorted.last() else {
            return Spread::default();
        };
        let n = sorted.len() as f64;
        let rank = (n * 0.99).ceil() as usize;
        Spread {
            count: sorted.len(),
            max,
            p99: sorted[rank.max(1) - 1],
            rms: (sorted.iter().map(|u| u * u).sum::<f64>() / n).sqrt(),
        }
    }
}

/// What was found about one law.
#[derive(Clone, Debug, Serialize)]
pub struct LawReport {
    /// Its name.
    pub name: &'static str,
    /// The identity.
    pub statement: &'static str,
    /// Cases it was tried on.
    pub cases: usize,
    /// Largest residual found, divided by what is allowed.
    pub worst: f64,
    /// The case with the largest residual.
    pub worst_case: Option<Case>,
}

/// What was found about one method.
#[derive(Clone, Debug, Serialize)]
pub struct MethodReport {
    /// The method.
    pub method: &'static str,
    /// In plain words.
    pub summary: &'static str,
    /// Its source.
    pub source: &'static str,
    /// The settings.
    pub settings: Settings,
    /// Cases judged.
    pub cases: usize,
    /// Cases passed.
    pub passed: usize,
    /// For each output.
    pub outputs: Vec<OutputStatistics>,
    /// For each law.
    pub laws: Vec<LawReport>,
    /// Largest normwise error found, in units of 2⁻⁵³.
    pub max_normwise: f64,
    /// The cases that did not pass.
    pub failures: Vec<CaseReport>,
}

impl MethodReport {
    /// Whether every case and every law passed, and there was at least one case.
    pub fn passed(&self) -> bool {
        self.cases > 0 && self.passed == self.cases && self.laws.iter().all(|l| l.worst <= 1.0)
    }
}

/// The cases of a run, check points first.
pub(crate) fn cases(method: &dyn Method, settings: &Settings) -> Vec<Case> {
    let domain = method.domain();
    let named = domain.check_points.into_iter().map(|p| Case {
        method: method.name(),
        region: "check-points",
        input: p.input,
        origin: Origin::CheckPoint { name: p.name },
    });
    let mut all: Vec<Case> = named.collect();
    for region in &domain.regions {
        all.extend((0..settings.cases_per_region).map(|index| {
            let mut draw = Draw::new(settings.seed, method.name(), region.name, index);
            Case {
                method: method.name(),
                region: region.name,
                input: (region.sample)(&mut draw),
                origin: Origin::Random {
                    seed: settings.seed,
                    index,
                },
            }
        }));
    }
    all
}

/// Audits one case: the precision doubles until the judge can decide.
pub fn audit_case(method: &dyn Method, case: Case, settings: &Settings) -> CaseReport {
    let exact: Option<Vec<Rational>> = case.input.iter().map(|&x| Rational::from_f64(x)).collect();
    let solved = catch_unwind(AssertUnwindSafe(|| method.solve(&case.input)));
    let answer = solved.unwrap_or(SolverAnswer::Refuses("panicked"));
    let outputs = method.outputs();
    let norm = method.norm_budget();
    let conditional = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    let finite = exact.is_some();
    let conditions = if finite && conditional {
        method.conditions(&case.input)
    } else {
        None
    };
    let mut bits = settings.first_bits;
    loop {
        let reference = match &exact {
            Some(x) => method.reference(x, bits),
            None => method.reference_not_finite(&case.input),
        };
        let c = conditions.as_deref();
        let judgement = judge_with_norm(&outputs, norm.as_ref(), &answer, &reference, c);
        if judgement.verdict == Verdict::Undecided && bits < settings.last_bits {
            bits *= 2;
            continue;
        }
        let (values, proof) = match &reference {
            ReferenceAnswer::Values(r) => (
                r.values.iter().map(|b| b.to_decimal(20)).collect(),
                Some(r.proof),
            ),
            ReferenceAnswer::Dues(dues, proof) => (
                dues.iter().map(|d| d.to_decimal(20)).collect(),
                Some(*proof),
            ),
            _ => (Vec::new(), None),
        };
        return CaseReport {
            case,
            answer: Some(answer),
            judgement,
            bits,
            reference: values,
            proof,
        };
    }
}

/// Audits a method over its whole domain, on all cores. `progress` is called once for each case.
pub fn audit_method(
    method: &dyn Method,
    settings: &Settings,
    progress: &(dyn Fn() + Sync),
) -> MethodReport {
    let reports: Vec<CaseReport> = cases(method, settings)
        .into_par_iter()
        .map(|case| {
            let report = audit_case(method, case, settings);
            progress();
            report
        })
        .collect();
    let outputs = method.outputs();
    let statistics = (0..outputs.len())
        .map(|o| statistics(o, outputs.len(), outputs[o].name, &reports))
        .collect();
    let laws = method
        .laws()
        .iter()
        .map(|law| law_report(law, &reports))
        .collect();
    let max_normwise = reports
        .iter()
        .filter(|r| !r.judgement.components.is_empty())
        .map(|r| r.judgement.normwise)
        .fold(0.0, f64::max);
    MethodReport {
        method: method.name(),
        summary: method.summary(),
        source: method.source(),
        settings: settings.clone(),
        cases: reports.len(),
        passed: reports
            .iter()
            .filter(|r| r.judgement.verdict == Verdict::Pass)
            .count(),
        outputs: statistics,
        laws,
        max_normwise,
        failures: reports
            .into_iter()
            .filter(|r| r.judgement.verdict != Verdict::Pass)
            .collect(),
    }
}

fn law_report(law: &super::method::Law, reports: &[CaseReport]) -> LawReport {
    let mut found = LawReport {
        name: law.name,
        statement: law.statement,
        cases: 0,
        worst: 0.0,
        worst_case: None,
    };
    let residuals: Vec<Option<f64>> = reports
        .par_iter()
        .map(|r| (law.residual)(&r.case.input))
        .collect();
    for (r, residual) in reports.iter().zip(residuals) {
        if let Some(x) = residual {
            // A residual that is not a number breaks the law.
            let x = if x.is_nan() { f64::INFINITY } else { x };
            found.cases += 1;
            if x > found.worst {
                found.worst = x;
                found.worst_case = Some(r.case.clone());
            }
        }
    }
    found
}

fn statistics(
    o: usize,
    outputs: usize,
    name: &'static str,
    reports: &[CaseReport],
) -> OutputStatistics {
    let judged: Vec<(&Case, &ComponentJudgement)> = reports
        .iter()
        .flat_map(|r| {
            let own = r.judgement.components.iter().skip(o).step_by(outputs);
            own.map(move |c| (&r.case, c))
        })
        .collect();
    // A share that is not a number is the worst of all.
    let share = |c: &ComponentJudgement| {
        if c.of_budget.is_nan() {
            f64::INFINITY
        } else {
            c.of_budget
        }
    };
    let worst = judged
        .iter()
        .max_by(|a, b| share(a.1).total_cmp(&share(b.1)));
    OutputStatistics {
        name,
        values: judged.len(),
        ulps: Spread::of(judged.iter().map(|(_, c)| c.ulps)),
        conditioned: Spread::of(judged.iter().map(|(_, c)| c.conditioned)),
        max_of_budget: worst.map_or(0.0, |(_, c)| share(c)),
        max_condition: judged
            .iter()
            .map(|(_, c)| c.condition)
            .filter(|c| c.is_finite())
            .fold(0.0, f64::max),
        worst: worst.map(|(case, _)| (*case).clone()),
    }
}

#[cfg(test)]
mod tests {
    use super::Spread;

    #[test]
    fn spread() {
        let s = Spread::of((1..=200).map(f64::from).chain([f64::NAN]));
        assert_eq!((s.count, s.max, s.p99), (200, 200.0, 198.0));
        assert!((s.rms - (201.0f64 * 401.0 / 6.0).sqrt()).abs() < 1e-12);
        assert_eq!(Spread::of(std::iter::empty()), Spread::default());
        assert_eq!(
            Spread::of([3.0, f64::INFINITY].into_iter()).max,
            f64::INFINITY
        );
    }
}

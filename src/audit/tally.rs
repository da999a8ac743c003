//! What was found, gathered case by case.

use super::case::Case;
use super::hard::HardCase;
use super::judge::{ComponentJudgement, Verdict};
use super::maps::ErrorMap;
use super::method::Method;
use super::parts::ErrorParts;
use super::run::{CaseReport, Settings};
use serde::Serialize;
use std::collections::BTreeMap;

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
    /// The errors in ulps counted by octaves: `(k, n)` for n errors in `[2^k, 2^(k+1))`, `(None, n)`
    /// for exact values.
    pub histogram: Vec<(Option<i32>, usize)>,
    /// Largest share of the budget found.
    pub max_of_budget: f64,
    /// Largest finite condition number met.
    pub max_condition: f64,
    /// The case with the largest share of the budget.
    pub worst: Option<Case>,
    /// Its error taken apart, where the method has a twin.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<ErrorParts>,
}

/// How errors are spread; zeros if there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Number of errors.
    pub count: usize,
    /// The largest found.
    pub max: f64,
    /// 99th percentile (nearest rank), rounded up by less than a thousandth.
    pub p99: f64,
    /// Root mean square.
    pub rms: f64,
}

/// Gathers a [`Spread`] in a bounded space: counts of numbers with the same leading eleven bits.
#[derive(Clone, Debug, Default)]
pub struct SpreadTally {
    bins: BTreeMap<u64, usize>,
    count: usize,
    max: f64,
    /// Of numbers up to 2^500; of larger ones, each divided by 2^600.
    squares: [f64; 2],
}

/// Bits of the fraction dropped for the percentile.
const DROPPED: u32 = 42;

impl SpreadTally {
    /// One error, which is not negative; NaN is passed over.
    pub fn add(&mut self, value: f64) {
        if value.is_nan() {
            return;
        }
        *self.bins.entry(value.to_bits() >> DROPPED).or_default() += 1;
        self.count += 1;
        self.max = self.max.max(value);
        let (large, scale) = match value < 2f64.powi(500) {
            true => (0, 1.0),
            false => (1, 2f64.powi(-600)),
        };
        self.squares[large] += (value * scale).powi(2);
    }

    /// The numbers counted by octaves, finite ones only.
    pub fn octaves(&self) -> Vec<(Option<i32>, usize)> {
        let mut octaves: BTreeMap<Option<i32>, usize> = BTreeMap::new();
        for (bin, n) in &self.bins {
            let x = f64::from_bits(bin << DROPPED);
            let octave = match x {
                0.0 => None,
                x if x.is_finite() => Some(x.log2().floor() as i32),
                _ => continue,
            };
            *octaves.entry(octave).or_default() += n;
        }
        octaves.into_iter().collect()
    }

    /// What was gathered.
    pub fn spread(&self) -> Spread {
        if self.count == 0 {
            return Spread::default();
        }
        let rank = (self.count as f64 * 0.99).ceil() as usize;
        let mut below = 0;
        let bin = self.bins.iter().find(|(_, n)| {
            below += *n;
            below >= rank
        });
        // The largest number in the bin.
        let edge = bin.map_or(self.max, |(b, _)| {
            f64::from_bits((b << DROPPED) | ((1 << DROPPED) - 1))
        });
        Spread {
            count: self.count,
            max: self.max,
            p99: if edge.is_nan() {
                self.max
            } else {
                edge.min(self.max)
            },
            rms: self.rms(),
        }
    }

    fn rms(&self) -> f64 {
        let ([squares, large], count) = (self.squares, self.count as f64);
        match large > 0.0 {
            // The small ones are less than an ulp of these.
            true => (large / count).sqrt() * 2f64.powi(600),
            false => (squares / count).sqrt(),
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
    /// Hard cases over budget by no more than is recorded of the method's own solver.
    pub recorded: usize,
    /// Whether the run was ended before all cases were judged.
    pub interrupted: bool,
    /// For each output.
    pub outputs: Vec<OutputStatistics>,
    /// For each law.
    pub laws: Vec<LawReport>,
    /// The error map, where one was asked for and the method has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub map: Option<ErrorMap>,
    /// Largest normwise error found, in units of 2⁻⁵³.
    pub max_normwise: f64,
    /// The cases that did not pass, the first of them if there are very many.
    pub failures: Vec<CaseReport>,
    /// How many more did not pass.
    pub failures_left_out: usize,
    /// How many of those left out got no answer.
    pub unanswered: usize,
}

impl MethodReport {
    /// Whether all cases were judged and every one and every law passed, but for recorded findings, and there was at least
    /// one case.
    pub fn passed(&self) -> bool {
        let all = self.passed + self.recorded == self.cases;
        let laws = self.laws.iter().all(|l| l.worst <= 1.0);
        !self.interrupted && self.cases > 0 && all && laws
    }
}

/// What was found for one output so far.
#[derive(Clone, Debug, Default)]
struct OutputTally {
    values: usize,
    ulps: SpreadTally,
    conditioned: SpreadTally,
    max_of_budget: f64,
    max_condition: f64,
    worst: Option<Case>,
}

impl OutputTally {
    fn add(&mut self, case: &Case, c: &ComponentJudgement) {
        self.values += 1;
        self.ulps.add(c.ulps);
        self.conditioned.add(c.conditioned);
        if c.condition.is_finite() {
            self.max_condition = self.max_condition.max(c.condition);
        }
        // A share that is not a number is the worst of all.
        let share = match c.of_budget {
            x if x.is_nan() => f64::INFINITY,
            x => x,
        };
        if share > self.max_of_budget || self.worst.is_none() {
            self.max_of_budget = share;
            self.worst = Some(case.clone());
        }
    }
}

/// Counts judged cases as they come and keeps no more of them than it has to.
pub struct Tally {
    outputs: Vec<OutputTally>,
    laws: Vec<LawReport>,
    cases: usize,
    passed: usize,
    recorded: usize,
    interrupted: bool,
    hard: Vec<HardCase>,
    max_normwise: f64,
    failures: Vec<CaseReport>,
    failures_kept: usize,
    unanswered: usize,
}

impl Tally {
    /// Nothing found yet; that many failing cases will be kept.
    pub fn new(method: &dyn Method, failures_kept: usize) -> Tally {
        let laws = method.laws().into_iter().map(|law| LawReport {
            name: law.name,
            statement: law.statement,
            cases: 0,
            worst: 0.0,
            worst_case: None,
        });
        Tally {
            outputs: vec![OutputTally::default(); method.outputs().len()],
            laws: laws.collect(),
            cases: 0,
            passed: 0,
            recorded: 0,
            interrupted: false,
            hard: method.hard(),
            max_normwise: 0.0,
            failures: Vec::new(),
            failures_kept,
            unanswered: 0,
        }
    }

    /// One case.
    pub fn add(&mut self, report: CaseReport) {
        self.cases += 1;
        let components = &report.judgement.components;
        let outputs = self.outputs.len();
        for (i, c) in components.iter().enumerate() {
            self.outputs[i % outputs].add(&report.case, c);
        }
        if !components.is_empty() {
            self.max_normwise = self.max_normwise.max(report.judgement.normwise);
        }
        if report.judgement.verdict == Verdict::Pass {
            self.passed += 1;
        } else if self.is_recorded(&report) {
            self.recorded += 1;
        } else if self.failures.len() < self.failures_kept {
            self.failures.push(report);
        }
    }

    /// Whether this is a hard case, over its budget by no more than is recorded. It is known by its
    /// input, which may have come in a file.
    fn is_recorded(&self, report: &CaseReport) -> bool {
        let shares = report.judgement.components.iter().map(|c| c.of_budget);
        let share = shares.fold(0.0, f64::max);
        let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
        let input = bits(&report.case.input);
        // A norm over its budget is no value over its own.
        report.judgement.verdict == Verdict::Over
            && share > 1.0
            && self
                .hard
                .iter()
                .any(|h| h.allows(share) && bits(&h.input) == input)
    }

    /// The residuals of the method's laws at a case, in the laws' order.
    pub fn laws(&mut self, case: &Case, residuals: &[Option<f64>]) {
        for (law, residual) in self.laws.iter_mut().zip(residuals) {
            let Some(x) = *residual else { continue };
            // A residual that is not a number breaks the law.
            let x = if x.is_nan() { f64::INFINITY } else { x };
            law.cases += 1;
            if x > law.worst {
                law.worst = x;
                law.worst_case = Some(case.clone());
            }
        }
    }

    /// The run ends before its last case.
    pub fn interrupt(&mut self) {
        self.interrupted = true;
    }

    /// Whether [`Tally::interrupt`] has been called.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Cases that got no answer: they count, and do not pass.
    pub fn unanswered(&mut self, cases: usize) {
        self.cases += cases;
        self.unanswered += cases;
    }

    /// The report.
    pub fn finish(self, method: &dyn Method, settings: &Settings) -> MethodReport {
        let outputs = method.outputs().into_iter().zip(self.outputs);
        MethodReport {
            method: method.name(),
            summary: method.summary(),
            source: method.source(),
            settings: settings.clone(),
            cases: self.cases,
            passed: self.passed,
            recorded: self.recorded,
            interrupted: self.interrupted,
            outputs: outputs
                .map(|(o, found)| OutputStatistics {
                    name: o.name,
                    values: found.values,
                    ulps: found.ulps.spread(),
                    histogram: found.ulps.octaves(),
                    conditioned: found.conditioned.spread(),
                    max_of_budget: found.max_of_budget,
                    max_condition: found.max_condition,
                    worst: found.worst,
                    parts: None,
                })
                .collect(),
            laws: self.laws,
            map: None,
            max_normwise: self.max_normwise,
            failures_left_out: self.cases - self.passed - self.recorded - self.failures.len(),
            unanswered: self.unanswered,
            failures: self.failures,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Spread, SpreadTally};

    fn of(values: impl Iterator<Item = f64>) -> Spread {
        let mut tally = SpreadTally::default();
        values.for_each(|v| tally.add(v));
        tally.spread()
    }

    #[test]
    fn spread() {
        let s = of((1..=200).map(f64::from).chain([f64::NAN]));
        assert_eq!((s.count, s.max), (200, 200.0));
        assert!((198.0..198.2).contains(&s.p99), "{}", s.p99);
        assert!((s.rms - (201.0f64 * 401.0 / 6.0).sqrt()).abs() < 1e-12);
        assert_eq!(of(std::iter::empty()), Spread::default());
        for large in [1e160, 1e300] {
            let s = of([large, 3.0, large, 0.0].into_iter());
            assert!((s.rms / large - 0.5f64.sqrt()).abs() < 1e-12, "{s:?}");
        }
        let s = of([3.0, f64::INFINITY].into_iter());
        assert_eq!((s.max, s.p99), (f64::INFINITY, f64::INFINITY));
        let mut tally = SpreadTally::default();
        [0.0, 1.5, 1.0, 0.26, f64::INFINITY]
            .into_iter()
            .for_each(|v| tally.add(v));
        assert_eq!(tally.octaves(), [(None, 1), (Some(-2), 1), (Some(0), 2)]);
        assert_eq!(of([0.0; 5].into_iter()).p99, 0.0);
    }
}

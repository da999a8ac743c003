//! Decides claims: maxima by an audit of the claim's own domain and a hunt in it, means by a
//! certified sample.

use super::claim::{Claim, Measure, Place, Statistic, Verdict};
use super::code::{self, answer};
use super::effort::Effort;
use super::lines::{self, HartmannTran};
use super::mean::{Mean, mean};
use super::{at, rounded};
use crate::audit::{
    Cases, HuntSettings, Limit, Method, Region, Settings, SolverAnswer, Variant, Verdict as Judged,
    audit_method, hunt, judge_case_briefly,
};
use crate::methods::find;
use mechaudit_atlas::{Algorithm, PROFILES, Profile, find as find_algorithm};
use rayon::prelude::*;
use serde::Serialize;

/// Points of an audit, evaluations of a hunt, points of a mean, for each case of a region.
const AUDITED: u64 = 10;
const HUNTED: u64 = 20;
const AVERAGED: u64 = 40;
/// A strip this low may be what a claim leaves out.
const STRIP: f64 = 0.1;

/// A claim with what became of it.
#[derive(Clone, Debug, Serialize)]
pub struct Decided {
    /// The algorithm.
    pub algorithm: &'static str,
    /// As printed.
    pub statement: &'static str,
    /// Where, and what was read.
    pub source: &'static str,
    /// How it is read here.
    pub reading: &'static str,
    /// Where it is tested.
    pub domain: &'static str,
    /// Holds what is measured, in words.
    pub measure: String,
    /// Holds what it may be.
    pub bound: Option<f64>,
    /// Holds what became of it.
    pub verdict: Verdict,
    /// Which part holds, or why it cannot be tested.
    pub part: String,
    /// Points and evaluations of hunts.
    pub points: u64,
    /// The largest error found, or the mean.
    pub found: Option<f64>,
    /// Half the width of the mean's interval.
    pub within: Option<f64>,
    /// The point with the largest error; a claim is refuted by it.
    pub at: Option<Vec<f64>>,
    /// A command that shows it.
    pub reproduce: Option<String>,
}

/// Decides it.
pub fn decide(claim: &Claim, effort: &Effort) -> Decided {
    let mut decided = Decided {
        algorithm: claim.algorithm,
        statement: claim.statement,
        source: claim.source,
        reading: claim.reading,
        domain: claim.test.map_or("", |t| t.0.words),
        measure: String::new(),
        bound: claim.test.map(|t| t.3),
        verdict: Verdict::NotTestable,
        part: claim.reading.into(),
        points: 0,
        found: None,
        within: None,
        at: None,
        reproduce: None,
    };
    let (Some((place, measure, statistic, bound)), Some(subject)) =
        (claim.test, Subject::of(claim.algorithm))
    else {
        return decided;
    };
    decided.part = String::new();
    match statistic {
        Statistic::Maximum => {
            decided.measure = measure.words().into();
            let tested = Tested::new(subject, place, measure, bound);
            maximum(&mut decided, &tested, effort);
        }
        Statistic::Mean => {
            decided.measure = format!("mean, {}", measure.words());
            let tested = Tested::new(subject, place, measure, 1.0);
            let Some(m) = tested.mean(effort) else {
                decided.verdict = Verdict::Refuted;
                decided.part = "an answer is no number".into();
                return decided;
            };
            decided.points = m.points;
            decided.found = Some(rounded(m.mean));
            decided.within = Some(rounded(m.within));
            decided.verdict = of_mean(&m, bound);
        }
    }
    let shown = |z: &Vec<f64>| format!("mechaudit {}", code::at(claim.algorithm, z));
    decided.reproduce = decided.at.as_ref().map(shown);
    decided
}

/// The interval of a mean is below the bound, above it, or holds it.
fn of_mean(m: &Mean, bound: f64) -> Verdict {
    match bound {
        b if m.mean + m.within <= b => Verdict::Holds,
        b if m.mean - m.within > b => Verdict::Refuted,
        _ => Verdict::Open,
    }
}

/// Describes what a claim is about.
pub(super) enum Subject {
    W(Algorithm),
    Line(Profile),
}

impl Subject {
    pub(super) fn of(name: &str) -> Option<Subject> {
        let profile = PROFILES.into_iter().find(|p| p.name == name);
        let algorithm = find_algorithm(name).map(Subject::W);
        algorithm.or(profile.map(Subject::Line))
    }

    pub(super) fn method(&self) -> Box<dyn Method> {
        match self {
            Subject::W(_) => find("faddeeva").expect("a method of the registry"),
            Subject::Line(_) => Box::new(HartmannTran),
        }
    }

    pub(super) fn answer(&self, input: &[f64]) -> SolverAnswer {
        match self {
            Subject::W(a) => answer(a, input),
            Subject::Line(p) => lines::answer(p, input),
        }
    }
}

/// An algorithm where a claim is tested.
struct Tested {
    subject: Subject,
    place: Place,
    measure: Measure,
    bound: f64,
    method: Box<dyn Method>,
}

impl Tested {
    fn new(subject: Subject, place: Place, measure: Measure, bound: f64) -> Tested {
        Tested {
            method: subject.method(),
            subject,
            place,
            measure,
            bound,
        }
    }

    /// Calls `f` with the method over the claim's domain above `Im z = floor`, judged as the claim
    /// is read.
    fn over<T>(&self, floor: f64, f: impl FnOnce(&dyn Method) -> T) -> T {
        let region = Region::new("claim", self.place.words, self.place.draw);
        let holds =
            move |z: &[f64]| (z[1] >= floor || floor == f64::NEG_INFINITY) && (self.place.holds)(z);
        let part = match self.measure {
            Measure::RelativeIm => 1..2,
            Measure::RelativeRe | Measure::AbsoluteRe => 0..1,
            _ => 0..2,
        };
        let names: Vec<&str> = self.method.outputs().iter().map(|o| o.name).collect();
        let chosen = &names[part.clone()];
        let solve = move |z: &[f64]| match self.subject.answer(z) {
            SolverAnswer::Values(v) if v.len() == 2 => SolverAnswer::Values(v[part.clone()].into()),
            other => other,
        };
        let placed = Variant::new(&*self.method).placed(vec![region], holds);
        let variant = placed.solver(solve);
        let variant = match self.measure {
            Measure::Norm => variant.norm_limit(self.bound),
            Measure::Absolute | Measure::AbsoluteRe => variant.limit(Limit::Absolute(self.bound)),
            _ => variant.limit(Limit::Relative(self.bound)),
        };
        let variant = match chosen.len() {
            2 => variant,
            _ => variant.outputs(chosen).expect("outputs of W"),
        };
        f(&variant)
    }

    /// The error at a point in units of the bound, and whether it certainly is over it.
    fn share(&self, method: &dyn Method, z: &[f64]) -> (f64, bool) {
        let (case, answer) = (at(self.method.name(), z), method.solve(z));
        let report = judge_case_briefly(method, case, answer, &Settings::default());
        let j = &report.judgement;
        let over = matches!(j.verdict, Judged::Over | Judged::WrongKind);
        // Of a norm the components' shares are of the same bound and no larger.
        (j.share(), over)
    }

    fn mean(&self, effort: &Effort) -> Option<Mean> {
        let settings = effort.settings(AVERAGED);
        self.over(f64::NEG_INFINITY, |method| {
            let cases = Cases::new(method, &settings);
            let errors: Vec<f64> = (0..cases.len())
                .into_par_iter()
                .map(|i| self.share(method, &cases.get(i).input).0)
                .collect();
            let numbers = errors.iter().all(|e| e.is_finite());
            numbers.then(|| mean(&errors))
        })
    }
}

/// The worst of a search.
struct Search {
    worst: Option<(f64, Vec<f64>, bool)>,
    /// The highest failing point.
    ceiling: f64,
    points: u64,
}

impl Search {
    /// Considers what is certain before what is not.
    fn offer(&mut self, (share, over): (f64, bool), z: &[f64]) {
        if over {
            self.ceiling = self.ceiling.max(z[1]);
        }
        let worse = |w: &(f64, Vec<f64>, bool)| (over, share) > (w.2, w.0);
        if self.worst.as_ref().is_none_or(worse) {
            self.worst = Some((share, z.to_vec(), over));
        }
    }
}

fn searched(tested: &Tested, floor: f64, effort: &Effort) -> Search {
    let mut search = Search {
        worst: None,
        ceiling: f64::NEG_INFINITY,
        points: 0,
    };
    tested.over(floor, |method| {
        if floor == f64::NEG_INFINITY {
            let report = audit_method(method, &effort.settings(AUDITED), &|| ());
            search.points += report.cases;
            let found = report.failures.iter().chain(&report.worst);
            for case in found.chain(&report.wrong) {
                let z = &case.case.input;
                search.offer(tested.share(method, z), z);
            }
        }
        let hunted = HuntSettings {
            evaluations: effort.cases * HUNTED,
            seed: effort.seed,
        };
        let found = hunt(method, &hunted, &|_| ());
        search.points += found.evaluations;
        let worst = found.worst.iter().map(|w| &w.input);
        for z in worst.chain(found.failures.iter().map(|f| &f.input)) {
            search.offer(tested.share(method, z), z);
        }
    });
    search
}

fn maximum(decided: &mut Decided, tested: &Tested, effort: &Effort) {
    let search = searched(tested, f64::NEG_INFINITY, effort);
    decided.points = search.points;
    let Some((share, z, over)) = search.worst else {
        return;
    };
    decided.found = Some(rounded(share * tested.bound));
    decided.at = Some(z.clone());
    decided.verdict = match (over, share <= 1.0) {
        (true, _) => Verdict::Refuted,
        (false, true) => Verdict::Holds,
        // The reference could not tell.
        (false, false) => Verdict::Open,
    };
    // Looks at the rest without a strip along the real axis.
    let ceiling = search.ceiling;
    let plane = matches!(tested.subject, Subject::W(_));
    if !over || !plane || !(0.0..STRIP).contains(&ceiling) {
        return;
    }
    let mut floor = power_above(ceiling);
    for _ in 0..4 {
        if floor > STRIP {
            return;
        }
        let above = searched(tested, floor, effort);
        decided.points += above.points;
        match above.worst {
            Some((share, _, false)) if share <= 1.0 => {
                decided.verdict = Verdict::InPart;
                decided.part = format!("where Im z >= {floor:e}");
                return;
            }
            Some((_, z, true)) => floor = power_above(above.ceiling.max(z[1])),
            _ => return,
        }
    }
}

/// The power of ten above a number, not below 1e-20.
fn power_above(y: f64) -> f64 {
    let k = (y.max(1e-20) * (1.0 + 1e-9)).log10().floor() as i32 + 1;
    format!("1e{k}").parse().unwrap_or(f64::INFINITY)
}

#[cfg(test)]
mod tests;

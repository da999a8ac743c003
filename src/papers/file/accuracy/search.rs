//! The search for the largest error of a solver, and the mean of its errors.

use super::{Held, Measure, Test};
use crate::audit::{
    Case, Cases, HuntSettings, Limit, Method, Origin, Settings, SolverAnswer, Variant,
    Verdict as Judged, audit_method, hunt, hunt_answers, judge_case_briefly,
};
use crate::papers::{Figure, figure};
use crate::study::Study;
use rayon::prelude::*;
use rug::Rational;
use std::sync::atomic::AtomicBool;

/// Evaluations of the hunt for each point.
const HUNTED: u64 = 2;
const SEED: u64 = 1;

/// The findings of a test.
pub(super) struct Found {
    pub(super) held: Held,
    /// The largest error in units of the bound.
    pub(super) size: f64,
    /// The largest error, or the mean, in words.
    pub(super) error: String,
    /// The input with the largest error, with what the solver gave and what is due there.
    pub(super) at: Vec<Figure>,
    pub(super) points: u64,
}

/// A mean of errors, and four standard errors: by the central limit theorem the interval misses the
/// mean once in 16000 samples; where a few points carry the mean it may miss it more often.
pub(super) fn mean(errors: &[f64]) -> [f64; 2] {
    let n = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / n;
    let squares: f64 = errors.iter().map(|e| (e - mean) * (e - mean)).sum();
    [mean, 4.0 * (squares / (n - 1.0).max(1.0) / n).sqrt()]
}

impl Test {
    /// A study with its solver, judged by a limit.
    fn variant<'a>(&self, study: &'a Study, limit: f64) -> Option<Variant<'a>> {
        let variant = Variant::new(study);
        let variant = match self.measure {
            Measure::Norm => variant.norm_limit(limit),
            Measure::Absolute => variant.limit(Limit::Absolute(limit)),
            Measure::Relative => variant.limit(Limit::Relative(limit)),
        };
        let variant = match self.output {
            Some(output) => variant.outputs(&[output]).ok()?,
            None => variant,
        };
        let Some(program) = self.program.clone() else {
            return Some(variant);
        };
        let variant = variant.solver(move |input| program.solve(study, input));
        // All at once: a program is started for each batch.
        let cases = Cases::new(&variant, &self.settings());
        let inputs = (0..cases.len()).map(|k| cases.get(k).input);
        if let Some(program) = self.program.as_ref().filter(|_| self.at.is_none()) {
            program.answers(study, &inputs.collect::<Vec<_>>());
        }
        Some(variant)
    }

    fn settings(&self) -> Settings {
        Settings {
            seed: SEED,
            cases_per_region: self.cases,
            ..Settings::default()
        }
    }

    /// The error at an input in units of the limit, and whether it certainly is over it.
    fn share(method: &dyn Method, input: &[f64]) -> (f64, bool) {
        let answer = method.solve(input);
        // A program that has not answered has not erred.
        if let SolverAnswer::Unanswered(_) = answer {
            return (f64::INFINITY, false);
        }
        let case = Case {
            method: method.name(),
            region: "given",
            input: input.to_vec(),
            origin: Origin::Given,
        };
        let judgement = judge_case_briefly(method, case, answer, &Settings::default()).judgement;
        let over = matches!(judgement.verdict, Judged::Over | Judged::WrongKind);
        (judgement.share(), over)
    }

    /// The largest error that an audit and a hunt find, in the part that the claim names as well
    /// where it is refuted.
    pub(super) fn largest(&self) -> Found {
        let mut found = match &self.at {
            Some(input) => self.worst_of(&self.studies[0], [input], 1),
            None => self.searched(&self.studies),
        };
        if let (Held::Refuted, Some((part, _))) = (found.held, &self.part) {
            let of_part = self.searched(part);
            found.points += of_part.points;
            if of_part.held == Held::AsFarAsSearched {
                found.held = Held::InPart;
            }
        }
        found
    }

    /// The worst that is found over some studies.
    fn searched(&self, studies: &[Study]) -> Found {
        let found = studies.iter().map(|study| self.searched_one(study));
        let worse = |a: Found, b: Found| {
            let points = a.points + b.points;
            // A refutation is worse than an open case, and that than a proof.
            let is_worse = (b.held, b.size) > (a.held, a.size);
            let worst = if is_worse { b } else { a };
            Found { points, ..worst }
        };
        let none = || self.worst_of(&self.studies[0], [], 0);
        found.reduce(worse).unwrap_or_else(none)
    }

    fn searched_one(&self, study: &Study) -> Found {
        let Some(variant) = self.variant(study, self.bound) else {
            return self.worst_of(study, [], 0);
        };
        let report = audit_method(&variant, &self.settings(), &|| ());
        let hunted = HuntSettings {
            evaluations: self.cases * HUNTED,
            seed: SEED,
        };
        let climbed = match &self.program {
            Some(program) => {
                let answers = |inputs: &[Vec<f64>]| program.answers(study, inputs);
                let never = AtomicBool::new(false);
                hunt_answers(&variant, &hunted, &answers, &|_| (), &never)
            }
            None => hunt(&variant, &hunted, &|_| ()),
        };
        let audited = report.failures.iter().chain(&report.worst);
        let audited = audited.chain(&report.wrong).map(|c| &c.case.input);
        let worst = climbed.worst.iter().map(|w| &w.input);
        let climbed_to = worst.chain(climbed.failures.iter().map(|f| &f.input));
        let points = report.cases + climbed.evaluations;
        self.worst_of(study, audited.chain(climbed_to), points)
    }

    /// The verdict that the worst of some inputs gives.
    fn worst_of<'a>(
        &self,
        study: &Study,
        inputs: impl IntoIterator<Item = &'a Vec<f64>>,
        points: u64,
    ) -> Found {
        let mut worst: Option<(bool, f64, &Vec<f64>)> = None;
        let variant = self.variant(study, self.bound);
        for input in inputs {
            let Some(variant) = &variant else { break };
            let (share, over) = Test::share(variant, input);
            // Certain errors come before uncertain ones; a share that is no number is the worst.
            let size = if share.is_nan() { f64::INFINITY } else { share };
            if worst.is_none_or(|w| (over, size) > (w.0, w.1)) {
                worst = Some((over, size, input));
            }
        }
        let held = match &worst {
            Some((true, ..)) => Held::Refuted,
            Some((false, share, _)) if *share <= 1.0 => Held::AsFarAsSearched,
            _ => Held::Open,
        };
        let error = worst.map_or("nothing".into(), |w| format!("{:.2e}", w.1 * self.bound));
        let shown = worst.filter(|_| held != Held::AsFarAsSearched || self.at.is_some());
        Found {
            held,
            size: worst.map_or(0.0, |w| w.1),
            error,
            at: shown.map_or_else(Vec::new, |w| self.shown(study, w.2)),
            points,
        }
    }

    /// An input, the numbers of the solver there, and those that are due.
    fn shown(&self, study: &Study, input: &[f64]) -> Vec<Figure> {
        let inputs = study.inputs();
        let values = inputs.iter().zip(input);
        let values = values.map(|(i, x)| format!("{} = {x:?}", i.name));
        let mut figures = vec![figure("at", values.collect::<Vec<_>>().join(", "), "1")];
        let outputs = study.outputs();
        let exact: Option<Vec<_>> = input.iter().map(|x| Rational::from_f64(*x)).collect();
        let due = exact.map_or_else(Vec::new, |exact| study.digits(&exact, 12));
        let answer = match &self.program {
            Some(program) => program.solve(study, input),
            None => study.solve(input),
        };
        if let SolverAnswer::Values(got) = answer {
            for ((output, got), due) in outputs.iter().zip(got).zip(due) {
                if self.output.is_none_or(|o| o == output.name) {
                    let due = due.decimal.unwrap_or_else(|| "undecided".into());
                    let value = format!("{got:.11e}, due {due}");
                    figures.push(figure(output.name, value, output.unit));
                }
            }
        }
        figures
    }

    /// The mean of the errors over points drawn as the inputs are spaced.
    pub(super) fn mean(&self) -> Found {
        let mut errors: Vec<f64> = Vec::new();
        for study in &self.studies {
            let variant = self.variant(study, 1.0);
            let Some(variant) = variant.and_then(|v| v.region("domain").ok()) else {
                continue;
            };
            let cases = Cases::new(&variant, &self.settings());
            let all = (0..cases.len()).into_par_iter();
            let found = all.map(|k| Test::share(&variant, &cases.get(k).input).0);
            errors.extend(found.collect::<Vec<f64>>());
        }
        let points = errors.len() as u64;
        // Without a sample, or with an error that is no number, the mean is none, and the claim is
        // open.
        let [mean, within] = match errors.iter().all(|e| e.is_finite()) {
            true => mean(&errors),
            false => [f64::NAN; 2],
        };
        let held = match self.bound {
            b if mean + within <= b => Held::AsFarAsSearched,
            b if mean - within > b => Held::Refuted,
            _ => Held::Open,
        };
        Found {
            held,
            size: mean,
            error: match mean.is_nan() {
                true => "an error that is no number".into(),
                false => format!("{mean:.2e} within {within:.1e}"),
            },
            at: Vec::new(),
            points,
        }
    }
}

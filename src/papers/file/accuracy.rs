//! Claims about the accuracy of algorithms: a solver, a region, a measure and a bound, tested by an audit and a hunt.

use super::read::{Reading, count, required, text, word};
use super::study;
use crate::audit::{
    Case, Cases, HuntSettings, Limit, Method, Origin, Settings, Variant, Verdict as Judged,
    audit_method, hunt, judge_case_briefly, selected_outputs,
};
use crate::claims::mean;
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figure};
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, intern, rational};
use rayon::prelude::*;

/// The measure of an error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// `|got − ref|/|ref|` of each output.
    Relative,
    /// `|got − ref|` of each output.
    Absolute,
    /// `‖got − ref‖₂/‖ref‖₂` over all outputs.
    Norm,
}

/// The claim about the errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statistic {
    /// Every one is at most the bound.
    Largest,
    /// Their mean over points drawn as the region says is at most the bound.
    Mean,
}

/// The verdict on a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// At every point tried, or the interval of the mean is below the bound.
    AsFarAsSearched,
    /// At a point that is named it certainly does not hold, or the interval of the mean is above the bound.
    Refuted,
    /// The reference could not tell, or the interval of the mean holds the bound.
    Open,
    /// It states no bound.
    NotTestable,
}

/// A claim about an algorithm.
#[derive(Clone)]
pub struct Accuracy {
    /// A stable name.
    pub id: &'static str,
    /// Where it is claimed.
    pub place: &'static str,
    /// Its statement.
    pub claim: &'static str,
    /// A further remark, for instance how it is read.
    pub note: &'static str,
    /// The verdict on record.
    pub expected: Held,
    test: Option<Test>,
}

impl std::fmt::Debug for Accuracy {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Accuracy")
            .field("id", &self.id)
            .finish_non_exhaustive()
    }
}

/// The evidence that decides a claim.
#[derive(Clone)]
struct Test {
    study: Study,
    region: Option<&'static str>,
    output: Option<&'static str>,
    measure: Measure,
    statistic: Statistic,
    bound: f64,
    printed: &'static str,
    cases: u64,
}

const KEYS: [&str; 13] = [
    "id",
    "place",
    "claims",
    "note",
    "study",
    "solver",
    "region",
    "output",
    "measure",
    "statistic",
    "bound",
    "cases",
    "verdict",
];

const MEASURES: [(&str, Measure); 3] = [
    ("relative", Measure::Relative),
    ("absolute", Measure::Absolute),
    ("norm", Measure::Norm),
];

const STATISTICS: [(&str, Statistic); 2] =
    [("largest", Statistic::Largest), ("mean", Statistic::Mean)];

const VERDICTS: [(&str, Held); 4] = [
    ("holds", Held::AsFarAsSearched),
    ("refuted", Held::Refuted),
    ("open", Held::Open),
    ("not testable", Held::NotTestable),
];

/// Points in each region, unless the claim says how many, and the largest number.
const CASES: u32 = 300;
const MOST_CASES: u32 = 100_000;
/// Evaluations of the hunt for each point.
const HUNTED: u64 = 2;
const SEED: u64 = 1;

/// Reads a claim; without a bound it is not testable.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Accuracy, StudyError> {
    node.only(&KEYS)?;
    let id = reading.id(node)?;
    for key in ["place", "claims"] {
        required(node, key)?;
    }
    let test = node
        .get("bound")
        .map(|bound| test(reading, node, bound))
        .transpose()?;
    let expected = word(node.get("verdict"), &VERDICTS, Held::AsFarAsSearched)?;
    if test.is_none() != (expected == Held::NotTestable) {
        return Err(node.fault("a claim has a bound, or the verdict \"not testable\""));
    }
    Ok(Accuracy {
        id,
        place: text(node, "place")?,
        claim: text(node, "claims")?,
        note: text(node, "note")?,
        expected,
        test,
    })
}

fn test(reading: &Reading, node: &Node, bound: &Node) -> Result<Test, StudyError> {
    let number = rational(bound)?.to_f64();
    if !(number > 0.0 && number.is_finite()) {
        return Err(bound.fault("a bound is a positive number"));
    }
    let study = study::open(reading, required(node, "study")?)?;
    let solver = required(node, "solver")?;
    let study = study
        .with_solver(solver.text()?)
        .map_err(|e| e.at(solver.place))?;
    let part = |key: &str| node.get(key).map(|n| n.text().map(intern)).transpose();
    let (region, output) = (part("region")?, part("output")?);
    if let (Some(region), Some(at)) = (region, node.get("region")) {
        Variant::new(&study)
            .region(region)
            .map_err(|e| at.fault(e.to_string()))?;
    }
    if let (Some(output), Some(at)) = (output, node.get("output")) {
        selected_outputs(&study, &[output]).map_err(|e| at.fault(e.to_string()))?;
    }
    let cases = node
        .get("cases")
        .map_or(Ok(CASES), |n| count(n, MOST_CASES))?;
    Ok(Test {
        study,
        region,
        output,
        measure: word(node.get("measure"), &MEASURES, Measure::Relative)?,
        statistic: word(node.get("statistic"), &STATISTICS, Statistic::Largest)?,
        bound: number,
        printed: intern(bound.text()?),
        cases: u64::from(cases.max(1)),
    })
}

/// The findings of a test.
struct Found {
    held: Held,
    /// The largest error, or the mean, in words.
    error: String,
    /// The input with the largest error.
    at: Option<String>,
    points: u64,
}

impl Accuracy {
    /// Decides the claim.
    pub(super) fn finding(&self) -> Finding {
        let found = self.test.as_ref().map(|test| match test.statistic {
            Statistic::Largest => test.largest(),
            Statistic::Mean => test.mean(),
        });
        let held = found.as_ref().map_or(Held::NotTestable, |f| f.held);
        let (verdict, word) = match held {
            Held::AsFarAsSearched => (FindingVerdict::Confirmed, "Holds as far as searched."),
            Held::Refuted => (FindingVerdict::Refuted, "Refuted."),
            Held::Open => (
                FindingVerdict::Unexplained,
                "Open: the reference or the sample could not tell.",
            ),
            Held::NotTestable => (
                FindingVerdict::Unexplained,
                "Not testable: no bound is stated.",
            ),
        };
        let mut figures = Vec::new();
        if let (Some(test), Some(found)) = (&self.test, &found) {
            figures.push(figure("claimed bound", test.printed, "1"));
            figures.push(figure("found", &found.error, "1"));
            figures.extend(found.at.as_ref().map(|at| figure("at", at, "1")));
            figures.push(figure("points", found.points.to_string(), "1"));
        }
        let text = [word, self.note].join(" ");
        Draft::new(self.id, Subject::Claim, self.place)
            .verdict(verdict)
            .titled(self.claim.trim_end_matches('.'))
            .text(text.trim())
            .figures(figures)
            .recorded_if(held == self.expected)
    }
}

impl Test {
    /// The study with its solver, judged by a limit in the region of the claim.
    fn variant(&self, limit: f64) -> Option<Variant<'_>> {
        let variant = Variant::new(&self.study);
        let variant = match self.region {
            Some(region) => variant.region(region).ok()?,
            None => variant,
        };
        let variant = match self.measure {
            Measure::Norm => variant.norm_limit(limit),
            Measure::Absolute => variant.limit(Limit::Absolute(limit)),
            Measure::Relative => variant.limit(Limit::Relative(limit)),
        };
        match self.output {
            Some(output) => variant.outputs(&[output]).ok(),
            None => Some(variant),
        }
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
        let case = Case {
            method: method.name(),
            region: "given",
            input: input.to_vec(),
            origin: Origin::Given,
        };
        let report = judge_case_briefly(method, case, method.solve(input), &Settings::default());
        let j = &report.judgement;
        (
            j.share(),
            matches!(j.verdict, Judged::Over | Judged::WrongKind),
        )
    }

    /// The largest error that an audit and a hunt find.
    fn largest(&self) -> Found {
        let mut worst: Option<(bool, f64, Vec<f64>)> = None;
        let mut points = 0;
        if let Some(variant) = self.variant(self.bound) {
            let report = audit_method(&variant, &self.settings(), &|| ());
            let hunted = HuntSettings {
                evaluations: self.cases * HUNTED,
                seed: SEED,
            };
            let climbed = hunt(&variant, &hunted, &|_| ());
            points = report.cases + climbed.evaluations;
            let audited = report
                .failures
                .iter()
                .chain(&report.worst)
                .chain(&report.wrong);
            let audited = audited.map(|c| &c.case.input);
            let climbed = climbed
                .worst
                .iter()
                .map(|w| &w.input)
                .chain(climbed.failures.iter().map(|f| &f.input));
            for input in audited.chain(climbed) {
                let (share, over) = Test::share(&variant, input);
                // Certain errors come before uncertain ones; a share that is no number is the worst.
                let size = if share.is_nan() { f64::INFINITY } else { share };
                if worst.as_ref().is_none_or(|w| (over, size) > (w.0, w.1)) {
                    worst = Some((over, size, input.clone()));
                }
            }
        }
        let held = match &worst {
            Some((true, ..)) => Held::Refuted,
            Some((false, share, _)) if *share <= 1.0 => Held::AsFarAsSearched,
            _ => Held::Open,
        };
        let error = worst
            .as_ref()
            .map_or("nothing".into(), |w| format!("{:.2e}", w.1 * self.bound));
        let names: Vec<&str> = self.study.inputs().iter().map(|i| i.name).collect();
        let at = worst.filter(|_| held != Held::AsFarAsSearched).map(|w| {
            let values = names
                .iter()
                .zip(&w.2)
                .map(|(name, x)| format!("{name} = {x:?}"));
            values.collect::<Vec<_>>().join(", ")
        });
        Found {
            held,
            error,
            at,
            points,
        }
    }

    /// The mean of the errors with four standard errors.
    fn mean(&self) -> Found {
        let errors: Vec<f64> = self.variant(1.0).map_or_else(Vec::new, |variant| {
            let cases = Cases::new(&variant, &self.settings());
            let all = (0..cases.len()).into_par_iter();
            all.map(|k| Test::share(&variant, &cases.get(k).input).0)
                .collect()
        });
        let points = errors.len() as u64;
        if errors.is_empty() || !errors.iter().all(|e| e.is_finite()) {
            let (held, error) = (Held::Open, "an error that is no number".into());
            return Found {
                held,
                error,
                at: None,
                points,
            };
        }
        let m = mean(&errors);
        let held = match self.bound {
            b if m.mean + m.within <= b => Held::AsFarAsSearched,
            b if m.mean - m.within > b => Held::Refuted,
            _ => Held::Open,
        };
        let error = format!("{:.2e} within {:.1e}", m.mean, m.within);
        Found {
            held,
            error,
            at: None,
            points,
        }
    }
}

#[cfg(test)]
mod tests;

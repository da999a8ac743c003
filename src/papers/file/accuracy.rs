//! Claims about the accuracy of algorithms: a solver, a region, a measure and a bound, tested by an audit and a hunt.

use super::read::{Reading, count, required, text, texts, word};
use crate::audit::{
    Case, CaseReport, Cases, HuntSettings, Limit, Method, Origin, Settings, Variant,
    Verdict as Judged, audit_method, hunt, judge_case_briefly, selected_outputs,
};
use crate::papers::{Draft, Figure, Finding, FindingVerdict, Subject, figure};
use crate::reference::nearest_f64;
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, StudyInput, input, intern, rational};
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
    /// Refuted in the region, but at every point tried of a part that the claim names.
    InPart,
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
    /// The study over each region of the claim.
    studies: Vec<Study>,
    /// The same over the part where the claim holds, with the part in words.
    part: Option<(Vec<Study>, String)>,
    /// The only input, where the claim is about one.
    at: Option<Vec<f64>>,
    output: Option<&'static str>,
    measure: Measure,
    statistic: Statistic,
    bound: f64,
    printed: &'static str,
    cases: u64,
}

const KEYS: [&str; 15] = [
    "id",
    "place",
    "claims",
    "note",
    "study",
    "solver",
    "region",
    "part",
    "at",
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

const VERDICTS: [(&str, Held); 5] = [
    ("holds", Held::AsFarAsSearched),
    ("in part", Held::InPart),
    ("refuted", Held::Refuted),
    ("open", Held::Open),
    ("not testable", Held::NotTestable),
];

/// Points that the regions of a claim share, unless it says how many, and the largest number.
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

fn test(reading: &mut Reading, node: &Node, bound: &Node) -> Result<Test, StudyError> {
    let number = rational(bound)?.to_f64();
    if !(number > 0.0 && number.is_finite()) {
        return Err(bound.fault("a bound is a positive number"));
    }
    let solver = required(node, "solver")?;
    let known = reading.solver(solver.text()?);
    let study = match (known, node.get("study")) {
        (Some(study), None) => study,
        _ => {
            let study = reading.study(required(node, "study")?)?;
            let chosen = study.with_solver(solver.text()?);
            chosen.map_err(|e| e.at(solver.place))?
        }
    };
    let part = |key: &str| node.get(key).map(|n| n.text().map(intern)).transpose();
    let output = part("output")?;
    let at = node.get("at").map(|at| point(&study, at)).transpose()?;
    let mut studies = Vec::new();
    for region in texts(node.get("region"))? {
        let within = study.within(Some(region.text()?), &[]);
        studies.push(within.map_err(|e| e.at(region.place))?);
    }
    if studies.is_empty() {
        studies.push(study.clone());
    }
    let part = node.get("part");
    let part = part.map(|part| narrowed(&studies, part)).transpose()?;
    if let (Some(output), Some(at)) = (output, node.get("output")) {
        let study = &studies[0];
        selected_outputs(study, &[output]).map_err(|e| at.fault(e.to_string()))?;
    }
    let cases = node
        .get("cases")
        .map_or(Ok(CASES), |n| count(n, MOST_CASES))?;
    Ok(Test {
        part,
        at,
        output,
        measure: word(node.get("measure"), &MEASURES, Measure::Relative)?,
        statistic: word(node.get("statistic"), &STATISTICS, Statistic::Largest)?,
        bound: number,
        printed: intern(bound.text()?),
        cases: u64::from(cases).div_ceil(studies.len() as u64).max(1),
        studies,
    })
}

/// The input that a claim is about: a number for each input of the study.
fn point(study: &Study, node: &Node) -> Result<Vec<f64>, StudyError> {
    let inputs = &study.problem().inputs;
    let names: Vec<&str> = inputs.iter().map(|i| i.name.as_str()).collect();
    node.only(&names)?;
    let number = |name: &&str| -> Result<f64, StudyError> {
        Ok(nearest_f64(&rational(required(node, name)?)?))
    };
    names.iter().map(number).collect()
}

/// The studies over a part: inputs with nearer ends. A region without a point of it is left out.
fn narrowed(studies: &[Study], node: &Node) -> Result<(Vec<Study>, String), StudyError> {
    let mut words = Vec::new();
    let mut all = Vec::new();
    for study in studies {
        let own = &study.problem().inputs;
        let names: Vec<&str> = own.iter().map(|i| i.name.as_str()).collect();
        node.only(&names)?;
        let mut inputs: Vec<StudyInput> = Vec::new();
        words.clear();
        for own in own {
            let Some(item) = node.get(&own.name) else {
                continue;
            };
            item.only(&["from", "to"])?;
            let stated = input(&own.name, item)?;
            for (key, sign) in [("from", ">="), ("to", "<=")] {
                if let Some(end) = item.get(key) {
                    words.push(format!("{} {sign} {}", own.name, end.text()?));
                }
            }
            inputs.push(StudyInput {
                from: stated.from.into_iter().chain(own.from.clone()).max(),
                to: stated.to.into_iter().chain(own.to.clone()).min(),
                ..own.clone()
            });
        }
        let is_empty = |i: &StudyInput| i.from.as_ref().zip(i.to.as_ref()).is_some_and(|e| e.0 > e.1);
        if !inputs.iter().any(is_empty) {
            all.push(study.within(None, &inputs).map_err(|e| e.at(node.place))?);
        }
    }
    match all.is_empty() {
        true => Err(node.fault("no region of the claim has a point of this part")),
        false => Ok((all, words.join(", "))),
    }
}

/// The findings of a test.
struct Found {
    held: Held,
    /// The largest error in units of the bound.
    size: f64,
    /// The largest error, or the mean, in words.
    error: String,
    /// The input with the largest error, with what the solver gave and what is due there.
    at: Vec<Figure>,
    points: u64,
}

impl Found {
    /// The order of findings: what is refuted is worse than what is open, and that than what holds.
    fn rank(&self) -> (u8, f64) {
        let held = match self.held {
            Held::Refuted => 2,
            Held::Open => 1,
            _ => 0,
        };
        (held, self.size)
    }
}

/// A mean of errors, and four standard errors: by the central limit theorem the interval misses the mean once in 16000
/// samples; where a few points carry the mean it may miss it more often.
fn mean(errors: &[f64]) -> [f64; 2] {
    let n = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / n;
    let squares: f64 = errors.iter().map(|e| (e - mean) * (e - mean)).sum();
    [mean, 4.0 * (squares / (n - 1.0).max(1.0) / n).sqrt()]
}

impl Accuracy {
    /// Decides the claim.
    pub(super) fn finding(&self) -> Finding {
        let found = self.test.as_ref().map(|test| match test.statistic {
            Statistic::Largest => test.largest(),
            Statistic::Mean => test.mean(),
        });
        let part = self.test.as_ref().and_then(|test| test.part.as_ref());
        let held = found.as_ref().map_or(Held::NotTestable, |f| f.held);
        let (verdict, word) = match held {
            Held::AsFarAsSearched => (FindingVerdict::Confirmed, "Holds as far as searched."),
            Held::InPart => (FindingVerdict::Refuted, "Holds in part alone."),
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
            figures.extend(found.at.iter().cloned());
            if let (Held::InPart, Some((_, words))) = (held, part) {
                figures.push(figure("holds where", words, "1"));
            }
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
    /// A study with its solver, judged by a limit.
    fn variant<'a>(&self, study: &'a Study, limit: f64) -> Option<Variant<'a>> {
        let variant = Variant::new(study);
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

    fn judged(method: &dyn Method, input: &[f64]) -> CaseReport {
        let case = Case {
            method: method.name(),
            region: "given",
            input: input.to_vec(),
            origin: Origin::Given,
        };
        judge_case_briefly(method, case, method.solve(input), &Settings::default())
    }

    /// The error at an input in units of the limit, and whether it certainly is over it.
    fn share(method: &dyn Method, input: &[f64]) -> (f64, bool) {
        let judgement = Test::judged(method, input).judgement;
        let over = matches!(judgement.verdict, Judged::Over | Judged::WrongKind);
        (judgement.share(), over)
    }

    /// The largest error that an audit and a hunt find, in the part that the claim names as well where it is refuted.
    fn largest(&self) -> Found {
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
            let worst = if b.rank() > a.rank() { b } else { a };
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
        let climbed = hunt(&variant, &hunted, &|_| ());
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
        let exact: Option<Vec<_>> = input.iter().map(|x| rug::Rational::from_f64(*x)).collect();
        let due = exact.map_or_else(Vec::new, |exact| study.digits(&exact, 12));
        if let crate::audit::SolverAnswer::Values(got) = study.solve(input) {
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
    fn mean(&self) -> Found {
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
        // Without a sample, or with an error that is no number, the mean is none, and the claim is open.
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

#[cfg(test)]
mod tests;

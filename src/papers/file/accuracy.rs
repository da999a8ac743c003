//! Claims about the accuracy of algorithms: a solver, a region, a measure and a bound, tested by an
//! audit and a hunt.

mod search;

use super::claim::Statement;
use super::program::Asked;
use super::read::{Reading, count, only, required, texts, word};
use crate::audit::selected_outputs;
use crate::papers::{Finding, FindingVerdict, figure};
use crate::reference::nearest_f64;
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, StudyInput, input, intern, rational};
use std::sync::Arc;

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

/// The verdict on a claim, the worst last.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd)]
pub enum Held {
    /// It states no bound.
    NotTestable,
    /// At every point tried, or the interval of the mean is below the bound.
    AsFarAsSearched,
    /// Refuted in the region, but at every point tried of a part that the claim names.
    InPart,
    /// The reference could not tell, or the interval of the mean holds the bound.
    Open,
    /// At a point that is named it certainly does not hold, or the interval of the mean is above
    /// the bound.
    Refuted,
}

impl Held {
    fn words(self) -> (FindingVerdict, &'static str) {
        use FindingVerdict::{Confirmed, Refuted, Unexplained};
        match self {
            Held::AsFarAsSearched => (Confirmed, "Holds as far as searched."),
            Held::InPart => (Refuted, "Holds in part alone."),
            Held::Refuted => (Refuted, "Refuted."),
            Held::Open => (
                Unexplained,
                "Open: the reference or the sample could not tell.",
            ),
            Held::NotTestable => (Unexplained, "Not testable: no bound is stated."),
        }
    }
}

/// A claim about an algorithm.
#[derive(Clone, Debug)]
pub struct Accuracy {
    /// Its statement.
    pub statement: Statement,
    /// The verdict on record.
    pub expected: Held,
    test: Option<Test>,
}

/// The evidence that decides a claim.
#[derive(Clone, Debug)]
struct Test {
    /// The study over each region of the claim.
    studies: Vec<Study>,
    /// The program under test, where it is no formula of the studies.
    program: Option<Arc<Asked>>,
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

const KEYS: &str = "id place claims note study solver region part at output measure statistic \
                    bound cases verdict";

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

/// Reads a claim; without a bound it is not testable.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Accuracy, StudyError> {
    only(node, KEYS)?;
    let statement = Statement::read(reading, node)?;
    let test = node
        .get("bound")
        .map(|bound| test(reading, node, bound))
        .transpose()?;
    let expected = word(node.get("verdict"), &VERDICTS, Held::AsFarAsSearched)?;
    if test.is_none() != (expected == Held::NotTestable) {
        return Err(node.fault("a claim has a bound, or the verdict \"not testable\""));
    }
    Ok(Accuracy {
        statement,
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
    let (study, program) = match (known, node.get("study")) {
        (Some(known), None) => (known.study.clone(), known.program.clone()),
        _ => {
            let study = reading.study(required(node, "study")?)?;
            let chosen = study.with_solver(solver.text()?);
            (chosen.map_err(|e| e.at(solver.place))?, None)
        }
    };
    let output = node.get("output").map(|n| n.text().map(intern));
    let output = output.transpose()?;
    let at = node.get("at").map(|at| point(&study, at)).transpose()?;
    let mut studies = Vec::new();
    for region in texts(node.get("region")) {
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
        program,
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
        let is_empty = |i: &StudyInput| {
            i.from
                .as_ref()
                .zip(i.to.as_ref())
                .is_some_and(|e| e.0 > e.1)
        };
        if !inputs.iter().any(is_empty) {
            all.push(study.within(None, &inputs).map_err(|e| e.at(node.place))?);
        }
    }
    match all.is_empty() {
        true => Err(node.fault("no region of the claim has a point of this part")),
        false => Ok((all, words.join(", "))),
    }
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
        let (verdict, words) = held.words();
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
        let as_recorded = held == self.expected;
        self.statement.finding(verdict, words, figures, as_recorded)
    }
}

#[cfg(test)]
mod tests;

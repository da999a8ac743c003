//! The findings of a proof on its parts: rectangles of W's, boxes of the domain of a study.

use super::deal::Stride;
use super::plan::Part;
use crate::audit::hex_float;
use crate::proof::program::{Interval, Limits, Measure, Program, parts, prove};
use crate::proof::{
    Bound, Certificate, Code, Leaf, ProofError, Rectangle, UPPER_HALF_PLANE, Watch,
    first_rectangles, on_rectangle,
};
use crate::study::Study;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};

/// Boxes without a bound that are kept.
const OPEN: usize = 20;
/// Parts of the domain of a study, and boxes for each bound on one of them: together as many as
/// sixteen proofs of the program `prove` look at.
const PARTS: usize = 256;
const BOXES: u64 = 1_250;

/// The ends of every input, by their bits.
type Ends = Vec<[u64; 2]>;

fn ends(at: &Rectangle) -> Ends {
    vec![at.a.map(f64::to_bits), at.b.map(f64::to_bits)]
}

/// Returns an object of a value for each name.
fn named<T>(names: &[String], all: &[T], of: impl Fn(&T) -> Value) -> Value {
    Value::Object(names.iter().cloned().zip(all.iter().map(of)).collect())
}

fn shown(names: &[String], at: &Ends) -> Value {
    named(names, at, |x| {
        json!(x.map(|x| hex_float(f64::from_bits(x))))
    })
}

/// The largest bound, and the first rectangle where it is attained.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Attained {
    /// The complement of the bound's bits, so that the largest comes first; bounds are not
    /// negative.
    order: u64,
    at: Ends,
}

impl Attained {
    fn new(bound: f64, at: &Ends) -> Attained {
        Attained {
            order: !bound.to_bits(),
            at: at.clone(),
        }
    }

    /// The bound; infinite where a rectangle has none.
    pub fn bound(&self) -> f64 {
        f64::from_bits(!self.order)
    }

    fn add(&mut self, other: &Attained) {
        if other < self {
            self.clone_from(other);
        }
    }

    fn json(&self, names: &[String]) -> Value {
        json!({ "bound": finite(self.bound()), "box": shown(names, &self.at) })
    }
}

/// Nothing for what no number says.
fn finite(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

/// The bounds proved by one formula of W's, or of one output of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OfFormula {
    /// Boxes.
    pub boxes: u64,
    /// In the order of the measures of the tally.
    pub bounds: Vec<Attained>,
}

/// Counts and the largest bounds; adding is exact, in any order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ProofTally {
    /// The names of inputs and of measures; none of nothing.
    inputs: Vec<String>,
    measures: Vec<String>,
    /// Parts that were proved apart.
    pub parts: u64,
    /// Boxes without a bound.
    pub open: u64,
    /// The first of them, and why.
    first_open: Vec<(Ends, String)>,
    formulas: BTreeMap<String, OfFormula>,
}

/// The inputs of W, and the bounds that its proof has: of the norm in units of 2⁻⁵², of both parts
/// in units in their last places, and in addition in units of 2⁻¹⁰⁷⁵, where a part may be below
/// 2⁻⁹⁶⁰.
const OF_W: ([&str; 2], [&str; 4]) = (["re", "im"], ["norm", "re", "im", "tiny"]);
const MEASURES: [(&str, Measure); 3] = [
    ("absolute", Measure::Absolute),
    ("relative", Measure::Relative),
    ("ulps", Measure::Ulps),
];

impl ProofTally {
    fn of_part(inputs: &[&str], measures: &[&str]) -> ProofTally {
        let words = |all: &[&str]| all.iter().map(|s| s.to_string()).collect();
        ProofTally {
            inputs: words(inputs),
            measures: words(measures),
            parts: 1,
            ..ProofTally::default()
        }
    }

    fn of(found: &Certificate) -> ProofTally {
        let mut tally = ProofTally::of_part(&OF_W.0, &OF_W.1);
        for Leaf { at, formula, bound } in &found.leaves {
            let Bound { norm, re, im, tiny } = *bound;
            let bounds = [norm, re, im, tiny].map(|x| Attained::new(x, &ends(at)));
            let (boxes, bounds) = (1, bounds.to_vec());
            tally.add_formula(formula.name().into(), OfFormula { boxes, bounds });
        }
        tally.open = found.open.len() as u64;
        let open = found.open.iter().map(|o| (ends(&o.at), o.why.into()));
        tally.first_open = open.collect();
        tally.cut();
        tally
    }

    /// The bounds of every output over a part of a study's domain.
    fn of_study(study: &OfStudy, at: &[Interval]) -> ProofTally {
        let inputs: Vec<&str> = study.inputs.iter().map(String::as_str).collect();
        let mut tally = ProofTally::of_part(&inputs, &MEASURES.map(|m| m.0));
        let bits = |at: &[Interval]| -> Ends {
            at.iter().map(|x| [x.lo, x.hi].map(f64::to_bits)).collect()
        };
        let limits = Limits {
            boxes: BOXES,
            target: 0.0,
        };
        for (name, program) in &study.outputs {
            let part = program.within(at.to_vec());
            let (mut boxes, mut bounds) = (0, Vec::new());
            for (_, measure) in MEASURES {
                let found = prove(&part, measure, &limits, &Watch::default());
                let found = found.expect("nobody stops it");
                boxes += found.boxes.len() as u64;
                let place = found.at.as_ref().map_or(at, |b| &b.at);
                if measure == Measure::Absolute && found.proved().is_none() {
                    let why = found.at.as_ref().and_then(|b| b.why);
                    tally.open += 1;
                    tally
                        .first_open
                        .push((bits(place), why.unwrap_or("the limit ended it").into()));
                }
                bounds.push(Attained::new(found.bound, &bits(place)));
            }
            tally.add_formula(name.clone(), OfFormula { boxes, bounds });
        }
        tally
    }

    fn add_formula(&mut self, name: String, more: OfFormula) {
        match self.formulas.get_mut(&name) {
            None => drop(self.formulas.insert(name, more)),
            Some(own) => {
                own.boxes += more.boxes;
                own.bounds
                    .iter_mut()
                    .zip(&more.bounds)
                    .for_each(|(own, more)| own.add(more));
            }
        }
    }

    fn cut(&mut self) {
        self.first_open.sort();
        self.first_open.truncate(OPEN);
    }

    /// Adds what was found on other parts.
    pub fn merge(&mut self, other: ProofTally) {
        if self.parts == 0 {
            (self.inputs, self.measures) = (other.inputs, other.measures);
        }
        self.parts += other.parts;
        self.open += other.open;
        self.first_open.extend(other.first_open);
        self.cut();
        for (name, more) in other.formulas {
            self.add_formula(name, more);
        }
    }

    /// Each formula, by its name.
    pub fn formulas(&self) -> impl Iterator<Item = (&str, &OfFormula)> {
        self.formulas.iter().map(|(name, f)| (name.as_str(), f))
    }

    /// Boxes with a bound.
    pub fn boxes(&self) -> u64 {
        self.formulas.values().map(|f| f.boxes).sum()
    }

    /// The names of the measures that a table shows.
    pub fn measures(&self) -> impl Iterator<Item = &str> {
        self.measures
            .iter()
            .map(String::as_str)
            .filter(|m| *m != "tiny")
    }

    /// The largest bound of a measure.
    fn most(&self, measure: usize) -> Option<&Attained> {
        self.formulas
            .values()
            .filter_map(|f| f.bounds.get(measure))
            .min()
    }

    /// The largest bound of a measure over all formulas; 0 of nothing.
    pub fn bound(&self, measure: &str) -> f64 {
        let place = self.measures.iter().position(|m| m == measure);
        place
            .and_then(|k| self.most(k))
            .map_or(0.0, Attained::bound)
    }

    /// All of it. Bounds of what underflows in W have no box.
    pub fn json(&self) -> Value {
        let names = &self.inputs;
        let formulas = self.formulas.iter().map(|(name, f)| {
            let mut v = json!({ "formula": name, "boxes": f.boxes });
            for (measure, bound) in self.measures.iter().zip(&f.bounds) {
                v[measure] = match measure.as_str() {
                    "tiny" => json!(bound.bound()),
                    _ => bound.json(names),
                };
            }
            v
        });
        let formulas: Vec<Value> = formulas.collect();
        let open = self.first_open.iter();
        let open = open.map(|(at, why)| json!({ "box": shown(names, at), "why": why }));
        let open: Vec<Value> = open.collect();
        let most = |k: usize| self.most(k).map(|a| a.json(names));
        let component = [1, 2].into_iter().filter_map(|k| self.most(k)).min();
        let mut v = match self.measures.first().map(String::as_str) {
            Some("absolute") => {
                json!({ "absolute": most(0), "relative": most(1), "ulps": most(2) })
            }
            _ => json!({
                "function": "faddeeva",
                "part": "upper",
                "rectangles": self.parts,
                "norm": most(0),
                "component": component.map(|a| a.json(names)),
                "tiny": self.most(3).map(Attained::bound),
            }),
        };
        for (key, value) in [
            ("passed", json!(self.open == 0)),
            ("proved", json!(self.open == 0)),
            ("parts", json!(self.parts)),
            ("boxes", json!(self.boxes())),
            ("formulas", json!(formulas)),
            ("open", json!(self.open)),
            ("first_open", json!(open)),
        ] {
            v[key] = value;
        }
        v
    }
}

/// The outputs of a study as programs of the proof, and parts of its domain.
pub struct OfStudy {
    inputs: Vec<String>,
    outputs: Vec<(String, Program)>,
    parts: Vec<Vec<Interval>>,
}

/// The units of a proof.
pub enum Units {
    /// Rectangles of the closed upper half-plane, for W.
    Rectangles(Vec<Rectangle>),
    /// Parts of the domain of a study.
    Study(OfStudy),
}

impl Units {
    /// The units of a part of a plan.
    ///
    /// # Errors
    /// A method without such a proof, and nothing within the limit.
    pub fn of(part: &Part) -> Result<Units, String> {
        let method = &part.method;
        if !crate::study::is_path(method) {
            if method != "faddeeva" {
                return Err(format!(
                    "a proof that is cut into parts is of faddeeva or of a study, not of {method}"
                ));
            }
            let all = first_rectangles(part.within);
            return match all.is_empty() {
                true => Err(format!(
                    "no rectangle lies within {}",
                    part.within.unwrap_or(0.0)
                )),
                false => Ok(Units::Rectangles(all)),
            };
        }
        let study = Study::open(method).map_err(|e| e.to_string())?;
        let problem = study.problem();
        let solver = problem
            .solvers
            .first()
            .ok_or("the study has no solver that rounds to one format, binary64 or binary32")?;
        let outputs = problem.outputs.iter().enumerate().map(|(k, output)| {
            let program = problem.program(solver, &[k], solver.setting(), part.within);
            let named = program.map(|p| (output.name.clone(), p));
            named.map_err(|e| e.to_string())
        });
        let outputs = outputs.collect::<Result<Vec<_>, String>>()?;
        let (_, first) = outputs.first().ok_or("the study has no output")?;
        Ok(Units::Study(OfStudy {
            inputs: problem.inputs.iter().map(|i| i.name.clone()).collect(),
            parts: parts(first, PARTS),
            outputs,
        }))
    }

    /// Returns the number of them.
    pub fn count(&self) -> usize {
        match self {
            Units::Rectangles(all) => all.len(),
            Units::Study(study) => study.parts.len(),
        }
    }

    /// Proves what can be proved on some of them, by their places; what is found after `stop` is
    /// set means nothing.
    fn prove(
        &self,
        places: Vec<usize>,
        progress: &(dyn Fn(u64) + Sync),
        stop: &AtomicBool,
    ) -> Result<Vec<ProofTally>, ProofError> {
        let code = match self {
            Units::Rectangles(_) if !places.is_empty() => Some(Code::of_the_solver()?),
            _ => None,
        };
        let watch = Watch::default();
        let found = places.into_par_iter().with_max_len(1).map(|k| {
            if stop.load(Ordering::Relaxed) {
                watch.stop.store(true, Ordering::Relaxed);
                return ProofTally::default();
            }
            let found = match (self, &code) {
                (Units::Study(study), _) => Some(ProofTally::of_study(study, &study.parts[k])),
                (Units::Rectangles(all), Some(code)) => {
                    let found = on_rectangle(code, UPPER_HALF_PLANE, &watch, all[k]);
                    found.map(|f| ProofTally::of(&f))
                }
                _ => None,
            };
            progress(1);
            found.unwrap_or_default()
        });
        Ok(found.collect())
    }
}

/// Proves what can be proved on some of the units, on the threads of the pool that this runs in;
/// what is found after `stop` is set means nothing.
///
/// # Errors
/// A part without units, and if the reference is undecided about a coefficient of the solver's
/// tables.
pub fn of(
    part: &Part,
    stride: Stride,
    progress: &(dyn Fn(u64) + Sync),
    stop: &AtomicBool,
) -> Result<ProofTally, ProofError> {
    let mut sum = ProofTally::default();
    if stride.is_empty() {
        return Ok(sum);
    }
    let units = Units::of(part).map_err(ProofError::Fails)?;
    let places = (0..stride.len()).map(|j| stride.at(j) as usize).collect();
    for more in units.prove(places, progress, stop)? {
        sum.merge(more);
    }
    Ok(sum)
}

/// The bounds on two of the units, bit for bit, so that another prover is noticed.
pub fn probe(part: &Part) -> String {
    let found = Units::of(part).and_then(|units| {
        let some = vec![0, units.count() / 3];
        let found = units.prove(some, &|_| {}, &AtomicBool::new(false));
        Ok((units.count(), found.map_err(|e| e.to_string())?))
    });
    match found {
        Ok((count, found)) => format!("{count} {found:?}\n"),
        Err(why) => why,
    }
}

#[cfg(test)]
mod tests;

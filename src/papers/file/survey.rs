//! Surveys of solvers: how near to zero of an input each keeps an accuracy, how far its values jump
//! where one formula takes over from another, and what follows for whoever has to choose.

use super::read::{Reading, Solver, count, only, required, text, texts};
use crate::audit::{Case, Cases, Judge, Limit, Method, Origin, Settings, SolverAnswer, Variant};
use crate::papers::{Figure, Finding, FindingVerdict, Subject, figure};
use crate::study::document::Item as Node;
use crate::study::{Study, StudyError, StudyInput, intern, rational};
use rayon::prelude::*;
use rug::Rational;
use rug::ops::Pow;

/// A survey of the solvers of one study.
#[derive(Clone, Debug)]
pub struct Survey {
    id: &'static str,
    place: &'static str,
    /// The study over the region, without a solver, and its text with the region's name.
    study: Study,
    text: String,
    /// The input whose powers of ten are the heights.
    along: StudyInput,
    /// Relative errors, as written and as numbers.
    targets: Vec<(&'static str, f64)>,
    /// Heights from which on the advice names solvers, in addition to all heights.
    floors: Vec<(&'static str, f64)>,
    cases: u64,
    solvers: Vec<Solver>,
    /// The heights of solvers on record.
    recorded: Option<Vec<(&'static str, &'static str)>>,
}

const KEYS: &str = "id place study region along targets floors cases solvers recorded";

/// Points in each region of each band, unless the survey says how many, and the largest number.
const CASES: u32 = 30;
const MOST_CASES: u32 = 10_000;
const SEED: u64 = 1;
/// The lowest power of ten above zero.
const LOWEST: i32 = -20;
/// The relative limit that errors are measured by: no answer is off by exactly that much by an
/// accident that happens, as zero for a value is by 1.
const WHOLE: f64 = 3.0;
/// Jumps that are not larger are rounding.
const LEAST: f64 = 1e-14;

/// Reads a survey.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Survey, StudyError> {
    only(node, KEYS)?;
    let id = reading.id(node)?;
    let file = required(node, "study")?;
    let region = node.get("region").map(Node::text).transpose()?;
    let definition = reading.source.read(file.text()?);
    let definition = definition.map_err(|e| e.at(file.place))?;
    let study = reading.study(file)?;
    let study = study.within(region, &[]).map_err(|e| e.at(node.place))?;
    let along = required(node, "along")?;
    let name = along.text()?;
    let found = study.problem().inputs.iter().find(|i| i.name == name);
    let Some(input) = found.cloned() else {
        return Err(along.fault(format!("there is no input {name}")));
    };
    let zero = Rational::new();
    if !(input.from.as_ref().is_some_and(|x| *x >= zero) && input.to.is_some()) {
        let reason = format!("the range of {name} begins at zero or above, and ends");
        return Err(along.fault(reason));
    }
    let numbers = |key: &str| -> Result<Vec<(&'static str, f64)>, StudyError> {
        let mut all = Vec::new();
        for n in texts(node.get(key)) {
            match rational(n)?.to_f64() {
                x if x > 0.0 && x.is_finite() => all.push((intern(n.text()?), x)),
                _ => return Err(n.fault(format!("{key} are positive numbers"))),
            }
        }
        Ok(all)
    };
    let file = file.text()?;
    let mut solvers = Vec::new();
    for solver in reading.solvers.iter().filter(|s| s.file == file) {
        let study = solver.study.within(region, &[]);
        solvers.push(Solver {
            study: study.map_err(|e| e.at(node.place))?,
            ..solver.clone()
        });
    }
    if let Some(names) = node.get("solvers") {
        let all = std::mem::take(&mut solvers);
        for name in names.list()? {
            let text = name.text()?;
            let found = all.iter().find(|s| s.name == text);
            let none = || name.fault("there is no such solver of this study above");
            solvers.push(found.cloned().ok_or_else(none)?);
        }
    }
    let recorded = match node.get("recorded") {
        None => None,
        Some(node) => {
            let mut entries = Vec::new();
            for (name, value) in node.table()? {
                entries.push((intern(name), intern(value.text()?)));
            }
            Some(entries)
        }
    };
    let cases = node
        .get("cases")
        .map_or(Ok(CASES), |n| count(n, MOST_CASES))?;
    let survey = Survey {
        id,
        place: text(node, "place")?,
        study,
        text: format!("{definition}\n{}", region.unwrap_or_default()),
        along: input,
        targets: numbers("targets")?,
        floors: numbers("floors")?,
        cases: u64::from(cases.max(1)),
        solvers,
        recorded,
    };
    if survey.solvers.is_empty() || survey.targets.is_empty() {
        return Err(node.fault("a survey has targets, and solvers of its study stand above it"));
    }
    Ok(survey)
}

/// The measures of an error.
const MEASURES: [&str; 2] = ["of the norm", "of each output"];

/// The largest errors of a solver in the bands, from below, by [`MEASURES`].
struct Heights {
    name: &'static str,
    bands: Vec<[f64; 2]>,
}

impl Survey {
    /// Takes the solvers of another survey in, if it is one of the same function for the same
    /// needs; returns false otherwise.
    pub(in crate::papers) fn join(&mut self, other: &Survey) -> bool {
        let same = self.text == other.text
            && self.along.name == other.along.name
            && (&self.targets, &self.floors) == (&other.targets, &other.floors)
            && (self.cases, self.recorded.is_some()) == (other.cases, other.recorded.is_some());
        if same {
            self.solvers.extend(other.solvers.iter().cloned());
            if let (Some(all), Some(more)) = (&mut self.recorded, &other.recorded) {
                all.extend(more);
            }
        }
        same
    }

    /// The exponents of the bands' lower ends; the first band begins where the range does.
    fn powers(&self) -> std::ops::Range<i32> {
        let exponent = |q: &Option<Rational>| q.as_ref().map_or(0.0, Rational::to_f64).log10();
        let whole = |x: f64| x.clamp(f64::from(LOWEST) - 1.0, 308.0) as i32;
        let first = whole(exponent(&self.along.from).floor());
        first..whole(exponent(&self.along.to).ceil()).max(first + 1)
    }

    /// The study over the band that begins at a power of ten.
    fn band(&self, k: i32) -> Option<Study> {
        let powers = self.powers();
        let ten = |k: i32| Rational::from(10).pow(k);
        let inside = StudyInput {
            from: match k == powers.start {
                true => self.along.from.clone(),
                false => Some(ten(k)),
            },
            to: match k + 1 == powers.end {
                true => self.along.to.clone(),
                false => Some(ten(k + 1)),
            },
            ..self.along.clone()
        };
        self.study.within(None, &[inside]).ok()
    }

    fn heights(&self) -> Vec<Heights> {
        let rows = self.solvers.iter();
        let mut rows: Vec<Heights> = rows
            .map(|s| Heights {
                name: s.name,
                bands: Vec::new(),
            })
            .collect();
        let settings = Settings {
            seed: SEED,
            cases_per_region: self.cases,
            ..Settings::default()
        };
        for k in self.powers() {
            let worst = self.band(k).map(|band| {
                let variant = Variant::new(&band).limit(Limit::Relative(WHOLE));
                let cases = Cases::new(&variant, &settings);
                for solver in &self.solvers {
                    if let Some(program) = &solver.program {
                        let inputs = (0..cases.len()).map(|i| cases.get(i).input);
                        program.answers(&solver.study, &inputs.collect::<Vec<_>>());
                    }
                }
                let all = (0..cases.len()).into_par_iter();
                let found = all.map(|i| self.errors(&variant, &cases.get(i).input));
                let none = || vec![[0.0; 2]; self.solvers.len()];
                found.reduce(none, |a, b| {
                    let pairs = a.iter().zip(&b);
                    pairs
                        .map(|(a, b)| [a[0].max(b[0]), a[1].max(b[1])])
                        .collect()
                })
            });
            let worst = worst.unwrap_or_else(|| vec![[f64::INFINITY; 2]; rows.len()]);
            for (row, worst) in rows.iter_mut().zip(worst) {
                row.bands.push(worst);
            }
        }
        rows
    }

    /// The relative errors of all solvers at an input, infinite where they cannot be measured.
    fn errors(&self, variant: &dyn Method, input: &[f64]) -> Vec<[f64; 2]> {
        let settings = Settings::default();
        let unit = 2f64.powi(-(variant.format().precision() as i32));
        let judge = Judge::new(variant, &settings);
        let mut referee = judge.referee(Case {
            method: variant.name(),
            region: "given",
            input: input.to_vec(),
            origin: Origin::Given,
        });
        let error = |solver: &Solver| {
            let judgement = referee.judge(solver.solve(input), false).judgement;
            if !judgement.is_measured() {
                return [f64::INFINITY; 2];
            }
            let parts = judgement.components.iter().map(|c| c.of_budget * WHOLE);
            let found = [judgement.normwise * unit, parts.fold(0.0, f64::max)];
            found.map(|x| if x.is_nan() { f64::INFINITY } else { x })
        };
        self.solvers.iter().map(error).collect()
    }

    /// The power of ten from which on a target is met at every point tried by a measure: the
    /// infinite ones if it is everywhere or nowhere.
    fn height(&self, row: &Heights, of: usize, target: f64) -> f64 {
        let good = row.bands.iter().rev();
        match good.take_while(|b| b[of] <= target).count() {
            0 => f64::INFINITY,
            n if n == row.bands.len() => f64::NEG_INFINITY,
            n => f64::from(self.powers().end - n as i32),
        }
    }

    /// The findings: heights, jumps, and what meets each need.
    pub(in crate::papers) fn findings(&self) -> Vec<Finding> {
        let rows = self.heights();
        let name = &self.along.name;
        let finding = |part: &str, title: String, text: &str, figures, as_recorded| Finding {
            id: match part {
                "" => self.id,
                part => intern(&format!("{}-{part}", self.id)),
            },
            subject: Subject::Claim,
            place: self.place,
            title,
            verdict: FindingVerdict::Recovered,
            text: text.into(),
            figures,
            as_recorded,
        };
        let heights: Vec<Figure> = rows.iter().map(|row| self.words(row)).collect();
        let as_recorded = self.recorded.as_ref().is_none_or(|on_record| {
            let found = heights.iter().map(|f| (f.name.as_str(), f.value.as_str()));
            found.eq(on_record.iter().copied())
        });
        let title = format!("The power of ten of {name} from which each solver keeps an accuracy");
        let text = "Relative errors at every point tried, of the norm of all outputs and then of each output.";
        let heights = finding("", title, text, heights, as_recorded);
        let title =
            "The largest jump of each solver between neighbouring inputs with different formulas";
        let text = "Conditions of the solver are followed to the neighbouring numbers between which they flip; the \
                    jump is that of the norm, relative.";
        let jumps = self.solvers.par_iter();
        let jumps = jumps.filter_map(|solver| self.jump(solver)).collect();
        let seams = finding("seams", title.into(), text, jumps, true);
        let (title, text) = (
            "The solvers that meet a need",
            "Of the solvers of this survey, at every point tried.",
        );
        let advice = finding("advice", title.into(), text, self.advice(&rows), true);
        vec![heights, seams, advice]
    }

    fn words(&self, row: &Heights) -> Figure {
        let targets = self.targets.iter().map(|(target, number)| {
            let heights = [0, 1].map(|of| match self.height(row, of, *number) {
                f64::NEG_INFINITY => "everywhere".to_string(),
                f64::INFINITY => "nowhere".into(),
                k => format!("1e{k}"),
            });
            format!("{target}: {}", heights.join(", "))
        });
        figure(row.name, targets.collect::<Vec<_>>().join("; "), "1")
    }

    /// The solvers that meet each need, or, where that is shorter, those that do not.
    fn advice(&self, rows: &[Heights]) -> Vec<Figure> {
        let name = &self.along.name;
        let mut all = Vec::new();
        for (target, number) in &self.targets {
            for (words, floor) in std::iter::once((None, f64::NEG_INFINITY))
                .chain(self.floors.iter().map(|f| (Some(f.0), f.1.log10())))
            {
                for (of, measure) in MEASURES.into_iter().enumerate() {
                    let meets = |row: &&Heights| self.height(row, of, *number) <= floor + 1e-9;
                    let (good, bad): (Vec<&Heights>, Vec<_>) = rows.iter().partition(meets);
                    let names =
                        |of: &[&Heights]| of.iter().map(|r| r.name).collect::<Vec<_>>().join(", ");
                    let value = match (good.len(), bad.len()) {
                        (0, _) => "none".into(),
                        (_, 0) => "all".into(),
                        (n, m) if m < n => format!("all but {}", names(&bad)),
                        _ => names(&good),
                    };
                    let domain = match words {
                        None => format!("every {name}"),
                        Some(floor) => format!("{name} >= {floor}"),
                    };
                    all.push(figure(format!("{target} {measure}, {domain}"), value, "1"));
                }
            }
        }
        all
    }

    /// The largest jump of a solver, where there is one that is not rounding.
    fn jump(&self, solver: &Solver) -> Option<Figure> {
        if solver.program.is_some() {
            return None;
        }
        let mut largest: Option<(f64, Vec<f64>)> = None;
        for [a, b] in solver.study.seams() {
            let values = |input: &[f64]| match solver.solve(input) {
                SolverAnswer::Values(values) => Some(values),
                _ => None,
            };
            let size = match (values(&a), values(&b)) {
                (Some(v), Some(w)) => {
                    let norm =
                        |x: &mut dyn Iterator<Item = f64>| x.fold(0.0, |sum: f64, x| sum.hypot(x));
                    let change = norm(&mut v.iter().zip(&w).map(|(v, w)| v - w));
                    let of = norm(&mut v.iter().copied());
                    if change == 0.0 { 0.0 } else { change / of }
                }
                _ => f64::INFINITY,
            };
            let size = if size.is_nan() { f64::INFINITY } else { size };
            if size > LEAST && largest.as_ref().is_none_or(|l| size > l.0) {
                largest = Some((size, a));
            }
        }
        let (size, at) = largest?;
        let inputs = self.study.problem().inputs.iter().zip(&at);
        let at: Vec<String> = inputs.map(|(i, x)| format!("{} = {x:?}", i.name)).collect();
        Some(figure(
            solver.name,
            format!("{size:.1e} at {}", at.join(", ")),
            "1",
        ))
    }
}

#[cfg(test)]
mod tests;

//! Cases of a method, and the judge. Python calls the callable; nothing here does.

use crate::certified::{Component, component, evaluable_method, uncertified, values_of};
use crate::errors::value_error;
use crate::facts::{proof, report_facts};
use crate::pool::pool;
use mechaudit::audit::{
    CandidateReport, Case, CaseReport, Cases, Format, Judge, Layout, Limit, Method, MethodReport,
    Near, Origin, ReferenceAnswer, Reproduce, SampleBox, Sampling, Settings, SolverAnswer, Tally,
    Uncertified, Variant, Verdict, answer_of,
};
use mechaudit::methods::Evaluable;
use mechaudit::reference::{Ball, HexFloat};
use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;

/// Cases of each region that a page shows with all their errors.
const POINTS: usize = 64;

/// The outcome of a callable at a case.
#[derive(FromPyObject)]
pub enum Answer {
    /// It returned these numbers.
    #[pyo3(transparent)]
    Values(Vec<f64>),
    /// It refused, with or without a word; or it failed, and how.
    #[pyo3(transparent)]
    Other((bool, Option<String>)),
}

impl From<Answer> for SolverAnswer {
    fn from(answer: Answer) -> SolverAnswer {
        match answer {
            Answer::Values(values) => SolverAnswer::Values(values),
            Answer::Other((true, word)) => SolverAnswer::Declines(word),
            Answer::Other((false, why)) => SolverAnswer::Fails(why.unwrap_or_default()),
        }
    }
}

/// Which cases.
enum Choice {
    /// Drawn: those of the method's sampling.
    Drawn,
    /// Inputs.
    Given(Vec<Vec<f64>>),
    /// One.
    Single(Box<Case>),
}

/// The cases of a run and what was found so far.
#[pyclass(module = "mechaudit._mechaudit")]
pub struct Run {
    method: &'static dyn Evaluable,
    scope: Scope,
    cases: Cases,
    choice: Choice,
    settings: Settings,
    tally: Option<Tally>,
    report: Option<MethodReport>,
}

/// The settings of a run and its budget, each optional.
#[derive(Default, FromPyObject)]
#[pyo3(from_item_all)]
pub struct Scope {
    #[pyo3(default)]
    outputs: Option<Vec<String>>,
    limits: BTreeMap<String, f64>,
    #[pyo3(default)]
    single: bool,
    #[pyo3(default)]
    regions: Vec<String>,
    #[pyo3(default)]
    ordinary: bool,
    #[pyo3(default)]
    sides: Option<String>,
    #[pyo3(default)]
    near: Option<(String, f64)>,
}

fn given(word: &str, value: &str, rule: &str) -> PyErr {
    PyValueError::new_err(format!("{word}: {rule}, got {value:?}"))
}

/// The limit for each output that is asked for, if one is.
fn limit(limits: &BTreeMap<String, f64>) -> PyResult<Option<Limit>> {
    for (kind, k) in limits {
        if !(k.is_finite() && *k > 0.0) {
            let rule = "a budget is finite and positive";
            return Err(PyValueError::new_err(format!("{kind}: {rule}, got {k}")));
        }
    }
    let limit = |kind: &str| limits.get(kind).copied();
    let outputs: Vec<&str> = limits.keys().map(String::as_str).collect();
    let outputs: Vec<&str> = outputs.into_iter().filter(|k| *k != "normwise").collect();
    Ok(match outputs.as_slice() {
        [] => None,
        ["ulps"] => limit("ulps").map(Limit::Ulps),
        ["conditioned"] => limit("conditioned").map(Limit::Conditioned),
        ["relative"] => limit("relative").map(Limit::Relative),
        ["absolute"] => limit("absolute").map(Limit::Absolute),
        ["absolute", "relative"] => limit("relative")
            .zip(limit("absolute"))
            .map(|(r, a)| Limit::RelativeOrAbsolute(r, a)),
        several => {
            return Err(PyValueError::new_err(format!(
                "{} exclude each other: a budget is ulps, conditioned, or relative and absolute",
                several.join(" and ")
            )));
        }
    })
}

impl Scope {
    /// Returns the rest of the place of a case: how its run draws.
    fn tail(&self) -> String {
        let mut tail = String::new();
        if self.single {
            tail.push_str(" --single");
        }
        if self.sides.is_some() {
            // Inputs that the box does not name are drawn from the regions, one after the other.
            tail.extend(self.regions.iter().map(|r| format!(" --region {r}")));
            tail.push_str(if self.ordinary { " --ordinary" } else { "" });
        }
        tail
    }

    /// The method as it is asked for.
    fn variant(
        &self,
        method: &'static dyn Evaluable,
        settings: &Settings,
    ) -> PyResult<Variant<'static>> {
        let mut variant = Variant::new(method).without_laws();
        if let Some(names) = &self.outputs {
            variant = variant.outputs(names).map_err(value_error)?;
        }
        if self.single {
            variant = variant.format(Format::Single);
        }
        if let Some(limit) = limit(&self.limits)? {
            variant = variant.limit(limit);
        }
        if let Some(r) = self.limits.get("normwise") {
            variant = variant.norm_limit(*r);
        }
        for name in &self.regions {
            variant = variant.region(name).map_err(value_error)?;
        }
        if self.ordinary {
            variant = variant.ordinary();
        }
        if let Some(text) = &self.sides {
            let sides = SampleBox::read(&variant, text).map_err(value_error)?;
            variant = variant.sampling(Sampling::Box(sides));
        }
        if let Some((text, radius)) = &self.near {
            let near = Near::read(&variant, settings, text, *radius).map_err(value_error)?;
            variant = variant.sampling(Sampling::Near(near));
        }
        Ok(variant)
    }
}

/// Reads the place of a case, written like the arguments of `mechaudit audit` that choose it: how
/// its run draws, and which it is.
fn place(words: &[String], settings: &mut Settings) -> PyResult<(Scope, BTreeMap<String, String>)> {
    const VALUED: [&str; 9] = [
        "--region",
        "--seed",
        "--case",
        "--check-point",
        "--hard-case",
        "--at",
        "--box",
        "--near",
        "--radius",
    ];
    let whole = words.join(" ");
    let bad = |rule: &str| given("place", &whole, rule);
    let (mut scope, mut found) = (Scope::default(), BTreeMap::new());
    let mut words = words.iter();
    while let Some(flag) = words.next() {
        match flag.as_str() {
            "--single" => scope.single = true,
            "--ordinary" => scope.ordinary = true,
            flag if VALUED.contains(&flag) => {
                let value = words
                    .next()
                    .ok_or_else(|| bad(&format!("{flag} needs a value")))?;
                match flag {
                    "--region" => scope.regions.push(value.clone()),
                    "--box" => scope.sides = Some(value.clone()),
                    _ => {
                        found.insert(flag.to_string(), value.clone());
                    }
                }
            }
            _ => {
                let known = VALUED.join(", ");
                let rule = format!("a case is chosen by {known}, --ordinary or --single");
                return Err(bad(&rule));
            }
        }
    }
    if let Some(seed) = found.get("--seed") {
        settings.seed = seed.parse().map_err(|_| bad("--seed is a number"))?;
    }
    if let Some(text) = found.remove("--near") {
        let radius = found.get("--radius").and_then(|r| r.parse().ok());
        let radius = radius.ok_or_else(|| bad("--near needs a --radius, a number"))?;
        scope.near = Some((text, radius));
    }
    Ok((scope, found))
}

/// The case that the rest of a place names.
fn named(
    method: &dyn Method,
    cases: &Cases,
    scope: &Scope,
    found: &BTreeMap<String, String>,
) -> PyResult<Case> {
    let number = |flag: &str| {
        let text = found.get(flag);
        let read = text.map(|t| t.parse::<u64>());
        let rule = "is a number";
        read.transpose().map_err(|_| given("place", flag, rule))
    };
    let case = if let Some(name) = found.get("--check-point") {
        cases.at_check_point(name)
    } else if let Some(n) = number("--hard-case")? {
        cases.hard_case(usize::try_from(n).unwrap_or(usize::MAX))
    } else if let Some(numbers) = found.get("--at") {
        let input = numbers.split(',').map(|t| {
            let hex = HexFloat::parse(t).ok().map(|x| x.to_f64());
            hex.or_else(|| t.parse().ok())
        });
        let input: Option<Vec<f64>> = input.collect();
        let input = input.ok_or_else(|| given("place", numbers, "--at takes numbers"))?;
        return of_input(method, input);
    } else if let Some(index) = number("--case")? {
        match (cases.at_index(index), scope.regions.as_slice()) {
            (Some(case), _) => Ok(case),
            (None, [region]) => cases.in_region(region, index),
            (None, _) => {
                return Err(given(
                    "place",
                    "--case",
                    "of one --region, a --box or --near",
                ));
            }
        }
    } else {
        let rule = "a case is a --check-point, a --hard-case, an --at, or a --case of a --region, \
                    a --box or --near";
        return Err(given("place", "", rule));
    };
    case.map_err(value_error)
}

fn of_input(method: &dyn Method, input: Vec<f64>) -> PyResult<Case> {
    Layout::new(method).lengths(&input).map_err(value_error)?;
    Ok(Case {
        method: method.name(),
        region: "given",
        input,
        origin: Origin::Given,
    })
}

impl Run {
    fn variant(&self) -> PyResult<Variant<'static>> {
        self.scope.variant(self.method, &self.settings)
    }

    fn count(&self) -> usize {
        match &self.choice {
            Choice::Drawn => self.cases.len(),
            Choice::Given(all) => all.len(),
            Choice::Single(_) => 1,
        }
    }

    fn checked(&self, i: usize) -> PyResult<usize> {
        match self.count() {
            n if i < n => Ok(i),
            n => Err(PyValueError::new_err(format!(
                "case: there are {n}, not {i}"
            ))),
        }
    }

    fn case(&self, i: usize) -> Case {
        match &self.choice {
            Choice::Drawn => self.cases.get(i),
            Choice::Given(all) => Case {
                method: self.method.name(),
                region: "given",
                input: all[i].clone(),
                origin: Origin::Line {
                    number: i as u64 + 1,
                },
            },
            Choice::Single(case) => (**case).clone(),
        }
    }

    /// Judges answers to the cases from `start` on.
    fn judge_all(
        &mut self,
        py: Python<'_>,
        start: usize,
        answers: Vec<SolverAnswer>,
    ) -> PyResult<Vec<bool>> {
        let end = start
            .checked_add(answers.len())
            .filter(|end| *end <= self.count());
        let Some(end) = end else {
            return Err(PyValueError::new_err("more answers than cases"));
        };
        let here = &*self;
        let variant = here.variant()?;
        let judge = Judge::new(&variant, &here.settings);
        let threads = pool()?;
        let judged: Vec<CaseReport> = py.detach(|| {
            threads.install(|| {
                (start..end)
                    .into_par_iter()
                    .zip(answers)
                    .map(|(i, answer)| judge.judge(here.case(i), answer, false))
                    .collect()
            })
        });
        let tally = self
            .tally
            .get_or_insert_with(|| Tally::new(&variant, &self.settings));
        let passed = judged.iter().map(|report| {
            tally.add(report);
            report.judgement.verdict == Verdict::Pass
        });
        Ok(passed.collect())
    }
}

#[pymethods]
impl Run {
    #[new]
    #[pyo3(signature = (method, *, seed=1, cases=1, scope=None, given=None, place=None))]
    fn new(
        method: &str,
        seed: u64,
        cases: u64,
        scope: Option<Scope>,
        given: Option<Vec<Vec<f64>>>,
        place: Option<Vec<String>>,
    ) -> PyResult<Run> {
        let method = evaluable_method(method)?;
        let mut settings = Settings {
            seed,
            cases_per_region: cases,
            points: POINTS,
            ..Settings::default()
        };
        let mut scope = scope.unwrap_or_default();
        let mut found = None;
        if let Some(words) = &place {
            let (drawn, rest) = self::place(words, &mut settings)?;
            scope = Scope {
                outputs: scope.outputs,
                limits: scope.limits,
                ..drawn
            };
            found = Some(rest);
        }
        let variant = scope.variant(method, &settings)?;
        let cases = Cases::new(&variant, &settings);
        let choice = match (found, given) {
            (Some(rest), _) => Choice::Single(Box::new(named(&variant, &cases, &scope, &rest)?)),
            (None, Some(inputs)) => {
                let layout = Layout::new(method);
                for x in &inputs {
                    layout.lengths(x).map_err(value_error)?;
                }
                Choice::Given(inputs)
            }
            (None, None) => Choice::Drawn,
        };
        Ok(Run {
            method,
            scope,
            cases,
            choice,
            settings,
            tally: None,
            report: None,
        })
    }

    fn __len__(&self) -> usize {
        self.count()
    }

    /// The inputs of cases, one a row; they have to be of one length.
    fn block<'py>(
        &self,
        py: Python<'py>,
        start: usize,
        end: usize,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let end = end.min(self.count());
        let start = start.min(end);
        let inputs: Vec<Vec<f64>> =
            py.detach(|| (start..end).map(|i| self.case(i).input).collect());
        let width = inputs.first().map_or(0, Vec::len);
        let flat: Vec<f64> = inputs.iter().flatten().copied().collect();
        let all = Array2::from_shape_vec((inputs.len(), width), flat);
        Ok(all.map_err(value_error)?.to_pyarray(py))
    }

    /// The input of a case, and how many numbers belong to each part of its layout.
    fn input<'py>(
        &self,
        py: Python<'py>,
        i: usize,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, Vec<usize>)> {
        let input = self.case(self.checked(i)?).input;
        let lengths = Layout::new(self.method)
            .lengths(&input)
            .map_err(value_error)?;
        Ok((input.to_pyarray(py), lengths))
    }

    /// Returns the answer of the method's own solver at a case; nothing if it refuses.
    fn own(&self, i: usize) -> PyResult<Option<Vec<f64>>> {
        let case = self.case(self.checked(i)?);
        Ok(match answer_of(&self.variant()?, &case.input) {
            SolverAnswer::Values(values) => Some(values),
            _ => None,
        })
    }

    /// The region and the place of a case.
    fn place(&self, i: usize) -> PyResult<(&'static str, String)> {
        let case = self.case(self.checked(i)?);
        Ok((
            case.region,
            format!("{}{}", case.place(), self.scope.tail()),
        ))
    }

    /// Judges one row of values for each case from `start` on; which passed.
    fn judge_block(
        &mut self,
        py: Python<'_>,
        start: usize,
        values: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<Vec<bool>> {
        let rows = values.as_array();
        let answers = rows
            .outer_iter()
            .map(|row| SolverAnswer::Values(row.to_vec()))
            .collect();
        self.judge_all(py, start, answers)
    }

    /// Judges what a callable did at each case from `start` on; which passed.
    fn judge(&mut self, py: Python<'_>, start: usize, answers: Vec<Answer>) -> PyResult<Vec<bool>> {
        let answers = answers.into_iter().map(SolverAnswer::from).collect();
        self.judge_all(py, start, answers)
    }

    /// Judges the method's own solver at the cases from `start` to `end`; which passed.
    fn judge_own(&mut self, py: Python<'_>, start: usize, end: usize) -> PyResult<Vec<bool>> {
        let end = end.min(self.count());
        let (here, variant) = (&*self, self.variant()?);
        let threads = pool()?;
        let answers = py.detach(|| {
            threads.install(|| {
                let cases = (start.min(end)..end).into_par_iter();
                cases
                    .map(|i| answer_of(&variant, &here.case(i).input))
                    .collect()
            })
        });
        self.judge_all(py, start.min(end), answers)
    }

    /// Returns the findings for the callable of that name; `trouble` beside its answers makes it
    /// fail.
    #[pyo3(signature = (interrupted, name=None))]
    fn finish<'py>(
        &mut self,
        py: Python<'py>,
        interrupted: bool,
        name: Option<String>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let (variant, tail) = (self.variant()?, self.scope.tail());
        let tally = self.tally.take();
        let mut tally = tally.unwrap_or_else(|| Tally::new(&variant, &self.settings));
        if interrupted {
            tally.interrupt();
        }
        let mut report = py.detach(|| tally.finish(&variant));
        report.reproduce = Reproduce {
            head: format!("mechaudit.case({:?}, \"", report.method),
            tail: format!("{tail}\")"),
        };
        report.candidate = name.map(|name| CandidateReport {
            name,
            answered: report.cases,
            ..CandidateReport::default()
        });
        let facts = report_facts(py, &report, &tail)?;
        self.report = Some(report);
        Ok(facts)
    }

    /// Returns the findings as a page that needs nothing from elsewhere: that of `mechaudit audit
    /// --format html`.
    fn page(&self) -> PyResult<String> {
        match &self.report {
            Some(report) => {
                let all = std::slice::from_ref(report);
                Ok(mechaudit_cli::report::html::audit::page(
                    all,
                    None,
                    None,
                    report.interrupted,
                ))
            }
            None => Err(PyValueError::new_err("the run is not finished")),
        }
    }

    /// Certified values of a case, with their proof.
    fn due(
        &self,
        py: Python<'_>,
        i: usize,
        digits: u32,
    ) -> PyResult<(Vec<Component>, Option<String>)> {
        let case = self.case(self.checked(i)?);
        let exact: Option<Vec<Rational>> =
            case.input.iter().map(|x| Rational::from_f64(*x)).collect();
        let Some(exact) = exact else {
            return Err(crate::errors::DomainError::new_err(
                "the input is not finite",
            ));
        };
        let found = py.detach(|| {
            // Where no numbers are due, `certify` may call the refusal undecided.
            let (due, why) = match self.method.reference(&exact, 128) {
                ReferenceAnswer::Values(r) => (Some(r.values), Some(r.proof)),
                ReferenceAnswer::Expected(expected, p) => {
                    let numbers = expected.iter().map(|d| d.number().cloned()).collect();
                    match numbers {
                        Some(numbers) => (Some(numbers), Some(p)),
                        None => return Err(Uncertified::NoNumber),
                    }
                }
                ReferenceAnswer::Refuses(word) => return Err(Uncertified::Refused(word)),
                _ => (None, None),
            };
            let known: Option<Vec<Ball>> = due;
            match known.filter(|balls| balls.iter().all(|b| b.rad().is_zero())) {
                Some(balls) => Ok((
                    balls
                        .into_iter()
                        .map(|b| component(&b.into(), digits))
                        .collect(),
                    why,
                )),
                None => Ok((values_of(self.method, &exact, digits)?, why)),
            }
        });
        let (values, why) = found.map_err(|e| uncertified(e, 0))?;
        Ok((values, proof(why)))
    }
}

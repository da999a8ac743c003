//! Cases of a method, and the judge. Python calls the callable; nothing here does.

use crate::certified::{Component, component, evaluable_method, uncertified, values_of};
use crate::errors::value_error;
use crate::facts::{case_facts, proof, statistics};
use crate::pool::pool;
use mechaudit::audit::{
    Case, CaseReport, Cases, Draw, Layout, Limit, Origin, ReferenceAnswer, Settings, SolverAnswer,
    Tally, Uncertified, Variant, Verdict, answer_of, judge_case, judge_case_briefly,
};
use mechaudit::methods::Evaluable;
use mechaudit::reference::{Ball, HexFloat};
use numpy::ndarray::Array2;
use numpy::{PyArray1, PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use rayon::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;

/// Worst cases kept of each region.
const WORST: usize = 10;
/// The name of what was drawn from a box.
const BOX: &str = "box";

/// What a callable did at a case.
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

/// An interval of an input, and whether it is sampled logarithmically.
type Interval = (usize, f64, f64, bool);

/// Which cases.
enum Choice {
    /// Regions, and the named cases if all are chosen.
    Regions { names: Vec<String>, named: bool },
    /// Drawn from intervals; inputs without one come from the regions in turn.
    Box(Vec<Interval>),
    /// Inputs.
    Given(Vec<Vec<f64>>),
    /// One.
    Single(Box<Case>),
}

/// The cases of a run and what was found so far.
#[pyclass(module = "mechaudit._mechaudit")]
pub struct Run {
    method: &'static dyn Evaluable,
    cases: Cases,
    choice: Choice,
    settings: Settings,
    outputs: Option<Vec<String>>,
    limit: Option<Limit>,
    tally: Option<Tally>,
    worst: BTreeMap<&'static str, Vec<(f64, Case, SolverAnswer)>>,
}

fn given(word: &str, value: &str, rule: &str) -> PyErr {
    PyValueError::new_err(format!("{word}: {rule}, got {value:?}"))
}

/// Reads the place of a case, written like the arguments of `mechaudit audit` that choose it.
fn single(method: &'static dyn Evaluable, place: &str, settings: &mut Settings) -> PyResult<Case> {
    let mut found: BTreeMap<&str, &str> = BTreeMap::new();
    let mut words = place.split_whitespace();
    while let Some(flag) = words.next() {
        let known = [
            "--region",
            "--seed",
            "--case",
            "--check-point",
            "--hard-case",
            "--at",
        ];
        if !known.contains(&flag) {
            let rule = format!("a case is chosen by {}", known.join(", "));
            return Err(given("place", place, &rule));
        }
        let value = words.next();
        found.insert(
            flag,
            value.ok_or_else(|| given("place", place, &format!("{flag} needs a value")))?,
        );
    }
    let number = |flag: &str| -> PyResult<Option<u64>> {
        let text = found.get(flag);
        let read = text.map(|t| {
            t.parse()
                .map_err(|_| given("place", place, &format!("{flag} is a number")))
        });
        read.transpose()
    };
    if let Some(seed) = number("--seed")? {
        settings.seed = seed;
    }
    let cases = Cases::new(method, settings);
    let case = if let Some(name) = found.get("--check-point") {
        cases.at_check_point(name)
    } else if let Some(n) = number("--hard-case")? {
        cases.hard_case(n as usize)
    } else if let Some(numbers) = found.get("--at") {
        let input = numbers.split(',').map(|t| {
            let hex = HexFloat::parse(t).ok().map(|x| x.to_f64());
            hex.or_else(|| t.parse().ok())
        });
        let input: Option<Vec<f64>> = input.collect();
        let input = input.ok_or_else(|| given("place", place, "--at takes numbers"))?;
        return of_input(method, input);
    } else if let (Some(region), Some(index)) = (found.get("--region"), number("--case")?) {
        cases.in_region(region, index)
    } else {
        let rule = "a case is a --check-point, a --hard-case, an --at, or a --case of a --region";
        return Err(given("place", place, rule));
    };
    case.map_err(value_error)
}

fn of_input(method: &dyn Evaluable, input: Vec<f64>) -> PyResult<Case> {
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
        let mut variant = Variant::new(self.method).without_laws();
        if let Some(names) = &self.outputs {
            variant = variant.outputs(names).map_err(value_error)?;
        }
        if let Some(limit) = self.limit {
            variant = variant.limit(limit);
        }
        Ok(variant)
    }

    fn count(&self) -> usize {
        let per_region = self.settings.cases_per_region as usize;
        match &self.choice {
            Choice::Regions { named: true, .. } => self.cases.len(),
            Choice::Regions { names, .. } => names.len().saturating_mul(per_region),
            Choice::Box(_) => per_region,
            Choice::Given(all) => all.len(),
            Choice::Single(_) => 1,
        }
    }

    fn case(&self, i: usize) -> Case {
        let per_region = self.settings.cases_per_region;
        match &self.choice {
            Choice::Regions { named: true, .. } => self.cases.get(i),
            Choice::Regions { names, .. } => {
                let (region, index) = (i as u64 / per_region, i as u64 % per_region);
                self.cases
                    .in_region(&names[region as usize], index)
                    .expect("regions are checked when they are chosen")
            }
            Choice::Box(intervals) => self.boxed(intervals, i as u64),
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

    /// A case of the regions in turn, with some inputs from their intervals.
    fn boxed(&self, intervals: &[Interval], i: u64) -> Case {
        let regions = self.method.domain().regions;
        let mut draw = Draw::new(self.settings.seed, self.method.name(), BOX, i);
        let region = &regions[(i % regions.len() as u64) as usize];
        let mut input = (region.sample)(&mut draw);
        for &(k, low, high, logarithmic) in intervals {
            if let Some(x) = input.get_mut(k) {
                *x = match logarithmic {
                    false => draw.uniform(low, high),
                    true if low < 0.0 => -draw.log_uniform(-high, -low),
                    true => draw.log_uniform(low, high),
                };
            }
        }
        Case {
            method: self.method.name(),
            region: BOX,
            input,
            origin: Origin::Given,
        }
    }

    fn add(&mut self, variant: &Variant<'_>, report: CaseReport) -> bool {
        let passed = report.judgement.verdict == Verdict::Pass;
        let region = report.case.region;
        let shares = report.judgement.components.iter().map(|c| c.of_budget);
        let whole = report.judgement.components.is_empty() && !passed;
        let share = shares.fold(if whole { f64::INFINITY } else { 0.0 }, |a, b| {
            // What is not a number is the worst of all.
            if b.is_nan() { f64::INFINITY } else { a.max(b) }
        });
        let worst = self.worst.entry(region).or_default();
        if worst.len() < WORST || worst.last().is_some_and(|w| share > w.0) {
            let at = worst.partition_point(|w| w.0 >= share);
            let answer = report.answer.clone();
            let answer = answer.unwrap_or(SolverAnswer::Declines(None));
            worst.insert(at, (share, report.case.clone(), answer));
            worst.truncate(WORST);
        }
        let settings = &self.settings;
        let tally = self
            .tally
            .get_or_insert_with(|| Tally::new(variant, settings));
        tally.add(&report);
        passed
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
        let variant = self.variant()?;
        let (here, settings) = (&*self, &self.settings);
        let threads = pool()?;
        let judged: Vec<CaseReport> = py.detach(|| {
            threads.install(|| {
                (start..end)
                    .into_par_iter()
                    .zip(answers)
                    .map(|(i, answer)| judge_case_briefly(&variant, here.case(i), answer, settings))
                    .collect()
            })
        });
        let passed = judged.into_iter().map(|r| self.add(&variant, r));
        Ok(passed.collect())
    }
}

#[pymethods]
impl Run {
    #[new]
    #[pyo3(signature = (method, *, seed, cases, regions=None, intervals=None, given=None, place=None, outputs=None, limit=None, named=true))]
    #[expect(clippy::too_many_arguments, reason = "Python names each")]
    fn new(
        method: &str,
        seed: u64,
        cases: u64,
        regions: Option<Vec<String>>,
        intervals: Option<Vec<Interval>>,
        given: Option<Vec<Vec<f64>>>,
        place: Option<&str>,
        outputs: Option<Vec<String>>,
        limit: Option<(String, f64)>,
        named: bool,
    ) -> PyResult<Run> {
        let method = evaluable_method(method)?;
        let mut settings = Settings {
            seed,
            cases_per_region: cases,
            ..Settings::default()
        };
        let all_regions = || {
            method
                .domain()
                .regions
                .iter()
                .map(|r| r.name.into())
                .collect()
        };
        let choice = if let Some(place) = place {
            Choice::Single(Box::new(single(method, place, &mut settings)?))
        } else if let Some(inputs) = given {
            let layout = Layout::new(method);
            for x in &inputs {
                layout.lengths(x).map_err(value_error)?;
            }
            Choice::Given(inputs)
        } else if let Some(intervals) = intervals {
            Choice::Box(intervals)
        } else {
            let named = named && regions.is_none();
            Choice::Regions {
                names: regions.unwrap_or_else(all_regions),
                named,
            }
        };
        let limit = limit.map(|(kind, k)| match kind.as_str() {
            _ if !(k.is_finite() && k > 0.0) => Err(PyValueError::new_err(format!(
                "{kind}: a budget is finite and positive, got {k}"
            ))),
            "ulps" => Ok(Limit::Ulps(k)),
            "conditioned" => Ok(Limit::Conditioned(k)),
            "normwise" => Ok(Limit::Normwise(k)),
            _ => Err(PyValueError::new_err(format!(
                "limit: a budget is in ulps, conditioned or normwise, not {kind:?}"
            ))),
        });
        let run = Run {
            cases: Cases::new(method, &settings),
            method,
            choice,
            settings,
            outputs,
            limit: limit.transpose()?,
            tally: None,
            worst: BTreeMap::new(),
        };
        run.variant()?;
        if let Choice::Regions { names, .. } = &run.choice {
            for name in names {
                run.cases.in_region(name, 0).map_err(value_error)?;
            }
        }
        Ok(run)
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
        if i >= self.count() {
            return Err(PyValueError::new_err(format!(
                "case: there are {}, not {i}",
                self.count()
            )));
        }
        let input = self.case(i).input;
        let lengths = Layout::new(self.method)
            .lengths(&input)
            .map_err(value_error)?;
        Ok((input.to_pyarray(py), lengths))
    }

    /// What the method's own solver gives at a case; nothing if it refuses.
    fn own(&self, i: usize) -> PyResult<Option<Vec<f64>>> {
        if i >= self.count() {
            return Err(PyValueError::new_err(format!(
                "case: there are {}, not {i}",
                self.count()
            )));
        }
        Ok(match answer_of(&self.variant()?, &self.case(i).input) {
            SolverAnswer::Values(values) => Some(values),
            _ => None,
        })
    }

    /// The region and the place of a case.
    fn place(&self, i: usize) -> PyResult<(&'static str, String)> {
        match i < self.count() {
            true => {
                let case = self.case(i);
                Ok((case.region, case.place()))
            }
            false => Err(PyValueError::new_err(format!(
                "case: there are {}, not {i}",
                self.count()
            ))),
        }
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
        let variant = self.variant()?;
        let here = &*self;
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

    /// What was found.
    fn finish<'py>(&mut self, py: Python<'py>, interrupted: bool) -> PyResult<Bound<'py, PyDict>> {
        let variant = self.variant()?;
        let settings = &self.settings;
        let tally = self.tally.take();
        let mut tally = tally.unwrap_or_else(|| Tally::new(&variant, settings));
        if interrupted {
            tally.interrupt();
        }
        let report = tally.finish(&variant);
        let d = statistics(py, &report.total)?;
        d.set_item("method", report.method)?;
        d.set_item("summary", report.summary)?;
        d.set_item("source", report.source)?;
        d.set_item("seed", settings.seed)?;
        d.set_item("cases_per_region", settings.cases_per_region)?;
        d.set_item("interrupted", report.interrupted)?;
        d.set_item("within_budget", report.passed())?;
        let budgets: Vec<(&str, String, &str)> = (report.budgets.iter())
            .map(|o| (o.name, o.budget.limit.to_string(), o.budget.reason))
            .collect();
        d.set_item("budgets", budgets)?;
        let norm = report.norm_budget;
        d.set_item("norm_budget", norm.map(|n| (n.to_string(), n.reason)))?;
        let regions = PyDict::new(py);
        for region in &report.regions {
            regions.set_item(region.name, statistics(py, region)?)?;
        }
        d.set_item("regions", regions)?;
        let failures = PyList::empty(py);
        for failure in &report.failures {
            failures.append(case_facts(py, failure)?)?;
        }
        d.set_item("failures", failures)?;
        d.set_item("failures_left_out", report.failures_left_out)?;
        let worst = PyList::empty(py);
        for (share, case, answer) in std::mem::take(&mut self.worst).into_values().flatten() {
            let judged = py.detach(|| judge_case(&variant, case, answer, &self.settings));
            let facts = case_facts(py, &judged)?;
            facts.set_item("share", share)?;
            worst.append(facts)?;
        }
        d.set_item("worst", worst)?;
        Ok(d)
    }

    /// Certified values of a case, with their proof.
    fn due(
        &self,
        py: Python<'_>,
        i: usize,
        digits: u32,
    ) -> PyResult<(Vec<Component>, Option<String>)> {
        if i >= self.count() {
            return Err(PyValueError::new_err(format!(
                "case: there are {}, not {i}",
                self.count()
            )));
        }
        let case = self.case(i);
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
                ReferenceAnswer::Dues(dues, p) => {
                    let numbers = dues.iter().map(|d| d.number().cloned()).collect();
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

//! Reports, cases and methods as plain Python data.

use crate::certified::evaluable_method;
use mechaudit::audit::{
    CaseReport, Layout, MethodReport, Proof, RegionReport, SolverAnswer, Spread,
};
use mechaudit::methods::{self, Evaluable};
use mechaudit_cli::report::words::audit::of_case;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::fmt::Display;

fn spread<'py>(py: Python<'py>, s: &Spread) -> PyResult<Bound<'py, PyDict>> {
    let d = PyDict::new(py);
    d.set_item("count", s.count)?;
    d.set_item("beyond", s.beyond)?;
    d.set_item("max", s.max)?;
    d.set_item("p99", s.p99)?;
    d.set_item("median", s.median)?;
    d.set_item("rms", s.rms)?;
    Ok(d)
}

pub fn proof(proof: Option<Proof>) -> Option<String> {
    proof.map(|p| match p {
        Proof::Exact => "exact".into(),
        Proof::Bounded(why) => why.into(),
    })
}

/// Returns the findings of a region, or of all.
pub fn statistics<'py>(py: Python<'py>, r: &RegionReport) -> PyResult<Bound<'py, PyDict>> {
    let d = PyDict::new(py);
    d.set_item("description", r.description)?;
    d.set_item("cases", r.cases)?;
    d.set_item("passed", r.passed)?;
    d.set_item("recorded", r.recorded)?;
    d.set_item("over", r.over)?;
    d.set_item("undecided", r.undecided)?;
    d.set_item("wrong_kind", r.kinds.total())?;
    let normwise = r.normwise.as_ref().map(|s| spread(py, s)).transpose()?;
    d.set_item("normwise_u", normwise)?;
    let outputs = PyList::empty(py);
    for o in &r.outputs {
        let one = PyDict::new(py);
        one.set_item("name", o.name)?;
        one.set_item("values", o.values)?;
        one.set_item("wrong_kind", o.kinds.total())?;
        one.set_item("ulps", spread(py, &o.ulps)?)?;
        one.set_item("conditioned_u", spread(py, &o.conditioned)?)?;
        one.set_item("max_of_budget", o.max_of_budget)?;
        one.set_item("max_condition", o.max_condition)?;
        let octaves: Vec<_> = o.histogram.iter().map(|o| (o.exponent, o.count)).collect();
        one.set_item("histogram", octaves)?;
        outputs.append(one)?;
    }
    d.set_item("outputs", outputs)?;
    Ok(d)
}

/// A report; `tail` is what else the place of a case needs.
pub fn report_facts<'py>(
    py: Python<'py>,
    report: &MethodReport,
    tail: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let d = statistics(py, &report.total)?;
    d.set_item("method", report.method)?;
    d.set_item("summary", report.summary)?;
    d.set_item("source", report.source)?;
    d.set_item("seed", report.settings.seed)?;
    d.set_item("cases_per_region", report.settings.cases_per_region)?;
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
    let cases = |all: &[CaseReport]| {
        let list = PyList::empty(py);
        for case in all {
            list.append(case_facts(py, case, tail)?)?;
        }
        Ok::<_, PyErr>(list)
    };
    d.set_item("failures", cases(&report.failures)?)?;
    d.set_item("failures_left_out", report.failures_left_out)?;
    let wrong = report.wrong.iter();
    let unlike = |r: &&CaseReport| !r.judgement.is_measured();
    let worst: Vec<CaseReport> = report
        .worst
        .iter()
        .chain(wrong.filter(unlike))
        .cloned()
        .collect();
    d.set_item("worst", cases(&worst)?)?;
    Ok(d)
}

/// Everything about a judged case.
fn case_facts<'py>(py: Python<'py>, r: &CaseReport, tail: &str) -> PyResult<Bound<'py, PyDict>> {
    let d = PyDict::new(py);
    let text = |e: &dyn Display| e.to_string();
    d.set_item("method", r.case.method)?;
    d.set_item("region", r.case.region)?;
    d.set_item("place", format!("{}{tail}", r.case.place()))?;
    d.set_item("share", r.judgement.share())?;
    d.set_item("input", r.case.input.clone())?;
    match &r.answer {
        Some(SolverAnswer::Values(v)) => d.set_item("got", v.clone())?,
        Some(SolverAnswer::Fails(why)) => d.set_item("got", why)?,
        Some(refusal) => {
            let why = refusal.refusal().unwrap_or("no reason");
            d.set_item("got", text(&format_args!("refused: {why}")))?;
        }
        None => d.set_item("got", py.None())?,
    }
    d.set_item("due", r.reference.clone())?;
    d.set_item("radius", r.radii.clone())?;
    d.set_item("verdict", of_case(r.judgement.verdict).0)?;
    d.set_item("reason", r.judgement.why())?;
    let c = &r.judgement.components;
    d.set_item("outputs", c.iter().map(|c| c.output).collect::<Vec<_>>())?;
    d.set_item("ulps", c.iter().map(|c| c.ulps).collect::<Vec<_>>())?;
    d.set_item(
        "of_budget",
        c.iter().map(|c| c.of_budget).collect::<Vec<_>>(),
    )?;
    d.set_item(
        "condition",
        c.iter().map(|c| c.condition).collect::<Vec<_>>(),
    )?;
    d.set_item("bits", r.bits)?;
    d.set_item("proof", proof(r.proof))?;
    Ok(d)
}

/// Returns name, summary, source, inputs, outputs, regions and check points of each method.
#[pyfunction]
#[pyo3(name = "methods")]
pub fn all_methods(py: Python<'_>) -> PyResult<Bound<'_, PyList>> {
    let all = PyList::empty(py);
    for m in methods::registry() {
        all.append(method_facts(py, &*m)?)?;
    }
    Ok(all)
}

/// The same of one method or study.
#[pyfunction]
pub fn method<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyDict>> {
    method_facts(py, evaluable_method(name)?)
}

fn method_facts<'py>(py: Python<'py>, m: &dyn Evaluable) -> PyResult<Bound<'py, PyDict>> {
    let layout = Layout::new(m);
    let domain = m.domain();
    let d = PyDict::new(py);
    d.set_item("name", m.name())?;
    d.set_item("summary", m.summary())?;
    d.set_item("source", m.source())?;
    let inputs: Vec<_> = m.inputs().iter().map(|i| (i.name, i.unit)).collect();
    d.set_item("inputs", inputs)?;
    let outputs: Vec<_> = m.outputs().iter().map(|o| (o.name, o.unit)).collect();
    d.set_item("outputs", outputs)?;
    let budgets = m.outputs().into_iter();
    let budgets: Vec<_> = budgets
        .map(|o| (o.name, o.budget.limit.to_string(), o.budget.reason))
        .collect();
    d.set_item("budgets", budgets)?;
    d.set_item(
        "fixed",
        (0..layout.parts()).all(|p| layout.is_single(p)) && m.rows().is_none(),
    )?;
    d.set_item("input", layout.input())?;
    d.set_item("answer", layout.answer())?;
    let regions: Vec<_> = domain
        .regions
        .iter()
        .map(|r| (r.name, r.description))
        .collect();
    d.set_item("regions", regions)?;
    let points: Vec<_> = domain.check_points.iter().map(|p| p.name).collect();
    d.set_item("check_points", points)?;
    Ok(d)
}

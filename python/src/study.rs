//! Studies: problems that users bring as formulas or files.

use crate::certified::{Fraction, rational};
use crate::errors::value_error;
use mechaudit::methods::Evaluable;
use mechaudit::study::{Study, StudyError, is_path};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::sync::{Mutex, PoisonError};

/// Studies by their keys, and keys by the names in reports. They stay to the end of the process, as
/// runs borrow them; the same text is kept once.
#[derive(Default)]
struct Kept {
    studies: BTreeMap<String, &'static Study>,
    names: BTreeMap<String, String>,
}

static KEPT: Mutex<Option<Kept>> = Mutex::new(None);

fn with<T>(f: impl FnOnce(&mut Kept) -> T) -> T {
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    f(kept.get_or_insert_default())
}

/// A key for the texts that make a study.
fn key(parts: impl Hash) -> String {
    let mut hasher = DefaultHasher::new();
    parts.hash(&mut hasher);
    format!("study-{:016x}", hasher.finish())
}

/// Keeps a study that is not kept yet.
fn keep(
    key: String,
    name: &str,
    make: impl FnOnce() -> Result<Study, StudyError>,
) -> PyResult<String> {
    let is_known = with(|kept| kept.studies.contains_key(&key));
    // Without the lock: a study may take seconds.
    let made = match is_known {
        true => None,
        false => Some(&*Box::leak(Box::new(make().map_err(value_error)?))),
    };
    with(|kept| {
        if let Some(study) = made {
            kept.studies.insert(key.clone(), study);
        }
        kept.names.insert(name.into(), key.clone());
    });
    Ok(key)
}

fn kept(name: &str) -> Option<&'static Study> {
    with(|kept| {
        let key = kept.names.get(name).map_or(name, String::as_str);
        kept.studies.get(key).copied()
    })
}

/// Returns the study of a key, of a name in a report, or of a file as it is now.
pub fn find(name: &str) -> PyResult<Option<&'static dyn Evaluable>> {
    let key = match is_path(name) {
        true => read(name, None)?,
        false => name.to_string(),
    };
    Ok(kept(&key).map(|study| study as &dyn Evaluable))
}

fn read(path: &str, solver: Option<&str>) -> PyResult<String> {
    let file = path.split_once(".fpcore#");
    let file = file.map_or(path.to_string(), |(stem, _)| format!("{stem}.fpcore"));
    // A file that cannot be read is refused below.
    let stamp = std::fs::metadata(file).and_then(|m| Ok((m.modified()?, m.len())));
    let key = key((path, stamp.ok(), solver));
    keep(key, path, || chosen(Study::open(path)?, solver))
}

fn chosen(study: Study, solver: Option<&str>) -> Result<Study, StudyError> {
    match solver {
        Some(name) => study.with_solver(name),
        None => Ok(study),
    }
}

/// Reads a study from a file or a text; returns its key.
#[pyfunction]
#[pyo3(signature = (text, is_path, solver=None))]
pub fn open_study(
    py: Python<'_>,
    text: &str,
    is_path: bool,
    solver: Option<&str>,
) -> PyResult<String> {
    py.detach(|| match is_path {
        true => read(text, solver),
        false => {
            let key = key((text, solver));
            let name = key.clone();
            keep(key, &name, || chosen(Study::parse(text, &name)?, solver))
        }
    })
}

/// Makes a study of a formula, of its inputs with their ends, and of a condition; returns its key.
#[pyfunction]
#[pyo3(signature = (text, inputs, condition=None))]
pub fn open_formula(
    py: Python<'_>,
    text: &str,
    inputs: Vec<(String, f64, f64)>,
    condition: Option<&str>,
) -> PyResult<String> {
    let ends: Vec<_> = inputs
        .iter()
        .map(|(name, from, to)| (name, from.to_bits(), to.to_bits()))
        .collect();
    let key = key((text, ends, condition));
    py.detach(|| {
        keep(key, text, || {
            let mut formula = Study::formula(text);
            for (name, from, to) in &inputs {
                formula = formula.input(name, *from..=*to);
            }
            if let Some(condition) = condition {
                formula = formula.condition(condition);
            }
            // Reports name it by its text.
            let mut problem = formula.study()?.problem().clone();
            problem.name = text.into();
            Study::new(problem)
        })
    })
}

fn found(key: &str) -> PyResult<&'static Study> {
    kept(key).ok_or_else(|| PyValueError::new_err(format!("study: there is no {key:?}")))
}

/// Definitions of the outputs, names of the solvers, and remarks.
#[pyfunction]
pub fn study_facts(key: &str) -> PyResult<(Vec<String>, Vec<String>, Vec<String>)> {
    let problem = found(key)?.problem();
    Ok((
        problem.outputs.iter().map(|o| o.text.clone()).collect(),
        problem.solvers.iter().map(|s| s.name.clone()).collect(),
        problem.notes.clone(),
    ))
}

/// Certified decimals of all outputs, none where undecided.
#[pyfunction]
pub fn study_digits(
    py: Python<'_>,
    key: &str,
    numbers: Vec<Fraction>,
    digits: u32,
) -> PyResult<Vec<Option<String>>> {
    let study = found(key)?;
    let exact: PyResult<Vec<Rational>> = numbers.iter().map(rational).collect();
    let exact = exact?;
    let values = py.detach(|| study.digits(&exact, digits));
    Ok(values.into_iter().map(|value| value.decimal).collect())
}

/// Values, or the reason why there are none.
type Values = (Option<Vec<f64>>, Option<String>);

/// The value of a study's solver at an input, or the reason why there is none.
#[pyfunction]
pub fn study_values(key: &str, numbers: Vec<f64>) -> PyResult<Values> {
    use mechaudit::audit::{Method, SolverAnswer};
    Ok(match found(key)?.solve(&numbers) {
        SolverAnswer::Values(values) => (Some(values), None),
        other => {
            let why = other.refusal().unwrap_or("the study states no solver");
            (None, Some(why.to_string()))
        }
    })
}

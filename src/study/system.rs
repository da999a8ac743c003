//! Systems of equations in studies.

use super::document::{Item, Value};
use super::error::StudyError;
use super::problem::{Problem, StudyOutput, StudySystem, default_budget};
use super::read::{Names, entries};
use mechaudit_symbolic::Expr;
use mechaudit_symbolic::graph::Start;

/// The most unknowns of a system.
const MOST: usize = 50;

/// The unknowns that a file declares.
pub(super) fn unknowns(file: &Item) -> Result<&[(String, Item)], StudyError> {
    let Some(system) = file.get("system") else {
        return Ok(&[]);
    };
    system.only(&["unknowns", "equations"])?;
    let found = entries(system, "unknowns")?;
    match found.len() {
        0 => Err(system.fault("a system has unknowns: unknowns = { u = { near = 1 } }")),
        n if n > MOST => Err(system.fault(format!("{n} unknowns where at most {MOST} are solved"))),
        _ => Ok(found),
    }
}

/// Reads the system; its unknowns are the outputs where the file states none.
pub(super) fn read(names: &Names, system: &Item, problem: &mut Problem) -> Result<(), StudyError> {
    let mut unknowns = Vec::new();
    for (name, item) in entries(system, "unknowns")? {
        if matches!(name.as_str(), "i" | "pi" | "inf") {
            return Err(item.fault(format!("{name} is a constant, no unknown")));
        }
        let start = start(names, name, item)?;
        unknowns.push((name.clone(), start));
    }
    let Some(list) = system.get("equations") else {
        return Err(system.fault("a system has equations: equations = [\"u^2 = 2\"]"));
    };
    let equations = list.list()?;
    let (found, due) = (equations.len(), unknowns.len());
    if found != due {
        return Err(list.fault(format!("{found} equations for {due} unknowns")));
    }
    let equations = equations.iter().map(|item| names.equation(item, &[]));
    let equations: Vec<Expr> = equations.collect::<Result<_, _>>()?;
    for (name, start) in &unknowns {
        for part in start.parts() {
            let all: Vec<&str> = unknowns.iter().map(|u| u.0.as_str()).collect();
            if problem.definitions.reaches(part, &all) {
                let reason = format!("where {name} is sought depends on an unknown");
                return Err(system.fault(reason));
            }
        }
    }
    if problem.outputs.is_empty() {
        let output = |name: &String| StudyOutput {
            name: name.clone(),
            unit: "1".into(),
            is: Expr::Sym(name.clone()),
            text: "an unknown".into(),
            budget: default_budget(),
            proved: None,
        };
        problem.outputs = unknowns.iter().map(|u| output(&u.0)).collect();
    }
    problem.system = Some(StudySystem {
        unknowns,
        equations,
    });
    Ok(())
}

/// Where an unknown is sought: a table of one key.
fn start(names: &Names, name: &str, item: &Item) -> Result<Start<Expr>, StudyError> {
    let needs = || {
        item.fault(format!(
            "the unknown {name} needs near = NUMBER or between = [LOW, HIGH]"
        ))
    };
    if !matches!(item.value, Value::Table(_)) {
        return Err(needs());
    }
    item.only(&["near", "between"])?;
    match (item.get("near"), item.get("between")) {
        (Some(near), None) => Ok(Start::Near(names.expression(near)?)),
        (None, Some(between)) => {
            let [low, high] = between.list()? else {
                return Err(between.fault("expected two ends: between = [LOW, HIGH]"));
            };
            Ok(Start::Between(
                names.expression(low)?,
                names.expression(high)?,
            ))
        }
        _ => Err(needs()),
    }
}

/// Refuses a condition on inputs that depends on an unknown or on a state.
pub(super) fn is_free(problem: &Problem, condition: &Expr, item: &Item) -> Result<(), StudyError> {
    let unknowns = problem.system.iter().flat_map(|s| &s.unknowns);
    let states = problem.initial_value.iter().flat_map(|s| &s.states);
    let unknowns = unknowns.map(|u| ("unknown", &u.0));
    let mut all = unknowns.chain(states.map(|s| ("state", &s.name)));
    match all.find(|(_, name)| problem.definitions.reaches(condition, &[name])) {
        None => Ok(()),
        Some((kind, name)) => Err(item.fault(format!(
            "a condition on the inputs depends on the {kind} {name}"
        ))),
    }
}

#[cfg(test)]
mod tests;

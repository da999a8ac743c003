//! Checks a study's formulas by the units that it states.

use super::document::Item;
use super::error::StudyError;
use super::problem::Problem;
use super::read::entries;
use mechaudit_symbolic::{Dimensions, Equation, Expr, Undimensional, unit};

/// Checks that every output has the dimension of its unit and that its parts agree. Names without a
/// unit, and parameters that are numbers without one, may have any. Returns a note about the first
/// fault, or about a unit that cannot be read, so that nothing is checked. A wrong dimension is a
/// remark of every report and no refusal: numbers in a formula may stand for quantities whose unit
/// it leaves out.
pub(super) fn check(
    file: &Item,
    problem: &Problem,
    unknowns: &[(String, Item)],
) -> Result<Option<String>, StudyError> {
    let (inputs, parameters) = (entries(file, "inputs")?, entries(file, "parameters")?);
    let outputs = entries(file, "outputs")?;
    let mut units = Dimensions::default();
    for (name, item) in inputs
        .iter()
        .chain(parameters)
        .chain(unknowns)
        .chain(outputs)
    {
        let is_number = matches!(
            problem.definitions.names.get(name),
            Some(Expr::Num(_) | Expr::Neg(_))
        );
        match item.get("unit") {
            Some(text) => match unit(text.text()?) {
                Ok(found) => units.declare(name, &found),
                Err(e) => {
                    return Ok(Some(format!(
                        "dimensions are not checked: the unit of {name}: {e}"
                    )));
                }
            },
            None if is_number || !problem.definitions.names.contains_key(name) => {
                units.leave_open(name)
            }
            None => {}
        }
    }
    let found = |e: Undimensional| match e {
        Undimensional::NoUnit { .. } | Undimensional::Circular { .. } => None,
        e => Some(e.to_string()),
    };
    for (name, _) in parameters.iter().chain(outputs) {
        let Some(is) = problem.definitions.names.get(name) else {
            continue;
        };
        let equation = Equation {
            left: Expr::Sym(name.clone()),
            right: is.clone(),
        };
        // The number of a parameter that has a unit is in that unit.
        let is_datum = parameters.iter().any(|p| p.0 == *name)
            && units.of(&problem.definitions, is) == Ok(Some(Default::default()));
        let checked = units.check(&problem.definitions, &equation);
        if let Some(fault) = checked.err().and_then(found).filter(|_| !is_datum) {
            return Ok(Some(format!("the dimension of {name} is wrong: {fault}")));
        }
    }
    for e in problem.system.iter().flat_map(|s| &s.equations) {
        if let Some(fault) = units.of(&problem.definitions, e).err().and_then(found) {
            return Ok(Some(format!(
                "the dimension of an equation is wrong: {fault}"
            )));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests;

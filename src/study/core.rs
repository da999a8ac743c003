//! Studies in FPCore.

use super::error::StudyError;
use super::problem::{
    Problem, StudyCondition, StudyInput, StudyOutput, StudySolver, default_budget,
};
use crate::audit::did_you_mean;
use mechaudit_symbolic::evaluation::{Elementary, Format};
use mechaudit_symbolic::fpcore::{Core, CoreError, parse_cores};
use mechaudit_symbolic::{Definitions, Expr, Relation, number};
use rug::Rational;

impl From<CoreError> for StudyError {
    fn from(error: CoreError) -> StudyError {
        let hint = error
            .unknown
            .map_or(String::new(), |(name, known)| did_you_mean(&name, &known));
        StudyError::new(error.reason + &hint).at(error.place)
    }
}

/// The problems of all cores of a text, each by itself.
pub(super) fn problems(
    text: &str,
    file: &str,
) -> Result<Vec<Result<Problem, StudyError>>, StudyError> {
    if text.len() > super::document::LONGEST {
        let reason = format!(
            "{} bytes where at most {} are read",
            text.len(),
            super::document::LONGEST
        );
        return Err(StudyError::new(reason));
    }
    let cores = parse_cores(text)?.into_iter().enumerate();
    Ok(cores.map(|(k, core)| Ok(problem(core?, file, k))).collect())
}

/// The problem of the core that a name picks: its symbol, its property `:name` or its number from
/// 1.
pub(super) fn picked(text: &str, file: &str, name: Option<&str>) -> Result<Problem, StudyError> {
    let mut all = problems(text, file)?;
    let Some(name) = name else {
        return match all.len() {
            0 => Err(StudyError::new("there is no core")),
            1 => all.remove(0),
            n => {
                let known = known(&all).join(", ");
                Err(StudyError::new(format!(
                    "there are {n} cores, pick one by #NAME or #NUMBER: {known}"
                )))
            }
        };
    };
    let place = all
        .iter()
        .position(|p| p.as_ref().is_ok_and(|p| p.name == name || p.title == name));
    let place = place.or_else(|| {
        name.parse::<usize>()
            .ok()
            .filter(|k| (1..=all.len()).contains(k))
            .map(|k| k - 1)
    });
    match place {
        Some(k) => all.swap_remove(k),
        None => {
            let known = known(&all);
            let hint = did_you_mean(name, &known);
            let known = known.join(", ");
            let first = all.iter().find_map(|p| p.as_ref().err());
            let unread = first.map_or(String::new(), |e| format!("; one that is not read: {e}"));
            Err(StudyError::new(format!(
                "there is no core {name:?}{hint}; there are: {known}{unread}"
            )))
        }
    }
}

fn known(all: &[Result<Problem, StudyError>]) -> Vec<String> {
    all.iter()
        .filter_map(|p| p.as_ref().ok().map(|p| p.name.clone()))
        .collect()
}

fn problem(core: Core, file: &str, k: usize) -> Problem {
    let mut inputs: Vec<StudyInput> = core
        .arguments
        .iter()
        .map(|name| StudyInput::any(name))
        .collect();
    if let Some((pre, _)) = &core.pre {
        narrow(pre, &mut inputs);
    }
    let is = core.spec.clone().unwrap_or_else(|| core.body.clone());
    let mut notes = Vec::new();
    if let Some(other) = &core.other_rounding {
        notes.push(format!(
            "The body asks for {other}, in which nothing is computed here: it is no solver."
        ));
    } else if core.spec.is_none() {
        notes.push("The solver is the definition itself in floating point.".into());
    }
    let format = match core.precision.as_deref() {
        Some("binary32") => Format::Single,
        _ => Format::Double,
    };
    let cited = core
        .texts
        .iter()
        .find(|t| t.0 == "cite" || t.0 == "description");
    Problem {
        name: match (&core.identifier, &core.name) {
            (Some(name), _) => name.clone(),
            (None, Some(name)) => name.clone(),
            (None, None) => format!("{file}-{}", k + 1),
        },
        title: core
            .name
            .clone()
            .unwrap_or_else(|| core.title().to_string()),
        source: cited.map_or_else(|| format!("{file}, line {}", core.line), |t| t.1.clone()),
        outputs: vec![StudyOutput {
            name: output_name(&core.arguments),
            unit: "1".into(),
            text: is.to_string(),
            is,
            budget: default_budget(),
            proved: None,
        }],
        solvers: match core.other_rounding {
            Some(_) => Vec::new(),
            None => vec![StudySolver {
                name: "body".into(),
                formulas: vec![core.body],
                definitions: Definitions::default(),
                format,
                elementary: Elementary::Platform,
            }],
        },
        condition: core.pre.map(|(is, place)| StudyCondition {
            is,
            place: Some(place),
        }),
        inputs,
        notes,
        ..Problem::default()
    }
}

/// `value`, unless an argument has this name.
fn output_name(arguments: &[String]) -> String {
    let names = ["value", "result", "output"];
    let free = names
        .into_iter()
        .find(|name| !arguments.iter().any(|a| a == name));
    free.unwrap_or("the-value").into()
}

/// Ends of inputs that a condition states: `a <= x <= b` among others that hold at once.
fn narrow(condition: &Expr, inputs: &mut [StudyInput]) {
    match condition {
        Expr::And(parts) => parts.iter().for_each(|part| narrow(part, inputs)),
        Expr::Compare(relation, parts) => {
            let [a, b] = parts.as_slice() else {
                return;
            };
            let (below, above) = match relation {
                Relation::Less | Relation::LessEqual => (a, b),
                Relation::Greater | Relation::GreaterEqual => (b, a),
                Relation::Equal => {
                    let value = match (a, b) {
                        (Expr::Sym(name), b) => constant(b).map(|q| (name, q)),
                        (a, Expr::Sym(name)) => constant(a).map(|q| (name, q)),
                        _ => None,
                    };
                    if let Some((name, q)) = value {
                        for input in inputs.iter_mut().filter(|i| i.name == *name) {
                            input.from = Some(q.clone());
                            input.to = Some(q.clone());
                        }
                    }
                    return;
                }
                Relation::NotEqual => return,
            };
            if let (Some(low), Expr::Sym(name)) = (constant(below), above) {
                for input in inputs.iter_mut().filter(|i| i.name == *name) {
                    let from = input.from.get_or_insert_with(|| low.clone());
                    *from = from.clone().max(low.clone());
                }
            }
            if let (Expr::Sym(name), Some(high)) = (below, constant(above)) {
                for input in inputs.iter_mut().filter(|i| i.name == *name) {
                    let to = input.to.get_or_insert_with(|| high.clone());
                    *to = to.clone().min(high.clone());
                }
            }
        }
        // Names that hide no input.
        Expr::Let(_, values, inner) => {
            let hides = |name: &str| values.iter().any(|v| v.0 == name);
            if !inputs.iter().any(|i| hides(&i.name)) {
                narrow(inner, inputs);
            }
        }
        _ => {}
    }
}

fn constant(e: &Expr) -> Option<Rational> {
    match e {
        Expr::Num(n) => number(n),
        Expr::Neg(e) => Some(-constant(e)?),
        Expr::Div(a, b) => {
            let b = constant(b)?;
            (b != 0).then(|| constant(a).map(|a| a / b)).flatten()
        }
        _ => None,
    }
}

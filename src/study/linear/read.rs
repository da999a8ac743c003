//! Studies of linear algebra in TOML.

use super::super::document::{Item, Value};
use super::super::error::StudyError;
use super::super::problem::{Problem, Spacing, StudyInput, StudyOutput, default_budget};
use super::super::read::{entries, is_name, rational, unit_and_budget};
use super::{Linear, MOST, Size, Task, Tensor};
use crate::audit::did_you_mean;
use mechaudit_symbolic::Expr;

/// Keys of a study of linear algebra.
const KEYS: [&str; 5] = ["title", "source", "inputs", "parameters", "outputs"];

/// Keys that define an output.
const TASKS: [&str; 5] = ["solve", "det", "inverse", "least_squares", "eigenvalues"];

/// The most rows.
const ROWS: usize = 1_000_000;

/// Returns true if an input has a shape, or an output is defined by a task.
pub(in super::super) fn is_linear(file: &Item) -> bool {
    let has = |section: &str, keys: &[&str]| match file.get(section).map(|s| &s.value) {
        Some(Value::Table(items)) => items
            .iter()
            .any(|i| keys.iter().any(|k| i.1.get(k).is_some())),
        _ => false,
    };
    has("inputs", &["shape", "banded"]) || has("outputs", &TASKS)
}

/// Reads a study of linear algebra.
pub(in super::super) fn problem(file: &Item, name: &str) -> Result<Problem, StudyError> {
    if let Some((key, item)) = file.table()?.iter().find(|e| !KEYS.contains(&e.0.as_str())) {
        let keys = KEYS.join(", ");
        return Err(item.fault(format!(
            "a study of linear algebra has no {key}; it has: {keys}"
        )));
    }
    let line = |key: &str| {
        file.get(key)
            .map(|item| item.text().map(String::from))
            .transpose()
    };
    let mut sizes = Sizes::default();
    for (name, item) in entries(file, "parameters")? {
        is_name(name, item)?;
        sizes.known.push((name, whole(item)?, item, false));
    }
    let mut inputs: Vec<StudyInput> = Vec::new();
    let mut tensors = Vec::new();
    for (name, item) in entries(file, "inputs")? {
        is_name(name, item)?;
        let (tensor, input) = tensor(&mut sizes, name, item)?;
        tensors.push(tensor);
        inputs.push(input);
    }
    if let Some((name, _, item, _)) = sizes.known.iter().find(|k| !k.3) {
        return Err(item.fault(format!("no shape uses the parameter {name}")));
    }
    let letter = sizes.letter.map(|(letter, _)| letter);
    let mut linear = Linear {
        letter,
        tensors,
        tasks: Vec::new(),
    };
    if linear.letter.is_none() && linear.count(0) > MOST {
        let count = linear.count(0);
        return Err(StudyError::new(format!(
            "{count} numbers where at most {MOST} are read"
        )));
    }
    let mut outputs: Vec<StudyOutput> = Vec::new();
    for (name, item) in entries(file, "outputs")? {
        is_name(name, item)?;
        if inputs.iter().any(|i| i.name == *name) {
            return Err(item.fault(format!("the name {name} is declared twice")));
        }
        let (task, text) = task(&linear, name, item)?;
        let mut output = StudyOutput {
            name: name.clone(),
            unit: "1".into(),
            is: Expr::Sym(text.clone()),
            text,
            budget: default_budget(),
            proved: None,
        };
        unit_and_budget(&mut output, item)?;
        if let Some(first) = linear.tasks.first()
            && linear.values_of(*first) != linear.values_of(task)
        {
            let other = &outputs[0].name;
            return Err(item.fault(format!(
                "{name} and {other} have different numbers of values: a study for each"
            )));
        }
        linear.tasks.push(task);
        outputs.push(output);
    }
    if outputs.is_empty() {
        return Err(StudyError::new(
            "a study has at least one output: [outputs]",
        ));
    }
    Ok(Problem {
        name: name.into(),
        title: line("title")?.unwrap_or_else(|| name.to_string()),
        source: line("source")?.unwrap_or_else(|| "the user's own study".into()),
        inputs,
        outputs,
        linear: Some(linear),
        ..Problem::default()
    })
}

/// Lengths by their names.
#[derive(Default)]
struct Sizes<'a> {
    /// Those of the parameters; true where a shape uses them.
    known: Vec<(&'a str, usize, &'a Item, bool)>,
    /// The one that is open, and the first shape that has it.
    letter: Option<(String, String)>,
}

/// A whole number from 1 on.
fn whole(item: &Item) -> Result<usize, StudyError> {
    let value = rational(item)?;
    let found = value
        .is_integer()
        .then(|| value.numer().to_usize())
        .flatten();
    match found {
        Some(n) if (1..=ROWS).contains(&n) => Ok(n),
        _ => Err(item.fault(format!(
            "{value} is no length: a whole number from 1 to {ROWS}"
        ))),
    }
}

impl Sizes<'_> {
    fn size(&mut self, of: &str, item: &Item) -> Result<Size, StudyError> {
        if matches!(item.value, Value::Number(_)) {
            return Ok(Size::Known(whole(item)?));
        }
        let name = item.text()?;
        is_name(name, item)?;
        if let Some(known) = self.known.iter_mut().find(|k| k.0 == name) {
            known.3 = true;
            return Ok(Size::Known(known.1));
        }
        let (letter, first) = self.letter.get_or_insert_with(|| (name.into(), of.into()));
        match letter == name {
            true => Ok(Size::Open),
            false => Err(item.fault(format!(
                "the lengths {letter} of {first} and {name} of {of} are both open: state one in [parameters]"
            ))),
        }
    }
}

fn tensor(
    sizes: &mut Sizes<'_>,
    name: &str,
    item: &Item,
) -> Result<(Tensor, StudyInput), StudyError> {
    item.only(&["shape", "banded", "from", "to", "unit"])?;
    let Some(shape) = item.get("shape") else {
        let reason = format!("the input {name} needs shape = [\"n\", \"n\"] or shape = [\"n\"]");
        return Err(item.fault(reason));
    };
    let (rows, columns) = match shape.list()? {
        [rows] => (sizes.size(name, rows)?, None),
        [rows, columns] => (sizes.size(name, rows)?, Some(sizes.size(name, columns)?)),
        other => {
            let found = other.len();
            return Err(shape.fault(format!(
                "a shape of {found} lengths, where one or two are meant"
            )));
        }
    };
    let mut band = None;
    if let Some(item) = item.get("banded") {
        let [lower, upper] = item.list()? else {
            return Err(item.fault("expected two numbers of diagonals: banded = [LOWER, UPPER]"));
        };
        let width = |item: &Item| {
            let found = item.text()?.parse::<usize>().ok().filter(|n| *n <= 1000);
            found.ok_or_else(|| item.fault("the number of diagonals is a whole number up to 1000"))
        };
        if columns != Some(rows) {
            return Err(item.fault(format!("the banded matrix {name} is not square")));
        }
        band = Some([width(lower)?, width(upper)?]);
    }
    let end = |key: &str| item.get(key).map(rational).transpose();
    let (from, to) = (end("from")?, end("to")?);
    if let (Some(from), Some(to)) = (&from, &to)
        && from > to
    {
        return Err(item.fault(format!("the range of {name} is empty: {from} to {to}")));
    }
    let unit = item.get("unit").map(Item::text).transpose()?.unwrap_or("1");
    let input = StudyInput {
        name: name.into(),
        unit: unit.into(),
        from,
        to,
        spacing: Spacing::Linear,
    };
    let tensor = Tensor {
        name: name.into(),
        rows,
        columns,
        band,
    };
    Ok((tensor, input))
}

/// The names that a task is of: a string, or a list of strings.
fn operands<'a>(
    linear: &Linear,
    item: &'a Item,
) -> Result<Vec<(usize, &'a str, &'a Item)>, StudyError> {
    let all: Vec<&Item> = match &item.value {
        Value::List(items) => items.iter().collect(),
        _ => vec![item],
    };
    let place = |item: &'a Item| {
        let name = item.text()?;
        match linear.tensors.iter().position(|t| t.name == name) {
            Some(place) => Ok((place, name, item)),
            None => {
                let known: Vec<&str> = linear.tensors.iter().map(|t| t.name.as_str()).collect();
                let hint = did_you_mean(name, &known);
                Err(item.fault(format!("there is no input {name}{hint}")))
            }
        }
    };
    all.into_iter().map(place).collect()
}

/// Reads the task of an output, and its text.
fn task(linear: &Linear, name: &str, item: &Item) -> Result<(Task, String), StudyError> {
    let stated: Vec<&str> = TASKS
        .into_iter()
        .filter(|key| item.get(key).is_some())
        .collect();
    let [key] = stated[..] else {
        let tasks = TASKS.join(", ");
        return Err(item.fault(format!("the output {name} needs one of: {tasks}")));
    };
    item.only(&[key, "unit", "budget", "why"])?;
    let of = item.get(key).unwrap_or(item);
    let operands = operands(linear, of)?;
    let size = |s: Size| s.text(linear.letter());
    let matrix = |(k, name, item): (usize, &str, &Item)| match linear.tensors[k].columns {
        Some(columns) => Ok((k, linear.tensors[k].rows, columns)),
        None => Err(item.fault(format!("{name} is a vector where a matrix is meant"))),
    };
    let square = |operand: (usize, &str, &Item)| {
        let (k, rows, columns) = matrix(operand)?;
        match rows == columns {
            true => Ok((k, rows)),
            false => Err(operand.2.fault(format!(
                "{} has {} rows and {} columns: it is not square",
                operand.1,
                size(rows),
                size(columns)
            ))),
        }
    };
    // The second operand has as many rows as the first.
    let beside = |rows: Size, (k, name, item): (usize, &str, &Item)| {
        let found = linear.tensors[k].rows;
        match found == rows {
            _ if linear.tensors[k].band.is_some() && key != "eigenvalues" => {
                Err(item.fault(format!("{name} is banded where a right-hand side is meant")))
            }
            true => Ok(k),
            false => Err(item.fault(format!(
                "{name} has {} rows where {} are needed",
                size(found),
                size(rows)
            ))),
        }
    };
    let found = match (key, &operands[..]) {
        ("solve", [a, b]) => {
            let (place, rows) = square(*a)?;
            Task::Solve(place, beside(rows, *b)?)
        }
        ("least_squares", [a, b]) => {
            let (place, rows, columns) = matrix(*a)?;
            if let (Size::Known(m), Size::Known(n)) = (rows, columns)
                && m < n
            {
                let reason = format!("{} has more columns ({n}) than rows ({m})", a.1);
                return Err(a.2.fault(reason));
            }
            Task::LeastSquares(place, beside(rows, *b)?)
        }
        ("det", [a]) => Task::Determinant(square(*a)?.0),
        ("inverse", [a]) => Task::Inverse(square(*a)?.0),
        ("eigenvalues", [a]) => Task::Eigenvalues(square(*a)?.0, None),
        ("eigenvalues", [a, b]) => {
            let (place, rows) = square(*a)?;
            square(*b)?;
            Task::Eigenvalues(place, Some(beside(rows, *b)?))
        }
        (_, others) => {
            let due = match key {
                "solve" | "least_squares" => "a matrix and a right-hand side",
                "eigenvalues" => "one or two matrices",
                _ => "one matrix",
            };
            let found = others.len();
            return Err(of.fault(format!("{key} of {found} inputs, where {due} are meant")));
        }
    };
    let names: Vec<&str> = operands.iter().map(|o| o.1).collect();
    Ok((found, format!("{key}({})", names.join(", "))))
}

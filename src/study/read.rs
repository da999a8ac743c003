//! Studies in TOML.

use super::definitions::definitions;
use super::dimensions;
use super::document::{Item, Value, read as document};
use super::error::StudyError;
use super::initial_value;
use super::linear;
use super::problem::{
    Problem, Spacing, StudyCondition, StudyInput, StudyOutput, StudyRegion, StudySolver,
    default_budget, fault_in, limit,
};
use super::system;
use mechaudit_symbolic::evaluation::{Elementary, Format};
use mechaudit_symbolic::{
    Bound, Constant, Definitions, Equation, Expr, Func, Roots, number, parse_declared,
    parse_declared_equation,
};
use rug::Rational;

/// Keys of a study.
const KEYS: [&str; 11] = [
    "title",
    "source",
    "inputs",
    "parameters",
    "let",
    "outputs",
    "region",
    "where",
    "system",
    "ode",
    "solver",
];

/// Reads a study; its name is that of its file.
pub(super) fn problem(text: &str, name: &str) -> Result<Problem, StudyError> {
    let file = document(text)?;
    file.only(&KEYS)?;
    if linear::is_linear(&file) {
        return linear::read::problem(&file, name);
    }
    let line = |key: &str| {
        file.get(key)
            .map(|item| item.text().map(String::from))
            .transpose()
    };
    let mut problem = Problem {
        name: name.into(),
        title: line("title")?.unwrap_or_else(|| name.to_string()),
        source: line("source")?.unwrap_or_else(|| "the user's own study".into()),
        ..Problem::default()
    };
    for (name, item) in entries(&file, "inputs")? {
        named(&problem, name, item)?;
        problem.inputs.push(input(name, item)?);
    }
    let parameters = entries(&file, "parameters")?;
    let (lets, listed) = definitions(entries(&file, "let")?)?;
    let stated = entries(&file, "outputs")?;
    let (outputs, places) = one_by_one(stated)?;
    let unknowns = system::unknowns(&file)?;
    let states = initial_value::read::states(&file)?;
    if outputs.is_empty() && unknowns.is_empty() && states.is_empty() {
        return Err(StudyError::new(
            "a study has at least one output: [outputs]",
        ));
    }
    if let Some(ode) = file.get("ode") {
        problem
            .inputs
            .push(initial_value::read::time(&problem, ode)?);
    }
    let mut declared: Vec<String> = problem.inputs.iter().map(|i| i.name.clone()).collect();
    let is_unknown = |name: &str| unknowns.iter().any(|u| u.0 == name);
    // An output may be an unknown, which is declared where the system is.
    let defined = outputs.iter().filter(|o| !is_unknown(&o.0));
    let defined: Vec<&(String, Item)> = parameters.iter().chain(&lets).chain(defined).collect();
    for (name, item) in defined.iter().copied().chain(unknowns).chain(states) {
        is_name(name, item)?;
        if declared.contains(name) {
            return Err(item.fault(format!("the name {name} is declared twice")));
        }
        declared.push(name.clone());
    }
    declared.extend(listed.iter().cloned());
    problem.lists = listed;
    let names = Names { declared };
    problem.notes.extend(names.hidden());
    for (name, item) in parameters.iter().chain(&lets) {
        problem.definitions.set(name, names.definition(name, item)?);
    }
    if let Some(ode) = file.get("ode") {
        initial_value::read::read(&names, ode, &mut problem)?;
    }
    for ((name, item), place) in outputs.iter().zip(places) {
        let is_unknown = is_unknown(name);
        let output = output(&names, name, item, is_unknown, place)?;
        if !is_unknown {
            problem.definitions.set(name, output.is.clone());
        }
        problem.outputs.push(output);
    }
    if let Some(item) = file.get("system") {
        system::read(&names, item, &mut problem)?;
    }
    // A name that leads back to itself has no value.
    for (name, item) in defined {
        if leads_to(&problem.definitions, name) {
            return Err(item.fault(format!("the definition of {name} leads back to {name}")));
        }
    }
    let whole = file.get("where");
    problem.condition = whole
        .map(|item| condition(&names, &problem, item))
        .transpose()?;
    if let Some(regions) = file.get("region") {
        for item in regions.list()? {
            problem.regions.push(region(&names, &problem, item)?);
        }
    }
    for (name, item) in entries(&file, "solver")? {
        problem.solvers.push(solver(&problem, name, item)?);
    }
    problem.notes.extend(dependent(&problem));
    let note = dimensions::check(&file, &problem, unknowns)?;
    problem.notes.extend(note);
    Ok(problem)
}

/// Entries of a table that may be missing.
pub(super) fn entries<'a>(file: &'a Item, key: &str) -> Result<&'a [(String, Item)], StudyError> {
    file.get(key).map_or(Ok(&[]), Item::table)
}

/// The reason why `inf` is no name: limits without end are told by it from numbers.
pub(super) const INFINITY: &str = "inf is infinity, and no name";

/// Checks that a text is a name.
///
/// # Errors
/// A text that is not a letter or an underscore, then up to 63 letters, digits, underscores and
/// primes.
pub fn is_name(name: &str, item: &Item) -> Result<(), StudyError> {
    let mut letters = name.chars();
    let first = letters
        .next()
        .is_some_and(|c| c.is_ascii_alphabetic() || c == '_');
    let rest = letters.all(|c| c.is_ascii_alphanumeric() || matches!(c, '_' | '\''));
    match first && rest && name.len() <= 64 {
        true if name == "inf" => Err(item.fault(INFINITY)),
        true => Ok(()),
        false => Err(item.fault(format!(
            "{name:?} is no name: a letter, then up to 63 letters, digits and underscores"
        ))),
    }
}

/// Outputs, and of each its place among the roots of one equation, or 0.
type OneByOne = (Vec<(String, Item)>, Vec<u32>);

/// Outputs with each root of an equation by itself: its name ends in its place, from 1 to `count`;
/// the places of roots beside them, 0 elsewhere.
fn one_by_one(stated: &[(String, Item)]) -> Result<OneByOne, StudyError> {
    /// The most roots that one output may stand for.
    const MOST: u32 = 1000;
    let mut places = Vec::new();
    let mut outputs = Vec::new();
    for (name, item) in stated {
        if item.get("roots_of").is_none() {
            outputs.push((name.clone(), item.clone()));
            places.push(0);
            continue;
        }
        is_name(name, item)?;
        if item.get("root_of").is_some() {
            return Err(item.fault(format!("the output {name} has root_of and roots_of")));
        }
        let Some(count) = item.get("count") else {
            return Err(item.fault(format!(
                "the roots {name} need count = NUMBER: outputs are {name}_1, {name}_2, ..."
            )));
        };
        let number = count.text()?.parse::<u32>().ok();
        let Some(number) = number.filter(|n| (1..=MOST).contains(n)) else {
            return Err(count.fault(format!("the number of roots is not from 1 to {MOST}")));
        };
        for place in 1..=number {
            outputs.push((format!("{name}_{place}"), item.clone()));
            places.push(place);
        }
    }
    Ok((outputs, places))
}

/// The name that an equation gives its unknown: that of the output, without the place of a root.
fn unknown_of(name: &str, place: u32) -> &str {
    match place {
        0 => name,
        place => name.strip_suffix(&format!("_{place}")).unwrap_or(name),
    }
}

fn named(problem: &Problem, name: &str, item: &Item) -> Result<(), StudyError> {
    is_name(name, item)?;
    match problem.inputs.iter().any(|i| i.name == name) {
        true => Err(item.fault(format!("the name {name} is declared twice"))),
        false => Ok(()),
    }
}

/// The names that expressions of a study may use.
pub(super) struct Names {
    declared: Vec<String>,
}

impl Names {
    /// An expression of a string or a number.
    pub(super) fn expression(&self, item: &Item) -> Result<Expr, StudyError> {
        self.expression_with(item, &[])
    }

    pub(super) fn expression_with(&self, item: &Item, more: &[&str]) -> Result<Expr, StudyError> {
        let text = item.text()?;
        let (text, sign) = match (&item.value, text.strip_prefix('-')) {
            (Value::Number(_), Some(rest)) => (rest, true),
            _ => (text, false),
        };
        let known = |name: &str| self.declared.iter().any(|n| n == name) || more.contains(&name);
        let found =
            parse_declared(text, &known).map_err(|e| fault_in(e, item.place, &self.all()))?;
        Ok(if sign {
            Expr::Neg(Box::new(found))
        } else {
            found
        })
    }

    /// `left = right`, or an expression that is to be zero.
    pub(super) fn equation(&self, item: &Item, more: &[&str]) -> Result<Expr, StudyError> {
        let text = item.text()?;
        let is_equation = text
            .replace("==", "")
            .replace("<=", "")
            .replace(">=", "")
            .replace("!=", "")
            .contains('=');
        if !is_equation {
            return self.expression_with(item, more);
        }
        let known = |name: &str| self.declared.iter().any(|n| n == name) || more.contains(&name);
        let Equation { left, right } = parse_declared_equation(text, &known)
            .map_err(|e| fault_in(e, item.place, &self.all()))?;
        Ok(Expr::Add(vec![left, Expr::Neg(Box::new(right))]))
    }

    /// All names that may be meant where one is not known.
    fn all(&self) -> Vec<String> {
        let functions = Func::ALL.iter().map(|f| f.1.to_string());
        self.declared.iter().cloned().chain(functions).collect()
    }

    /// Remarks on names that hide constants or functions.
    fn hidden(&self) -> Vec<String> {
        let constant = |name: &str| {
            matches!(name, "e" | "i" | "pi" | "inf") || Constant::ALL.iter().any(|c| c.1 == name)
        };
        let names = self.declared.iter();
        names
            .filter_map(|name| match (constant(name), Func::named(name)) {
                (true, _) => Some(format!(
                    "The name {name} is declared and hides the constant."
                )),
                (_, Some(_)) => Some(format!(
                    "The name {name} is declared and hides the function."
                )),
                _ => None,
            })
            .collect()
    }
}

/// An exact number of a string or a number.
///
/// # Errors
/// A text that is no finite number.
pub fn rational(item: &Item) -> Result<Rational, StudyError> {
    let text = item.text()?;
    exact(text).ok_or_else(|| item.fault(format!("{text:?} is no finite number")))
}

/// The number that a text is; none where it is no finite number.
pub(super) fn exact(text: &str) -> Option<Rational> {
    let text = text.trim();
    let (sign, size) = match text.strip_prefix('-') {
        Some(size) => (-1, size),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    Some(number(&size.replace('_', ""))? * sign)
}

/// An input: a table of ends, spacing and unit.
///
/// # Errors
/// An unknown key, an end that is no number, and a range that is empty.
pub fn input(name: &str, item: &Item) -> Result<StudyInput, StudyError> {
    item.only(&["from", "to", "spacing", "unit"])?;
    let end = |key: &str| item.get(key).map(rational).transpose();
    let spacing = match item.get("spacing").map(Item::text).transpose()? {
        None | Some("linear") => Spacing::Linear,
        Some("log") => Spacing::Log,
        Some(other) => {
            return Err(item.fault(format!(
                "the spacing {other:?} is neither \"linear\" nor \"log\""
            )));
        }
    };
    let unit = item.get("unit").map(Item::text).transpose()?.unwrap_or("1");
    let found = StudyInput {
        name: name.into(),
        unit: unit.into(),
        from: end("from")?,
        to: end("to")?,
        spacing,
    };
    if let (Some(from), Some(to)) = (&found.from, &found.to)
        && from > to
    {
        return Err(item.fault(format!("the range of {name} is empty: {from} to {to}")));
    }
    Ok(found)
}

/// An output: its definition as a string, or a table; an unknown of a system is its own definition.
fn output(
    names: &Names,
    name: &str,
    item: &Item,
    is_unknown: bool,
    place: u32,
) -> Result<StudyOutput, StudyError> {
    let plain = |is: Expr, text: String| StudyOutput {
        name: name.into(),
        unit: "1".into(),
        is,
        text,
        budget: default_budget(),
        proved: None,
    };
    if !matches!(item.value, Value::Table(_)) {
        if is_unknown {
            return Err(item.fault(format!("the name {name} is declared twice")));
        }
        return Ok(plain(names.expression(item)?, item.text()?.into()));
    }
    let keys = [
        "is", "root_of", "roots_of", "between", "count", "unit", "budget", "why",
    ];
    item.only(&keys)?;
    let equation = item.get("root_of").or(item.get("roots_of"));
    if item.get("count").is_some() && place == 0 {
        return Err(item.fault("count belongs to roots_of"));
    }
    let mut found = match (item.get("is"), equation) {
        (Some(is), None) => plain(names.expression(is)?, is.text()?.into()),
        (None, Some(of)) => {
            let Some(between) = item.get("between") else {
                return Err(item.fault(format!("the root {name} needs between = [LOW, HIGH]")));
            };
            let [low, high] = between.list()? else {
                return Err(between.fault("expected two ends: between = [LOW, HIGH]"));
            };
            let unknown = unknown_of(name, place);
            let bound = Bound {
                var: unknown.into(),
                from: names.expression(low)?,
                to: names.expression(high)?,
                body: names.equation(of, &[unknown])?,
            };
            let (which, kind) = match item.get("count") {
                None => (Roots::Only, "root".into()),
                Some(count) => {
                    let count = count.text()?.parse().unwrap_or(0);
                    let kind = format!("root {place} of {count}");
                    (Roots::One { place, count }, kind)
                }
            };
            let (low, high) = (low.text()?, high.text()?);
            let text = format!("{kind} of {} between {low} and {high}", of.text()?);
            plain(Expr::Root(Box::new(bound), which), text)
        }
        (None, None) if is_unknown => plain(Expr::Sym(name.into()), "an unknown".into()),
        _ => {
            return Err(item.fault(format!(
                "the output {name} needs is = ..., root_of = ... or roots_of = ..."
            )));
        }
    };
    if is_unknown && found.is != Expr::Sym(name.into()) {
        return Err(item.fault(format!("the name {name} is declared twice")));
    }
    unit_and_budget(&mut found, item)?;
    Ok(found)
}

/// The unit and the budget that a table states for an output.
pub(super) fn unit_and_budget(found: &mut StudyOutput, item: &Item) -> Result<(), StudyError> {
    if let Some(unit) = item.get("unit") {
        found.unit = unit.text()?.into();
    }
    if let Some(text) = item
        .get("budget")
        .filter(|b| b.text().is_ok_and(|t| t == "proved"))
    {
        found.proved = Some(text.place);
    } else if let Some(text) = item.get("budget") {
        let limit = limit(text.text()?).map_err(|e| e.at(text.place))?;
        let why = item.get("why").map(Item::text).transpose()?;
        let why = why.unwrap_or("stated by the study without a reason");
        found.budget = (limit, why.into());
    }
    Ok(())
}

/// A region: a name, other ends of inputs, a condition.
fn region(names: &Names, problem: &Problem, item: &Item) -> Result<StudyRegion, StudyError> {
    let Some(name) = item.get("name") else {
        return Err(item.fault("a region has a name"));
    };
    let word = name.text()?;
    let is_word = !word.is_empty()
        && word
            .chars()
            .all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_');
    if !is_word {
        return Err(name.fault(format!("the region's name {word:?} is not one word")));
    }
    let mut inputs = Vec::new();
    let mut found = None;
    for (key, value) in item.table()? {
        match key.as_str() {
            "name" => {}
            "where" => found = Some(condition(names, problem, value)?),
            key => {
                if !problem.inputs.iter().any(|i| i.name == key) {
                    let known: Vec<&str> = problem.inputs.iter().map(|i| i.name.as_str()).collect();
                    let hint = crate::audit::did_you_mean(key, &known);
                    return Err(value.fault(format!("there is no input {key}{hint}")));
                }
                inputs.push(input(key, value)?);
            }
        }
    }
    Ok(StudyRegion {
        name: word.into(),
        inputs,
        condition: found,
    })
}

/// A condition on the inputs.
fn condition(names: &Names, problem: &Problem, item: &Item) -> Result<StudyCondition, StudyError> {
    let is = names.expression(item)?;
    system::is_free(problem, &is, item)?;
    Ok(StudyCondition {
        is,
        place: Some(item.place),
    })
}

/// A solver: a formula for each output; names of its own in `let`, `format`, `elementary`; in words
/// `title`, `source` and `read`, what was read.
pub(super) fn solver(
    problem: &Problem,
    name: &str,
    item: &Item,
) -> Result<StudySolver, StudyError> {
    let (lets, listed) = definitions(entries(item, "let")?)?;
    for (own, value) in &lets {
        is_name(own, value)?;
    }
    let inputs = problem.inputs.iter().map(|i| &i.name);
    let stated = problem.definitions.names.keys().chain(&problem.lists);
    let own = lets.iter().map(|l| &l.0).chain(&listed);
    let outputs = problem.outputs.iter().map(|o| &o.name);
    let own = Names {
        declared: inputs
            .chain(stated)
            .chain(outputs)
            .chain(own)
            .cloned()
            .collect(),
    };
    // Outputs have no values in a solver, or it would be the definition.
    let mut definitions = Definitions::default();
    for (key, value) in &problem.definitions.names {
        if !problem.outputs.iter().any(|o| o.name == *key) {
            definitions.set(key, value.clone());
        }
    }
    for (key, value) in &lets {
        definitions.set(key, own.definition(key, value)?);
    }
    let mut formulas = Vec::new();
    for output in &problem.outputs {
        let Some(formula) = item.get(&output.name) else {
            let missing = &output.name;
            return Err(item.fault(format!("the solver {name} has no formula for {missing}")));
        };
        let formula = own.expression(formula)?;
        definitions.set(&output.name, formula.clone());
        formulas.push(formula);
    }
    for (key, value) in item.table()? {
        let known = ["let", "format", "elementary", "title", "source", "read"]
            .contains(&key.as_str())
            || problem.outputs.iter().any(|o| o.name == *key);
        if !known {
            return Err(value.fault(format!("the solver {name} has the unknown key {key:?}")));
        }
    }
    let format = match item.get("format").map(Item::text).transpose()? {
        None | Some("binary64") => Format::Double,
        Some("binary32") => Format::Single,
        Some(other) => {
            return Err(item.fault(format!(
                "the format {other:?} is neither \"binary64\" nor \"binary32\""
            )));
        }
    };
    let elementary = match item.get("elementary").map(Item::text).transpose()? {
        None | Some("platform") => Elementary::Platform,
        Some("correct") => Elementary::Correct,
        Some(other) => {
            return Err(item.fault(format!(
                "elementary = {other:?} is neither \"platform\" nor \"correct\""
            )));
        }
    };
    Ok(StudySolver {
        name: name.into(),
        formulas,
        definitions,
        format,
        elementary,
    })
}

/// Returns true if a definition depends on its own name.
fn leads_to(definitions: &Definitions, name: &str) -> bool {
    let Some(e) = definitions.names.get(name) else {
        return false;
    };
    // A root's variable has the name of its output.
    match e {
        Expr::Root(bound, _) if bound.var == name => [&bound.from, &bound.to]
            .into_iter()
            .any(|e| definitions.reaches(e, &[name])),
        e => definitions.reaches(e, &[name]),
    }
}

/// Remarks on solvers that are no witness for the definition.
fn dependent(problem: &Problem) -> Vec<String> {
    let mut notes = Vec::new();
    for solver in &problem.solvers {
        for (output, formula) in problem.outputs.iter().zip(&solver.formulas) {
            let is_other = |n: &String| problem.definitions.reaches(&output.is, &[n]);
            let is_alike = *formula == output.is && !problem.redefined(solver).any(is_other);
            let (solver, name) = (&solver.name, &output.name);
            if is_alike {
                notes.push(format!(
                    "The solver {solver} and the definition of {name} are the same formula: they are not independent."
                ));
                continue;
            }
            let shared = problem.definitions.names.keys().find(|key| {
                let is_parameter = |e: &Expr| e.children().is_empty();
                !is_parameter(&problem.definitions.names[*key])
                    && problem.definitions.reaches(&output.is, &[key])
                    && problem.definitions.reaches(formula, &[key])
            });
            if let Some(shared) = shared {
                notes.push(format!(
                    "The solver {solver} and the definition of {name} share {shared}: they are not independent."
                ));
            }
        }
    }
    notes
}

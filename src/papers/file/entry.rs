//! Entries of a ledger, read from a file.

use super::read::{Reading, count, defined, only, required, text, texts, truth, word};
use crate::papers::ledger::{Item, Kind, Names, Requirement, Verdict};
use crate::study::document::{Item as Node, Value};
use crate::study::{StudyError, fault_in, intern, is_name};
use crate::symbolic::{Definitions, Dimensions, Expr, Family, Outcome, SymbolicError, unit};
use std::sync::Arc;

const KEYS: &str = "id place kind printed composed claims with requires also values verdict \
                    repair edits confused missing note unit";

const KINDS: [(&str, Kind); 5] = [
    ("formula", Kind::Formula),
    ("step", Kind::Step),
    ("table", Kind::Table),
    ("number", Kind::Number),
    ("statement", Kind::Statement),
];

const VERDICTS: [(&str, Verdict); 8] = [
    ("proved", Verdict::Proved),
    ("misprint", Verdict::Misprint),
    ("refuted", Verdict::Refuted),
    ("undimensional", Verdict::Undimensional),
    ("undecided", Verdict::Undecided),
    ("definition", Verdict::Definition),
    ("undefined", Verdict::Undefined),
    ("model", Verdict::Model),
];

/// The largest number of names that a repair may exchange or add.
const MOST_NAMES: usize = 40;

/// Reads an entry and every formula in it.
pub(super) fn read(reading: &mut Reading, node: &Node) -> Result<Item, StudyError> {
    only(node, KEYS)?;
    let id = reading.id(node)?;
    required(node, "place")?;
    let kind = word(node.get("kind"), &KINDS, Kind::Formula)?;
    let mut item = Item::new(id, text(node, "place")?, kind);
    item.origin = Some((reading.file, node.place.line));
    item.claim = text(node, "claims")?;
    item.note = text(node, "note")?;
    item.definitions = reading.definitions(node.get("with"))?;
    item.expected = word(node.get("verdict"), &VERDICTS, Verdict::Proved)?;
    let printed = printed(node, &mut item)?;
    item.names = names(&reading.symbols.names, &item, printed)?;
    item.conditions = Arc::new(reading.symbols.conditions(truth(node, "values")?));
    let requirements = texts(node.get("requires"));
    for requirement in &requirements {
        let text = requirement.text()?;
        let read = Requirement::read(text, &item.names);
        read.map_err(|e| fault(e, requirement, &item.names))?;
        item.requirements.push(text.into());
    }
    facts(node, &mut item)?;
    let needs_none = match item.expected {
        Verdict::Definition | Verdict::Undefined => true,
        Verdict::Model => !item.facts.is_empty(),
        _ => false,
    };
    if requirements.is_empty() && !needs_none {
        let reason = format!(
            "the entry {id} has no requirement: requires = [...], or a verdict \"definition\", \
             \"undefined\", or \"model\" with also = [...]"
        );
        return Err(node.fault(reason));
    }
    repair(node, &mut item)?;
    item.dimensions = dimensions(reading, node, &item)?;
    check_definitions(node, &item, printed)?;
    Ok(item)
}

/// The units of the symbols, with that of the name that the printed form defines.
fn dimensions(
    reading: &Reading,
    node: &Node,
    item: &Item,
) -> Result<Option<Arc<Dimensions>>, StudyError> {
    let units = reading.symbols.dimensions.clone();
    let Some(text) = node.get("unit") else {
        return Ok(units);
    };
    let found = unit(text.text()?).map_err(|e| text.fault(e.to_string()))?;
    let name = item.printed.and_then(defined);
    let (Some(units), Some(name)) = (units, name) else {
        return Err(
            text.fault("a unit of the printed name needs a printed form, and units of the symbols")
        );
    };
    let mut units = (*units).clone();
    units.declare(name, &found);
    Ok(Some(Arc::new(units)))
}

fn printed<'a>(node: &'a Node, item: &mut Item) -> Result<Option<&'a Node>, StudyError> {
    let found = match (node.get("printed"), node.get("composed")) {
        (Some(_), Some(other)) => {
            return Err(other.fault("an entry has printed or composed, not both"));
        }
        (Some(printed), None) => Some(printed),
        (None, composed) => {
            item.composed = composed.is_some();
            composed
        }
    };
    item.printed = found.map(|node| node.text().map(intern)).transpose()?;
    Ok(found)
}

/// The names that formulas of the entry may use: symbols, definitions, and the printed name.
fn names(declared: &Names, item: &Item, printed: Option<&Node>) -> Result<Names, StudyError> {
    let own = item.definitions.iter().filter_map(|text| defined(text));
    let mut more: Vec<String> = own.map(String::from).collect();
    if let (Some(text), Some(node)) = (item.printed, printed) {
        let left = text.split('=').next().unwrap_or(text).trim();
        if is_name(left, node).is_ok() {
            more.push(left.into());
        }
        more.extend(["left".into(), "right".into()]);
    }
    Ok(declared.with(more))
}

fn facts(node: &Node, item: &mut Item) -> Result<(), StudyError> {
    for fact in texts(node.get("also")) {
        let (place, outcome) = match fact.value {
            Value::Table(_) => {
                fact.only(&["refuted"])?;
                (required(fact, "refuted")?, Outcome::Refuted)
            }
            _ => (fact, Outcome::Proved),
        };
        let text = place.text()?;
        let read = Requirement::read(text, &item.names);
        read.map_err(|e| fault(e, place, &item.names))?;
        item.facts.push((intern(text), outcome));
    }
    Ok(())
}

fn repair(node: &Node, item: &mut Item) -> Result<(), StudyError> {
    if let Some(repair) = node.get("repair") {
        let text = repair.text()?;
        let read = item.names.equation(text);
        read.map_err(|e| fault(e, repair, &item.names))?;
        item.repair = Some(intern(text));
        if item.expected != Verdict::Misprint {
            return Err(repair.fault("a repair belongs to an entry with verdict = \"misprint\""));
        }
    }
    if let Some(edits) = node.get("edits") {
        item.most_edits = match count(edits, 2)? {
            0 => return Err(edits.fault("a repair has 1 or 2 edits")),
            n => n as usize,
        };
    }
    let confused = texts(node.get("confused"));
    let confused = confused.into_iter().map(Node::text);
    let confused = confused.collect::<Result<Vec<_>, _>>()?;
    let family = Family::new(&confused, text(node, "missing")?);
    let names = family.confused.iter().map(Vec::len).sum::<usize>() + family.missing.len();
    if names > MOST_NAMES {
        return Err(node.fault(format!(
            "confused and missing have {names} names, at most {MOST_NAMES}"
        )));
    }
    item.family = Some(family);
    Ok(())
}

/// Refuses definitions that cannot be read and those that lead back to themselves.
fn check_definitions(node: &Node, item: &Item, printed: Option<&Node>) -> Result<(), StudyError> {
    let with = node.get("with").unwrap_or(node);
    let mut definitions = item
        .names
        .definitions(&item.definitions)
        .map_err(|e| fault(e, with, &item.names))?;
    let mut place = with;
    if let (Some(text), Some(node)) = (item.printed, printed) {
        let form = item.names.equation(text);
        let form = form.map_err(|e| fault(e, node, &item.names))?;
        if let Expr::Sym(name) = &form.left {
            definitions.set(name, form.right);
            place = node;
        }
    }
    match circular(&definitions) {
        Some(name) => Err(place.fault(format!("the definition of {name} leads back to {name}"))),
        None => Ok(()),
    }
}

/// A name whose definition leads back to it.
pub(super) fn circular(definitions: &Definitions) -> Option<&str> {
    let mut names = definitions.names.iter();
    names
        .find(|(name, e)| definitions.reaches(e, &[name]))
        .map(|(name, _)| name.as_str())
}

/// A fault of a formula, at its place in the file.
pub(super) fn fault(error: SymbolicError, node: &Node, names: &Names) -> StudyError {
    fault_in(error, node.place, &names.all())
}

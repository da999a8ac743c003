//! The symbols of a paper: meaning, unit, domain, and the value as printed.

use super::read::{ends, required, word};
use crate::papers::ledger::{Conditions, Domain, Names};
use crate::study::document::{Item as Node, Value};
use crate::study::{Place, StudyError, is_name};
use crate::symbolic::{Dimensions, Expr, number, parse_declared, unit};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A declared symbol.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Its name in formulas.
    pub name: String,
    /// Its meaning.
    pub means: String,
    /// Its unit, where one is stated.
    pub unit: Option<String>,
    /// Its values, where they are not all positive numbers.
    pub domain: Option<Domain>,
    /// Its value as printed: the text and the number.
    pub value: Option<(String, Expr)>,
    /// The line in the first file.
    pub place: Place,
}

/// The longest name of a symbol in the algebra.
const LONGEST: usize = 16;

/// Reads `[symbols]`.
pub(super) fn read(file: &Node) -> Result<Vec<Symbol>, StudyError> {
    let mut all = Vec::new();
    for (name, node) in file.get("symbols").map_or(Ok(&[][..]), Node::table)? {
        is_name(name, node)?;
        if name.len() > LONGEST {
            let reason = format!("the name {name} has more than {LONGEST} characters");
            return Err(node.fault(reason));
        }
        if ["i", "pi", "inf", "left", "right"].contains(&name.as_str()) {
            return Err(node.fault(format!("the name {name} has a meaning of its own")));
        }
        all.push(symbol(name, node)?);
    }
    Ok(all)
}

fn symbol(name: &str, node: &Node) -> Result<Symbol, StudyError> {
    let mut symbol = Symbol {
        name: name.into(),
        means: String::new(),
        unit: None,
        domain: None,
        value: None,
        place: node.place,
    };
    // The meaning alone, as a text.
    if !matches!(node.value, Value::Table(_)) {
        symbol.means = node.text()?.into();
        return Ok(symbol);
    }
    node.only(&["means", "unit", "domain", "value"])?;
    symbol.means = required(node, "means")?.text()?.into();
    symbol.unit = node
        .get("unit")
        .map(Node::text)
        .transpose()?
        .map(String::from);
    symbol.domain = node.get("domain").map(domain).transpose()?.flatten();
    if let Some(value) = node.get("value") {
        let text = value.text()?;
        let read = parse_declared(text, &|_| false);
        let read = read.map_err(|e| crate::study::fault_in(e, value.place, &[]));
        // A number with a sign is no text of the language.
        let read = match text.strip_prefix('-').and_then(number) {
            Some(_) => Expr::Neg(Box::new(Expr::Num(text.trim_start_matches('-').into()))),
            None => read?,
        };
        symbol.value = Some((text.into(), read));
    }
    Ok(symbol)
}

fn domain(node: &Node) -> Result<Option<Domain>, StudyError> {
    if let Value::List(_) = node.value {
        let [low, high] = ends(node)?;
        return match low < high {
            true => Ok(Some(Domain::Between(low, high))),
            false => Err(node.fault("the domain is empty: its first end is the smaller one")),
        };
    }
    match node.text()? {
        "positive" => Ok(None),
        "real" => Ok(Some(Domain::Real)),
        "integer" => Ok(Some(Domain::Integer)),
        other => Err(node.fault(format!(
            "the domain {other:?} is none of: \"positive\", \"real\", \"integer\", [from, to]"
        ))),
    }
}

/// The facts about symbols that formulas need.
#[derive(Clone, Debug)]
pub(super) struct Symbols {
    /// The declared names; any name without `[symbols]`.
    pub names: Names,
    domains: BTreeMap<String, Domain>,
    /// The printed values.
    pub values: BTreeMap<String, Expr>,
    /// The units, where the file states any.
    pub dimensions: Option<Arc<Dimensions>>,
}

/// The units of the symbols, of which either none or each has one.
pub(super) fn dimensions(
    file: &Node,
    symbols: &[Symbol],
) -> Result<Option<Arc<Dimensions>>, StudyError> {
    let mut units = Dimensions::default();
    let kinds = [("quantities", false), ("numbers", true)];
    units.numbers = word(file.get("units"), &kinds, false)?;
    if symbols.iter().all(|s| s.unit.is_none()) {
        return match file.get("units") {
            Some(node) => Err(node.fault("no symbol has a unit")),
            None => Ok(None),
        };
    }
    // A symbol that is its meaning alone is a pure number.
    let is_plain = |name: &str| {
        let node = file.get("symbols").and_then(|table| table.get(name));
        node.is_some_and(|node| !matches!(node.value, Value::Table(_)))
    };
    for symbol in symbols {
        let plain = is_plain(&symbol.name).then_some("1");
        let Some(text) = symbol.unit.as_deref().or(plain) else {
            let name = &symbol.name;
            let reason = format!(
                "{name} has no unit where others have one; a pure number has the unit \"1\""
            );
            return Err(StudyError::new(reason).at(symbol.place));
        };
        let found = unit(text)
            .map_err(|e| StudyError::new(format!("{}: {e}", symbol.name)).at(symbol.place))?;
        units.declare(&symbol.name, &found);
    }
    Ok(Some(Arc::new(units)))
}

impl Symbols {
    pub fn new(symbols: &[Symbol], declared: bool, dimensions: Option<Arc<Dimensions>>) -> Symbols {
        let named = symbols.iter().map(|s| s.name.clone());
        Symbols {
            dimensions,
            names: match declared {
                true => Names::declared(named),
                false => Names::default(),
            },
            domains: symbols
                .iter()
                .filter_map(|s| Some((s.name.clone(), s.domain.clone()?)))
                .collect(),
            values: symbols
                .iter()
                .filter_map(|s| Some((s.name.clone(), s.value.clone()?.1)))
                .collect(),
        }
    }

    /// The conditions of an entry; with the printed values put in if asked for.
    pub fn conditions(&self, values: bool) -> Conditions {
        Conditions {
            domains: self.domains.clone(),
            values: match values {
                true => self.values.clone(),
                false => BTreeMap::new(),
            },
        }
    }
}

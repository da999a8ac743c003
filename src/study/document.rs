//! TOML with places: a tree whose tables keep the order of the file, for studies and for papers.

use super::error::{Place, StudyError};
use super::problem::intern;
use super::read::rational;
use rug::Rational;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value with its place.
#[derive(Clone, Debug)]
pub struct Item {
    /// Where it begins.
    pub place: Place,
    /// The value.
    pub value: Value,
}

/// A value.
#[derive(Clone, Debug)]
pub enum Value {
    /// A string.
    Text(String),
    /// A number as it is written.
    Number(String),
    /// True or false.
    Truth(bool),
    /// A list.
    List(Vec<Item>),
    /// A table.
    Table(Vec<(String, Item)>),
}

/// The longest text that is read, in bytes.
pub const LONGEST: usize = 4 << 20;

/// Reads a text.
///
/// # Errors
/// The place and the rule of TOML that the text breaks; a text of more than [`LONGEST`] bytes.
pub fn read(text: &str) -> Result<Item, StudyError> {
    if text.len() > LONGEST {
        let reason = format!("{} bytes where at most {LONGEST} are read", text.len());
        return Err(StudyError::new(reason));
    }
    let table = DeTable::parse(text).map_err(|e| {
        let at = e.span().map_or(0, |span| span.start);
        StudyError::new(e.message().to_string()).at(Place::of(text, at))
    })?;
    Ok(Item {
        place: Place { line: 1, column: 1 },
        value: self::table(text, table.get_ref()),
    })
}

fn table(text: &str, table: &DeTable<'_>) -> Value {
    let mut entries: Vec<_> = table.iter().collect();
    entries.sort_by_key(|(key, _)| key.span().start);
    let entries = entries.into_iter();
    Value::Table(
        entries
            .map(|(key, value)| (key.get_ref().to_string(), item(text, value)))
            .collect(),
    )
}

fn item(text: &str, value: &Spanned<DeValue<'_>>) -> Item {
    let place = Place::of(text, value.span().start);
    let value = match value.get_ref() {
        DeValue::String(s) => Value::Text(s.to_string()),
        DeValue::Integer(n) => Value::Number(match n.radix() {
            16 => format!("0x{}", n.as_str()),
            _ => n.as_str().to_string(),
        }),
        DeValue::Float(x) => Value::Number(x.as_str().to_string()),
        DeValue::Boolean(b) => Value::Truth(*b),
        DeValue::Datetime(d) => Value::Text(d.to_string()),
        DeValue::Array(items) => Value::List(items.iter().map(|x| item(text, x)).collect()),
        DeValue::Table(t) => self::table(text, t),
    };
    Item { place, value }
}

impl Item {
    /// A fault here.
    pub fn fault(&self, reason: impl Into<String>) -> StudyError {
        StudyError::new(reason).at(self.place)
    }

    /// The text of a string, or of a number.
    ///
    /// # Errors
    /// A value of another kind, as for [`Item::table`] and [`Item::list`].
    pub fn text(&self) -> Result<&str, StudyError> {
        match &self.value {
            Value::Text(s) | Value::Number(s) => Ok(s),
            _ => Err(self.fault("expected a string or a number")),
        }
    }

    /// The entries of a table.
    ///
    /// # Errors
    /// A value of another kind.
    pub fn table(&self) -> Result<&[(String, Item)], StudyError> {
        match &self.value {
            Value::Table(entries) => Ok(entries),
            _ => Err(self.fault("expected a table")),
        }
    }

    /// The items of a list.
    ///
    /// # Errors
    /// A value of another kind.
    pub fn list(&self) -> Result<&[Item], StudyError> {
        match &self.value {
            Value::List(items) => Ok(items),
            _ => Err(self.fault("expected a list")),
        }
    }

    /// The entry of a key in a table.
    pub fn get(&self, key: &str) -> Option<&Item> {
        let Value::Table(entries) = &self.value else {
            return None;
        };
        entries.iter().find(|e| e.0 == key).map(|e| &e.1)
    }

    /// Refuses keys that are not known.
    ///
    /// # Errors
    /// The first unknown key, with the nearest known one.
    pub fn only(&self, known: &[&str]) -> Result<(), StudyError> {
        for (key, item) in self.table()? {
            if !known.contains(&key.as_str()) {
                let hint = crate::audit::did_you_mean(key, known);
                let known = known.join(", ");
                return Err(item.fault(format!(
                    "there is no key {key:?}{hint} here; there are: {known}"
                )));
            }
        }
        Ok(())
    }
}

/// Refuses keys other than these, which are separated by blanks.
///
/// # Errors
/// As [`Item::only`].
pub fn only(node: &Item, keys: &str) -> Result<(), StudyError> {
    node.only(&keys.split_whitespace().collect::<Vec<_>>())
}

/// A key that has to be there.
///
/// # Errors
/// The key is missing.
pub fn required<'a>(node: &'a Item, key: &str) -> Result<&'a Item, StudyError> {
    node.get(key)
        .ok_or_else(|| node.fault(format!("the key {key:?} is missing")))
}

/// A text that may be missing, kept for good.
///
/// # Errors
/// As [`Item::text`].
pub fn text(node: &Item, key: &str) -> Result<&'static str, StudyError> {
    node.get(key).map_or(Ok(""), |item| item.text().map(intern))
}

/// The texts of a list, or one text; nothing if it is missing.
pub fn texts(node: Option<&Item>) -> Vec<&Item> {
    match node {
        None => Vec::new(),
        Some(node) => match &node.value {
            Value::List(items) => items.iter().collect(),
            _ => vec![node],
        },
    }
}

/// True or false; false if it is missing.
///
/// # Errors
/// A value of another kind.
pub fn truth(node: &Item, key: &str) -> Result<bool, StudyError> {
    match node.get(key).map(|item| (&item.value, item)) {
        None => Ok(false),
        Some((Value::Truth(b), _)) => Ok(*b),
        Some((_, item)) => Err(item.fault("expected true or false")),
    }
}

/// A number without sign that is not larger than a limit.
///
/// # Errors
/// Another text, and a larger number.
pub fn count(node: &Item, most: u32) -> Result<u32, StudyError> {
    let text = node.text()?;
    match text.parse::<u32>() {
        Ok(n) if n <= most => Ok(n),
        _ => Err(node.fault(format!("{text:?} is no number from 0 to {most}"))),
    }
}

/// One of some words.
///
/// # Errors
/// A text that is none of the words.
pub fn word<T: Copy>(
    node: Option<&Item>,
    words: &[(&str, T)],
    default: T,
) -> Result<T, StudyError> {
    let Some(node) = node else { return Ok(default) };
    let text = node.text()?;
    let found = words.iter().find(|w| w.0 == text);
    found.map(|w| w.1).ok_or_else(|| {
        let known: Vec<&str> = words.iter().map(|w| w.0).collect();
        let known = known.join(", ");
        node.fault(format!("{text:?} is none of: {known}"))
    })
}

/// The two ends of a range, `[from, to]`.
///
/// # Errors
/// Anything else than a list of two numbers.
pub fn ends(node: &Item) -> Result<[Rational; 2], StudyError> {
    match node.list()? {
        [low, high] => Ok([rational(low)?, rational(high)?]),
        _ => Err(node.fault("expected two ends: [from, to]")),
    }
}

//! The text of a description, in TOML or JSON, and refusals that name the value, the rule and the
//! line.

use crate::audit::did_you_mean;
use serde::de::DeserializeOwned;
use std::error::Error;
use std::fmt;
use std::io::Read;
use std::path::Path;

/// How a description is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// TOML.
    Toml,
    /// JSON.
    Json,
}

/// The text of a description.
#[derive(Clone, Debug)]
pub struct Source {
    text: String,
    form: Form,
}

/// Texts longer than this describe no machine.
const LONGEST: u64 = 1 << 20;

/// Why there is no text to read a description from.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// It cannot be read.
    #[error("{0}")]
    Read(#[from] std::io::Error),
    /// It is longer than 1 MiB.
    #[error("the file is longer than 1 MiB")]
    TooLong,
    /// It is not text.
    #[error("the file is not UTF-8 text (at byte {at})")]
    NotUtf8 {
        /// The number of bytes that are text.
        at: usize,
        /// The fault of the next one.
        source: std::string::FromUtf8Error,
    },
    /// It holds nothing.
    #[error("the file is empty")]
    Empty,
}

/// A description that is refused: in one line where, which value and by which rule.
#[derive(Debug)]
pub struct Refusal {
    line: Option<usize>,
    place: String,
    rule: String,
    source: Option<Cause>,
}

type Cause = Box<dyn Error + Send + Sync>;

impl Refusal {
    /// The line, counted from 1, where it is known.
    pub fn line(&self) -> Option<usize> {
        self.line
    }

    /// The value or section, such as `geometry.l5`; empty for the whole file.
    pub fn place(&self) -> &str {
        &self.place
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.rule),
            None => f.write_str(&self.rule),
        }
    }
}

impl Error for Refusal {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.source.as_deref().map(|e| e as &(dyn Error + 'static))
    }
}

impl Source {
    /// A description in TOML.
    pub fn toml(text: impl Into<String>) -> Source {
        let (text, form) = (text.into(), Form::Toml);
        Source { text, form }
    }

    /// A description in JSON.
    pub fn json(text: impl Into<String>) -> Source {
        let (text, form) = (text.into(), Form::Json);
        Source { text, form }
    }

    /// The file's text; its form by its extension, else as [`read`](Source::read) tells it.
    ///
    /// # Errors
    /// [`SourceError`].
    pub fn open(path: &Path) -> Result<Source, SourceError> {
        let form = match path.extension().and_then(|e| e.to_str()) {
            Some("json") => Some(Form::Json),
            Some("toml") => Some(Form::Toml),
            _ => None,
        };
        Source::read(std::fs::File::open(path)?, form)
    }

    /// All that can be read; without a form it is JSON if it begins with a brace, else TOML.
    ///
    /// # Errors
    /// [`SourceError`].
    pub fn read(from: impl Read, form: Option<Form>) -> Result<Source, SourceError> {
        let mut bytes = Vec::new();
        from.take(LONGEST + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > LONGEST {
            return Err(SourceError::TooLong);
        }
        let text = String::from_utf8(bytes).map_err(|source| SourceError::NotUtf8 {
            at: source.utf8_error().valid_up_to(),
            source,
        })?;
        let text = text.trim_start_matches('\u{feff}');
        if text.trim().is_empty() {
            return Err(SourceError::Empty);
        }
        let form = form.unwrap_or(match text.trim_start().starts_with('{') {
            true => Form::Json,
            false => Form::Toml,
        });
        let text = text.to_owned();
        Ok(Source { text, form })
    }

    /// Reads the fields of `T`.
    pub(crate) fn parse<T: DeserializeOwned>(&self) -> Result<T, Refusal> {
        match self.form {
            Form::Toml => {
                let file = toml::Deserializer::parse(&self.text);
                let file = file.map_err(|e| self.refused_toml("", e))?;
                serde_path_to_error::deserialize(file).map_err(|e| {
                    let place = e.path().to_string();
                    self.refused_toml(&place, e.into_inner())
                })
            }
            Form::Json => {
                let mut file = serde_json::Deserializer::from_str(&self.text);
                let value = serde_path_to_error::deserialize(&mut file).map_err(|e| {
                    let place = e.path().to_string();
                    refused_json(&place, e.into_inner())
                })?;
                file.end().map_err(|e| refused_json("", e))?;
                Ok(value)
            }
        }
    }

    fn refused_toml(&self, place: &str, e: toml::de::Error) -> Refusal {
        let line = e.span().map(|s| self.line_at(s.start));
        let message = e.message().to_owned();
        refused(place, line, &message, e.into())
    }

    fn line_at(&self, byte: usize) -> usize {
        self.text[..byte].matches('\n').count() + 1
    }

    /// A refusal of what stands in this place, whose cause says what is wrong with it.
    pub(super) fn refuse(&self, place: &str, cause: impl Error + Send + Sync + 'static) -> Refusal {
        Refusal {
            line: self.line_of(place),
            rule: format!("{place}: {cause}"),
            place: place.into(),
            source: Some(cause.into()),
        }
    }

    /// A refusal of what stands in this place by a rule of the file.
    pub(crate) fn breach(&self, place: &str, rule: impl Into<String>) -> Refusal {
        Refusal {
            line: self.line_of(place),
            place: place.into(),
            rule: rule.into(),
            source: None,
        }
    }

    /// The line of what stands in this place, or of the innermost section there is around it.
    fn line_of(&self, place: &str) -> Option<usize> {
        // JSON is no TOML, so nothing of it is found: no line begins with a brace.
        let file = toml::de::DeTable::parse(&self.text).ok()?;
        let mut section = file.get_ref();
        let mut found = None;
        for key in place.split('.') {
            // A member of an array of sections: name[k].
            let (name, index) = match key.strip_suffix(']').and_then(|k| k.split_once('[')) {
                Some((name, k)) => (name, k.parse::<usize>().ok()),
                None => (key, None),
            };
            let Some((key, value)) = section.get_key_value(name) else {
                break;
            };
            let member = index.and_then(|k| value.get_ref().as_array()?.get(k));
            found = Some(member.map_or(key.span().start, |m| m.span().start));
            match member.unwrap_or(value).get_ref().as_table() {
                Some(inner) => section = inner,
                None => break,
            }
        }
        found.map(|byte| self.line_at(byte))
    }
}

fn refused_json(place: &str, e: serde_json::Error) -> Refusal {
    let whole = e.to_string();
    let position = format!(" at line {} column {}", e.line(), e.column());
    let message = whole.strip_suffix(&position).unwrap_or(&whole).to_owned();
    let line = (e.line() > 0).then(|| e.line());
    refused(place, line, &message, e.into())
}

/// A refusal by a reader of files: on one line and without the names of Rust's types.
fn refused(place: &str, line: Option<usize>, message: &str, source: Cause) -> Refusal {
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    // The path of the whole file is a point.
    let place = place.trim_start_matches('.');
    // A section missing from the whole file is missing on no line.
    let nowhere = place.is_empty() && message.starts_with("missing field");
    Refusal {
        line: line.filter(|_| !nowhere),
        place: place.into(),
        rule: in_words(place, &message),
        source: Some(source),
    }
}

/// The message of serde, in the words of the file.
fn in_words(place: &str, message: &str) -> String {
    if let Some(field) = quoted_after(message, "missing field `") {
        return match place {
            // All that the file itself has to have are sections.
            "" => format!("the section [{field}] is missing"),
            section => format!("{section}.{field} is missing"),
        };
    }
    let expected = message.split_once(", expected ").map(|p| p.1);
    let known = |text: &str| -> Vec<String> {
        let names = text.split('`').skip(1).step_by(2);
        names.map(String::from).collect()
    };
    if let (Some(name), Some(expected)) = (quoted_after(message, "unknown field `"), expected) {
        let known = known(expected);
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let meant = did_you_mean(name, &known);
        return format!("unknown field `{name}`{meant}, expected {expected}");
    }
    if let (Some(name), Some(expected)) = (quoted_after(message, "unknown variant `"), expected) {
        let known = known(expected);
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let meant = did_you_mean(name, &known);
        let all: Vec<String> = known.iter().map(|n| format!("{n:?}")).collect();
        let all = match &all[..] {
            [a, b] => format!("{a} or {b}"),
            all => format!("one of {}", all.join(", ")),
        };
        return format!("{place} = {name:?}{meant} must be {all}");
    }
    match (place, message.starts_with('"')) {
        ("", _) => message.into(),
        // A quantity, quoted as it is written.
        (_, true) => format!("{place} = {message}"),
        (_, false) => format!("{place}: {}", without_types(message)),
    }
}

/// The text between backticks after the words that the message begins with.
fn quoted_after<'a>(message: &'a str, words: &str) -> Option<&'a str> {
    message.strip_prefix(words)?.split('`').next()
}

fn without_types(message: &str) -> String {
    let Some((before, expected)) = message.rsplit_once("expected ") else {
        return message.into();
    };
    let kind = match expected {
        "f64" => "a number",
        "usize" | "u32" | "u64" => "a whole number, 0 or more",
        _ => return message.into(),
    };
    format!("{before}expected {kind}")
}

#[cfg(test)]
mod tests;

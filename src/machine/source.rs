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
        /// How many bytes are text.
        at: usize,
        /// What is wrong with the next.
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
        if self.form == Form::Json {
            return None;
        }
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
    // What the whole file has not got is missing on no line.
    let nowhere = place.is_empty() && message.starts_with("missing field");
    Refusal {
        line: line.filter(|_| !nowhere),
        place: place.into(),
        rule: in_words(place, &message),
        source: Some(source),
    }
}

/// What serde says, in the words of the file.
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

/// What stands between backticks after the words that the message begins with.
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
mod tests {
    use super::*;
    use crate::machine::quantity::Quantity;
    use crate::solvers::units::Length;
    use serde::Deserialize;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        geometry: Geometry,
        #[serde(default)]
        _kind: Choice,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Geometry {
        crank: Quantity<Length>,
        #[serde(default)]
        points: Vec<Quantity<Length>>,
        #[serde(default)]
        _count: u32,
    }

    #[derive(Debug, Default, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Choice {
        #[default]
        Linear,
        Cubic,
    }

    #[test]
    fn refusals_name_value_rule_and_line() {
        for (toml, json, line, place, rule) in [
            (
                "[geometry]\n\ncrank = \"1 kg\"\n",
                "{\"geometry\":\n\n{\"crank\": \"1 kg\"}}",
                3,
                "geometry.crank",
                "geometry.crank = \"1 kg\" is not a length",
            ),
            (
                "[geometry]\ncrank = 7\n",
                "{\"geometry\":\n{\"crank\": 7}}",
                2,
                "geometry.crank",
                "geometry.crank = \"7\" has no unit",
            ),
            (
                "[geometry]\ncrank = \"1 m\"\npoints = [\n\"1 m\",\n\"x\"]",
                "{\"geometry\":\n{\"crank\": \"1 m\",\n\"points\": [\"1 m\"\n,\n\"x\"]}}",
                5,
                "geometry.points[1]",
                "geometry.points[1] = \"x\" does not begin with a decimal number",
            ),
            (
                "\n[geometry]\n",
                "{\n\"geometry\": {}}",
                2,
                "geometry",
                "geometry.crank is missing",
            ),
            (
                "[geometry]\ncrank = \"1 m\"\n_count = -1\n",
                "{\"geometry\":\n{\"crank\": \"1 m\",\n\"_count\": -1}}",
                3,
                "geometry._count",
                "integer `-1`, expected a whole number, 0 or more",
            ),
            (
                "_kind = \"cubik\"\n",
                "{\"_kind\": \"cubik\"}",
                1,
                "_kind",
                "_kind = \"cubik\" (did you mean \"cubic\"?) must be \"linear\" or \"cubic\"",
            ),
        ] {
            for source in [Source::toml(toml), Source::json(json)] {
                let e = source.parse::<File>().unwrap_err();
                let text = e.to_string();
                assert_eq!((e.line(), e.place()), (Some(line), place), "{text}");
                assert!(text.contains(rule), "{text}");
                assert!(!text.contains('\n') && e.source().is_some());
            }
        }
        let good = "[geometry]\ncrank = \"1 m\"\npoints = [\"1 cm\"]\n";
        let file: File = Source::toml(good).parse().unwrap();
        let read = (file.geometry.crank.to_f64(), file.geometry.points.len());
        assert_eq!(read, (1.0, 1));
        for source in [
            Source::toml("[geometri]\ncrank = \"1 m\""),
            Source::json("{\"geometri\": {}}"),
        ] {
            let e = source.parse::<File>().unwrap_err();
            let due = "line 1: unknown field `geometri` (did you mean \"geometry\"?), expected";
            assert!(e.to_string().starts_with(due), "{e}");
        }
        for source in [Source::toml("_kind = \"cubic\""), Source::json("{}")] {
            let e = source.parse::<File>().unwrap_err();
            assert_eq!(e.to_string(), "the section [geometry] is missing");
        }
    }

    #[test]
    fn places_are_found() {
        let source = Source::toml("a = 1\n[b]\n\nc = 2\n[b.d]\ne = { f = 3 }\n");
        for (place, line) in [("a", 1), ("b", 2), ("b.c", 4), ("b.d.e", 6), ("b.x", 2)] {
            assert_eq!(source.line_of(place), Some(line), "{place}");
        }
        assert_eq!(source.line_of("x"), None);
        let source = Source::toml("[[b]]\nc = 1\n[[b]]\n\nc = 2\n");
        for (place, line) in [
            ("b[0].c", 2),
            ("b[1]", 3),
            ("b[1].c", 5),
            ("b[1].x", 3),
            ("b[7]", 1),
        ] {
            assert_eq!(source.line_of(place), Some(line), "{place}");
        }
        assert_eq!(Source::json("{\"a\": 1}").line_of("a"), None);
    }

    #[test]
    fn texts() {
        let read = |bytes: &[u8]| Source::read(bytes, None);
        assert_eq!(read(b" {}").unwrap().form, Form::Json);
        assert_eq!(read("\u{feff}a = 1".as_bytes()).unwrap().text, "a = 1");
        let long = vec![b'#'; LONGEST as usize + 1];
        for (bytes, part) in [
            (&b"\n"[..], "empty"),
            (b"a\xff", "not UTF-8 text (at byte 1)"),
            (&long, "longer than 1 MiB"),
        ] {
            let e = read(bytes).unwrap_err().to_string();
            assert!(e.contains(part), "{e}");
        }
    }
}

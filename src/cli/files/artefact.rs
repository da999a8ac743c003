//! A generated file: its header, and the check against it.

use mechaudit::audit::{Origin, Uncertified};
use mechaudit::reference::Ball;
use mechaudit::report::words::numbers::clipped;
use serde_json::{Map, Value};
use sha2::{Digest, Sha256};
use std::error::Error;
use std::path::PathBuf;

/// A calculation that may stay undecided.
pub type Outcome<T> = Result<T, Box<dyn Error + Send + Sync>>;

/// The reason why a file cannot be made, where no layer below gives it.
#[derive(Debug, thiserror::Error)]
pub enum MakeError {
    #[error("there is no paper {0:?}")]
    NoPaper(&'static str),
    #[error("the content is no JSON object")]
    NoObject,
    #[error("{what}: a rounding is undecided at {bits} bits")]
    Rounding { what: String, bits: u32 },
    #[error("{digits} digits are undecided at {bits} bits")]
    Digits { digits: usize, bits: u32 },
    #[error("{what} is not an f64")]
    NotExact { what: String },
    #[error("the polynomials leave out {0:e}")]
    LeftOut(f64),
    #[error("{0:?} is no case of a region")]
    NotOfRegion(Origin),
    #[error("{case}")]
    Case { case: String, source: Uncertified },
    #[error("{case}: value {value} is undecided")]
    Value { case: String, value: usize },
}

/// The result of a recipe.
pub struct Made {
    /// The contents of the file.
    pub title: String,
    /// Precision, seed, counts.
    pub facts: Vec<(&'static str, String)>,
    /// Everything that the file depends on but the code.
    pub recipe: String,
    /// The file without its header.
    pub body: String,
}

/// The form of a header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    Csv,
    Rust,
    Json,
    /// A chapter of the book, which has no header.
    Chapter,
}

/// A generated file.
pub struct Artefact {
    pub name: String,
    /// Under the folder of the sources.
    pub path: PathBuf,
    pub form: Form,
    pub make: Box<dyn Fn() -> Outcome<Made>>,
}

const RECIPE: &str = "SHA-256 of the recipe: ";
const CONTENT: &str = "SHA-256 of all lines below: ";

impl Artefact {
    /// The whole file, made anew.
    pub fn text(&self) -> Outcome<String> {
        document(&self.name, self.form, &(self.make)()?)
    }
}

/// A file with its header.
pub fn document(name: &str, form: Form, made: &Made) -> Outcome<String> {
    if form == Form::Chapter {
        return Ok(made.body.clone());
    }
    let command = format!("mechaudit regenerate {name}");
    let version = env!("CARGO_PKG_VERSION");
    if form == Form::Json {
        let mut header = Map::new();
        let mut put = |key: &str, value: &str| header.insert(key.into(), value.into());
        put("title", &made.title);
        put("made_by", &command);
        put("mechaudit_version", version);
        for (key, value) in &made.facts {
            put(key, value);
        }
        put("recipe_sha256", &digest(&made.recipe));
        put("content_sha256", &digest(&made.body));
        let mut whole = Map::new();
        whole.insert("generated".into(), header.into());
        let Value::Object(content) = serde_json::from_str(&made.body)? else {
            return Err(MakeError::NoObject.into());
        };
        whole.extend(content);
        return Ok(serde_json::to_string_pretty(&whole)? + "\n");
    }
    let title = made.title.lines().map(str::to_string);
    let facts = made.facts.iter().map(|(k, v)| format!("{k}: {v}"));
    let lines = title
        .chain([
            String::new(),
            format!("Made by `{command}` (mechaudit {version}); not to be edited."),
        ])
        .chain(facts)
        .chain([
            format!("{RECIPE}{}", digest(&made.recipe)),
            format!("{CONTENT}{}", digest(&made.body)),
        ]);
    let mark = if form == Form::Rust { "//!" } else { "#" };
    let header: Vec<String> = lines
        .map(|l| format!("{mark} {l}").trim_end().to_string())
        .collect();
    Ok(format!("{}\n{}", header.join("\n"), made.body))
}

/// Returns certified digits of a number known to `bits` bits.
pub fn certified(ball: &Ball, digits: usize, bits: u32) -> Result<String, MakeError> {
    ball.to_decimal(digits)
        .ok_or(MakeError::Digits { digits, bits })
}

/// SHA-256 in hexadecimal.
pub fn digest(text: &str) -> String {
    let bytes = Sha256::digest(text.as_bytes());
    bytes.iter().map(|b| format!("{b:02x}")).collect()
}

/// Returns the fault of the digest in a file's header, if there is one.
pub fn broken(form: Form, text: &str) -> Option<String> {
    let (said, content) = match form {
        Form::Chapter => return None,
        Form::Json => {
            let Ok(Value::Object(mut whole)) = serde_json::from_str(text) else {
                return Some("it is no JSON object".into());
            };
            let header = whole.shift_remove("generated");
            let said = header.and_then(|h| Some(h["content_sha256"].as_str()?.to_string()));
            let content = serde_json::to_string_pretty(&whole).unwrap_or_default() + "\n";
            (said, content)
        }
        Form::Csv | Form::Rust => {
            let found = text.split_once(CONTENT);
            let found = found.and_then(|(_, rest)| rest.split_once('\n'));
            let (said, content) = found.unwrap_or_default();
            let said = (!said.is_empty()).then(|| said.to_string());
            (said, content.to_string())
        }
    };
    match said {
        None => Some("there is no digest in its header".into()),
        Some(said) if said != digest(&content) => {
            Some("its content does not match the digest in its header".into())
        }
        Some(_) => None,
    }
}

/// The first place where a file differs from what it should be.
pub fn difference(found: &str, due: &str) -> Option<String> {
    if found == due {
        return None;
    }
    let (mut a, mut b) = (found.split('\n'), due.split('\n'));
    let mut line = 0;
    loop {
        line += 1;
        let (x, y) = (a.next(), b.next());
        if x == y && x.is_some() {
            continue;
        }
        let (x, y) = (x.unwrap_or("(the end)"), y.unwrap_or("(the end)"));
        let same = x.chars().zip(y.chars()).take_while(|(p, q)| p == q).count();
        let shown = |text: &str| {
            let from = same.saturating_sub(12);
            let part: String = text.chars().skip(from).collect();
            let dots = if from > 0 { "… " } else { "" };
            format!("{dots}{}", clipped(&part, 48))
        };
        return Some(format!(
            "line {line}, column {}: found `{}`, due `{}`",
            same + 1,
            shown(x),
            shown(y)
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn made(body: &str) -> Made {
        Made {
            title: "Numbers".into(),
            facts: vec![("precision", "exact".into())],
            recipe: "two numbers".into(),
            body: body.into(),
        }
    }

    #[test]
    fn sha_256_of_nothing() {
        let due = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        assert_eq!(digest(""), due);
    }

    #[test]
    fn headers_hold_until_somebody_edits() {
        for (form, body, from, to) in [
            (Form::Csv, "x,y\n1,2\n", "1,2", "1,3"),
            (Form::Rust, "\nconst X: u8 = 1;\n", "= 1", "= 2"),
            (
                Form::Json,
                "{\n  \"x\": [\n    1\n  ]\n}\n",
                "    1\n",
                "    2\n",
            ),
        ] {
            let text = document("numbers", form, &made(body)).unwrap();
            assert_eq!(broken(form, &text), None, "{text}");
            let edited = text.replace(from, to);
            assert!(
                broken(form, &edited).unwrap().contains("digest"),
                "{edited}"
            );
            assert!(
                difference(&edited, &text).unwrap().contains("line "),
                "{edited}"
            );
            let bare = broken(form, body).unwrap();
            assert!(bare.contains("no digest"), "{bare}");
        }
    }

    #[test]
    fn the_first_difference_is_named() {
        assert_eq!(difference("a\nb\n", "a\nb\n"), None);
        let found = difference("a\nbc\n", "a\nbd\n").unwrap();
        assert_eq!(found, "line 2, column 2: found `bc`, due `bd`");
        let found = difference("a\n", "a\nb\n").unwrap();
        assert_eq!(found, "line 2, column 1: found ``, due `b`");
        assert!(difference("a", "a\n").unwrap().contains("(the end)"));
    }

    #[test]
    fn a_header_says_how_a_file_was_made() {
        let version = env!("CARGO_PKG_VERSION");
        let (recipe, content) = (digest("two numbers"), digest("1,2\n"));
        let made = Made {
            title: "Numbers\n\nof two kinds".into(),
            ..made("1,2\n")
        };
        let lines = |mark: &str| {
            format!(
                "{mark} Numbers\n{mark}\n{mark} of two kinds\n{mark}\n\
                 {mark} Made by `mechaudit regenerate some` (mechaudit {version}); not to be edited.\n\
                 {mark} precision: exact\n{mark} SHA-256 of the recipe: {recipe}\n\
                 {mark} SHA-256 of all lines below: {content}\n1,2\n"
            )
        };
        assert_eq!(document("some", Form::Csv, &made).unwrap(), lines("#"));
        assert_eq!(document("some", Form::Rust, &made).unwrap(), lines("//!"));
    }

    #[test]
    fn a_header_of_json_stands_first() {
        let body = "{\n  \"b\": 1,\n  \"a\": 2\n}\n";
        let text = document("some", Form::Json, &made(body)).unwrap();
        let version = env!("CARGO_PKG_VERSION");
        let (recipe, content) = (digest("two numbers"), digest(body));
        let due = format!(
            "{{\n  \"generated\": {{\n    \"title\": \"Numbers\",\n    \
             \"made_by\": \"mechaudit regenerate some\",\n    \"mechaudit_version\": \"{version}\",\n    \
             \"precision\": \"exact\",\n    \"recipe_sha256\": \"{recipe}\",\n    \
             \"content_sha256\": \"{content}\"\n  }},\n  \"b\": 1,\n  \"a\": 2\n}}\n"
        );
        assert_eq!(text, due);
        let none = document("some", Form::Json, &made("[1]")).unwrap_err();
        assert_eq!(none.to_string(), "the content is no JSON object");
        for (text, due) in [
            ("[1]", Some("it is no JSON object")),
            ("{", Some("it is no JSON object")),
            (
                "{\"generated\": {}}",
                Some("there is no digest in its header"),
            ),
            (
                "{\"generated\": {\"content_sha256\": 1}}",
                Some("there is no digest in its header"),
            ),
            (&text, None),
        ] {
            assert_eq!(broken(Form::Json, text).as_deref(), due, "{text}");
        }
    }

    #[test]
    fn a_file_is_made_by_its_recipe() {
        let artefact = Artefact {
            name: "some".into(),
            path: "some.csv".into(),
            form: Form::Csv,
            make: Box::new(|| Ok(made("1\n"))),
        };
        let due = document("some", Form::Csv, &made("1\n")).unwrap();
        assert_eq!(artefact.text().unwrap(), due);
    }

    /// A few characters before the first that differ, forty-eight in all.
    #[test]
    fn a_long_line_is_shown_about_its_difference() {
        let of = |before: usize, after: usize| {
            let (a, b) = ("x".repeat(before), "y".repeat(after));
            difference(&format!("{a}1{b}"), &format!("{a}2{b}")).unwrap()
        };
        assert_eq!(
            of(12, 3),
            format!(
                "line 1, column 13: found `{0}1yyy`, due `{0}2yyy`",
                "x".repeat(12)
            )
        );
        assert_eq!(
            of(13, 3),
            format!(
                "line 1, column 14: found `… {0}1yyy`, due `… {0}2yyy`",
                "x".repeat(12)
            )
        );
        let long = of(20, 100);
        assert!(long.starts_with("line 1, column 21: found `… "), "{long}");
        assert_eq!(
            difference("a\n\n", "a\n\nb"),
            Some("line 3, column 1: found ``, due `b`".into())
        );
        assert_eq!(
            difference("a", "a\nb"),
            Some("line 2, column 1: found `(the end)`, due `b`".into())
        );
    }
}

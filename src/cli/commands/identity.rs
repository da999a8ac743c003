//! Equations on standard input, one a line, proved or refuted.

use crate::cli::args::{IdentityArgs, TextOrJson};
use crate::cli::failure::{Failure, Outcome};
use crate::cli::files::output::write_to;
use crate::cli::number::shortened;
use mechaudit::symbolic::{
    Definitions, Equation, Expr, Identity, Outcome as Decision, SymbolicError, Witness, parse,
    parse_equation,
};
use rayon::prelude::*;
use serde_json::{Map, json};
use std::io::{BufRead, BufReader, Read, Write};

/// Lines decided at a time, for each thread: few, because one of them may take seconds.
const LINES: usize = 16;
/// The longest line, in bytes.
const LONGEST: usize = 1 << 16;
/// The number of bytes of text held at a time.
const BUFFER: usize = 1 << 16;
/// Stack of a thread, in bytes: definitions may be nested in one another, and each as deep as the
/// parser lets it.
const STACK: usize = 1 << 28;
/// Names that have a meaning of their own.
const RESERVED: [&str; 4] = ["pi", "inf", "each", "n_num"];

/// A line with its number, counted from one.
struct Line {
    number: u64,
    text: String,
}

/// The reason why an equation or a definition cannot be read.
#[derive(Debug, thiserror::Error)]
enum IdentityError {
    #[error("longer than {LONGEST} bytes")]
    TooLong,
    #[error("not UTF-8")]
    NotUtf8(#[from] std::string::FromUtf8Error),
    /// The character is counted from one.
    #[error("character {0}: {1}")]
    Character(usize, String),
    #[error(transparent)]
    Symbolic(SymbolicError),
    #[error("expected name = expression or derivation: symbol = expression")]
    NoDefinition,
    #[error("{0:?} is not a name that can be defined")]
    NotDefinable(String),
    #[error("{0} is defined twice")]
    Twice(String),
}

impl IdentityError {
    /// That of a text which begins `characters` characters into its line.
    fn behind(characters: usize, e: SymbolicError) -> IdentityError {
        match e {
            SymbolicError::Parse { at, reason } => {
                IdentityError::Character(characters + at + 1, reason)
            }
            other => IdentityError::Symbolic(other),
        }
    }
}

/// Decides the equations.
pub fn identity(args: &IdentityArgs) -> Result<Outcome, Failure> {
    let definitions = defined(&args.define)?;
    let pool = rayon::ThreadPoolBuilder::new()
        .stack_size(STACK)
        .build()
        .map_err(|e| Failure::caused(e).about("cannot start threads"))?;
    let mut outcome = Outcome::AsExpected;
    write_to(|out| {
        let input = BufReader::with_capacity(BUFFER, std::io::stdin().lock());
        outcome = stream(&definitions, args.format, &pool, input, out)?;
        Ok(())
    })?;
    Ok(outcome)
}

/// The definitions given as options.
fn defined(texts: &[String]) -> Result<Definitions, Failure> {
    let mut all = Definitions::default();
    for text in texts {
        define(&mut all, text)
            .map_err(|e| Failure::caused(e).about(format!("--define {text:?}")))?;
    }
    Ok(all)
}

/// Adds one.
fn define(all: &mut Definitions, text: &str) -> Result<(), IdentityError> {
    let (left, right) = text.split_once('=').ok_or(IdentityError::NoDefinition)?;
    let before = left.chars().count() + 1;
    let value = parse(right).map_err(|e| IdentityError::behind(before, e))?;
    let Some((by, symbol)) = left.split_once(':') else {
        let name = name(left)?;
        if all.names.contains_key(name) {
            return Err(IdentityError::Twice(name.into()));
        }
        all.set(name, value);
        return Ok(());
    };
    let (by, symbol) = (name(by)?, name(symbol)?);
    let images = all.derivations.entry(by.into()).or_default();
    if images.iter().any(|(s, _)| s == symbol) {
        return Err(IdentityError::Twice(format!("D({symbol}, {by})")));
    }
    images.push((symbol.into(), value));
    Ok(())
}

/// A name that stands for nothing yet.
fn name(text: &str) -> Result<&str, IdentityError> {
    let text = text.trim();
    let free = !RESERVED.contains(&text);
    match parse(text) {
        Ok(Expr::Sym(_)) if free => Ok(text),
        _ => Err(IdentityError::NotDefinable(text.into())),
    }
}

/// Reads some lines, decides them side by side, writes the answers in order, and so on.
fn stream(
    definitions: &Definitions,
    format: TextOrJson,
    pool: &rayon::ThreadPool,
    mut input: BufReader<impl Read>,
    out: &mut dyn Write,
) -> Result<Outcome, Failure> {
    let most = LINES * pool.current_num_threads();
    let (mut number, mut answered, mut more, mut all_proved) = (0, 0u64, true, true);
    while more {
        let mut equations: Vec<(Line, Equation)> = Vec::new();
        let mut failed = None;
        // Lines that have arrived are answered before more are waited for.
        while more && equations.len() < most && (equations.is_empty() || has_line(&input)) {
            let mut text = Vec::new();
            let read = (&mut input)
                .take(LONGEST as u64 + 1)
                .read_until(b'\n', &mut text)
                .map_err(|e| Failure::caused(e).about("cannot read standard input"))?;
            number += 1;
            let shown = || format!("line {number} ({:?})", shortened(&text));
            match equation(&text) {
                Ok(Some((text, equation))) => equations.push((Line { number, text }, equation)),
                Ok(None) => {}
                Err(e) => failed = Some(Failure::caused(e).about(shown())),
            }
            more = read > 0 && failed.is_none();
        }
        let found: Vec<Identity> = pool.install(|| {
            let equations = equations.par_iter();
            equations
                .map(|(_, e)| Identity::of(definitions, e))
                .collect()
        });
        for ((line, _), found) in equations.iter().zip(&found) {
            all_proved &= found.outcome == Decision::Proved;
            answered += 1;
            match format {
                TextOrJson::Text => writeln!(out, "{}", words(found))?,
                TextOrJson::Json => writeln!(out, "{}", object(line, found))?,
            }
        }
        out.flush()?;
        if let Some(failure) = failed {
            return Err(failure);
        }
    }
    if answered == 0 {
        return Err(Failure::new("no equation on standard input"));
    }
    Ok(Outcome::of(all_proved))
}

fn has_line(input: &BufReader<impl Read>) -> bool {
    input.buffer().contains(&b'\n')
}

/// The equation of a line with its text; nothing for a blank one or a comment.
fn equation(line: &[u8]) -> Result<Option<(String, Equation)>, IdentityError> {
    if line.len() > LONGEST {
        return Err(IdentityError::TooLong);
    }
    let text = String::from_utf8(line.to_vec())?;
    let trimmed = text.trim();
    if trimmed.is_empty() || trimmed.starts_with('#') {
        return Ok(None);
    }
    let equation = parse_equation(text.trim_end()).map_err(|e| IdentityError::behind(0, e))?;
    Ok(Some((trimmed.into(), equation)))
}

/// The reason why an equation is undecided.
fn reason(found: &Identity) -> Option<String> {
    let undecided = found.outcome == Decision::Undecided;
    undecided.then(|| match &found.error {
        Some(e) => e.to_string(),
        None => "the sides have different normal forms, and no point tried tells them apart".into(),
    })
}

/// The answer as a line of text.
fn words(found: &Identity) -> String {
    match (&found.witness, reason(found)) {
        (Some(witness), _) => refuted(witness),
        (None, Some(why)) => format!("undecided: {why}"),
        (None, None) => "proved".into(),
    }
}

fn refuted(witness: &Witness) -> String {
    let point = witness.point.iter();
    let point: Vec<String> = point.map(|(name, x)| format!("{name} = {x}")).collect();
    let place = match point.is_empty() {
        true => String::new(),
        false => format!(" at {}", point.join(", ")),
    };
    format!("refuted{place}: left - right = {}", witness.residual)
}

/// The answer as an object on one line.
fn object(line: &Line, found: &Identity) -> serde_json::Value {
    let witness = found.witness.as_ref().map(|w| {
        let point = w.point.iter();
        let point: Map<_, _> = point.map(|(n, x)| (n.clone(), json!(x))).collect();
        json!({"point": point, "residual": w.residual})
    });
    json!({
        "line": line.number,
        "equation": line.text,
        "outcome": found.outcome,
        "residual": found.residual,
        "witness": witness,
        "reason": reason(found),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The answers to a text, and the outcome or why it ended.
    fn answers(text: &str, format: TextOrJson) -> (Vec<String>, Result<Outcome, String>) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let mut out = Vec::new();
        let input = BufReader::new(text.as_bytes());
        let none = Definitions::default();
        let end = stream(&none, format, &pool.unwrap(), input, &mut out);
        let out = String::from_utf8(out).unwrap();
        let lines = out.lines().map(String::from).collect();
        (lines, end.map_err(|e| e.to_string()))
    }

    /// In the order of the lines, however many there are, comments and blank lines passed over.
    #[test]
    fn every_equation_has_its_answer() {
        let text = "x + x = 2*x\n# no\n\nx = y\n  2 = 1 + 1\r\n".repeat(20);
        let (lines, end) = answers(&text, TextOrJson::Text);
        assert_eq!((lines.len(), end), (60, Ok(Outcome::Finding)));
        for three in lines.chunks(3) {
            assert_eq!([&*three[0], &*three[2]], ["proved", "proved"]);
            assert!(three[1].starts_with("refuted at x = "), "{three:?}");
            assert!(three[1].contains(", y = "), "{three:?}");
            assert!(three[1].contains(": left - right = "), "{three:?}");
        }
        let (lines, end) = answers("1 = 2", TextOrJson::Text);
        assert_eq!(lines, ["refuted: left - right = -1"]);
        assert_eq!(end, Ok(Outcome::Finding));
        let (lines, end) = answers("1 = 1", TextOrJson::Text);
        assert_eq!((&*lines[0], end), ("proved", Ok(Outcome::AsExpected)));
    }

    #[test]
    fn objects_hold_all_that_is_found() {
        let (lines, _) = answers(
            "\n x = 2*x \nx = x\narctan(x) = arctan(x)\n",
            TextOrJson::Json,
        );
        let read = |line: &String| serde_json::from_str::<serde_json::Value>(line).unwrap();
        let [wrong, right] = [&lines[0], &lines[1]].map(read);
        assert_eq!(wrong["line"], 2);
        assert_eq!(wrong["equation"], "x = 2*x");
        assert_eq!(wrong["outcome"], "refuted");
        assert_eq!(wrong["residual"], "-x");
        assert!(wrong["witness"]["point"]["x"].is_string(), "{wrong}");
        assert!(wrong["witness"]["residual"].is_string(), "{wrong}");
        assert!(wrong["reason"].is_null());
        assert_eq!(right["outcome"], "proved");
        assert!(right["witness"].is_null() && right["reason"].is_null());
    }

    /// Its line and the character are said, counted from one; what stands before it is answered.
    #[test]
    fn a_line_that_cannot_be_read_ends_it() {
        for (line, why) in [
            ("x = (y", "character 7: expected ')'"),
            ("x = y = z", "character 7: unexpected '='"),
            ("x", "character 2: expected '='"),
            ("= x", "character 1: unexpected '='"),
            ("  x + = x", "character 7: unexpected '='"),
            ("x = a_name_that_is_too_long", "is not a name of 1 to 16"),
        ] {
            let (lines, end) = answers(&format!("1 = 1\n\n{line}\n1 = 1\n"), TextOrJson::Text);
            let end = end.unwrap_err();
            assert_eq!(lines, ["proved"], "{line}");
            let begin = format!("line 3 ({:?}): ", line.trim());
            assert!(end.starts_with(&begin) && end.contains(why), "{end}");
        }
        let long = format!("1 = 1{}", " ".repeat(LONGEST));
        let (_, end) = answers(&long, TextOrJson::Text);
        assert!(end.unwrap_err().ends_with("longer than 65536 bytes"));
        for none in ["", "# nothing\n\n"] {
            let (_, end) = answers(none, TextOrJson::Text);
            assert_eq!(end.unwrap_err(), "no equation on standard input");
        }
        assert!(matches!(
            equation(b"\xff = 1"),
            Err(IdentityError::NotUtf8(_))
        ));
    }

    #[test]
    fn definitions_are_checked() {
        let read = |texts: &[&str]| {
            let texts: Vec<String> = texts.iter().map(|t| t.to_string()).collect();
            defined(&texts).map_err(|e| e.to_string())
        };
        let all = read(&["c = a + b", "t: x = c", "t: y = 1", "s: x = 2"]).unwrap();
        assert_eq!(all.names.len(), 1);
        assert_eq!(all.derivations["t"].len(), 2);
        for (texts, why) in [
            (&["c"][..], "expected name = expression"),
            (&["c = (a"], "character 7: expected ')'"),
            (&["t: x = 1 +"], "character 11: expected an expression"),
            (&["1 = a"], "\"1\" is not a name that can be defined"),
            (&["pi = 3"], "\"pi\" is not a name that can be defined"),
            (&["i = 3"], "\"i\" is not a name that can be defined"),
            (&["exp = 3"], "\"exp\" is not a name that can be defined"),
            (&["a b = 3"], "\"a b\" is not a name that can be defined"),
            (&["t: = 3"], "\"\" is not a name that can be defined"),
            (&["a = 1", "a = 2"], "a is defined twice"),
            (&["t: x = 1", "t: x = 2"], "D(x, t) is defined twice"),
        ] {
            let found = read(texts).unwrap_err();
            let begin = format!("--define {:?}: ", texts.last().unwrap());
            assert!(found.starts_with(&begin) && found.contains(why), "{found}");
        }
    }
}

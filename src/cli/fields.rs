//! Fields of a linkage's file: quantities as written, needed or optional, and how the crank moves.

use super::quantity::{Kind, Quantity};
use mechaudit::audit::did_you_mean;
use rug::Rational;
use serde::Deserialize;
use serde::de::{DeserializeOwned, Deserializer, Visitor};

/// A value as written: a string, or a bare number, which is refused with its field's name.
#[derive(Clone, Debug)]
pub enum Written {
    Text(String),
    Bare(String),
}

impl<'de> Deserialize<'de> for Written {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Written, D::Error> {
        struct V;
        impl Visitor<'_> for V {
            type Value = Written;
            fn expecting(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
                f.write_str("a string with a number and its unit")
            }
            fn visit_str<E>(self, v: &str) -> Result<Written, E> {
                Ok(Written::Text(v.into()))
            }
            fn visit_i64<E>(self, v: i64) -> Result<Written, E> {
                Ok(Written::Bare(v.to_string()))
            }
            fn visit_u64<E>(self, v: u64) -> Result<Written, E> {
                Ok(Written::Bare(v.to_string()))
            }
            fn visit_f64<E>(self, v: f64) -> Result<Written, E> {
                Ok(Written::Bare(v.to_string()))
            }
        }
        d.deserialize_any(V)
    }
}

/// The motion of the crank.
#[derive(Clone, Debug)]
pub struct CrankMotion {
    pub omega: Quantity,
    pub epsilon: Quantity,
}

/// Reads TOML or JSON; a refusal is one line.
pub fn parse<T: DeserializeOwned>(text: &str, json: bool) -> Result<T, String> {
    if json {
        return serde_json::from_str(text).map_err(|e| in_words(&e.to_string()));
    }
    toml::from_str(text).map_err(|e| {
        let line = e.span().map(|s| text[..s.start].matches('\n').count() + 1);
        let message = in_words(e.message());
        match line {
            Some(line) => format!("line {line}: {message}"),
            None => message,
        }
    })
}

/// What a reader of files says, on one line and without the names of Rust's types.
fn in_words(message: &str) -> String {
    let line = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let Some((before, expected)) = line.rsplit_once("expected ") else {
        return line;
    };
    // Where it stands may follow.
    let end = expected.find(' ').unwrap_or(expected.len());
    let kind = match &expected[..end] {
        "f64" => "a number",
        "usize" | "u32" | "u64" => "a whole number, 0 or more",
        "one" => return with_a_guess(before, expected),
        name if name.starts_with('`') => return with_a_guess(before, expected),
        _ => return line,
    };
    format!("{before}expected {kind}{}", &expected[end..])
}

/// An unknown field beside the names there are, in backticks.
fn with_a_guess(before: &str, expected: &str) -> String {
    let name = before.split('`').nth(1).unwrap_or_default();
    let known: Vec<&str> = expected.split('`').skip(1).step_by(2).collect();
    let meant = did_you_mean(name, &known);
    let before = before.trim_end_matches([',', ' ']);
    format!("{before}{meant}, expected {expected}")
}

/// A required quantity.
pub fn need(kind: Kind, field: &str, written: &Option<Written>) -> Result<Quantity, String> {
    may(kind, field, written)?.ok_or_else(|| format!("{field} is missing"))
}

/// An optional quantity.
pub fn may(kind: Kind, field: &str, written: &Option<Written>) -> Result<Option<Quantity>, String> {
    let text = match written {
        None => return Ok(None),
        Some(Written::Text(text) | Written::Bare(text)) => text,
    };
    let quantity = Quantity::parse(kind, text).map_err(|e| format!("{field} = {e}"))?;
    Ok(Some(quantity))
}

/// The motion of the crank, if given.
pub fn crank_motion(
    speed: &Option<Written>,
    acceleration: &Option<Written>,
) -> Result<Option<CrankMotion>, String> {
    let omega = may(Kind::AngularVelocity, "crank_speed", speed)?;
    let field = "crank_acceleration";
    let epsilon = may(Kind::AngularAcceleration, field, acceleration)?;
    match (omega, epsilon) {
        (Some(omega), epsilon) => Ok(Some(CrankMotion {
            omega,
            epsilon: epsilon.unwrap_or_else(|| Quantity::si(Rational::new())),
        })),
        (None, None) => Ok(None),
        (None, Some(_)) => Err("crank_acceleration needs crank_speed".into()),
    }
}

/// An angle in degrees; one given in radians is rounded.
pub fn in_degrees(q: &Quantity) -> Option<Rational> {
    if q.degrees {
        return Some(q.value.clone());
    }
    Rational::from_f64(q.to_f64().to_degrees())
}

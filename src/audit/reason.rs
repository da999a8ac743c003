//! The reason why a judgement is no pass.

use serde::{Serialize, Serializer};
use std::fmt::{self, Display, Formatter};

/// The reason why a judgement is no pass. Of a value it is put in words when it is shown: a bad
/// candidate has a reason at every case, and few are kept.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// In words.
    Words(String),
    /// One value is the worst.
    Value {
        /// The output it belongs to.
        output: &'static str,
        /// Its number among all values.
        number: usize,
        /// The value answered.
        got: f64,
        /// The expected value: the nearest number, an infinity or NaN.
        expected: f64,
        /// The fault of it.
        fault: Fault,
    },
}

/// The fault of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// It is of the wrong kind: NaN, an infinity, a number for one of them, or the zero of the
    /// wrong sign.
    Kind,
    /// Its error exceeds the budget by this factor.
    Over(f64),
    /// It cannot be decided.
    Open,
}

/// A number in words: the shortest decimal that reads back as the same one, with an exponent, so
/// that no number is long.
pub fn written(x: f64) -> String {
    match x {
        0.0 => format!("{x}"),
        x => format!("{x:e}"),
    }
}

/// A number as it is usually written, and as [`written`] where that would be long.
pub(super) fn plain(x: f64) -> String {
    match x.abs() {
        size if size == 0.0 || (1e-5..1e16).contains(&size) => x.to_string(),
        _ => written(x),
    }
}

impl Display for Reason {
    fn fmt(&self, to: &mut Formatter<'_>) -> fmt::Result {
        let (output, number, got, expected, fault) = match self {
            Reason::Words(words) => return to.write_str(words),
            Reason::Value {
                output,
                number,
                got,
                expected,
                fault,
            } => (output, number, written(*got), written(*expected), *fault),
        };
        write!(
            to,
            "{output} (value {number}) is {got}, expected {expected}"
        )?;
        match fault {
            Fault::Kind => Ok(()),
            Fault::Over(x) if x < 1e4 => write!(to, ": {x:.3} times its budget off"),
            Fault::Over(f64::INFINITY) => to.write_str(": more than 1e308 times its budget off"),
            Fault::Over(x) => write!(to, ": {x:.2e} times its budget off"),
            Fault::Open => to.write_str(": the reference cannot decide it against its budget"),
        }
    }
}

impl Serialize for Reason {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

impl From<String> for Reason {
    fn from(words: String) -> Reason {
        Reason::Words(words)
    }
}

impl From<&str> for Reason {
    fn from(words: &str) -> Reason {
        Reason::Words(words.into())
    }
}

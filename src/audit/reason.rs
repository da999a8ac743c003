//! Why a judgement is no pass.

use serde::{Serialize, Serializer};
use std::fmt::{self, Display, Formatter};

/// Why a judgement is no pass. Of a value it is put in words when it is shown: a bad candidate has a reason at every
/// case, and few are kept.
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
        /// What was answered.
        got: f64,
        /// What is wrong with it.
        fault: Fault,
    },
}

/// What is wrong with a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// The other zero is due.
    Zero,
    /// It is of the wrong kind: NaN, an infinity, or a number for one of them.
    Kind,
    /// Its error is so many times the budget.
    Over(f64),
    /// It cannot be decided.
    Open,
}

impl Display for Reason {
    fn fmt(&self, to: &mut Formatter<'_>) -> fmt::Result {
        let (output, number, got, fault) = match self {
            Reason::Words(words) => return to.write_str(words),
            Reason::Value {
                output,
                number,
                got,
                fault,
            } => (output, number, *got, *fault),
        };
        write!(to, "{output} (value {number}) ")?;
        match fault {
            Fault::Zero => write!(to, "is {got:?} where {:?} is due", -got),
            Fault::Kind => write!(to, "is {got}"),
            Fault::Over(x) if x < 1e4 => write!(to, "is {x:.3} times its budget off"),
            Fault::Over(f64::INFINITY) => to.write_str("is more than 1e308 times its budget off"),
            Fault::Over(x) => write!(to, "is {x:.2e} times its budget off"),
            Fault::Open => to.write_str("cannot be decided against its budget"),
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

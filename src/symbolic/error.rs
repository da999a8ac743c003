//! Errors of expressions.

/// Why an expression has no value in the algebra or in balls.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SymbolicError {
    /// The text is not an expression.
    #[error("at character {at}: {reason}")]
    Parse {
        /// Where, counted from 0.
        at: usize,
        /// The expected token.
        reason: String,
    },
    /// A name that is neither declared nor a constant.
    #[error("at character {at}: the name {name} is not declared")]
    Unknown {
        /// The place, counted from 0.
        at: usize,
        /// The name.
        name: String,
    },
    /// Not a name of 1 to 16 printable ASCII characters.
    #[error("{0:?} is not a name of 1 to 16 printable ASCII characters")]
    Name(String),
    /// A definition or a variable with the name of a constant.
    #[error("{0} is a constant and cannot be defined or varied")]
    Reserved(String),
    /// Division by zero or by a proper sum of exponentials.
    #[error("cannot divide by {0}")]
    NotInvertible(String),
    /// A square root whose branch depends on the values of the symbols, or of a number with large
    /// prime factors.
    #[error("the branch of the root of {0} is not decided")]
    Root(String),
    /// Outside the algebra.
    #[error("outside the algebra: {0}")]
    Unsupported(String),
    /// Definitions that lead back to themselves.
    #[error("the definition of {0} does not end")]
    Circular(String),
    /// The decision takes more operations than are allowed for one.
    #[error("the limit on the work of one decision is passed")]
    Work,
    /// A name without a value where values are needed.
    #[error("{0} has no value")]
    NoValue(String),
    /// An enclosure is too wide.
    #[error("an enclosure is too wide for {0}")]
    Wide(String),
}

/// Returns the error for an expression outside the algebra.
pub(super) fn unsupported<T>(what: impl Into<String>) -> Result<T, SymbolicError> {
    Err(SymbolicError::Unsupported(what.into()))
}

/// A place in a text, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line.
    pub line: usize,
    /// The column.
    pub column: usize,
}

impl Place {
    /// The place of a byte of a text.
    pub fn of(text: &str, at: usize) -> Place {
        let before = &text.as_bytes()[..at.min(text.len())];
        let start = before
            .iter()
            .rposition(|b| *b == b'\n')
            .map_or(0, |k| k + 1);
        Place {
            line: before.iter().filter(|b| **b == b'\n').count() + 1,
            column: String::from_utf8_lossy(&before[start..]).chars().count() + 1,
        }
    }
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

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

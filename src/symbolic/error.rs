//! What can go wrong with an expression.

/// Why an expression has no value in the algebra or in balls.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SymbolicError {
    /// The text is not an expression.
    #[error("at character {at}: {reason}")]
    Parse {
        /// Where, counted from 0.
        at: usize,
        /// What was expected.
        reason: String,
    },
    /// Not a name of 1 to 16 printable ASCII characters.
    #[error("{0:?} is not a name of 1 to 16 printable ASCII characters")]
    Name(String),
    /// Division by zero or by a proper sum of exponentials.
    #[error("cannot divide by {0}")]
    NotInvertible(String),
    /// A square root that cannot be adjoined independently of the others.
    #[error("the root of {0} is not independent of those in use")]
    Root(String),
    /// Outside the algebra.
    #[error("outside the algebra: {0}")]
    Unsupported(String),
    /// Definitions that lead back to themselves.
    #[error("the definition of {0} does not end")]
    Circular(String),
    /// An enclosure is too wide.
    #[error("an enclosure is too wide for {0}")]
    Wide(String),
}

/// What is outside the algebra.
pub(super) fn unsupported<T>(what: impl Into<String>) -> Result<T, SymbolicError> {
    Err(SymbolicError::Unsupported(what.into()))
}

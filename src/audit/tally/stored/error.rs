//! The reason why a stored text is no tally.

/// The reason why a stored tally does not fit a method and its settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StoredError {
    /// A region, check point, output or law that the method does not have.
    #[error("the method has no {what} {name:?}")]
    Name {
        /// The expected content.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// Values that no tally holds.
    #[error("{0} that no tally holds")]
    Value(&'static str),
}

//! Why what is stored is no tally.

/// Why a stored tally is none of a method and its settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StoredError {
    /// A region, check point, output or law that the method does not have.
    #[error("the method has no {what} {name:?}")]
    Name {
        /// What it would be.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// Values that no tally holds.
    #[error("{0} that no tally holds")]
    Value(&'static str),
}

//! Why there is no proof.

use mechaudit_reference::Undecided;

/// Why there is no proof: what it rests on does not hold, or is not decided.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ProofError {
    /// Something of the solver is not what the proof needs.
    #[error("{0}")]
    Fails(String),
    /// The reference does not decide a value that the proof needs.
    #[error(transparent)]
    Undecided(#[from] Undecided),
}

impl From<&str> for ProofError {
    fn from(why: &str) -> ProofError {
        ProofError::Fails(why.into())
    }
}

//! How much of an atlas is done.

use serde::Serialize;

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Effort {
    /// Points in each region; searches are multiples.
    pub cases: u64,
    /// Key of the random stream.
    pub seed: u64,
}

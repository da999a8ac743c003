//! How much of an atlas is done.

use crate::audit::Settings;
use serde::Serialize;

/// How much is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Effort {
    /// Points in each region; searches are multiples.
    pub cases: u64,
    /// Key of the random stream.
    pub seed: u64,
}

impl Effort {
    /// The settings of an audit with so many times the points.
    pub(super) fn settings(&self, times: u64) -> Settings {
        Settings {
            seed: self.seed,
            cases_per_region: self.cases * times,
            ..Settings::default()
        }
    }
}

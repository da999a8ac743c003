//! Settings of a run.

use serde::Serialize;

/// The settings of a run; all of them are printed with it.
#[derive(Clone, Debug, Serialize)]
pub struct Settings {
    /// Key of the random stream.
    pub seed: u64,
    /// Random cases drawn in each region.
    pub cases_per_region: u64,
    /// Working precision the references start from, in bits.
    pub first_bits: u32,
    /// Working precision at which an open case is called undecided, in bits.
    pub last_bits: u32,
    /// True if functions of a complex variable are mapped, too; see
    /// [`error_map`](super::error_map).
    pub maps: bool,
    /// True if condition numbers are computed for every case, even if its budget is in ulps.
    pub conditions: bool,
    /// Cases of each region that the report shows with all their errors, whatever they are.
    pub points: usize,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            seed: 1,
            cases_per_region: 200,
            first_bits: 128,
            last_bits: 2048,
            maps: false,
            conditions: false,
            points: 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seed and number of cases choose the inputs of an audit, the bits what is called undecided:
    /// recorded findings are those of these.
    #[test]
    fn the_defaults_are_pinned() {
        let s = Settings::default();
        assert_eq!((s.seed, s.cases_per_region), (1, 200));
        assert_eq!((s.first_bits, s.last_bits), (128, 2048));
        assert_eq!((s.maps, s.conditions, s.points), (false, false, 0));
    }
}

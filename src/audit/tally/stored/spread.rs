//! Spreads of errors, stored.

use super::case::Bits;
use super::error::StoredError;
use crate::spread::{Bin, SpreadTally, Squares};
use serde::{Deserialize, Serialize};

/// Counts by bins, sums of squares by exponents.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StoredSpread {
    dropped: u32,
    count: u64,
    beyond: u64,
    max: Bits,
    /// The first bin, its count, the step to the next, its count, and so on.
    bins: Vec<u64>,
    /// Exponent, then the upper 64 and the lower 128 bits.
    squares: Vec<(i32, u64, String)>,
}

impl StoredSpread {
    pub(super) fn of(spread: &SpreadTally) -> StoredSpread {
        let mut before = 0;
        let bins = spread.bins().flat_map(|(k, count)| {
            let step = u64::from(k - before);
            before = k;
            [step, count]
        });
        StoredSpread {
            dropped: spread.dropped,
            count: spread.count,
            beyond: spread.beyond,
            max: Bits(f64::from_bits(spread.max)),
            bins: bins.collect(),
            squares: spread
                .squares()
                .map(|(e, s)| (e, s.carry, format!("{:x}", s.low)))
                .collect(),
        }
    }

    /// Of the kind of that one.
    pub(super) fn restored(self, like: &SpreadTally) -> Result<SpreadTally, StoredError> {
        if self.dropped != like.dropped {
            return Err(StoredError::Value("widths of bins"));
        }
        let bad = || StoredError::Value("a spread");
        let mut spread = SpreadTally::dropping(self.dropped);
        let mut at: Bin = 0;
        let (pairs, rest) = self.bins.as_chunks::<2>();
        if !rest.is_empty() {
            return Err(bad());
        }
        for (k, [step, count]) in pairs.iter().enumerate() {
            if k > 0 && *step == 0 {
                return Err(bad());
            }
            let step = Bin::try_from(*step).map_err(|_| bad())?;
            at = at.checked_add(step).ok_or_else(bad)?;
            spread.count_in_bin(at, *count).ok_or_else(bad)?;
        }
        for (e, carry, low) in self.squares {
            let low = u128::from_str_radix(&low, 16).map_err(|_| bad())?;
            let squares = Squares { low, carry };
            spread.set_squares(e, squares).ok_or_else(bad)?;
        }
        let total = {
            let mut counts = spread.bins().map(|(_, count)| count);
            counts.try_fold(0u64, u64::checked_add)
        };
        if total != Some(self.count) {
            return Err(bad());
        }
        spread.count = self.count;
        spread.beyond = self.beyond;
        spread.max = self.max.0.to_bits();
        Ok(spread)
    }
}

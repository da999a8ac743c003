//! The spread of errors: exact counts and sums that can be merged in any order.

use super::by_integer::ByInteger;
use rug::{Float, Integer};
use serde::Serialize;
use std::collections::BTreeMap;

/// The spread of errors; zeros if there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Number of errors.
    pub count: u64,
    /// The number of errors beyond the largest `f64`, which are in no other member.
    pub beyond: u64,
    /// The largest found.
    pub max: f64,
    /// 99th percentile (nearest rank), rounded up by less than a thousandth, in a campaign by less
    /// than a hundredth or to 2⁻²⁰.
    pub p99: f64,
    /// 99.99th percentile, rounded up likewise; of ten thousand errors or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p9999: Option<f64>,
    /// Median (nearest rank), rounded up likewise.
    pub median: f64,
    /// Root mean square, rounded once.
    pub rms: f64,
}

/// Gathers a [`Spread`] in a bounded space. Nothing is rounded before [`SpreadTally::spread`], so
/// the order of additions and merges never shows.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpreadTally {
    /// Bits of the fraction dropped for percentiles.
    pub(super) dropped: u32,
    /// By the field of the exponent.
    octaves: ByInteger<OctaveTally>,
    pub(super) count: u64,
    pub(super) beyond: u64,
    /// The bits of the largest; numbers that are not negative are in the order of their bits.
    pub(super) max: u64,
}

/// The leading bits of a number.
pub(super) type Bin = u32;

/// The counts of numbers of one exponent, by leading bits.
#[derive(Clone, Debug, Default)]
struct Bins {
    /// The bins of up to [`FEW`] numbers that are not in `all` yet: one count after another there
    /// would be a cache miss each.
    few: Vec<u16>,
    /// Every bin's count; empty until there are more. Errors of a bad candidate are in a hundred
    /// octaves.
    all: Vec<u64>,
}

/// As many as take the space of 64 bins.
const FEW: usize = 256;

impl Bins {
    /// Counts `more` numbers in one of `bins` bins.
    fn add(&mut self, bins: usize, bin: usize, more: u64) {
        if more <= (FEW - self.few.len()) as u64 {
            let (bin, more) = (bin as u16, more as usize);
            return match more {
                1 => self.few.push(bin),
                _ => self.few.resize(self.few.len() + more, bin),
            };
        }
        self.all.resize(bins, 0);
        let few = self.few.drain(..);
        few.for_each(|k| self.all[usize::from(k)] += 1);
        self.all[bin] += more;
    }

    /// Bins in rising order with their counts, which are not zero.
    fn counts(&self) -> impl Iterator<Item = (usize, u64)> {
        let mut few = self.few.clone();
        few.sort_unstable();
        let equal = few.chunk_by(|a, b| a == b);
        let few = equal.map(|k| (usize::from(k[0]), k.len() as u64));
        let counts: Vec<(usize, u64)> = match self.all.is_empty() {
            true => few.collect(),
            false => {
                let mut all = self.all.clone();
                few.for_each(|(k, count)| all[k] += count);
                let all = all.into_iter().enumerate();
                all.filter(|(_, count)| *count > 0).collect()
            }
        };
        counts.into_iter()
    }
}

impl PartialEq for Bins {
    fn eq(&self, other: &Bins) -> bool {
        self.counts().eq(other.counts())
    }
}

impl Eq for Bins {}

/// Numbers of one exponent.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct OctaveTally {
    count: u64,
    /// By the leading bits of the fraction.
    bins: Bins,
    squares: Squares,
}

impl OctaveTally {
    fn count(&mut self, dropped: u32, bin: Bin, more: u64) {
        let bins = 1 << (52 - dropped);
        self.count = self.count.saturating_add(more);
        self.bins.add(bins, bin as usize & (bins - 1), more);
    }
}

/// Σ m² over numbers `m · 2^e` of one exponent, in 192 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Squares {
    pub(super) low: u128,
    pub(super) carry: u64,
}

/// Bits of the fraction dropped for percentiles: 2¹⁰ bins an octave.
const DROPPED: u32 = 42;
/// Where tallies travel: 2⁷ bins an octave.
const DROPPED_COARSELY: u32 = 45;

impl Squares {
    fn add(&mut self, other: Squares) {
        let (sum, carry) = self.low.overflowing_add(other.low);
        self.low = sum;
        self.carry += other.carry + u64::from(carry);
    }

    fn sum(&self) -> Integer {
        (Integer::from(self.carry) << 128u32) + Integer::from(self.low)
    }
}

/// The exponent `e` of `m · 2^e`, `m < 2⁵³`, from its field.
fn exponent(field: u32) -> i32 {
    field.max(1) as i32 - 1075
}

impl Default for SpreadTally {
    fn default() -> SpreadTally {
        SpreadTally::dropping(DROPPED)
    }
}

impl SpreadTally {
    pub(super) fn dropping(dropped: u32) -> SpreadTally {
        SpreadTally {
            dropped,
            octaves: ByInteger::default(),
            count: 0,
            beyond: 0,
            max: 0,
        }
    }

    /// One that takes less space: percentiles are rounded up by less than a hundredth, and numbers
    /// below 2⁻²⁰ that are not zero are rounded up to it. It may be merged with its like only.
    pub fn coarse() -> SpreadTally {
        SpreadTally::dropping(DROPPED_COARSELY)
    }

    /// The number that is counted for one: itself, or the least that is told from zero.
    pub(super) fn counted(&self, value: f64) -> f64 {
        const LEAST: f64 = 1.0 / (1 << 20) as f64;
        match self.dropped == DROPPED_COARSELY && value > 0.0 && value < LEAST {
            true => LEAST,
            false => value,
        }
    }

    fn octave(&mut self, field: u32) -> &mut OctaveTally {
        self.octaves.or_insert_with(field, OctaveTally::default)
    }

    /// One error, which is not negative; NaN is passed over.
    pub fn add(&mut self, value: f64) {
        if value.is_nan() {
            return;
        }
        if value.is_infinite() {
            self.beyond += 1;
            return;
        }
        // −0 is 0.
        let bits = self.counted(value.abs()).to_bits();
        let (field, fraction) = ((bits >> 52) as u32, bits & ((1 << 52) - 1));
        let m = u128::from(fraction | u64::from(field > 0) << 52);
        let dropped = self.dropped;
        let octave = self.octave(field);
        octave.count(dropped, (bits >> dropped) as Bin, 1);
        octave.squares.add(Squares {
            low: m * m,
            carry: 0,
        });
        self.count += 1;
        self.max = self.max.max(bits);
    }

    /// Adds what another tally has gathered.
    ///
    /// # Panics
    /// When one of them is coarse and the other is not.
    pub fn merge(&mut self, other: &SpreadTally) {
        assert_eq!(self.dropped, other.dropped, "bins of one width");
        let dropped = self.dropped;
        for (field, more) in other.octaves.iter() {
            let own = self.octave(field);
            own.squares.add(more.squares);
            for (bin, count) in more.bins.counts() {
                own.count(dropped, bin as Bin, count);
            }
        }
        self.count += other.count;
        self.beyond += other.beyond;
        self.max = self.max.max(other.max);
    }

    /// The bins that are not empty, in rising order.
    pub(super) fn bins(&self) -> impl Iterator<Item = (Bin, u64)> + '_ {
        let shift = 52 - self.dropped;
        self.octaves.iter().flat_map(move |(field, octave)| {
            let bins = octave.bins.counts();
            bins.map(move |(k, count)| (field << shift | k as Bin, count))
        })
    }

    /// Sums of squares by exponents, in rising order.
    pub(super) fn squares(&self) -> impl Iterator<Item = (i32, Squares)> + '_ {
        let octaves = self.octaves.iter();
        octaves.map(|(field, octave)| (exponent(field), octave.squares))
    }

    /// Counts in a bin, of one that was stored; `None` if there is no such bin.
    pub(super) fn count_in_bin(&mut self, bin: Bin, count: u64) -> Option<()> {
        let field = bin >> (52 - self.dropped);
        let dropped = self.dropped;
        let octave = (field < 2047).then(|| self.octave(field))?;
        octave.count(dropped, bin, count);
        Some(())
    }

    /// Sets the sum of squares of an exponent, likewise, after its bins.
    pub(super) fn set_squares(&mut self, exponent: i32, squares: Squares) -> Option<()> {
        let field = u32::try_from(exponent.checked_add(1075)?).ok()?;
        let zeros = (field == 1)
            .then_some(0)
            .filter(|k| self.octaves.get(*k).is_some());
        self.octaves.get_mut(zeros.unwrap_or(field))?.squares = squares;
        Some(())
    }

    /// The numbers counted by octaves: `(k, n)` for n numbers in `[2^k, 2^(k+1))`, `(None, n)` for
    /// zeros.
    pub fn octaves(&self) -> Vec<(Option<i32>, u64)> {
        let mut octaves: BTreeMap<Option<i32>, u64> = BTreeMap::new();
        for (field, tally) in self.octaves.iter() {
            match field {
                // Zeros and subnormal numbers.
                0 => tally.bins.counts().for_each(|(k, count)| {
                    let x = f64::from_bits((k as u64) << self.dropped);
                    *octaves.entry(octave(x)).or_default() += count;
                }),
                _ => {
                    let own = octave(f64::from_bits(u64::from(field) << 52));
                    *octaves.entry(own).or_default() += tally.count;
                }
            }
        }
        octaves.into_iter().collect()
    }

    /// The number of that rank, counted from one, rounded up to the end of its bin.
    fn at_rank(&self, rank: u64) -> f64 {
        let mut below = 0;
        let max = f64::from_bits(self.max);
        for (field, octave) in self.octaves.iter() {
            if below + octave.count < rank {
                below += octave.count;
                continue;
            }
            let bin = octave.bins.counts().find(|(_, count)| {
                below += count;
                below >= rank
            });
            let Some((bin, _)) = bin else { continue };
            return match u64::from(field) << (52 - self.dropped) | bin as u64 {
                // Zeros, and subnormal numbers of no interest.
                0 => 0.0,
                k => {
                    let end = (k << self.dropped) | ((1 << self.dropped) - 1);
                    f64::from_bits(end).min(max)
                }
            };
        }
        max
    }

    /// The number that `share` of all numbers do not exceed, given in ten-thousandths (nearest
    /// rank), rounded up to the end of its bin; 0 of none.
    pub fn quantile(&self, share: u32) -> f64 {
        match self.count {
            0 => 0.0,
            n => self.at_rank((u128::from(n) * u128::from(share)).div_ceil(10_000) as u64),
        }
    }

    /// The gathered numbers.
    pub fn spread(&self) -> Spread {
        if self.count == 0 {
            return Spread {
                beyond: self.beyond,
                ..Spread::default()
            };
        }
        Spread {
            count: self.count,
            beyond: self.beyond,
            max: f64::from_bits(self.max),
            p99: self.quantile(9900),
            p9999: (self.count >= 10_000).then(|| self.quantile(9999)),
            median: self.quantile(5000),
            rms: self.rms(),
        }
    }

    fn rms(&self) -> f64 {
        let Some((least, _)) = self.squares().next() else {
            return 0.0;
        };
        let mut sum = Integer::new();
        for (e, squares) in self.squares() {
            sum += squares.sum() << (2 * (e - least)) as u32;
        }
        let mean = Float::with_val(192, sum) / self.count;
        let root: Float = mean.sqrt() << least;
        root.to_f64()
    }
}

/// The octave of a number, none for zero. Subnormal numbers are in one octave with the smallest
/// normal ones.
pub fn octave(x: f64) -> Option<i32> {
    match (x.to_bits() >> 52) as i32 {
        0 if x.to_bits() >> DROPPED_COARSELY == 0 => None,
        e => Some(e.max(1) - 1023),
    }
}

#[cfg(test)]
mod tests;

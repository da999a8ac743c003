//! How errors are spread: exact counts and sums that can be merged in any order.

use rug::{Float, Integer};
use serde::Serialize;
use std::collections::BTreeMap;

/// How errors are spread; zeros if there are none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Number of errors.
    pub count: u64,
    /// Errors beyond the largest `f64` besides, which are in no other member.
    pub beyond: u64,
    /// The largest found.
    pub max: f64,
    /// 99th percentile (nearest rank), rounded up by less than a thousandth.
    pub p99: f64,
    /// Median (nearest rank), rounded up likewise.
    pub median: f64,
    /// Root mean square, rounded once.
    pub rms: f64,
}

/// Gathers a [`Spread`] in a bounded space. Nothing is rounded before [`SpreadTally::spread`], so the
/// order of additions and merges never shows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SpreadTally {
    /// By the leading bits: numbers of a bin share their exponent.
    bins: BTreeMap<u32, Bin>,
    count: u64,
    beyond: u64,
    /// The bits of the largest; numbers that are not negative are in the order of their bits.
    max: u64,
}

/// Numbers `m · 2^e` with the same leading bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Bin {
    count: u64,
    /// Σ m², in 192 bits.
    squares: u128,
    carry: u64,
}

/// Bits of the fraction dropped for percentiles.
const DROPPED: u32 = 42;

impl Bin {
    fn add(&mut self, other: Bin) {
        self.count += other.count;
        let (sum, carry) = self.squares.overflowing_add(other.squares);
        self.squares = sum;
        self.carry += other.carry + u64::from(carry);
    }

    fn sum(&self) -> Integer {
        (Integer::from(self.carry) << 128u32) + Integer::from(self.squares)
    }
}

/// `x = m · 2^e` with an integer `m < 2⁵³`.
fn parts(bits: u64) -> (u64, i32) {
    let (exponent, fraction) = ((bits >> 52) as i32, bits & ((1 << 52) - 1));
    match exponent {
        0 => (fraction, -1074),
        e => (fraction | 1 << 52, e - 1075),
    }
}

impl SpreadTally {
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
        let bits = value.abs().to_bits();
        let m = u128::from(parts(bits).0);
        let one = Bin {
            count: 1,
            squares: m * m,
            carry: 0,
        };
        self.bins
            .entry((bits >> DROPPED) as u32)
            .or_default()
            .add(one);
        self.count += 1;
        self.max = self.max.max(bits);
    }

    /// Adds what another tally has gathered.
    pub fn merge(&mut self, other: &SpreadTally) {
        for (k, bin) in &other.bins {
            self.bins.entry(*k).or_default().add(*bin);
        }
        self.count += other.count;
        self.beyond += other.beyond;
        self.max = self.max.max(other.max);
    }

    /// The numbers counted by octaves: `(k, n)` for n numbers in `[2^k, 2^(k+1))`, `(None, n)` for
    /// zeros.
    pub fn octaves(&self) -> Vec<(Option<i32>, u64)> {
        let mut octaves: BTreeMap<Option<i32>, u64> = BTreeMap::new();
        for (k, bin) in &self.bins {
            let x = f64::from_bits(u64::from(*k) << DROPPED);
            *octaves.entry(octave(x)).or_default() += bin.count;
        }
        octaves.into_iter().collect()
    }

    /// The number of that rank, counted from one, rounded up to the end of its bin.
    fn at_rank(&self, rank: u64) -> f64 {
        let mut below = 0;
        let bin = self.bins.iter().find(|(_, bin)| {
            below += bin.count;
            below >= rank
        });
        let max = f64::from_bits(self.max);
        bin.map_or(max, |(k, _)| match k {
            // Zeros, and subnormal numbers of no interest.
            0 => 0.0,
            k => f64::from_bits((u64::from(*k) << DROPPED) | ((1 << DROPPED) - 1)).min(max),
        })
    }

    /// What was gathered.
    pub fn spread(&self) -> Spread {
        if self.count == 0 {
            return Spread {
                beyond: self.beyond,
                ..Spread::default()
            };
        }
        let rank = |hundredths: u128| (u128::from(self.count) * hundredths).div_ceil(100) as u64;
        Spread {
            count: self.count,
            beyond: self.beyond,
            max: f64::from_bits(self.max),
            p99: self.at_rank(rank(99)),
            median: self.at_rank(rank(50)),
            rms: self.rms(),
        }
    }

    fn rms(&self) -> f64 {
        let exponent = |k: u32| parts(u64::from(k) << DROPPED).1;
        let Some(least) = self.bins.keys().next().map(|k| exponent(*k)) else {
            return 0.0;
        };
        let mut sum = Integer::new();
        for (k, bin) in &self.bins {
            sum += bin.sum() << (2 * (exponent(*k) - least)) as u32;
        }
        let mean = Float::with_val(192, sum) / self.count;
        let root: Float = mean.sqrt() << least;
        root.to_f64()
    }
}

/// The octave of a number, none for zero. Subnormal numbers are in one octave with the smallest normal
/// ones.
pub fn octave(x: f64) -> Option<i32> {
    match (x.to_bits() >> 52) as i32 {
        0 if x.to_bits() >> DROPPED == 0 => None,
        e => Some(e.max(1) - 1023),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn gathered(values: impl IntoIterator<Item = f64>) -> SpreadTally {
        let mut tally = SpreadTally::default();
        values.into_iter().for_each(|v| tally.add(v));
        tally
    }

    fn of(values: impl IntoIterator<Item = f64>) -> Spread {
        gathered(values).spread()
    }

    #[test]
    fn spread() {
        let s = of((1..=200).map(f64::from).chain([f64::NAN]));
        assert_eq!((s.count, s.max, s.beyond), (200, 200.0, 0));
        assert!((198.0..198.2).contains(&s.p99), "{}", s.p99);
        assert!((100.0..100.2).contains(&s.median), "{}", s.median);
        assert_eq!(s.rms, (201.0f64 * 401.0 / 6.0).sqrt());
        assert_eq!(of([]), Spread::default());
        for large in [1e160, 1e300, 1e-300] {
            let s = of([large, 0.0, large, 0.0]);
            assert!((s.rms / large - 0.5f64.sqrt()).abs() < 1e-15, "{s:?}");
        }
        let s = of([f64::MAX, f64::MAX]);
        assert_eq!((s.max, s.rms), (f64::MAX, f64::MAX));
        assert_eq!(of([0.0; 5]).p99, 0.0);
    }

    #[test]
    fn what_no_number_holds_is_counted_apart() {
        let s = of([3.0, f64::INFINITY]);
        assert_eq!(
            (s.count, s.beyond, s.max, s.p99, s.rms),
            (1, 1, 3.0, 3.0, 3.0)
        );
        let s = of([f64::INFINITY]);
        assert_eq!((s.count, s.beyond, s.max), (0, 1, 0.0));
    }

    #[test]
    fn octaves() {
        let tally = gathered([0.0, 1.5, 1.0, 0.26, f64::INFINITY]);
        assert_eq!(tally.octaves(), [(None, 1), (Some(-2), 1), (Some(0), 2)]);
        for x in [1.0, 1.999, 0.3, 1e-300, 1e300] {
            assert_eq!(octave(x), Some(x.log2().floor() as i32), "{x}");
        }
    }

    /// Sums of squares beyond 128 bits.
    #[test]
    fn carries_are_kept() {
        let x = 2f64.next_down();
        let mut tally = gathered([x]);
        for _ in 0..40 {
            let same = tally.clone();
            tally.merge(&same);
        }
        let s = tally.spread();
        assert_eq!((s.count, s.rms), (1 << 40, x));
    }

    /// Not negative, of every size.
    fn any_error() -> impl Strategy<Value = f64> {
        prop_oneof![
            (0..u64::MAX >> 1).prop_map(f64::from_bits),
            0.0..10.0f64,
            Just(0.0),
        ]
    }

    proptest! {
        #[test]
        fn merging_is_adding_in_any_order(
            values in prop::collection::vec(any_error(), 0..60),
            cuts in prop::array::uniform2(0usize..60),
        ) {
            let whole = gathered(values.iter().copied());
            let backwards = gathered(values.iter().rev().copied());
            prop_assert_eq!(&whole, &backwards);
            let cut = |k: usize| k.min(values.len());
            let (i, j) = (cut(cuts[0].min(cuts[1])), cut(cuts[0].max(cuts[1])));
            let part = |r: std::ops::Range<usize>| gathered(values[r].iter().copied());
            let (a, b, c) = (part(0..i), part(i..j), part(j..values.len()));
            let merged = |x: &SpreadTally, y: &SpreadTally| {
                let mut x = x.clone();
                x.merge(y);
                x
            };
            prop_assert_eq!(&merged(&a, &b), &merged(&b, &a));
            prop_assert_eq!(&merged(&merged(&a, &b), &c), &merged(&a, &merged(&b, &c)));
            let all = merged(&merged(&c, &a), &b);
            prop_assert_eq!(&all, &whole);
            let bits = |s: Spread| [s.max, s.p99, s.median, s.rms].map(f64::to_bits);
            prop_assert_eq!(bits(all.spread()), bits(whole.spread()));
        }
    }
}

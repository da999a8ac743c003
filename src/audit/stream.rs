//! Streams of ChaCha8, the first blocks of several at a time.
//!
//! Neither the numbers nor their order may ever change: recorded cases are found again through
//! them.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use std::array::from_fn;

/// Blocks that are computed together: vectors of 128 bits hold as many words.
pub(super) const LANES: usize = 4;
/// Words of a block.
const WORDS: usize = 16;

/// The key, expanded from a seed.
pub(super) type Key = [u32; 8];

/// A word of four blocks each.
pub(super) type Blocks = [[u32; LANES]; WORDS];

/// Returns the key that all streams of a seed share.
pub(super) fn keyed(seed: u64) -> Key {
    let bytes = ChaCha8Rng::seed_from_u64(seed).get_seed();
    from_fn(|k| u32::from_le_bytes(from_fn(|i| bytes[4 * k + i])))
}

macro_rules! quarter_rounds {
    ($x:ident: $($a:literal $b:literal $c:literal $d:literal),+) => {$(
        $x[$a] = $x[$a].wrapping_add($x[$b]);
        $x[$d] = ($x[$d] ^ $x[$a]).rotate_left(16);
        $x[$c] = $x[$c].wrapping_add($x[$d]);
        $x[$b] = ($x[$b] ^ $x[$c]).rotate_left(12);
        $x[$a] = $x[$a].wrapping_add($x[$b]);
        $x[$d] = ($x[$d] ^ $x[$a]).rotate_left(8);
        $x[$c] = $x[$c].wrapping_add($x[$d]);
        $x[$b] = ($x[$b] ^ $x[$c]).rotate_left(7);
    )+};
}

macro_rules! double_round {
    ($x:ident) => {
        quarter_rounds!($x: 0 4 8 12, 1 5 9 13, 2 6 10 14, 3 7 11 15);
        quarter_rounds!($x: 0 5 10 15, 1 6 11 12, 2 7 8 13, 3 4 9 14);
    };
}

macro_rules! store {
    ($all:ident, $i:ident, $x:ident + $start:ident: $($k:literal)+) => {
        $($all[$k][$i] = $x[$k].wrapping_add($start[$k]);)+
    };
}

/// Blocks of that number of each stream.
pub(super) fn blocks(key: &Key, streams: [u64; LANES], numbers: [u64; LANES]) -> Blocks {
    let halves = |x: [u64; LANES]| [x.map(|x| x as u32), x.map(|x| (x >> 32) as u32)];
    let ([n, n_high], [s, s_high]) = (halves(numbers), halves(streams));
    side_by_side(key, &[n, n_high, s, s_high])
}

/// Without loops but that over the blocks, the compiler takes them side by side.
#[inline(never)]
fn side_by_side(key: &Key, places: &[[u32; LANES]; 4]) -> Blocks {
    let mut all = [[0; LANES]; WORDS];
    for i in 0..LANES {
        let [a, b, c, d, e, f, g, h] = *key;
        let (k, l, m, n) = (places[0][i], places[1][i], places[2][i], places[3][i]);
        let [p, q, r, s] = [0x6170_7865, 0x3320_646e, 0x7962_2d32, 0x6b20_6574];
        let start = [p, q, r, s, a, b, c, d, e, f, g, h, k, l, m, n];
        let mut x = start;
        double_round!(x);
        double_round!(x);
        double_round!(x);
        double_round!(x);
        store!(all, i, x + start: 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    }
    all
}

/// The numbers of one stream.
pub(super) struct Stream {
    key: Key,
    number: u64,
    /// The block after those that are at hand.
    next: u64,
    /// Words at hand, the first ones spent.
    words: [u32; LANES * WORDS],
    spent: usize,
    end: usize,
}

impl Stream {
    /// The stream of that number under a key.
    pub(super) fn new(key: &Key, number: u64) -> Stream {
        Stream {
            key: *key,
            number,
            next: 0,
            words: [0; LANES * WORDS],
            spent: 0,
            end: 0,
        }
    }

    /// Begins another stream, whose first block is that of a lane.
    pub(super) fn begin(&mut self, number: u64, blocks: &Blocks, lane: usize) {
        self.number = number;
        self.next = 1;
        for (word, blocks) in self.words.iter_mut().zip(blocks) {
            *word = blocks[lane];
        }
        (self.spent, self.end) = (0, WORDS);
    }

    /// The next 64 bits, the lower word first.
    #[inline]
    pub(super) fn next_u64(&mut self) -> u64 {
        if self.spent == self.end {
            self.refill();
        }
        let (low, high) = (self.words[self.spent], self.words[self.spent + 1]);
        self.spent += 2;
        u64::from(high) << 32 | u64::from(low)
    }

    #[cold]
    fn refill(&mut self) {
        let numbers = from_fn(|i| self.next + i as u64);
        let blocks = blocks(&self.key, [self.number; LANES], numbers);
        self.words = from_fn(|at| blocks[at % WORDS][at / WORDS]);
        self.next += LANES as u64;
        (self.spent, self.end) = (0, LANES * WORDS);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use rand::Rng;

    proptest! {
        /// Number by number those of the crate `chacha20`.
        #[test]
        fn streams_are_those_of_chacha8(
            seed: u64, numbers: [u64; LANES], lane in 0..LANES, earlier in 0usize..40,
        ) {
            let key = keyed(seed);
            let mut other = ChaCha8Rng::seed_from_u64(seed);
            let mut stream = Stream::new(&key, numbers[lane]);
            for begun in [false, true] {
                other.set_stream(numbers[lane]);
                if begun {
                    let first = blocks(&key, numbers, [0; LANES]);
                    stream = Stream::new(&key, seed);
                    (0..earlier).for_each(|_| _ = stream.next_u64());
                    stream.begin(numbers[lane], &first, lane);
                }
                for _ in 0..100 {
                    prop_assert_eq!(stream.next_u64(), other.next_u64());
                }
            }
        }
    }
}

//! Numbers and balls drawn by chance, the same on every machine.

use crate::{Ball, Mag};
use rug::Rational;

/// Pseudo-random numbers (SplitMix64).
pub(crate) struct Draw(pub u64);

impl Draw {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    /// From 0 to n − 1.
    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A fraction from −1 to 1 with a denominator of 21 bits, seldom a power of two.
    pub fn fraction(&mut self) -> Rational {
        let down = (1 << 20) + self.below(1 << 20);
        let up = self.below(2 * down + 1) as i64 - down as i64;
        Rational::from((up, down))
    }

    /// From `from` to `to`.
    pub fn between(&mut self, from: i64, to: i64) -> Rational {
        (self.fraction() + 1u32) * Rational::from((to - from, 2)) + from
    }

    /// A fraction times a power of two from `2^from` to `2^to`.
    pub fn sized(&mut self, from: i32, to: i32) -> Rational {
        let k = from + self.below((to - from + 1) as u64) as i32;
        self.fraction() << k
    }

    /// A ball about a fraction, of `bits` bits and a radius from nothing to a few units, and now
    /// and then a wide one.
    pub fn ball(&mut self, bits: u32, from: i32, to: i32) -> Ball {
        let x = Ball::rational(bits, &self.sized(from, to));
        let x = Ball::new(x.mid().clone(), Mag::ZERO);
        let down = match self.below(4) {
            0 => return x,
            1 => 1 + self.below(8),
            2 => u64::from(bits) / 2 + self.below(8),
            _ => u64::from(bits) + self.below(8),
        };
        let size = Mag::from_f64((1 + self.below(1 << 40)) as f64);
        x.widened(size.shift(i64::from(from) - 40 - down as i64))
    }
}

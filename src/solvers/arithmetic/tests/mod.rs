//! Tests of the arithmetic.

mod double_double;
pub(crate) mod exact;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod packs;
mod payne_hanek;
mod real;

/// Pseudo-random numbers (Steele, Lea & Flood, *Fast splittable pseudorandom number generators*,
/// OOPSLA 2014): the same ones in every run.
pub(crate) struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Evenly in `low … high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let t = (self.bits() >> 11) as f64 / (1u64 << 53) as f64;
        low + t * (high - low)
    }

    /// Evenly in the logarithm, from `2^low` to `2^high`.
    pub fn power(&mut self, low: f64, high: f64) -> f64 {
        self.between(low, high).exp2()
    }

    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// A significand in [1, 2): half of them with a few digits only, where roundings tie.
    pub fn significand(&mut self) -> f64 {
        let mut bits = self.bits() >> 12;
        if self.below(2) == 0 {
            bits &= self.bits() & self.bits() & self.bits() & self.bits();
            if self.below(2) == 0 {
                bits ^= (1 << 52) - 1;
            }
        }
        f64::from_bits(1023 << 52 | bits)
    }

    /// A number of either sign with an exponent of `low … high`.
    pub fn number(&mut self, low: i32, high: i32) -> f64 {
        let e = low + self.below((high - low + 1) as u64) as i32;
        let x = self.significand() * f64::exp2(f64::from(e));
        if self.below(2) == 0 { x } else { -x }
    }
}

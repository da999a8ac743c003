//! Tests of the parts of the Faddeeva function.

mod bits;
#[cfg(target_arch = "x86_64")]
mod branch;
mod double_double;
pub(super) mod exact;
#[cfg(target_arch = "x86_64")]
mod packs;
mod paths;
mod payne_hanek;
mod real;
mod seams;
mod signs_of_zero;
mod special_values;

/// Pseudo-random numbers (Steele, Lea & Flood, *Fast splittable pseudorandom number generators*,
/// OOPSLA 2014): the same ones in every run.
pub(super) struct Random(pub u64);

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

    /// A point of the whole plane, every formula and every edge among them.
    pub fn point(&mut self) -> (f64, f64) {
        const EDGE: [f64; 24] = [
            0.0,
            -0.0,
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            -5e-324,
            -f64::MAX,
            0.125,
            -0.125,
            0.25,
            -0.25,
            1.125,
            1.0,
            3.75,
            7.0,
            -7.0,
            10.0,
            16.0,
            27.5,
            1000.0,
            1e100,
        ];
        let sign = |x: f64, negative: bool| if negative { -x } else { x };
        let (x, y) = match self.below(12) {
            0 => (self.between(0.0, 8.0), self.between(0.0, 8.0)),
            1 => (self.between(0.0, 40.0), self.between(0.0, 40.0)),
            2 => (self.between(0.0, 30.0), self.power(-1074.0, -2.0)),
            3 => (self.power(-1074.0, -2.0), self.between(0.0, 30.0)),
            4 => (self.power(-20.0, 20.0), self.power(-20.0, 20.0)),
            5 => {
                // Beside the diagonal, where both terms are of the same size.
                let a = self.power(0.0, 26.0);
                (a, a + self.between(-30.0, 30.0) / a)
            }
            6 => {
                let z = &super::tables::ZEROS[self.below(12) as usize].0;
                let r = self.power(-60.0, -3.0);
                (
                    z[0] + r * self.between(-1.0, 1.0),
                    -z[3] + r * self.between(-1.0, 1.0),
                )
            }
            7 => (EDGE[self.below(24) as usize], EDGE[self.below(24) as usize]),
            8 => (EDGE[self.below(24) as usize], self.power(-10.0, 10.0)),
            9 => (
                // Middles between centres.
                self.below(230) as f64 / 16.0,
                self.below(230) as f64 / 16.0,
            ),
            10 => (f64::from_bits(self.bits()), f64::from_bits(self.bits())),
            _ => (self.power(-1074.0, 1023.9), self.power(-1074.0, 1023.9)),
        };
        let (p, q) = (self.below(2) == 0, self.below(3) != 0);
        (sign(x, p), sign(y, q))
    }
}

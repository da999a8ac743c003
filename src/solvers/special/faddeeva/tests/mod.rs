//! Tests of the parts of the Faddeeva function.

mod bits;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
mod branch;
mod paths;
mod real_argument;
mod seams;
mod signs_of_zero;
mod special_values;

pub(super) use crate::arithmetic::tests::{Random, exact};

impl Random {
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

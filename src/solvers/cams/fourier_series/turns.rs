//! Multiples of angles in turns, reduced exactly.

use crate::double_double::{Dd, two_prod, two_sum};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// An angle in turns as an unevaluated sum of two numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turns(Dd);

impl Turns {
    pub(super) const ZERO: Turns = Turns(Dd::ZERO);

    /// `n · turns`, exactly.
    pub(super) fn multiple(n: f64, turns: f64) -> Turns {
        Turns(two_prod(n, turns))
    }

    /// `self · x`, with an error of 2u² of it.
    pub(super) fn times(self, x: f64) -> Turns {
        Turns(self.0.mul_f(x))
    }

    /// `self · x` for an `x` of two parts, with an error of 4u² of it.
    pub(super) fn times_pair(self, x: Dd) -> Turns {
        Turns(self.0 * x)
    }

    /// The nearest number of turns.
    pub(super) fn turns(self) -> f64 {
        self.0.value()
    }

    pub(super) fn radians(self) -> f64 {
        TAU * self.0.value()
    }

    /// `1 − 2t`, rounded once.
    pub(super) fn one_minus_twice(self) -> f64 {
        let d = two_sum(1.0, -2.0 * self.0.hi);
        d.add_f(-2.0 * self.0.lo).value()
    }

    /// The sum, of which whole turns are left out.
    pub(super) fn plus(self, other: Turns) -> Turns {
        Turns(self.fraction() + other.fraction())
    }

    pub(super) fn minus(self, other: Turns) -> Turns {
        Turns(self.fraction() - other.fraction())
    }

    fn fraction(self) -> Dd {
        let Dd { hi, lo } = self.0;
        two_sum(hi - hi.round(), lo)
    }

    /// `e^{2πit} − 1`: both parts within a few u of themselves for t within a quarter of whole
    /// turns, within a few u elsewhere.
    pub(super) fn cis_less_one(self) -> Complex64 {
        let (s, c) = (PI * self.fraction().value()).sin_cos();
        Complex64::new(-2.0 * s * s, 2.0 * s * c)
    }

    /// `e^{2πit}`: exact at quarter turns, both parts otherwise within a few u of themselves.
    pub(super) fn cis(self) -> Complex64 {
        let f = self.fraction();
        let quarter = (4.0 * f.hi).round();
        let rest = two_sum(f.hi - 0.25 * quarter, f.lo).value();
        let (s, c) = (TAU * rest).sin_cos();
        match quarter as i64 & 3 {
            0 => Complex64::new(c, s),
            1 => Complex64::new(-s, c),
            2 => Complex64::new(-c, -s),
            _ => Complex64::new(s, -c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Turns;
    use num_complex::Complex64;

    #[test]
    fn multiples_are_reduced_exactly() {
        // 10⁶ · 0.1 turns is 10⁵ turns and 10⁶ (fl(0.1) − 0.1), which is 2^-55 · 0.2 · 10⁶.
        let t = Turns::multiple(1e6, 0.1);
        let off = 1e6 * 0.2 * 2f64.powi(-55);
        assert!((t.cis().im / (std::f64::consts::TAU * off) - 1.0).abs() < 1e-14);
        let exact = |n, re: f64, im: f64| {
            assert_eq!(Turns::multiple(n, 0.25).cis(), Complex64::new(re, im));
        };
        exact(0.0, 1.0, 0.0);
        exact(1.0, 0.0, 1.0);
        exact(999_999.0, 0.0, -1.0);
        exact(999_998.0, -1.0, 0.0);
        // 5 fl(0.1) is a half and 2^-55.
        let past = Turns::multiple(5.0, 0.1).one_minus_twice();
        assert_eq!(past, -(2f64.powi(-54)));
        let sum = Turns::multiple(3.0, 0.75).plus(Turns::multiple(1.0, 0.25));
        assert_eq!(sum.cis().re, -1.0);
    }
}

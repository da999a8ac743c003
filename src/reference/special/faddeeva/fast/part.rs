//! One component with what is proved about it.

use super::fixed_point::{PREC, SCALE};
use crate::{Ball, Mag};
use rug::Float;

/// States what is proved about the sums: an error of 2^9 units.
const SUM_ERROR: i64 = 9 - SCALE as i64;

/// A number with an error bound.
pub struct Part {
    mid: Float,
    error: Mag,
    /// Holds what it may have been cancelled from.
    cancelled: Mag,
}

impl Part {
    /// `n 2^-SCALE factor`, n wrong by 2^9 units.
    #[inline]
    pub fn sum(n: i128, factor: &Float) -> Part {
        Part {
            mid: (Float::with_val(PREC, n) >> SCALE) * factor,
            error: Mag::above(factor).mul(Mag::power_of_two(SUM_ERROR)),
            cancelled: Mag::ZERO,
        }
    }

    /// The same with the factor one.
    #[inline]
    pub fn plain(n: i128) -> Part {
        Part {
            mid: Float::with_val(PREC, n) >> SCALE,
            error: Mag::power_of_two(SUM_ERROR),
            cancelled: Mag::ZERO,
        }
    }

    /// `self + k g`, |k| ≤ 2, where g has a relative error of 2^-140 and the absolute error
    /// `slack`.
    #[inline]
    pub fn plus(self, g: &Float, k: i32, slack: Mag) -> Part {
        let term = Float::with_val(PREC, g * k);
        let relative = Mag::above(&term).shift(-140);
        Part {
            error: self.error.add(relative).add(slack.shift(1)),
            mid: self.mid + term,
            cancelled: Mag::above(g).shift(1),
        }
    }

    #[inline]
    pub fn negated(self) -> Part {
        let mid = -self.mid;
        Part { mid, ..self }
    }

    /// The ball, with the roundings of the few operations on floats (each relative to a result of
    /// 160 bits): 2^-150 of the number and of what it may have been cancelled from.
    #[inline]
    pub fn ball(self) -> Ball {
        let rounding = Mag::above(&self.mid).add(self.cancelled).shift(-150);
        Ball::new(self.mid, self.error.add(rounding))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn f(x: f64) -> Float {
        Float::with_val(300, x)
    }

    /// Two to the power of k.
    fn p(k: i32) -> Float {
        f(1.0) << k
    }

    /// A number that no double holds: a bound of 53 bits has to lie above it.
    fn long() -> Float {
        f(1.5) + p(-100)
    }

    /// From what is due to a little more.
    fn is(ball: &Ball, mid: Float, rad: Float) {
        assert!(*ball.mid() == mid, "{ball:?} {mid}");
        let found = Float::with_val(400, ball.rad().to_float());
        assert!(
            found >= rad && found <= rad.clone() * (1.0 + 1e-12),
            "{ball:?} {rad}"
        );
    }

    /// 2^9 units, and 2^-150 of the number.
    #[test]
    fn sums_are_wrong_by_512_units() {
        let three = 3i128 << (SCALE - 1);
        is(
            &Part::plain(three).ball(),
            f(1.5),
            p(-113) + f(1.5) * p(-150),
        );
        is(
            &Part::plain(-three).ball(),
            f(-1.5),
            p(-113) + f(1.5) * p(-150),
        );
        let due = long() * (p(-113) + f(1.5) * p(-150));
        is(
            &Part::sum(three, &long()).ball(),
            f(1.5) * long(),
            due.clone(),
        );
        is(
            &Part::sum(three, &-long()).negated().ball(),
            f(1.5) * long(),
            due,
        );
        // Where rounding is all there is, and where there is next to none.
        is(&Part::sum(three, &f(0.0)).ball(), f(0.0), f(0.0));
        is(
            &Part::sum(1 << 126, &long()).ball(),
            16 * long(),
            long() * (p(-113) + p(-146)),
        );
        is(&Part::plain(0).ball(), f(0.0), p(-113));
    }

    /// `k g` with 2^-140 of it, twice the slack, and 2^-150 of the sum and of 2g.
    #[test]
    fn terms_bring_their_errors() {
        for g in [long(), -long(), long() * p(80), long() * p(-80)] {
            for k in [-2i32, -1, 1, 2] {
                for (slack, twice) in [(Mag::ZERO, f(0.0)), (Mag::power_of_two(-120), p(-119))] {
                    let size = Float::with_val(300, g.abs_ref());
                    let mid = Float::with_val(PREC, f(1.0) + g.clone() * k);
                    let terms = size.clone() * k.abs() * p(-140) + size * 2 * p(-150);
                    let due = p(-113) + terms + mid.clone().abs() * p(-150) + twice;
                    let part = Part::plain(1 << SCALE).plus(&g, k, slack);
                    is(&part.ball(), mid, due);
                }
            }
        }
        // Roundings alone: g is zero and so is the factor of the sum.
        let none = Part::sum(1, &f(0.0)).plus(&long(), 1, Mag::ZERO);
        is(&none.ball(), long(), long() * (p(-140) + 3 * p(-150)));
    }
}

//! The distance between a double and a ball.

use super::{BITS, Ball};
use crate::Mag;
use gmp_mpfr_sys::gmp::LIMB_BITS;

/// Bounds on a number and on its distance from a double, in doubles: the numbers of units that
/// [`Ball::mignitude`] and [`Ball::distance_from`] give.
///
/// A bound is rounded to nearest and moved to the next double, and both are the same in any unit
/// that is a power of two as long as no double leaves the normal range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// The exponent of the unit: the midpoint holds from 2¹²⁷ to 2¹²⁸ of them.
    pub unit: i64,
    /// The number holds so many at least, more than 2¹²⁶.
    pub size: f64,
    /// The distance is at least that; zero or more than 2⁻³⁶⁰.
    pub least: f64,
    /// The distance is at most that; zero or at least 2⁻³⁰⁰, below 2¹²⁹.
    pub most: f64,
}

impl Ball {
    /// Bounds on the distance of this number from an exact and finite `x`: at least, at most.
    pub fn distance_from(&self, x: f64) -> (Mag, Mag) {
        if let Some(([least, most], unit)) = self.integers(x) {
            let least = Mag::of_integer(least, unit, false);
            let most = Mag::of_integer(most, unit, true);
            return (least.sub_below(self.rad), most.add(self.rad));
        }
        let p = self.prec().max(BITS);
        let difference = Ball::nearest(p, x - &self.mid, self.rad);
        (difference.mignitude(), difference.magnitude())
    }

    /// [`Ball::distance_from`] in doubles: `None` where `x` is beyond the next power of two or
    /// subnormal, or where the radius is more than 2⁻⁸ of the number or next to nothing.
    #[inline]
    pub fn apart_from(&self, x: f64) -> Option<Apart> {
        let unit = i64::from(self.mid.get_exp()?) - 128;
        let significand = self.mid.get_significand()?;
        let limbs = significand.as_limbs();
        let (&[.., high], 64) = (limbs, LIMB_BITS) else {
            return None;
        };
        let [least, most] = match self.integers(x) {
            Some(([least, most], _)) => [Mag::rounded(least, false), Mag::rounded(most, true)],
            None => self.below_power(limbs, x)?,
        };
        let rad = self.rad.shift(-unit);
        let normal = |e: i64| (-300..120).contains(&e);
        if !(rad.is_zero() || rad.exponent().is_some_and(normal)) {
            return None;
        }
        let rad = rad.to_f64();
        // [`Mag::sub_below`] and [`Mag::add`] of numbers that are not negative.
        let minus = |a: f64| match (a > rad, rad == 0.0) {
            (true, false) => f64::from_bits((a - rad).to_bits() - 1),
            (true, true) => a,
            (false, _) => 0.0,
        };
        let plus = |a: f64| match a == 0.0 || rad == 0.0 {
            true => a + rad,
            false => f64::from_bits((a + rad).to_bits() + 1),
        };
        Some(Apart {
            unit,
            size: minus(Mag::rounded(u128::from(high) << 64, false)),
            least: minus(least),
            most: plus(most),
        })
    }

    /// Bounds on `|x − mid|` in units, where x is the power of two above the midpoint, of these
    /// limbs.
    fn below_power(&self, limbs: &[impl Copy + Into<u64>], x: f64) -> Option<[f64; 2]> {
        let same_sign = self.mid.is_sign_negative() == x.is_sign_negative();
        let power = x.is_normal() && x.to_bits() << 12 == 0;
        let exponent = (x.to_bits() << 1 >> 53) as i64 - 1023;
        if !(same_sign && power && exponent == i64::from(self.mid.get_exp()?)) {
            return None;
        }
        // The limbs of the difference: what is above the last limb that is not zero is inverted.
        let last = limbs.iter().position(|&limb| limb.into() != 0)?;
        let of = |i: usize| match limbs[i].into() {
            limb if i > last => !limb,
            limb => limb.wrapping_neg(),
        };
        let top = (last..limbs.len()).rev().find(|&i| of(i) != 0)?;
        let next = if top > last { of(top - 1) } else { 0 };
        // More than 53 bits: the last of them only says that there are others.
        let d = u128::from(of(top)) << 64 | u128::from(next) | u128::from(top > last + 1);
        let limbs_below = (limbs.len() - 1 - top) as i64;
        let unit = Mag::power_of_two(-64 * limbs_below).to_f64();
        let near = limbs_below <= 3;
        near.then(|| [false, true].map(|up| Mag::rounded(d, up) * unit))
    }

    /// Bounds on `|x − mid|` in units of `2^unit` where x holds a whole number of units: a tenth of
    /// the time of a difference in MPFR, which judgements consist of.
    #[inline]
    fn integers(&self, x: f64) -> Option<([u128; 2], i64)> {
        /// Bits of the integers beyond those of a double.
        const SPARE: i64 = u128::BITS as i64 - f64::MANTISSA_DIGITS as i64;
        let unit = i64::from(self.mid.get_exp()?) - 128;
        let significand = self.mid.get_significand()?;
        let (mid, rest) = match (significand.as_limbs(), LIMB_BITS) {
            (&[high], 64) => (u128::from(high) << 64, false),
            (&[ref rest @ .., low, high], 64) => (
                u128::from(high) << 64 | u128::from(low),
                rest.iter().any(|&limb| limb != 0),
            ),
            _ => return None,
        };
        if self.mid.is_sign_negative() != x.is_sign_negative() || !x.is_normal() {
            return None;
        }
        let bits = x.to_bits();
        let m = u128::from(bits << 12 >> 12 | 1 << 52);
        let shift = (bits << 1 >> 53) as i64 - 1075 - unit;
        // No bit is lost.
        let x = (0..=SPARE).contains(&shift).then(|| m << shift)?;
        // The part that is cut off of mid is less than a unit.
        let d = mid.abs_diff(x);
        let rest = u128::from(rest);
        Some(([d.saturating_sub(rest), d.checked_add(rest)?], unit))
    }

    /// Returns true if [`Ball::distance_from`] takes its quick way.
    #[cfg(test)]
    pub(super) fn on_integers(&self, x: f64) -> bool {
        self.integers(x).is_some()
    }
}

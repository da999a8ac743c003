//! Upper bounds on magnitudes with an unlimited exponent: the radius of a [`Ball`](super::Ball).

use gmp_mpfr_sys::gmp::LIMB_BITS;
use rug::Float;
use rug::float::Round;
use std::cmp::Ordering;

/// A non-negative number `m · 2^e` that is only ever rounded **up**, so that it stays an upper
/// bound through any chain of operations.
///
/// `m` lies in `[1, 2)`, or is 0, or is infinite; `e` is a 64-bit exponent, so radii of
/// 10 000-digit balls neither underflow nor overflow. Each operation is one `f64` operation
/// rounded to nearest followed by [`f64::next_up`], which is an upper bound because the rounding
/// error is at most half the spacing to the neighbour above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mag {
    m: f64,
    e: i64,
}

/// `2^k` as an `f64`, for `k` in the normal range.
#[inline]
fn pow2(k: i64) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// From a distance of 54 binary places on, a number is less than half a unit of another.
const FAR: i64 = 60;

/// A limb, whatever its size here.
fn wide(limb: impl Into<u64>) -> u64 {
    limb.into()
}

impl Mag {
    /// Zero: an exact value.
    pub const ZERO: Mag = Mag { m: 0.0, e: 0 };
    /// No bound at all.
    pub const INFINITY: Mag = Mag {
        m: f64::INFINITY,
        e: 0,
    };

    /// Brings `m > 0` back into `[1, 2)`; exact.
    #[inline]
    fn normal(m: f64, e: i64) -> Mag {
        const FIELD: u64 = 0x7ff << 52;
        let bits = m.to_bits();
        match (bits & FIELD) >> 52 {
            // Subnormal: scale into the normal range first.
            0 if m != 0.0 => Mag::normal(m * pow2(200), e - 200),
            0 | 0x7ff => Mag { m, e: 0 },
            k => Mag {
                m: f64::from_bits(bits & !FIELD | 1023 << 52),
                e: e + k as i64 - 1023,
            },
        }
    }

    /// The magnitude of `x`, exactly; infinite for NaN.
    #[inline]
    pub fn from_f64(x: f64) -> Mag {
        if x.is_nan() {
            return Mag::INFINITY;
        }
        Mag::normal(x.abs(), 0)
    }

    /// `2^k`.
    #[inline]
    pub fn power_of_two(k: i64) -> Mag {
        Mag { m: 1.0, e: k }
    }

    /// An upper bound on `|x|` (53 bits, rounded away from zero).
    pub fn above(x: &Float) -> Mag {
        Mag::of_float(x, true)
    }

    /// A lower bound on `|x|` (53 bits, rounded towards zero). NaN gives zero.
    pub fn below(x: &Float) -> Mag {
        if x.is_nan() {
            return Mag::ZERO;
        }
        Mag::of_float(x, false)
    }

    fn of_float(x: &Float, up: bool) -> Mag {
        let Some(significand) = x.get_significand() else {
            return if x.is_zero() {
                Mag::ZERO
            } else {
                Mag::INFINITY
            };
        };
        // MPFR's leading limb begins with a one.
        if let ([rest @ .., last], 64) = (significand.as_limbs(), LIMB_BITS)
            && let Some(e) = x.get_exp()
        {
            let last = wide(*last);
            let cut = last & 0x7ff != 0 || rest.iter().any(|&limb| limb != 0);
            let m = (last >> 11) + u64::from(up && cut);
            return Mag::normal(m as f64 * pow2(-52), i64::from(e) - 1);
        }
        Mag::of_any_limbs(x, up)
    }

    /// Of a number that is not zero, infinite or NaN.
    fn of_any_limbs(x: &Float, up: bool) -> Mag {
        let round = if up { Round::AwayZero } else { Round::Zero };
        let (m, e) = x.to_f64_exp_round(round);
        Mag::normal(m.abs(), i64::from(e))
    }

    /// `d` to 53 bits, rounded up or down.
    #[inline]
    pub(super) fn rounded(d: u128, up: bool) -> f64 {
        let cut = 75u32.saturating_sub(d.leading_zeros());
        let m = (d >> cut) as u64 + u64::from(up && (d >> cut) << cut != d);
        // Less than or equal to 2^53: exact.
        m as i64 as f64 * pow2(i64::from(cut))
    }

    /// A bound on `d · 2^e`, from above or from below.
    pub(super) fn of_integer(d: u128, e: i64, up: bool) -> Mag {
        Mag::normal(Mag::rounded(d, up), e)
    }

    /// Returns true if this is exactly zero.
    #[inline]
    pub fn is_zero(self) -> bool {
        self.m == 0.0
    }

    /// Returns true if this bounds anything.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.m.is_finite()
    }

    /// The exponent: the value lies in `[2^e, 2^(e+1))`. `None` for zero and infinity.
    #[inline]
    pub fn exponent(self) -> Option<i64> {
        (self.m != 0.0 && self.m.is_finite()).then_some(self.e)
    }

    /// `self · 2^k`; exact.
    #[inline]
    pub fn shift(self, k: i64) -> Mag {
        match self.exponent() {
            Some(e) => Mag {
                m: self.m,
                e: e + k,
            },
            None => self,
        }
    }

    /// An upper bound on `self + other`.
    #[allow(clippy::should_implement_trait)]
    #[inline]
    pub fn add(self, other: Mag) -> Mag {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        if !self.is_finite() || !other.is_finite() {
            return Mag::INFINITY;
        }
        let (big, small) = if self.e >= other.e {
            (self, other)
        } else {
            (other, self)
        };
        let d = big.e - small.e;
        let m = if d > FAR {
            big.m.next_up()
        } else {
            (big.m + small.m * pow2(-d)).next_up()
        };
        Mag::normal(m, big.e)
    }

    /// An upper bound on `self · other`; zero times anything finite is zero.
    #[allow(clippy::should_implement_trait)]
    #[inline]
    pub fn mul(self, other: Mag) -> Mag {
        if !self.is_finite() || !other.is_finite() {
            return Mag::INFINITY;
        }
        if self.is_zero() || other.is_zero() {
            return Mag::ZERO;
        }
        Mag::normal((self.m * other.m).next_up(), self.e + other.e)
    }

    /// An upper bound on `self / lower` where `lower` is a **lower** bound of the divisor.
    /// Infinite when `lower` is zero and `self` is not.
    #[allow(clippy::should_implement_trait)]
    #[inline]
    pub fn div(self, lower: Mag) -> Mag {
        if self.is_zero() {
            return Mag::ZERO;
        }
        if lower.is_zero() || !self.is_finite() {
            return Mag::INFINITY;
        }
        if !lower.is_finite() {
            return Mag::ZERO;
        }
        Mag::normal((self.m / lower.m).next_up(), self.e - lower.e)
    }

    /// A **lower** bound on `self − upper`, where `self` is a lower bound and `upper` an upper
    /// bound; zero if the difference may be negative.
    pub fn sub_below(self, upper: Mag) -> Mag {
        if upper.is_zero() {
            return self;
        }
        if self.partial_cmp(&upper) != Some(Ordering::Greater) || !upper.is_finite() {
            return Mag::ZERO;
        }
        if !self.is_finite() {
            return self;
        }
        let d = self.e - upper.e;
        let m = if d > FAR {
            self.m.next_down()
        } else {
            (self.m - upper.m * pow2(-d)).next_down()
        };
        // Positive still: the two differ by 2⁻⁵³ at least, without rounding where they are near.
        Mag::normal(m, self.e)
    }

    /// The largest number of 53 bits that is not above `self + other`, of **lower** bounds; zero of
    /// infinite ones, of which nothing is known.
    pub fn add_below(self, other: Mag) -> Mag {
        if !self.is_finite() || !other.is_finite() {
            return Mag::ZERO;
        }
        if self < other {
            return other.add_below(self);
        }
        if other.is_zero() {
            return self;
        }
        let small = other.m * pow2(-(self.e - other.e).min(FAR));
        let sum = self.m + small;
        // The exact rounding error.
        let rest = small - (sum - self.m);
        Mag::normal(if rest < 0.0 { sum.next_down() } else { sum }, self.e)
    }

    /// The largest number of 53 bits that is not above `self · other`, likewise.
    pub fn mul_below(self, other: Mag) -> Mag {
        if !self.is_finite() || !other.is_finite() {
            return Mag::ZERO;
        }
        let m = self.m * other.m;
        let rest = self.m.mul_add(other.m, -m);
        Mag::normal(if rest < 0.0 { m.next_down() } else { m }, self.e + other.e)
    }

    /// An upper bound on `√self`.
    #[inline]
    pub fn sqrt(self) -> Mag {
        match self.exponent() {
            None => self,
            Some(e) => {
                let odd = e.rem_euclid(2);
                Mag::normal((self.m * pow2(odd)).sqrt().next_up(), (e - odd) / 2)
            }
        }
    }

    /// The larger of the two.
    #[inline]
    pub fn max(self, other: Mag) -> Mag {
        if self.partial_cmp(&other) == Some(Ordering::Less) {
            other
        } else {
            self
        }
    }

    /// The smaller.
    pub fn min(self, other: Mag) -> Mag {
        if other < self { other } else { self }
    }

    /// An upper bound as an `f64` (infinite beyond its range, at least the smallest subnormal for
    /// anything positive).
    #[inline]
    pub fn to_f64(self) -> f64 {
        match self.exponent() {
            None => self.m,
            Some(e) if e < -1022 => {
                if e < -1074 {
                    return f64::from_bits(1);
                }
                (self.m * pow2(e + 200) * pow2(-200)).next_up()
            }
            // 2^1024 is infinite.
            Some(e) => self.m * pow2(e.min(1024)),
        }
    }

    /// The value as a 53-bit float; outside MPFR's range of exponents the least positive float, or
    /// infinity.
    pub fn to_float(self) -> Float {
        let mut f = Float::with_val(f64::MANTISSA_DIGITS, self.m);
        let Some(e) = self.exponent() else { return f };
        f <<= i32::try_from(e).unwrap_or(if e < 0 { i32::MIN } else { i32::MAX });
        if f.is_zero() {
            f.next_up();
        }
        f
    }
}

impl PartialOrd for Mag {
    fn partial_cmp(&self, other: &Mag) -> Option<Ordering> {
        let special = |x: &Mag| x.m == 0.0 || x.m.is_infinite();
        if special(self) || special(other) {
            return self.m.partial_cmp(&other.m);
        }
        Some(
            self.e
                .cmp(&other.e)
                .then(self.m.partial_cmp(&other.m).unwrap_or(Ordering::Equal)),
        )
    }
}

#[cfg(test)]
mod tests;

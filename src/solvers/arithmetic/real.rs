//! One number or several side by side: the formulas are written once, for an `f64` and for vectors
//! of four or eight of them.
//!
//! Every operation is correctly rounded in each place, so that a value has the same bits whichever
//! way it was computed.

use crate::hex::hex;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Adding and subtracting this rounds a number below 2⁵¹ to an integer `k`; the low bits of the
/// sum are those of `k`.
pub const ROUND: f64 = hex("0x1.8p52");

/// A real number, or several in places of their own.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Truth values.
    type Mask: Copy;
    /// The constant `x` in every place.
    fn like(self, x: f64) -> Self;
    /// `self · b + c` with one rounding.
    fn fma(self, b: Self, c: Self) -> Self;
    /// `self + b = s + e` exactly (Knuth).
    #[inline(always)]
    fn two_sum(self, b: Self) -> (Self, Self) {
        let s = self + b;
        let t = s - self;
        (s, (self - (s - t)) + (b - t))
    }
    /// `self + b = s + e` exactly if `|self| ≥ |b|` or `self = 0` (Dekker).
    #[inline(always)]
    fn fast_two_sum(self, b: Self) -> (Self, Self) {
        let s = self + b;
        (s, b - (s - self))
    }
    /// `self · b = p + e` exactly, barring underflow.
    #[inline(always)]
    fn two_prod(self, b: Self) -> (Self, Self) {
        let p = self * b;
        (p, self.fma(b, -p))
    }
    /// Its absolute value.
    fn magnitude(self) -> Self;
    /// `low` if it is smaller.
    fn at_least(self, low: Self) -> Self;
    /// `high` if it is larger.
    fn at_most(self, high: Self) -> Self;
    /// At least a constant. Where the result is squared: of a comparison written out a compiler
    /// squares both sides and then chooses, and a square that underflows takes as long as half of a
    /// formula.
    fn raised(self, least: f64) -> Self;
    /// Returns whether it is smaller than the other one.
    fn below(self, other: Self) -> Self::Mask;
    /// Returns whether either is true.
    fn or(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// One or the other.
    fn pick(self, mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The second constant where the mask is true, else the first.
    #[inline(always)]
    fn either(self, second: Self::Mask, [a, b]: [f64; 2]) -> Self {
        self.pick(second, self.like(b), self.like(a))
    }
    /// Returns whether the mask is true in every place.
    fn all(self, mask: Self::Mask) -> bool;
    /// 2^k, where `self` is `ROUND + k` and `k` within the normal exponents.
    fn power_of_two(self) -> Self;
    /// Returns whether `k` is odd, where `self` is `ROUND + k`.
    fn is_odd(self) -> Self::Mask;
    /// `x`, negated if the second bit of `k` is set, where `self` is `ROUND + k`.
    fn flip(self, x: Self) -> Self;
}

impl Real for f64 {
    type Mask = bool;
    #[inline(always)]
    fn like(self, x: f64) -> f64 {
        x
    }
    #[inline(always)]
    fn fma(self, b: f64, c: f64) -> f64 {
        self.mul_add(b, c)
    }
    #[inline(always)]
    fn magnitude(self) -> f64 {
        self.abs()
    }
    #[inline(always)]
    fn at_least(self, low: f64) -> f64 {
        if self < low { low } else { self }
    }
    #[inline(always)]
    fn raised(self, least: f64) -> f64 {
        self.max(least)
    }
    #[inline(always)]
    fn at_most(self, high: f64) -> f64 {
        if self > high { high } else { self }
    }
    #[inline(always)]
    fn below(self, other: f64) -> bool {
        self < other
    }
    #[inline(always)]
    fn or(self, a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn pick(self, mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn all(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn power_of_two(self) -> f64 {
        f64::from_bits((self.to_bits().wrapping_add(1023)) << 52)
    }
    #[inline(always)]
    fn is_odd(self) -> bool {
        self.to_bits() & 1 != 0
    }
    #[inline(always)]
    fn flip(self, x: f64) -> f64 {
        f64::from_bits(x.to_bits() ^ (self.to_bits() & 2) << 62)
    }
}

/// `x · 2^k` where `n = ROUND + k`, in two steps, so that only the last one may round or overflow.
#[inline(always)]
pub(crate) fn scaled<R: Real>(x: R, n: R) -> R {
    let round = x.like(ROUND);
    let k = n - round;
    let half = k.fma(x.like(0.5), round);
    let rest = (k - (half - round)) + round;
    x * half.power_of_two() * rest.power_of_two()
}

/// Where a number is zero.
#[inline(always)]
pub(crate) fn is_zero<R: Real>(x: R) -> R::Mask {
    x.magnitude().below(x.like(f64::from_bits(1)))
}

/// `t`, negated if `x` has a minus sign: without a branch, which for signs by chance is taken
/// wrongly every other time.
#[inline(always)]
pub(crate) fn with_sign_of(t: f64, x: f64) -> f64 {
    f64::from_bits(t.to_bits() ^ (x.to_bits() & (1 << 63)))
}

/// Numbers whose formula is chosen place by place: all places take a formula if any needs it, and
/// those that need it keep its value.
pub(crate) trait Masked: Real {
    /// Returns whether the mask is true in any place.
    fn any(self, mask: Self::Mask) -> bool;
    /// Where both are true.
    fn both(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Where `a` is true and `b` is not.
    fn except(self, a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `self`, negated where `x` has a minus sign.
    fn with_sign_of(self, x: Self) -> Self;
    /// Its square root.
    fn root(self) -> Self;
}

impl Masked for f64 {
    #[inline(always)]
    fn any(self, mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn both(self, a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn except(self, a: bool, b: bool) -> bool {
        a & !b
    }
    #[inline(always)]
    fn with_sign_of(self, x: f64) -> f64 {
        with_sign_of(self, x)
    }
    #[inline(always)]
    fn root(self) -> f64 {
        self.sqrt()
    }
}

/// Four numbers as an array, for processors without vectors of four.
#[derive(Clone, Copy)]
pub(crate) struct Four(pub [f64; 4]);

macro_rules! elementwise {
    ($trait:ident, $method:ident) => {
        impl $trait for Four {
            type Output = Four;
            #[inline(always)]
            fn $method(self, other: Four) -> Four {
                Four(std::array::from_fn(|i| self.0[i].$method(other.0[i])))
            }
        }
    };
}
elementwise!(Add, add);
elementwise!(Sub, sub);
elementwise!(Mul, mul);
elementwise!(Div, div);

impl Neg for Four {
    type Output = Four;
    #[inline(always)]
    fn neg(self) -> Four {
        Four(self.0.map(|x| -x))
    }
}

impl Four {
    #[inline(always)]
    fn zip(self, other: Four, f: impl Fn(f64, f64) -> f64) -> Four {
        Four(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl Real for Four {
    type Mask = [bool; 4];
    #[inline(always)]
    fn like(self, x: f64) -> Four {
        Four([x; 4])
    }
    // Four calls where there is no instruction for it: inlined they are most of the time that tests
    // take to build.
    #[cfg_attr(debug_assertions, inline(never))]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn fma(self, b: Four, c: Four) -> Four {
        Four(std::array::from_fn(|i| self.0[i].mul_add(b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn magnitude(self) -> Four {
        Four(self.0.map(f64::abs))
    }
    #[inline(always)]
    fn at_least(self, low: Four) -> Four {
        self.zip(low, f64::at_least)
    }
    #[inline(always)]
    fn raised(self, least: f64) -> Four {
        Four(self.0.map(|x| x.raised(least)))
    }
    #[inline(always)]
    fn at_most(self, high: Four) -> Four {
        self.zip(high, f64::at_most)
    }
    #[inline(always)]
    fn below(self, other: Four) -> [bool; 4] {
        std::array::from_fn(|i| self.0[i] < other.0[i])
    }
    #[inline(always)]
    fn or(self, a: [bool; 4], b: [bool; 4]) -> [bool; 4] {
        std::array::from_fn(|i| a[i] | b[i])
    }
    #[inline(always)]
    fn pick(self, mask: [bool; 4], yes: Four, no: Four) -> Four {
        Four(std::array::from_fn(|i| {
            if mask[i] { yes.0[i] } else { no.0[i] }
        }))
    }
    #[inline(always)]
    fn all(self, mask: [bool; 4]) -> bool {
        mask == [true; 4]
    }
    #[inline(always)]
    fn power_of_two(self) -> Four {
        Four(self.0.map(|x| x.power_of_two()))
    }
    #[inline(always)]
    fn is_odd(self) -> [bool; 4] {
        self.0.map(|x| x.is_odd())
    }
    #[inline(always)]
    fn flip(self, x: Four) -> Four {
        self.zip(x, |n, x| n.flip(x))
    }
}

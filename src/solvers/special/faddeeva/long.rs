//! Binary floating-point numbers of 256 bits, for the few points where two `f64` have too few.
//!
//! Results are cut off, not rounded: each operation is within 2⁻²⁵⁴ of the exact result, a sum
//! within 2⁻²⁵⁵ of its larger term.

use crate::real::{ROUND, scaled};
use std::array::from_fn;
use std::ops::{Add, Mul, Neg, Sub};

/// Words of a significand.
const WORDS: usize = 4;
const BITS: i64 = 64 * WORDS as i64;

/// `±0.m · 2^exponent`: the words of m from the leading one on, whose first bit is set; or zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Long {
    negative: bool,
    exponent: i64,
    m: [u64; WORDS],
}

/// The words of `m · 2^by` that are left.
fn left<const N: usize>(m: &[u64; N], by: u32) -> [u64; N] {
    let (words, bits) = ((by / 64) as usize, by % 64);
    let word = |i: usize| m.get(i + words).copied().unwrap_or(0);
    from_fn(|i| match bits {
        0 => word(i),
        _ => word(i) << bits | word(i + 1) >> (64 - bits),
    })
}

/// The same for `m · 2^-by`.
fn right(m: &[u64; WORDS], by: u32) -> [u64; WORDS] {
    let (words, bits) = ((by / 64) as usize, by % 64);
    let word = |i: Option<usize>| i.map_or(0, |i| m[i]);
    from_fn(|i| {
        let (here, before) = (i.checked_sub(words), i.checked_sub(words + 1));
        match bits {
            0 => word(here),
            _ => word(here) >> bits | word(before) << (64 - bits),
        }
    })
}

impl Long {
    pub(super) const ZERO: Long = Long {
        negative: false,
        exponent: 0,
        m: [0; WORDS],
    };
    pub(super) const ONE: Long = Long::parts(1, [1 << 63, 0, 0, 0]);

    /// `0.m · 2^exponent`; the first bit of m has to be set.
    pub(super) const fn parts(exponent: i64, m: [u64; WORDS]) -> Long {
        Long {
            negative: false,
            exponent,
            m,
        }
    }

    /// Exponent and words of m.
    #[cfg(feature = "proof")]
    pub(super) fn words(self) -> (i64, [u64; WORDS]) {
        (self.exponent, self.m)
    }

    /// `±0.m · 2^exponent` with any words.
    pub(super) fn normal<const N: usize>(negative: bool, exponent: i64, m: &[u64; N]) -> Long {
        let Some(words) = m.iter().position(|w| *w != 0) else {
            return Long::ZERO;
        };
        let zeros = 64 * words as u32 + m[words].leading_zeros();
        let m = left(m, zeros);
        Long {
            negative,
            exponent: exponent - i64::from(zeros),
            m: from_fn(|i| m.get(i).copied().unwrap_or(0)),
        }
    }

    /// A finite number, exactly.
    pub(super) fn from(x: f64) -> Long {
        let (bits, fraction) = (x.to_bits(), x.to_bits() & ((1 << 52) - 1));
        let (m, e) = match (bits >> 52) as i64 & 0x7ff {
            0 => (fraction, -1074),
            e => (fraction | 1 << 52, e - 1075),
        };
        Long::normal(x.is_sign_negative(), e + 64, &[m])
    }

    /// The nearest `f64`.
    pub(super) fn value(self) -> f64 {
        if self.is_zero() || self.exponent < -1074 {
            return if self.negative { -0.0 } else { 0.0 };
        }
        // Fewer digits below the normal numbers: 0 at half of the smallest.
        let digits = (self.exponent + 1074).min(53);
        let first = u128::from(self.m[0]) << 32;
        let (whole, rest) = (first >> (96 - digits), first << (32 + digits));
        let rest = rest | u128::from(self.m[1..].iter().any(|w| *w != 0));
        let half = 1 << 127;
        let up = rest > half || rest == half && whole % 2 == 1;
        let size = (whole + u128::from(up)) as f64;
        let size = scaled(size, ROUND + (self.exponent - digits).min(2000) as f64);
        if self.negative { -size } else { size }
    }

    pub(super) fn is_zero(self) -> bool {
        self.m[0] == 0
    }

    pub(super) fn is_negative(self) -> bool {
        self.negative
    }

    /// `self · 2^k`
    pub(super) fn scale(self, k: i64) -> Long {
        Long {
            exponent: self.exponent + k,
            ..self
        }
    }

    /// `self/n`
    pub(super) fn over(self, n: u64) -> Long {
        let mut rest = 0;
        let m: [u64; WORDS + 1] = from_fn(|i| {
            let t = u128::from(rest) << 64 | u128::from(self.m.get(i).copied().unwrap_or(0));
            rest = (t % u128::from(n)) as u64;
            (t / u128::from(n)) as u64
        });
        Long::normal(self.negative, self.exponent, &m)
    }

    /// `1/self` by Newton's method, from 52 bits on.
    pub(super) fn recip(self) -> Long {
        let m = self.scale(-self.exponent);
        let mut r = Long::from(1.0 / m.value());
        for _ in 0..3 {
            r = r + r * (Long::ONE - m * r);
        }
        r.scale(-self.exponent)
    }

    pub(super) fn square(self) -> Long {
        self * self
    }
}

impl Neg for Long {
    type Output = Long;
    fn neg(self) -> Long {
        Long {
            negative: !self.negative,
            ..self
        }
    }
}

impl Add for Long {
    type Output = Long;
    fn add(self, other: Long) -> Long {
        if self.is_zero() || other.is_zero() {
            return if self.is_zero() { other } else { self };
        }
        let (a, b) = match (self.exponent, self.m) < (other.exponent, other.m) {
            true => (other, self),
            false => (self, other),
        };
        let apart = a.exponent - b.exponent;
        if apart >= BITS {
            return a;
        }
        let b_m = right(&b.m, apart as u32);
        let mut m = a.m;
        let mut carry = false;
        for (x, y) in m.iter_mut().zip(b_m).rev() {
            let ((s, p), c) = match a.negative == b.negative {
                true => (x.overflowing_add(y), u64::from(carry)),
                false => (x.overflowing_sub(y), u64::from(carry)),
            };
            let (s, q) = match a.negative == b.negative {
                true => s.overflowing_add(c),
                false => s.overflowing_sub(c),
            };
            (*x, carry) = (s, p | q);
        }
        if carry {
            // Only a sum of like signs is above 1.
            m = right(&m, 1);
            m[0] |= 1 << 63;
        }
        Long::normal(a.negative, a.exponent + i64::from(carry), &m)
    }
}

impl Sub for Long {
    type Output = Long;
    fn sub(self, other: Long) -> Long {
        self + -other
    }
}

impl Mul for Long {
    type Output = Long;
    fn mul(self, other: Long) -> Long {
        let mut product = [0; 2 * WORDS];
        for i in (0..WORDS).rev() {
            let mut carry = 0;
            for j in (0..WORDS).rev() {
                let t = u128::from(self.m[i]) * u128::from(other.m[j])
                    + u128::from(product[i + j + 1])
                    + u128::from(carry);
                (product[i + j + 1], carry) = (t as u64, (t >> 64) as u64);
            }
            product[i] = carry;
        }
        let negative = self.negative != other.negative;
        // Its first bit is the first or the second.
        let [p, q, r, s, t, ..] = product;
        Long::normal(negative, self.exponent + other.exponent, &[p, q, r, s, t])
    }
}

#[cfg(test)]
mod tests;

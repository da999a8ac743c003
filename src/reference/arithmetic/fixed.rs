//! Numbers of 256 binary places in machine words, for functions that MPFR is slow at.
//!
//! A [`Fraction`] is a number in `[0, 1)` in units of `u = 2^−256`, a [`Fixed`] one below `2^64`.
//! Both are arrays of words, the least one first. Products are cut off: of those of two words that
//! reach no higher than a unit, at most three reach as high, so that a product is too small by less
//! than 5u.

use rug::integer::Order;
use rug::{Float, Integer};
use std::cmp::Ordering;

/// A number in `[0, 1)`.
pub(crate) type Fraction = [u64; 4];

/// A number in `[0, 2^64)`.
pub(crate) type Fixed = [u64; 5];

/// Binary places.
pub(crate) const PLACES: u32 = 256;

/// `a b`, too small by less than 5u.
#[inline]
pub(crate) fn times(a: &Fraction, b: &Fraction) -> Fraction {
    let mut sum = [0_u64; 5];
    for i in 0..4 {
        let mut carry = 0;
        for j in 3 - i..4 {
            let place = i + j - 3;
            let product = u128::from(a[i]) * u128::from(b[j]);
            let all = product + u128::from(sum[place]) + u128::from(carry);
            (sum[place], carry) = (all as u64, (all >> 64) as u64);
        }
        sum[i + 1] = carry;
    }
    let [_, rest @ ..] = sum;
    rest
}

/// `a + b`, and whether it is one or more, which is cut off.
#[inline]
pub(crate) fn plus<const N: usize>(a: &[u64; N], b: &[u64; N]) -> ([u64; N], bool) {
    let mut sum = [0; N];
    let mut carry = false;
    for k in 0..N {
        let (x, first) = a[k].overflowing_add(b[k]);
        let (x, second) = x.overflowing_add(carry.into());
        (sum[k], carry) = (x, first | second);
    }
    (sum, carry)
}

/// `a − b`, and whether it is negative: one, or `2^64`, is then added.
#[inline]
pub(crate) fn minus<const N: usize>(a: &[u64; N], b: &[u64; N]) -> ([u64; N], bool) {
    let mut difference = [0; N];
    let mut borrow = false;
    for k in 0..N {
        let (x, first) = a[k].overflowing_sub(b[k]);
        let (x, second) = x.overflowing_sub(borrow.into());
        (difference[k], borrow) = (x, first | second);
    }
    (difference, borrow)
}

/// `a / n`, cut off.
#[inline]
pub(crate) fn over(a: &Fraction, n: u64) -> Fraction {
    let mut quotient = [0; 4];
    let mut rest = 0;
    for k in (0..4).rev() {
        let all = u128::from(rest) << 64 | u128::from(a[k]);
        quotient[k] = (all / u128::from(n)) as u64;
        rest = (all % u128::from(n)) as u64;
    }
    quotient
}

/// `2^−bits a`, cut off, for less than 64 bits.
#[inline]
pub(crate) fn halved<const N: usize>(a: &[u64; N], bits: u32) -> [u64; N] {
    std::array::from_fn(|k| {
        let above = a.get(k + 1).copied().unwrap_or(0);
        match bits {
            0 => a[k],
            _ => a[k] >> bits | above << (64 - bits),
        }
    })
}

/// `2^bits a` modulo one, for less than 64 bits.
#[inline]
pub(crate) fn doubled(a: &Fraction, bits: u32) -> Fraction {
    std::array::from_fn(|k| match (bits, k) {
        (0, _) => a[k],
        (_, 0) => a[0] << bits,
        _ => a[k] << bits | a[k - 1] >> (64 - bits),
    })
}

/// `a n`.
pub(crate) fn product(a: &Fixed, n: u64) -> [u64; 6] {
    let mut found = [0; 6];
    let mut carry = 0;
    for (place, limb) in found.iter_mut().zip(a) {
        carry += u128::from(*limb) * u128::from(n);
        (*place, carry) = (carry as u64, carry >> 64);
    }
    found[5] = carry as u64;
    found
}

/// `2^−bits a`, cut off. None if it is `2^64` or more.
pub(crate) fn quotient_of_power(a: &[u64; 6], bits: u32) -> Option<Fixed> {
    let [all @ .., above] = shifted(a, bits);
    (above == 0).then_some(all)
}

/// `a / b`, cut off, for a quotient below one.
pub(crate) fn ratio(a: &Fraction, b: &Fixed) -> Fraction {
    let [a, b] = [&a[..], &b[..]].map(|x| Integer::from_digits(x, Order::Lsf));
    let mut found = [0; 4];
    if b != 0 && a < b {
        let quotient: Integer = (a << PLACES) / b;
        quotient.write_digits(&mut found, Order::Lsf);
    }
    found
}

/// A fraction with the whole number zero.
pub(crate) fn widen([a, b, c, d]: Fraction) -> Fixed {
    [a, b, c, d, 0]
}

/// `|x|` without the bits beyond the places. None for what is not a number below `2^64`.
pub(crate) fn of_float(x: &Float) -> Option<Fixed> {
    if x.is_zero() {
        return Some([0; 5]);
    }
    let e = i64::from(x.get_exp()?);
    if e > 64 || usize::BITS != 64 {
        return None;
    }
    let mut found = [0; 5];
    let significand = x.get_significand()?;
    // The place of the last bit of each word, the highest word first.
    let mut place = e + 192;
    for &limb in significand.as_limbs().iter().rev() {
        #[allow(clippy::unnecessary_cast)]
        let limb = limb as u64;
        match place {
            0.. => {
                let (word, bit) = ((place / 64) as usize, place % 64);
                found[word] |= limb << bit;
                if bit > 0 && word < 4 {
                    found[word + 1] |= limb >> (64 - bit);
                }
            }
            -63..0 => found[0] |= limb >> -place,
            _ => break,
        }
        place -= 64;
    }
    Some(found)
}

/// `x` without the bits beyond the places, for `0 ≤ x < 1`.
pub(crate) fn fraction(x: &Float) -> Fraction {
    let [a, b, c, d, _] = of_float(x).unwrap_or_default();
    [a, b, c, d]
}

/// The number next to `±2^shift v` that has `prec` bits, where every number within `error` units of
/// v that is not halfway between two such numbers, nor one of them, is rounded to it.
pub(crate) fn nearest(
    v: &Fixed,
    error: u64,
    shift: i64,
    negative: bool,
    prec: u32,
) -> Option<(Float, Ordering)> {
    let word = v.iter().rposition(|x| *x != 0)?;
    let bits = 64 * word as u32 + 64 - v[word].leading_zeros();
    // Numbers halfway between two others are multiples of 2^half units.
    let half = bits.checked_sub(prec + 1)?;
    let error: Fixed = [error, 0, 0, 0, 0];
    let (low, is_below) = minus(v, &error);
    let (high, is_above) = plus(v, &error);
    let (low, high) = (shifted(&low, half), shifted(&high, half));
    if is_below || is_above || low != high {
        return None;
    }
    let is_up = low[0] & 1 == 1;
    let (even, _) = plus(&low, &[u64::from(is_up), 0, 0, 0, 0]);
    let whole = Integer::from_digits(&halved(&even, 1), Order::Lsf);
    let shift = i32::try_from(i64::from(half) + 1 - i64::from(PLACES) + shift).ok()?;
    let mut mid = Float::with_val(prec, &whole);
    mid <<= shift;
    if negative {
        mid = -mid;
    }
    let ordering = match is_up != negative {
        true => Ordering::Greater,
        false => Ordering::Less,
    };
    Some((mid, ordering))
}

/// `2^−bits v`, cut off.
fn shifted<const N: usize>(v: &[u64; N], bits: u32) -> [u64; N] {
    let words = (bits / 64) as usize;
    let moved: [u64; N] = std::array::from_fn(|k| v.get(k + words).copied().unwrap_or(0));
    halved(&moved, bits % 64)
}

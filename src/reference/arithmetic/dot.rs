//! Sums of products of numbers of one precision, in fixed point with one rounding.
//!
//! # Method
//! Let all terms `w a b` of the sum be below `2^top`. They are added in units of
//! `2^(top − 64 (L + 1))`, where L is the number of 64-bit words of a significand: each product is
//! exact in 2L + 1 words and is cut to the L + 1 words of the sum, above which one more takes
//! carries and the sign.
//!
//! # Error
//! The largest term is at least `2^(top − 3)`, so n terms cut off lose less than
//! `n 2^(top − 64 (L + 1)) ≤ n 2^−61 u Σ |w a b|` with `u = 2^−bits ≥ 2^(−64 L)`; the sum is rounded
//! once. For `n ≤ 2^40` the result is within `(1 + 2^−20) u Σ |w a b|` of the sum: far less than
//! what the bound `γ_n Σ |w a b|` of n rounded products and sums allows (Higham, *Accuracy and
//! Stability of Numerical Algorithms*, 2nd ed. 2002, §3.1), and no more than that for one term
//! where γ is rounded up by a ten thousandth. Beyond [`MOST`] words, and for numbers of several
//! precisions, every product and every sum is rounded.

use rug::integer::Order;
use rug::{Assign, Float, Integer};

/// The most words of a significand. From about 600 bits on GMP's products take most of the time.
const MOST: usize = 8;

/// `Σ w(i) a_i b_(k−i)` over `low ≤ i ≤ high`, at `bits` bits.
pub(crate) fn convolution(
    [a, b]: [&[Float]; 2],
    k: usize,
    [low, high]: [usize; 2],
    weight: impl Fn(usize) -> i64,
    bits: u32,
) -> Float {
    let terms = (low..=high).map(|i| (&a[i], &b[k - i], weight(i)));
    let sum = match bits.div_ceil(64) {
        1 => fixed::<1>(terms.clone(), bits),
        2 => fixed::<2>(terms.clone(), bits),
        3 => fixed::<3>(terms.clone(), bits),
        4 => fixed::<4>(terms.clone(), bits),
        5 => fixed::<5>(terms.clone(), bits),
        6 => fixed::<6>(terms.clone(), bits),
        7 => fixed::<7>(terms.clone(), bits),
        8 => fixed::<8>(terms.clone(), bits),
        _ => None,
    };
    sum.unwrap_or_else(|| rounded(terms, bits))
}

/// The sum with every product and every sum rounded.
fn rounded<'a>(terms: impl Iterator<Item = (&'a Float, &'a Float, i64)>, bits: u32) -> Float {
    let (mut sum, mut product) = (Float::new(bits), Float::new(bits));
    for (a, b, w) in terms {
        product.assign(a * b);
        if w != 1 {
            product *= w;
        }
        sum += &product;
    }
    sum
}

/// The exponent e of a term below `2^e`; `None` if it is zero.
fn exponent((a, b, w): (&Float, &Float, i64)) -> Option<i64> {
    let of_weight = match w {
        0 => return None,
        1 => 0,
        _ => i64::from(u64::BITS - w.unsigned_abs().leading_zeros()),
    };
    Some(i64::from(a.get_exp()?) + i64::from(b.get_exp()?) + of_weight)
}

/// The sum of numbers whose significands have L words; `None` if one has other words or is not
/// finite.
fn fixed<'a, const L: usize>(
    terms: impl Iterator<Item = (&'a Float, &'a Float, i64)> + Clone,
    bits: u32,
) -> Option<Float> {
    if terms
        .clone()
        .any(|(a, b, _)| !a.is_finite() || !b.is_finite())
    {
        return None;
    }
    let Some(top) = terms.clone().filter_map(exponent).max() else {
        return Some(Float::new(bits));
    };
    let mut sum = [0; MOST + 2];
    for term in terms {
        let Some(e) = exponent(term) else { continue };
        let (a, b, w) = term;
        let (a_words, b_words) = (a.get_significand()?, b.get_significand()?);
        let product = product::<L>(
            a_words.as_limbs().try_into().ok()?,
            b_words.as_limbs().try_into().ok()?,
            w.unsigned_abs(),
        );
        // The product is an integer times 2^(e − bits of the weight − 128 L).
        let of_weight = e - i64::from(a.get_exp()?) - i64::from(b.get_exp()?);
        let down = (top - e + of_weight) as u64 + 64 * (L as u64 - 1);
        let (words, shift) = (usize::try_from(down / 64).ok()?, (down % 64) as u32);
        let word = |j: usize| product.get(j + words).copied().unwrap_or(0);
        let shifted = |j: usize| match shift {
            0 => word(j),
            _ => word(j) >> shift | word(j + 1) << (64 - shift),
        };
        match (a.is_sign_negative() != b.is_sign_negative()) != (w < 0) {
            false => add(&mut sum[..L + 2], shifted),
            true => subtract(&mut sum[..L + 2], shifted),
        }
    }
    let sum = &mut sum[..L + 2];
    let is_negative = sum[L + 1] >> 63 == 1;
    if is_negative {
        negate(sum);
    }
    let mut value = Float::with_val(bits, &Integer::from_digits(&*sum, Order::Lsf));
    value <<= i32::try_from(top - 64 * (L as i64 + 1)).ok()?;
    Some(if is_negative { -value } else { value })
}

/// The words of `w a b`, the lowest first.
fn product<const L: usize>(a: &[u64; L], b: &[u64; L], w: u64) -> [u64; 2 * MOST + 1] {
    let mut product = [0; 2 * MOST + 1];
    for (i, &x) in a.iter().enumerate() {
        let mut carry = 0;
        for (j, &y) in b.iter().enumerate() {
            (product[i + j], carry) = times(x, y, product[i + j], carry);
        }
        product[i + L] = carry;
    }
    if w != 1 {
        let mut carry = 0;
        for word in &mut product[..=2 * L] {
            (*word, carry) = times(*word, w, 0, carry);
        }
    }
    product
}

/// The low and the high word of `x y + a + b`.
fn times(x: u64, y: u64, a: u64, b: u64) -> (u64, u64) {
    let all = u128::from(x) * u128::from(y) + u128::from(a) + u128::from(b);
    (all as u64, (all >> 64) as u64)
}

/// Adds words to all but the last of the sum, which takes the carry.
fn add(sum: &mut [u64], words: impl Fn(usize) -> u64) {
    let (last, others) = sum.split_last_mut().expect("a word for carries");
    let mut carry = false;
    for (j, s) in others.iter_mut().enumerate() {
        let (t, first) = s.overflowing_add(words(j));
        let (t, second) = t.overflowing_add(u64::from(carry));
        (*s, carry) = (t, first | second);
    }
    *last = last.wrapping_add(u64::from(carry));
}

/// Subtracts words likewise.
fn subtract(sum: &mut [u64], words: impl Fn(usize) -> u64) {
    let (last, others) = sum.split_last_mut().expect("a word for carries");
    let mut borrow = false;
    for (j, s) in others.iter_mut().enumerate() {
        let (t, first) = s.overflowing_sub(words(j));
        let (t, second) = t.overflowing_sub(u64::from(borrow));
        (*s, borrow) = (t, first | second);
    }
    *last = last.wrapping_sub(u64::from(borrow));
}

/// Changes the sign of a number in two's complement.
fn negate(words: &mut [u64]) {
    let mut carry = true;
    for word in words {
        (*word, carry) = (!*word).overflowing_add(u64::from(carry));
    }
}

#[cfg(test)]
mod tests;

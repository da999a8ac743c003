//! Decides whether an analytic function of a whole number comes close to a whole number.
//!
//! In blocks it is replaced by the polynomial through some values, which is stepped by differences,
//! modulo one in 128 bits. With N equidistant values at distance h it is wrong by at most
//! `(h^N (N − 1)!/4) |f^{(N)}|/N!`, and by Cauchy's estimate `|f^{(N)}|/N!` is at most
//! `max |f|/ρ^N`, on the disc of radius ρ, a quarter of the first number. An error of the values
//! grows by less than 2^N, that of the differences, 2⁻¹²⁸, by less than 2⁷⁴. Where the polynomial
//! is within 2⁻³⁰ of a whole number the function itself is computed.

use crate::ProofError;
use crate::bounds::power_up;
use crate::certificate::Watch;
use crate::interval::{product_up, quotient_up, sum_up};
use mechaudit_reference::{Ball, Mag};
use rayon::prelude::*;
use rug::{Float, Integer};

/// The value at a number, with that many bits.
pub(super) type Value<'a> = &'a (dyn Fn(u64, u32) -> Result<Ball, ProofError> + Sync);

/// A function of whole numbers, times a power of two.
pub(super) struct Smooth<'a> {
    /// The value, with that many bits.
    pub value: Value<'a>,
    /// The exponent of the power, for a block with this value.
    pub shift: &'a (dyn Fn(f64) -> i32 + Sync),
    /// A bound of the value on the disc of a quarter of the number about it.
    pub most: &'a (dyn Fn(u64) -> f64 + Sync),
    /// Tells whether short blocks with many values serve for all numbers.
    pub few: bool,
}

const BITS: u32 = 192;
const MORE_BITS: u32 = 400;
/// Bits of numbers that are computed exactly.
const EXACT: u32 = 400;
/// Closer to a whole number the value itself is asked.
const CLOSE: f64 = 1.0 / 1_073_741_824.0;
/// No value may be closer: a change of 2⁻¹²⁹ moves a number of 56 bits by less.
const CLOSEST: i64 = -60;
/// Numbers of the first blocks.
const DIRECT: u64 = 1 << 15;
/// Blocks at a time, between looks at the watch.
const AT_ONCE: usize = 256;

/// A run of numbers. Its values reach as far as it does: beyond them the remainder is no bound.
#[derive(Clone, Copy, Debug)]
struct Block {
    first: u64,
    len: u64,
    /// How many, none where each number is looked at by itself, and their distance.
    values: u64,
    h: u64,
}

impl Smooth<'_> {
    /// The number of numbers from `first` to `last`, none with a value next to a whole number;
    /// `None` if it was stopped.
    ///
    /// # Errors
    /// Where one may be.
    pub fn stays_off(
        &self,
        first: u64,
        last: u64,
        watch: &Watch,
    ) -> Result<Option<u64>, ProofError> {
        if last < first {
            return Ok(Some(0));
        }
        let blocks = self.blocks(first, last);
        for some in blocks.chunks(AT_ONCE) {
            if watch.is_stopped() {
                return Ok(None);
            }
            some.par_iter()
                .map(|b| self.block(*b))
                .collect::<Result<(), ProofError>>()?;
        }
        Ok(Some(last - first + 1))
    }

    fn blocks(&self, first: u64, last: u64) -> Vec<Block> {
        let mut all = Vec::new();
        let mut at = first;
        while at <= last {
            let (values, h) = match at {
                _ if at < DIRECT => (0, 0),
                _ if self.few || at < 1 << 24 => (10, (at >> 11).min(1017) / 9),
                _ => (7, (at >> 14).min(8190) / 6),
            };
            let len = match values {
                0 => 64.min(DIRECT - at),
                _ => (values - 1) * h,
            };
            all.push(Block {
                first: at,
                len: len.min(last - at + 1),
                values,
                h,
            });
            at += len;
        }
        all
    }

    fn scaled(&self, n: u64, bits: u32) -> Result<(Ball, i32), ProofError> {
        let x = (self.value)(n, bits)?;
        let shift = (self.shift)(middle(&x));
        Ok((x.shift(shift), shift))
    }

    /// The value itself.
    fn is_off(&self, n: u64) -> Result<(), ProofError> {
        for bits in [BITS, MORE_BITS] {
            let (x, _) = self.scaled(n, bits)?;
            let whole = Ball::new(Float::with_val(EXACT, x.mid().round_ref()), Mag::ZERO);
            if (&x - &whole).mignitude() > Mag::power_of_two(CLOSEST) {
                return Ok(());
            }
        }
        Err(ProofError::Fails(format!(
            "number {n} may be next to an f64"
        )))
    }

    fn block(&self, block: Block) -> Result<(), ProofError> {
        let Block {
            first,
            len,
            values,
            h,
        } = block;
        if values == 0 {
            return (first..first + len).try_for_each(|n| self.is_off(n));
        }
        let mut error = 2f64.powi(-54);
        let mut table: Vec<Float> = Vec::new();
        let (begin, shift) = self.scaled(first, BITS)?;
        for i in 0..values {
            let x = match i {
                0 => begin.clone(),
                _ => (self.value)(first + i * h, BITS)?.shift(shift),
            };
            error = sum_up(error, product_up(2048.0, x.rad().to_f64()));
            table.push(Float::with_val(EXACT, x.mid()));
        }
        let past = first + values * h;
        let ratio = quotient_up(4.0 * h as f64, first as f64);
        let factorial: f64 = (1..values).map(|i| i as f64).product();
        let most = product_up((self.most)(past), f64::from(shift).exp2());
        let remainder = product_up(
            product_up(power_up(ratio, values as u32), 0.25 * factorial),
            most,
        );
        if sum_up(error, remainder) > 0.5 * CLOSE {
            return Err(ProofError::Fails(format!(
                "from {first} on values are too far apart: {remainder:e}"
            )));
        }
        let mut step = unit_differences(table, h);
        for n in first..first + len {
            if is_close(step[0]) {
                self.is_off(n)?;
            }
            for i in 1..step.len() {
                step[i - 1] = step[i - 1].wrapping_add(step[i]);
            }
        }
        Ok(())
    }
}

/// Returns the middle of a ball as an `f64`.
pub(super) fn middle(x: &Ball) -> f64 {
    x.mid().to_f64()
}

/// Returns whether a number modulo one, in units of 2⁻¹²⁸, is within [`CLOSE`] of a whole one.
fn is_close(x: u128) -> bool {
    const REACH: u128 = 1 << 98;
    x.wrapping_add(REACH) < 2 * REACH
}

/// Differences, the first value at their head.
fn differences(mut table: Vec<Float>) -> Vec<Float> {
    for i in 1..table.len() {
        for j in (i..table.len()).rev() {
            let before = table[j - 1].clone();
            table[j] -= before;
        }
    }
    table
}

/// Of the polynomial with values at distance h, the differences at distance one, modulo one in
/// units of 2⁻¹²⁸.
fn unit_differences(table: Vec<Float>, h: u64) -> Vec<u128> {
    let d = differences(table);
    let values = (0..d.len()).map(|t| {
        // Σ d_i binom(t/h, i)
        let mut sum = Float::with_val(EXACT, 0);
        let mut binomial = Float::with_val(EXACT, 1);
        for (i, d) in d.iter().enumerate() {
            sum += Float::with_val(EXACT, d * &binomial);
            let factor = Float::with_val(EXACT, t as i64 - (i as u64 * h) as i64);
            binomial *= factor;
            binomial /= h * (i as u64 + 1);
        }
        sum
    });
    let one = Integer::from(1) << 128;
    let modulo = |x: Float| {
        let whole: Integer = (x << 128u32).round().to_integer().expect("finite");
        let rest = whole.modulo(&one);
        rest.to_u128().expect("below 2^128")
    };
    differences(values.collect())
        .into_iter()
        .map(modulo)
        .collect()
}

#[cfg(test)]
mod tests;

//! Judgements that are a pass within ulps, in doubles: the usual case, in a part of the time.
//!
//! Bit for bit those of `Mag`, whose operations are those of doubles on significands, each rounded
//! to nearest and moved to the next double; see [`mechaudit_reference::Apart`]. Here numbers of
//! units are within 2^±360 and factors within 2^±100, sums of squares from 2⁻¹⁰⁰⁰ on or zero: no
//! operation leaves the normal range.

use super::norm::Squares;
use super::{ComponentJudgement, Judgement, Rules, Verdict};
use crate::budget::Limit;
use crate::expected::Values;

/// Returns the judgement of values that certainly pass. `None` if they do not, if the reference's
/// own width is a part of what would be said, or where doubles do not reach.
pub(super) fn passing(rules: &Rules, got: &[f64], values: Values) -> Option<Judgement> {
    let precision = rules.format.precision();
    // From units to ulps of a number of 128 bits.
    let to_ulps = pow2(precision - 128);
    // Neither a number nor its ulps are at the lower end of the range.
    let least_unit = rules.format.least() + precision - 124;
    let outputs = rules.outputs;
    let mut components = Vec::with_capacity(got.len());
    let mut sums = None;
    for i in 0..got.len() {
        let output = &outputs[i % outputs.len()];
        let Limit::Ulps(factor) = output.budget.limit else {
            return None;
        };
        let found = values.get(i).number()?.apart_from(got[i])?;
        let ulps = found.most * to_ulps;
        let of_budget = ratio(ulps, factor);
        let wide = of_budget > 1.0 / 16.0 && 2.0 * found.least < found.most;
        if !(ulps <= factor) || wide || found.unit < least_unit || !is_ordinary(factor) {
            return None;
        }
        let own = Sums {
            unit: found.unit,
            size: product(found.size, found.size),
            error: product(found.most, found.most),
        };
        sums = Some(match sums {
            None => own,
            Some(sums) => own.added_to(sums)?,
        });
        components.push(ComponentJudgement {
            output: output.name,
            verdict: Verdict::Pass,
            kind: None,
            ulps,
            conditioned: f64::NAN,
            of_budget,
            condition: f64::NAN,
        });
    }
    let Sums { size, error, .. } = sums?;
    let size = product(root(size), Squares::below(got.len()));
    let error_in_u = root(error) * pow2(precision);
    let mut norm_of_budget = f64::NAN;
    if let Some(budget) = rules.norm {
        let allowed = product(budget.factor, size);
        if !(is_ordinary(budget.factor) && error_in_u <= allowed) {
            return None;
        }
        norm_of_budget = ratio(error_in_u, allowed);
    }
    Some(Judgement {
        verdict: Verdict::Pass,
        kind: None,
        reason: None,
        components,
        normwise: ratio(error_in_u, size),
        norm_of_budget,
        wide: false,
    })
}

/// Sums of squares in units of `2^(2 unit)`, zero or at least 2⁻¹⁰⁰⁰; the unit of the largest.
#[derive(Clone, Copy)]
struct Sums {
    unit: i64,
    size: f64,
    error: f64,
}

impl Sums {
    /// Adds the sums of others. `None` where doubles do not hold both and neither is next to nothing
    /// beside the other.
    #[inline]
    fn added_to(self, others: Sums) -> Option<Sums> {
        /// The largest distance of two units' exponents at which doubles hold both.
        const NEAR: i64 = 200;
        let (large, small) = match self.unit > others.unit {
            true => (self, others),
            false => (others, self),
        };
        let apart = large.unit - small.unit;
        // Beyond, the smaller sums are smaller still.
        let scale = pow2(-2 * apart.min(NEAR));
        let add = |large: f64, small: f64| {
            let scaled = small * scale;
            match apart <= NEAR {
                _ if small == 0.0 => Some(large),
                _ if scaled < pow2(-1000) => None,
                true => Some(sum(large, scaled)),
                false => (scaled <= large * pow2(-60)).then_some(up(large)),
            }
        };
        Some(Sums {
            unit: large.unit,
            size: add(large.size, small.size)?,
            error: add(large.error, small.error)?,
        })
    }
}

/// `2^k` of a normal number.
#[inline]
fn pow2(k: i64) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// Returns true for factors within 2^±100.
#[inline]
fn is_ordinary(factor: f64) -> bool {
    (pow2(-100)..pow2(100)).contains(&factor)
}

/// The next double above a positive one.
#[inline]
fn up(x: f64) -> f64 {
    f64::from_bits(x.to_bits() + 1)
}

/// `Mag::div`
#[inline]
fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { up(a / b) }
}

/// `Mag::mul`
#[inline]
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { up(a * b) }
}

/// `Mag::sqrt`
#[inline]
fn root(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { up(x.sqrt()) }
}

/// `Mag::add`
#[inline]
fn sum(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        a + b
    } else {
        up(a + b)
    }
}

#[cfg(test)]
mod tests;

//! Judgements that are a pass within ulps, in doubles: the usual case, in a part of the time.
//!
//! Bit for bit those of [`Mag`], whose operations are those of doubles on significands, each rounded to
//! nearest and moved to the next double; see [`mechaudit_reference::Apart`]. Here numbers of units are within 2^±300 and
//! factors within 2^±100, so that no operation leaves the normal range, squares included.

use super::norm::Squares;
use super::{ComponentJudgement, Judgement, Rules, Verdict};
use crate::budget::{Limit, NormBudget};
use crate::expected::Values;
use mechaudit_reference::Mag;

/// The largest distance of two units' exponents at which their numbers are added as doubles.
const NEAR: i64 = 200;

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
    // Sums of squares in units of 2^first.
    let mut first = None;
    let mut near = true;
    let (mut size, mut error) = (0.0, 0.0);
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
        let apart = found.unit - *first.get_or_insert(found.unit);
        near &= apart.abs() <= NEAR;
        if near {
            let scale = pow2(apart);
            size = plus_square(size, found.size * scale);
            error = plus_square(error, found.most * scale);
        }
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
    let norm = match near {
        true => {
            first?;
            let size = product(root(size), Squares::below(got.len()));
            within(rules.norm, size, root(error), precision)
        }
        false => norm_of_any_size(rules, &components, values),
    };
    let (normwise, norm_of_budget) = norm?;
    Some(Judgement {
        verdict: Verdict::Pass,
        kind: None,
        reason: None,
        components,
        normwise,
        norm_of_budget,
        wide: false,
    })
}

/// The error of a norm in units of u and its share of the budget, if it is within that; both in the
/// same units.
fn within(
    budget: Option<&NormBudget>,
    size: f64,
    error: f64,
    precision: i64,
) -> Option<(f64, f64)> {
    let error_in_u = error * pow2(precision);
    let normwise = ratio(error_in_u, size);
    let Some(budget) = budget else {
        return Some((normwise, f64::NAN));
    };
    let allowed = product(budget.factor, size);
    let fits = is_ordinary(budget.factor) && error_in_u <= allowed;
    fits.then(|| (normwise, ratio(error_in_u, allowed)))
}

/// [`within`], of values that are too far apart for doubles.
fn norm_of_any_size(
    rules: &Rules,
    components: &[ComponentJudgement],
    values: Values,
) -> Option<(f64, f64)> {
    let mut squares = Squares::default();
    for (i, c) in components.iter().enumerate() {
        let ball = values.get(i).number()?;
        let ulp = rules.format.ulp_exponent(ball.mid());
        let error = Mag::from_f64(c.ulps).shift(ulp);
        squares.add(Some(ball.mignitude()), Mag::ZERO, error);
    }
    let norms = squares.norms(rules.format);
    let normwise = squares.normwise(norms, rules.format);
    let Some(budget) = rules.norm else {
        return Some((normwise, f64::NAN));
    };
    let (verdict, share) = squares.verdict(norms, budget, rules.format);
    (verdict == Verdict::Pass).then_some((normwise, share))
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

/// [`Mag::div`]
#[inline]
fn ratio(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { up(a / b) }
}

/// [`Mag::mul`]
#[inline]
fn product(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { up(a * b) }
}

/// [`Mag::sqrt`]
#[inline]
fn root(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { up(x.sqrt()) }
}

/// [`Mag::add`] of the square.
#[inline]
fn plus_square(sum: f64, x: f64) -> f64 {
    let square = product(x, x);
    match sum == 0.0 || square == 0.0 {
        true => sum + square,
        false => up(sum + square),
    }
}

#[cfg(test)]
mod tests;

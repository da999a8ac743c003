//! Certified decimals of a method's values.

use super::definition::Evaluable;
use crate::audit::Uncertified;
use crate::reference::faddeeva::Scaled;
use rug::Rational;

/// The least precision in bits that references are written for.
const LEAST_FIRST: u32 = 64;

/// Bits that are tried at least, however few digits are asked for: where two assembly modes nearly
/// meet, telling them apart takes far more bits than two digits of their angles.
const LEAST_LAST: u32 = 1024;

/// A value, and its decimals where they are certain.
#[derive(Clone, Debug)]
pub struct CertifiedValue {
    /// The value at the last precision that was tried.
    pub value: Scaled,
    /// The decimals; `None` where the value could not be told from zero, or not well enough.
    pub decimal: Option<String>,
    /// The reason why there is no number, where the method says it.
    pub why: Option<String>,
}

/// The values of a method at exact numbers, each with `digits` significant decimal digits where
/// these can be certified.
///
/// The precision is doubled until every value for which `is_wanted` holds has its digits, up to
/// eight times the first precision or 1024 bits: a reference that is undecided at the first one
/// may decide, or refuse, at a later one.
///
/// ```
/// use mechaudit::methods::{certified_digits, find};
/// use rug::Rational;
/// let erf = find("erf").expect("a method");
/// let z = [Rational::from((1, 2)), Rational::new()];
/// let [re, im] = &certified_digits(&*erf, &z, 25, |_| true)?[..] else { unreachable!() };
/// assert_eq!(re.decimal.as_deref(), Some("0.5204998778130465376827467"));
/// assert_eq!(im.decimal.as_deref(), Some("0"));
/// # Ok::<(), mechaudit::audit::Uncertified>(())
/// ```
///
/// # Errors
/// A refusal, or the reason why the reference is undecided at every precision.
pub fn certified_digits(
    method: &dyn Evaluable,
    numbers: &[Rational],
    digits: u32,
    is_wanted: impl Fn(usize) -> bool,
) -> Result<Vec<CertifiedValue>, Uncertified> {
    if let Some(found) = method.digits(numbers, digits) {
        return Ok(found);
    }
    let mut found: Result<Vec<CertifiedValue>, Uncertified> =
        Err(Uncertified::Undecided("no precision was tried".into()));
    for bits in precisions(digits) {
        let values = match method.certify(numbers, bits) {
            Ok(values) => values,
            Err(undecided @ Uncertified::Undecided(_)) => {
                // Values of a lower precision hold.
                if found.is_err() {
                    found = Err(undecided);
                }
                continue;
            }
            Err(other) => return Err(other),
        };
        let decimals = values.into_iter().map(|value| CertifiedValue {
            decimal: value.to_decimal(digits as usize),
            value,
            why: None,
        });
        let all: Vec<CertifiedValue> = decimals.collect();
        let is_open = |(i, v): (usize, &CertifiedValue)| v.decimal.is_none() && is_wanted(i);
        let is_done = !all.iter().enumerate().any(is_open);
        found = Ok(all);
        if is_done {
            break;
        }
    }
    found
}

/// The precisions in bits: that of two digits and four bits more than are asked for, 64 at least,
/// and its doubles. Most references keep to the relative accuracy asked for, so that the first is
/// enough.
fn precisions(digits: u32) -> impl Iterator<Item = u32> {
    let needed = ((f64::from(digits) + 2.0) * std::f64::consts::LOG2_10).ceil() as u32 + 4;
    let first = needed.max(LEAST_FIRST);
    let last = (8 * first).max(LEAST_LAST);
    std::iter::successors(Some(first), |bits| Some(2 * bits)).take_while(move |bits| *bits <= last)
}

#[cfg(test)]
mod tests;

//! The error of a single value, split into method error and rounding.

use super::answer::{ReferenceAnswer, SolverAnswer};
use super::judged::answer_of;
use super::method::Method;
use super::ulp::{ulp_exponent, ulps};
use mechaudit_reference::Ball;
use rug::Rational;
use serde::Serialize;

/// Where the error of a value comes from, in ulps of the reference, as upper bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorParts {
    /// Of the method: twin less reference.
    pub method: f64,
    /// Of rounding: value less twin.
    pub rounding: f64,
}

/// Those of the worst value of an output at an input; `None` where the method has no
/// [twin](Method::twin), or there are no values.
pub(super) fn error_parts(
    method: &dyn Method,
    input: &[f64],
    output: usize,
    bits: u32,
) -> Option<ErrorParts> {
    let twin = method.twin(input)?;
    let exact: Vec<Rational> = input
        .iter()
        .map(|&x| Rational::from_f64(x))
        .collect::<Option<_>>()?;
    let ReferenceAnswer::Values(reference) = method.reference(&exact, bits) else {
        return None;
    };
    let SolverAnswer::Values(values) = answer_of(method, input) else {
        return None;
    };
    if twin.len() != values.len() || reference.values.len() != values.len() {
        return None;
    }
    let error = |i: &usize| ulps(values[*i], &reference.values[*i]).1;
    let own = (output..values.len()).step_by(method.outputs().len());
    let i = own.max_by(|a, b| error(a).total_cmp(&error(b)))?;
    let (truth, unit) = (
        &reference.values[i],
        ulp_exponent(reference.values[i].mid()),
    );
    let in_ulps = |d: Ball| d.magnitude().shift(-unit).to_f64();
    let result = Ball::exact(twin[i].prec().max(64), values[i]);
    Some(ErrorParts {
        method: in_ulps(&twin[i] - truth),
        rounding: in_ulps(&result - &twin[i]),
    })
}

#[cfg(test)]
mod tests;

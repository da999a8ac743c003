//! Sums to infinity of graphs: finitely many terms, and a bound on the rest.

use super::ball::{Balls, Value};
use super::integral::Body;
use super::{Evaluator, Interpretation, ROUNDS_REASON, Stop};
use crate::graph::Id;
use mechaudit_reference::Mag;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::quadrature::{End, Integrand};

/// The last term added has at most the index 2 to this power.
const LAST: u32 = 14;

/// The sum of a body over all integers from a node on.
///
/// The term as a function of a real index is bounded for all `x ≥ 2^k` by a function that falls, so
/// that the terms after `2^k` are at most the integral of the bound from there on.
pub(super) fn infinite(
    evaluator: &mut Evaluator<Balls>,
    binder: u32,
    node: Id,
    [from, body]: [Id; 2],
) -> Result<Value, Stop> {
    let stop = |reason| Stop { node, reason };
    let first = evaluator.value(from)?.clone();
    let Some(first) = evaluator.interpretation.to_integer(&first) else {
        let reason = NoValue::Undefined("a limit of a sum that is no integer");
        return Err(stop(reason));
    };
    let graph = evaluator.graph().clone();
    super::system::prepare(evaluator, &graph, &[body]);
    // A sum next to zero gets its relative accuracy as the working precision is raised.
    let most = Mag::power_of_two(-i64::from(evaluator.interpretation.prec));
    let least = (i64::BITS - first.max(1).leading_zeros()).max(2);
    let mut terms = Body::new(evaluator, binder, body);
    let mut is_bounded = false;
    let found = (least..=LAST).find_map(|k| {
        let rest = terms.growth(&End::PlusInfinity, k)?.rest_of_sum(k)?;
        is_bounded = true;
        (rest <= most).then_some((k, rest))
    });
    let Some((k, rest)) = found else {
        return Err(stop(NoValue::Undecided(match is_bounded {
            true => ROUNDS_REASON,
            false => "a sum to infinity whose terms are not bounded",
        })));
    };
    let sum = evaluator.terms(binder, node, body, [first, 1 << k])?;
    match sum.real() {
        Some(sum) => Ok(Value::Real(sum.widened(rest))),
        None => Err(stop(NoValue::Undecided(
            "a sum to infinity of numbers that are not real",
        ))),
    }
}

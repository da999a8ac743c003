//! Roots of graphs.

use super::ball::{Balls, Value};
use super::{Evaluator, Stop};
use crate::Roots;
use crate::graph::Id;
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::roots::interval::{PIECES, RootError, all_roots, unique_root};
use mechaudit_reference::{Ball, Mag};
use std::cell::RefCell;

/// A root of a body between two nodes, or the number of roots.
pub(super) fn root(
    evaluator: &mut Evaluator<Balls>,
    binder: u32,
    node: Id,
    [from, to, body, slope]: [Id; 4],
    which: Roots,
) -> Result<Value, Stop> {
    let stop = |reason| Stop { node, reason };
    let mut end = |id: Id| match evaluator.value(id)?.real() {
        Some(x) if x.is_finite() => Ok(x.clone()),
        _ => Err(stop(NoValue::Undefined(
            "an end of the interval of a root that is not a number",
        ))),
    };
    let (low, high) = (end(from)?, end(to)?);
    // The smallest interval that surely holds the one that is meant.
    let (outer_low, outer_high) = (low.lower().to_rational(), high.upper().to_rational());
    let (Some(outer_low), Some(outer_high)) = (outer_low, outer_high) else {
        return Err(stop(NoValue::Undecided("an end of the interval of a root")));
    };
    let graph = evaluator.graph().clone();
    super::system::prepare(evaluator, &graph, &[body, slope]);
    let goal = evaluator.interpretation.due();
    let evaluator = RefCell::new(evaluator);
    let of = |id: Id| {
        let evaluator = &evaluator;
        move |x: &Ball, bits: u32| -> Result<Ball, Stop> {
            let mut evaluator = evaluator.borrow_mut();
            let outside = std::mem::replace(&mut evaluator.interpretation.prec, bits);
            evaluator.set_variables(binder, [Value::Real(x.clone())]);
            let value = evaluator.value(id).map(|v| v.real().cloned());
            evaluator.interpretation.prec = outside;
            match value {
                Ok(Some(ball)) => Ok(ball),
                // Where nothing is known yet a shorter interval may decide.
                Ok(None) => Ok(Ball::integer(bits, 0).widened(Mag::INFINITY)),
                Err(Stop {
                    reason: NoValue::Undefined(_),
                    ..
                }) if x.rad().is_zero() => value.map(|_| Ball::integer(bits, 0)),
                Err(_) => Ok(Ball::integer(bits, 0).widened(Mag::INFINITY)),
            }
        }
    };
    let (f, slope) = (of(body), of(slope));
    let found = match which {
        Roots::Only => unique_root(f, slope, &outer_low, &outer_high, goal).map(|root| vec![root]),
        _ => all_roots(f, slope, &outer_low, &outer_high, goal, PIECES),
    };
    // The roots found lie in the larger interval; they have to lie in the one that is meant.
    let is_inside = |root: &Ball| {
        (low.rad().is_zero() || root.lower() >= low.upper())
            && (high.rad().is_zero() || root.upper() <= high.lower())
    };
    match found {
        Ok(roots) if !roots.iter().all(is_inside) => Err(stop(NoValue::Undecided(
            "a root next to the end of its interval",
        ))),
        Ok(mut roots) => match which {
            Roots::Number => Ok(Value::Real(Ball::integer(64, roots.len() as i64))),
            Roots::Only => Ok(Value::Real(roots.remove(0))),
            Roots::One { place, count } if roots.len() == count as usize => {
                Ok(Value::Real(roots.swap_remove(place as usize - 1)))
            }
            Roots::One { .. } => Err(stop(NoValue::Undefined(
                "another number of roots in the interval",
            ))),
        },
        Err(RootError::None) => Err(stop(NoValue::Undefined("no root in the interval"))),
        Err(RootError::Several { .. }) => Err(stop(NoValue::Undefined(
            "more than one root in the interval",
        ))),
        Err(RootError::Interval { .. }) => Err(stop(NoValue::Undefined(
            "an interval whose ends are in the wrong order",
        ))),
        Err(RootError::Function { error, .. }) => Err(error),
        Err(RootError::Undecided { .. }) => {
            // A body that is undefined on the whole interval has no root there.
            let evaluator = evaluator.into_inner();
            let whole = low.union(&high);
            evaluator.set_variables(binder, [Value::Real(whole)]);
            match evaluator.value(body) {
                Err(undefined) if matches!(undefined.reason, NoValue::Undefined(_)) => {
                    Err(undefined)
                }
                _ => Err(stop(NoValue::Undecided(
                    "a root that is not proved to be the only one",
                ))),
            }
        }
    }
}

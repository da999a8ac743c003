//! Solutions of systems of equations in graphs.

use super::ball::{Balls, Value};
use super::{Evaluator, Stop};
use crate::graph::{Binding, Graph, Id, Node, Start};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::roots::systems::{System, SystemError, in_box, near};
use mechaudit_reference::{Ball, Mag};
use rug::Float;
use std::convert::Infallible;

/// Parts of a box that are looked at.
const PARTS: usize = 2000;

/// Bits of the numbers that are tried as an exact solution.
const SHORT: u32 = 32;

/// The equations of a binder by the evaluator.
struct Equations<'a> {
    evaluator: &'a mut Evaluator<Balls>,
    binder: u32,
    equations: &'a [Id],
    jacobian: &'a [Id],
}

impl Equations<'_> {
    /// The values of nodes over a box; where there is none, a ball without a bound says that a
    /// smaller box may decide.
    fn at(&mut self, ids: &[Id], x: &[Ball], bits: u32) -> Vec<Ball> {
        let outside = std::mem::replace(&mut self.evaluator.interpretation.prec, bits);
        let values = x.iter().cloned().map(Value::Real);
        self.evaluator.set_variables(self.binder, values);
        let found = ids.iter().map(|id| {
            let value = self
                .evaluator
                .value(*id)
                .ok()
                .and_then(|v| v.real().cloned());
            value.unwrap_or_else(|| Ball::integer(bits, 0).widened(Mag::INFINITY))
        });
        let found = found.collect();
        self.evaluator.interpretation.prec = outside;
        found
    }
}

impl System for Equations<'_> {
    type Error = Infallible;

    fn values(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
        Ok(self.at(self.equations, x, bits))
    }

    fn jacobian(&mut self, x: &[Ball], bits: u32) -> Result<Vec<Ball>, Infallible> {
        Ok(self.at(self.jacobian, x, bits))
    }
}

/// Parts of functions that do not depend on any variable are kept by the evaluator: they have
/// to be computed at the full precision before wide arguments are looked at, at fewer bits.
pub(super) fn prepare(evaluator: &mut Evaluator<Balls>, graph: &Graph, roots: &[Id]) {
    let binders = graph.binders() as u32;
    for root in roots {
        for id in graph.reach(*root) {
            let is_free = (0..binders).all(|b| !graph.depends_on(id, b));
            if !is_free || graph.node(id) == Node::Infinity {
                continue;
            }
            // A part without a value is reported where it is needed.
            let _ = match graph.is_condition(id) {
                true => evaluator.holds(id).map(|_| ()),
                false => evaluator.value(id).map(|_| ()),
            };
        }
    }
}

/// An end of a side as a floating-point number, at or beyond the exact end; true if it is exact.
fn outward(x: &Float, up: bool) -> (f64, bool) {
    let near = x.to_f64();
    match (*x == near, up) {
        (true, _) => (near, true),
        (false, true) if near < *x => (near.next_up(), false),
        (false, false) if near > *x => (near.next_down(), false),
        _ => (near, false),
    }
}

/// The unknowns of a system.
pub(super) fn solution(
    evaluator: &mut Evaluator<Balls>,
    binder: u32,
    node: Id,
) -> Result<Vec<Value>, Stop> {
    let graph = evaluator.graph().clone();
    let stop = |reason| Stop { node, reason };
    let undecided = |reason| Err(stop(NoValue::Undecided(reason)));
    let Binding::System {
        starts,
        equations,
        jacobian,
    } = &graph.binder(binder).binding
    else {
        return Err(stop(NoValue::Undefined("a binder that is not closed")));
    };
    let mut number = |id: Id| match evaluator.value(id)?.real() {
        Some(x) if x.is_finite() => Ok(x.clone()),
        _ => Err(stop(NoValue::Undefined(
            "a start of an unknown that is not a number",
        ))),
    };
    let mut sought = Vec::new();
    for start in starts {
        sought.push(match start {
            Start::Near(at) => Start::Near(number(*at)?),
            Start::Between(low, high) => Start::Between(number(*low)?, number(*high)?),
        });
    }
    prepare(evaluator, &graph, equations);
    prepare(evaluator, &graph, jacobian);
    let bits = evaluator.interpretation.prec;
    // Parts that do not depend on an unknown are known to the working precision alone.
    let goal = evaluator.interpretation.due().min(bits.saturating_sub(32));
    let mut system = Equations {
        evaluator,
        binder,
        equations,
        jacobian,
    };
    let mut is_exact = true;
    let mut sides = Vec::new();
    let mut first = Vec::new();
    for start in &sought {
        match start {
            Start::Near(at) => first.push(at.mid().to_f64()),
            Start::Between(low, high) => {
                let (lo, exact) = outward(&low.lower(), false);
                let (hi, also) = outward(&high.upper(), true);
                is_exact &= exact && also && low.rad().is_zero() && high.rad().is_zero();
                sides.push([lo, hi]);
                first.push(0.5 * lo + 0.5 * hi);
            }
        }
    }
    let is_box = sides.len() == sought.len();
    let found = match is_box {
        true => in_box(&mut system, &sides, goal, PARTS),
        // An unknown that is zero has to be known to twice the bits; numbers of the equations are
        // not.
        false => match near(&mut system, &first, goal) {
            Err(SystemError::Undecided { .. }) => near(&mut system, &first, goal / 2),
            found => found,
        },
    };
    let mut found = match found {
        Ok(found) => found,
        Err(SystemError::None) => {
            return Err(stop(NoValue::Undefined("no solution in the box")));
        }
        Err(SystemError::Several { .. }) if is_exact => {
            return Err(stop(NoValue::Undefined(
                "more than one solution in the box",
            )));
        }
        Err(SystemError::Several { .. }) => {
            return undecided("a solution next to a side of the box");
        }
        Err(SystemError::Side { .. }) => {
            return Err(stop(NoValue::Undefined(
                "a side of the box whose ends are in the wrong order",
            )));
        }
        Err(SystemError::Data(_)) => {
            return Err(stop(NoValue::Undefined(
                "a start of an unknown beyond the range of binary64",
            )));
        }
        Err(SystemError::Function(never)) => match never {},
        Err(SystemError::Undecided { .. }) if is_box => {
            return undecided("a solution in the box that is not proved to be the only one");
        }
        Err(SystemError::Undecided { .. }) => {
            return undecided("no solution is proved near the start");
        }
    };
    // The box that was searched may be larger than the one that is meant, and Newton's method may
    // leave it.
    for (x, start) in found.iter().zip(&sought) {
        if let Start::Between(low, high) = start {
            if x.upper() < low.lower() || x.lower() > high.upper() {
                return undecided("the solution near the start is outside of an unknown's range");
            }
            if x.lower() < low.upper() || x.upper() > high.lower() {
                return undecided("a solution next to an end of an unknown's range");
            }
        }
    }
    // A solution of short numbers, zeros among them, is proved by exact arithmetic: it is the only
    // one around.
    let short: Vec<Ball> = found.iter().map(shortened).collect();
    let holds = |(x, short): (&Ball, &Ball)| x.contains_ball(short);
    if found.iter().zip(&short).all(holds) {
        let values = system.at(equations, &short, bits.max(8 * SHORT));
        if values.iter().all(Ball::is_zero) {
            found = short;
        }
    }
    Ok(found.into_iter().map(Value::Real).collect())
}

/// The nearest number of few bits, zero where the ball holds zero.
fn shortened(x: &Ball) -> Ball {
    match x.contains_zero() {
        true => Ball::integer(x.prec(), 0),
        false => Ball::new(Float::with_val(SHORT, x.mid()), Mag::ZERO).with_prec(x.prec()),
    }
}

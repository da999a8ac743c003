//! Switches of programs and their sides.

use crate::graph::{Graph, Id, Node};
use crate::{Func, Relation};
use rug::Rational;
use std::cmp::Ordering;

/// A switch: the sign of `a − b`, or the integer that a step function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::evaluation) enum Switch {
    /// The sign of a difference.
    Sign(Id, Id),
    /// The sign of a value.
    SignOf(Id),
    /// A step function of a value.
    Step(Func, Id),
}

impl Switch {
    /// The switch of a comparison; true if its sign is that of `b − a`.
    pub fn between(graph: &Graph, a: Id, b: Id) -> (Switch, bool) {
        let is_zero = |id| match graph.node(id) {
            Node::Number(place) => *graph.rational(place) == 0,
            _ => false,
        };
        match () {
            () if is_zero(b) => (Switch::SignOf(a), false),
            () if is_zero(a) => (Switch::SignOf(b), true),
            () if a > b => (Switch::Sign(b, a), true),
            () => (Switch::Sign(a, b), false),
        }
    }

    /// The switches of all nodes that some nodes need.
    pub fn all(graph: &Graph, roots: &[Id]) -> Vec<Switch> {
        let mut found = Vec::new();
        let mut seen = vec![false; graph.len()];
        for id in roots.iter().flat_map(|root| graph.reach(*root)) {
            if std::mem::replace(&mut seen[id as usize], true) {
                continue;
            }
            let mut add = |switch| {
                if !found.contains(&switch) {
                    found.push(switch);
                }
            };
            match graph.node(id) {
                Node::Unary(Func::Abs | Func::Cbrt, a) => add(Switch::SignOf(a)),
                Node::Binary(Func::Copysign, a, b) => {
                    add(Switch::SignOf(a));
                    add(Switch::SignOf(b));
                }
                Node::Compare(_, a, b)
                | Node::Binary(Func::Fmin | Func::Fmax | Func::Fdim, a, b) => {
                    add(Switch::between(graph, a, b).0);
                }
                Node::Unary(
                    f @ (Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint),
                    a,
                )
                | Node::Flat(f, a) => add(Switch::Step(f, a)),
                _ => {}
            }
        }
        found
    }

    /// Returns true if what depends on the sign is something else where the value is zero than on
    /// either side: `a == b`, or `a <= b` beside `a >= b`.
    pub fn is_pointed(self, graph: &Graph) -> bool {
        let at_zero = |id| match graph.node(id) {
            Node::Compare(relation, a, b) => {
                let (switch, is_turned) = Switch::between(graph, a, b);
                (switch == self).then_some(match relation {
                    Relation::Less | Relation::GreaterEqual => Some(!is_turned),
                    Relation::LessEqual | Relation::Greater => Some(is_turned),
                    Relation::Equal | Relation::NotEqual => None,
                })
            }
            Node::Binary(Func::Copysign, _, b) => (Switch::SignOf(b) == self).then_some(Some(true)),
            _ => None,
        };
        let mut sides = (0..graph.len() as Id).filter_map(at_zero);
        let first = sides.next().unwrap_or(Some(true));
        first.is_none() || sides.any(|side| side != first)
    }

    /// The nodes whose difference changes its sign.
    pub fn parts(self) -> (Id, Option<Id>) {
        match self {
            Switch::Sign(a, b) => (a, Some(b)),
            Switch::SignOf(a) | Switch::Step(_, a) => (a, None),
        }
    }
}

/// The side of a switch.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::evaluation) enum Side {
    /// The value is greater than zero.
    Positive,
    /// The value is less than zero.
    Negative,
    /// The value is zero: the motion is at the switch.
    Zero,
    /// The value of the step function.
    Integer(Rational),
}

/// The open interval on which a step function is n; none for an end that is infinite.
pub(super) fn ends(f: Func, n: &Rational) -> [Option<Rational>; 2] {
    let shifted = |by: (i32, i32)| Some(n + Rational::from(by));
    match f {
        Func::Floor => [shifted((0, 1)), shifted((1, 1))],
        Func::Ceil => [shifted((-1, 1)), shifted((0, 1))],
        Func::Round | Func::Nearbyint => [shifted((-1, 2)), shifted((1, 2))],
        // The integer part: towards zero.
        _ => match n.cmp0() {
            Ordering::Greater => [shifted((0, 1)), shifted((1, 1))],
            Ordering::Less => [shifted((-1, 1)), shifted((0, 1))],
            Ordering::Equal => [shifted((-1, 1)), shifted((1, 1))],
        },
    }
}

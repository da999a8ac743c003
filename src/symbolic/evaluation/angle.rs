//! Circular functions of rational multiples of π, whose arguments are reduced exactly.
//!
//! An angle of x degrees is `x π/180`. Where a ball multiplies π in, it needs as many bits as x has
//! before the point; the rational number `x/180` without its half turns needs none of them.

use super::{Evaluator, Interpretation};
use crate::graph::{Graph, Id, Node};
use crate::{Constant, Func};
use mechaudit_reference::Ball;
use rug::ops::Pow;
use rug::{Integer, Rational};

/// Operations in a multiple of π.
const MOST: u32 = 64;

/// Bits of its numerator and denominator together.
const LONGEST: u32 = 1 << 14;

/// The argument of circular functions in a graph: π times a number that is rational at rational
/// inputs.
struct Argument {
    id: Id,
    /// Their nodes.
    functions: Vec<(Func, Id)>,
}

/// An angle `(n + t) π/2` for n quarter turns, `|t| ≤ 1/2`, and the functions of it.
struct Angle {
    place: usize,
    quarters: u32,
    rest: Rational,
}

/// The circular functions of angles in a graph.
pub(super) struct Angles {
    arguments: Vec<Argument>,
    /// Those that are known at the inputs.
    known: Vec<Angle>,
}

/// Evaluates what is rational at rational inputs, for as long as it is short.
struct Exactly<'a> {
    graph: &'a Graph,
    inputs: &'a [Rational],
    left: u32,
}

impl Exactly<'_> {
    fn number(&mut self, id: Id) -> Option<Rational> {
        self.left = self.left.checked_sub(1)?;
        let found = match self.graph.node(id) {
            Node::Number(place) => self.graph.rational(place).clone(),
            Node::Input(k) => self.inputs.get(k as usize)?.clone(),
            Node::Neg(a) => -self.number(a)?,
            Node::Add(a, b) => self.number(a)? + self.number(b)?,
            Node::Sub(a, b) => self.number(a)? - self.number(b)?,
            Node::Mul(a, b) => self.number(a)? * self.number(b)?,
            Node::Div(a, b) => self.number(a)? / self.divisor(b)?,
            Node::Power(a, k @ 0..=8) => self.number(a)?.pow(k),
            _ => return None,
        };
        short(found)
    }

    fn divisor(&mut self, id: Id) -> Option<Rational> {
        self.number(id).filter(|q| *q != 0)
    }

    /// The number of which a node is the multiple by π.
    fn multiple(&mut self, id: Id) -> Option<Rational> {
        self.left = self.left.checked_sub(1)?;
        let found = match self.graph.node(id) {
            Node::Constant(Constant::Pi) => 1.into(),
            Node::Constant(Constant::HalfPi) => (1, 2).into(),
            Node::Constant(Constant::QuarterPi) => (1, 4).into(),
            Node::Neg(a) => -self.multiple(a)?,
            Node::Add(a, b) => self.multiple(a)? + self.multiple(b)?,
            Node::Sub(a, b) => self.multiple(a)? - self.multiple(b)?,
            Node::Mul(a, b) if self.graph.is_rational(b) => self.multiple(a)? * self.number(b)?,
            Node::Mul(a, b) => self.number(a)? * self.multiple(b)?,
            Node::Div(a, b) => self.multiple(a)? / self.divisor(b)?,
            _ => return None,
        };
        short(found)
    }
}

/// Leaves out a number that has grown long.
fn short(q: Rational) -> Option<Rational> {
    let bits = q.numer().significant_bits() + q.denom().significant_bits();
    (bits <= LONGEST).then_some(q)
}

/// Returns true for the nodes that are π times what may be rational.
fn multiples(graph: &Graph) -> Vec<bool> {
    let mut found: Vec<bool> = Vec::with_capacity(graph.len());
    for id in 0..graph.len() as Id {
        let is = |id: Id| found[id as usize];
        found.push(match graph.node(id) {
            Node::Constant(Constant::Pi | Constant::HalfPi | Constant::QuarterPi) => true,
            Node::Neg(a) => is(a),
            Node::Add(a, b) | Node::Sub(a, b) => is(a) && is(b),
            Node::Mul(a, b) if graph.is_rational(b) => is(a),
            Node::Mul(a, b) => graph.is_rational(a) && is(b),
            Node::Div(a, b) => graph.is_rational(b) && is(a),
            _ => false,
        });
    }
    found
}

impl Angles {
    /// Finds them in a graph.
    pub fn new(graph: &Graph) -> Angles {
        let is_multiple = multiples(graph);
        let mut arguments: Vec<Argument> = Vec::new();
        for id in 0..graph.len() as Id {
            if let Node::Unary(f @ (Func::Sin | Func::Cos | Func::Tan), x) = graph.node(id) {
                match arguments.iter_mut().find(|a| a.id == x) {
                    Some(known) => known.functions.push((f, id)),
                    None if is_multiple[x as usize] => arguments.push(Argument {
                        id: x,
                        functions: vec![(f, id)],
                    }),
                    None => {}
                }
            }
        }
        Angles {
            arguments,
            known: Vec::new(),
        }
    }

    /// Reduces them at inputs.
    pub fn reduce(&mut self, graph: &Graph, inputs: &[Rational]) {
        self.known.clear();
        for (place, argument) in self.arguments.iter().enumerate() {
            let left = MOST;
            let mut exactly = Exactly {
                graph,
                inputs,
                left,
            };
            let Some(half_turns) = exactly.multiple(argument.id) else {
                continue;
            };
            // Half a turn is two quarters.
            let (rest, n) = (half_turns * 2u32).fract_round(Integer::new());
            self.known.push(Angle {
                place,
                quarters: n.mod_u(4),
                rest,
            });
        }
    }

    /// The tangents of odd multiples of a right angle: they have no value.
    pub fn poles(&self) -> Vec<Id> {
        let is_pole = |angle: &&Angle| angle.rest.is_zero() && angle.quarters % 2 == 1;
        let at_poles = self.known.iter().filter(is_pole);
        let functions = at_poles.flat_map(|angle| &self.arguments[angle.place].functions);
        let tangents = functions.filter(|(f, _)| *f == Func::Tan);
        tangents.map(|(_, id)| *id).collect()
    }

    /// Gives the functions their values in an evaluator. Returns true if there are any.
    ///
    /// At `x = t π/2` with `|x| ≤ π/4` neither rounding error is large beside the function: `|sin x|`
    /// is at least `0.9 |x|`.
    pub fn set<I: Interpretation>(
        &self,
        evaluator: &mut Evaluator<I>,
        precision: impl Fn(Id) -> u32,
        value: impl Fn(Ball) -> Option<I::V>,
    ) -> bool {
        for angle in &self.known {
            let functions = &self.arguments[angle.place].functions;
            let bits = functions.iter().map(|(_, id)| precision(*id)).max();
            let p = bits.unwrap_or(0).saturating_add(1);
            let [sin, cos] = match angle.rest.is_zero() {
                true => [0, 1].map(|n| Ball::integer(p, n)),
                false => {
                    let x = Ball::pi(p) * Ball::rational(p, &angle.rest);
                    let (sin, cos) = x.shift(-1).sin_cos();
                    [sin, cos]
                }
            };
            let [sin, cos] = match angle.quarters {
                0 => [sin, cos],
                1 => [cos, -sin],
                2 => [-sin, -cos],
                _ => [-cos, sin],
            };
            for (f, id) in functions {
                let ball = match f {
                    Func::Sin => sin.clone(),
                    Func::Cos => cos.clone(),
                    // The cosine is zero.
                    _ if cos.is_zero() => continue,
                    _ => &sin / &cos,
                };
                if let Some(value) = value(ball) {
                    evaluator.set(*id, value);
                }
            }
        }
        !self.known.is_empty()
    }
}

#[cfg(test)]
mod tests;

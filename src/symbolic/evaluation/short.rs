//! Graphs in balls of machine words: a first pass, of which most values are accurate enough.
//!
//! Values that these balls do not decide, undefined and complex ones among them, are left to
//! [`Balls`].

use super::adaptive::{Answer, FIRST, Goal};
use super::angle::Angles;
use super::ball::{Balls, Value, ball_of};
use super::integral::leaves;
use super::tuning::{Passes, Size};
use super::{Evaluator, Interpretation, Stop};
use crate::graph::{Binding, Graph, Id, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::{Ball, Ball128};
use mechaudit_reference::elementary::NoValue;
use rug::Rational;
use std::cmp::Ordering;
use std::sync::Arc;

/// The interpretation in balls of 128 bits.
struct Short {
    /// MPFR, for the functions: its precision is theirs.
    balls: Balls,
    /// True if a function of MPFR was called: more bits of it may help.
    has_called: bool,
}

/// The answer where these balls do not decide.
const LEFT: NoValue = NoValue::Undecided("left to balls of more bits");

type Found = Result<Ball128, NoValue>;

fn decided(found: Option<Ball128>) -> Found {
    found.ok_or(LEFT)
}

fn short(value: &Value) -> Found {
    match value {
        Value::Real(x) => decided(Ball128::of_ball(x)),
        _ => Err(LEFT),
    }
}

impl Short {
    /// Returns true if a graph has values in these balls: integrals, roots and systems have none.
    fn takes(graph: &Graph) -> bool {
        (0..graph.len() as u32).all(|id| match graph.node(id) {
            Node::Bound(binder) | Node::Last(binder, _) => match graph.binder(binder).binding {
                Binding::Sum { to, .. } => graph.node(to) != Node::Infinity,
                Binding::Loop { .. } => true,
                _ => false,
            },
            Node::ImaginaryUnit => false,
            _ => true,
        })
    }

    /// Returns true if each node has one value.
    fn is_straight(graph: &Graph) -> bool {
        let is_bound = |id| matches!(graph.node(id), Node::Bound(_) | Node::Last(..));
        !(0..graph.len() as u32).any(is_bound)
    }

    /// A rational number.
    fn rational(&self, q: &Rational) -> Found {
        match Ball128::dyadic(q) {
            Some(x) => Ok(x),
            None => decided(Ball128::of_ball(&ball_of(128, q))),
        }
    }
}

impl Interpretation for Short {
    type V = Ball128;

    fn number(&mut self, graph: &Graph, place: u32) -> Found {
        self.rational(graph.rational(place))
    }

    fn integer(&mut self, n: i64) -> Ball128 {
        Ball128::integer(n)
    }

    fn constant(&mut self, c: Constant) -> Found {
        short(&Balls::new(128).constant(c)?)
    }

    fn imaginary_unit(&mut self) -> Found {
        Err(LEFT)
    }

    fn infinity(&mut self) -> Found {
        Err(LEFT)
    }

    fn neg(&mut self, a: &Ball128) -> Found {
        Ok(a.negative())
    }

    fn add(&mut self, a: &Ball128, b: &Ball128) -> Found {
        decided(a.add(b))
    }

    fn sub(&mut self, a: &Ball128, b: &Ball128) -> Found {
        decided(a.sub(b))
    }

    fn mul(&mut self, a: &Ball128, b: &Ball128) -> Found {
        decided(a.mul(b))
    }

    fn div(&mut self, a: &Ball128, b: &Ball128) -> Found {
        decided(a.div(b))
    }

    fn power(&mut self, a: &Ball128, k: i32) -> Found {
        match a.is_zero() {
            // Zero to the power of zero is for the others to define.
            true => Err(LEFT),
            false => decided(a.power(k)),
        }
    }

    fn call(&mut self, f: Func, x: &[&Ball128]) -> Found {
        match (f, x) {
            (Func::Sqrt, [x]) => decided(x.sqrt()),
            (Func::Abs, [x]) => match x.sign() {
                Some(Ordering::Less) => Ok(x.negative()),
                Some(_) => Ok(**x),
                None => Err(LEFT),
            },
            (Func::Fma, [x, y, z]) => decided(x.mul(y).and_then(|product| product.add(z))),
            (Func::Fmin | Func::Fmax, [x, y]) => {
                let order = x.sub(y).and_then(|d| d.sign()).ok_or(LEFT)?;
                let is_first = (order == Ordering::Less) == (f == Func::Fmin);
                Ok(if is_first { **x } else { **y })
            }
            (_, x) => {
                self.has_called = true;
                let mut values = Vec::with_capacity(x.len());
                for x in x {
                    values.push(Value::Real(x.to_ball().ok_or(LEFT)?));
                }
                let operands: Vec<&Value> = values.iter().collect();
                short(&self.balls.call(f, &operands)?)
            }
        }
    }

    fn flat(&mut self, _: Func, _: &Ball128) -> Found {
        Err(LEFT)
    }

    fn compare(&mut self, relation: Relation, a: &Ball128, b: &Ball128) -> Result<bool, NoValue> {
        let order = a.sub(b).and_then(|d| d.sign()).ok_or(LEFT)?;
        Ok(relation.holds(order))
    }

    fn to_integer(&self, a: &Ball128) -> Option<i64> {
        let x = a.to_ball()?;
        self.balls.to_integer(&Value::Real(x))
    }

    fn bound(evaluator: &mut Evaluator<Short>, binder: u32) -> Result<Ball128, Stop> {
        let node = evaluator.graph().find(Node::Bound(binder)).unwrap_or(0);
        Err(Stop { node, reason: LEFT })
    }
}

/// The body of a binder of one variable as a function of numbers in these balls.
pub(super) struct Pointwise {
    evaluator: Evaluator<Short>,
    binder: u32,
    body: Id,
}

impl Pointwise {
    /// Takes the values of what does not depend on the variable from another evaluator.
    pub fn new(balls: &Evaluator<Balls>, binder: u32, body: Id) -> Pointwise {
        let meaning = Short {
            balls: Balls::new(128),
            has_called: false,
        };
        let mut evaluator = Evaluator::new(balls.graph().clone(), meaning);
        for id in leaves(balls.graph(), body, binder) {
            let known = balls.known[id as usize].as_ref().and_then(Value::real);
            if let Some(value) = known.and_then(Ball128::of_ball) {
                evaluator.set(id, value);
            }
        }
        Pointwise {
            evaluator,
            binder,
            body,
        }
    }

    /// The value at a number; it takes from the rounds of loops that are left.
    pub fn value(&mut self, x: &Ball128, rounds: &mut u64) -> Option<Ball128> {
        self.evaluator.rounds = *rounds;
        self.evaluator.set_variables(self.binder, [*x]);
        let found = self.evaluator.value(self.body).ok().copied();
        *rounds = self.evaluator.rounds;
        found
    }
}

/// Values of the nodes of a graph in these balls, for as far as they decide.
pub(super) struct FirstPass {
    evaluator: Evaluator<Short>,
    next: u32,
    is_straight: bool,
}

/// The next precision where nothing is left of a value.
const CANCELLED: u32 = 512;

impl FirstPass {
    /// Bits of functions where values at [`FIRST`] are not accurate enough.
    const MOST: u32 = 120;

    /// None for a graph that has no values in these balls.
    pub fn new(graph: &Arc<Graph>) -> Option<FirstPass> {
        let meaning = Short {
            balls: Balls::new(FIRST),
            has_called: false,
        };
        Short::takes(graph).then(|| FirstPass {
            evaluator: Evaluator::new(graph.clone(), meaning),
            next: FIRST,
            is_straight: Short::is_straight(graph),
        })
    }

    /// Returns the working precision to name the nearest binary64 of what was left open.
    pub fn next(&self) -> u32 {
        self.next
    }

    /// Returns true if nothing is left of a value.
    pub fn has_cancelled(&self) -> bool {
        self.next >= CANCELLED
    }

    /// Returns true if precisions of nodes save time: the graph has neither loops nor sums, and
    /// functions are called.
    pub fn is_tuned(&self) -> bool {
        self.is_straight && self.has_called()
    }

    /// Returns true if there are functions that machine words do not evaluate.
    pub fn has_called(&self) -> bool {
        self.evaluator.interpretation.has_called
    }

    /// The precisions of all nodes for a pass with `most` bits; none without sizes to go by.
    pub fn precisions(&self, roots: &[Id], bits: u32, most: u32) -> Vec<u32> {
        // The bits of arithmetic cost less than the estimates.
        if !self.is_tuned() {
            return Vec::new();
        }
        let evaluator = &self.evaluator;
        let passes = Passes {
            graph: evaluator.graph(),
            size: |id: Id| evaluator.known[id as usize].as_ref().map(Size::of_short),
            before: evaluator.interpretation.balls.prec,
            most,
            wanted: bits,
        };
        passes.precisions(roots)
    }

    /// The answers that are accurate enough.
    pub fn answers(
        &mut self,
        inputs: &[Rational],
        angles: &Angles,
        nodes: &[Id],
        goal: Goal,
    ) -> Vec<Option<Answer>> {
        let mut answers = vec![None; nodes.len()];
        let precisions = match goal {
            Goal::Nearest => [FIRST, FirstPass::MOST],
            Goal::Bits(bits) | Goal::Double(bits) => [bits.saturating_add(16), u32::MAX],
        };
        self.next = FIRST;
        for prec in precisions {
            if prec > FirstPass::MOST || !self.begin(inputs, angles, prec) {
                break;
            }
            // More bits of functions may help.
            let mut may_help = false;
            for (node, answer) in nodes.iter().zip(&mut answers) {
                if answer.is_some() {
                    continue;
                }
                self.evaluator.begin();
                let Ok(value) = self.evaluator.value(*node) else {
                    self.next = self.next.max(256);
                    continue;
                };
                *answer = accepted(value, goal);
                if answer.is_some() {
                    continue;
                }
                // Where everything cancels, the bits that are missing are unknown, and many.
                let next = match value.accuracy() {
                    None => CANCELLED,
                    Some(bits) if bits < 64 => 192,
                    Some(_) => FIRST,
                };
                may_help |= next == 192;
                self.next = self.next.max(next);
            }
            let hint = self.evaluator.interpretation.balls.hint;
            if hint > FirstPass::MOST {
                self.next = hint.next_multiple_of(64);
                break;
            }
            if !may_help || !self.evaluator.interpretation.has_called {
                break;
            }
        }
        answers
    }

    /// Prepares an evaluation with functions at a precision; false if the inputs are no such balls.
    fn begin(&mut self, inputs: &[Rational], angles: &Angles, prec: u32) -> bool {
        let short = &mut self.evaluator.interpretation;
        let is_other = short.balls.prec != prec;
        short.balls.prec = prec;
        short.balls.hint = 0;
        self.evaluator.reset(is_other);
        let of_ball = |x: Ball| Ball128::of_ball(&x);
        let has_angles = angles.set(&mut self.evaluator, |_| prec, of_ball);
        self.evaluator.interpretation.has_called = has_angles;
        inputs.iter().enumerate().all(|(k, input)| {
            let value = self.evaluator.interpretation.rational(input);
            value.map(|x| self.evaluator.set_input(k, x)).is_ok()
        })
    }
}

/// The answer that a value is, if it is accurate enough.
fn accepted(x: &Ball128, goal: Goal) -> Option<Answer> {
    if x.is_zero() {
        return Some(Answer::Zero);
    }
    let is_enough = match goal {
        Goal::Nearest => x.nearest_f64().is_some(),
        Goal::Bits(bits) | Goal::Double(bits) => x.accuracy()? >= i64::from(bits),
    };
    match is_enough {
        true => x.to_ball().map(Answer::Number),
        false => None,
    }
}

//! A formula as a tape of floating-point operations, each behind its operands; bounded loops and
//! finite sums are unrolled.

use super::accuracy::{Accuracy, accuracy};
use super::pass::Pass;
use super::{ProgramError, Setting, refused};
use crate::interval::{Interval, up};
use mechaudit_reference::{Ball, nearest_f64};
use mechaudit_symbolic::evaluation::{Balls, Interpretation};
use mechaudit_symbolic::graph::{Binding, Graph, Id, Node};
use mechaudit_symbolic::{Func, Relation};
use rug::Float;
use rug::Rational;
use rug::float::Round;
use std::collections::HashMap;

/// A place on the tape.
pub(crate) type Place = usize;

/// An operation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Op {
    /// An input.
    Input(usize),
    /// A constant: an enclosure of its value, the number that stands for it, and what that is more
    /// than the value.
    Constant(Interval, f64, Interval),
    /// `−a`.
    Neg(Place),
    /// `|a|`.
    Abs(Place),
    /// `a + b`.
    Add(Place, Place),
    /// `a − b`.
    Sub(Place, Place),
    /// `a b`.
    Mul(Place, Place),
    /// `a / b`.
    Div(Place, Place),
    /// `√a`.
    Sqrt(Place),
    /// `a b + c` with one rounding.
    Fma(Place, Place, Place),
    /// A smooth function of one argument.
    Smooth(Func, Place, Accuracy),
    /// `a^k` by `pow`.
    Power(Place, i32, Accuracy),
    /// `a^b`.
    Pow(Place, Place, Accuracy),
    /// `√(a² + b²)`.
    Hypot(Place, Place, Accuracy),
    /// The angle of the point (b, a).
    Atan2(Place, Place, Accuracy),
    /// The smaller of both.
    Min(Place, Place),
    /// The larger of both.
    Max(Place, Place),
    /// A function to whole numbers.
    Step(Func, Place),
    /// The second where the condition holds, else the third.
    If(usize, Place, Place),
    /// A solver's number with its factor σ multiplied out.
    Plain(Place),
    /// The rounding error of a solver's operation with its sign reversed, which code takes back.
    Lost(Place),
    /// A solver's number and any more that is at most this and what underflowed.
    Near(Place, f64),
}

/// A condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Condition {
    /// True or false.
    Truth(bool),
    /// A comparison.
    Compare(Relation, Place, Place),
    /// Both.
    And(usize, usize),
    /// One of both.
    Or(usize, usize),
    /// The contrary.
    Not(usize),
}

/// The operations of a formula and the conditions in it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    /// Operations; operands come before.
    pub ops: Vec<Op>,
    /// Conditions; parts come before.
    pub conditions: Vec<Condition>,
}

/// The most operations of a tape.
const LONGEST: usize = 20_000;
/// The deepest nesting of expressions.
const DEEPEST: usize = 1_500;

impl Op {
    /// The operands.
    pub fn operands(self) -> ([Place; 3], usize) {
        match self {
            Op::Input(_) | Op::Constant(..) | Op::Lost(_) => ([0; 3], 0),
            Op::Neg(a)
            | Op::Abs(a)
            | Op::Sqrt(a)
            | Op::Smooth(_, a, _)
            | Op::Power(a, ..)
            | Op::Plain(a)
            | Op::Near(a, _)
            | Op::Step(_, a) => ([a, 0, 0], 1),
            Op::Add(a, b)
            | Op::Sub(a, b)
            | Op::Mul(a, b)
            | Op::Div(a, b)
            | Op::Pow(a, b, _)
            | Op::Hypot(a, b, _)
            | Op::Atan2(a, b, _)
            | Op::Min(a, b)
            | Op::Max(a, b)
            | Op::If(_, a, b) => ([a, b, 0], 2),
            Op::Fma(a, b, c) => ([a, b, c], 3),
        }
    }
}

/// Numbers of either sign that are at most `off`.
fn within(off: f64) -> Interval {
    Interval::new(-off, off)
}

/// Writes nodes of a graph on a tape.
pub(crate) struct Writer<'a> {
    graph: &'a Graph,
    setting: Setting,
    pub tape: Tape,
    /// Ranges over all inputs, which decide how often a loop runs.
    whole: Pass,
    domain: &'a [Interval],
    values: HashMap<Id, Place>,
    conditions: HashMap<Id, usize>,
    depth: usize,
}

type Written<T> = Result<T, ProgramError>;

impl<'a> Writer<'a> {
    /// Begins a tape for inputs of a domain.
    pub fn new(graph: &'a Graph, setting: Setting, domain: &'a [Interval]) -> Writer<'a> {
        Writer {
            graph,
            setting,
            tape: Tape::default(),
            whole: Pass::new(setting, domain.len()),
            domain,
            values: HashMap::new(),
            conditions: HashMap::new(),
            depth: 0,
        }
    }

    fn push(&mut self, op: Op) -> Written<Place> {
        if self.tape.ops.len() >= LONGEST {
            return refused(format!("more than {LONGEST} operations"));
        }
        self.tape.ops.push(op);
        Ok(self.tape.ops.len() - 1)
    }

    fn constant(&mut self, q: &Rational) -> Written<Place> {
        let end = |way| Float::with_val_round(53, q, way).0.to_f64();
        let real = Interval::new(end(Round::Down), end(Round::Up));
        let nearest = match self.setting.is_single() {
            false => nearest_f64(q),
            true => {
                let (mut x, way) = Float::with_val_round(24, q, Round::Nearest);
                x.subnormalize_ieee_round(way, Round::Nearest);
                f64::from(x.to_f32())
            }
        };
        let off = match Rational::from_f64(nearest) {
            Some(nearest) => (nearest - q).abs(),
            None => return refused("a constant overflows"),
        };
        let off = Float::with_val_round(53, &off, Round::Up).0;
        self.push(Op::Constant(
            real,
            nearest,
            within(off.to_f64_round(Round::Up)),
        ))
    }

    fn integer(&mut self, k: i64) -> Written<Place> {
        self.constant(&Rational::from(k))
    }

    /// Writes a number; returns its place.
    pub fn value(&mut self, id: Id) -> Written<Place> {
        if let Some(place) = self.values.get(&id) {
            return Ok(*place);
        }
        self.depth += 1;
        if self.depth > DEEPEST {
            return refused(format!("expressions nested more than {DEEPEST} deep"));
        }
        let place = self.written(id)?;
        self.depth -= 1;
        self.values.insert(id, place);
        Ok(place)
    }

    fn written(&mut self, id: Id) -> Written<Place> {
        let op = match self.graph.node(id) {
            Node::Number(k) => {
                let q = self.graph.rational(k).clone();
                return self.constant(&q);
            }
            Node::Constant(c) => {
                let ball = Balls::new(128).constant(c);
                let ball = ball.ok().and_then(|v| v.real().cloned());
                let Some(ball) = ball else {
                    return refused("a constant without a value");
                };
                return self.named(&ball);
            }
            Node::Input(k) => Op::Input(k as usize),
            Node::Neg(a) => Op::Neg(self.value(a)?),
            Node::Add(a, b) => Op::Add(self.value(a)?, self.value(b)?),
            Node::Sub(a, b) => Op::Sub(self.value(a)?, self.value(b)?),
            Node::Mul(a, b) => Op::Mul(self.value(a)?, self.value(b)?),
            Node::Div(a, b) => Op::Div(self.value(a)?, self.value(b)?),
            Node::Power(a, k) => {
                let a = self.value(a)?;
                match k {
                    0 => return self.integer(1),
                    1 => return Ok(a),
                    2 => Op::Mul(a, a),
                    k => Op::Power(a, k, accuracy(Func::Pow, self.setting)?),
                }
            }
            Node::Unary(f, a) => {
                let a = self.value(a)?;
                match f {
                    Func::Abs => Op::Abs(a),
                    Func::Sqrt => Op::Sqrt(a),
                    Func::Re | Func::Conj => return Ok(a),
                    Func::Floor | Func::Ceil | Func::Trunc | Func::Round | Func::Nearbyint => {
                        Op::Step(f, a)
                    }
                    f => Op::Smooth(f, a, accuracy(f, self.setting)?),
                }
            }
            Node::Binary(f, a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                match f {
                    Func::Pow => Op::Pow(a, b, accuracy(f, self.setting)?),
                    Func::Hypot => Op::Hypot(a, b, accuracy(f, self.setting)?),
                    Func::Atan2 => Op::Atan2(a, b, accuracy(f, self.setting)?),
                    Func::Fmin => Op::Min(a, b),
                    Func::Fmax => Op::Max(a, b),
                    Func::Fdim => {
                        let (difference, zero) = (self.push(Op::Sub(a, b))?, self.integer(0)?);
                        Op::Max(difference, zero)
                    }
                    f => return refused(format!("{} jumps", f.name())),
                }
            }
            Node::Ternary(Func::Fma, a, b, c) => {
                Op::Fma(self.value(a)?, self.value(b)?, self.value(c)?)
            }
            Node::If(condition, a, b) => {
                let condition = self.condition(condition)?;
                match self.tape.conditions[condition] {
                    Condition::Truth(true) => return self.value(a),
                    Condition::Truth(false) => return self.value(b),
                    _ => Op::If(condition, self.value(a)?, self.value(b)?),
                }
            }
            Node::Bound(binder) => return self.sum(binder),
            Node::Last(binder, k) => return self.repeat(binder, k),
            node => return refused(format!("no floating-point operation: {node:?}")),
        };
        self.push(op)
    }

    /// A named constant, from a ball of 128 bits.
    fn named(&mut self, ball: &Ball) -> Written<Place> {
        let (low, high) = (ball.lower(), ball.upper());
        let end = |x: &Float, way| Float::with_val_round(53, x, way).0.to_f64();
        let real = Interval::new(end(&low, Round::Down), end(&high, Round::Up));
        let bits = if self.setting.is_single() { 24 } else { 53 };
        let nearest = Float::with_val(bits, ball.mid()).to_f64();
        let off = (real - Interval::point(nearest)).magnitude();
        // The ball is far narrower than a unit in the last place of either end.
        let half = Float::with_val(128, ball.mid() - nearest).abs();
        let half = Float::with_val_round(53, &half, Round::Up).0.to_f64();
        let off = off.min(up(half + ball.rad().to_f64()));
        self.push(Op::Constant(real, nearest, within(up(off))))
    }

    /// Writes a condition; returns its number.
    pub fn condition(&mut self, id: Id) -> Written<usize> {
        if let Some(known) = self.conditions.get(&id) {
            return Ok(*known);
        }
        let condition = match self.graph.node(id) {
            Node::Truth(t) => Condition::Truth(t),
            Node::Compare(relation, a, b) => {
                Condition::Compare(relation, self.value(a)?, self.value(b)?)
            }
            Node::And(a, b) => Condition::And(self.condition(a)?, self.condition(b)?),
            Node::Or(a, b) => Condition::Or(self.condition(a)?, self.condition(b)?),
            Node::Not(a) => Condition::Not(self.condition(a)?),
            node => return refused(format!("no condition: {node:?}")),
        };
        self.tape.conditions.push(condition);
        let place = self.tape.conditions.len() - 1;
        self.conditions.insert(id, place);
        Ok(place)
    }

    /// Gives the variables of a binder values and forgets what depends on the old ones.
    fn set_variables(&mut self, binder: u32, places: &[Place]) {
        for id in &self.graph.binder(binder).members {
            self.values.remove(id);
            self.conditions.remove(id);
        }
        for (k, place) in places.iter().enumerate() {
            if let Some(id) = self.graph.find(Node::Variable(binder, k as u32)) {
                self.values.insert(id, *place);
            }
        }
    }

    /// A sum between constant limits.
    fn sum(&mut self, binder: u32) -> Written<Place> {
        let Binding::Sum { from, to, body } = self.graph.binder(binder).binding else {
            return refused("an integral or a root is no floating-point operation");
        };
        let limit = |id: Id| match self.graph.node(id) {
            Node::Number(k) => self.graph.rational(k).numer().to_i64(),
            _ => None,
        };
        let (Some(from), Some(to)) = (limit(from), limit(to)) else {
            return refused("a sum whose limits are not numbers");
        };
        let mut sum = None;
        for k in from..=to {
            let index = self.integer(k)?;
            self.set_variables(binder, &[index]);
            let term = self.value(body)?;
            sum = Some(match sum {
                Some(sum) => self.push(Op::Add(sum, term))?,
                None => term,
            });
        }
        sum.map_or_else(|| self.integer(0), Ok)
    }

    /// A loop, unrolled as often as it runs for all inputs.
    fn repeat(&mut self, binder: u32, k: u32) -> Written<Place> {
        let Binding::Loop {
            condition,
            first,
            next,
        } = self.graph.binder(binder).binding.clone()
        else {
            return refused("a system of equations is no floating-point operation");
        };
        let all = |writer: &mut Writer<'a>, ids: &[Id]| -> Written<Vec<Place>> {
            ids.iter().map(|id| writer.value(*id)).collect()
        };
        let mut values = all(self, &first)?;
        // A round may add no operation.
        for round in 0.. {
            if round == LONGEST {
                return refused(format!("a loop of more than {LONGEST} rounds"));
            }
            self.set_variables(binder, &values);
            let condition = self.condition(condition)?;
            let known = self.whole.forward(&self.tape, self.domain, false, &[]);
            known.map_err(|stop| ProgramError(format!("a loop: {}", stop.reason)))?;
            match self.whole.holds(&self.tape, condition) {
                Some(true) => values = all(self, &next)?,
                Some(false) => break,
                None => return refused("how often a loop runs depends on inputs or on rounding"),
            }
        }
        for (k, place) in values.iter().enumerate() {
            if let Some(id) = self.graph.find(Node::Last(binder, k as u32)) {
                self.values.insert(id, *place);
            }
        }
        Ok(values[k as usize])
    }
}

//! Certified values of graphs: the working precision is raised until they are accurate enough.

use super::angle::Angles;
use super::ball::{Balls, MAY_BE_EQUAL, Value, ball_of, bessel};
use super::integral::CLOSER;
use super::short::FirstPass;
use super::tuning::{Passes, Size};
use super::{Evaluator, Stop, cost, huge};
use crate::exact::proves_zero;
use crate::graph::{Binding, Graph, Id, Node};
use crate::{Definitions, Expr, Func};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::{Ball, Mag};
use rug::Rational;
use rug::float::Round;
use std::sync::Arc;

/// How accurate a value has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Goal {
    /// A relative radius of at most `2^−bits`.
    Bits(u32),
    /// Such a radius, or one that is negligible beside the smallest binary64: `2^−bits` times the
    /// larger of the value and `2^−1074`.
    Double(u32),
    /// As accurate as it takes to name the nearest binary64.
    Nearest,
}

/// The certified value of a node, or the reason why there is none.
#[derive(Clone, Debug)]
pub enum Answer {
    /// The number in the ball.
    Number(Ball),
    /// Exactly zero, by the symbolic algebra or by exact arithmetic.
    Zero,
    /// Larger than any ball holds.
    Huge {
        /// True if it is negative.
        negative: bool,
    },
    /// There is no real value.
    Undefined {
        /// Why.
        reason: &'static str,
        /// The subexpression that has none.
        place: String,
    },
    /// Not decided within the limit.
    Undecided(Undecided),
}

/// The subexpression that stayed open.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}: {place} (at {bits} bits)")]
pub struct Undecided {
    /// Why.
    pub reason: &'static str,
    /// The subexpression.
    pub place: String,
    /// The highest precision tried.
    pub bits: u32,
}

impl Balls {
    /// The interpretation at a precision; integrals and roots are enclosed as closely.
    pub fn new(prec: u32) -> Balls {
        Balls {
            prec,
            goal: prec,
            exact: false,
            holomorphic: false,
            mirrors: false,
            wide: false,
            has_complex_roots: false,
            places: u32::MAX,
            evaluations: EVALUATIONS,
            known: i64::MAX,
            precisions: Vec::new(),
            hint: 0,
            work: u64::MAX,
            poles: Vec::new(),
        }
    }
}

/// The expressions of nodes, for the symbolic algebra.
#[derive(Clone, Debug, Default)]
pub struct Algebraic {
    /// The names in them that are defined.
    pub definitions: Definitions,
    /// Nodes with their expressions.
    pub expressions: Vec<(Id, Expr)>,
}

/// Certified values of the nodes of a graph.
pub struct Certified {
    evaluator: Evaluator<Balls>,
    /// Balls of machine words, which are tried first.
    first: Option<FirstPass>,
    /// Circular functions whose arguments are reduced exactly.
    angles: Angles,
    /// The highest working precision.
    limit: u32,
    /// Values of constants at this precision are at hand, and whether they are exact.
    constants: (u32, bool),
    /// The expressions of nodes, by which the symbolic algebra proves zeros.
    algebra: Option<Arc<Algebraic>>,
    /// Nodes on whose operands the algebra was asked at these inputs.
    asked: Vec<Id>,
    /// The facts that it proved of them.
    proved: Vec<Proved>,
    /// True if rational numbers are exact from the start: orders of Bessel functions that no binary
    /// number holds.
    exact: bool,
    /// True if there are functions that jump at rational numbers.
    has_steps: bool,
    /// Bits that inputs have beyond the working precision: what is uncertain in them is so on every
    /// panel of an integral.
    more: u32,
    /// Inputs in a row at which it was asked and proved nothing.
    in_vain: u32,
}

/// A fact that the symbolic algebra proves of a node at the inputs.
enum Proved {
    /// It is a multiple of 1/2, next to which functions have their zeros, poles and steps.
    Value(Id, Rational),
    /// It is a comparison of two equal numbers.
    Equal(Id),
}

/// Parts of an expression of which the algebra is asked.
const LARGEST: u32 = 1000;

/// The working precision that is tried first to name the nearest binary64.
pub(super) const FIRST: u32 = 63;

/// The working precision from which on the symbolic algebra is asked, of arithmetic and roots alone
/// and of other graphs: it costs more than balls of fewer bits.
const ASK_ALGEBRA: [u32; 2] = [8192, 2048];

/// Inputs in a row without an answer after which the algebra is asked at the highest precision
/// alone: few numbers are zero by chance, and it takes longer than thousands of bits.
const PATIENCE: u32 = 4;

/// Reason that exact rational numbers may settle.
const MAY_BE_ZERO: &str = "the divisor may be zero";

/// Reason of a value with fewer digits than are asked for.
const INACCURATE: &str = "a value that is not accurate enough";

/// Evaluations of an integrand before an integral is given up, unless another limit is set.
const EVALUATIONS: u64 = 1 << 19;

/// The highest working precision unless another is set.
pub const LIMIT: u32 = 16_384;

impl Certified {
    /// Creates an evaluator with a limit on the working precision.
    pub fn new(graph: Arc<Graph>, limit: u32) -> Certified {
        let of_order = |id| match graph.node(id) {
            Node::Binary(f, order, _) if bessel(f).is_some() => match graph.node(order) {
                Node::Number(place) => !graph.rational(place).denom().is_power_of_two(),
                _ => true,
            },
            _ => false,
        };
        let is_step = |id| match graph.node(id) {
            Node::Unary(f, _) | Node::Binary(f, ..) => matches!(
                f,
                Func::Floor
                    | Func::Ceil
                    | Func::Round
                    | Func::Trunc
                    | Func::Nearbyint
                    | Func::Fmod
                    | Func::Remainder
            ),
            _ => false,
        };
        let is_integral = |id| match graph.node(id) {
            Node::Bound(b) => matches!(graph.binder(b).binding, Binding::Integral { .. }),
            _ => false,
        };
        // A part of a complex number that varies with the variable of an integral.
        let is_part = |id| match graph.node(id) {
            Node::Unary(Func::Re | Func::Im | Func::Conj | Func::Abs | Func::Arg, z) => {
                graph.is_complex(z) && graph.is_within(z)
            }
            _ => false,
        };
        let balls = Balls {
            mirrors: (0..graph.len() as Id).any(is_part),
            ..Balls::new(FIRST)
        };
        Certified {
            exact: (0..graph.len() as Id).any(of_order),
            has_steps: (0..graph.len() as Id).any(is_step),
            more: match (0..graph.len() as Id).any(is_integral) {
                true => CLOSER,
                false => 0,
            },
            first: FirstPass::new(&graph),
            angles: Angles::new(&graph),
            evaluator: Evaluator::new(graph, balls),
            limit: limit.max(64),
            constants: (0, false),
            algebra: None,
            asked: Vec::new(),
            proved: Vec::new(),
            in_vain: 0,
        }
    }

    /// Lets the symbolic algebra decide whether these nodes are zero, where balls do not.
    #[must_use]
    pub fn with_algebra(mut self, algebra: Arc<Algebraic>) -> Certified {
        self.algebra = Some(algebra);
        self
    }

    /// The values of nodes at exact inputs.
    pub fn values(&mut self, inputs: &[Rational], nodes: &[Id], goal: Goal) -> Vec<Answer> {
        self.angles.reduce(self.evaluator.graph(), inputs);
        self.evaluator.interpretation.poles = self.angles.poles();
        let mut answers: Vec<Option<Answer>> = match &mut self.first {
            Some(first) => first.answers(inputs, &self.angles, nodes, goal),
            None => vec![None; nodes.len()],
        };
        if answers.iter().all(Option::is_some) {
            return answers.into_iter().flatten().collect();
        }
        let mut asked = vec![false; nodes.len()];
        let mut work = vec![cost::allowed(goal); nodes.len()];
        self.asked.clear();
        self.proved.clear();
        // Bits that an output is to have for as long as it is not accurate enough.
        let mut wanted = match goal {
            Goal::Nearest => 128,
            Goal::Bits(bits) | Goal::Double(bits) => bits,
        };
        let open = nodes.iter().zip(&answers).filter(|(_, a)| a.is_none());
        let open: Vec<Id> = open.map(|(node, _)| *node).collect();
        let prec = match (goal, &self.first) {
            (Goal::Nearest, Some(first)) => first.next(),
            (Goal::Nearest, None) => FIRST,
            (Goal::Bits(bits) | Goal::Double(bits), _) => bits.saturating_add(16),
        };
        let mut prec = prec.min(self.limit);
        let balls = &mut self.evaluator.interpretation;
        balls.precisions.clear();
        // Arithmetic that cancels is exact at once.
        let graph = self.evaluator.graph();
        let is_rational = open.iter().all(|id| graph.is_rational(*id));
        let is_exact =
            self.exact || is_rational && self.first.as_ref().is_some_and(FirstPass::has_cancelled);
        if let (Goal::Nearest, Some(first), false) = (goal, &self.first, is_exact) {
            self.evaluator.interpretation.precisions = first.precisions(&open, wanted, prec);
        }
        self.evaluator.interpretation.exact = is_exact;
        let is_arithmetic = self.first.as_ref().is_some_and(|first| !first.has_called());
        let ask_algebra = match self.in_vain < PATIENCE {
            true => ASK_ALGEBRA[usize::from(!is_arithmetic)].min(self.limit),
            false => self.limit,
        };
        loop {
            prec = prec.min(self.limit);
            self.begin(inputs, prec, goal);
            // The precision that the open ones are estimated to need.
            let mut needed = 0;
            let mut open = Vec::new();
            for (k, node) in nodes.iter().enumerate() {
                if answers[k].is_some() {
                    continue;
                }
                self.evaluator.evaluations = super::ALL_EVALUATIONS;
                self.evaluator.interpretation.work = work[k];
                let found = self.evaluator.value(*node).cloned();
                work[k] = self.evaluator.interpretation.work;
                let (reason, lacking) = match found {
                    Err(_) if work[k] == 0 => {
                        open.push((k, *node, cost::REASON));
                        continue;
                    }
                    // Digits are those of a number that is not beyond all that have any.
                    Ok(Value::Huge { exponent, .. })
                        if matches!(goal, Goal::Bits(_)) && exponent < huge::ENDLESS =>
                    {
                        answers[k] = Some(Answer::Undecided(Undecided {
                            reason: "a number that may be within 2^(2^30)",
                            place: self.evaluator.graph().text(*node),
                            bits: prec,
                        }));
                        continue;
                    }
                    Ok(Value::Huge { negative, .. }) => {
                        answers[k] = Some(Answer::Huge { negative });
                        continue;
                    }
                    Ok(value) => match value.real() {
                        None => {
                            answers[k] = Some(self.undefined(*node, "a complex value"));
                            continue;
                        }
                        Some(ball) if ball.is_zero() => {
                            answers[k] = Some(Answer::Zero);
                            continue;
                        }
                        Some(ball) => match lacking(ball, goal) {
                            0 => {
                                answers[k] = Some(Answer::Number(ball.clone()));
                                continue;
                            }
                            lacking => (INACCURATE, lacking),
                        },
                    },
                    Err(Stop {
                        node,
                        reason: NoValue::Undefined(reason),
                    }) => {
                        answers[k] = Some(self.undefined(node, reason));
                        continue;
                    }
                    Err(Stop {
                        node,
                        reason: NoValue::Undecided(reason),
                    }) => {
                        open.push((k, node, reason));
                        needed = needed.max(prec.saturating_mul(2));
                        continue;
                    }
                    Err(Stop {
                        node,
                        reason: NoValue::Overflow { .. },
                    }) => {
                        open.push((k, node, "a number beyond the exponents"));
                        needed = needed.max(prec.saturating_mul(2));
                        continue;
                    }
                };
                open.push((k, *node, reason));
                needed = needed.max(match lacking {
                    u32::MAX => prec.saturating_mul(3),
                    bits => prec.saturating_add(bits).saturating_add(16),
                });
            }
            if open.is_empty() {
                break;
            }
            // More precision shortens neither a loop nor an integral.
            open.retain(|(k, node, reason)| {
                let finals = [
                    super::ROUNDS_REASON,
                    super::EVALUATIONS_REASON,
                    cost::REASON,
                ];
                let is_open = !finals.contains(reason);
                if !is_open {
                    let place = self.evaluator.graph().text(*node);
                    let bits = prec;
                    answers[*k] = Some(Answer::Undecided(Undecided {
                        reason,
                        place,
                        bits,
                    }));
                }
                is_open
            });
            if open.is_empty() {
                break;
            }
            // Rational numbers that are equal are seen to be so where they are exact.
            let is_exact = self.evaluator.interpretation.exact;
            let graph = self.evaluator.graph();
            let has_steps = self.has_steps;
            let may_help = |o: &(usize, Id, &str)| {
                // A step, a pole or an end of the domain may be at a rational number.
                let mut operands = graph.operands(graph.node(o.1)).into_iter();
                let is_next_to_it = o.2 != INACCURATE && operands.all(|id| graph.is_rational(id));
                let is_compared = [MAY_BE_EQUAL, MAY_BE_ZERO].contains(&o.2);
                let is_split = has_steps || is_compared || is_next_to_it;
                graph.is_rational(nodes[o.0]) || (is_split && prec >= 128)
            };
            if !is_exact && open.iter().any(may_help) {
                self.evaluator.interpretation.exact = true;
                self.evaluator.interpretation.precisions.clear();
                continue;
            }
            // A divisor or a difference that decides may be zero.
            if prec >= ask_algebra {
                let before = self.proved.len();
                for (_, node, _) in &open {
                    self.ask_of_operands(*node, inputs);
                }
                if self.proved.len() > before {
                    continue;
                }
            }
            // A value whose balls hold zero may be zero.
            for (k, _, _) in &open {
                let is_new = prec >= ask_algebra && !std::mem::replace(&mut asked[*k], true);
                if is_new && self.is_zero(nodes[*k], inputs) {
                    answers[*k] = Some(Answer::Zero);
                }
            }
            if prec >= self.limit {
                // The estimates may have been wrong.
                if !std::mem::take(&mut self.evaluator.interpretation.precisions).is_empty() {
                    continue;
                }
                for (k, node, reason) in open {
                    let place = self.evaluator.graph().text(node);
                    answers[k].get_or_insert(Answer::Undecided(Undecided {
                        reason,
                        place,
                        bits: prec,
                    }));
                }
                break;
            }
            let before = prec;
            prec = needed
                .clamp(prec + 32, prec.saturating_mul(4))
                .max(self.evaluator.interpretation.hint)
                .next_multiple_of(64)
                .min(self.limit);
            wanted += 64;
            if self.first.as_ref().is_some_and(FirstPass::is_tuned) && !is_exact {
                let open: Vec<Id> = open.iter().map(|o| nodes[o.0]).collect();
                let passes = Passes {
                    graph: self.evaluator.graph(),
                    size: |id: Id| {
                        let value = self.evaluator.known[id as usize].as_ref();
                        value.and_then(Value::real).map(Size::of)
                    },
                    before,
                    most: prec,
                    wanted,
                };
                let found = passes.precisions(&open);
                self.evaluator.interpretation.precisions = found;
            }
        }
        let answers: Vec<Answer> = answers.into_iter().flatten().collect();
        let is_zero = |a: &Answer| matches!(a, Answer::Zero);
        if !self.proved.is_empty() || answers.iter().any(is_zero) {
            self.in_vain = 0;
        } else if !self.asked.is_empty() || asked.contains(&true) {
            self.in_vain += 1;
        }
        answers
    }

    /// Prepares an evaluation at a precision.
    fn begin(&mut self, inputs: &[Rational], prec: u32, goal: Goal) {
        let balls = &mut self.evaluator.interpretation;
        balls.prec = prec;
        balls.hint = 0;
        balls.goal = match goal {
            Goal::Nearest => prec.saturating_sub(16),
            Goal::Bits(bits) | Goal::Double(bits) => bits + 4,
        };
        let constants = (prec, balls.exact);
        self.evaluator
            .reset(std::mem::replace(&mut self.constants, constants) != constants);
        for (k, input) in inputs.iter().enumerate() {
            let bits = prec.saturating_add(self.more);
            let value = match self.evaluator.interpretation.exact {
                true => Value::rational(bits, input.clone()),
                false => Value::Real(ball_of(bits, input)),
            };
            self.evaluator.set_input(k, value);
        }
        let precisions = std::mem::take(&mut self.evaluator.interpretation.precisions);
        let is_exact = self.evaluator.interpretation.exact;
        self.angles.set(
            &mut self.evaluator,
            |id| precisions.get(id as usize).copied().unwrap_or(prec),
            |x| match is_exact && x.rad().is_zero() {
                true => Some(Value::rational(prec, x.mid().to_rational()?)),
                false => Some(Value::Real(x)),
            },
        );
        self.evaluator.interpretation.precisions = precisions;
        for proved in &self.proved {
            match proved {
                Proved::Value(node, q) => {
                    let value = match self.evaluator.interpretation.exact {
                        true => Value::rational(prec, q.clone()),
                        false => Value::Real(ball_of(prec, q)),
                    };
                    self.evaluator.set(*node, value);
                }
                Proved::Equal(node) => self.evaluator.set_equal(*node),
            }
        }
    }

    /// Asks the symbolic algebra about the operands of a node that balls do not decide.
    fn ask_of_operands(&mut self, node: Id, inputs: &[Rational]) {
        if self.algebra.is_none() || self.asked.contains(&node) {
            return;
        }
        self.asked.push(node);
        let graph = self.evaluator.graph().clone();
        let expression = |id: Id| graph.expression(id, &mut LARGEST.clone());
        let is_zero = |e: Option<Expr>| {
            e.is_some_and(|e| proves_zero(&Definitions::default(), &e, graph.inputs(), inputs))
        };
        if let Node::Compare(_, a, b) = graph.node(node) {
            let difference = expression(a).zip(expression(b));
            let difference = difference.map(|(a, b)| Expr::Add(vec![a, Expr::Neg(Box::new(b))]));
            if is_zero(difference) {
                self.proved.push(Proved::Equal(node));
            }
            return;
        }
        for operand in graph.operands(graph.node(node)) {
            let known = self.evaluator.known[operand as usize].as_ref();
            let Some(half) = known.and_then(Value::real).and_then(only_half) else {
                continue;
            };
            let size = Expr::Num(half.clone().abs().to_string());
            let minus = match half > 0 {
                true => Expr::Neg(Box::new(size)),
                false => size,
            };
            let off = expression(operand).map(|e| Expr::Add(vec![e, minus]));
            if is_zero(off) {
                self.proved.push(Proved::Value(operand, half));
            }
        }
    }

    fn undefined(&self, node: Id, reason: &'static str) -> Answer {
        Answer::Undefined {
            reason,
            place: self.evaluator.graph().text(node),
        }
    }

    fn is_zero(&self, node: Id, inputs: &[Rational]) -> bool {
        let Some(Algebraic {
            definitions,
            expressions,
        }) = self.algebra.as_deref()
        else {
            return false;
        };
        let expression = expressions.iter().find(|e| e.0 == node).map(|e| &e.1);
        expression
            .is_some_and(|e| proves_zero(definitions, e, self.evaluator.graph().inputs(), inputs))
    }
}

/// The only multiple of 1/2 in a ball that is no exact number.
fn only_half(x: &Ball) -> Option<Rational> {
    if x.rad().is_zero() || x.rad() >= Mag::power_of_two(-4) {
        return None;
    }
    let half = Rational::from((x.shift(1).mid().to_integer_round(Round::Nearest)?.0, 2));
    (x - &Ball::rational(x.prec(), &half))
        .contains_zero()
        .then_some(half)
}

/// Bits that a ball lacks to its goal; the largest number where nothing is known of it.
pub(super) fn lacking(ball: &Ball, goal: Goal) -> u32 {
    if !ball.is_finite() {
        return u32::MAX;
    }
    let bits = match goal {
        Goal::Nearest => return lacking_to_nearest(ball),
        Goal::Bits(bits) => bits,
        Goal::Double(bits) => {
            if ball.rad() <= Mag::power_of_two(-1074 - i64::from(bits)) {
                return 0;
            }
            bits
        }
    };
    let accuracy = ball.accuracy_bits();
    match i64::from(bits).saturating_sub(accuracy) {
        lacking if lacking <= 0 => 0,
        _ if ball.contains_zero() => u32::MAX,
        lacking => u32::try_from(lacking).unwrap_or(u32::MAX),
    }
}

/// Zero if all numbers of the ball have the same nearest binary64.
fn lacking_to_nearest(ball: &Ball) -> u32 {
    let accuracy = ball.accuracy_bits();
    if accuracy == i64::MAX {
        return 0;
    }
    let [low, high] = [ball.lower(), ball.upper()].map(|x| nearest_double(&x));
    if low == high {
        return 0;
    }
    match ball.contains_zero() {
        true => u32::MAX,
        // Near the middle of two numbers twice the bits decide.
        false => u32::try_from(64 - accuracy).unwrap_or(64).max(32),
    }
}

/// The binary64 nearest to a number.
fn nearest_double(x: &rug::Float) -> f64 {
    // Above the subnormal numbers the conversion rounds once.
    let value = x.to_f64();
    if value.abs() >= 2.0 * f64::MIN_POSITIVE || x.is_zero() {
        return value;
    }
    let (mut rounded, way) = rug::Float::with_val_round(53, x, rug::float::Round::Nearest);
    rounded.subnormalize_ieee_round(way, rug::float::Round::Nearest);
    rounded.to_f64()
}

impl Answer {
    /// The nearest binary64: NaN where the value is undefined or undecided.
    pub fn to_f64(&self) -> f64 {
        match self {
            Answer::Number(ball) => nearest_double(ball.mid()),
            Answer::Zero => 0.0,
            Answer::Huge { negative: false } => f64::INFINITY,
            Answer::Huge { negative: true } => f64::NEG_INFINITY,
            Answer::Undefined { .. } | Answer::Undecided(_) => f64::NAN,
        }
    }
}

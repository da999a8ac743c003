//! Integrands in machine words.

use super::super::Evaluator;
use super::super::ball::{Balls, Value};
use super::super::integral::leaves;
use super::{Choice, Choosing, Chosen, Short, Words, is_choice};
use crate::graph::{Id, Node};
use mechaudit_reference::elementary::complex::Rectangle;
use mechaudit_reference::quadrature::Crossing;
use mechaudit_reference::{Ball, Ball128, Complex128, ComplexBall};
use rug::Float;

/// The body of a binder of one variable as a function of numbers in these balls.
pub(in super::super) struct Pointwise {
    evaluator: Evaluator<Short>,
    binder: u32,
    body: Id,
    /// True if functions with choices depend on the variable, each of which is made once.
    has_choices: bool,
    /// True if complex numbers are left to MPFR.
    is_slow: bool,
    /// The number at which choices are kept.
    chosen_at: Option<Float>,
}

impl Pointwise {
    /// Takes the values of what does not depend on the variable from another evaluator.
    pub fn new(balls: &Evaluator<Balls>, binder: u32, body: Id) -> Pointwise {
        let graph = balls.graph().clone();
        let parts = graph.reach(body);
        // A node under another binder makes many choices.
        let is_bound = |id: &Id| matches!(graph.node(*id), Node::Bound(_) | Node::Last(..));
        let is_straight = !parts.iter().any(is_bound);
        let has_choices = is_straight
            && parts.into_iter().any(|id| {
                let is_choice = match graph.node(id) {
                    Node::Unary(f, _) | Node::Binary(f, ..) => is_choice(f),
                    Node::Compare(..) => true,
                    _ => false,
                };
                is_choice && graph.depends_on(id, binder)
            });
        let mut evaluator = Evaluator::new(graph, Short::new(128));
        for id in leaves(balls.graph(), body, binder) {
            let value = match &balls.known[id as usize] {
                Some(Value::Complex(z)) => Complex128::of_ball(z).map(Words::Complex),
                Some(value) => value.real().and_then(Ball128::of_ball).map(Words::Real),
                None => None,
            };
            if let Some(value) = value {
                evaluator.set(id, value);
            }
        }
        Pointwise {
            evaluator,
            binder,
            body,
            has_choices,
            is_slow: false,
            chosen_at: None,
        }
    }

    /// Returns true if functions with choices depend on the variable, each of which is made once.
    pub fn has_choices(&self) -> bool {
        self.has_choices
    }

    /// An evaluation with choices.
    fn choosing(&mut self, how: Choosing, x: Words, rounds: &mut u64) -> Option<Words> {
        self.evaluator.interpretation.choosing = how;
        let found = self.at(x, rounds);
        self.evaluator.interpretation.choosing = Choosing::Freely;
        found
    }

    /// Returns true if every choice is the same for all numbers of an interval.
    pub fn is_settled(&mut self, x: &Ball, rounds: &mut u64) -> bool {
        let x = Ball128::of_ball(x);
        x.is_some_and(|x| {
            let found = self.choosing(Choosing::Settled, Words::Real(x), rounds);
            found.is_some()
        })
    }

    /// The choices at a number, by nodes.
    fn choices_at(&mut self, x: &Ball, rounds: &mut u64) -> Option<&mut Vec<Option<Chosen>>> {
        self.chosen_at = None;
        self.evaluator.interpretation.choices.clear();
        let x = Words::Real(Ball128::of_ball(x)?);
        self.choosing(Choosing::Kept, x, rounds)?;
        Some(&mut self.evaluator.interpretation.choices)
    }

    /// Guesses where between two numbers choices change.
    pub fn crossing(&mut self, [a, b]: [&Ball; 2], rounds: &mut u64) -> Option<Crossing> {
        let before = std::mem::take(self.choices_at(a, rounds)?);
        let after = self.choices_at(b, rounds)?;
        let change = |(x, y): (&Option<Chosen>, &Option<Chosen>)| {
            let (x, y) = ((*x)?, (*y)?);
            let (threshold, is_single) = match (x.choice, y.choice) {
                (Choice::Order(i), Choice::Order(j)) if i != j => (0, true),
                (Choice::Step(i), Choice::Step(j)) if i != j => {
                    (i + i64::from(i < j), i.abs_diff(j) == 1)
                }
                _ => return None,
            };
            let threshold = Ball128::integer(threshold);
            let off = |x: &Chosen| {
                let [low, high] = x.by.sub(&threshold)?.doubles()?;
                Some(low / 2.0 + high / 2.0)
            };
            let (from, to) = (off(&x)?, off(&y)?);
            let share = from / (from - to);
            let is_between = (0.0..=1.0).contains(&share);
            is_between.then_some(Crossing { share, is_single })
        };
        let changes = before.iter().zip(after.iter()).filter_map(change);
        changes.reduce(|a, b| Crossing {
            share: a.share.min(b.share),
            is_single: false,
        })
    }

    /// Encloses on a rectangle the holomorphic function that the choices at a number make.
    pub fn chosen(&mut self, at: &Ball, z: &ComplexBall, rounds: &mut u64) -> Option<ComplexBall> {
        if self.chosen_at.as_ref() != Some(at.mid()) {
            self.choices_at(at, rounds)?;
            self.chosen_at = Some(at.mid().clone());
        }
        self.evaluator.interpretation.choosing = Choosing::Held;
        let found = self.continuation(z, rounds);
        self.evaluator.interpretation.choosing = Choosing::Freely;
        found
    }

    /// Returns true if this is the body.
    pub fn is_of(&self, body: Id) -> bool {
        self.body == body
    }

    fn at(&mut self, x: Words, rounds: &mut u64) -> Option<Words> {
        self.evaluator.rounds = *rounds;
        self.evaluator.set_variables(self.binder, [x]);
        let found = self.evaluator.value(self.body).ok().copied();
        *rounds = self.evaluator.rounds;
        found
    }

    /// The value at a number; it takes from the rounds of loops that are left.
    pub fn value(&mut self, x: &Ball128, rounds: &mut u64) -> Option<Ball128> {
        self.at(Words::Real(*x), rounds)?.real().copied()
    }

    /// The value at a number as a complex one.
    pub fn complex_value(&mut self, x: &Ball128, rounds: &mut u64) -> Option<Complex128> {
        if self.is_slow {
            return None;
        }
        self.evaluator.interpretation.has_left = false;
        let found = self.at(Words::Real(*x), rounds)?.complex();
        // Functions of MPFR cost as much with more bits, which may be needed.
        self.is_slow = self.evaluator.interpretation.has_left;
        found.filter(|_| !self.is_slow)
    }

    /// Encloses the continuation on a rectangle on which it is holomorphic.
    pub fn continuation(&mut self, z: &ComplexBall, rounds: &mut u64) -> Option<ComplexBall> {
        let z = Words::Continued(Rectangle::of_ball(z)?);
        // Bounds are doubles in the end.
        let outside = &mut self.evaluator.interpretation.balls;
        (outside.prec, outside.holomorphic) = (64, true);
        let found = self.at(z, rounds);
        let outside = &mut self.evaluator.interpretation.balls;
        (outside.prec, outside.holomorphic) = (128, false);
        found?.to_value()?.to_complex()
    }
}

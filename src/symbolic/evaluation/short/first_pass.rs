//! The first pass over a graph, of which most values are accurate enough.

use super::super::Evaluator;
use super::super::adaptive::{Answer, FIRST, Goal};
use super::super::angle::Angles;
use super::super::tuning::{Passes, Size};
use super::{Short, Words};
use crate::graph::{Graph, Id};
use mechaudit_reference::{Ball, Ball128};
use rug::Rational;
use std::sync::Arc;

/// Values of the nodes of a graph in these balls, for as far as they decide.
pub(in super::super) struct FirstPass {
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
        Short::takes(graph).then(|| FirstPass {
            evaluator: Evaluator::new(graph.clone(), Short::new(FIRST)),
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
            size: |id: Id| {
                let value = evaluator.known[id as usize].as_ref();
                value.and_then(Words::real).map(Size::of_short)
            },
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
                let Some(value) = value.real() else { continue };
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
        let of_ball = |x: Ball| Ball128::of_ball(&x).map(Words::Real);
        let has_angles = angles.set(&mut self.evaluator, |_| prec, of_ball);
        self.evaluator.interpretation.has_called = has_angles;
        inputs.iter().enumerate().all(|(k, input)| {
            let value = self.evaluator.interpretation.rational(input);
            value
                .map(|x| self.evaluator.set_input(k, Words::Real(x)))
                .is_some()
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

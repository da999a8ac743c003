//! Quantities of a motion: expressions of the inputs, the time and the states.
//!
//! A quantity may jump at a switch, as a force does that holds a body at rest. On a smooth piece of
//! a motion it is taken on the sides of that piece, also where the motion begins at the switch.
//! Where the motion slides along one, it is the mean of both sides that the rates have there: it
//! has to be a linear function of what jumps in the rates, as forces and accelerations are.

use super::field::{Sides, inputs_of, set};
use super::problem::InitialValueProblem;
use super::sliding::choices;
use crate::evaluation::taylor::{Side, Switch};
use crate::evaluation::{Balls, Evaluator};
use crate::graph::{Graph, Id};
use mechaudit_reference::Ball;
use std::sync::Arc;

/// The quantities on some sides of switches.
pub(super) struct Quantities {
    graph: Arc<Graph>,
    /// `None` for one that is not known on the sides.
    nodes: Vec<Option<Id>>,
}

impl Quantities {
    /// The quantities of a problem on some sides of its switches.
    pub fn on(problem: &InitialValueProblem, sides: &Sides) -> Quantities {
        let mut found = Quantities {
            graph: problem.graph.clone(),
            nodes: problem.quantities.iter().copied().map(Some).collect(),
        };
        let mut sides: Vec<(&Switch, &Side)> = sides.iter().collect();
        // A switch is replaced before the switches that its value depends on.
        sides.sort_by_key(|(switch, _)| {
            let (a, b) = switch.parts();
            std::cmp::Reverse(b.unwrap_or(a).max(a))
        });
        for (switch, side) in sides {
            if !matches!(side, Side::Positive | Side::Negative) {
                continue;
            }
            let graph = Arc::make_mut(&mut found.graph);
            let known: Vec<Id> = found.nodes.iter().flatten().copied().collect();
            let map = choices(graph, &known, *switch, *side == Side::Positive);
            for node in &mut found.nodes {
                *node = node.and_then(|node| graph.replaced(node, &map).ok());
            }
        }
        found
    }

    /// The values at all times and states of some balls, with the inputs of an evaluator; `None`
    /// for a quantity without a value.
    pub fn values(
        &self,
        problem: &InitialValueProblem,
        of: &mut Evaluator<Balls>,
        (time, states): (&Ball, &[Ball]),
    ) -> Vec<Option<Ball>> {
        let balls = Balls::new(of.interpretation.prec);
        let mut evaluator = Evaluator::new(self.graph.clone(), balls);
        for (k, value) in inputs_of(of, problem.inputs).into_iter().enumerate() {
            if let Some(value) = value {
                evaluator.set_input(k, value);
            }
        }
        set(&mut evaluator, problem, time, states);
        let value = |node: &Option<Id>| evaluator.value((*node)?).ok()?.real().cloned();
        self.nodes.iter().map(value).collect()
    }
}

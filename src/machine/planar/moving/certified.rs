//! The motion with certified digits.

use super::equations::Equations;
use super::laws::TIME;
use super::{Moving, MovingError};
use crate::reference::Ball;
use crate::study::StudySystem;
use mechaudit_symbolic::evaluation::{
    Balls, Evaluator, InitialValueProblem, Limits, Trajectory, Value,
};
use mechaudit_symbolic::graph::{Graph, Id};
use mechaudit_symbolic::{SymbolicError, parse};
use rug::{Complete, Integer, Rational};
use std::sync::Arc;

/// Times that the working precision is raised for a quantity that cancels.
const RAISED: u32 = 3;

/// Certified values of a motion.
pub struct Certified {
    graph: Arc<Graph>,
    /// The quantities of a row: states, or expressions of them.
    outputs: Vec<Output>,
    trajectory: Trajectory,
    digits: u32,
}

enum Output {
    State(usize),
    Expression(Id),
}

/// A row of digits; `None` where none are proved, with the reason.
pub type Digits = (Vec<Option<String>>, Option<String>);

fn fault(e: impl std::fmt::Display) -> MovingError {
    MovingError::NotExact(e.to_string())
}

impl Certified {
    /// For so many significant digits of every quantity.
    ///
    /// # Errors
    /// [`MovingError`].
    pub fn new(moving: &Moving, digits: u32) -> Result<Certified, MovingError> {
        let equations = moving.equations()?;
        let (graph, nodes, outputs) = equations.graph().map_err(fault)?;
        let mut posed = graph.clone();
        let zero = posed.number(0);
        let problem = InitialValueProblem::of_graph(posed, zero, &nodes).map_err(fault)?;
        let trajectory = problem.trajectory(&[], Limits::default()).map_err(fault)?;
        let output = |(id, name): (Id, &String)| {
            let state = equations.states.iter().position(|s| s.name == *name);
            state.map_or(Output::Expression(id), Output::State)
        };
        Ok(Certified {
            outputs: outputs
                .into_iter()
                .zip(&equations.outputs)
                .map(output)
                .collect(),
            graph: Arc::new(graph),
            trajectory,
            digits,
        })
    }

    /// The quantities at a time in seconds. One whose enclosure holds zero is `0` if it is proved to be smaller than
    /// `10^−digits` of its unit.
    pub fn at(&mut self, time: &Rational) -> Digits {
        let mut bits = crate::machine::first_bits(self.digits) - 40;
        let mut found = vec![None; self.outputs.len()];
        let mut reason = None;
        for _ in 0..=RAISED {
            let states = match self.trajectory.enclosed(time, bits) {
                Ok(states) => states,
                Err(e) => {
                    reason = Some(e.to_string());
                    break;
                }
            };
            let values = self.values(time, &states, bits + 64);
            for (found, value) in found.iter_mut().zip(values) {
                if found.is_none() {
                    *found = value.and_then(|v| self.decimal(&v));
                }
            }
            if found.iter().all(Option::is_some) {
                return (found, None);
            }
            bits *= 2;
        }
        let narrow = "the enclosure is not narrow enough for all digits";
        (found, Some(reason.unwrap_or_else(|| narrow.into())))
    }

    fn decimal(&self, value: &Ball) -> Option<String> {
        let least = Ball::rational(
            64,
            &Rational::from((1, Integer::u_pow_u(10, self.digits).complete())),
        );
        match value.contains_zero() && value.magnitude() < least.mignitude() {
            true => Some("0".into()),
            false => value.to_decimal(self.digits as usize),
        }
    }

    /// The quantities about enclosed states.
    fn values(&self, time: &Rational, states: &[Ball], bits: u32) -> Vec<Option<Ball>> {
        let mut evaluator = Evaluator::new(self.graph.clone(), Balls::new(bits));
        evaluator.set_input(0, Value::Real(Ball::rational(bits, time)));
        for (k, state) in states.iter().enumerate() {
            evaluator.set_input(k + 1, Value::Real(state.clone()));
        }
        let value = |output: &Output| match output {
            Output::State(k) => Some(states[*k].clone()),
            Output::Expression(id) => evaluator.value(*id).ok()?.real().cloned(),
        };
        self.outputs.iter().map(value).collect()
    }
}

/// Nodes of starts and rates, and of quantities.
type Nodes = (Graph, Vec<(Id, Id)>, Vec<Id>);

impl Equations {
    /// The equations as a graph whose inputs are the time and the states.
    ///
    /// # Errors
    /// [`SymbolicError`] for a formula without meaning.
    pub fn graph(&self) -> Result<Nodes, SymbolicError> {
        let definitions = self.defined()?;
        let names = self.states.iter().map(|s| s.name.clone());
        let names = std::iter::once(TIME.to_string()).chain(names);
        let mut graph = Graph::new(names).of_real_functions();
        if !self.unknowns.is_empty() {
            let StudySystem {
                unknowns,
                equations,
            } = self.system()?;
            graph.solve(&definitions, &unknowns, &equations)?;
        }
        let mut nodes = Vec::new();
        for state in &self.states {
            let start = graph.build(&definitions, &parse(&state.start)?)?;
            nodes.push((start, graph.build(&definitions, &parse(&state.rate)?)?));
        }
        let mut outputs = Vec::new();
        for name in &self.outputs {
            outputs.push(graph.build(&definitions, &parse(name)?)?);
        }
        Ok((graph, nodes, outputs))
    }
}

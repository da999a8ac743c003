//! The motion with certified digits.

use super::equations::{Equations, OUTSIDE, UNTIL};
use super::laws::TIME;
use super::study::read;
use super::{Moving, MovingError, Row};
use crate::reference::{Ball, Decimal};
use crate::study::StudySystem;
use mechaudit_symbolic::SymbolicError;
use mechaudit_symbolic::evaluation::{Balls, Evaluator, InitialValueProblem, Limits, Trajectory};
use mechaudit_symbolic::graph::{Graph, Id};
use rug::{Complete, Float, Integer, Rational};
use std::sync::Arc;

/// Times that the working precision is raised for a quantity that cancels.
const RAISED: u32 = 3;

/// Certified values of a motion.
pub struct Certified {
    /// The graph of the starts.
    graph: Arc<Graph>,
    /// The quantities of a row: states, or quantities of the trajectory.
    outputs: Vec<Output>,
    trajectory: Trajectory,
    digits: u32,
    /// States that tell whether the motion has passed its end or a table's.
    until: Option<usize>,
    outside: Option<usize>,
    starts: Vec<Id>,
}

enum Output {
    State(usize),
    Quantity(usize),
}

/// Certified digits at a moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CertifiedMoment {
    /// Those of every quantity; `None` where none are proved.
    pub digits: Vec<Option<String>>,
    /// The reason why some are not proved.
    pub reason: Option<String>,
    /// The time in seconds, rounded to the digits, at which the motion ended, if it has: the
    /// quantities are those at the end.
    pub ended: Option<Rational>,
}

/// The end of a motion, or of what is known of it.
enum Passed {
    /// The time and the states then.
    End(Ball, Vec<Ball>),
    Not,
    /// It is not known at this precision.
    Open,
}

fn fault(e: impl std::fmt::Display) -> MovingError {
    MovingError::NotExact(e.to_string())
}

impl Certified {
    /// For `digits` significant digits of every quantity of a row.
    ///
    /// # Errors
    /// [`MovingError`].
    pub fn new(moving: &Moving, digits: u32, row: &Row) -> Result<Certified, MovingError> {
        let equations = moving.equations(row)?;
        let (graph, nodes, outputs) = equations.graph().map_err(fault)?;
        let mut posed = graph.clone();
        let zero = posed.number(0);
        let problem = InitialValueProblem::of_graph(posed, zero, &nodes).map_err(fault)?;
        let problem = problem.with_quantities(outputs);
        let trajectory = problem.trajectory(&[], Limits::default()).map_err(fault)?;
        let state = |name: &str| equations.states.iter().position(|s| s.name == *name);
        let outputs = equations.outputs.iter().enumerate();
        let outputs =
            outputs.map(|(k, name)| state(name).map_or(Output::Quantity(k), Output::State));
        Ok(Certified {
            outputs: outputs.collect(),
            starts: nodes.iter().map(|n| n.0).collect(),
            until: state(UNTIL),
            outside: state(OUTSIDE),
            graph: Arc::new(graph),
            trajectory,
            digits,
        })
    }

    /// The quantities at a time in seconds, or at the end of the motion if that comes first. One
    /// whose enclosure holds zero is `0` if it is proved to be smaller than `10^−digits` of its
    /// unit.
    pub fn at(&mut self, time: &Rational) -> CertifiedMoment {
        let mut bits = crate::machine::first_bits(self.digits) - 40;
        let mut found = CertifiedMoment {
            digits: vec![None; self.outputs.len()],
            ..CertifiedMoment::default()
        };
        for _ in 0..=RAISED {
            match self.try_at(time, bits, &mut found) {
                Err(reason) => {
                    found.reason = Some(reason);
                    return found;
                }
                Ok(()) if found.digits.iter().all(Option::is_some) => return found,
                Ok(()) => bits *= 2,
            }
        }
        found.reason = Some("the enclosure is not narrow enough for all digits".into());
        found
    }

    /// Adds what a run of `bits` bits decides.
    fn try_at(
        &mut self,
        time: &Rational,
        bits: u32,
        found: &mut CertifiedMoment,
    ) -> Result<(), String> {
        let mut states = match self.starts(bits).filter(|_| time.is_zero()) {
            // A start that is exactly zero is on one side of a switch.
            Some(starts) => starts,
            None => self.states(time, bits)?,
        };
        let quantities = match self.passed(time, &states, bits)? {
            Passed::Open => return Ok(()),
            Passed::Not => self.trajectory.quantities(time, &states, bits),
            Passed::End(end, at_end) => {
                let decimal = end.to_decimal(self.digits as usize);
                let Some(decimal) = decimal.and_then(|d| Decimal::parse(&d).ok()) else {
                    return Ok(());
                };
                found.ended = Some(decimal.value);
                states = at_end;
                Ok(self.trajectory.quantities_across(&end, &states))
            }
        };
        if let Some(k) = self.outside {
            if states[k].is_positive() {
                return Err("the speed has left the motor's table".into());
            }
            if !self.is_none(&states[k]) {
                return Ok(());
            }
        }
        for (found, output) in found.digits.iter_mut().zip(&self.outputs) {
            let value = match output {
                Output::State(k) => Some(&states[*k]),
                Output::Quantity(k) => quantities.as_ref().ok().and_then(|all| all[*k].as_ref()),
            };
            if found.is_none() {
                *found = value.and_then(|value| self.decimal(value));
            }
        }
        quantities.map(drop).map_err(|e| e.to_string())
    }

    /// The states at the start.
    fn starts(&self, bits: u32) -> Option<Vec<Ball>> {
        let mut evaluator = Evaluator::new(self.graph.clone(), Balls::new(bits + 16));
        let mut value = |id: &Id| evaluator.value(*id).ok()?.real().cloned();
        self.starts.iter().map(&mut value).collect()
    }

    fn states(&mut self, time: &Rational, bits: u32) -> Result<Vec<Ball>, String> {
        let states = self.trajectory.enclosed(time, bits);
        states.map_err(|e| e.to_string())
    }

    /// The time less the magnitude of the integral of a sign: zero until the sign changes, and then
    /// twice what has passed since, as long as it does not change back.
    fn since(&self, time: &Rational, states: &[Ball], until: usize) -> Ball {
        let state = &states[until];
        Ball::rational(state.prec(), time) - state.abs()
    }

    /// The end of the motion, if it comes before a time.
    fn passed(&mut self, time: &Rational, states: &[Ball], bits: u32) -> Result<Passed, String> {
        let Some(until) = self.until else {
            return Ok(Passed::Not);
        };
        let since = self.since(time, states, until);
        if !since.is_positive() {
            return Ok(match self.is_none(&since) {
                true => Passed::Not,
                false => Passed::Open,
            });
        }
        let switches = self.trajectory.switches();
        let exactly = |x: &Float| x.to_rational().unwrap_or_default();
        for (k, (at, states)) in switches.iter().enumerate() {
            let next = switches.get(k + 1).map(|s| exactly(&s.0.lower()));
            let next = next
                .filter(|next| next < time)
                .unwrap_or_else(|| time.clone());
            let between = (exactly(&at.upper()) + next) / 2u32;
            let there = self.states(&between, bits)?;
            if self.since(&between, &there, until).is_positive() {
                return Ok(Passed::End(at.clone(), states.clone()));
            }
        }
        Ok(Passed::Open)
    }

    /// Returns true for what is proved to be smaller than `10^−digits`.
    fn is_none(&self, value: &Ball) -> bool {
        let least = Rational::from((1, Integer::u_pow_u(10, self.digits).complete()));
        value.contains_zero() && value.magnitude() < Ball::rational(64, &least).mignitude()
    }

    fn decimal(&self, value: &Ball) -> Option<String> {
        match self.is_none(value) {
            true => Some("0".into()),
            false => value.to_decimal(self.digits as usize),
        }
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
        let names = self.declared();
        let parse = |text: &str| read(text, &names);
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

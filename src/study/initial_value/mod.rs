//! Studies of initial value problems: the last input is the time, the states are outputs.
//!
//! The reference encloses the solution of `y′ = f(t, y, x)`, `y(t_0) = y_0(x)` with inputs x, see
//! [`Trajectory`](mechaudit_symbolic::evaluation::Trajectory). Other outputs are expressions of the
//! states, evaluated in balls about them.

mod conditions;
pub(super) mod read;
mod times;
mod trajectories;

pub use times::{TimesError, times};

use super::compiled::graph_with_system;
use super::error::StudyError;
use super::problem::{Problem, intern};
use crate::reference::elementary::NoValue;
use crate::reference::{Ball, Mag};
use mechaudit_symbolic::evaluation::{
    Answer, Balls, Certified, Evaluator, Goal, InitialValueProblem, Limits, MotionError,
    ProblemError, State, Stop, Undecided, Value,
};
use mechaudit_symbolic::graph::{Graph, Id};
use mechaudit_symbolic::{Definitions, Expr};
use rug::Rational;
use std::sync::Arc;
use trajectories::Trajectories;

/// An initial value problem; its time is the last input of the study.
#[derive(Clone, Debug)]
pub struct InitialValue {
    /// The time of the start.
    pub start: Rational,
    /// The states in the order of the file.
    pub states: Vec<State>,
    /// The times of a whole trajectory, which is one answer with a row for each; none where the
    /// time is an input.
    pub times: Vec<Rational>,
}

/// Times that the working precision is raised for an output that cancels.
const RAISED: u32 = 5;

/// An initial value problem made ready to be solved.
pub(super) struct Solution {
    start: Rational,
    trajectories: Trajectories,
    graph: Arc<Graph>,
    /// Nodes of the outputs, over inputs, time and states; a state is its own.
    outputs: Vec<Output>,
    conditions: Option<conditions::Conditions>,
    limits: Limits,
    at_start: AtStart,
}

/// Starts, rates and outputs at the start, as expressions of the inputs.
struct AtStart {
    graph: Arc<Graph>,
    nodes: Vec<(String, Id)>,
    outputs: Vec<Id>,
}

/// An output.
enum Output {
    /// The state of that number.
    State(usize),
    /// An expression.
    Expression(Id),
}

/// The names of inputs, time and states.
fn names(problem: &Problem, of: &InitialValue) -> Vec<String> {
    let inputs = problem.inputs.iter().map(|i| i.name.clone());
    inputs
        .chain(of.states.iter().map(|s| s.name.clone()))
        .collect()
}

/// The start of the time as an expression.
fn number(q: &Rational) -> Expr {
    let whole = |z: &rug::Integer| match *z < 0 {
        true => Expr::Neg(Box::new(Expr::Num(rug::Integer::from(-z).to_string()))),
        false => Expr::Num(z.to_string()),
    };
    Expr::Div(Box::new(whole(q.numer())), Box::new(whole(q.denom())))
}

impl Solution {
    /// Prepares the problem of a study.
    ///
    /// # Errors
    /// Formulas without meaning, starts that depend on states, rates that are undefined at the
    /// start.
    pub fn new(problem: &Problem, of: &InitialValue) -> Result<Solution, StudyError> {
        let definitions = &problem.definitions;
        let graph = Graph::new(names(problem, of)).of_real_functions();
        let mut graph = graph_with_system(graph, problem)?;
        let build = |graph: &mut Graph, part: &str, name: &str, e: &Expr| {
            let built = graph.build(definitions, e);
            built.map_err(|error| StudyError::new(format!("{part}{name}: {error}")))
        };
        let start = graph.number(of.start.clone());
        let mut nodes = Vec::new();
        for state in &of.states {
            let first = build(&mut graph, "the start of ", &state.name, &state.start)?;
            let rate = build(&mut graph, "the rate of ", &state.name, &state.rate)?;
            nodes.push((first, rate));
        }
        let mut outputs = Vec::new();
        for output in &problem.outputs {
            let state = of
                .states
                .iter()
                .position(|s| output.is == Expr::Sym(s.name.clone()));
            outputs.push(match state {
                Some(k) => Output::State(k),
                None => {
                    let id = build(&mut graph, "", &output.name, &output.is)?;
                    if graph.is_complex(id) || graph.is_condition(id) {
                        let reason = format!("the output {} is not a real number", output.name);
                        return Err(StudyError::new(reason));
                    }
                    Output::Expression(id)
                }
            });
        }
        let fault = |e: ProblemError| StudyError::new(e.to_string());
        let conditions = conditions::Conditions::new(problem, &mut graph, &outputs, &nodes);
        let limits = Limits::default();
        let posed = InitialValueProblem::of_graph(graph.clone(), start, &nodes).map_err(fault)?;
        let solution = Solution {
            start: of.start.clone(),
            trajectories: Trajectories::new(posed, limits),
            graph: Arc::new(graph),
            outputs,
            conditions,
            limits,
            at_start: AtStart::new(problem, of)?,
        };
        // Without inputs the file decides.
        if problem.inputs.len() == 1
            && let Some((part, why)) = solution.at_start.undefined(&[])
        {
            return Err(StudyError::new(format!("{part} is undefined: {why}")));
        }
        Ok(solution)
    }

    /// Sets the highest working precision in bits.
    pub fn set_limit(&mut self, bits: u32) {
        self.limits.bits = bits;
        self.trajectories.set_limit(bits);
    }

    /// The reason why a time is none of the motion.
    pub fn refusal(&self, time: f64) -> Option<String> {
        let start = crate::reference::nearest_f64(&self.start);
        (time < start).then(|| format!("the time {time} comes before the start {start}"))
    }

    /// Returns true if the time, the last input, comes before the start.
    pub fn is_before_start(&self, inputs: &[Rational]) -> bool {
        inputs.last().is_some_and(|time| *time < self.start)
    }

    /// The values of all outputs; the time is the last input.
    pub fn values(&self, inputs: &[Rational], goal: Goal) -> Vec<Answer> {
        let Some((time, inputs)) = inputs.split_last() else {
            return Vec::new();
        };
        if *time < self.start {
            let undefined = Answer::Undefined {
                reason: "a time before the start",
                place: time.to_string(),
            };
            return vec![undefined; self.outputs.len()];
        }
        // No enclosure tells a start that is zero from others.
        if *time == self.start {
            let mut certified = Certified::new(self.at_start.graph.clone(), self.limits.bits);
            return certified.values(inputs, &self.at_start.outputs, goal);
        }
        let states = match self.trajectories.at(inputs, time, goal) {
            Ok(states) => states,
            Err(e) => return vec![self.without(inputs, &e); self.outputs.len()],
        };
        let answer = |output: &Output| match output {
            Output::State(k) => self.number(&states[*k], goal, || self.name(*k)),
            Output::Expression(id) => self.expression(*id, inputs, time, &states, goal),
        };
        self.outputs.iter().map(answer).collect()
    }

    /// The name of a state.
    fn name(&self, k: usize) -> String {
        let leaves = self.graph.inputs();
        leaves[leaves.len() - self.trajectories.states() + k].clone()
    }

    /// The answer that a ball is.
    fn number(&self, ball: &Ball, goal: Goal, place: impl FnOnce() -> String) -> Answer {
        match ball {
            ball if ball.is_zero() => Answer::Zero,
            ball if meets(ball, goal) => Answer::Number(ball.clone()),
            ball => Answer::Undecided(Undecided {
                reason: "an enclosure that is not narrow enough",
                place: place(),
                bits: self.limits.bits.min(ball.prec()),
            }),
        }
    }

    /// The value of an expression of the states, which are enclosed the closer the more it cancels.
    fn expression(
        &self,
        id: Id,
        inputs: &[Rational],
        time: &Rational,
        states: &[Ball],
        goal: Goal,
    ) -> Answer {
        let place = || self.graph.text(id);
        let mut bits = match goal {
            Goal::Nearest => 64,
            Goal::Bits(bits) | Goal::Double(bits) => bits,
        };
        let mut states = states.to_vec();
        let mut last = None;
        for _ in 0..=RAISED {
            let mut evaluator = Evaluator::new(self.graph.clone(), Balls::new(bits + 64));
            self.set(&mut evaluator, inputs, time, &states, bits + 64);
            match evaluator.value(id) {
                Ok(value) => match value.real() {
                    Some(ball) if ball.is_zero() => return Answer::Zero,
                    Some(ball) if meets(ball, goal) => return Answer::Number(ball.clone()),
                    Some(ball) => {
                        last = Some(("a value that is not accurate enough", place(), ball.prec()))
                    }
                    None => {
                        last = Some((
                            "a value that is no real number of usual size",
                            place(),
                            bits,
                        ))
                    }
                },
                Err(Stop {
                    node,
                    reason: NoValue::Undefined(reason),
                }) => {
                    let place = self.graph.text(node);
                    return Answer::Undefined { reason, place };
                }
                Err(Stop { node, .. }) => {
                    last = Some((
                        "undecided between the ends of an enclosure",
                        self.graph.text(node),
                        bits,
                    ));
                }
            }
            bits = bits.saturating_mul(2);
            if bits > self.limits.bits {
                break;
            }
            states = match self.trajectories.at(inputs, time, Goal::Bits(bits)) {
                Ok(states) => states,
                Err(e) => return self.without(inputs, &e),
            };
        }
        let (reason, place, bits) =
            last.unwrap_or(("an enclosure that is not narrow enough", place(), bits));
        Answer::Undecided(Undecided {
            reason,
            place,
            bits,
        })
    }

    /// Gives the leaves of the graph their values.
    fn set(
        &self,
        evaluator: &mut Evaluator<Balls>,
        inputs: &[Rational],
        time: &Rational,
        states: &[Ball],
        bits: u32,
    ) {
        let exact = inputs.iter().chain([time]).map(|x| Ball::rational(bits, x));
        let all = exact.chain(states.iter().cloned());
        for (k, ball) in all.enumerate() {
            evaluator.set_input(k, Value::Real(ball));
        }
    }

    /// The answer where the motion has no certified value.
    fn without(&self, inputs: &[Rational], e: &MotionError) -> Answer {
        if let MotionError::Start { .. } | MotionError::Rate { .. } = e
            && let Some((part, why)) = self.at_start.undefined(inputs)
        {
            let reason = intern(&why);
            return Answer::Undefined {
                reason,
                place: part,
            };
        }
        Answer::Undecided(Undecided {
            reason: intern(&e.to_string()),
            place: self.name(0),
            bits: self.limits.bits,
        })
    }

    /// `Σ_j |x_j ∂f_i/∂x_j|` for each output, over the inputs, the time and the starts of the
    /// states.
    pub fn conditions(&self, inputs: &[Rational]) -> Option<Vec<f64>> {
        let (time, inputs) = inputs.split_last()?;
        self.conditions.as_ref()?.values(self, inputs, time)
    }
}

/// Returns true if a ball is as narrow as the goal asks for.
fn meets(ball: &Ball, goal: Goal) -> bool {
    if !ball.is_finite() {
        return false;
    }
    match goal {
        Goal::Nearest => ball.accuracy_bits() >= 55,
        Goal::Bits(bits) => ball.accuracy_bits() >= i64::from(bits),
        Goal::Double(bits) => {
            ball.accuracy_bits() >= i64::from(bits)
                || ball.rad() <= Mag::power_of_two(-1074 - i64::from(bits))
        }
    }
}

impl AtStart {
    fn new(problem: &Problem, of: &InitialValue) -> Result<AtStart, StudyError> {
        let mut definitions: Definitions = problem.definitions.clone();
        let mut inputs: Vec<String> = problem.inputs.iter().map(|i| i.name.clone()).collect();
        if let Some(time) = inputs.pop() {
            definitions.set(&time, number(&of.start));
        }
        for state in &of.states {
            definitions.set(&state.name, state.start.clone());
        }
        let graph = Graph::new(inputs).of_real_functions();
        let mut graph = graph_with_system(graph, problem)?;
        let mut nodes = Vec::new();
        for state in &of.states {
            for (part, e) in [("the start", &state.start), ("the rate", &state.rate)] {
                let built = graph.build(&definitions, e);
                let id =
                    built.map_err(|e| StudyError::new(format!("{part} of {}: {e}", state.name)))?;
                let at = if part == "the rate" {
                    " at the start"
                } else {
                    ""
                };
                nodes.push((format!("{part} of {}{at}", state.name), id));
            }
        }
        let mut outputs = Vec::new();
        for output in &problem.outputs {
            let built = graph.build(&definitions, &output.is);
            outputs.push(built.map_err(|e| StudyError::new(format!("{}: {e}", output.name)))?);
        }
        let graph = Arc::new(graph);
        Ok(AtStart {
            graph,
            nodes,
            outputs,
        })
    }

    /// The first part that is proved to be undefined, and why it is.
    fn undefined(&self, inputs: &[Rational]) -> Option<(String, String)> {
        /// Bits at which a part that is neither is left alone.
        const BITS: u32 = 1024;
        let mut certified = Certified::new(self.graph.clone(), BITS);
        self.nodes.iter().find_map(|(part, id)| {
            match certified.values(inputs, &[*id], Goal::Double(24)).pop()? {
                Answer::Undefined { reason, place } => {
                    Some((part.clone(), format!("{reason}: {place}")))
                }
                _ => None,
            }
        })
    }
}

#[cfg(test)]
mod tests;

//! The statement of an initial value problem.

use super::{Limits, MotionError, Trajectory};
use crate::evaluation::taylor::Switch;
use crate::graph::{Graph, Id, Node};
use crate::{Definitions, Expr, SymbolicError};
use rug::Rational;
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// A state: its value at the start and its rate.
#[derive(Clone, Debug)]
pub struct State {
    /// The name, by which rates refer to it.
    pub name: String,
    /// The value at the start, an expression of the inputs.
    pub start: Expr,
    /// The derivative by the time, an expression of the inputs, the time and all states.
    pub rate: Expr,
}

impl State {
    /// Creates a state.
    pub fn new(name: impl Into<String>, start: Expr, rate: Expr) -> State {
        let name = name.into();
        State { name, start, rate }
    }
}

/// Reason why an initial value problem is none.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ProblemError {
    /// There is nothing to solve for.
    #[error("an initial value problem has at least one state")]
    NoState,
    /// Two inputs, states or the time have the same name.
    #[error("{0} is declared twice")]
    Twice(String),
    /// A start depends on the time or on a state.
    #[error("the start of {name} depends on {on}, which has no value before the start")]
    Start {
        /// The state, or the time.
        name: String,
        /// The name that it depends on.
        on: String,
    },
    /// A start or a rate is complex or a condition.
    #[error("the {part} of {name} is not a real number")]
    NotReal {
        /// `start` or `rate`.
        part: &'static str,
        /// The state, or the time.
        name: String,
    },
    /// An expression has no meaning.
    #[error("the {part} of {name}: {error}")]
    Expression {
        /// `start` or `rate`.
        part: &'static str,
        /// The state, or the time.
        name: String,
        /// Why.
        error: SymbolicError,
    },
}

/// The initial value problem `y′ = f(t, y, p)`, `y(t_0) = y_0(p)` with inputs p.
#[derive(Clone, Debug)]
pub struct InitialValueProblem {
    pub(super) graph: Arc<Graph>,
    pub(super) inputs: usize,
    pub(super) time: String,
    pub(super) start: Id,
    pub(super) states: Vec<String>,
    pub(super) starts: Vec<Id>,
    pub(super) rates: Vec<Id>,
    /// Derivatives of rates by states that are not zero: the rate, the state and the node.
    pub(super) jacobian: Vec<(usize, usize, Id)>,
    /// The switches of the rates, and the rates of the values that change their signs there.
    pub(super) switches: Vec<(Switch, Option<Id>)>,
    /// Switches that are guarded, although the rates do not need them.
    pub(super) margins: Vec<Switch>,
    /// Nodes whose values are asked for along the motion.
    pub(super) quantities: Vec<Id>,
    /// The derivatives that are carried along.
    pub(super) variation: Option<Variation>,
    /// The problem that carries derivatives along, once it is asked for.
    varied: Arc<OnceLock<Result<InitialValueProblem, ProblemError>>>,
}

/// Derivatives of states and inputs by their values at the start. Inputs are further states, which
/// rest.
#[derive(Clone, Debug)]
pub(super) struct Variation {
    /// The derivatives at the start, row by row.
    pub start: Vec<Id>,
    /// For each switch, the derivatives by states and inputs of the value that changes its sign.
    pub gradients: HashMap<Switch, Vec<Id>>,
}

impl InitialValueProblem {
    /// States a problem by expressions. `inputs` are the names of the parameters p, `time` is the
    /// name of t and `start` the expression of t_0.
    ///
    /// # Errors
    /// See [`ProblemError`].
    pub fn new(
        definitions: &Definitions,
        inputs: &[&str],
        time: &str,
        start: &Expr,
        states: &[State],
    ) -> Result<InitialValueProblem, ProblemError> {
        let names = inputs.iter().copied().chain([time]);
        let names = names.chain(states.iter().map(|s| s.name.as_str()));
        let mut graph = Graph::new(names.map(String::from)).of_real_functions();
        let mut build = |part: &'static str, name: &str, e: &Expr| {
            let built = graph.build(definitions, e);
            built.map_err(|error| ProblemError::Expression {
                part,
                name: name.into(),
                error,
            })
        };
        let start = build("start", time, start)?;
        let mut nodes = Vec::new();
        for state in states {
            let first = build("start", &state.name, &state.start)?;
            let rate = build("rate", &state.name, &state.rate)?;
            nodes.push((first, rate));
        }
        InitialValueProblem::of_graph(graph, start, &nodes)
    }

    /// States a problem by the nodes of a graph, whose inputs are the parameters, the time and as
    /// many states as there are pairs of a start and a rate.
    ///
    /// # Errors
    /// See [`ProblemError`].
    ///
    /// # Panics
    /// If the graph has fewer inputs than the time and the states.
    pub fn of_graph(
        mut graph: Graph,
        start: Id,
        states: &[(Id, Id)],
    ) -> Result<InitialValueProblem, ProblemError> {
        if states.is_empty() {
            return Err(ProblemError::NoState);
        }
        let names = graph.inputs().to_vec();
        let inputs = names.len() - states.len() - 1;
        if let Some(k) = (1..names.len()).find(|k| names[..*k].contains(&names[*k])) {
            return Err(ProblemError::Twice(names[k].clone()));
        }
        let (time, own) = (names[inputs].clone(), &names[inputs + 1..]);
        let firsts = [(&time, start)].into_iter();
        let firsts: Vec<(&String, Id)> = firsts
            .chain(own.iter().zip(states.iter().map(|s| s.0)))
            .collect();
        for (name, id) in &firsts {
            let reached = graph.reach(*id);
            let on = reached.iter().find_map(|id| match graph.node(*id) {
                Node::Input(k) if k as usize >= inputs => Some(names[k as usize].clone()),
                _ => None,
            });
            if let Some(on) = on {
                let name = name.to_string();
                return Err(ProblemError::Start { name, on });
            }
        }
        let rates = own.iter().zip(states.iter().map(|s| s.1));
        let all = firsts.iter().map(|(name, id)| ("start", *name, *id));
        for (part, name, id) in all.chain(rates.map(|(name, id)| ("rate", name, id))) {
            if graph.is_complex(id) || graph.is_condition(id) {
                let name = name.clone();
                return Err(ProblemError::NotReal { part, name });
            }
        }
        let own = own.to_vec();
        let mut jacobian = Vec::new();
        for (row, (name, (_, rate))) in own.iter().zip(states).enumerate() {
            for column in 0..states.len() {
                let by = graph.input(inputs + 1 + column);
                let slope = graph.derivative(*rate, by);
                let slope = slope.map_err(|error| ProblemError::Expression {
                    part: "rate",
                    name: name.clone(),
                    error,
                })?;
                let is_zero =
                    matches!(graph.node(slope), Node::Number(k) if *graph.rational(k) == 0);
                if !is_zero {
                    jacobian.push((row, column, slope));
                }
            }
        }
        let rates: Vec<Id> = states.iter().map(|s| s.1).collect();
        let switches = Switch::all(&graph, &rates).into_iter().map(|switch| {
            let value = value_of_switch(&mut graph, switch);
            (
                switch,
                rate_of_value(&mut graph, value, inputs, &rates).ok(),
            )
        });
        let switches = switches.collect();
        Ok(InitialValueProblem {
            switches,
            margins: Vec::new(),
            quantities: Vec::new(),
            inputs,
            time,
            start,
            states: own,
            jacobian,
            starts: states.iter().map(|s| s.0).collect(),
            rates,
            graph: Arc::new(graph),
            variation: None,
            varied: Arc::default(),
        })
    }

    /// The problem of the states and the inputs, with their derivatives by the starts of the states
    /// and by the inputs.
    pub(super) fn with_variation(&self) -> Result<&InitialValueProblem, ProblemError> {
        let varied = self.varied.get_or_init(|| self.varied());
        varied.as_ref().map_err(Clone::clone)
    }

    fn varied(&self) -> Result<InitialValueProblem, ProblemError> {
        let mut graph = Graph::clone(&self.graph);
        let n = self.states.len();
        let [zero, one] = [0, 1].map(|k| graph.number(k));
        let inputs: Vec<Id> = (0..self.inputs).map(|k| graph.input(k)).collect();
        for name in self.inputs() {
            graph.add_input(format!("{name} as a state"));
        }
        let fault = |k: usize| {
            let (part, name) = ("start", self.states[k].clone());
            move |error| ProblemError::Expression { part, name, error }
        };
        let mut start = Vec::new();
        for k in 0..n {
            start.extend((0..n).map(|j| if j == k { one } else { zero }));
            for input in &inputs {
                let slope = graph.derivative(self.starts[k], *input);
                start.push(slope.map_err(fault(k))?);
            }
        }
        let size = n + self.inputs;
        start
            .extend((n * size..size * size).map(|k| if k % size == k / size { one } else { zero }));
        let states = self.starts.iter().copied().zip(self.rates.iter().copied());
        let rest = inputs.iter().map(|input| (*input, zero));
        let states: Vec<(Id, Id)> = states.chain(rest).collect();
        let problem = InitialValueProblem::of_graph(graph, self.start, &states)?;
        problem.by_inputs(start)
    }

    /// The problem with quantities, nodes of its graph, for [`Trajectory::quantities`]. What jumps
    /// in a quantity at a switch has to be a linear function of what jumps in the rates there.
    #[must_use]
    pub fn with_quantities(mut self, quantities: Vec<Id>) -> InitialValueProblem {
        self.quantities = quantities;
        self
    }

    /// The problem with guards of some switches, and of those that these depend on, whether its
    /// rates need them or not.
    pub(super) fn guarded(mut self, switches: Vec<Switch>) -> InitialValueProblem {
        let graph = Arc::make_mut(&mut self.graph);
        let values = switches
            .iter()
            .map(|switch| value_of_switch(graph, *switch));
        let values: Vec<Id> = values.collect();
        let inner = Switch::all(graph, &values);
        self.margins = switches.into_iter().chain(inner).collect();
        for switch in &self.margins {
            if self.switches.iter().all(|known| known.0 != *switch) {
                let value = value_of_switch(graph, *switch);
                let rate = rate_of_value(graph, value, self.inputs, &self.rates);
                self.switches.push((*switch, rate.ok()));
            }
        }
        self
    }

    /// The problem, whose last states are the inputs, with derivatives that are carried along:
    /// those by the inputs are in the Jacobian as those by these states.
    pub(super) fn by_inputs(mut self, start: Vec<Id>) -> Result<InitialValueProblem, ProblemError> {
        let graph = Arc::make_mut(&mut self.graph);
        let n = self.states.len() - self.inputs;
        let inputs: Vec<Id> = (0..self.inputs).map(|k| graph.input(k)).collect();
        let own: Vec<Id> = (0..n).map(|k| graph.input(self.inputs + 1 + k)).collect();
        let zero = graph.number(0);
        for k in 0..n {
            for (j, input) in inputs.iter().enumerate() {
                let slope = graph.derivative(self.rates[k], *input);
                let slope = slope.map_err(|error| ProblemError::Expression {
                    part: "rate",
                    name: self.states[k].clone(),
                    error,
                })?;
                if slope != zero {
                    self.jacobian.push((k, n + j, slope));
                }
            }
        }
        let gradients = self.switches.iter().filter_map(|(switch, _)| {
            let value = value_of_switch(graph, *switch);
            let by = own.iter().chain(&inputs);
            let found: Result<Vec<Id>, _> = by.map(|by| graph.derivative(value, *by)).collect();
            Some((*switch, found.ok()?))
        });
        let gradients = gradients.collect();
        self.variation = Some(Variation { start, gradients });
        Ok(self)
    }

    /// The names of the inputs.
    pub fn inputs(&self) -> &[String] {
        &self.graph.inputs()[..self.inputs]
    }

    /// The name of the time.
    pub fn time(&self) -> &str {
        &self.time
    }

    /// The names of the states.
    pub fn states(&self) -> &[String] {
        &self.states
    }

    /// The graph of the problem, whose inputs are the inputs, the time and the states.
    pub fn graph(&self) -> &Arc<Graph> {
        &self.graph
    }

    /// The solution for some values of the inputs.
    ///
    /// # Errors
    /// A start without a value, a start of the time that is not rational.
    ///
    /// # Panics
    /// If there are more or fewer values than inputs.
    pub fn trajectory(
        &self,
        inputs: &[Rational],
        limits: Limits,
    ) -> Result<Trajectory, MotionError> {
        Trajectory::new(self, inputs, limits)
    }
}

/// The derivative of a node by the time, along a motion with some rates.
pub(super) fn rate_of_value(
    graph: &mut Graph,
    value: Id,
    inputs: usize,
    rates: &[Id],
) -> Result<Id, SymbolicError> {
    let one = graph.number(1);
    let mut path = vec![(graph.input(inputs), one)];
    for (k, rate) in rates.iter().enumerate() {
        path.push((graph.input(inputs + 1 + k), *rate));
    }
    graph.derivative_along(value, &path)
}

/// The value whose sign, or whose integer part, decides a switch.
pub(super) fn value_of_switch(graph: &mut Graph, switch: Switch) -> Id {
    match switch.parts() {
        (a, Some(b)) => graph.difference(a, b),
        (a, None) => a,
    }
}

//! Values of graphs.
//!
//! An [`Evaluator`] goes through a [`Graph`] once; what the operations mean is an
//! [`Interpretation`]: balls at a precision ([`Balls`]), floating-point numbers ([`Floating`]).
//! Only what a value needs is evaluated: of a choice the part that is chosen, of a conjunction the
//! second condition where the first holds.

mod adaptive;
mod angle;
mod ball;
mod complex;
mod cost;
mod float;
mod germ;
mod huge;
mod initial_value;
mod integral;
mod mirror;
mod oscillation;
mod real;
mod root;
mod short;
mod sum;
mod system;
mod taylor;
#[cfg(test)]
mod tests;
mod tuning;

pub use adaptive::{Algebraic, Answer, Certified, Goal, LIMIT, Undecided};
pub use ball::{Balls, Value};
pub use float::{Elementary, FloatValue, Floating, Format};
pub use initial_value::{
    Derivatives, InitialValueProblem, Limits, MotionError, ProblemError, State, Trajectory,
};

use crate::graph::{Binding, Graph, Id, Node};
use crate::{Constant, Func, Relation};
use mechaudit_reference::elementary::NoValue;
use std::collections::HashSet;
use std::sync::Arc;

/// Reason why a node has no value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stop {
    /// Where.
    pub node: Id,
    /// Why.
    pub reason: NoValue,
}

/// The meaning of the operations of a graph.
pub trait Interpretation: Sized {
    /// The values of numbers.
    type V: Clone;
    /// Prepares the operation of a node, and counts its work.
    fn at(&mut self, _id: Id, _node: Node) -> Result<(), NoValue> {
        Ok(())
    }
    /// A number of the graph's table.
    fn number(&mut self, graph: &Graph, place: u32) -> Result<Self::V, NoValue>;
    /// A small integer.
    fn integer(&mut self, n: i64) -> Self::V;
    /// A named constant.
    fn constant(&mut self, c: Constant) -> Result<Self::V, NoValue>;
    /// The imaginary unit.
    fn imaginary_unit(&mut self) -> Result<Self::V, NoValue>;
    /// Infinity, where it is compared.
    fn infinity(&mut self) -> Result<Self::V, NoValue>;
    /// `−a`.
    fn neg(&mut self, a: &Self::V) -> Result<Self::V, NoValue>;
    /// `a + b`.
    fn add(&mut self, a: &Self::V, b: &Self::V) -> Result<Self::V, NoValue>;
    /// `a − b`.
    fn sub(&mut self, a: &Self::V, b: &Self::V) -> Result<Self::V, NoValue>;
    /// `a b`.
    fn mul(&mut self, a: &Self::V, b: &Self::V) -> Result<Self::V, NoValue>;
    /// `a / b`.
    fn div(&mut self, a: &Self::V, b: &Self::V) -> Result<Self::V, NoValue>;
    /// An integer power.
    fn power(&mut self, a: &Self::V, k: i32) -> Result<Self::V, NoValue>;
    /// A function.
    fn call(&mut self, f: Func, x: &[&Self::V]) -> Result<Self::V, NoValue>;
    /// `1/f(x)`, where that is more than the inverse of what is known of `f(x)`.
    fn inverse(&mut self, _: Func, _: &Self::V) -> Option<Self::V> {
        None
    }
    /// Zero where a step function is constant.
    fn flat(&mut self, f: Func, x: &Self::V) -> Result<Self::V, NoValue>;
    /// A comparison.
    fn compare(&mut self, relation: Relation, a: &Self::V, b: &Self::V) -> Result<bool, NoValue>;
    /// True if a comparison that is not decided has both outcomes: within an interval.
    fn has_both(&self) -> bool {
        false
    }
    /// Holds both values of a choice.
    fn union(&self, _: &Self::V, _: &Self::V) -> Result<Self::V, NoValue> {
        Err(NoValue::Undecided(ball::MAY_BE_EQUAL))
    }
    /// The integer that a value certainly is.
    fn to_integer(&self, a: &Self::V) -> Option<i64>;
    /// An integral, a root, or a sum to infinity, whose limits have values.
    fn bound(evaluator: &mut Evaluator<Self>, binder: u32) -> Result<Self::V, Stop>;
    /// The unknowns of a system of equations, which `node` is one of; by default they have none.
    fn system(_: &mut Evaluator<Self>, _: u32, node: Id) -> Result<Vec<Self::V>, Stop> {
        let reason = NoValue::Undefined("a system of equations in floating point");
        Err(Stop { node, reason })
    }
}

/// The truth of a condition; none where it holds at some of the points that are meant at once and
/// may fail at others.
type Truth = Option<bool>;

/// Values of the nodes of a graph for one interpretation and one set of inputs.
pub struct Evaluator<I: Interpretation> {
    graph: Arc<Graph>,
    /// The meaning of the operations.
    pub interpretation: I,
    known: Vec<Option<I::V>>,
    truths: Vec<Option<Truth>>,
    /// For each root, the nodes that it needs in any case.
    orders: Vec<Option<Arc<[Id]>>>,
    /// The nodes of the inputs.
    inputs: Vec<Option<Id>>,
    /// Nodes that depend on inputs or variables, of those that have had values.
    varying: Vec<Id>,
    /// The nodes among them.
    is_varying: Vec<bool>,
    /// Rounds of loops and terms of sums that are left.
    pub rounds: u64,
    /// Evaluations of integrands that are left, those of integrals within integrals among them.
    evaluations: u64,
}

/// The nodes of a graph's inputs.
fn input_nodes(graph: &Graph) -> Vec<Option<Id>> {
    let all = 0..graph.inputs().len() as u32;
    all.map(|k| graph.find(Node::Input(k))).collect()
}

const NOT_A_NUMBER: NoValue = NoValue::Undefined("a condition or a name without a value");

/// Rounds of loops and terms of sums that one evaluation may take.
pub const ROUNDS: u64 = 20_000;

/// Evaluations of all integrands of a value together: some ten seconds. Integrals within integrals
/// multiply.
const ALL_EVALUATIONS: u64 = 1 << 20;

/// A part of a choice that may be needed at none of the points may be undefined there.
fn undecided(stop: Stop) -> Stop {
    let reason = match stop.reason {
        NoValue::Undefined(_) => NoValue::Undecided(ball::MAY_BE_EQUAL),
        reason => reason,
    };
    Stop { reason, ..stop }
}

/// Reason of an integral that takes more evaluations than are allowed.
const EVALUATIONS_REASON: &str = "the limit on evaluations of an integrand";

/// Reason of a value that takes more of them.
const ROUNDS_REASON: &str = "the limit on rounds of loops and terms of sums";

impl<I: Interpretation> Evaluator<I> {
    /// Creates an evaluator without inputs.
    pub fn new(graph: Arc<Graph>, interpretation: I) -> Evaluator<I> {
        Evaluator {
            known: vec![None; graph.len()],
            truths: vec![None; graph.len()],
            interpretation,
            orders: vec![None; graph.len()],
            inputs: input_nodes(&graph),
            varying: Vec::new(),
            is_varying: vec![false; graph.len()],
            rounds: ROUNDS,
            evaluations: ALL_EVALUATIONS,
            graph,
        }
    }

    /// The graph.
    pub fn graph(&self) -> &Arc<Graph> {
        &self.graph
    }

    /// Adds nodes to the graph; values that are known are kept.
    pub fn extend<T>(&mut self, add: impl FnOnce(&mut Graph) -> T) -> T {
        let found = add(Arc::make_mut(&mut self.graph));
        let graph = &self.graph;
        self.known.resize(graph.len(), None);
        self.truths.resize(graph.len(), None);
        self.orders.resize(graph.len(), None);
        self.is_varying.resize(graph.len(), false);
        self.inputs = input_nodes(graph);
        found
    }

    /// Keeps a node in mind that is to be forgotten when inputs or variables change.
    fn note(&mut self, id: Id) {
        let place = id as usize;
        if !self.is_varying[place] && self.graph.varies(id) {
            self.is_varying[place] = true;
            self.varying.push(id);
        }
    }

    /// Forgets what depends on inputs and variables; everything if `constants` as well.
    pub fn reset(&mut self, constants: bool) {
        match constants {
            true => {
                self.known.fill(None);
                self.truths.fill(None);
            }
            false => {
                for id in &self.varying {
                    self.known[*id as usize] = None;
                    self.truths[*id as usize] = None;
                }
            }
        }
        self.begin();
    }

    /// Gives the next value the whole of what one evaluation may take.
    pub fn begin(&mut self) {
        self.rounds = ROUNDS;
        self.evaluations = ALL_EVALUATIONS;
    }

    /// Gives an input a value. What depends on it has to be forgotten before.
    pub fn set_input(&mut self, k: usize, value: I::V) {
        if let Some(id) = self.inputs.get(k).copied().flatten() {
            self.set(id, value);
        }
    }

    /// Gives a node a value.
    fn set(&mut self, id: Id, value: I::V) {
        self.note(id);
        self.known[id as usize] = Some(value);
    }

    /// Gives a comparison of two numbers that are equal its truth.
    fn set_equal(&mut self, id: Id) {
        if let Node::Compare(relation, ..) = self.graph.node(id) {
            let holds = matches!(
                relation,
                Relation::LessEqual | Relation::Equal | Relation::GreaterEqual
            );
            self.note(id);
            self.truths[id as usize] = Some(Some(holds));
        }
    }

    /// Gives the variables of a binder values and forgets what depends on the old ones.
    pub fn set_variables(&mut self, binder: u32, values: impl IntoIterator<Item = I::V>) {
        for id in &self.graph.binder(binder).members {
            self.known[*id as usize] = None;
            self.truths[*id as usize] = None;
        }
        for (k, value) in values.into_iter().enumerate() {
            if let Some(id) = self.graph.find(Node::Variable(binder, k as u32)) {
                self.set(id, value);
            }
        }
    }

    /// The value of a node.
    ///
    /// # Errors
    /// The first node without a value, and why it has none.
    pub fn value(&mut self, id: Id) -> Result<&I::V, Stop> {
        if self.known[id as usize].is_none() {
            self.run(id)?;
        }
        self.known[id as usize].as_ref().ok_or(Stop {
            node: id,
            reason: NOT_A_NUMBER,
        })
    }

    /// Returns true if a condition holds.
    ///
    /// # Errors
    /// As [`Evaluator::value`].
    pub fn holds(&mut self, id: Id) -> Result<bool, Stop> {
        let reason = NoValue::Undecided(ball::MAY_BE_EQUAL);
        self.truth(id)?.ok_or(Stop { node: id, reason })
    }

    fn truth(&mut self, id: Id) -> Result<Truth, Stop> {
        if self.truths[id as usize].is_none() {
            self.run(id)?;
        }
        self.truths[id as usize].ok_or(Stop {
            node: id,
            reason: NoValue::Undefined("a number where a condition is needed"),
        })
    }

    /// Nodes that are needed for a node in any case, in ascending order.
    fn order(&mut self, root: Id) -> Arc<[Id]> {
        if let Some(order) = &self.orders[root as usize] {
            return order.clone();
        }
        // A graph that has grown may be far larger than what one node needs.
        let mut seen = HashSet::new();
        let mut open = vec![root];
        while let Some(id) = open.pop() {
            if !seen.insert(id) {
                continue;
            }
            match self.graph.node(id) {
                Node::If(condition, ..) => open.push(condition),
                Node::And(a, _) | Node::Or(a, _) => open.push(a),
                Node::Bound(binder) => match self.graph.binder(binder).binding {
                    Binding::Sum { from, to, .. }
                    | Binding::Integral { from, to, .. }
                    | Binding::Root { from, to, .. } => {
                        let is_finite = |id: &Id| self.graph.node(*id) != Node::Infinity;
                        open.extend([from, to].into_iter().filter(is_finite));
                    }
                    _ => {}
                },
                Node::Last(binder, _) => {
                    if let Binding::Loop { first, .. } = &self.graph.binder(binder).binding {
                        open.extend(first);
                    }
                }
                node => open.extend(self.graph.operands(node)),
            }
        }
        let mut order: Vec<Id> = seen.into_iter().collect();
        order.sort_unstable();
        for id in &order {
            self.note(*id);
        }
        let order: Arc<[Id]> = order.into();
        self.orders[root as usize] = Some(order.clone());
        order
    }

    fn run(&mut self, root: Id) -> Result<(), Stop> {
        for id in self.order(root).iter() {
            let place = *id as usize;
            if self.known[place].is_none() && self.truths[place].is_none() {
                let counted = self.interpretation.at(*id, self.graph.node(*id));
                counted.map_err(|reason| Stop { node: *id, reason })?;
                self.compute(*id)?;
            }
        }
        Ok(())
    }

    /// The value of a node whose operands are known.
    fn compute(&mut self, id: Id) -> Result<(), Stop> {
        let node = self.graph.node(id);
        let stop = |reason| Stop { node: id, reason };
        // These need values that are not known yet.
        match node {
            Node::If(condition, a, b) => {
                let value = match self.truth(condition)? {
                    Some(true) => self.value(a)?.clone(),
                    Some(false) => self.value(b)?.clone(),
                    None => {
                        let both = [a, b].map(|part| self.value(part).cloned());
                        let [a, b] = both.map(|part| part.map_err(undecided));
                        self.interpretation.union(&a?, &b?).map_err(stop)?
                    }
                };
                self.known[id as usize] = Some(value);
                return Ok(());
            }
            // The second one is needed unless the first decides at all points.
            Node::And(a, b) | Node::Or(a, b) => {
                let decides = matches!(node, Node::Or(..));
                let truth = match self.truth(a)? {
                    Some(first) if first == decides => Some(decides),
                    Some(_) => self.truth(b)?,
                    None => {
                        let second = self.truth(b).map_err(undecided)?;
                        second.filter(|second| *second == decides)
                    }
                };
                self.truths[id as usize] = Some(truth);
                return Ok(());
            }
            Node::Not(a) => {
                let truth = self.truth(a)?;
                self.truths[id as usize] = Some(truth.map(|t| !t));
                return Ok(());
            }
            Node::Bound(binder) => {
                let value = self.bound(binder, id)?;
                self.known[id as usize] = Some(value);
                return Ok(());
            }
            Node::Last(binder, _) => return self.repeat(binder, id),
            _ => {}
        }
        let truth = match node {
            Node::Truth(t) => Some(Some(t)),
            Node::Compare(relation, a, b) => {
                let (known, i) = (&self.known, &mut self.interpretation);
                let number = |id: Id| known[id as usize].as_ref().ok_or(NOT_A_NUMBER);
                let found = number(a).and_then(|a| i.compare(relation, a, number(b)?));
                match found {
                    Err(NoValue::Undecided(ball::MAY_BE_EQUAL)) if i.has_both() => Some(None),
                    found => Some(Some(found.map_err(stop)?)),
                }
            }
            _ => None,
        };
        if truth.is_some() {
            self.truths[id as usize] = truth;
            return Ok(());
        }
        let inverse = match node {
            Node::Div(_, b) => self.inverse(b, 1),
            Node::Power(b, k) if k < 0 => self.inverse(b, k.unsigned_abs()),
            _ => None,
        };
        let known = &self.known;
        let get = |id: Id| known[id as usize].as_ref().ok_or(NOT_A_NUMBER);
        let i = &mut self.interpretation;
        let value = (|| match node {
            Node::Number(place) => i.number(&self.graph, place),
            Node::Constant(c) => i.constant(c),
            Node::ImaginaryUnit => i.imaginary_unit(),
            Node::Infinity => i.infinity(),
            Node::Neg(a) => i.neg(get(a)?),
            Node::Add(a, b) => i.add(get(a)?, get(b)?),
            Node::Sub(a, b) => i.sub(get(a)?, get(b)?),
            Node::Mul(a, b) => i.mul(get(a)?, get(b)?),
            Node::Div(a, b) => match inverse {
                Some(inverse) => i.mul(get(a)?, &inverse),
                None => i.div(get(a)?, get(b)?),
            },
            Node::Power(a, k) => match inverse {
                Some(inverse) => Ok(inverse),
                None => i.power(get(a)?, k),
            },
            Node::Unary(f, a) => i.call(f, &[get(a)?]),
            Node::Binary(f, a, b) => i.call(f, &[get(a)?, get(b)?]),
            Node::Ternary(f, a, b, c) => i.call(f, &[get(a)?, get(b)?, get(c)?]),
            Node::Flat(f, a) => i.flat(f, get(a)?),
            _ => Err(NoValue::Undefined("a name without a value")),
        })();
        self.known[id as usize] = Some(value.map_err(stop)?);
        Ok(())
    }

    /// The inverse of a power of a function, where the interpretation has one.
    fn inverse(&mut self, id: Id, power: u32) -> Option<I::V> {
        let (id, power) = match self.graph.node(id) {
            Node::Power(id, k) if k > 0 => (id, power.checked_mul(k.unsigned_abs())?),
            _ => (id, power),
        };
        let Node::Unary(f, x) = self.graph.node(id) else {
            return None;
        };
        let inverse = self
            .interpretation
            .inverse(f, self.known[x as usize].as_ref()?)?;
        match power {
            1 => Some(inverse),
            _ => self
                .interpretation
                .power(&inverse, power.try_into().ok()?)
                .ok(),
        }
    }

    /// Counts a round of a loop or a term of a sum.
    fn count(&mut self, node: Id) -> Result<(), Stop> {
        self.rounds = self.rounds.saturating_sub(1);
        match self.rounds {
            0 => Err(Stop {
                node,
                reason: NoValue::Undecided(ROUNDS_REASON),
            }),
            _ => Ok(()),
        }
    }

    fn bound(&mut self, binder: u32, id: Id) -> Result<I::V, Stop> {
        let Binding::Sum { from, to, body } = self.graph.binder(binder).binding else {
            return I::bound(self, binder);
        };
        if self.graph.node(to) == Node::Infinity {
            return I::bound(self, binder);
        }
        let stop = |reason| Stop { node: id, reason };
        let mut limit = |limit: Id| {
            let value = self.value(limit)?.clone();
            let integer = self.interpretation.to_integer(&value);
            integer.ok_or(stop(NoValue::Undefined(
                "a limit of a sum that is no integer",
            )))
        };
        let limits = [limit(from)?, limit(to)?];
        self.terms(binder, id, body, limits)
    }

    /// The sum of a body over the integers from one to another.
    fn terms(&mut self, binder: u32, id: Id, body: Id, limits: [i64; 2]) -> Result<I::V, Stop> {
        let [from, to] = limits;
        let stop = |reason| Stop { node: id, reason };
        let mut sum: Option<I::V> = None;
        for k in from..=to {
            self.count(id)?;
            let index = self.interpretation.integer(k);
            self.set_variables(binder, [index]);
            let term = self.value(body)?.clone();
            sum = Some(match sum {
                Some(sum) => self.interpretation.add(&sum, &term).map_err(stop)?,
                None => term,
            });
        }
        Ok(sum.unwrap_or_else(|| self.interpretation.integer(0)))
    }

    /// Runs a loop or solves a system, and gives all its last values or unknowns.
    fn repeat(&mut self, binder: u32, id: Id) -> Result<(), Stop> {
        let graph = self.graph.clone();
        let Binding::Loop {
            condition,
            first,
            next,
        } = &graph.binder(binder).binding
        else {
            let values = I::system(self, binder, id)?;
            self.set_last(binder, values);
            return Ok(());
        };
        let mut values = self.all(first)?;
        loop {
            self.set_variables(binder, values.iter().cloned());
            if !self.holds(*condition)? {
                break;
            }
            self.count(id)?;
            values = self.all(next)?;
        }
        self.set_last(binder, values);
        Ok(())
    }

    fn set_last(&mut self, binder: u32, values: Vec<I::V>) {
        for (k, value) in values.into_iter().enumerate() {
            if let Some(id) = self.graph.find(Node::Last(binder, k as u32)) {
                self.set(id, value);
            }
        }
    }

    fn all(&mut self, ids: &[Id]) -> Result<Vec<I::V>, Stop> {
        ids.iter().map(|id| self.value(*id).cloned()).collect()
    }
}

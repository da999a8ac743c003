//! Expressions with shared subexpressions.
//!
//! A [`Graph`] holds every subexpression once. [`Graph::build`] makes it of expressions by the walk
//! that all domains take; [`Graph::derivative`] adds derivatives; an
//! [`Evaluator`](crate::evaluation::Evaluator) gives its nodes values.

mod build;
mod continuation;
mod derivative;
mod identities;
mod substitute;
mod system;
mod text;

pub use system::Start;

use crate::{Constant, Func, Relation, Roots};
use rug::Rational;
use std::collections::HashMap;

/// A node of a [`Graph`]. Operands come before the nodes that use them.
pub type Id = u32;

/// A number of a binder: a sum, an integral, a root, a loop or a system, in the order of building.
pub type BinderId = u32;

/// A subexpression.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A rational number, by its place in the table of numbers.
    Number(u32),
    /// A named constant.
    Constant(Constant),
    /// The imaginary unit.
    ImaginaryUnit,
    /// Infinity: a limit of an integral or a sum.
    Infinity,
    /// An input, by its place.
    Input(u32),
    /// The k-th variable of a binder.
    Variable(BinderId, u32),
    /// True or false.
    Truth(bool),
    /// `−a`.
    Neg(Id),
    /// `a + b`.
    Add(Id, Id),
    /// `a − b`.
    Sub(Id, Id),
    /// `a b`.
    Mul(Id, Id),
    /// `a / b`.
    Div(Id, Id),
    /// An integer power.
    Power(Id, i32),
    /// A function of one argument.
    Unary(Func, Id),
    /// A function of two arguments.
    Binary(Func, Id, Id),
    /// A function of three arguments.
    Ternary(Func, Id, Id, Id),
    /// Zero: the derivative of a step function where that function is constant, and zero off the
    /// cut of a function of complex numbers; by the argument of a real number where it has a sign.
    Flat(Func, Id),
    /// A comparison.
    Compare(Relation, Id, Id),
    /// Both.
    And(Id, Id),
    /// One of both.
    Or(Id, Id),
    /// The contrary.
    Not(Id),
    /// The second where the first is true, else the third.
    If(Id, Id, Id),
    /// The sum, the integral or the root of a binder.
    Bound(BinderId),
    /// The last value of the k-th variable of a loop, or the k-th unknown of a system.
    Last(BinderId, u32),
}

/// How a variable is bound.
#[derive(Clone, Debug, PartialEq)]
pub enum Binding {
    /// A sum over the integers from one node to another, which may be infinite.
    Sum {
        /// The first index.
        from: Id,
        /// The last index.
        to: Id,
        /// The term.
        body: Id,
    },
    /// An integral.
    Integral {
        /// The lower limit.
        from: Id,
        /// The upper limit.
        to: Id,
        /// The integrand.
        body: Id,
    },
    /// A root of the body between two limits, or the number of roots.
    Root {
        /// The lower limit.
        from: Id,
        /// The upper limit.
        to: Id,
        /// The function.
        body: Id,
        /// Its derivative.
        slope: Id,
        /// The root that is meant.
        which: Roots,
    },
    /// A loop: all variables are replaced at once while the condition holds.
    Loop {
        /// The condition.
        condition: Id,
        /// First values.
        first: Vec<Id>,
        /// Values of the next round.
        next: Vec<Id>,
    },
    /// The only solution of as many equations as there are variables.
    System {
        /// Where each unknown is sought.
        starts: Vec<Start<Id>>,
        /// Expressions that are zero at the solution.
        equations: Vec<Id>,
        /// Their derivatives by the unknowns, equation by equation.
        jacobian: Vec<Id>,
    },
    /// A binder that is being built.
    Open,
}

/// A sum, an integral, a root, a loop or a system.
#[derive(Clone, Debug)]
pub struct Binder {
    /// How its variables are bound.
    pub binding: Binding,
    /// The names of its variables.
    pub names: Vec<String>,
    /// Nodes whose innermost variable is one of this binder's.
    pub members: Vec<Id>,
    /// The number of binders around it.
    depth: u32,
}

/// Properties of a node.
#[derive(Clone, Debug, Default)]
struct Facts {
    /// The binders whose variables it depends on, innermost last.
    binders: Vec<BinderId>,
    /// True if it depends on an input.
    varies: bool,
    /// True if its value may have an imaginary part.
    is_complex: bool,
    /// True if its value may be irrational at rational inputs.
    is_irrational: bool,
}

/// Expressions with shared subexpressions.
#[derive(Clone, Debug, Default)]
pub struct Graph {
    inputs: Vec<String>,
    nodes: Vec<Node>,
    facts: Vec<Facts>,
    places: HashMap<Node, Id>,
    numbers: Vec<Rational>,
    number_places: HashMap<Rational, u32>,
    binders: Vec<Binder>,
    derivatives: HashMap<(Id, Id), Option<Id>>,
    /// True if differences that cancel are replaced where an identity allows it.
    is_real_function: bool,
    /// The unknowns of a system with the nodes that stand for them.
    unknowns: Vec<(String, Id)>,
    /// True if a name that is not declared becomes an input.
    takes_any_name: bool,
}

impl Graph {
    /// Creates a graph whose expressions depend on these inputs.
    pub fn new(inputs: impl IntoIterator<Item = String>) -> Graph {
        Graph {
            inputs: inputs.into_iter().collect(),
            ..Graph::default()
        }
    }

    /// Replaces differences that cancel by identities of real functions, in what is built from now
    /// on. A graph whose nodes stand for floating-point operations must not do so.
    #[must_use]
    pub fn of_real_functions(mut self) -> Graph {
        self.is_real_function = true;
        self
    }

    /// Makes an input of each name that is not declared.
    #[must_use]
    pub fn of_any_names(mut self) -> Graph {
        self.takes_any_name = true;
        self
    }

    /// The names of the inputs.
    pub fn inputs(&self) -> &[String] {
        &self.inputs
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Returns true if there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// A node.
    pub fn node(&self, id: Id) -> Node {
        self.nodes[id as usize]
    }

    /// The place of a node, if the graph has it.
    pub fn find(&self, node: Node) -> Option<Id> {
        self.places.get(&node).copied()
    }

    /// A rational number of the table.
    pub fn rational(&self, place: u32) -> &Rational {
        &self.numbers[place as usize]
    }

    /// All numbers of the table.
    pub fn numbers(&self) -> &[Rational] {
        &self.numbers
    }

    /// A binder.
    pub fn binder(&self, id: BinderId) -> &Binder {
        &self.binders[id as usize]
    }

    /// The number of binders.
    pub fn binders(&self) -> usize {
        self.binders.len()
    }

    /// Returns true if the value depends on an input or a bound variable.
    pub fn varies(&self, id: Id) -> bool {
        let facts = &self.facts[id as usize];
        facts.varies || !facts.binders.is_empty()
    }

    /// Returns true if the value may have an imaginary part.
    pub fn is_complex(&self, id: Id) -> bool {
        self.facts[id as usize].is_complex
    }

    /// Returns true if the value is rational at rational inputs.
    pub fn is_rational(&self, id: Id) -> bool {
        !self.facts[id as usize].is_irrational
    }

    /// Returns true if the value is true or false.
    pub fn is_condition(&self, id: Id) -> bool {
        matches!(
            self.node(id),
            Node::Truth(_) | Node::Compare(..) | Node::And(..) | Node::Or(..) | Node::Not(_)
        )
    }

    /// The node of an input.
    pub fn input(&mut self, k: usize) -> Id {
        self.push(Node::Input(k as u32))
    }

    /// Adds an input; returns its node.
    pub fn add_input(&mut self, name: String) -> Id {
        self.inputs.push(name);
        self.input(self.inputs.len() - 1)
    }

    /// Returns true if the value depends on a variable of the binder.
    pub fn depends_on(&self, id: Id, binder: BinderId) -> bool {
        self.facts[id as usize].binders.contains(&binder)
    }

    /// Returns true if a node depends on the variable of any binder.
    pub fn is_within(&self, id: Id) -> bool {
        !self.facts[id as usize].binders.is_empty()
    }

    /// The node of a rational number.
    pub fn number(&mut self, value: impl Into<Rational>) -> Id {
        let value = value.into();
        let place = match self.number_places.get(&value) {
            Some(place) => *place,
            None => {
                let place = self.numbers.len() as u32;
                self.numbers.push(value.clone());
                self.number_places.insert(value, place);
                place
            }
        };
        self.push(Node::Number(place))
    }

    /// The operands of a node, those of its binder included.
    pub fn operands(&self, node: Node) -> Vec<Id> {
        match node {
            Node::Number(_)
            | Node::Constant(_)
            | Node::ImaginaryUnit
            | Node::Infinity
            | Node::Input(_)
            | Node::Variable(..)
            | Node::Truth(_) => Vec::new(),
            Node::Neg(a) | Node::Power(a, _) | Node::Unary(_, a) | Node::Flat(_, a) => vec![a],
            Node::Not(a) => vec![a],
            Node::Add(a, b) | Node::Sub(a, b) | Node::Mul(a, b) | Node::Div(a, b) => vec![a, b],
            Node::Binary(_, a, b) | Node::Compare(_, a, b) => vec![a, b],
            Node::And(a, b) | Node::Or(a, b) => vec![a, b],
            Node::Ternary(_, a, b, c) | Node::If(a, b, c) => vec![a, b, c],
            Node::Bound(binder) | Node::Last(binder, _) => self.operands_of(binder),
        }
    }

    fn operands_of(&self, binder: BinderId) -> Vec<Id> {
        match &self.binder(binder).binding {
            Binding::Sum { from, to, body } | Binding::Integral { from, to, body } => {
                vec![*from, *to, *body]
            }
            Binding::Root {
                from,
                to,
                body,
                slope,
                ..
            } => vec![*from, *to, *body, *slope],
            Binding::Loop {
                condition,
                first,
                next,
            } => {
                let all = [*condition].into_iter();
                all.chain(first.iter().copied())
                    .chain(next.iter().copied())
                    .collect()
            }
            Binding::System {
                starts,
                equations,
                jacobian,
            } => {
                let all = starts.iter().flat_map(Start::parts).copied();
                all.chain(equations.iter().copied())
                    .chain(jacobian.iter().copied())
                    .collect()
            }
            Binding::Open => Vec::new(),
        }
    }

    /// The place of a node, which is added if it is new.
    pub(crate) fn push(&mut self, node: Node) -> Id {
        let node = match self.is_real_function {
            true => self.without_cancellation(node),
            false => node,
        };
        if let Some(place) = self.places.get(&node) {
            return *place;
        }
        let mut facts = Facts::default();
        for operand in self.operands(node) {
            let known = &self.facts[operand as usize];
            facts.varies |= known.varies;
            facts.is_complex |= known.is_complex;
            facts.is_irrational |= known.is_irrational;
            let new = known.binders.iter().filter(|b| !facts.binders.contains(b));
            let new: Vec<BinderId> = new.copied().collect();
            facts.binders.extend(new);
        }
        facts.is_irrational |= match node {
            Node::Constant(_) | Node::ImaginaryUnit | Node::Bound(_) => true,
            Node::Unary(f, _) | Node::Binary(f, ..) | Node::Ternary(f, ..) => !f.is_rational(),
            _ => false,
        };
        match node {
            Node::Input(_) => facts.varies = true,
            Node::ImaginaryUnit | Node::Unary(Func::W, _) => facts.is_complex = true,
            Node::Unary(Func::Re | Func::Im | Func::Abs | Func::Arg, _)
            | Node::Flat(..)
            | Node::Compare(..) => {
                facts.is_complex = false;
            }
            Node::Variable(binder, _) => facts.binders.push(binder),
            Node::Bound(binder) | Node::Last(binder, _) => facts.binders.retain(|b| *b != binder),
            _ => {}
        }
        facts
            .binders
            .sort_by_key(|b| self.binders[*b as usize].depth);
        let place = self.nodes.len() as Id;
        if let Some(innermost) = facts.binders.last() {
            self.binders[*innermost as usize].members.push(place);
        }
        self.nodes.push(node);
        self.facts.push(facts);
        self.places.insert(node, place);
        place
    }

    /// Opens a binder of some variables within others.
    fn open(&mut self, names: Vec<String>, depth: u32) -> BinderId {
        self.binders.push(Binder {
            binding: Binding::Open,
            names,
            members: Vec::new(),
            depth,
        });
        self.binders.len() as BinderId - 1
    }

    /// Where a binder is to be opened whose body depends on these nodes.
    fn depth_above(&self, nodes: &[Id]) -> u32 {
        let binders = nodes
            .iter()
            .flat_map(|id| &self.facts[*id as usize].binders);
        let depths = binders.map(|b| self.binders[*b as usize].depth + 1);
        depths.max().unwrap_or(0)
    }

    /// All nodes that a node depends on, itself included, in ascending order.
    pub fn reach(&self, root: Id) -> Vec<Id> {
        let mut seen = vec![false; root as usize + 1];
        let mut open = vec![root];
        while let Some(id) = open.pop() {
            if !std::mem::replace(&mut seen[id as usize], true) {
                open.extend(self.operands(self.node(id)));
            }
        }
        (0..=root).filter(|id| seen[*id as usize]).collect()
    }
}

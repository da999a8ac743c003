//! Graphs as straight-line programs whose Taylor coefficients are computed one order at a time.
//!
//! Values that depend neither on the time nor on a state are constants, computed in balls by the
//! evaluator. A value that is smooth on either side of a switch (`abs`, `if`, `fmin`, `floor`)
//! becomes the smooth function of the side that is chosen, and a guard: a value whose sign has to
//! be proved where the program is used.

mod functions;
mod switch;

pub(super) use switch::{Side, Switch};

use crate::graph::{Graph, Id, Node};
use crate::{Func, Relation};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Operation, Program, Slot};
use rug::Rational;
use std::cmp::Ordering;
use std::collections::HashMap;
use switch::ends;

/// A constant of a program.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Fixed {
    /// The value of a node.
    Node(Id),
    /// A rational number.
    Number(Rational),
    /// `2/√π`.
    TwoOverRootPi,
    /// `π/2`.
    HalfPi,
}

/// A value whose sign is that of a side of a switch.
#[derive(Clone, Debug)]
pub(super) struct Guard {
    pub switch: Switch,
    pub slot: Slot,
    /// True if the value has to be positive, else it has to be negative.
    pub positive: bool,
}

/// A program for nodes of a graph.
#[derive(Clone, Debug, Default)]
pub(super) struct Compiled {
    pub program: Program,
    pub constants: Vec<Fixed>,
    pub guards: Vec<Guard>,
    /// The nodes of operations.
    pub origin: Vec<Id>,
}

/// Reason why a node is no program.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Unsupported {
    pub node: Id,
    pub reason: NoValue,
}

/// Where a node depends on the time or a state.
pub(super) fn dependent(graph: &Graph, inputs: usize) -> Vec<bool> {
    let mut depends = vec![false; graph.len()];
    for id in 0..graph.len() as Id {
        depends[id as usize] = match graph.node(id) {
            Node::Input(k) => k as usize >= inputs,
            node => graph.operands(node).iter().any(|a| depends[*a as usize]),
        };
    }
    depends
}

/// Compiles nodes; `choose` gives the side of each switch that is met. `switches` are guarded even
/// if no node needs them.
pub(super) fn compile(
    graph: &Graph,
    inputs: usize,
    roots: &[Id],
    switches: &[Switch],
    choose: &mut dyn FnMut(Switch) -> Result<Side, NoValue>,
) -> Result<(Compiled, Vec<Slot>), Unsupported> {
    let mut compiler = Compiler {
        graph,
        inputs,
        depends: dependent(graph, inputs),
        choose,
        slots: HashMap::new(),
        fixed: Vec::new(),
        out: Compiled::default(),
        node: 0,
    };
    let mut slots = Vec::with_capacity(roots.len());
    for root in roots {
        let slot = compiler.slot(*root);
        slots.push(slot.map_err(|reason| Unsupported {
            node: compiler.node,
            reason,
        })?);
    }
    for switch in switches {
        let side = compiler.side(*switch);
        side.map_err(|reason| Unsupported {
            node: compiler.node,
            reason,
        })?;
    }
    Ok((compiler.out, slots))
}

struct Compiler<'a> {
    graph: &'a Graph,
    inputs: usize,
    depends: Vec<bool>,
    choose: &'a mut dyn FnMut(Switch) -> Result<Side, NoValue>,
    slots: HashMap<Id, Slot>,
    fixed: Vec<(Fixed, Slot)>,
    out: Compiled,
    /// The node that is compiled.
    node: Id,
}

const OUTSIDE: NoValue =
    NoValue::Undecided("sums, integrals, roots and loops over a state have no Taylor series here");

const NO_SERIES: NoValue = NoValue::Undecided("a function without a Taylor series here");

type Placed = Result<Slot, NoValue>;

impl Compiler<'_> {
    fn push(&mut self, operation: Operation) -> Slot {
        let slot = self.out.program.push(operation);
        self.out.origin.resize(slot + 1, self.node);
        slot
    }

    fn sine_cosine(&mut self, a: Slot) -> (Slot, Slot) {
        let pair = self.out.program.sine_cosine(a);
        self.out.origin.resize(pair.1 + 1, self.node);
        pair
    }

    fn fixed(&mut self, value: Fixed) -> Slot {
        if let Some(known) = self.fixed.iter().find(|f| f.0 == value) {
            return known.1;
        }
        let slot = self.out.program.constant();
        self.out.origin.resize(slot + 1, self.node);
        self.out.constants.push(value.clone());
        self.fixed.push((value, slot));
        slot
    }

    fn number(&mut self, n: i64) -> Slot {
        self.fixed(Fixed::Number(n.into()))
    }

    /// The place of a node. What it needs is placed first, without recursion in the depth of the
    /// expression: an expression of users may be deep.
    fn slot(&mut self, root: Id) -> Placed {
        let mut open = vec![(root, false)];
        while let Some((id, is_ready)) = open.pop() {
            if self.slots.contains_key(&id) {
                continue;
            }
            self.node = id;
            if !self.depends[id as usize] {
                let slot = self.fixed(Fixed::Node(id));
                self.slots.insert(id, slot);
                continue;
            }
            let node = self.graph.node(id);
            if is_ready {
                let slot = self.place(node)?;
                self.slots.insert(id, slot);
                continue;
            }
            open.push((id, true));
            match node {
                Node::If(condition, a, b) => {
                    let chosen = if self.holds(condition)? { a } else { b };
                    self.node = id;
                    open.push((chosen, false));
                }
                Node::Bound(_) | Node::Last(..) | Node::Variable(..) => return Err(OUTSIDE),
                node => open.extend(self.graph.operands(node).into_iter().map(|a| (a, false))),
            }
        }
        self.known(root)
    }

    fn known(&self, id: Id) -> Placed {
        self.slots.get(&id).copied().ok_or(OUTSIDE)
    }

    /// The operation of a node whose operands have places.
    fn place(&mut self, node: Node) -> Placed {
        Ok(match node {
            Node::Input(k) if k as usize == self.inputs => self.push(Operation::Time),
            Node::Input(k) => self.push(Operation::State(k as usize - self.inputs - 1)),
            Node::Neg(a) => {
                let a = self.known(a)?;
                self.push(Operation::Neg(a))
            }
            Node::Add(a, b) => self.pair(a, b, Operation::Add)?,
            Node::Sub(a, b) => self.pair(a, b, Operation::Sub)?,
            Node::Mul(a, b) if a == b => {
                let a = self.known(a)?;
                self.push(Operation::Square(a))
            }
            Node::Mul(a, b) => self.pair(a, b, Operation::Mul)?,
            Node::Div(a, b) => self.pair(a, b, Operation::Div)?,
            Node::Power(a, k) => {
                let a = self.known(a)?;
                self.power(a, k)
            }
            Node::Unary(f, a) => {
                let slot = self.known(a)?;
                self.unary(f, a, slot)?
            }
            Node::Binary(f, a, b) => self.binary(f, a, b)?,
            Node::Ternary(Func::Fma, a, b, c) => {
                let product = self.pair(a, b, Operation::Mul)?;
                let c = self.known(c)?;
                self.push(Operation::Add(product, c))
            }
            Node::Flat(f, a) => {
                self.side(Switch::Step(f, a))?;
                self.number(0)
            }
            Node::If(condition, a, b) => {
                let chosen = if self.holds(condition)? { a } else { b };
                self.known(chosen)?
            }
            Node::Ternary(..)
            | Node::Number(_)
            | Node::Constant(_)
            | Node::ImaginaryUnit
            | Node::Infinity
            | Node::Variable(..)
            | Node::Truth(_)
            | Node::Compare(..)
            | Node::And(..)
            | Node::Or(..)
            | Node::Not(_)
            | Node::Bound(_)
            | Node::Last(..) => return Err(NO_SERIES),
        })
    }

    fn pair(&mut self, a: Id, b: Id, of: fn(Slot, Slot) -> Operation) -> Placed {
        let (a, b) = (self.known(a)?, self.known(b)?);
        Ok(self.push(of(a, b)))
    }

    /// The side of a switch, with its guards; at the switch itself there are none.
    fn side(&mut self, switch: Switch) -> Result<Side, NoValue> {
        let side = (self.choose)(switch)?;
        let known = self.out.guards.iter().any(|guard| guard.switch == switch);
        if known || side == Side::Zero {
            return Ok(side);
        }
        let outside = self.node;
        match (switch, &side) {
            (Switch::Sign(a, b), _) => {
                let (a, b) = (self.slot(a)?, self.slot(b)?);
                let slot = self.push(Operation::Sub(a, b));
                self.guard(switch, slot, side == Side::Positive);
            }
            (Switch::SignOf(a), _) => {
                let slot = self.slot(a)?;
                self.guard(switch, slot, side == Side::Positive);
            }
            (Switch::Step(f, a), Side::Integer(n)) => {
                let a = self.slot(a)?;
                for (end, positive) in ends(f, n).into_iter().zip([true, false]) {
                    let Some(end) = end else { continue };
                    let end = self.fixed(Fixed::Number(end));
                    let slot = self.push(Operation::Sub(a, end));
                    self.guard(switch, slot, positive);
                }
            }
            _ => return Err(NO_SERIES),
        }
        self.node = outside;
        Ok(side)
    }

    fn guard(&mut self, switch: Switch, slot: Slot, positive: bool) {
        self.out.guards.push(Guard {
            switch,
            slot,
            positive,
        });
    }

    fn is_positive(&mut self, switch: Switch) -> Result<bool, NoValue> {
        Ok(self.side(switch)? == Side::Positive)
    }

    /// The order of a and b on the chosen side.
    fn order(&mut self, a: Id, b: Id) -> Result<Ordering, NoValue> {
        let (switch, is_turned) = Switch::between(self.graph, a, b);
        Ok(match (self.side(switch)?, is_turned) {
            (Side::Zero, _) => Ordering::Equal,
            (Side::Positive, false) | (Side::Negative, true) => Ordering::Greater,
            _ => Ordering::Less,
        })
    }

    /// Returns true if `a > b` on the chosen side.
    fn is_greater(&mut self, a: Id, b: Id) -> Result<bool, NoValue> {
        Ok(self.order(a, b)? == Ordering::Greater)
    }

    /// Returns true if a condition holds on the chosen sides of its switches.
    fn holds(&mut self, condition: Id) -> Result<bool, NoValue> {
        match self.graph.node(condition) {
            Node::Truth(t) => Ok(t),
            Node::Not(a) => Ok(!self.holds(a)?),
            Node::And(a, b) => Ok(self.holds(a)? && self.holds(b)?),
            Node::Or(a, b) => Ok(self.holds(a)? || self.holds(b)?),
            Node::Compare(relation, a, b) => {
                let order = self.order(a, b)?;
                Ok(match relation {
                    Relation::Less => order.is_lt(),
                    Relation::LessEqual => order.is_le(),
                    Relation::Greater => order.is_gt(),
                    Relation::GreaterEqual => order.is_ge(),
                    Relation::Equal => order.is_eq(),
                    Relation::NotEqual => order.is_ne(),
                })
            }
            _ => Err(NO_SERIES),
        }
    }
}

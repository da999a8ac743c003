//! Graphs as straight-line programs whose Taylor coefficients are computed one order at a time.
//!
//! Values that depend neither on the time nor on a state are constants, computed in balls by the
//! evaluator. A value that is smooth on either side of a switch (`abs`, `if`, `fmin`, `floor`)
//! becomes the smooth function of the side that is chosen, and a guard: a value whose sign has to
//! be proved where the program is used.

use crate::graph::{Graph, Id, Node};
use crate::{Func, Relation};
use mechaudit_reference::elementary::NoValue;
use mechaudit_reference::initial_value::{Operation, Primitive, Program, Slot};
use rug::Rational;
use std::cmp::Ordering;
use std::collections::HashMap;

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

/// A switch: the sign of `a − b`, or the integer that a step function gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Switch {
    /// The sign of a difference.
    Sign(Id, Id),
    /// The sign of a value.
    SignOf(Id),
    /// A step function of a value.
    Step(Func, Id),
}

impl Switch {
    /// The switch of a comparison; true if its sign is that of `b − a`.
    pub fn between(graph: &Graph, a: Id, b: Id) -> (Switch, bool) {
        let is_zero = |id| match graph.node(id) {
            Node::Number(place) => *graph.rational(place) == 0,
            _ => false,
        };
        match () {
            () if is_zero(b) => (Switch::SignOf(a), false),
            () if is_zero(a) => (Switch::SignOf(b), true),
            () if a > b => (Switch::Sign(b, a), true),
            () => (Switch::Sign(a, b), false),
        }
    }

    /// The switches of all nodes that some nodes need.
    pub fn all(graph: &Graph, roots: &[Id]) -> Vec<Switch> {
        let mut found = Vec::new();
        let mut seen = vec![false; graph.len()];
        for id in roots.iter().flat_map(|root| graph.reach(*root)) {
            if std::mem::replace(&mut seen[id as usize], true) {
                continue;
            }
            let mut add = |switch| {
                if !found.contains(&switch) {
                    found.push(switch);
                }
            };
            match graph.node(id) {
                Node::Unary(Func::Abs | Func::Cbrt, a) => add(Switch::SignOf(a)),
                Node::Binary(Func::Copysign, a, b) => {
                    add(Switch::SignOf(a));
                    add(Switch::SignOf(b));
                }
                Node::Compare(_, a, b)
                | Node::Binary(Func::Fmin | Func::Fmax | Func::Fdim, a, b) => {
                    add(Switch::between(graph, a, b).0);
                }
                Node::Unary(
                    f @ (Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint),
                    a,
                )
                | Node::Flat(f, a) => add(Switch::Step(f, a)),
                _ => {}
            }
        }
        found
    }

    /// Returns true if what depends on the sign is something else where the value is zero than on
    /// either side: `a == b`, or `a <= b` beside `a >= b`.
    pub fn is_pointed(self, graph: &Graph) -> bool {
        let at_zero = |id| match graph.node(id) {
            Node::Compare(relation, a, b) => {
                let (switch, is_turned) = Switch::between(graph, a, b);
                (switch == self).then_some(match relation {
                    Relation::Less | Relation::GreaterEqual => Some(!is_turned),
                    Relation::LessEqual | Relation::Greater => Some(is_turned),
                    Relation::Equal | Relation::NotEqual => None,
                })
            }
            Node::Binary(Func::Copysign, _, b) => (Switch::SignOf(b) == self).then_some(Some(true)),
            _ => None,
        };
        let mut sides = (0..graph.len() as Id).filter_map(at_zero);
        let first = sides.next().unwrap_or(Some(true));
        first.is_none() || sides.any(|side| side != first)
    }

    /// The nodes whose difference changes its sign.
    pub fn parts(self) -> (Id, Option<Id>) {
        match self {
            Switch::Sign(a, b) => (a, Some(b)),
            Switch::SignOf(a) | Switch::Step(_, a) => (a, None),
        }
    }
}

/// The side of a switch.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Side {
    /// The value is greater than zero.
    Positive,
    /// The value is less than zero.
    Negative,
    /// The value is zero: the motion is at the switch.
    Zero,
    /// The value of the step function.
    Integer(Rational),
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

    fn quotient(&mut self, n: i64, below: Slot) -> Slot {
        let above = self.number(n);
        self.push(Operation::Div(above, below))
    }

    /// An integer power by squares and products, which hold where the base is zero, too.
    fn power(&mut self, a: Slot, k: i32) -> Slot {
        let mut rest = k.unsigned_abs();
        let mut square = a;
        let mut product = None;
        while rest > 0 {
            if rest % 2 == 1 {
                product = Some(match product {
                    Some(product) => self.push(Operation::Mul(product, square)),
                    None => square,
                });
            }
            rest /= 2;
            if rest > 0 {
                square = self.push(Operation::Square(square));
            }
        }
        match (product, k < 0) {
            (None, _) => self.number(1),
            (Some(product), false) => product,
            (Some(product), true) => self.quotient(1, product),
        }
    }

    fn scaled(&mut self, factor: Fixed, a: Slot) -> Slot {
        let factor = self.fixed(factor);
        self.push(Operation::Mul(factor, a))
    }

    fn primitive(&mut self, f: Primitive, a: Slot, slope: Slot) -> Slot {
        self.push(Operation::Primitive(f, vec![(a, slope)]))
    }

    fn log(&mut self, a: Slot) -> Slot {
        let slope = self.quotient(1, a);
        self.primitive(Primitive::Log, a, slope)
    }

    /// `1/(m + n a²)`, or the inverse of its root.
    fn inverse(&mut self, m: i64, n: i64, a: Slot, is_root: bool) -> Slot {
        let square = self.push(Operation::Square(a));
        let m = self.number(m);
        let sum = self.push(match n {
            1 => Operation::Add(m, square),
            _ => Operation::Sub(m, square),
        });
        let below = match is_root {
            true => self.push(Operation::Sqrt(sum)),
            false => sum,
        };
        self.quotient(1, below)
    }

    /// `(2/√π) e^{±a²}`.
    fn gaussian(&mut self, is_falling: bool, a: Slot) -> Slot {
        let mut square = self.push(Operation::Square(a));
        if is_falling {
            square = self.push(Operation::Neg(square));
        }
        let exponential = self.push(Operation::Exp(square));
        self.scaled(Fixed::TwoOverRootPi, exponential)
    }

    fn less_than(&mut self, n: i64, a: Slot) -> Slot {
        let n = self.number(n);
        self.push(Operation::Sub(n, a))
    }

    /// The logarithm of a number as a constant.
    fn log_of(&mut self, n: i64) -> Slot {
        let n = self.number(n);
        self.log(n)
    }

    fn unary(&mut self, f: Func, id: Id, a: Slot) -> Placed {
        Ok(match f {
            Func::Exp => self.push(Operation::Exp(a)),
            Func::Exp2 | Func::Exp10 => {
                let log = self.log_of(if f == Func::Exp2 { 2 } else { 10 });
                let exponent = self.push(Operation::Mul(log, a));
                self.push(Operation::Exp(exponent))
            }
            Func::Expm1 => {
                let exponential = self.push(Operation::Exp(a));
                let one = self.number(1);
                self.push(Operation::Sub(exponential, one))
            }
            Func::Log => self.log(a),
            Func::Log2 | Func::Log10 => {
                let (log, base) = (
                    self.log(a),
                    self.log_of(if f == Func::Log2 { 2 } else { 10 }),
                );
                self.push(Operation::Div(log, base))
            }
            Func::Log1p => {
                let one = self.number(1);
                let sum = self.push(Operation::Add(one, a));
                self.log(sum)
            }
            Func::Sqrt => self.push(Operation::Sqrt(a)),
            Func::Cbrt => {
                let positive = self.is_positive(Switch::SignOf(id))?;
                let size = match positive {
                    true => a,
                    false => self.push(Operation::Neg(a)),
                };
                let root = self.push(Operation::Power(size, 1, 3));
                match positive {
                    true => root,
                    false => self.push(Operation::Neg(root)),
                }
            }
            Func::Sin => self.sine_cosine(a).0,
            Func::Cos => self.sine_cosine(a).1,
            Func::Tan => {
                let (sine, cosine) = self.sine_cosine(a);
                self.push(Operation::Div(sine, cosine))
            }
            Func::Arctan => {
                let slope = self.inverse(1, 1, a, false);
                self.primitive(Primitive::Atan, a, slope)
            }
            Func::Asin | Func::Acos => {
                let slope = self.inverse(1, -1, a, true);
                let sine = self.primitive(Primitive::Asin, a, slope);
                match f {
                    Func::Asin => sine,
                    _ => {
                        let half = self.fixed(Fixed::HalfPi);
                        self.push(Operation::Sub(half, sine))
                    }
                }
            }
            Func::Sinh | Func::Cosh | Func::Tanh => {
                let up = self.push(Operation::Exp(a));
                let down = self.quotient(1, up);
                let [sum, difference] =
                    [Operation::Add(up, down), Operation::Sub(up, down)].map(|o| self.push(o));
                let half = Fixed::Number((1, 2).into());
                match f {
                    Func::Sinh => self.scaled(half, difference),
                    Func::Cosh => self.scaled(half, sum),
                    _ => self.push(Operation::Div(difference, sum)),
                }
            }
            Func::Asinh => {
                let slope = self.inverse(1, 1, a, true);
                self.primitive(Primitive::Asinh, a, slope)
            }
            Func::Acosh => {
                let square = self.push(Operation::Square(a));
                let one = self.number(1);
                let below = self.push(Operation::Sub(square, one));
                let root = self.push(Operation::Sqrt(below));
                let slope = self.quotient(1, root);
                self.primitive(Primitive::Acosh, a, slope)
            }
            Func::Atanh => {
                let slope = self.inverse(1, -1, a, false);
                self.primitive(Primitive::Atanh, a, slope)
            }
            Func::Erf => {
                let slope = self.gaussian(true, a);
                self.primitive(Primitive::Erf, a, slope)
            }
            Func::Erfc | Func::Erfcx => {
                let slope = self.gaussian(true, a);
                let erf = self.primitive(Primitive::Erf, a, slope);
                let erfc = self.less_than(1, erf);
                match f {
                    Func::Erfc => erfc,
                    _ => {
                        let square = self.push(Operation::Square(a));
                        let exponential = self.push(Operation::Exp(square));
                        self.push(Operation::Mul(exponential, erfc))
                    }
                }
            }
            Func::Erfi => {
                let slope = self.gaussian(false, a);
                self.primitive(Primitive::Erfi, a, slope)
            }
            // e^{−a²} erfi(a) √π/2.
            Func::Dawson => {
                let slope = self.gaussian(false, a);
                let erfi = self.primitive(Primitive::Erfi, a, slope);
                let gaussian = self.gaussian(true, a);
                let product = self.push(Operation::Mul(erfi, gaussian));
                let factor = self.fixed(Fixed::TwoOverRootPi);
                let square = self.push(Operation::Square(factor));
                self.push(Operation::Div(product, square))
            }
            Func::Abs => match self.is_positive(Switch::SignOf(id))? {
                true => a,
                false => self.push(Operation::Neg(a)),
            },
            Func::Floor | Func::Ceil | Func::Round | Func::Trunc | Func::Nearbyint => {
                match self.side(Switch::Step(f, id))? {
                    Side::Integer(n) => self.fixed(Fixed::Number(n)),
                    _ => return Err(NO_SERIES),
                }
            }
            Func::Re | Func::Conj => a,
            Func::Im => self.number(0),
            _ => return Err(NO_SERIES),
        })
    }

    fn binary(&mut self, f: Func, left: Id, right: Id) -> Placed {
        let (a, b) = (self.known(left)?, self.known(right)?);
        Ok(match f {
            Func::Pow => {
                if let Node::Number(place) = self.graph.node(right) {
                    let exponent = self.graph.rational(place);
                    let whole = exponent.numer().to_i32().filter(|_| exponent.is_integer());
                    if let Some(k) = whole.filter(|k| k.abs() <= 1 << 16) {
                        return Ok(self.power(a, k));
                    }
                    if let Some(slot) = self.out.program.power(a, exponent) {
                        self.out.origin.resize(slot + 1, self.node);
                        return Ok(slot);
                    }
                }
                let log = self.log(a);
                let exponent = self.push(Operation::Mul(b, log));
                self.push(Operation::Exp(exponent))
            }
            Func::Hypot => {
                let squares = [a, b].map(|x| self.push(Operation::Square(x)));
                let sum = self.push(Operation::Add(squares[0], squares[1]));
                self.push(Operation::Sqrt(sum))
            }
            Func::Atan2 => {
                let squares = [a, b].map(|x| self.push(Operation::Square(x)));
                let sum = self.push(Operation::Add(squares[0], squares[1]));
                let [by_y, to_x] = [b, a].map(|x| self.push(Operation::Div(x, sum)));
                let by_x = self.push(Operation::Neg(to_x));
                let parts = vec![(a, by_y), (b, by_x)];
                self.push(Operation::Primitive(Primitive::Atan2, parts))
            }
            Func::Fmin | Func::Fmax => {
                let is_greater = self.is_greater(left, right)?;
                match is_greater == (f == Func::Fmax) {
                    true => a,
                    false => b,
                }
            }
            Func::Fdim => match self.is_greater(left, right)? {
                true => self.push(Operation::Sub(a, b)),
                false => self.number(0),
            },
            Func::Copysign => {
                let sign = self.side(Switch::SignOf(right))? != Side::Negative;
                let is_positive = match self.graph.node(left) {
                    Node::Number(place) => *self.graph.rational(place) >= 0,
                    _ => self.is_positive(Switch::SignOf(left))?,
                };
                match sign == is_positive {
                    true => a,
                    false => self.push(Operation::Neg(a)),
                }
            }
            _ => return Err(NO_SERIES),
        })
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

/// The open interval on which a step function is n; none for an end that is infinite.
fn ends(f: Func, n: &Rational) -> [Option<Rational>; 2] {
    let shifted = |by: (i32, i32)| Some(n + Rational::from(by));
    match f {
        Func::Floor => [shifted((0, 1)), shifted((1, 1))],
        Func::Ceil => [shifted((-1, 1)), shifted((0, 1))],
        Func::Round | Func::Nearbyint => [shifted((-1, 2)), shifted((1, 2))],
        // The integer part: towards zero.
        _ => match n.cmp0() {
            std::cmp::Ordering::Greater => [shifted((0, 1)), shifted((1, 1))],
            std::cmp::Ordering::Less => [shifted((-1, 1)), shifted((0, 1))],
            std::cmp::Ordering::Equal => [shifted((-1, 1)), shifted((1, 1))],
        },
    }
}

//! Identities of real functions that spare precision, or are enclosed more closely.

use super::{Graph, Id, Node};
use crate::{Constant, Func};

impl Graph {
    /// The same real function without some differences that cancel: `e^x − 1` is `expm1(x)`,
    /// `log(1 + x)` is `log1p(x)`, `1 − 1/(1 + x)` is `x/(1 + x)`, and `1 − cos x` is `2 sin²(x/2)`.
    /// `a − a` is `0 a`, which has a value where a has one, and `a < a` compares such zeros. `pow`
    /// with a small integer is a power, and of Euler's number the exponential. Of a bound variable,
    /// whose values are wide, `a/x^k` is `a x^{−k}`: a power of a rectangle holds zero where its
    /// base does not.
    ///
    /// This is for definitions, which are meant over the reals; a formula in floating point would
    /// be another one.
    pub fn without_cancellation(&mut self, node: Node) -> Node {
        let one = |graph: &Graph, id: Id| match graph.node(id) {
            Node::Number(place) => *graph.rational(place) == 1,
            _ => false,
        };
        let unary = |graph: &Graph, id: Id, f: Func| match graph.node(id) {
            Node::Unary(g, x) if f == g => Some(x),
            _ => None,
        };
        match node {
            Node::Sub(a, b) if a == b && self.is_finite(a) => Node::Mul(self.number(0), a),
            Node::Compare(relation, a, b) if a == b && !self.is_complex(a) && self.is_finite(a) => {
                let zero = self.push(Node::Sub(a, a));
                Node::Compare(relation, zero, zero)
            }
            Node::Sub(a, b) if one(self, b) => match unary(self, a, Func::Exp) {
                Some(x) => Node::Unary(Func::Expm1, x),
                None => node,
            },
            Node::Sub(a, b) if one(self, a) => {
                if let Some(x) = unary(self, b, Func::Exp) {
                    let minus = self.push(Node::Unary(Func::Expm1, x));
                    return Node::Neg(minus);
                }
                if let Node::Div(c, d) = self.node(b)
                    && one(self, c)
                    && let Node::Add(x, y) = self.node(d)
                    && let Some(rest) = match (one(self, x), one(self, y)) {
                        (true, _) => Some(y),
                        (_, true) => Some(x),
                        _ => None,
                    }
                    // Over wide values x would count twice.
                    && self.facts[rest as usize].binders.is_empty()
                {
                    return Node::Div(rest, d);
                }
                let Some(x) = unary(self, b, Func::Cos) else {
                    return node;
                };
                let two = self.number(2);
                let half = self.push(Node::Div(x, two));
                let sine = self.push(Node::Unary(Func::Sin, half));
                let square = self.push(Node::Power(sine, 2));
                Node::Mul(two, square)
            }
            Node::Unary(Func::Log, a) if !self.is_complex(a) => match self.node(a) {
                Node::Add(x, y) if one(self, x) => Node::Unary(Func::Log1p, y),
                Node::Add(x, y) if one(self, y) => Node::Unary(Func::Log1p, x),
                Node::Sub(x, y) if one(self, x) => {
                    let minus = self.push(Node::Neg(y));
                    Node::Unary(Func::Log1p, minus)
                }
                _ => node,
            },
            Node::Binary(Func::Pow, a, b) => match (self.node(a), self.small_integer(b)) {
                (_, Some(k)) => Node::Power(a, k),
                (Node::Constant(Constant::E), None) => Node::Unary(Func::Exp, b),
                _ => node,
            },
            Node::Div(a, b) => match self.node(b) {
                Node::Power(x, k) if k > 1 && !self.facts[x as usize].binders.is_empty() => {
                    let power = self.push(Node::Power(x, -k));
                    match one(self, a) {
                        true => Node::Power(x, -k),
                        false => Node::Mul(a, power),
                    }
                }
                _ => node,
            },
            node => node,
        }
    }

    /// Returns true if infinity is no part of a node.
    pub(super) fn is_finite(&self, id: Id) -> bool {
        let parts = self.reach(id);
        parts.iter().all(|part| self.node(*part) != Node::Infinity)
    }

    /// The exponent that a node is, if a few products give the power.
    fn small_integer(&self, id: Id) -> Option<i32> {
        let Node::Number(place) = self.node(id) else {
            return None;
        };
        let number = self.rational(place);
        let k = number.is_integer().then(|| number.numer().to_i32())??;
        (1..=64).contains(&k.unsigned_abs()).then_some(k)
    }
}

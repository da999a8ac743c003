//! Derivatives of Bessel functions.

use super::{Graph, Id, Node};
use crate::Func;
use rug::Rational;

impl Graph {
    /// The number that a node is, if it is one or a quotient of two.
    fn fraction(&self, id: Id) -> Option<Rational> {
        match self.node(id) {
            Node::Number(place) => Some(self.rational(place).clone()),
            Node::Neg(a) => self.fraction(a).map(|q| -q),
            Node::Div(a, b) => {
                let below = self.fraction(b).filter(|q| *q != 0)?;
                Some(self.fraction(a)? / below)
            }
            _ => None,
        }
    }

    /// The derivative of a function of the order and the argument that are given, the node `id`:
    /// `(f_{ν−1} ∓ f_{ν+1})/2`, less f for `e^{−x} I_ν`. Where ν − 1 is a broken number below zero
    /// it is `(ν/x) f ∓ f_{ν+1}`.
    pub(super) fn bessel_slope(&mut self, f: Func, [order, x]: [Id; 2], id: Id) -> Id {
        let one = self.number(1);
        let above = self.push(Node::Add(order, one));
        let high = self.push(Node::Binary(f, above, x));
        let is_broken = |q: &Rational| *q < 1 && !q.is_integer();
        let (low, parts) = match self.fraction(order).filter(is_broken) {
            Some(_) => {
                let product = self.push(Node::Mul(order, id));
                (self.push(Node::Div(product, x)), 1)
            }
            None => {
                let below = self.push(Node::Sub(order, one));
                (self.push(Node::Binary(f, below, x)), 2)
            }
        };
        let sum = self.push(match f {
            Func::BesselJ => Node::Sub(low, high),
            _ => Node::Add(low, high),
        });
        let parts = self.number(parts);
        let slope = self.push(Node::Div(sum, parts));
        match f {
            Func::BesselIe => self.push(Node::Sub(slope, id)),
            _ => slope,
        }
    }
}

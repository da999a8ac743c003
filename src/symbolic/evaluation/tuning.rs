//! Working precisions node by node.
//!
//! Where a difference cancels, its operands need many bits and the rest of a formula few. The sizes
//! of all values are known from a pass that was not accurate enough; from the outputs down, each
//! operation asks its operands for the absolute accuracy that its own result needs. The estimates
//! decide how much work is done, not whether a value is right.

use crate::Func;
use crate::graph::{Graph, Id, Node};
use mechaudit_reference::{Ball, Ball128};

/// The size of a value: `2^lower ≤ |x| < 2^upper`, known to within `2^radius`.
#[derive(Clone, Copy)]
pub(super) struct Size {
    upper: i64,
    /// None if the value may be zero.
    lower: Option<i64>,
    /// None if it is exact.
    radius: Option<i64>,
}

/// More than the exponents of all numbers that matter.
const FAR: i64 = 1 << 50;

/// Bits that are kept beyond those that are asked for.
const SPARE: i64 = 8;

/// The fewest bits of a midpoint.
const FEWEST: i64 = 64;

impl Size {
    /// The size of a ball.
    pub fn of(x: &Ball) -> Size {
        Size {
            upper: x.magnitude().exponent().map_or(-FAR, |e| e + 1),
            lower: x.mignitude().exponent(),
            radius: x.rad().exponent().map(|e| e + 1),
        }
    }

    /// The size of a ball of machine words.
    pub fn of_short(x: &Ball128) -> Size {
        let [upper, lower, radius] = x.exponents();
        Size {
            upper: upper.unwrap_or(-FAR),
            lower,
            radius,
        }
    }
}

/// A pass that was not accurate enough, and the next one.
pub(super) struct Passes<'a, S> {
    /// The graph.
    pub graph: &'a Graph,
    /// The sizes of the values that are known.
    pub size: S,
    /// Bits of the pass that was made.
    pub before: u32,
    /// The most bits of a node in the next one.
    pub most: u32,
    /// Bits of the outputs that are wanted in the end.
    pub wanted: u32,
}

impl<S: Fn(Id) -> Option<Size>> Passes<'_, S> {
    /// The precisions of all nodes up to the last root for the next pass.
    pub fn precisions(&self, roots: &[Id]) -> Vec<u32> {
        // Operands stand before what they are used in.
        let end = roots.iter().max().map_or(0, |id| id + 1);
        let exponents = self.exponents(end);
        let mut errors = vec![i64::MAX; end as usize];
        for root in roots {
            let least = match exponents[*root as usize] {
                Some(e) => e - i64::from(self.wanted) - SPARE,
                None => FAR,
            };
            errors[*root as usize] = least;
        }
        for id in (0..end).rev() {
            if errors[id as usize] != i64::MAX {
                self.ask_operands(id, &exponents, &mut errors);
            }
        }
        let precision = |(id, error): (usize, i64)| match (error, (self.size)(id as Id)) {
            // Constants are kept for other inputs.
            _ if !self.graph.varies(id as Id) => self.most,
            (i64::MAX, _) | (_, None) => self.most,
            (error, Some(size)) => {
                let bits = (size.upper - error + SPARE)
                    .max(FEWEST)
                    .min(self.most.into());
                u32::try_from(bits).unwrap_or(self.most)
            }
        };
        errors.into_iter().enumerate().map(precision).collect()
    }

    /// Estimates of `log2 |x|`; where a value may be zero, from the operands but for differences,
    /// which may be as small as the next pass can tell from zero.
    fn exponents(&self, end: Id) -> Vec<Option<i64>> {
        let gain = i64::from(self.most) - i64::from(self.before);
        let mut found: Vec<Option<i64>> = Vec::with_capacity(end as usize);
        for id in 0..end {
            let of = |id: Id| found[id as usize];
            let both = |a: Id, b: Id| of(a).zip(of(b));
            let estimate = (self.size)(id).and_then(|size| match (size.lower, size.radius) {
                (Some(lower), _) => Some(lower),
                (None, None) => Some(-FAR),
                (None, Some(radius)) => match self.graph.node(id) {
                    Node::Neg(a) | Node::Unary(Func::Abs, a) => of(a),
                    Node::Mul(a, b) => both(a, b).map(|(a, b)| a + b),
                    Node::Div(a, b) => both(a, b).map(|(a, b)| a - b),
                    Node::Power(a, k) => of(a).map(|a| a * i64::from(k)),
                    Node::Unary(Func::Sqrt, a) => of(a).map(|a| a / 2),
                    Node::Unary(Func::Sin | Func::Cos | Func::Tan, _) if radius >= -8 => Some(-1),
                    _ => Some(radius - gain),
                },
            });
            found.push(estimate.map(|e| e.clamp(-FAR, FAR)));
        }
        found
    }

    /// Hands the request for a node down to its operands, by bounds on the derivatives.
    fn ask_operands(&self, id: Id, exponents: &[Option<i64>], errors: &mut [i64]) {
        let node = self.graph.node(id);
        let error = errors[id as usize];
        let of = |id: Id| exponents[id as usize];
        let mut ask = |id: Id, error: i64| {
            let least = &mut errors[id as usize];
            *least = error.clamp(-FAR, FAR).min(*least);
        };
        // All the bits that there are of a number, and the truth of a condition.
        let all = |id: Id| {
            let upper = (self.size)(id).map(|s| s.upper);
            upper.map_or(FAR, |upper| upper - i64::from(self.most))
        };
        match node {
            Node::Neg(a) | Node::Unary(Func::Abs, a) => return ask(a, error),
            Node::Add(a, b) | Node::Sub(a, b) => {
                ask(a, error - 2);
                return ask(b, error - 2);
            }
            Node::Mul(a, b) => {
                if let Some((x, y)) = of(a).zip(of(b)) {
                    ask(a, error - y - 2);
                    return ask(b, error - x - 2);
                }
            }
            Node::Div(a, b) => {
                if let Some((x, y)) = of(a).zip(of(b)) {
                    ask(a, error + y - 2);
                    return ask(b, error + 2 * y - x - 2);
                }
            }
            Node::Power(a, k) => {
                if let Some((x, y)) = of(a).zip(of(id)) {
                    let factor = i64::from(k.unsigned_abs().max(1).ilog2());
                    return ask(a, error + x - y - factor - 3);
                }
            }
            Node::Unary(f, a) => {
                let asked = match f {
                    Func::Sqrt => of(id).map(|y| error + y),
                    Func::Exp | Func::Cosh => of(id).map(|y| error - y - 2),
                    Func::Expm1 | Func::Sinh => of(id).map(|y| error - y.max(0) - 3),
                    Func::Log => of(a).map(|x| error + x - 2),
                    Func::Sin | Func::Cos | Func::Arctan | Func::Tanh | Func::Erf => {
                        Some(error - 2)
                    }
                    _ => None,
                };
                if let Some(error) = asked {
                    return ask(a, error);
                }
            }
            Node::If(condition, a, b) => {
                ask(condition, FAR);
                ask(a, error);
                return ask(b, error);
            }
            _ => {}
        }
        for operand in self.graph.operands(node) {
            ask(operand, all(operand));
        }
    }
}

//! Working precisions node by node.
//!
//! Where a difference cancels, its operands need many bits and the rest of a formula few. The sizes
//! of all values are known from a pass that was not accurate enough; from the outputs down, each
//! operation asks its operands for the absolute accuracy that its own result needs. The estimates
//! decide how much work is done, not whether a value is right.

use crate::Func;
use crate::graph::{Graph, Id, Node};
use mechaudit_reference::{Ball, Ball128, Mag};

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

impl Size {
    fn new(magnitude: Mag, mignitude: Mag, radius: Mag) -> Size {
        Size {
            upper: magnitude.exponent().map_or(-FAR, |e| e + 1),
            lower: mignitude.exponent(),
            radius: radius.exponent().map(|e| e + 1),
        }
    }

    /// The size of a ball.
    pub fn of(x: &Ball) -> Size {
        Size::new(x.magnitude(), x.mignitude(), x.rad())
    }

    /// The size of a ball of machine words.
    pub fn of_short(x: &Ball128) -> Option<Size> {
        x.to_ball().map(|x| Size::of(&x))
    }
}

/// The requests for accuracy that reach each node.
struct Requests<'a, S> {
    size: &'a S,
    /// The exponents of the errors that are allowed; the largest number if no one asks.
    errors: Vec<i64>,
    most: i64,
}

impl<S: Fn(Id) -> Option<Size>> Requests<'_, S> {
    fn ask(&mut self, id: Id, error: i64) {
        let least = &mut self.errors[id as usize];
        *least = error.clamp(-FAR, FAR).min(*least);
    }

    /// Asks a number for all the bits that there are, and a condition for its truth.
    fn ask_all(&mut self, id: Id) {
        let size = (self.size)(id);
        self.ask(id, size.map_or(FAR, |size| size.upper - self.most));
    }

    /// Hands the request for a node down to its operands.
    fn pass(&mut self, graph: &Graph, id: Id) {
        let node = graph.node(id);
        let error = self.errors[id as usize];
        let size = |id: Id| (self.size)(id);
        let lower = |id: Id| size(id).and_then(|s| s.lower);
        let upper = |id: Id| size(id).map(|s| s.upper);
        // The largest errors of the operands, by bounds on the derivatives.
        let asked: Option<Vec<(Id, i64)>> = match node {
            Node::Neg(a) | Node::Unary(Func::Abs, a) => Some(vec![(a, error)]),
            Node::Add(a, b) | Node::Sub(a, b) => Some(vec![(a, error - 2), (b, error - 2)]),
            Node::Mul(a, b) => upper(a)
                .zip(upper(b))
                .map(|(x, y)| vec![(a, error - y - 2), (b, error - x - 2)]),
            Node::Div(a, b) => upper(a)
                .zip(lower(b))
                .map(|(x, y)| vec![(a, error + y - 2), (b, error + 2 * y - x - 2)]),
            Node::Power(a, k) => lower(a).zip(upper(id)).map(|(x, y)| {
                let k = i64::from(k.unsigned_abs().ilog2()) + 1;
                vec![(a, error + x - y - k - 2)]
            }),
            Node::Unary(Func::Sqrt, a) => lower(id).map(|y| vec![(a, error + y)]),
            Node::Unary(Func::Exp | Func::Cosh, a) => upper(id).map(|y| vec![(a, error - y - 2)]),
            Node::Unary(Func::Expm1 | Func::Sinh, a) => {
                upper(id).map(|y| vec![(a, error - y.max(0) - 3)])
            }
            Node::Unary(Func::Log, a) => lower(a).map(|x| vec![(a, error + x - 2)]),
            Node::Unary(Func::Sin | Func::Cos | Func::Arctan | Func::Tanh | Func::Erf, a) => {
                Some(vec![(a, error - 2)])
            }
            Node::If(_, a, b) => Some(vec![(a, error), (b, error)]),
            _ => None,
        };
        match asked {
            Some(asked) => {
                for (id, error) in asked {
                    self.ask(id, error);
                }
            }
            None => {
                for operand in graph.operands(node) {
                    self.ask_all(operand);
                }
            }
        }
        if let Node::If(condition, ..) = node {
            self.ask_all(condition);
        }
    }
}

/// The precisions of all nodes for a pass with `most` bits after one with `before`; `bits` are to
/// be right in the end.
pub(super) fn precisions(
    graph: &Graph,
    roots: &[Id],
    size: impl Fn(Id) -> Option<Size>,
    bits: u32,
    before: u32,
    most: u32,
) -> Vec<u32> {
    /// Bits that are kept beyond those that are asked for.
    const SPARE: i64 = 8;
    let mut requests = Requests {
        size: &size,
        errors: vec![i64::MAX; graph.len()],
        most: most.into(),
    };
    for root in roots {
        let Some(size) = size(*root) else { continue };
        match (size.lower, size.radius) {
            (Some(lower), _) => requests.ask(*root, lower - i64::from(bits) - SPARE),
            // As many bits more as there are.
            (None, Some(radius)) => {
                requests.ask(*root, radius - i64::from(most) + i64::from(before));
            }
            (None, None) => {}
        }
    }
    for id in (0..graph.len() as Id).rev() {
        if requests.errors[id as usize] != i64::MAX {
            requests.pass(graph, id);
        }
    }
    let errors = requests.errors.iter().enumerate();
    let precision = |(id, &error): (usize, &i64)| match (error, size(id as Id)) {
        // Constants are kept for other inputs.
        _ if !graph.varies(id as Id) => most,
        (i64::MAX, _) | (_, None) => most,
        (error, Some(size)) => {
            let bits = size.upper.saturating_sub(error).saturating_add(SPARE);
            bits.clamp(FEWEST, most.into()) as u32
        }
    };
    errors.map(precision).collect()
}

/// The fewest bits of a midpoint.
const FEWEST: i64 = 64;

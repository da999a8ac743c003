//! Jumps of nodes, across which a derivative proves nothing.

use super::Slope;
use crate::graph::{Graph, Id, Node};
use crate::{Func, SymbolicError};
use std::collections::HashMap;

/// True for functions of a complex number that jump at a cut.
fn has_cut(f: Func) -> bool {
    use Func::*;
    matches!(
        f,
        Log | Log2
            | Log10
            | Log1p
            | Sqrt
            | Cbrt
            | Asin
            | Acos
            | Arctan
            | Asinh
            | Acosh
            | Atanh
            | CosInt
            | Ei
            | ExpInt
            | LambertW
            | Lgamma
            | Arg
    )
}

impl Graph {
    /// The derivative by a bound variable, which is undecided on an interval where the node may
    /// jump: what mean values are proved by.
    pub(in crate::graph) fn slope_off_jumps(
        &mut self,
        root: Id,
        leaf: Id,
    ) -> Result<Id, SymbolicError> {
        let seeds = HashMap::from([(leaf, Some(self.number(1)))]);
        let known = self.slopes(root, &seeds)?;
        let slope = known.get(&root).copied().flatten();
        let jumps = self.jumps(root, &known, |_, _| true);
        let found = self.plus(slope, jumps);
        Ok(found.unwrap_or_else(|| self.number(0)))
    }

    /// Zero where a node does not jump as the leaves of known derivatives vary, and undecided
    /// elsewhere; nothing where it jumps nowhere. Jumps that the derivative itself shows, those of
    /// steps among them, are not repeated.
    pub(super) fn jumps(
        &mut self,
        root: Id,
        known: &HashMap<Id, Slope>,
        is_meant: impl Fn(&Graph, Id) -> bool,
    ) -> Slope {
        let varies = |id: Id| known.get(&id).copied().flatten().is_some();
        let mut sum = None;
        for id in self.reach(root) {
            if !is_meant(self, id) {
                continue;
            }
            let node = self.node(id);
            let flat = match node {
                Node::Compare(_, a, b) if varies(a) || varies(b) => {
                    (Func::Arg, self.push(Node::Sub(a, b)))
                }
                Node::Binary(Func::Copysign, _, b) if varies(b) => (Func::Arg, b),
                Node::Binary(Func::Atan2, y, x) if varies(y) || varies(x) => {
                    let unit = self.push(Node::ImaginaryUnit);
                    let above = self.product(unit, y);
                    (Func::Log, self.push(Node::Add(x, above)))
                }
                Node::Binary(Func::Pow, a, _) if varies(a) && self.is_complex(id) => (Func::Log, a),
                Node::Unary(f, a) if varies(a) && self.is_complex(a) && has_cut(f) => {
                    (if f == Func::Arg { Func::Log } else { f }, a)
                }
                Node::Unary(Func::Arg, a) if varies(a) => (Func::Arg, a),
                _ => continue,
            };
            let flat = self.push(Node::Flat(flat.0, flat.1));
            sum = self.plus(sum, Some(flat));
        }
        sum
    }
}

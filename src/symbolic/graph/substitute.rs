//! Copies of expressions with other nodes in the place of some.

use super::{Binding, Graph, Id, Node};
use crate::SymbolicError;
use crate::error::unsupported;
use std::collections::HashMap;

impl Graph {
    /// The expression with a node in place of an input or a variable.
    ///
    /// # Errors
    /// A binder that is being built.
    pub fn substitute(&mut self, root: Id, leaf: Id, value: Id) -> Result<Id, SymbolicError> {
        self.replaced(root, &HashMap::from([(leaf, value)]))
    }

    /// The expression with nodes in place of others.
    ///
    /// # Errors
    /// A binder that is being built.
    pub(crate) fn replaced(
        &mut self,
        root: Id,
        map: &HashMap<Id, Id>,
    ) -> Result<Id, SymbolicError> {
        let mut known = map.clone();
        let mut loops: HashMap<u32, u32> = HashMap::new();
        for id in self.reach(root) {
            if known.contains_key(&id) {
                continue;
            }
            let r = |a: Id| known.get(&a).copied().unwrap_or(a);
            let node = self.node(id);
            let unchanged = self.operands(node).into_iter().all(|a| r(a) == a);
            let new = match node {
                _ if unchanged => id,
                Node::Neg(a) => self.push(Node::Neg(r(a))),
                Node::Power(a, k) => self.push(Node::Power(r(a), k)),
                Node::Unary(f, a) => self.push(Node::Unary(f, r(a))),
                Node::Flat(f, a) => self.push(Node::Flat(f, r(a))),
                Node::Not(a) => self.push(Node::Not(r(a))),
                Node::Add(a, b) => self.push(Node::Add(r(a), r(b))),
                Node::Sub(a, b) => self.push(Node::Sub(r(a), r(b))),
                Node::Mul(a, b) => self.push(Node::Mul(r(a), r(b))),
                Node::Div(a, b) => self.push(Node::Div(r(a), r(b))),
                Node::Binary(f, a, b) => self.push(Node::Binary(f, r(a), r(b))),
                Node::Compare(f, a, b) => self.push(Node::Compare(f, r(a), r(b))),
                Node::And(a, b) => self.push(Node::And(r(a), r(b))),
                Node::Or(a, b) => self.push(Node::Or(r(a), r(b))),
                Node::Ternary(f, a, b, c) => self.push(Node::Ternary(f, r(a), r(b), r(c))),
                Node::If(a, b, c) => self.push(Node::If(r(a), r(b), r(c))),
                Node::Bound(binder) => {
                    let new = self.rebound(binder, map, &known)?;
                    self.push(Node::Bound(new))
                }
                Node::Last(binder, k) => {
                    let new = match loops.get(&binder) {
                        Some(new) => *new,
                        None => {
                            let new = self.rebound(binder, map, &known)?;
                            loops.insert(binder, new);
                            new
                        }
                    };
                    self.push(Node::Last(new, k))
                }
                Node::Number(_)
                | Node::Constant(_)
                | Node::ImaginaryUnit
                | Node::Infinity
                | Node::Input(_)
                | Node::Variable(..)
                | Node::Truth(_) => id,
            };
            known.insert(id, new);
        }
        Ok(known.get(&root).copied().unwrap_or(root))
    }

    /// A copy of a binder with nodes replaced in its body.
    fn rebound(
        &mut self,
        binder: u32,
        map: &HashMap<Id, Id>,
        known: &HashMap<Id, Id>,
    ) -> Result<u32, SymbolicError> {
        let outer = |a: Id| known.get(&a).copied().unwrap_or(a);
        let old = self.binder(binder).clone();
        let values: Vec<Id> = map.values().copied().collect();
        let depth = old.depth.max(self.depth_above(&values));
        let new = self.open(old.names.clone(), depth);
        let mut inner = map.clone();
        for k in 0..old.names.len() as u32 {
            let variable = self.push(Node::Variable(binder, k));
            let fresh = self.push(Node::Variable(new, k));
            inner.insert(variable, fresh);
        }
        let binding = match old.binding {
            Binding::Sum { from, to, body } => Binding::Sum {
                from: outer(from),
                to: outer(to),
                body: self.replaced(body, &inner)?,
            },
            Binding::Integral { from, to, body } => Binding::Integral {
                from: outer(from),
                to: outer(to),
                body: self.replaced(body, &inner)?,
            },
            Binding::Root {
                from,
                to,
                body,
                slope,
                which,
            } => Binding::Root {
                which,
                from: outer(from),
                to: outer(to),
                body: self.replaced(body, &inner)?,
                slope: self.replaced(slope, &inner)?,
            },
            Binding::Loop {
                condition,
                first,
                next,
            } => {
                let condition = self.replaced(condition, &inner)?;
                let mut updates = Vec::new();
                for x in next {
                    updates.push(self.replaced(x, &inner)?);
                }
                Binding::Loop {
                    condition,
                    first: first.into_iter().map(outer).collect(),
                    next: updates,
                }
            }
            Binding::System {
                starts,
                equations,
                jacobian,
            } => {
                let mut inside = |ids: Vec<Id>| -> Result<Vec<Id>, SymbolicError> {
                    ids.into_iter().map(|x| self.replaced(x, &inner)).collect()
                };
                Binding::System {
                    equations: inside(equations)?,
                    jacobian: inside(jacobian)?,
                    starts: starts.iter().map(|s| s.map(|a| outer(*a))).collect(),
                }
            }
            Binding::Open => return unsupported("a binder that is not closed"),
        };
        self.binders[new as usize].binding = binding;
        Ok(new)
    }
}

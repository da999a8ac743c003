//! A graph of expressions.

use super::{Binding, Graph, Id, Node};
use crate::error::unsupported;
use crate::expr::{Bound, Expr, Loop, Roots};
use crate::walk::{Definitions, Domain, Scope, walk};
use crate::{Constant, Func, Gauss, SymbolicError};
use std::collections::HashMap;

impl Graph {
    /// Adds an expression; returns its node.
    ///
    /// # Errors
    /// [`SymbolicError::NoValue`] for a name that is neither an input nor defined, and what has no
    /// meaning in a graph: formal series, derivatives by what is not a variable.
    pub fn build(&mut self, definitions: &Definitions, e: &Expr) -> Result<Id, SymbolicError> {
        self.build_keeping(definitions, e, &mut HashMap::new())
    }

    /// As [`Graph::build`], with nodes of definitions from before, to which those of others are
    /// added.
    ///
    /// # Errors
    /// As [`Graph::build`].
    pub fn build_keeping(
        &mut self,
        definitions: &Definitions,
        e: &Expr,
        known: &mut HashMap<String, Id>,
    ) -> Result<Id, SymbolicError> {
        let mut builder = Builder { graph: self, known };
        walk(&mut builder, &mut Scope::new(definitions), e)
    }

    /// A function of as many nodes as it has arguments.
    pub(super) fn function(&mut self, f: Func, x: &[Id]) -> Result<Id, SymbolicError> {
        let node = match (x, f.arity()) {
            ([a], 1) => Node::Unary(f, *a),
            ([a, b], 2) => Node::Binary(f, *a, *b),
            ([a, b, c], 3) => Node::Ternary(f, *a, *b, *c),
            _ => return unsupported(format!("{} of {} arguments", f.name(), x.len())),
        };
        Ok(self.push(node))
    }
}

struct Builder<'a> {
    graph: &'a mut Graph,
    /// Nodes of definitions.
    known: &'a mut HashMap<String, Id>,
}

type Built = Result<Id, SymbolicError>;

impl Builder<'_> {
    /// Opens a binder within those around.
    fn open(&mut self, scope: &Scope<Id>, names: Vec<String>) -> u32 {
        let unknowns = self.graph.unknowns.iter();
        let around: Vec<Id> = scope.bound.iter().chain(unknowns).map(|b| b.1).collect();
        let depth = self.graph.depth_above(&around);
        self.graph.open(names, depth)
    }

    /// A sum, an integral or a root: the variable's binder, the limits and the body.
    fn bound(
        &mut self,
        scope: &mut Scope<Id>,
        bound: &Bound,
    ) -> Result<(u32, [Id; 3]), SymbolicError> {
        let [from, to] = [
            walk(self, scope, &bound.from)?,
            walk(self, scope, &bound.to)?,
        ];
        let (binder, body) = self.body(scope, bound)?;
        Ok((binder, [from, to, body]))
    }

    /// A new binder's body.
    fn body(&mut self, scope: &mut Scope<Id>, bound: &Bound) -> Result<(u32, Id), SymbolicError> {
        let binder = self.open(scope, vec![bound.var.clone()]);
        let variable = self.graph.push(Node::Variable(binder, 0));
        let body = scope.binding(&bound.var, variable, |scope| walk(self, scope, &bound.body))?;
        Ok((binder, body))
    }

    /// Returns true if a limit is a number.
    fn is_finite(&self, limit: Id) -> bool {
        let below = match self.graph.node(limit) {
            Node::Neg(a) => a,
            _ => limit,
        };
        self.graph.node(below) != Node::Infinity
    }

    /// The integral from a to b along the segment between them: `(b − a) ∫_0^1 f(a + (b − a) s)
    /// ds`.
    fn along_segment(&mut self, scope: &mut Scope<Id>, bound: &Bound, [a, b]: [Id; 2]) -> Built {
        let binder = self.open(scope, vec![bound.var.clone()]);
        let share = self.graph.push(Node::Variable(binder, 0));
        let way = self.graph.push(Node::Sub(b, a));
        let along = self.graph.push(Node::Mul(way, share));
        let place = self.graph.push(Node::Add(a, along));
        let body = scope.binding(&bound.var, place, |scope| walk(self, scope, &bound.body))?;
        let [from, to] = [0, 1].map(|n| self.graph.number(n));
        let integral = self.close(binder, Binding::Integral { from, to, body });
        Ok(self.graph.push(Node::Mul(way, integral)))
    }

    fn close(&mut self, binder: u32, binding: Binding) -> Id {
        self.graph.binders[binder as usize].binding = binding;
        self.graph.push(Node::Bound(binder))
    }

    fn pair(&mut self, scope: &mut Scope<Id>, parts: &[Expr], of: fn(Id, Id) -> Node) -> Built {
        let mut found: Option<Id> = None;
        for part in parts {
            let part = walk(self, scope, part)?;
            found = Some(match found {
                Some(before) => self.graph.push(of(before, part)),
                None => part,
            });
        }
        Ok(found.unwrap_or_else(|| self.graph.push(Node::Truth(true))))
    }
}

impl Domain for Builder<'_> {
    type V = Id;

    fn constant(&mut self, c: &Gauss) -> Id {
        let re = self.graph.number(c.re.clone());
        if c.im == 0 {
            return re;
        }
        let unit = self.graph.push(Node::ImaginaryUnit);
        let im = match c.im == 1 {
            true => unit,
            false => {
                let im = self.graph.number(c.im.clone());
                self.graph.push(Node::Mul(im, unit))
            }
        };
        match c.re == 0 {
            true => im,
            false => self.graph.push(Node::Add(re, im)),
        }
    }

    fn symbol(&mut self, name: &str) -> Built {
        if let Some(place) = self.graph.inputs.iter().position(|input| input == name) {
            return Ok(self.graph.push(Node::Input(place as u32)));
        }
        if let Some((_, id)) = self.graph.unknowns.iter().find(|u| u.0 == name) {
            return Ok(*id);
        }
        match name {
            "pi" => Ok(self.graph.push(Node::Constant(Constant::Pi))),
            _ if self.graph.takes_any_name => Ok(self.graph.add_input(name.into())),
            _ => Err(SymbolicError::NoValue(name.into())),
        }
    }

    fn infinity(&mut self) -> Built {
        Ok(self.graph.push(Node::Infinity))
    }

    fn named_constant(&mut self, _: &mut Scope<Id>, c: Constant) -> Built {
        Ok(self.graph.push(Node::Constant(c)))
    }

    fn add(&mut self, a: &Id, b: &Id) -> Id {
        self.graph.push(Node::Add(*a, *b))
    }

    fn sub(&mut self, a: &Id, b: &Id) -> Id {
        self.graph.push(Node::Sub(*a, *b))
    }

    fn neg(&mut self, a: &Id) -> Id {
        self.graph.push(Node::Neg(*a))
    }

    fn mul(&mut self, a: &Id, b: &Id) -> Id {
        self.graph.push(Node::Mul(*a, *b))
    }

    fn div(&mut self, a: &Id, b: &Id) -> Built {
        Ok(self.graph.push(Node::Div(*a, *b)))
    }

    fn power(&mut self, x: &Id, k: i32) -> Built {
        Ok(self.graph.push(Node::Power(*x, k)))
    }

    fn call(&mut self, f: Func, x: &[Id]) -> Built {
        self.graph.function(f, x)
    }

    fn integral(&mut self, scope: &mut Scope<Id>, bound: &Bound) -> Built {
        let limits = [
            walk(self, scope, &bound.from)?,
            walk(self, scope, &bound.to)?,
        ];
        // An integral with constant limits is continued to complex values of what its integrand
        // depends on.
        let is_complex = limits.iter().any(|limit| self.graph.is_complex(*limit));
        let moves = self.graph.depth_above(&limits) > 0;
        if (is_complex || moves) && limits.iter().all(|limit| self.is_finite(*limit)) {
            return self.along_segment(scope, bound, limits);
        }
        let (binder, body) = self.body(scope, bound)?;
        let [from, to] = limits;
        Ok(self.close(binder, Binding::Integral { from, to, body }))
    }

    fn sum(&mut self, scope: &mut Scope<Id>, bound: &Bound) -> Built {
        // A name with an index is another name for each index.
        if scope
            .definitions
            .any(&bound.body, |e| matches!(e, Expr::Index(..)))
        {
            return crate::walk::finite_sum(self, scope, bound);
        }
        let (binder, [from, to, body]) = self.bound(scope, bound)?;
        Ok(self.close(binder, Binding::Sum { from, to, body }))
    }

    fn root(&mut self, scope: &mut Scope<Id>, bound: &Bound, which: Roots) -> Built {
        let (binder, [from, to, body]) = self.bound(scope, bound)?;
        let variable = self.graph.push(Node::Variable(binder, 0));
        let slope = self.graph.slope_off_jumps(body, variable)?;
        let binding = Binding::Root {
            from,
            to,
            body,
            slope,
            which,
        };
        Ok(self.close(binder, binding))
    }

    fn condition(&mut self, scope: &mut Scope<Id>, e: &Expr) -> Built {
        match e {
            Expr::Truth(t) => Ok(self.graph.push(Node::Truth(*t))),
            Expr::Not(x) => {
                let x = walk(self, scope, x)?;
                Ok(self.graph.push(Node::Not(x)))
            }
            Expr::And(parts) => self.pair(scope, parts, Node::And),
            Expr::Or(parts) => self.pair(scope, parts, Node::Or),
            Expr::Compare(relation, parts) => {
                let parts: Result<Vec<Id>, _> =
                    parts.iter().map(|x| walk(self, scope, x)).collect();
                let parts = parts?;
                let mut all: Option<Id> = None;
                for pair in parts.windows(2) {
                    let this = self.graph.push(Node::Compare(*relation, pair[0], pair[1]));
                    all = Some(match all {
                        Some(before) => self.graph.push(Node::And(before, this)),
                        None => this,
                    });
                }
                Ok(all.unwrap_or_else(|| self.graph.push(Node::Truth(true))))
            }
            e => unsupported(format!("the condition {e}")),
        }
    }

    fn choose(&mut self, scope: &mut Scope<Id>, parts: &[Expr; 3]) -> Built {
        let [condition, a, b] = parts;
        let condition = walk(self, scope, condition)?;
        let (a, b) = (walk(self, scope, a)?, walk(self, scope, b)?);
        Ok(self.graph.push(Node::If(condition, a, b)))
    }

    fn repeat(&mut self, scope: &mut Scope<Id>, repeated: &Loop) -> Built {
        let outside = scope.bound.len();
        let mut first = Vec::new();
        for (name, start, _) in &repeated.variables {
            let start = walk(self, scope, start)?;
            if repeated.sequential {
                scope.bound.push((name.clone(), start));
            }
            first.push(start);
        }
        scope.bound.truncate(outside);
        let names: Vec<String> = repeated.variables.iter().map(|v| v.0.clone()).collect();
        let binder = self.open(scope, names.clone());
        for (k, name) in names.iter().enumerate() {
            let variable = self.graph.push(Node::Variable(binder, k as u32));
            scope.bound.push((name.clone(), variable));
        }
        let condition = walk(self, scope, &repeated.condition)?;
        let mut next = Vec::new();
        for (k, (name, _, update)) in repeated.variables.iter().enumerate() {
            let update = walk(self, scope, update)?;
            // The updates after it see the new value.
            if repeated.sequential {
                scope.bound[outside + k] = (name.clone(), update);
            }
            next.push(update);
        }
        scope.bound.truncate(outside);
        self.graph.binders[binder as usize].binding = Binding::Loop {
            condition,
            first,
            next,
        };
        for (k, name) in names.into_iter().enumerate() {
            let last = self.graph.push(Node::Last(binder, k as u32));
            scope.bound.push((name, last));
        }
        let body = walk(self, scope, &repeated.body);
        scope.bound.truncate(outside);
        body
    }

    fn derivative(&mut self, scope: &mut Scope<Id>, body: &Expr, by: &str) -> Built {
        let bound = scope.bound.iter().rev().find(|b| b.0 == by).map(|b| b.1);
        let leaf = match bound {
            Some(id) => id,
            None => self.symbol(by)?,
        };
        if !matches!(self.graph.node(leaf), Node::Input(_) | Node::Variable(..)) {
            return unsupported(format!("a derivative by {by}, which has a value here"));
        }
        let body = walk(self, scope, body)?;
        let slope = self.graph.derivative(body, leaf)?;
        let is_real = self.graph.is_real_function;
        let nothing = is_real.then(|| self.graph.nothing(body)).flatten();
        Ok(match nothing {
            Some(nothing) => self.graph.push(Node::Add(slope, nothing)),
            None => slope,
        })
    }

    fn at(&mut self, scope: &mut Scope<Id>, body: &Expr, symbol: &str, value: Id) -> Built {
        // The body may differentiate by the symbol: the value is put in afterwards.
        let binder = self.open(scope, vec![symbol.into()]);
        let variable = self.graph.push(Node::Variable(binder, 0));
        let body = scope.binding(symbol, variable, |scope| walk(self, scope, body))?;
        self.graph.substitute(body, variable, value)
    }

    fn recall(&mut self, name: &str) -> Option<Id> {
        self.known.get(name).copied()
    }

    fn keep(&mut self, _: &Definitions, name: &str, value: &Id) {
        self.known.insert(name.into(), *value);
    }
}

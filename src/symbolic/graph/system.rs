//! Systems of equations whose solution is a part of expressions.

use super::derivative::Slope;
use super::{BinderId, Binding, Graph, Id, Node};
use crate::error::unsupported;
use crate::{Definitions, Expr, SymbolicError};
use std::collections::HashMap;

/// Where an unknown of a system is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start<T> {
    /// Near a number, from which Newton's method starts.
    Near(T),
    /// Between two numbers.
    Between(T, T),
}

impl<T> Start<T> {
    /// The numbers.
    pub fn parts(&self) -> impl Iterator<Item = &T> {
        let (a, b) = match self {
            Start::Near(a) => (a, None),
            Start::Between(a, b) => (a, Some(b)),
        };
        std::iter::once(a).chain(b)
    }

    /// Applies a function to the numbers.
    pub fn map<U>(&self, to: impl Fn(&T) -> U) -> Start<U> {
        match self {
            Start::Near(a) => Start::Near(to(a)),
            Start::Between(a, b) => Start::Between(to(a), to(b)),
        }
    }
}

impl Graph {
    /// Adds a system of as many equations as unknowns, given by expressions that are zero at the
    /// solution. Expressions that are built afterwards may use the unknowns by their names.
    ///
    /// # Errors
    /// As [`Graph::build`], and an equation that is complex or a condition, or whose derivatives
    /// are not in the language.
    pub fn solve(
        &mut self,
        definitions: &Definitions,
        unknowns: &[(String, Start<Expr>)],
        equations: &[Expr],
    ) -> Result<(), SymbolicError> {
        let mut starts = Vec::new();
        for (_, start) in unknowns {
            let mut part = |e: &Expr| self.build(definitions, e);
            starts.push(match start {
                Start::Near(at) => Start::Near(part(at)?),
                Start::Between(low, high) => Start::Between(part(low)?, part(high)?),
            });
        }
        let names: Vec<String> = unknowns.iter().map(|u| u.0.clone()).collect();
        let binder = self.open(names.clone(), 0);
        let n = names.len() as u32;
        let variables: Vec<Id> = (0..n)
            .map(|k| self.push(Node::Variable(binder, k)))
            .collect();
        self.unknowns = names
            .iter()
            .cloned()
            .zip(variables.iter().copied())
            .collect();
        let (mut bodies, mut jacobian) = (Vec::new(), Vec::new());
        for equation in equations {
            let body = self.build(definitions, equation)?;
            if self.is_complex(body) || self.is_condition(body) {
                return unsupported(format!(
                    "the equation {equation}, which is not one of numbers"
                ));
            }
            bodies.push(body);
        }
        for body in &bodies {
            for variable in &variables {
                jacobian.push(self.slope_off_jumps(*body, *variable)?);
            }
        }
        self.binders[binder as usize].binding = Binding::System {
            starts,
            equations: bodies,
            jacobian,
        };
        let solutions = (0..n).map(|k| self.push(Node::Last(binder, k)));
        let solutions: Vec<Id> = solutions.collect();
        self.unknowns = names.into_iter().zip(solutions).collect();
        Ok(())
    }

    /// The derivatives of the unknowns, as the unknowns of the linear system that they satisfy:
    /// F(x, p) = 0, so that F_x x′ = −F_p.
    pub(super) fn system_slope(
        &mut self,
        binder: BinderId,
        seeds: &HashMap<Id, Slope>,
    ) -> Result<(BinderId, u32), SymbolicError> {
        let old = self.binder(binder).clone();
        let Binding::System {
            equations,
            jacobian,
            ..
        } = old.binding
        else {
            return unsupported("the derivative of what is no system");
        };
        let n = old.names.len() as u32;
        let (mut inner, mut map) = (seeds.clone(), HashMap::new());
        for k in 0..n {
            let variable = self.push(Node::Variable(binder, k));
            let solution = self.push(Node::Last(binder, k));
            inner.insert(variable, None);
            map.insert(variable, solution);
        }
        let mut direct = Vec::new();
        for equation in &equations {
            direct.push(match self.slope(*equation, &inner)? {
                Some(slope) => self.replaced(slope, &map)?,
                None => self.number(0),
            });
        }
        let mut matrix = Vec::new();
        for entry in jacobian {
            matrix.push(self.replaced(entry, &map)?);
        }
        let names = old.names.iter().map(|name| format!("{name}'")).collect();
        let new = self.open(names, old.depth);
        let mut bodies = Vec::new();
        for (row, direct) in matrix.chunks(n as usize).zip(direct) {
            let mut sum = direct;
            for (k, entry) in row.iter().enumerate() {
                let variable = self.push(Node::Variable(new, k as u32));
                let term = self.push(Node::Mul(*entry, variable));
                sum = self.push(Node::Add(sum, term));
            }
            bodies.push(sum);
        }
        let zero = self.number(0);
        self.binders[new as usize].binding = Binding::System {
            starts: vec![Start::Near(zero); n as usize],
            equations: bodies,
            jacobian: matrix,
        };
        Ok((new, 0))
    }
}

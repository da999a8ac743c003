//! The names that formulas may use.

use crate::{
    Definitions, Equation, Expr, SymbolicError, parse, parse_declared, parse_declared_equation,
    parse_equation,
};
use std::collections::BTreeSet;
use std::sync::Arc;

/// Declared names; without a declaration every name is a symbol.
#[derive(Clone, Debug, Default)]
pub struct Names(Option<Arc<BTreeSet<String>>>);

impl Names {
    /// These names alone.
    pub fn declared(names: impl IntoIterator<Item = String>) -> Names {
        Names(Some(Arc::new(names.into_iter().collect())))
    }

    /// The names with further ones.
    #[must_use]
    pub fn with(&self, more: impl IntoIterator<Item = String>) -> Names {
        let extended =
            |names: &Arc<BTreeSet<String>>| Arc::new(names.iter().cloned().chain(more).collect());
        Names(self.0.as_ref().map(extended))
    }

    /// The declared names.
    pub fn all(&self) -> Vec<String> {
        self.0
            .iter()
            .flat_map(|names| names.iter().cloned())
            .collect()
    }

    /// Reads an expression.
    ///
    /// # Errors
    /// As [`parse()`]; a name that is not declared.
    pub fn expression(&self, text: &str) -> Result<Expr, SymbolicError> {
        match &self.0 {
            Some(names) => parse_declared(text, &|name| names.contains(name)),
            None => parse(text),
        }
    }

    /// Reads an equation.
    ///
    /// # Errors
    /// As [`Names::expression`].
    pub fn equation(&self, text: &str) -> Result<Equation, SymbolicError> {
        match &self.0 {
            Some(names) => parse_declared_equation(text, &|name| names.contains(name)),
            None => parse_equation(text),
        }
    }

    /// Reads definitions, `name = expression` or `t: x = expression`.
    ///
    /// # Errors
    /// As [`Names::expression`].
    pub fn definitions(&self, lines: &[&str]) -> Result<Definitions, SymbolicError> {
        Definitions::read_with(lines, &|text| self.expression(text))
    }
}

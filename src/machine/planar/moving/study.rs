//! The motion as a study: whatever takes a study takes a mechanism that moves.

use super::equations::Equations;
use super::laws::TIME;
use super::{Moving, MovingError, Row};
use crate::audit::Limit;
use crate::machine::Source;
use crate::study::{
    InitialValue, Problem, Spacing, Study, StudyError, StudyInput, StudyOutput, StudySystem,
};
use mechaudit_symbolic::evaluation::State;
use mechaudit_symbolic::graph::Start;
use mechaudit_symbolic::{Definitions, Expr, SymbolicError, parse_declared};
use rug::Rational;
use std::collections::HashSet;

/// The error of a quantity that passes where it is judged, in its unit.
const BUDGET: f64 = 1e-6;

/// The end of the range of times from which cases are drawn, in seconds.
const UNTIL: u32 = 10;

/// Reads a formula in which the declared names stand for themselves.
pub(super) fn read(text: &str, names: &HashSet<&str>) -> Result<Expr, SymbolicError> {
    parse_declared(text, &|name| names.contains(name))
}

impl Equations {
    /// Returns the names that formulas may use.
    pub(super) fn declared(&self) -> HashSet<&str> {
        let own = self.definitions.iter().map(|d| &d.0);
        let names = own.chain(self.given.iter().map(|g| &g.0));
        let names = names.chain(self.states.iter().map(|s| &s.name));
        let names = names.chain(self.unknowns.iter().map(|u| &u.0));
        names.map(String::as_str).chain([TIME]).collect()
    }

    /// Returns the intermediate results, parameters and formulas by their names.
    ///
    /// # Errors
    /// [`SymbolicError`] for a formula without meaning.
    pub(super) fn defined(&self) -> Result<Definitions, SymbolicError> {
        let names = self.declared();
        let mut definitions = Definitions::default();
        for (name, text) in &self.definitions {
            definitions.set(name, read(text, &names)?);
        }
        for (name, value) in &self.given {
            definitions.set(name, value.clone());
        }
        Ok(definitions)
    }

    /// Returns the system of equations of the start.
    ///
    /// # Errors
    /// [`SymbolicError`] for a formula without meaning.
    pub(super) fn system(&self) -> Result<StudySystem, SymbolicError> {
        let names = self.declared();
        let mut unknowns = Vec::new();
        for (name, near) in &self.unknowns {
            let near = read(&format!("({near})"), &names)?;
            unknowns.push((name.clone(), Start::Near(near)));
        }
        let equations = self.equations.iter().map(|e| read(e, &names));
        Ok(StudySystem {
            unknowns,
            equations: equations.collect::<Result<_, _>>()?,
        })
    }

    /// Returns the initial value problem, without outputs.
    fn problem(&self) -> Result<Problem, SymbolicError> {
        let names = self.declared();
        let mut states = Vec::new();
        for state in &self.states {
            let (start, rate) = (read(&state.start, &names)?, read(&state.rate, &names)?);
            states.push(State::new(state.name.clone(), start, rate));
        }
        Ok(Problem {
            inputs: vec![StudyInput {
                name: TIME.into(),
                unit: "s".into(),
                from: Some(Rational::new()),
                to: Some(UNTIL.into()),
                spacing: Spacing::Linear,
            }],
            definitions: self.defined()?,
            system: (!self.unknowns.is_empty())
                .then(|| self.system())
                .transpose()?,
            initial_value: Some(InitialValue {
                times: Vec::new(),
                start: Rational::new(),
                states,
            }),
            ..Problem::default()
        })
    }
}

impl Moving {
    /// Returns the motion as a study: its input is the time in seconds, its outputs are
    /// [`Moving::quantities`], each with a budget of 1e-6 of its unit.
    ///
    /// # Errors
    /// [`MovingError`]: no start, or numbers that are not exact.
    pub fn study(&self, name: &str) -> Result<Study, MovingError> {
        let fault = |e: &dyn std::fmt::Display| MovingError::NotExact(e.to_string());
        let equations = self.equations(&Row::Motion { reactions: false })?;
        let mut problem = equations.problem().map_err(|e| fault(&e))?;
        problem.name = name.into();
        problem.title = self.name.clone().unwrap_or_else(|| "mechanism".into());
        problem.source = "the equations of motion of the mechanism".into();
        let names = equations.declared();
        let quantities = self.quantities(false)?;
        for (quantity, text) in quantities.into_iter().zip(&equations.outputs) {
            problem.outputs.push(StudyOutput {
                name: quantity.name,
                unit: quantity.unit.into(),
                is: read(text, &names).map_err(|e| fault(&e))?,
                text: quantity.text,
                proved: None,
                budget: (
                    Limit::Absolute(BUDGET),
                    "none is stated: a millionth of the unit".into(),
                ),
            });
        }
        Study::new(problem).map_err(|e| fault(&e))
    }

    /// Reads a description of a mechanism as a study.
    ///
    /// # Errors
    /// The line and the rule that the text breaks.
    pub fn read_study(source: &Source, name: &str) -> Result<Study, StudyError> {
        let moving = Moving::read(source).map_err(|e| StudyError::new(e.to_string()))?;
        let study = moving.study(name);
        study.map_err(|e| StudyError::new(e.to_string()))
    }
}

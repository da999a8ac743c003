//! A study of one formula, built in code.

use super::problem::{Problem, StudyCondition, StudyInput, StudyOutput, default_budget};
use super::{Study, StudyError};
use crate::audit::{Limit, SolverAnswer};
use crate::candidate::{Audit, AuditError, IntoAnswer, Report};
use mechaudit_symbolic::parse_declared;
use rug::Rational;
use std::ops::RangeInclusive;

/// A budget of k units in the last place.
pub fn ulps(k: f64) -> Limit {
    Limit::Ulps(k)
}

/// A budget of `k u (1 + condition)`.
pub fn conditioned(k: f64) -> Limit {
    Limit::Conditioned(k)
}

/// A budget of a relative error.
pub fn relative(r: f64) -> Limit {
    Limit::Relative(r)
}

/// A budget of an absolute error.
pub fn absolute(a: f64) -> Limit {
    Limit::Absolute(a)
}

/// A study of one formula that is being built: see [`Study::formula`].
#[derive(Clone, Debug)]
#[must_use = "nothing is audited before a candidate is given"]
pub struct Formula {
    text: String,
    inputs: Vec<StudyInput>,
    condition: Option<String>,
    budget: (Limit, String),
    cases: Option<u64>,
    seed: u64,
}

impl Formula {
    pub(super) fn new(text: &str) -> Formula {
        Formula {
            text: text.into(),
            inputs: Vec::new(),
            condition: None,
            budget: default_budget(),
            cases: None,
            seed: 1,
        }
    }

    /// Adds an input with its range. An end that is not finite leaves that side open.
    pub fn input(mut self, name: &str, range: RangeInclusive<f64>) -> Formula {
        let mut input = StudyInput::any(name);
        input.from = Rational::from_f64(*range.start());
        input.to = Rational::from_f64(*range.end());
        self.inputs.push(input);
        self
    }

    /// Restricts the inputs by a condition: `a < b`.
    pub fn condition(mut self, condition: &str) -> Formula {
        self.condition = Some(condition.into());
        self
    }

    /// The budget of the candidate.
    pub fn budget(mut self, limit: Limit) -> Formula {
        self.budget = (limit, "stated by the test".into());
        self
    }

    /// The number of random cases in each region.
    pub fn cases(mut self, cases: u64) -> Formula {
        self.cases = Some(cases);
        self
    }

    /// The key of the random stream, 1 by default.
    pub fn seed(mut self, seed: u64) -> Formula {
        self.seed = seed;
        self
    }

    /// The study.
    ///
    /// # Errors
    /// A formula that cannot be read, an empty range, a budget that is not positive.
    pub fn study(&self) -> Result<Study, StudyError> {
        if !self.budget.0.is_sound() {
            let budget = self.budget.0;
            return Err(StudyError::new(format!(
                "the budget {budget} is not finite and positive"
            )));
        }
        if let Some(input) = self
            .inputs
            .iter()
            .find(|i| matches!((&i.from, &i.to), (Some(a), Some(b)) if a > b))
        {
            return Err(StudyError::new(format!(
                "the range of {} is empty",
                input.name
            )));
        }
        let known = |name: &str| self.inputs.iter().any(|i| i.name == name);
        if known("inf") {
            return Err(StudyError::new(super::read::INFINITY));
        }
        let names: Vec<String> = self.inputs.iter().map(|i| i.name.clone()).collect();
        let place = super::Place { line: 1, column: 0 };
        let read = |text: &str| {
            parse_declared(text, &known).map_err(|e| super::problem::fault_in(e, place, &names))
        };
        let is = read(&self.text)?;
        let condition = self.condition.as_deref().map(read).transpose()?;
        let condition = condition.map(|is| StudyCondition { is, place: None });
        Study::new(Problem {
            name: "formula".into(),
            title: self.text.clone(),
            source: "a formula in code".into(),
            inputs: self.inputs.clone(),
            outputs: vec![StudyOutput {
                name: "value".into(),
                unit: "1".into(),
                is,
                text: self.text.clone(),
                budget: self.budget.clone(),
                proved: None,
            }],
            condition,
            ..Problem::default()
        })
    }

    fn run<'a>(
        &self,
        candidate: impl Fn(&[f64]) -> SolverAnswer + Sync + 'a,
    ) -> Result<Report, AuditError> {
        let mut audit = self.study()?.audit(candidate).seed(self.seed);
        if let Some(cases) = self.cases {
            audit = audit.cases(cases);
        }
        audit.run()
    }

    /// Audits a function of the one input.
    ///
    /// # Errors
    /// As [`Formula::study`], and a formula of another number of inputs.
    pub fn audit(self, candidate: impl Fn(f64) -> f64 + Sync) -> Result<Report, AuditError> {
        self.takes(1)?;
        self.run(|x| SolverAnswer::Values(vec![candidate(x[0])]))
    }

    /// Audits a function of the two inputs.
    ///
    /// # Errors
    /// As [`Formula::audit`].
    pub fn audit2(self, candidate: impl Fn(f64, f64) -> f64 + Sync) -> Result<Report, AuditError> {
        self.takes(2)?;
        self.run(|x| SolverAnswer::Values(vec![candidate(x[0], x[1])]))
    }

    /// Audits a function of all inputs in the order in which they were added.
    ///
    /// # Errors
    /// As [`Formula::study`].
    pub fn audit_slice<R: IntoAnswer>(
        self,
        candidate: impl Fn(&[f64]) -> R + Sync,
    ) -> Result<Report, AuditError> {
        self.run(|x| candidate(x).into_answer())
    }

    fn takes(&self, n: usize) -> Result<(), StudyError> {
        match self.inputs.len() == n {
            true => Ok(()),
            false => Err(StudyError::new(format!(
                "a candidate of {n} arguments for a formula of {} inputs",
                self.inputs.len()
            ))),
        }
    }
}

impl Study {
    /// Audits somebody's code in place of a solver: a function from all inputs to all outputs.
    pub fn audit<'a, R: IntoAnswer>(
        self,
        candidate: impl Fn(&[f64]) -> R + Sync + 'a,
    ) -> Audit<'a> {
        Audit::new(Box::new(self), move |x| candidate(x).into_answer())
    }
}

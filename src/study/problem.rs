//! A problem: inputs, the definitions of its outputs, budgets and solvers.

use super::error::{Place, StudyError};
use crate::audit::{Budget, Limit};
use mechaudit_symbolic::evaluation::{Elementary, Format};
use mechaudit_symbolic::graph::Start;
use mechaudit_symbolic::{Definitions, Expr};
use rug::Rational;

/// How an input is spaced between its ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// Evenly.
    #[default]
    Linear,
    /// Evenly in the logarithm of the magnitude.
    Log,
}

/// An input.
#[derive(Clone, Debug)]
pub struct StudyInput {
    /// Its name.
    pub name: String,
    /// Its unit, `1` if none.
    pub unit: String,
    /// The lower end; none where every number below is meant.
    pub from: Option<Rational>,
    /// The upper end.
    pub to: Option<Rational>,
    /// The spacing.
    pub spacing: Spacing,
}

impl StudyInput {
    /// An input that takes every finite number.
    pub(super) fn any(name: &str) -> StudyInput {
        StudyInput {
            name: name.into(),
            unit: "1".into(),
            from: None,
            to: None,
            spacing: Spacing::default(),
        }
    }
}

/// An output.
#[derive(Clone, Debug)]
pub struct StudyOutput {
    /// Its name.
    pub name: String,
    /// Its unit, `1` if none.
    pub unit: String,
    /// The definition of its value.
    pub is: Expr,
    /// The text of its definition.
    pub text: String,
    /// The largest error that passes, and the reason for it.
    pub budget: (Limit, String),
    /// Where the file says that the budget is what is proved of the solver.
    pub proved: Option<Place>,
}

/// A system of equations.
#[derive(Clone, Debug)]
pub struct StudySystem {
    /// The unknowns, and where they are sought.
    pub unknowns: Vec<(String, Start<Expr>)>,
    /// As many expressions, which are zero at the solution.
    pub equations: Vec<Expr>,
}

/// A condition on the inputs.
#[derive(Clone, Debug)]
pub struct StudyCondition {
    /// Holds at the inputs that are meant.
    pub is: Expr,
    /// Where the file states it.
    pub place: Option<Place>,
}

/// A part of the domain.
#[derive(Clone, Debug)]
pub struct StudyRegion {
    /// Its name.
    pub name: String,
    /// Inputs with other ends than their own.
    pub inputs: Vec<StudyInput>,
    /// A condition on the inputs.
    pub condition: Option<StudyCondition>,
}

/// A solver that the file states.
#[derive(Clone, Debug)]
pub struct StudySolver {
    /// Its name.
    pub name: String,
    /// The formula of each output in the order of outputs.
    pub formulas: Vec<Expr>,
    /// Names in its formulas.
    pub definitions: Definitions,
    /// The format it computes in.
    pub format: Format,
    /// Whose elementary functions it takes.
    pub elementary: Elementary,
}

/// A problem as it is read.
#[derive(Clone, Debug, Default)]
pub struct Problem {
    /// The name in reports.
    pub name: String,
    /// One line in plain words.
    pub title: String,
    /// Where it comes from.
    pub source: String,
    /// Inputs in the order of the file.
    pub inputs: Vec<StudyInput>,
    /// Names with their definitions, parameters among them.
    pub definitions: Definitions,
    /// Names that take an index: `a` where `a_1` and `a_2` are defined.
    pub lists: Vec<String>,
    /// Outputs in the order of the file.
    pub outputs: Vec<StudyOutput>,
    /// A condition on all inputs.
    pub condition: Option<StudyCondition>,
    /// Parts of the domain.
    pub regions: Vec<StudyRegion>,
    /// Solvers in the order of the file.
    pub solvers: Vec<StudySolver>,
    /// A system of equations whose unknowns outputs may use.
    pub system: Option<StudySystem>,
    /// An initial value problem whose states are outputs, and which other outputs may use.
    pub initial_value: Option<super::initial_value::InitialValue>,
    /// A problem of linear algebra, in the place of formulas of the outputs.
    pub linear: Option<super::linear::Linear>,
    /// Remarks for the report: names that hide constants, formulas that are not independent.
    pub notes: Vec<String>,
}

impl Problem {
    /// The times of whole trajectories, each of which is one answer; none where the time is an
    /// input.
    pub fn times(&self) -> &[Rational] {
        self.initial_value
            .as_ref()
            .map_or(&[], |problem| &problem.times)
    }

    /// The inputs of an answer: all but the time, where an answer is a whole trajectory.
    pub fn given(&self) -> &[StudyInput] {
        match self.times() {
            [] => &self.inputs,
            _ => &self.inputs[..self.inputs.len() - 1],
        }
    }

    /// The names that a solver defines otherwise than the study, inputs and constants among them.
    pub fn redefined<'a>(&'a self, solver: &'a StudySolver) -> impl Iterator<Item = &'a String> {
        let stated = &self.definitions.names;
        let own = solver.definitions.names.iter();
        own.filter(|(name, is)| stated.get(*name) != Some(is))
            .map(|(name, _)| name)
    }

    /// The inputs of each row of an answer.
    pub(super) fn of_rows<T: Clone>(
        &self,
        given: &[T],
        time: impl Fn(&Rational) -> T,
    ) -> Vec<Vec<T>> {
        let rows = self.times().iter();
        let rows: Vec<Vec<T>> = rows
            .map(|t| given.iter().cloned().chain([time(t)]).collect())
            .collect();
        match rows.is_empty() {
            true => vec![given.to_vec()],
            false => rows,
        }
    }
}

/// The budget of an output that states none.
pub(super) fn default_budget() -> (Limit, String) {
    let reason = "none is stated: eight roundings of a backward stable formula";
    (Limit::Conditioned(8.0), reason.into())
}

/// Reads a limit: `2 ulp`, `4 u(1+cond)`, `1e-12 relative`, `1e-9 absolute`.
///
/// # Errors
/// A text of another form, and a number that is not finite and positive.
pub fn limit(text: &str) -> Result<Limit, StudyError> {
    let compact: String = text.chars().filter(|c| !c.is_whitespace()).collect();
    type OfNumber = fn(f64) -> Limit;
    let forms: [(&str, OfNumber); 8] = [
        ("ulps", Limit::Ulps),
        ("ulp", Limit::Ulps),
        ("u(1+cond)", Limit::Conditioned),
        ("u*(1+cond)", Limit::Conditioned),
        ("u(1+condition)", Limit::Conditioned),
        ("relative", Limit::Relative),
        ("absolute", Limit::Absolute),
        ("u", |k| Limit::Relative(k * f64::EPSILON / 2.0)),
    ];
    let found = forms.iter().find_map(|(unit, limit)| {
        let number = compact
            .strip_suffix(unit)
            .or_else(|| compact.strip_prefix(unit))?;
        number.parse::<f64>().ok().map(limit)
    });
    match found {
        Some(limit) if limit.is_sound() => Ok(limit),
        Some(_) => Err(StudyError::new(format!(
            "the budget {text:?} is not finite and positive"
        ))),
        None => Err(StudyError::new(format!(
            "the budget {text:?} is none of: \"2 ulp\", \"4 u(1+cond)\", \"1e-12 relative\", \"1e-9 absolute\""
        ))),
    }
}

/// The budget of an output, its texts kept for good.
pub(super) fn kept(budget: &(Limit, String)) -> Budget {
    Budget::new(budget.0, intern(&budget.1))
}

/// The same text with the life of the program: methods name their parts so. Every text is kept
/// once.
pub fn intern(text: &str) -> &'static str {
    use std::collections::BTreeSet;
    use std::sync::Mutex;
    static KEPT: Mutex<BTreeSet<&'static str>> = Mutex::new(BTreeSet::new());
    let mut kept = KEPT
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    match kept.get(text) {
        Some(known) => known,
        None => {
            let new: &'static str = Box::leak(text.to_string().into_boxed_str());
            kept.insert(new);
            new
        }
    }
}

/// A fault of an expression within a string that begins at a place.
pub fn fault_in(
    error: mechaudit_symbolic::SymbolicError,
    place: Place,
    known: &[String],
) -> StudyError {
    use mechaudit_symbolic::SymbolicError as E;
    // The string's own quotation mark comes first.
    let there = |at: usize| Place {
        line: place.line,
        column: place.column + 1 + at,
    };
    match error {
        E::Parse { at, reason } => StudyError::new(reason).at(there(at)),
        E::Unknown { at, name } => {
            let hint = crate::audit::did_you_mean(&name, known);
            let reason = format!("the name {name} is not declared{hint}");
            StudyError::new(reason).at(there(at))
        }
        other => StudyError::new(other.to_string()).at(place),
    }
}

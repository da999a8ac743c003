//! Studies: problems that users bring as text, certified and audited like the built-in methods.
//!
//! A [`Study`] states inputs, what outputs mean mathematically, and how accurate answers have to
//! be. It is a [`Method`](crate::audit::Method): whatever takes a method takes a study. Its
//! references are balls with proved radii, at a precision that is raised until the value is
//! decided; where balls cannot decide that a value is zero, the symbolic algebra is asked.
//!
//! # A formula in a test
//! ```
//! use mechaudit::study::{Study, ulps};
//!
//! let report = Study::formula("log(1 + x) - x")
//!     .input("x", 1e-8..=1.0)
//!     .budget(ulps(16.0))
//!     .audit(|x: f64| {
//!         // A series where the difference cancels.
//!         if x > 0.1 { return x.ln_1p() - x; }
//!         let terms = (2..30).rev();
//!         terms.fold(0.0, |s, n| x * (s + if n % 2 == 0 { -1.0 } else { 1.0 } / f64::from(n))) * x
//!     })?;
//! report.assert_within_budget();
//! # Ok::<(), mechaudit::candidate::AuditError>(())
//! ```
//!
//! # A file
//! ```
//! use mechaudit::study::Study;
//! use rug::Rational;
//!
//! let study = Study::parse(
//!     r#"
//!     [inputs]
//!     M = { from = 0, to = 3 }
//!     e = { from = 0, to = 0.9 }
//!     [outputs]
//!     E = { root_of = "E - e*sin(E) - M", between = ["M - e", "M + e"], budget = "4 ulp" }
//!     "#,
//!     "kepler",
//! )?;
//! let digits = study.digits(&[Rational::from(1), Rational::from((1, 2))], 25);
//! assert_eq!(digits[0].decimal.as_deref(), Some("1.498701133517848314057985"));
//! # Ok::<(), mechaudit::study::StudyError>(())
//! ```
//!
//! # Systems of equations
//! `[system]` states unknowns and as many equations, which may use inputs, parameters and `[let]`;
//! outputs may use the unknowns, and are the unknowns where there is no `[outputs]`. Where every
//! unknown has `between`, the only solution in that box is found and proved to be; elsewhere
//! Newton's method starts near the numbers given (in the middle of a range), and the solution it
//! finds is proved to be the only one around it. A solution outside of a range that is stated is
//! undecided.
//! ```
//! # use mechaudit::study::Study;
//! let study = Study::parse(
//!     r#"
//!     [system]
//!     unknowns  = { u = { near = 1 }, v = { near = -1.7 } }
//!     equations = ["u^2 + v^2 = 4", "exp(u) + v = 1"]
//!     "#,
//!     "meeting",
//! )?;
//! assert_eq!(study.digits(&[], 12)[0].decimal.as_deref(), Some("1.00416873847"));
//! # Ok::<(), mechaudit::study::StudyError>(())
//! ```
//!
//! # Linear algebra
//! An input with a `shape` is a matrix or a vector; outputs are `solve`, `det`, `inverse`,
//! `least_squares` or `eigenvalues` (of a symmetric matrix, or of two where the second is positive
//! definite). A length that `[parameters]` does not state follows from the count of numbers. The
//! numbers come row by row, one matrix after the other, of a matrix that is `banded = [lower,
//! upper]` those within the band alone.
//! ```
//! # use mechaudit::study::Study;
//! use mechaudit::methods::certified_digits;
//! use rug::Rational;
//! let study = Study::parse(
//!     r#"
//!     [inputs]
//!     A = { shape = ["n", "n"] }
//!     b = { shape = ["n"] }
//!     [outputs]
//!     x = { solve = ["A", "b"] }
//!     "#,
//!     "dense",
//! )?;
//! let numbers = [2, 1, 1, 3, 1, 2].map(Rational::from);
//! let x = certified_digits(&study, &numbers, 10, |_| true).unwrap();
//! assert_eq!(x[1].decimal.as_deref(), Some("0.6000000000"));
//! # Ok::<(), mechaudit::study::StudyError>(())
//! ```
//!
//! Formulas are in the language of [`parse`](mechaudit_symbolic::parse()), or in FPCore 2.0.

mod builder;
mod compiled;
mod core;
mod definitions;
mod dimensions;
pub mod document;
mod error;
mod initial_value;
mod linear;
mod method;
mod problem;
pub mod proof;
mod read;
mod sampling;
mod system;

pub use builder::{Formula, absolute, conditioned, relative, ulps};
pub use error::{Place, StudyError};
pub use initial_value::{InitialValue, TimesError, times};
pub use linear::{Linear, Task, Tensor};
pub use problem::{
    Problem, Spacing, StudyCondition, StudyInput, StudyOutput, StudyRegion, StudySolver,
    StudySystem, fault_in, intern, limit,
};
pub use read::{input, is_name, rational};

use crate::audit::{Domain, Limit, did_you_mean};
use crate::methods::CertifiedValue;
use crate::reference::Ball;
use compiled::{Compiled, FloatSolver, Sketch};
use mechaudit_symbolic::Expr;
use mechaudit_symbolic::evaluation::{Answer, Goal};
use rug::Rational;
use std::path::Path;
use std::sync::Arc;

/// A problem that a user brings: see the [module](self).
#[derive(Clone)]
pub struct Study {
    compiled: Arc<Compiled>,
    sketch: Arc<Sketch>,
    solvers: Arc<Vec<FloatSolver>>,
    domain: Domain,
    /// The solver that is audited, by its place.
    chosen: usize,
    /// The proved bounds of its outputs, where they are budgets.
    proved: Arc<Vec<Option<Limit>>>,
    name: &'static str,
}

impl std::fmt::Debug for Study {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut study = f.debug_struct("Study");
        study
            .field("name", &self.problem().name)
            .finish_non_exhaustive()
    }
}

impl Study {
    /// Prepares a problem.
    ///
    /// # Errors
    /// Formulas without meaning, conditions that no input satisfies, and a budget that is to be
    /// proved and is not.
    pub fn new(problem: Problem) -> Result<Study, StudyError> {
        let sketch = Arc::new(Sketch::new(&problem)?);
        let solvers = problem
            .solvers
            .iter()
            .map(|s| FloatSolver::new(&problem, s));
        let solvers: Vec<FloatSolver> = solvers.collect::<Result<_, _>>()?;
        let domain = match &problem.linear {
            Some(linear) => linear::sampling::domain(&problem, linear)?,
            None => sampling::domain(&problem, &sketch, method::format(solvers.first()))?,
        };
        let name = intern(&problem.name);
        let proved = Arc::new(problem.proved(0)?);
        Ok(Study {
            compiled: Arc::new(Compiled::new(problem)?),
            sketch,
            solvers: Arc::new(solvers),
            domain,
            chosen: 0,
            proved,
            name,
        })
    }

    /// Reads a study from a text in TOML, or in FPCore if it begins with a bracket or a semicolon.
    ///
    /// # Errors
    /// The place and the rule that the text breaks.
    pub fn parse(text: &str, name: &str) -> Result<Study, StudyError> {
        let problem = match text.trim_start().starts_with(['(', ';']) {
            true => core::picked(text, name, None)?,
            false => read::problem(text, name)?,
        };
        Study::new(problem)
    }

    /// Reads every core of a text in FPCore, each by itself.
    ///
    /// # Errors
    /// A text that is no sequence of cores.
    pub fn cores(text: &str, file: &str) -> Result<Vec<Result<Study, StudyError>>, StudyError> {
        let problems = core::problems(text, file)?.into_iter();
        Ok(problems.map(|problem| Study::new(problem?)).collect())
    }

    /// Opens `FILE.toml`, `FILE.fpcore` or `FILE.fpcore#NAME`.
    ///
    /// # Errors
    /// A file that cannot be read, and as [`Study::parse`].
    pub fn open(path: &str) -> Result<Study, StudyError> {
        let (file, core) = split(path);
        let fault = |e: StudyError| e.in_file(path);
        let text = read_text(file).map_err(fault)?;
        let stem = Path::new(file)
            .file_stem()
            .map_or(file.into(), |s| s.to_string_lossy());
        let problem = match is_fpcore(file) {
            true => core::picked(&text, &stem, core),
            false => read::problem(&text, &stem),
        };
        let mut study = problem.and_then(Study::new).map_err(fault)?;
        study.name = intern(path);
        Ok(study)
    }

    /// Opens every core of `FILE.fpcore`, each by itself.
    ///
    /// # Errors
    /// A file that cannot be read as a sequence of cores.
    pub fn open_all(file: &str) -> Result<Vec<Result<Study, StudyError>>, StudyError> {
        let fault = |e: StudyError| e.in_file(file);
        let text = read_text(file).map_err(fault)?;
        let stem = Path::new(file)
            .file_stem()
            .map_or(file.into(), |s| s.to_string_lossy());
        let mut all = Study::cores(&text, &stem).map_err(fault)?;
        // A core is named by its own name, or by its number where another has the same.
        let names: Vec<Option<&str>> = all
            .iter()
            .map(|s| s.as_ref().ok().map(|s| s.name))
            .collect();
        for (k, study) in all.iter_mut().enumerate() {
            if let Ok(study) = study {
                let is_unique = names.iter().filter(|n| **n == Some(study.name)).count() == 1;
                let core = if is_unique {
                    study.name.to_string()
                } else {
                    (k + 1).to_string()
                };
                study.name = intern(&format!("{file}#{core}"));
            }
        }
        Ok(all.into_iter().map(|study| study.map_err(fault)).collect())
    }

    /// Begins a study of one formula, for tests.
    pub fn formula(text: &str) -> Formula {
        Formula::new(text)
    }

    /// The same study with another solver of its own.
    ///
    /// # Errors
    /// A name that is not the name of a solver, and a budget that is to be proved of it and is not.
    pub fn with_solver(mut self, name: &str) -> Result<Study, StudyError> {
        let known: Vec<&str> = self
            .problem()
            .solvers
            .iter()
            .map(|s| s.name.as_str())
            .collect();
        match known.iter().position(|s| *s == name) {
            Some(place) => {
                let format = |study: &Study| method::format(study.solvers.get(study.chosen));
                let before = format(&self);
                self.chosen = place;
                self.proved = Arc::new(self.problem().proved(place)?);
                let format = format(&self);
                if format != before && self.problem().linear.is_none() {
                    self.domain = sampling::domain(self.problem(), &self.sketch, format)?;
                }
                Ok(self)
            }
            None if known.is_empty() => Err(StudyError::new("the study states no solver")),
            None => {
                let hint = did_you_mean(name, &known);
                let known = known.join(", ");
                Err(StudyError::new(format!(
                    "there is no solver {name:?}{hint}; there are: {known}"
                )))
            }
        }
    }

    /// The same study with one solver more, which is taken.
    ///
    /// # Errors
    /// As of a solver in the study's own file.
    pub fn and_solver(&self, name: &str, item: &document::Item) -> Result<Study, StudyError> {
        let mut problem = self.problem().clone();
        if problem.solvers.iter().any(|s| s.name == name) {
            return Err(item.fault(format!("the solver {name} is stated twice")));
        }
        let solver = read::solver(&problem, name, item)?;
        problem.solvers.push(solver);
        Ok(Study {
            chosen: problem.solvers.len() - 1,
            name: self.name,
            ..Study::new(problem).map_err(|e| e.at(item.place))?
        })
    }

    /// The same study with its chosen solver over a part of its domain: a region by its name, and
    /// inputs with other ends.
    ///
    /// # Errors
    /// A region that there is not, and a part that holds no input.
    pub fn within(
        &self,
        region: Option<&str>,
        narrowed: &[StudyInput],
    ) -> Result<Study, StudyError> {
        let mut problem = self.problem().clone();
        let regions = std::mem::take(&mut problem.regions);
        let mut inputs = Vec::new();
        if let Some(region) = region {
            let known: Vec<&str> = regions.iter().map(|r| r.name.as_str()).collect();
            let Some(found) = regions.iter().find(|r| r.name == region) else {
                let hint = did_you_mean(region, &known);
                return Err(StudyError::new(format!(
                    "the study states no region {region:?}{hint}"
                )));
            };
            inputs.extend(found.inputs.clone());
            let both = problem.condition.into_iter().chain(found.condition.clone());
            problem.condition = both.reduce(|a, b| StudyCondition {
                is: Expr::And(vec![a.is, b.is]),
                place: b.place,
            });
        }
        inputs.extend(narrowed.iter().cloned());
        for input in inputs {
            if let Some(own) = problem.inputs.iter_mut().find(|i| i.name == input.name) {
                *own = input;
            }
        }
        // They are ready already.
        problem.solvers.clear();
        Ok(Study {
            solvers: self.solvers.clone(),
            chosen: self.chosen,
            name: self.name,
            ..Study::new(problem)?
        })
    }

    /// Neighbouring inputs between which a condition of the chosen solver flips: where one of its
    /// formulas takes over from another.
    pub fn seams(&self) -> Vec<[Vec<f64>; 2]> {
        match self.solvers.get(self.chosen) {
            Some(solver) => sampling::seams(self.problem(), &self.sketch, solver),
            None => Vec::new(),
        }
    }

    /// The same study with another limit on the working precision, in bits; 16384 is the first.
    ///
    /// # Errors
    /// None of a study that was made before.
    pub fn with_limit(mut self, bits: u32) -> Result<Study, StudyError> {
        let mut compiled = Compiled::new(self.problem().clone())?;
        compiled.set_limit(bits);
        self.compiled = Arc::new(compiled);
        Ok(self)
    }

    /// The same study with the time as an input, where an answer is a whole trajectory.
    ///
    /// # Errors
    /// None of a study that was made before.
    pub fn with_time_as_input(&self) -> Result<Study, StudyError> {
        let mut problem = self.problem().clone();
        if let Some(initial_value) = &mut problem.initial_value {
            initial_value.times.clear();
        }
        let name = self.name;
        Ok(Study {
            name,
            ..Study::new(problem)?
        })
    }

    /// The problem as it was read.
    pub fn problem(&self) -> &Problem {
        &self.compiled.problem
    }

    /// The values of all outputs at exact inputs, in the order of the file; of a study of linear
    /// algebra as many as an answer has, each with the reason for a refusal in its place.
    pub fn answers(&self, inputs: &[Rational], goal: Goal) -> Vec<Answer> {
        if let Some(linear) = &self.problem().linear {
            return linear.answers(inputs, goal);
        }
        if let Some(motion) = &self.compiled.motion {
            let rows = self.problem().of_rows(inputs, Rational::clone);
            let values = rows.iter().map(|inputs| motion.values(inputs, goal));
            return values.flatten().collect();
        }
        self.compiled.values(inputs, goal)
    }

    /// Certified decimals of all outputs: `0` where a value is exactly zero, `nan` where it is
    /// undefined, `inf` or `-inf` where it is beyond every exponent, and none where it is
    /// undecided.
    pub fn digits(&self, inputs: &[Rational], digits: u32) -> Vec<CertifiedValue> {
        // One hundredth of a unit in the last digit, and a guard bit or two.
        let bits = (f64::from(digits) * std::f64::consts::LOG2_10).ceil() as u32 + 10;
        let answers = self.answers(inputs, Goal::Bits(bits)).into_iter();
        answers.map(|answer| certified(answer, digits)).collect()
    }
}

/// The decimals of an answer.
fn certified(answer: Answer, digits: u32) -> CertifiedValue {
    let zero = || Ball::integer(64, 0);
    let word = |word: &str, why: Option<String>| CertifiedValue {
        value: zero().into(),
        decimal: Some(word.into()),
        why,
    };
    match answer {
        Answer::Number(ball) => CertifiedValue {
            decimal: ball.to_decimal(digits as usize),
            value: ball.into(),
            why: None,
        },
        Answer::Zero => word("0", None),
        Answer::Huge { negative } => word(if negative { "-inf" } else { "inf" }, None),
        Answer::Undefined { reason, place } => word("nan", Some(format!("{reason}: {place}"))),
        Answer::Undecided(why) => CertifiedValue {
            value: zero().into(),
            decimal: None,
            why: Some(why.to_string()),
        },
    }
}

/// The longest file that is read.
const LONGEST: u64 = 4 << 20;

fn read_text(file: &str) -> Result<String, StudyError> {
    use std::io::Read;
    let failed = |e: std::io::Error| StudyError::new(format!("cannot read the file: {e}"));
    let open = std::fs::File::open(file).map_err(failed)?;
    let mut bytes = Vec::new();
    open.take(LONGEST + 1)
        .read_to_end(&mut bytes)
        .map_err(failed)?;
    if bytes.len() as u64 > LONGEST {
        return Err(StudyError::new(format!(
            "the file is longer than {LONGEST} bytes"
        )));
    }
    String::from_utf8(bytes).map_err(|_| StudyError::new("the file is not UTF-8"))
}

/// A path and the core that it names.
fn split(path: &str) -> (&str, Option<&str>) {
    match path.split_once(".fpcore#") {
        Some((file, core)) => (&path[..file.len() + ".fpcore".len()], Some(core)),
        None => (path, None),
    }
}

fn is_fpcore(file: &str) -> bool {
    file.ends_with(".fpcore")
}

/// Returns the file of a study's path: `FILE.fpcore` of `FILE.fpcore#NAME`.
pub fn file_of(path: &str) -> &str {
    split(path).0
}

/// Returns true if a text names a file of a study rather than a built-in method.
pub fn is_path(text: &str) -> bool {
    let file = split(text).0;
    is_fpcore(file) || file.ends_with(".toml")
}

#[cfg(test)]
mod tests;

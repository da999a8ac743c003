//! Code of one's own in place of a method's solver: its audit in anybody's `cargo test`.
//!
//! [`audit`] takes a function with the signature of a method ([`methods`] has one type for each),
//! [`audit_by_name`] a function from `&[f64]` to values for any method at all.
//!
//! ```
//! // The slider of a central slider-crank by the textbook's formula; everything else is left out.
//! let slider = |x: &[f64]| {
//!     let &[a, b, e, delta, phi, side] = x else { return None };
//!     let across = e - a * (phi - delta).sin();
//!     let along = side * (b * b - across * across).sqrt();
//!     along.is_finite().then(|| vec![a * (phi - delta).cos() + along])
//! };
//! let audit = mechaudit::audit_by_name("slider-crank", slider)?;
//! let report = audit.outputs(&["x"]).region("central").effort(0.1).run()?;
//! report.assert_within_budget();
//!
//! // Near the normal of the guide it loses half its digits, and the audit says so.
//! let audit = mechaudit::audit_by_name("slider-crank", slider)?;
//! let report = audit.outputs(&["x"]).region("near-normal").effort(0.1).run()?;
//! println!("{report}");
//! # Ok::<(), mechaudit::candidate::AuditError>(())
//! ```

mod report;

pub use crate::methods::{Candidate, IntoAnswer, Typed};
pub use report::Report;

use crate::audit::{
    Cases, Limit, NoSuch, Settings, SolverAnswer, Variant, audit_method, audit_one, did_you_mean,
};
use crate::methods;

/// Why an audit cannot be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AuditError {
    /// No method of that name.
    #[error("there is no method {name:?}{}; there are: {}", did_you_mean(.name, .known), .known.join(", "))]
    NoMethod {
        /// The name.
        name: String,
        /// The names there are.
        known: Vec<&'static str>,
    },
    /// No region, check point or output of that name.
    #[error(transparent)]
    NoSuch(#[from] NoSuch),
    /// The effort is not a positive number.
    #[error("the effort {0} must be a positive number, for instance 0.1 or 10")]
    Effort(f64),
    /// The limit is not a positive number.
    #[error("the limit {0} must be finite and positive")]
    Limit(f64),
    /// One case without its region.
    #[error("case {0} of which region?")]
    NoRegion(u64),
}

/// Audits `candidate` as the method `M`, with the method's domain, reference and budget.
///
/// The closure's arguments need their types: `audit::<Faddeeva>(|z: Complex<f64>| …)`.
///
/// ```
/// use mechaudit::methods::Faddeeva;
/// use mechaudit::solvers::faddeeva::faddeeva;
///
/// let report = mechaudit::audit::<Faddeeva>(faddeeva).seed(3).effort(0.05).run()?;
/// report.assert_within_budget();
/// println!("{report}");
/// # Ok::<(), mechaudit::candidate::AuditError>(())
/// ```
pub fn audit<'a, M: Typed>(candidate: impl Candidate<M> + 'a) -> Audit<'a> {
    Audit::new(M::NAME, move |x| candidate.answer(x))
}

/// Audits a function from the method's inputs to its outputs, both laid out as `mechaudit list`
/// says.
///
/// # Errors
/// A name that is not in the registry.
pub fn audit_by_name<'a, R: IntoAnswer>(
    name: &str,
    candidate: impl Fn(&[f64]) -> R + Sync + 'a,
) -> Result<Audit<'a>, AuditError> {
    let known: Vec<&'static str> = methods::registry().iter().map(|m| m.name()).collect();
    match known.iter().find(|k| **k == name) {
        Some(known) => Ok(Audit::new(known, move |x| candidate(x).into_answer())),
        None => Err(AuditError::NoMethod {
            name: name.into(),
            known,
        }),
    }
}

type Solver<'a> = Box<dyn Fn(&[f64]) -> SolverAnswer + Sync + 'a>;

/// An audit of somebody's code, to be set up and run.
#[must_use = "nothing is audited before it is run"]
pub struct Audit<'a> {
    method: &'static str,
    candidate: Solver<'a>,
    settings: Settings,
    effort: f64,
    region: Option<String>,
    case: Option<u64>,
    check_point: Option<String>,
    hard_case: Option<usize>,
    outputs: Option<Vec<String>>,
    limit: Option<Limit>,
}

impl<'a> Audit<'a> {
    fn new(
        method: &'static str,
        candidate: impl Fn(&[f64]) -> SolverAnswer + Sync + 'a,
    ) -> Audit<'a> {
        Audit {
            method,
            candidate: Box::new(candidate),
            settings: Settings::default(),
            effort: 1.0,
            region: None,
            case: None,
            check_point: None,
            hard_case: None,
            outputs: None,
            limit: None,
        }
    }

    /// Key of the random stream, 1 by default.
    pub fn seed(mut self, seed: u64) -> Audit<'a> {
        self.settings.seed = seed;
        self
    }

    /// Random cases in each region of the domain, 200 by default.
    pub fn cases(mut self, cases: u64) -> Audit<'a> {
        self.settings.cases_per_region = cases;
        self
    }

    /// Multiplies the number of random cases.
    pub fn effort(mut self, effort: f64) -> Audit<'a> {
        self.effort = effort;
        self
    }

    /// Only this region, without check points.
    pub fn region(mut self, name: &str) -> Audit<'a> {
        self.region = Some(name.into());
        self
    }

    /// Only this case of the region.
    pub fn case(mut self, index: u64) -> Audit<'a> {
        self.case = Some(index);
        self
    }

    /// Only this check point.
    pub fn check_point(mut self, name: &str) -> Audit<'a> {
        self.check_point = Some(name.into());
        self
    }

    /// Only this hard case, counted from one.
    pub fn hard_case(mut self, number: usize) -> Audit<'a> {
        self.hard_case = Some(number);
        self
    }

    /// Only these outputs, in the method's order: the code gives no others.
    pub fn outputs(mut self, names: &[&str]) -> Audit<'a> {
        self.outputs = Some(names.iter().map(|n| (*n).into()).collect());
        self
    }

    /// A limit of one's own for every output in place of the method's.
    pub fn limit(mut self, limit: Limit) -> Audit<'a> {
        self.limit = Some(limit);
        self
    }

    /// Runs it on all cores.
    ///
    /// # Errors
    /// A region, check point or output that the method does not have; an effort or limit that is
    /// not a positive number.
    pub fn run(self) -> Result<Report, AuditError> {
        if !(self.effort.is_finite() && self.effort > 0.0) {
            return Err(AuditError::Effort(self.effort));
        }
        let mut settings = self.settings;
        // Saturates.
        settings.cases_per_region = (settings.cases_per_region as f64 * self.effort).ceil() as u64;
        let method = methods::find(self.method).expect("the name is in the registry");
        let mut variant = Variant::new(&*method).solver(self.candidate);
        if let Some(names) = &self.outputs {
            variant = variant.outputs(names)?;
        }
        if let Some(limit) = self.limit {
            let k = limit.factor();
            if !(k.is_finite() && k > 0.0) {
                return Err(AuditError::Limit(k));
            }
            variant = variant.limit(limit);
        }
        let cases = Cases::new(&*method, &settings);
        let one = match (&self.check_point, &self.region, self.case) {
            _ if self.hard_case.is_some() => {
                self.hard_case.map(|n| cases.hard_case(n)).transpose()?
            }
            (Some(name), ..) => Some(cases.at_check_point(name)?),
            (None, Some(region), Some(index)) => Some(cases.in_region(region, index)?),
            (None, None, Some(index)) => return Err(AuditError::NoRegion(index)),
            _ => None,
        };
        if let Some(case) = one {
            let found = audit_one(&variant, case, None, &settings);
            return Ok(Report::new(&variant, found));
        }
        if let Some(name) = &self.region {
            variant = variant.region(name)?;
        }
        let found = audit_method(&variant, &settings, &|| ());
        Ok(Report::new(&variant, found))
    }
}

impl std::fmt::Debug for Audit<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Audit")
            .field("method", &self.method)
            .field("settings", &self.settings)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;

//! User code in place of a method's solver: its audit in any `cargo test`.
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

mod comparison;
mod report;

pub use crate::methods::{Candidate, IntoAnswer, Typed};
pub use comparison::{Compare, compare};
pub use report::Report;

use crate::audit::{
    CandidateReport, Case, Cases, Format, Limit, Near, NoSuch, SampleBox, Sampling, SamplingError,
    Settings, SolverAnswer, Variant, audit_method, audit_one,
};
use crate::methods::{self, Evaluable};
use crate::resolve::{MethodError, resolve};

/// The reason why an audit cannot be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AuditError {
    /// There is no method of that name.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// A study that cannot be read.
    #[cfg(feature = "studies")]
    #[error(transparent)]
    Study(#[from] crate::study::StudyError),
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
    /// A single case where many are compared.
    #[error("{0} is one case: a comparison is over many")]
    OneCase(String),
    /// No such box or neighbourhood.
    #[error(transparent)]
    Sampling(#[from] SamplingError),
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
    Audit::new(registered::<M>(), move |x| candidate.answer(x))
}

/// Audits a function from the method's inputs to its outputs, both laid out as
/// `mechaudit describe` says.
///
/// # Errors
/// A name that is not in the registry.
pub fn audit_by_name<'a, R: IntoAnswer>(
    name: &str,
    candidate: impl Fn(&[f64]) -> R + Sync + 'a,
) -> Result<Audit<'a>, AuditError> {
    let method = resolve(name)?;
    Ok(Audit::new(method, move |x| candidate(x).into_answer()))
}

/// Returns the method of a type.
fn registered<M: Typed>() -> Box<dyn Evaluable> {
    methods::find(M::NAME).expect("the name is in the registry")
}

type Solver<'a> = Box<dyn Fn(&[f64]) -> SolverAnswer + Sync + 'a>;

/// An audit of somebody's code, to be set up and run.
#[must_use = "nothing is audited before it is run"]
pub struct Audit<'a> {
    method: Box<dyn Evaluable>,
    candidate: Solver<'a>,
    settings: Settings,
    effort: f64,
    regions: Vec<String>,
    case: Option<u64>,
    check_point: Option<String>,
    hard_case: Option<usize>,
    sample_box: Option<String>,
    near: Option<(String, f64)>,
    ordinary: bool,
    single: bool,
    outputs: Option<Vec<String>>,
    limit: Option<Limit>,
    norm: Option<f64>,
    name: (String, Option<String>),
}

impl<'a> Audit<'a> {
    pub(crate) fn new(
        method: Box<dyn Evaluable>,
        candidate: impl Fn(&[f64]) -> SolverAnswer + Sync + 'a,
    ) -> Audit<'a> {
        Audit {
            method,
            candidate: Box::new(candidate),
            settings: Settings::default(),
            effort: 1.0,
            regions: Vec::new(),
            case: None,
            check_point: None,
            hard_case: None,
            sample_box: None,
            near: None,
            ordinary: false,
            single: false,
            outputs: None,
            limit: None,
            norm: None,
            name: ("closure".into(), None),
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

    /// Only this region, without check points; of several calls the regions of all.
    pub fn region(mut self, name: &str) -> Audit<'a> {
        self.regions.push(name.into());
        self
    }

    /// Cases from a box in some inputs or all: `"Re z=0..8,Im z=log 1e-9..1"`; see
    /// [`SampleBox`].
    pub fn sample_box(mut self, sides: &str) -> Audit<'a> {
        self.sample_box = Some(sides.into());
        self
    }

    /// Cases about this one, as far as `radius` relative to each number: numbers separated by
    /// commas, a check point, `REGION/INDEX` or `hard/NUMBER`; see [`Near`].
    pub fn near(mut self, case: &str, radius: f64) -> Audit<'a> {
        self.near = Some((case.into(), radius));
        self
    }

    /// Without regions, check points and hard cases at the ends of the range of floating-point
    /// numbers.
    pub fn ordinary(mut self) -> Audit<'a> {
        self.ordinary = true;
        self
    }

    /// The code computes in single precision: inputs are numbers that `f32` holds, ulps are those
    /// of `f32`, answers are rounded to it.
    ///
    /// ```
    /// use mechaudit::Complex64;
    /// use mechaudit::methods::Erf;
    ///
    /// // The real error function of the crate's own solver, rounded to single precision.
    /// let erf32 = |z: Complex64| {
    ///     let w = mechaudit::solvers::faddeeva::erf(z);
    ///     [f64::from(w.re as f32), f64::from(w.im as f32)]
    /// };
    /// let report = mechaudit::audit::<Erf>(erf32).single().region("mid").effort(0.1).run()?;
    /// assert!(report.passed() && report.total.outputs[0].ulps.max <= 0.5);
    /// # Ok::<(), mechaudit::candidate::AuditError>(())
    /// ```
    pub fn single(mut self) -> Audit<'a> {
        self.single = true;
        self
    }

    /// Sets the name of the code in reports.
    pub fn named(mut self, name: &str, version: Option<&str>) -> Audit<'a> {
        self.name = (name.into(), version.map(Into::into));
        self
    }

    /// Condition numbers, and errors in u (1 + condition), of every case, be the budget in ulps.
    pub fn conditions(mut self) -> Audit<'a> {
        self.settings.conditions = true;
        self
    }

    /// Only this case of the region, the box or the neighbourhood.
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

    /// Sets a user-supplied limit for every output in place of the method's.
    pub fn limit(mut self, limit: Limit) -> Audit<'a> {
        self.limit = Some(limit);
        self
    }

    /// Allows a norm of all errors of `r` times the norm of the values; alone, or together with
    /// [`Audit::limit`].
    pub fn normwise(mut self, r: f64) -> Audit<'a> {
        self.norm = Some(r);
        self
    }

    /// Runs it on all cores.
    ///
    /// # Errors
    /// A region, check point or output that the method does not have; an effort or limit that is
    /// not a positive number.
    pub fn run(self) -> Result<Report, AuditError> {
        let (settings, variant, one) = self.planned()?;
        let variant = variant.solver(|x| (self.candidate)(x));
        let mut found = match one {
            Some(case) => audit_one(&variant, case, None, &settings),
            None => audit_method(&variant, &settings, &|| ()),
        };
        let (name, version) = self.name.clone();
        found.candidate = Some(CandidateReport {
            name,
            version,
            command: None,
            answered: found.cases,
            trouble: None,
        });
        Ok(Report::new(&variant, found))
    }

    /// The settings, what is judged and where, and the one case if it is one.
    fn planned(&self) -> Result<(Settings, Variant<'_>, Option<Case>), AuditError> {
        if !(self.effort.is_finite() && self.effort > 0.0) {
            return Err(AuditError::Effort(self.effort));
        }
        let mut settings = self.settings.clone();
        // Saturates.
        settings.cases_per_region = (settings.cases_per_region as f64 * self.effort).ceil() as u64;
        let mut variant = Variant::new(&*self.method).without_laws();
        if let Some(names) = &self.outputs {
            variant = variant.outputs(names)?;
        }
        if self.single {
            variant = variant.format(Format::Single);
        }
        if let Some(limit) = self.limit {
            if !limit.is_sound() {
                return Err(AuditError::Limit(limit.factor()));
            }
            variant = variant.limit(limit);
        }
        if let Some(r) = self.norm {
            if !(r.is_finite() && r > 0.0) {
                return Err(AuditError::Limit(r));
            }
            variant = variant.norm_limit(r);
        }
        if self.ordinary {
            variant = variant.ordinary();
        }
        if let Some((text, radius)) = &self.near {
            let near = Near::read(&variant, &settings, text, *radius)?;
            variant = variant.sampling(Sampling::Near(near));
        }
        let cases = Cases::new(&variant, &settings);
        let one = match (&self.check_point, self.regions.as_slice(), self.case) {
            _ if self.hard_case.is_some() => {
                self.hard_case.map(|n| cases.hard_case(n)).transpose()?
            }
            (Some(name), ..) => Some(cases.at_check_point(name)?),
            (None, [region], Some(index)) if self.sample_box.is_none() => {
                Some(cases.in_region(region, index)?)
            }
            _ => None,
        };
        let one = match one {
            Some(case) => Some(case),
            None => {
                for name in &self.regions {
                    variant = variant.region(name)?;
                }
                if let Some(text) = &self.sample_box {
                    let sides = SampleBox::read(&variant, text)?;
                    variant = variant.sampling(Sampling::Box(sides));
                }
                let drawn = |index| Cases::new(&variant, &settings).at_index(index);
                let asked = self.case.filter(|_| self.check_point.is_none());
                let no_region = |index| drawn(index).ok_or(AuditError::NoRegion(index));
                asked.map(no_region).transpose()?
            }
        };
        Ok((settings, variant, one))
    }
}

impl std::fmt::Debug for Audit<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Audit")
            .field("method", &self.method.name())
            .field("settings", &self.settings)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;

//! Several pieces of code side by side, in anybody's `cargo test`.

use super::{Audit, AuditError, registered};
use crate::audit::{Comparison, Contender, Method, SolverAnswer, compare as compare_all};
use crate::methods::{Candidate, Typed};
use std::marker::PhantomData;

/// The name of a piece of code, and its version.
type Name = (String, Option<String>);
type Solver<'a> = Box<dyn Fn(&[f64]) -> SolverAnswer + Sync + 'a>;

/// Code for the method `M` to be judged at the same cases.
#[must_use = "nothing is compared before it is run"]
pub struct Compare<'a, M> {
    audit: Audit<'a>,
    contenders: Vec<(Option<Name>, Solver<'a>)>,
    method: PhantomData<fn() -> M>,
}

/// Compares pieces of code for the method `M`.
///
/// ```
/// use mechaudit::Complex64;
/// use mechaudit::methods::Erfcx;
/// use mechaudit::solvers::faddeeva::{erfc, erfcx};
///
/// // Overflows, and loses what the exponential loses.
/// let product = |z: Complex64| (z * z).exp() * erfc(z);
/// let found = mechaudit::compare::<Erfcx>()
///     .candidate("product", product)
///     .candidate("erfcx", erfcx)
///     .over(|audit| audit.region("mid").effort(0.1))
///     .run()?;
/// let all = &found.regions.last().unwrap().standings;
/// assert!(all[1].best && !all[0].best && all[0].ratio > Some(2.0));
/// # Ok::<(), mechaudit::candidate::AuditError>(())
/// ```
pub fn compare<'a, M: Typed>() -> Compare<'a, M> {
    Compare {
        audit: Audit::new(registered::<M>(), |_| SolverAnswer::Declines(None)),
        contenders: Vec::new(),
        method: PhantomData,
    }
}

impl<'a, M: Typed> Compare<'a, M> {
    /// Adds a piece of code under this name.
    pub fn candidate(mut self, name: &str, code: impl Candidate<M> + 'a) -> Compare<'a, M> {
        let solve = move |x: &[f64]| code.answer(x);
        let name = Some((name.into(), None));
        self.contenders.push((name, Box::new(solve)));
        self
    }

    /// Adds the method's own solver.
    pub fn ours(mut self) -> Compare<'a, M> {
        let method = registered::<M>();
        let solve = move |x: &[f64]| Method::solve(&*method, x);
        self.contenders.push((None, Box::new(solve)));
        self
    }

    /// Where, at how many cases and how strictly: `over(|audit| audit.region("mid").seed(7))`.
    pub fn over(mut self, set: impl FnOnce(Audit<'a>) -> Audit<'a>) -> Compare<'a, M> {
        self.audit = set(self.audit);
        self
    }

    /// Judges all of them on all cores and times them on one.
    ///
    /// # Errors
    /// As [`Audit::run`]; a single case.
    pub fn run(self) -> Result<Comparison, AuditError> {
        let (settings, variant, one) = self.audit.planned()?;
        if let Some(case) = one {
            return Err(AuditError::OneCase(case.place()));
        }
        let all = self.contenders.iter();
        let all: Vec<Contender> = all.map(|(name, solve)| (name.clone(), &**solve)).collect();
        Ok(compare_all(&variant, &all, &settings))
    }
}

impl<M> std::fmt::Debug for Compare<'_, M> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Compare")
            .field("audit", &self.audit)
            .field("contenders", &self.contenders.len())
            .finish_non_exhaustive()
    }
}

//! A method with another solver, over a part of its domain, or with a part of its outputs.

use super::answer::{Reference, ReferenceAnswer, SolverAnswer};
use super::budget::{Budget, Limit, NormBudget};
use super::domain::{Domain, Region};
use super::expected::Expected;
use super::hard::HardCase;
use super::layout::Layout;
use super::method::{BranchAt, Input, Law, Method, Output, ProvedBound, Rows};
use super::no_such::NoSuch;
use super::sampling::{Sampling, is_ordinary};
use super::ulp::Format;
use mechaudit_reference::Ball;
use rug::Rational;

type Solver<'a> = Box<dyn Fn(&[f64]) -> SolverAnswer + Sync + 'a>;

type Admits<'a> = Box<dyn Fn(&[f64]) -> bool + Sync + 'a>;

/// The reason for a user-supplied budget.
const AS_ASKED: &str = "as asked for";

/// For each output of a method, whether it is among the names. An output that is repeated in rows
/// is named alone or with the index of its rows, as `mechaudit describe` shows it: `S` or `S[q]`.
///
/// # Errors
/// An output that there is not.
pub fn selected_outputs(
    method: &dyn Method,
    names: &[impl AsRef<str>],
) -> Result<Vec<bool>, NoSuch> {
    let layout = Layout::new(method);
    let known: Vec<&'static str> = method.outputs().iter().map(|o| o.name).collect();
    let is_named = |name: &str, output: &str| name == output || name == layout.output(output);
    let is_known = |name: &str| known.iter().any(|output| is_named(name, output));
    if let Some(name) = names.iter().map(AsRef::as_ref).find(|name| !is_known(name)) {
        return Err(NoSuch::new(method.name(), "output", name, known));
    }
    let is_chosen = |output: &&str| names.iter().any(|name| is_named(name.as_ref(), output));
    Ok(known.iter().map(is_chosen).collect())
}

/// A method with something changed; everything else is passed through.
pub struct Variant<'a> {
    method: &'a dyn Method,
    solver: Option<Solver<'a>>,
    regions: Option<Vec<&'static str>>,
    place: Option<(Vec<Region>, Admits<'a>)>,
    ordinary: bool,
    sampling: Sampling,
    norm: Option<f64>,
    check_points: bool,
    /// Which of the method's outputs are judged.
    selected: Option<Vec<bool>>,
    limit: Option<Limit>,
    laws: bool,
    hard: Option<Vec<HardCase>>,
    format: Option<Format>,
}

impl<'a> Variant<'a> {
    /// The method as it is.
    pub fn new(method: &'a dyn Method) -> Variant<'a> {
        Variant {
            method,
            solver: None,
            regions: None,
            place: None,
            ordinary: false,
            sampling: Sampling::Domain,
            norm: None,
            check_points: true,
            selected: None,
            limit: None,
            laws: true,
            hard: None,
            format: None,
        }
    }

    /// Other code under test. The laws and what is proved go: they are about the method's own.
    #[must_use]
    pub fn solver(mut self, solve: impl Fn(&[f64]) -> SolverAnswer + Sync + 'a) -> Variant<'a> {
        self.solver = Some(Box::new(solve));
        self.without_laws()
    }

    /// Without the laws and what is proved, which are about the method's own solver.
    #[must_use]
    pub fn without_laws(mut self) -> Variant<'a> {
        self.laws = false;
        self
    }

    /// Adds a region of the domain to those selected; check points are left out.
    ///
    /// # Errors
    /// A region that there is not.
    pub fn region(mut self, name: &str) -> Result<Variant<'a>, NoSuch> {
        let regions = self.method.domain().regions;
        let known: Vec<&'static str> = regions.iter().map(|r| r.name).collect();
        let Some(found) = known.iter().find(|k| **k == name) else {
            return Err(NoSuch::new(self.method.name(), "region", name, known));
        };
        self.regions.get_or_insert_default().push(found);
        self.check_points = false;
        Ok(self)
    }

    /// Sets user-supplied regions in place of the domain's, without check points, hard cases, laws
    /// and what is proved of the domain; a hunt stays where `admits` holds.
    #[must_use]
    pub fn placed(
        mut self,
        regions: Vec<Region>,
        admits: impl Fn(&[f64]) -> bool + Sync + 'a,
    ) -> Variant<'a> {
        self.place = Some((regions, Box::new(admits)));
        self.check_points = false;
        self.without_laws()
    }

    /// Without the regions at the ends of the range of floating-point numbers, and without check
    /// points and hard cases there: see [`Region::is_ordinary`](super::Region::is_ordinary).
    #[must_use]
    pub fn ordinary(mut self) -> Variant<'a> {
        self.ordinary = true;
        self
    }

    /// Cases from a box or from about an input, in place of the regions, check points and hard
    /// cases.
    #[must_use]
    pub fn sampling(mut self, sampling: Sampling) -> Variant<'a> {
        self.sampling = sampling;
        self
    }

    /// Code whose numbers are of another format: inputs are numbers of it, ulps are its ulps,
    /// answers are rounded to it.
    #[must_use]
    pub fn format(mut self, format: Format) -> Variant<'a> {
        self.format = Some(format);
        self
    }

    /// Sets a user-supplied limit for the norm of all errors: `‖got − ref‖₂ ≤ r ‖ref‖₂`. It is
    /// judged in addition to user-supplied limits of outputs, and in place of the outputs' limits
    /// where there are none.
    ///
    /// # Panics
    /// When `r` is not a finite positive number.
    #[must_use]
    pub fn norm_limit(mut self, r: f64) -> Variant<'a> {
        self.norm = Some(r);
        match self.limit {
            None => self.limit(Limit::OfNorm(r)),
            Some(_) => self,
        }
    }

    /// Other hard cases than the method's own.
    #[must_use]
    pub fn hard_cases(mut self, cases: Vec<HardCase>) -> Variant<'a> {
        self.hard = Some(cases);
        self
    }

    /// Only these outputs, named as [`selected_outputs`] reads them: the solver gives no others,
    /// and no norm of all is judged.
    ///
    /// # Errors
    /// An output that there is not.
    pub fn outputs(mut self, names: &[impl AsRef<str>]) -> Result<Variant<'a>, NoSuch> {
        self.selected = Some(selected_outputs(self.method, names)?);
        Ok(self)
    }

    /// Another limit for every output; no norm of all is judged.
    ///
    /// # Panics
    /// When the limit is not a finite positive number.
    #[must_use]
    pub fn limit(mut self, limit: Limit) -> Variant<'a> {
        self.limit = Some(Budget::new(limit, AS_ASKED).limit);
        self
    }

    /// The entries of `all` that belong to selected outputs.
    fn select<T>(&self, all: Vec<T>) -> Vec<T> {
        let Some(selected) = &self.selected else {
            return all;
        };
        let chosen = selected.iter().cycle();
        all.into_iter()
            .zip(chosen)
            .filter(|(_, s)| **s)
            .map(|(v, _)| v)
            .collect()
    }

    fn select_answer(&self, answer: ReferenceAnswer) -> ReferenceAnswer {
        match answer {
            all if self.selected.is_none() => all,
            ReferenceAnswer::Values(Reference { values, proof }) => {
                let values: Vec<Ball> = self.select(values);
                ReferenceAnswer::Values(Reference { values, proof })
            }
            ReferenceAnswer::Expected(expected, proof) => {
                let expected: Vec<Expected> = self.select(expected);
                ReferenceAnswer::Expected(expected, proof)
            }
            other => other,
        }
    }
}

impl Method for Variant<'_> {
    fn name(&self) -> &'static str {
        self.method.name()
    }
    fn summary(&self) -> &'static str {
        self.method.summary()
    }
    fn source(&self) -> &'static str {
        self.method.source()
    }
    fn stream(&self) -> &'static str {
        self.method.stream()
    }
    fn remarks(&self) -> Vec<String> {
        self.method.remarks()
    }
    fn inputs(&self) -> Vec<Input> {
        self.method.inputs()
    }
    fn outputs(&self) -> Vec<Output> {
        let mut outputs = self.select(self.method.outputs());
        if let Some(limit) = self.limit {
            let budget = Budget::new(limit, AS_ASKED);
            outputs.iter_mut().for_each(|o| o.budget = budget);
        }
        outputs
    }
    fn rows(&self) -> Option<Rows> {
        self.method.rows()
    }
    fn norm_budget(&self) -> Option<NormBudget> {
        if let Some(r) = self.norm {
            let u = 2f64.powi(Method::format(self).precision() as i32);
            return Some(NormBudget::new(r * u, AS_ASKED));
        }
        let whole = self.selected.is_none() && self.limit.is_none();
        self.method.norm_budget().filter(|_| whole)
    }
    fn proved(&self) -> Vec<ProvedBound> {
        match self.laws && self.format.is_none() {
            true => self.method.proved(),
            false => Vec::new(),
        }
    }
    fn domain(&self) -> Domain {
        let mut domain = self.method.domain();
        if let Some((regions, _)) = &self.place {
            domain.regions.clone_from(regions);
        }
        if let Some(names) = &self.regions {
            domain.regions.retain(|r| names.contains(&r.name));
        }
        if !self.check_points {
            domain.check_points.clear();
        }
        if self.ordinary {
            let name = self.method.stream();
            domain.regions.retain(|r| r.is_ordinary(name));
            domain.check_points.retain(|p| is_ordinary(&p.input));
        }
        domain
    }
    fn sampling(&self) -> Sampling {
        match &self.sampling {
            Sampling::Domain => self.method.sampling(),
            own => own.clone(),
        }
    }
    fn solve(&self, input: &[f64]) -> SolverAnswer {
        match &self.solver {
            Some(solve) => solve(input),
            None => match self.method.solve(input) {
                SolverAnswer::Values(v) => SolverAnswer::Values(self.select(v)),
                other => other,
            },
        }
    }
    fn reference(&self, input: &[Rational], bits: u32) -> ReferenceAnswer {
        self.select_answer(self.method.reference(input, bits))
    }
    fn may_refuse(&self, input: &[Rational]) -> Option<&'static str> {
        self.method.may_refuse(input)
    }
    fn reference_not_finite(&self, input: &[f64]) -> ReferenceAnswer {
        self.select_answer(self.method.reference_not_finite(input))
    }
    fn signs_of_zero(&self, input: &[f64]) -> Vec<Option<bool>> {
        self.select(self.method.signs_of_zero(input))
    }
    fn conditions(&self, input: &[f64]) -> Option<Vec<f64>> {
        self.method.conditions(input).map(|c| self.select(c))
    }
    fn conditions_beside(&self, input: &[f64], reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        match self.selected {
            // Of the reference only the selected values are at hand.
            Some(_) => self.conditions(input),
            None => self.method.conditions_beside(input, reference),
        }
    }
    /// None with another solver: it is the twin of the method's own.
    fn twin(&self, input: &[f64]) -> Option<Vec<Ball>> {
        match self.solver {
            Some(_) => None,
            None => self.method.twin(input).map(|t| self.select(t)),
        }
    }
    fn format(&self) -> Format {
        self.format.unwrap_or_else(|| self.method.format())
    }
    /// None where the code is not the method's own: it has formulas of its own.
    fn branch(&self, input: &[f64]) -> Option<BranchAt> {
        self.method.branch(input).filter(|_| self.laws)
    }
    fn is_data(&self, k: usize) -> bool {
        self.method.is_data(k)
    }
    fn hard(&self) -> Vec<HardCase> {
        if !self.check_points {
            return Vec::new();
        }
        let own = || self.method.hard();
        let mut hard = self.hard.clone().unwrap_or_else(own);
        if self.ordinary {
            hard.retain(|h| is_ordinary(&h.input));
        }
        if self.limit.is_some() || self.format.is_some() {
            // Records refer to the method's own budget.
            hard.iter_mut().for_each(|h| h.share = 0.0);
        }
        hard
    }
    fn admits(&self, input: &[f64]) -> bool {
        self.method.admits(input) && self.place.as_ref().is_none_or(|(_, admits)| admits(input))
    }
    fn laws(&self) -> Vec<Law> {
        match self.laws {
            true => self.method.laws(),
            false => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests;

//! Norms over all values of an answer.

use super::Verdict;
use crate::budget::{Limit, NormBudget};
use crate::expected::Values;
use crate::method::Output;
use crate::ulp::Format;
use mechaudit_reference::{Ball, Mag};

/// Sums of squares over all values: bounds on the errors, a lower bound on the references.
pub(super) struct Squares {
    /// True if every value is due as a number.
    pub(super) numbers: bool,
    pub(super) terms: usize,
    low: Mag,
    high: Mag,
    norm: Mag,
}

impl Default for Squares {
    fn default() -> Squares {
        Squares {
            numbers: true,
            terms: 0,
            low: Mag::ZERO,
            high: Mag::ZERO,
            norm: Mag::ZERO,
        }
    }
}

impl Squares {
    /// A number due, at least that large, whose error is between the two bounds; or none.
    pub(super) fn add(&mut self, size: Option<Mag>, lo: Mag, hi: Mag) {
        let Some(size) = size else {
            self.numbers = false;
            return;
        };
        self.terms += 1;
        self.low = self.low.add(lo.mul(lo));
        self.high = self.high.add(hi.mul(hi));
        self.norm = self.norm.add(size.mul(size));
    }

    /// Returns a lower bound on the root of a sum of `n` squares.
    pub(super) fn root_below(sum: Mag, terms: usize) -> Mag {
        sum.sqrt().mul(Mag::from_f64(Squares::below(terms)))
    }

    /// Returns the factor to a lower bound on the root of a sum of so many squares: `Mag` rounds
    /// up, by less than 2⁻⁵² of the root for each of them and four times that in addition.
    pub(super) fn below(terms: usize) -> f64 {
        1.0 - 2f64.powi(-40) * (terms as f64 / 1024.0).max(1.0)
    }

    /// Lower and upper bounds on the norms: of the references, but for the smallest normal number,
    /// and of the errors.
    pub(super) fn norms(&self, format: Format) -> (Mag, Mag) {
        let least = Mag::from_f64(format.min_positive());
        let size = Squares::root_below(self.norm, self.terms).max(least);
        (size, self.high.sqrt())
    }

    pub(super) fn normwise(&self, (size, error): (Mag, Mag), format: Format) -> f64 {
        match self.numbers {
            true if error.is_zero() => 0.0,
            true => error.div(size).shift(format.precision()).to_f64(),
            false => f64::NAN,
        }
    }

    /// The verdict, and the share of the budget.
    pub(super) fn verdict(
        &self,
        (size, error): (Mag, Mag),
        budget: &NormBudget,
        format: Format,
    ) -> (Verdict, f64) {
        let allowed = Mag::from_f64(budget.factor).mul(size);
        let allowed = allowed.shift(-format.precision());
        let verdict = if error <= allowed {
            Verdict::Pass
        } else if Squares::root_below(self.low, self.terms) > allowed {
            Verdict::Over
        } else {
            Verdict::Undecided
        };
        (verdict, error.div(allowed).to_f64())
    }
}

/// `max_i (|ref_i| + cond_i)` over all outputs with normwise limits, for these; the norm of all
/// values for those of the norm. Sums are rounded down and up. Nothing where no limit asks for it.
pub(super) fn output_scales(
    outputs: &[Output],
    values: Values,
    conditions: Option<&[f64]>,
) -> Vec<(Mag, Mag)> {
    let asks = |o: &Output| matches!(o.budget.limit, Limit::Normwise(_) | Limit::OfNorm(_));
    if !outputs.iter().any(asks) {
        return Vec::new();
    }
    let (mut low, mut high) = (Mag::ZERO, Mag::ZERO);
    let mut squares = Mag::ZERO;
    for (i, v) in values.iter().enumerate() {
        let limit = outputs[i % outputs.len()].budget.limit;
        // An infinite condition number allows nothing, of another value as of its own.
        let c = conditions.map(|c| c[i]).filter(|c| c.is_finite());
        let c = c.map_or(Mag::ZERO, Mag::from_f64);
        let size = v.number().map_or(Mag::ZERO, Ball::mignitude);
        if let Limit::Normwise(_) = limit {
            low = low.max(size.add_below(c));
            high = high.max(size.add(c));
        }
        squares = squares.add(size.mul(size));
    }
    let root = Squares::root_below(squares, values.len());
    let scale = |output: &Output| match output.budget.limit {
        Limit::OfNorm(_) => (root, root),
        _ => (low, high),
    };
    outputs.iter().map(scale).collect()
}

//! The error that a method is allowed, and the reason for it.

use super::ulp::Format;
use serde::Serialize;

/// The largest error that passes. Always finite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// `|got − ref| ≤ k · ulp(ref)`.
    Ulps(f64),
    /// `|got − ref| ≤ k · 2⁻⁵³ · (|ref| + Σ_j |x_j ∂ref/∂x_j|)`: what a backward-stable method
    /// achieves when each input is known to half an ulp. At least `k · 2⁻¹⁰⁷⁵`, what k roundings of
    /// subnormal numbers may cost, unless nothing at all is allowed.
    Conditioned(f64),
    /// `|got − ref| ≤ k · 2⁻⁵³ · max_i (|ref_i| + Σ_j |x_j ∂ref_i/∂x_j|)`, the maximum over all
    /// values of all outputs with such a limit, which share a unit (components of one vector, parts
    /// of complex numbers); at least as with [`Conditioned`](Limit::Conditioned).
    Normwise(f64),
    /// `|got − ref| ≤ r · |ref|`, and half the smallest number in any case.
    Relative(f64),
    /// `|got − ref| ≤ a`, in the output's unit.
    Absolute(f64),
    /// `|got − ref| ≤ max(a, r · |ref|)`.
    RelativeOrAbsolute(f64, f64),
    /// `|got − ref| ≤ r · ‖ref‖₂` over all values of the answer: what a [`NormBudget`] implies for
    /// each of them.
    OfNorm(f64),
    /// `|printed − ref| ≤ k` units of the last printed digit, which differ from entry to entry.
    LastDigit(f64),
}

impl Limit {
    /// The factor `k`, `r` or `a`; of two the first.
    pub fn factor(self) -> f64 {
        match self {
            Limit::Ulps(k) | Limit::Conditioned(k) | Limit::Normwise(k) | Limit::LastDigit(k) => k,
            Limit::Relative(r) | Limit::RelativeOrAbsolute(r, _) | Limit::OfNorm(r) => r,
            Limit::Absolute(a) => a,
        }
    }

    /// Returns true if it is finite and positive, as a budget has to be.
    pub fn is_sound(self) -> bool {
        let good = |k: f64| k.is_finite() && k > 0.0;
        let second = match self {
            Limit::RelativeOrAbsolute(_, a) => good(a),
            _ => true,
        };
        good(self.factor()) && second
    }

    /// Returns true if the limit needs condition numbers.
    pub fn needs_conditions(self) -> bool {
        matches!(self, Limit::Conditioned(_) | Limit::Normwise(_))
    }
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Limit::Ulps(k) => write!(f, "{k} ulp"),
            Limit::Conditioned(k) => write!(f, "{k} u (1 + cond)"),
            Limit::Normwise(k) => write!(f, "{k} u (1 + cond), normwise"),
            Limit::Relative(r) => write!(f, "relative error {r:e}"),
            Limit::Absolute(a) => write!(f, "absolute error {a:e}"),
            Limit::RelativeOrAbsolute(r, a) => {
                write!(f, "relative error {r:e} or absolute error {a:e}")
            }
            Limit::LastDigit(k) => write!(f, "{k} of a unit of the last digit"),
            Limit::OfNorm(r) => write!(f, "{r:e} of the norm"),
        }
    }
}

/// The error that all values of an answer together may have, where they share a unit:
/// `‖got − ref‖₂ ≤ k · 2⁻⁵³ · max(‖ref‖₂, 2⁻¹⁰²²)`.
///
/// It is judged in addition to the budgets of the outputs, where all values are expected to be
/// numbers and are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NormBudget {
    /// The factor `k`.
    pub factor: f64,
    /// The reason for the limit.
    pub reason: &'static str,
}

impl NormBudget {
    /// A budget.
    ///
    /// # Panics
    /// When the factor is not a finite positive number.
    pub fn new(factor: f64, reason: &'static str) -> NormBudget {
        assert!(
            factor.is_finite() && factor > 0.0,
            "a budget is finite and positive, got {factor}"
        );
        NormBudget { factor, reason }
    }

    /// For people, with the u of a format.
    pub fn shown(&self, format: Format) -> String {
        let u = 2f64.powi(-format.precision() as i32);
        match self.factor {
            // A user-supplied budget, given as a relative error.
            k if k >= 1e6 || k.fract() != 0.0 => format!("{:.3e} of the norm", k * u),
            k => format!("{k} u of the norm"),
        }
    }
}

/// With the u of `f64`.
impl std::fmt::Display for NormBudget {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.shown(Format::Double))
    }
}

/// A limit with the reason for it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Budget {
    /// The limit.
    pub limit: Limit,
    /// The reason for the limit.
    pub reason: &'static str,
}

impl Budget {
    /// A budget.
    ///
    /// # Panics
    /// When the limit is not a finite positive number: an unbounded budget is no budget.
    pub fn new(limit: Limit, reason: &'static str) -> Budget {
        assert!(
            limit.is_sound(),
            "a budget is finite and positive, got {limit}"
        );
        Budget { limit, reason }
    }
}

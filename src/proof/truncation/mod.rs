//! The distance of a formula, evaluated without rounding, from w.

mod asymptotic;
mod complement;
mod maclaurin;
mod odd;
mod rows;

pub(crate) use asymptotic::{
    asymptotic, exponential_error, huge, on_real_line, polynomial_error, strip,
};
pub(crate) use complement::ErfcRow;
pub(crate) use maclaurin::maclaurin;
pub(crate) use odd::{odd_series_error, pair_error};
pub(crate) use rows::RowErrors;

/// Bounds of `|formula − w|`, and of its components divided by σ, where they have the factor σ in
/// the formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Truncation {
    /// Of the absolute value.
    pub norm: f64,
    /// Of the real part; infinite where nothing better than `norm` is proved and the part has the
    /// factor σ.
    pub re: f64,
    /// Of the imaginary part.
    pub im: f64,
    /// The part of each component's error that does not scale with it, in units of 2⁻¹⁰⁷⁵.
    pub tiny: f64,
    /// Of the real part beside the real axis, where `e^{−z²}` is added.
    pub sum: Option<OfSum>,
}

impl Truncation {
    /// One bound for all.
    pub fn all(norm: f64) -> Truncation {
        Truncation {
            norm,
            re: norm,
            im: norm,
            tiny: 0.0,
            sum: None,
        }
    }
}

/// `Re w = y U + E` beside the real axis, `E = Re e^{−z²}`, both terms positive: bounds of what
/// each of the two that the formula has in their place is wrong by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OfSum {
    /// Of U.
    pub slope: f64,
    /// Of E, as a part of it.
    pub exponential: f64,
    /// The largest `|E|`.
    pub most: f64,
    /// Below the formula's U where E is added: `1/(√π x²)`, plus positive terms.
    pub least: f64,
}

//! How far a formula, evaluated without rounding, is from w.

mod asymptotic;
mod maclaurin;
mod rows;

pub(crate) use asymptotic::{asymptotic, huge, on_real_line, polynomial_error, strip};
pub(crate) use maclaurin::maclaurin;
pub(crate) use rows::RowErrors;

/// Bounds of `|formula − w|`, and of its components divided by σ, where they have the factor σ in the formula.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Truncation {
    /// Of the absolute value.
    pub norm: f64,
    /// Of the real part; infinite where nothing better than `norm` is proved and the part has the factor σ.
    pub re: f64,
    /// Of the imaginary part.
    pub im: f64,
    /// Besides, of each component, in units of 2⁻¹⁰⁷⁵.
    pub tiny: f64,
}

//! The formulas for w in the closed first quadrant, for any type of number: what the proof of their
//! error bound runs.
//!
//! Each function here hands its arguments on to the code that `f64`s and vectors run.

use super::asymptotic::{one_term as first_term, series, series_rounded, two_terms as two};
use super::maclaurin::{self, nine_terms as nine, twenty_one_terms as twenty_one};
use super::rows::{above_real_axis, imaginary_axis_row, in_cell, on_axis, real_axis_row};
use super::taylor::{ComplexRow, axis_row, complex_row_rounded};
use super::{plane, rows, special};

pub mod lower;
pub mod real_line;

pub use crate::lanes::Vectors;
pub use crate::real::{ROUND, Real};

/// A row of complex coefficients: `Re c₀` (hi, lo), `Im c₀`, `Re c₁`, `Im c₁`, then four blocks of
/// four real and four imaginary parts of `c₂ … c₁₇`.
pub type Row = [f64; 40];
/// A row of real coefficients: `c₀` (hi, lo), `c₁` (hi, lo), `c₂ … c₁₇`.
pub type AxisRow = [f64; 20];

/// The row of the cell around `a + i b`, and the distance from its centre.
pub fn cell(a: f64, b: f64) -> (&'static Row, f64, f64) {
    let (row, dx, dy) = in_cell(a, b);
    (&row.0, dx, dy)
}

/// The row about the centre on the real axis next to `a`, and the distance from it.
pub fn real_axis(a: f64) -> (&'static Row, f64) {
    let (n, t) = rows::on_real_axis(a);
    (&real_axis_row(n).0, t)
}

/// The row about the centre on the imaginary axis next to `i b`, and the distance from it.
pub fn imaginary_axis(b: f64) -> (&'static AxisRow, f64) {
    let (n, t) = on_axis(b);
    (imaginary_axis_row(n), t)
}

/// w at distance `dx + i dy` from the centre of a row.
pub fn complex_row<L: Vectors>(
    lanes: L,
    row: &Row,
    dx: L::Scalar,
    dy: L::Scalar,
) -> (L::Scalar, L::Scalar) {
    complex_row_rounded(lanes, &ComplexRow(*row), dx, dy)
}

/// w at distance `t` from a centre on the real axis and `b` above it.
pub fn real_axis_value<L: Vectors>(
    lanes: L,
    row: &Row,
    t: L::Scalar,
    b: L::Scalar,
) -> (L::Scalar, L::Scalar) {
    complex_row(lanes, row, t, above_real_axis(b))
}

/// w at distance `i t` from a centre on the imaginary axis, where it is real.
pub fn imaginary_axis_value<L: Vectors>(lanes: L, row: &AxisRow, t: L::Scalar) -> L::Scalar {
    axis_row(lanes, row, t).hi
}

/// The asymptotic series with N terms.
pub fn asymptotic<R: Real, const N: usize>(a: R, b: R) -> (R, R) {
    series_rounded::<R, N>(a, b)
}

/// The same on the imaginary axis.
pub fn asymptotic_on_imaginary_axis<R: Real, const N: usize>(b: R) -> R {
    series::<R, N>(b.like(0.0), b).0.hi
}

/// The same with two terms, for `|z| ≥ 1024`.
pub fn two_terms<R: Real>(a: R, b: R) -> (R, R) {
    two(a, b)
}

/// The first term at a point scaled so that its larger coordinate is within [1, 2).
pub fn one_term<R: Real>(a: R, b: R) -> (R, R) {
    first_term(a, b)
}

/// w beside the real axis, from the asymptotic series and `e^{−z²}`.
pub fn in_strip<R: Real>(a: R, b: R) -> (R, R) {
    let (re, im, _) = plane::in_strip(a, b);
    (re, im)
}

/// w next to the real axis, from two polynomials and `e^{−z²}`.
pub fn on_real_line<R: Real>(a: R, b: R) -> (R, R) {
    let (re, im, _) = plane::on_real_line(a, b);
    (re, im)
}

/// The Maclaurin series with 9 terms.
pub fn nine_terms<R: Real>(x: R, y: R) -> (R, R) {
    nine(x, y)
}

/// The Maclaurin series with 21 terms.
pub fn twenty_one_terms<R: Real>(x: R, y: R) -> (R, R) {
    twenty_one(x, y)
}

/// The Maclaurin series with 9 terms on the imaginary axis.
pub fn nine_terms_on_imaginary_axis<R: Real>(y: R) -> R {
    maclaurin::on_imaginary_axis(y)
}

/// The polynomials of [`on_real_line`] in `1/(Re z)²`.
pub fn real_line_polynomials() -> &'static [[f64; 10]; 2] {
    &super::tables::REAL_LINE
}

/// `1/n!` from `n = 2` on in the polynomial of [`in_strip`] and [`on_real_line`] for `e^s`, and the
/// two parts of ln 2 that reduce its argument.
pub fn exponential() -> (&'static [f64; 12], [f64; 2]) {
    crate::exponential::of_rounded()
}

/// w from `|z|² = 10^200` on, unscaled.
pub fn huge(a: f64, b: f64) -> (f64, f64) {
    special::huge(a, b)
}

//! The formulas for erf, erfc, erfcx and Dawson's function of a real argument.
//!
//! They give two numbers whose sum the code rounds to one.

use super::{AxisRow, Real, Vectors};
use crate::double_double::Dd;
use crate::exponential::of_pairs;
use crate::faddeeva::asymptotic::series;
use crate::faddeeva::branch::{Branch, formula_of_pairs, series_of_pairs};
use crate::faddeeva::constants::{HALF_SQRT_PI, INV_SQRT_PI, TWO_OVER_SQRT_PI};
use crate::faddeeva::odd_series;
use crate::faddeeva::rows::{self, on_axis_of_dawson};
use crate::faddeeva::taylor::{RealRow, axis_row};
use crate::faddeeva::{branch, real_line as formulas};

/// |x| below which erf x is a Maclaurin series, and Dawson's function; below which erfc x is 1 − erf
/// x; from which |erf x| is 1 and erfc −|x| is 2; from which erfc x is 0, and beyond which erfcx −x
/// is infinite.
pub const LIMITS: [f64; 5] = [
    formulas::SERIES_OF_ERF,
    formulas::SERIES,
    formulas::COMPLEMENT,
    formulas::ONE,
    formulas::FAR,
];

/// Two numbers that stand for their sum.
pub type Pair<R> = [R; 2];

fn of<R>(t: Dd<R>) -> Pair<R> {
    [t.hi, t.lo]
}

fn dd<R>([hi, lo]: Pair<R>) -> Dd<R> {
    Dd { hi, lo }
}

/// Returns whether erfcx and Dawson's function are their limits at x.
pub fn is_huge(x: f64) -> bool {
    branch::is_huge(0.0, x)
}

/// The formula for erfcx x, `0 ≤ x`, not huge.
pub fn erfcx_branch(x: f64) -> Branch {
    formula_of_pairs(0.0, x)
}

/// erfcx at distance t from a centre.
pub fn erfcx_row<L: Vectors>(lanes: L, row: &AxisRow, t: L::Scalar) -> Pair<L::Scalar> {
    of(axis_row(lanes, &RealRow(*row), t))
}

/// erfcx x by the asymptotic series.
pub fn erfcx_series<R: Real, const N: usize>(x: R) -> Pair<R> {
    of(series::<R, N>(x.like(0.0), x).0)
}

/// erfcx of a huge x, scaled to about one.
pub fn erfcx_far<R: Real>(x: R) -> Pair<R> {
    of(formulas::erfcx_far(x))
}

/// `e^{x²}` as a mantissa and `ROUND` plus the exponent.
pub fn exponential<R: Real>(x: R) -> (Pair<R>, R) {
    let (e, n) = formulas::growth(x);
    (of(e), n)
}

/// Returns whether erfcx −x is `2e^{x²}` alone.
pub fn alone(n: f64) -> bool {
    formulas::alone(n)
}

/// erfcx −x from `e^{x²}` and erfcx x.
pub fn erfcx_left<R: Real>((e, n): (Pair<R>, R), w: Pair<R>) -> Pair<R> {
    of(formulas::erfcx_left((dd(e), n), dd(w)))
}

/// erf x by its series.
pub fn erf_near<R: Real>(x: R) -> Pair<R> {
    of(formulas::erf_near(x))
}

/// The row of erf, and the distance from its centre.
pub fn erf_row(x: f64) -> (&'static AxisRow, f64) {
    let (n, t) = rows::on_axis(x);
    (&rows::erf_row(n).0, t)
}

/// erf x at distance t from a centre.
pub fn erf_row_value<L: Vectors>(lanes: L, row: &AxisRow, t: L::Scalar) -> Pair<L::Scalar> {
    of(axis_row(lanes, &RealRow(*row), t))
}

/// erfc x by the series of erf x.
pub fn erfc_near<R: Real>(x: R) -> Pair<R> {
    of(formulas::erfc_near(x))
}

/// erfc x from erfcx x, as a mantissa and `ROUND` plus the exponent.
pub fn erfc_right<R: Real>(x: R, w: Pair<R>) -> (Pair<R>, R) {
    let (t, n) = formulas::erfc_right(x, dd(w));
    (of(t), n)
}

/// erfc −x from erfcx x.
pub fn erfc_left<R: Real>(x: R, w: Pair<R>) -> Pair<R> {
    of(formulas::less(2.0, formulas::erfc_right(x, dd(w))))
}

/// The formula for Dawson's function, `½ ≤ x`, not huge.
pub fn dawson_branch(x: f64) -> Branch {
    match formula_of_pairs(x, 0.0) {
        rows @ (Branch::Cell { .. } | Branch::RealAxis { .. }) => rows,
        _ => series_of_pairs(x, 0.0),
    }
}

/// The row of `(2/√π) F` for that formula, F Dawson's function, and the distance from its centre.
pub fn dawson_row(x: f64) -> (AxisRow, f64) {
    let (n, t) = on_axis_of_dawson(x);
    (rows::dawson_row(n).0, t)
}

/// Dawson's function at distance t from a centre.
pub fn dawson_row_value<L: Vectors>(lanes: L, row: &AxisRow, t: L::Scalar) -> Pair<L::Scalar> {
    of(formulas::dawson_beyond(axis_row(lanes, &RealRow(*row), t)))
}

/// Dawson's function by the asymptotic series.
pub fn dawson_series<R: Real, const N: usize>(x: R) -> Pair<R> {
    of(formulas::dawson_beyond(series::<R, N>(x, x.like(0.0)).1))
}

/// Dawson's function by its series.
pub fn dawson_near<R: Real>(x: R) -> Pair<R> {
    of(formulas::dawson_near(x))
}

/// The coefficients of the series of `(√π/2) erf x` and of Dawson's function, and what the second
/// of them lacks.
pub fn odd_series() -> [(&'static [f64], f64); 2] {
    let ((erf, p), (dawson, q)) = (odd_series::ERF, odd_series::DAWSON);
    [(erf, p[0]), (dawson, q[0])]
}

/// 2/√π, √π/2 and 1/√π.
pub fn constants() -> [Pair<f64>; 3] {
    [TWO_OVER_SQRT_PI, HALF_SQRT_PI, INV_SQRT_PI].map(of)
}

/// `1/n!` from n = 3 on in the polynomial for `e^s`, and the two parts of ln 2 that reduce its
/// argument.
pub fn exponential_constants() -> (&'static [f64; 11], [f64; 2]) {
    of_pairs()
}

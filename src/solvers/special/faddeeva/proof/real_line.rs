//! The formulas for erf, erfc, erfcx and Dawson's function of a real argument.
//!
//! They give two numbers whose sum the code rounds to one.

use super::{Real, Vectors};
use crate::double_double::Dd;
use crate::exponential::of_pairs;
use crate::faddeeva::asymptotic::series;
use crate::faddeeva::branch::{Branch, ROWS_ON_REAL_AXIS, modulus_squared, series_of_pairs};
use crate::faddeeva::constants::{HALF_SQRT_PI, INV_SQRT_PI, TWO_OVER_SQRT_PI};
use crate::faddeeva::odd_series;
use crate::faddeeva::rows::on_real_axis;
use crate::faddeeva::taylor::axis_row;
use crate::faddeeva::{axis, branch, erfc_rows, real_line as formulas};

/// |x| below which Dawson's function is a Maclaurin series; from which |erf x| is 1; from which erfc
/// x is computed from erfcx x, erfc −|x| is 2, and erfcx −|x| is `2e^{x²}`; from which erfc x is 0,
/// and beyond which erfcx −x is infinite.
pub const LIMITS: [f64; 4] = [
    formulas::SERIES,
    formulas::ONE,
    formulas::BEYOND,
    formulas::FAR,
];

/// A function that has rows about `k/16`, of as many numbers: `c₀` (hi, lo), `c₁` (hi, lo), `c₂ …`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OfRows {
    /// erf.
    Erf,
    /// `(2/√π) F`, F Dawson's function.
    Dawson,
}

/// The row of a function for `x ≥ 0`, and the distance from its centre.
pub fn row(function: OfRows, x: f64) -> (&'static [f64], f64) {
    let (n, t) = on_real_axis(x);
    let row: &[f64] = match function {
        OfRows::Erf => axis::erf_row(n),
        OfRows::Dawson => axis::dawson_row(n),
    };
    (row, t)
}

/// The function at distance t from the centre of a row.
///
/// # Panics
/// If the row has fewer than twelve numbers.
pub fn row_value<L: Vectors>(lanes: L, row: &[f64], t: L::Scalar) -> Pair<L::Scalar> {
    of(axis_row(
        lanes,
        row.first_chunk::<12>().expect("twelve numbers"),
        t,
    ))
}

/// erfc c and `−(2/√π) e^{−c²}`, each in two parts, for `x ≥ 0`, and the centre c.
pub fn erfc_row(x: f64) -> (&'static [f64; 4], f64) {
    let (n, c, _) = erfc_rows::centre(x);
    (erfc_rows::erfc_row(n), c)
}

/// erfc at distance t from a centre c.
pub fn erfc_value<R: Real>(row: [R; 4], c: R, t: R) -> Pair<R> {
    of(erfc_rows::value(row, c, t))
}

/// erfcx c and erfcx −c, each in two parts, for the centre c next to `x ≥ 0`.
pub fn erfcx_row(x: f64) -> &'static [f64; 4] {
    erfc_rows::erfcx_row(erfc_rows::centre(x).0)
}

/// erfcx at distance t from a centre c of either sign, from erfcx c.
pub fn erfcx_value<R: Real>(at_centre: Pair<R>, c: R, t: R) -> Pair<R> {
    of(erfc_rows::erfcx_value(at_centre, c, t))
}

/// `1/n!` from n = 2 on in the polynomial for `e^s − 1` of [`erfcx_value`].
pub fn exponential_beside_one() -> &'static [f64; 8] {
    crate::exponential::of_few()
}

/// The coefficients `1/(m! (m + 2k + 1) k!)` of [`erfc_value`], by k; those of k = 0 begin with
/// m = 1.
pub fn erfc_terms() -> [&'static [f64]; 4] {
    let (a, b, c, d) = erfc_rows::TERMS;
    [a, b, c, d]
}

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

/// The terms of the asymptotic series for erfcx x from [`LIMITS`]`[2]` on, not huge.
pub fn erfcx_terms(x: f64) -> u32 {
    terms(0.0, x, 0.0).unwrap_or(26)
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

/// erfc x from erfcx x, as a mantissa and `ROUND` plus the exponent.
pub fn erfc_right<R: Real>(x: R, w: Pair<R>) -> (Pair<R>, R) {
    let (t, n) = formulas::erfc_right(x, dd(w));
    (of(t), n)
}

/// erfc −x from erfc x.
pub fn erfc_left<R: Real>(right: Pair<R>) -> Pair<R> {
    of(formulas::erfc_left(dd(right)))
}

/// The terms of the asymptotic series for Dawson's function, `½ ≤ x`, not huge; `None` where it has
/// rows.
pub fn dawson_terms(x: f64) -> Option<u32> {
    terms(x, 0.0, ROWS_ON_REAL_AXIS[1])
}

fn terms(a: f64, b: f64, end: f64) -> Option<u32> {
    match series_of_pairs(a, b) {
        Branch::Asymptotic { terms } if modulus_squared(a, b) >= end => Some(terms),
        _ => None,
    }
}

/// Dawson's function from `(2/√π) F`.
pub fn dawson_beyond<R: Real>(v: Pair<R>) -> Pair<R> {
    of(formulas::dawson_beyond(dd(v)))
}

/// Dawson's function by the asymptotic series.
pub fn dawson_series<R: Real, const N: usize>(x: R) -> Pair<R> {
    of(formulas::dawson_beyond(series::<R, N>(x, x.like(0.0)).1))
}

/// Dawson's function by its series.
pub fn dawson_near<R: Real>(x: R) -> Pair<R> {
    of(formulas::dawson_near(x))
}

/// The coefficients of the series of Dawson's function, and what the second of them lacks.
pub fn odd_series() -> (&'static [f64], f64) {
    let (dawson, low) = odd_series::DAWSON;
    (dawson, low[0])
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

//! Polynomials of Taylor rows for as many points as a vector has places, each with a row of its own.
//!
//! The coefficients of a row lie side by side. With 32 vector registers they are transposed, so that
//! each vector holds one coefficient of all points; with 16 there is no room for that, and each
//! point's four interleaved polynomials stay in one vector until their sums are transposed. Both
//! carry out the same operations on the same numbers.

use super::pack::{Pack, Wide, transposed};
use super::real::Real;
use super::taylor::columns;
use pulp::x86::V3;
use pulp::{cast, f64x4};

/// The four interleaved polynomials of each point in `δ⁴ = x + i y`: real parts, and imaginary parts.
pub(super) type Parts<S> = ([Pack<S>; 4], [Pack<S>; 4]);

/// `p_m = q_m + q_{m+4}δ⁴ + …`
#[inline(always)]
pub(super) fn by_columns<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    (x, y): (Pack<S>, Pack<S>),
) -> Parts<S> {
    let (mut re, mut im) = (columns(simd, rows, last), columns(simd, rows, last + 4));
    let mut at = last;
    while at > first {
        at -= 8;
        let (a, b) = (columns(simd, rows, at), columns(simd, rows, at + 4));
        for m in 0..4 {
            let r = x.fma(re[m], (-y).fma(im[m], a[m]));
            im[m] = x.fma(im[m], y.fma(re[m], b[m]));
            re[m] = r;
        }
    }
    (re, im)
}

/// The same as [`by_columns`] for four points.
#[inline(always)]
pub(super) fn by_rows<const N: usize>(
    simd: V3,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    (x, y): (Pack<V3>, Pack<V3>),
) -> Parts<V3> {
    let numbers = |v: f64x4| -> [f64; 4] { cast(v) };
    let (x, y) = (numbers(x.1), numbers(y.1));
    let load = |m: usize, at: usize| -> f64x4 {
        let row = rows[m];
        cast([row[at], row[at + 1], row[at + 2], row[at + 3]])
    };
    let zero = simd.splat_f64x4(0.0);
    let (mut re, mut im) = ([zero; 4], [zero; 4]);
    for m in 0..4 {
        let (x, y) = (simd.splat_f64x4(x[m]), simd.splat_f64x4(y[m]));
        (re[m], im[m]) = (load(m, last), load(m, last + 4));
        let mut at = last;
        while at > first {
            at -= 8;
            let r = simd.negate_mul_add_f64x4(y, im[m], load(m, at));
            let i = simd.mul_add_f64x4(y, re[m], load(m, at + 4));
            re[m] = simd.mul_add_f64x4(x, re[m], r);
            im[m] = simd.mul_add_f64x4(x, im[m], i);
        }
    }
    let pack = |v| Pack(simd, v);
    (
        transposed(simd, re).map(pack),
        transposed(simd, im).map(pack),
    )
}

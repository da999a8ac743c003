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

/// A complex number for each point.
type Z<S> = (Pack<S>, Pack<S>);

/// `Σ q_n δⁿ`, with the powers of δ up to the fourth.
#[inline(always)]
pub(super) fn by_columns<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    powers: [Z<S>; 5],
) -> Z<S> {
    let (x4, y4) = powers[4];
    let (mut re, mut im) = (columns(simd, rows, last), columns(simd, rows, last + 4));
    let mut at = last;
    while at > first {
        at -= 8;
        let (a, b) = (columns(simd, rows, at), columns(simd, rows, at + 4));
        for m in 0..4 {
            let r = x4.fma(re[m], (-y4).fma(im[m], a[m]));
            im[m] = x4.fma(im[m], y4.fma(re[m], b[m]));
            re[m] = r;
        }
    }
    let (mut sr, mut si) = (re, im);
    for m in 1..4 {
        let (px, py) = powers[m];
        sr[m] = (-py).fma(im[m], px * re[m]);
        si[m] = px.fma(im[m], py * re[m]);
    }
    (total(sr), total(si))
}

#[inline(always)]
fn total<S: Wide>(s: [Pack<S>; 4]) -> Pack<S> {
    (s[0] + s[2]) + (s[1] + s[3])
}

#[inline(always)]
fn total_of_rows(simd: V3, s: [f64x4; 4]) -> Pack<V3> {
    let [a, b, c, d] = transposed(simd, s);
    total([Pack(simd, a), Pack(simd, b), Pack(simd, c), Pack(simd, d)])
}

/// The same as [`by_columns`] for four points.
#[inline(always)]
pub(super) fn by_rows<const N: usize>(
    simd: V3,
    rows: &[&[f64; N]; 8],
    (first, last): (usize, usize),
    powers: [Z<V3>; 5],
) -> Z<V3> {
    let numbers = |v: f64x4| -> [f64; 4] { cast(v) };
    let (x4, y4) = (numbers(powers[4].0.1), numbers(powers[4].1.1));
    let load = |m: usize, at: usize| -> f64x4 {
        let row = rows[m];
        cast([row[at], row[at + 1], row[at + 2], row[at + 3]])
    };
    let zero = simd.splat_f64x4(0.0);
    let (mut re, mut im) = ([zero; 4], [zero; 4]);
    for m in 0..4 {
        (re[m], im[m]) = (load(m, last), load(m, last + 4));
    }
    let blocks = (last - first) / 8;
    for block in 1..=blocks {
        let at = last - 8 * block;
        for m in 0..4 {
            let (x, y) = (simd.splat_f64x4(x4[m]), simd.splat_f64x4(y4[m]));
            let r = simd.negate_mul_add_f64x4(y, im[m], load(m, at));
            let i = simd.mul_add_f64x4(y, re[m], load(m, at + 4));
            re[m] = simd.mul_add_f64x4(x, re[m], r);
            im[m] = simd.mul_add_f64x4(x, im[m], i);
        }
    }
    // The powers of each point side by side.
    let [(p0, q0), (p1, q1), (p2, q2), (p3, q3), _] = powers;
    let px = transposed(simd, [p0.1, p1.1, p2.1, p3.1]);
    let py = transposed(simd, [q0.1, q1.1, q2.1, q3.1]);
    let (mut sr, mut si) = (re, im);
    for m in 0..4 {
        sr[m] = simd.negate_mul_add_f64x4(py[m], im[m], simd.mul_f64x4(px[m], re[m]));
        si[m] = simd.mul_add_f64x4(px[m], im[m], simd.mul_f64x4(py[m], re[m]));
    }
    (total_of_rows(simd, sr), total_of_rows(simd, si))
}

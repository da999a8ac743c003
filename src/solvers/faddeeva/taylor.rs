//! Taylor rows: W(z) near a tabulated centre.
//!
//! ```text
//! w(c + δ) = c₀ + c₁δ + δ²(q₀ + q₁δ + … + q₁₅δ¹⁵),   c_n = w⁽ⁿ⁾(c)/n!
//! ```
//!
//! `c₀` and `c₁` are stored as two `f64` each and `c₁δ` is formed with exact products, so that the
//! rounding errors left come from the last term alone. The sixteen coefficients are summed as four
//! interleaved polynomials in δ⁴, which the compiler turns into vector instructions.

use super::double_double::{Dd, fast_two_sum, two_prod, two_sum};

/// `Re c₀` (hi, lo), `Im c₀`, `Re c₁`, `Im c₁`, then four blocks of four real and four imaginary
/// parts of `q`.
#[repr(align(64))]
pub(super) struct ComplexRow(pub [f64; 40]);

/// `c₀` (hi, lo), `c₁` (hi, lo), `q₀ … q₁₅`, all real.
#[repr(align(32))]
pub(super) struct RealRow(pub [f64; 20]);

#[inline(always)]
fn block(c: &[f64], at: usize) -> [f64; 4] {
    [c[at], c[at + 1], c[at + 2], c[at + 3]]
}

#[inline(always)]
fn sum(v: [f64; 4]) -> f64 {
    (v[0] + v[2]) + (v[1] + v[3])
}

/// Real and imaginary part of `w(c + dx + i dy)`, unevaluated.
#[inline(always)]
pub(super) fn complex_row(row: &ComplexRow, dx: f64, dy: f64) -> (Dd, Dd) {
    let c = &row.0;
    // δ², δ³, δ⁴.
    let (x2, y2) = (dx.mul_add(dx, -(dy * dy)), 2.0 * dx * dy);
    let (x3, y3) = (x2.mul_add(dx, -(y2 * dy)), x2.mul_add(dy, y2 * dx));
    let (x4, y4) = (x2.mul_add(x2, -(y2 * y2)), 2.0 * x2 * y2);
    let mut re = block(c, 32);
    let mut im = block(c, 36);
    for k in (0..3).rev() {
        let (a, b) = (block(c, 8 + 8 * k), block(c, 12 + 8 * k));
        for m in 0..4 {
            let r = x4.mul_add(re[m], (-y4).mul_add(im[m], a[m]));
            let i = x4.mul_add(im[m], y4.mul_add(re[m], b[m]));
            re[m] = r;
            im[m] = i;
        }
    }
    let (px, py) = ([1.0, dx, x2, x3], [0.0, dy, y2, y3]);
    let (mut sr, mut si) = ([0.0; 4], [0.0; 4]);
    for m in 0..4 {
        sr[m] = px[m].mul_add(re[m], -(py[m] * im[m]));
        si[m] = px[m].mul_add(im[m], py[m] * re[m]);
    }
    let (qr, qi) = (sum(sr), sum(si));
    let (tr, ti) = (x2.mul_add(qr, -(y2 * qi)), x2.mul_add(qi, y2 * qr));

    // c₀ + c₁δ with exact products.
    let (a, b) = (two_prod(c[4], dx), two_prod(c[6], dy));
    let s = two_sum(a.hi, -b.hi);
    let lo = s.lo + (a.lo - b.lo) + c[5].mul_add(dx, -(c[7] * dy)) + c[1] + tr;
    let h = two_sum(c[0], s.hi);
    let re = fast_two_sum(h.hi, h.lo + lo);

    let (a, b) = (two_prod(c[4], dy), two_prod(c[6], dx));
    let s = two_sum(a.hi, b.hi);
    let lo = s.lo + (a.lo + b.lo) + c[5].mul_add(dy, c[7] * dx) + c[3] + ti;
    let h = two_sum(c[2], s.hi);
    let im = fast_two_sum(h.hi, h.lo + lo);
    (re, im)
}

/// For a function `f` real on the real axis and expanded about a real centre: the real part of
/// `f(c + t + i b)` and its imaginary part divided by `b`.
#[inline(always)]
pub(super) fn real_row(row: &RealRow, t: f64, b: f64) -> (Dd, Dd) {
    let c = &row.0;
    let bb = b * b;
    // δⁿ = pₙ + i b sₙ.
    let (p2, s2) = (t.mul_add(t, -bb), 2.0 * t);
    let (p3, s3) = (t.mul_add(p2, -(bb * s2)), t.mul_add(s2, p2));
    let (p4, s4) = (p2.mul_add(p2, -(bb * s2 * s2)), 2.0 * p2 * s2);
    let bs4 = bb * s4;
    let mut re = block(c, 16);
    let mut im = [0.0; 4];
    for k in (0..3).rev() {
        let v = block(c, 4 + 4 * k);
        for m in 0..4 {
            let r = p4.mul_add(re[m], (-bs4).mul_add(im[m], v[m]));
            let i = p4.mul_add(im[m], s4 * re[m]);
            re[m] = r;
            im[m] = i;
        }
    }
    let (p, s) = ([1.0, t, p2, p3], [0.0, 1.0, s2, s3]);
    let (mut qr, mut qs) = ([0.0; 4], [0.0; 4]);
    for m in 0..4 {
        qr[m] = p[m].mul_add(re[m], -(bb * s[m] * im[m]));
        qs[m] = p[m].mul_add(im[m], s[m] * re[m]);
    }
    let (qr, qs) = (sum(qr), sum(qs));
    let (tr, ts) = (p2.mul_add(qr, -(bb * s2 * qs)), p2.mul_add(qs, s2 * qr));

    let a = two_prod(c[2], t);
    let h = two_sum(c[0], a.hi);
    let re = fast_two_sum(h.hi, h.lo + (a.lo + c[3].mul_add(t, c[1]) + tr));
    let im = fast_two_sum(c[2], c[3] + ts);
    (re, im)
}

//! Taylor rows: W(z) near a tabulated centre.
//!
//! ```text
//! w(c + δ) = c₀ + c₁δ + δ²(q₀ + q₁δ + … + q₁₅δ¹⁵),   c_n = w⁽ⁿ⁾(c)/n!
//! ```
//!
//! `c₀` and `c₁` are stored as two `f64` each and `c₁δ` is formed with exact products, so that the
//! rounding errors left come from the last term alone. The sixteen coefficients are summed as four
//! interleaved polynomials in δ⁴, which the compiler turns into vector instructions.

use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use crate::lanes::Vectors;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use crate::pack::{Pack, Wide, columns};
use crate::real::Real;

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
fn first_eight<R: Real>(x: R, c: &[f64; 40]) -> [R; 8] {
    let at = |k: usize| x.like(c[k]);
    [at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7)]
}

/// `δ²`
#[inline(always)]
pub(super) fn square<R: Real>(dx: R, dy: R) -> (R, R) {
    (dx.fma(dx, -(dy * dy)), (dx + dx) * dy)
}

/// `q₀ + q₁δ + …` from blocks of four real and four imaginary parts, the first one at `first`, the
/// last one at `last`, with `δ² = x2 + i y2`.
#[inline(always)]
pub(super) fn polynomial<L: Vectors>(
    lanes: L,
    c: &[f64],
    (first, last): (usize, usize),
    delta: (L::Scalar, L::Scalar),
    d2: (L::Scalar, L::Scalar),
) -> (L::Scalar, L::Scalar) {
    let (x4, y4) = square(d2.0, d2.1);
    let (x4, y4) = (lanes.splat(x4), lanes.splat(y4));
    let mut re = lanes.entries(block(c, last));
    let mut im = lanes.entries(block(c, last + 4));
    let mut at = last;
    while at > first {
        at -= 8;
        let (a, b) = (lanes.entries(block(c, at)), lanes.entries(block(c, at + 4)));
        let r = lanes.mul_add(x4, re, lanes.neg_mul_add(y4, im, a));
        im = lanes.mul_add(x4, im, lanes.mul_add(y4, re, b));
        re = r;
    }
    interleaved(lanes.parts(re), lanes.parts(im), delta, d2)
}

/// `(a + i b) + (x + i y)(u + i v)`
#[inline(always)]
fn plus<R: Real>((a, b): (R, R), (x, y): (R, R), (u, v): (R, R)) -> (R, R) {
    (x.fma(u, (-y).fma(v, a)), x.fma(v, y.fma(u, b)))
}

/// `p₀ + p₁δ + p₂δ² + p₃δ³` from real and imaginary parts.
#[inline(always)]
pub(super) fn interleaved<R: Real>(re: [R; 4], im: [R; 4], delta: (R, R), d2: (R, R)) -> (R, R) {
    let even = plus((re[0], im[0]), d2, (re[2], im[2]));
    let odd = plus((re[1], im[1]), d2, (re[3], im[3]));
    plus(even, delta, odd)
}

/// `c₀ + c₁δ + δ²q` with exact products; `c` as at the beginning of a [`ComplexRow`].
#[inline(always)]
fn complex_sum<R: Real>(
    c: [R; 8],
    (dx, dy): (R, R),
    (x2, y2): (R, R),
    (qr, qi): (R, R),
) -> (Dd<R>, Dd<R>) {
    let (tr, ti) = (x2.fma(qr, -(y2 * qi)), x2.fma(qi, y2 * qr));
    let (a, b) = (two_prod(c[4], dx), two_prod(c[6], dy));
    let s = two_sum(a.hi, -b.hi);
    let lo = s.lo + (a.lo - b.lo) + c[5].fma(dx, -(c[7] * dy)) + c[1] + tr;
    let h = two_sum(c[0], s.hi);
    let re = fast_two_sum(h.hi, h.lo + lo);

    let (a, b) = (two_prod(c[4], dy), two_prod(c[6], dx));
    let s = two_sum(a.hi, b.hi);
    let lo = s.lo + (a.lo + b.lo) + c[5].fma(dy, c[7] * dx) + c[3] + ti;
    let h = two_sum(c[2], s.hi);
    let im = fast_two_sum(h.hi, h.lo + lo);
    (re, im)
}

/// `c₀ + c₁δ + δ²q`, rounded, from the same numbers: the smallest terms first, so that of the
/// roundings but the last none is of the whole.
#[inline(always)]
fn complex_sum_rounded<R: Real>(c: [R; 8], delta: (R, R), d2: (R, R), q: (R, R)) -> (R, R) {
    let (dx, dy) = delta;
    let low = (
        c[5].fma(dx, (-c[7]).fma(dy, c[1])),
        c[5].fma(dy, c[7].fma(dx, c[3])),
    );
    let (re, im) = plus(plus(low, d2, q), delta, (c[4], c[6]));
    (c[0] + re, c[2] + im)
}

/// Real and imaginary part of `w(c + dx + i dy)`, each as one number.
#[inline(always)]
pub(super) fn complex_row_rounded<L: Vectors>(
    lanes: L,
    row: &ComplexRow,
    dx: L::Scalar,
    dy: L::Scalar,
) -> (L::Scalar, L::Scalar) {
    let c = &row.0;
    let d2 = square(dx, dy);
    let q = polynomial(lanes, c, (8, 32), (dx, dy), d2);
    complex_sum_rounded(first_eight(dx, c), (dx, dy), d2, q)
}

/// Real and imaginary part of `w(c + dx + i dy)`, unevaluated.
#[inline(always)]
pub(super) fn complex_row<L: Vectors>(
    lanes: L,
    row: &ComplexRow,
    dx: L::Scalar,
    dy: L::Scalar,
) -> (Dd<L::Scalar>, Dd<L::Scalar>) {
    let c = &row.0;
    let d2 = square(dx, dy);
    let q = polynomial(lanes, c, (8, 32), (dx, dy), d2);
    complex_sum(first_eight(dx, c), (dx, dy), d2, q)
}

/// `c + x t`, whose parts need not be normal, and those of `c` and `t` neither.
#[inline(always)]
fn plus_times<R: Real>(
    c: (Dd<R>, Dd<R>),
    (x, y): (R, R),
    (u, v): (Dd<R>, Dd<R>),
) -> (Dd<R>, Dd<R>) {
    (
        plus_products(c.0, (x, u), (-y, v)),
        plus_products(c.1, (x, v), (y, u)),
    )
}

/// `c + x u + y v` likewise.
#[inline(always)]
fn plus_products<R: Real>(c: Dd<R>, (x, u): (R, Dd<R>), (y, v): (R, Dd<R>)) -> Dd<R> {
    let (p, q) = (two_prod(x, u.hi), two_prod(y, v.hi));
    let s = two_sum(p.hi, q.hi);
    let t = two_sum(c.hi, s.hi);
    let low = x.fma(u.lo, y.fma(v.lo, c.lo));
    Dd::new(t.hi, t.lo + (s.lo + (p.lo + q.lo) + low))
}

/// w by [`complex_sum`] or [`real_sum`]: terms from the second order on are rounded.
pub(super) const SHORT: u8 = 0;
/// w by [`long_sum`]: terms from the third order on are rounded.
pub(super) const LONG: u8 = 1;
/// w′ likewise.
pub(super) const SLOPE: u8 = 2;

/// Columns of a [`ComplexRow`]: the first eight, and `c₃`, `c₄` and `c₅`.
type Leading<R> = ([R; 8], [(R, R); 3]);

/// `w(c + δ)`, or `w′(c + δ)`. With `z = c + δ` and, from the equation `w′ = −2zw + 2i/√π`,
/// `e₁ = c₀ + c c₁ = −c₂` and `e₂ = c₁ − c e₁ = −(3/2) c₃`
///
/// ```text
/// w(z) = c₀ + δ (c₁ + δ (−e₁ + δ (c₃ + δp))),   p = c₄ + c₅δ + δ²r,   r = c₆ + c₇δ + …
/// w′(z) = c₁ − 2δ (e₁ + δ (e₂ − δ (2c₄ − δ (c₃ + zp))))
/// ```
///
/// where the terms up to that of second order are unevaluated sums.
#[inline(always)]
fn long_sum<R: Real, const SUM: u8>(
    (c, [c3, c4, c5]): Leading<R>,
    centre: (R, R),
    delta: (R, R),
    d2: (R, R),
    r: (R, R),
) -> (Dd<R>, Dd<R>) {
    let c0 = (Dd::new(c[0], c[1]), Dd::new(c[2], c[3]));
    let c1 = (Dd::new(c[4], c[5]), Dd::new(c[6], c[7]));
    let e1 = plus_times(c0, centre, c1);
    let p = plus(plus(c4, delta, c5), d2, r);
    let (u, v) = if SUM == SLOPE {
        let (mut u, mut v) = plus_times(c1, (-centre.0, -centre.1), e1);
        let z = (centre.0 + delta.0, centre.1 + delta.1);
        let back = (-delta.0, -delta.1);
        let rest = plus((c4.0 + c4.0, c4.1 + c4.1), back, plus(c3, z, p));
        (u.lo, v.lo) = plus((u.lo, v.lo), back, rest);
        let twice = (back.0 + back.0, back.1 + back.1);
        plus_times(c1, twice, plus_times(e1, delta, (u, v)))
    } else {
        let (mut u, mut v) = (-e1.0, -e1.1);
        (u.lo, v.lo) = plus((u.lo, v.lo), delta, plus(c3, delta, p));
        plus_times(c0, delta, plus_times(c1, delta, (u, v)))
    };
    (u.normal(), v.normal())
}

/// `r + c₁₈δ¹²`, `c₁₈ = −(c c₁₇ + c₁₆)/9`: its term of w is multiplied by `2z`.
#[inline(always)]
fn with_next<R: Real>(r: (R, R), centre: (R, R), d2: (R, R), [c16, c17]: [(R, R); 2]) -> (R, R) {
    let zero = r.0.like(0.0);
    let d4 = square(d2.0, d2.1);
    let d12 = plus((zero, zero), d4, square(d4.0, d4.1));
    let sum = plus(c16, centre, c17);
    let ninth = r.0.like(-1.0 / 9.0);
    plus(r, d12, (sum.0 * ninth, sum.1 * ninth))
}

/// Real and imaginary part of `w(c + δ)`, or of `w′(c + δ)`, unevaluated, by the sum `SUM`.
#[inline(always)]
pub(super) fn summed_row<L: Vectors, const SUM: u8>(
    lanes: L,
    row: &ComplexRow,
    centre: (L::Scalar, L::Scalar),
    delta: (L::Scalar, L::Scalar),
) -> (Dd<L::Scalar>, Dd<L::Scalar>) {
    if SUM == SHORT {
        return complex_row(lanes, row, delta.0, delta.1);
    }
    let c = &row.0;
    let d2 = square(delta.0, delta.1);
    let mut r = polynomial(lanes, c, (16, 32), delta, d2);
    let at = |k: usize| (d2.0.like(c[k]), d2.0.like(c[k + 4]));
    if SUM == SLOPE {
        r = with_next(r, centre, d2, [at(34), at(35)]);
    }
    let leading = (first_eight(d2.0, c), [at(9), at(10), at(11)]);
    long_sum::<_, SUM>(leading, centre, delta, d2, r)
}

/// The powers of `δ = t + i b` up to the fourth: real parts, and imaginary parts divided by `b`.
#[inline(always)]
fn real_powers<R: Real>(t: R, bb: R) -> ([R; 5], [R; 5]) {
    let (p2, s2) = (t.fma(t, -bb), t + t);
    let (p3, s3) = (t.fma(p2, -(bb * s2)), t.fma(s2, p2));
    let (p4, s4) = (p2.fma(p2, -(bb * s2 * s2)), (p2 + p2) * s2);
    let (one, zero) = (t.like(1.0), t.like(0.0));
    ([one, t, p2, p3, p4], [zero, one, s2, s3, s4])
}

/// `c₀ + c₁δ + δ²q`; `c` as at the beginning of a [`RealRow`].
#[inline(always)]
fn real_sum<R: Real>(
    c: [R; 4],
    (t, bb): (R, R),
    (p2, s2): (R, R),
    (qr, qs): (R, R),
) -> (Dd<R>, Dd<R>) {
    let (tr, ts) = (p2.fma(qr, -(bb * s2 * qs)), p2.fma(qs, s2 * qr));
    let a = two_prod(c[2], t);
    let h = two_sum(c[0], a.hi);
    let re = fast_two_sum(h.hi, h.lo + (a.lo + c[3].fma(t, c[1]) + tr));
    let im = fast_two_sum(c[2], c[3] + ts);
    (re, im)
}

/// For a function `f` real on the real axis and expanded about a real centre: the real part of
/// `f(c + t + i b)` and its imaginary part divided by `b`.
#[inline(always)]
pub(super) fn real_row<L: Vectors>(
    lanes: L,
    row: &[f64; 20],
    t: L::Scalar,
    b: L::Scalar,
) -> (Dd<L::Scalar>, Dd<L::Scalar>) {
    let (c, bb, powers, q) = real_polynomial(lanes, row, 4, t, b);
    real_sum(c, (t, bb), powers, q)
}

/// `(Re w, Im w)` from the expansion of `w(i s) = erfcx s` about a real centre.
#[inline(always)]
fn from_erfcx<R: Real>(a: R, (p, s): (Dd<R>, Dd<R>)) -> (Dd<R>, Dd<R>) {
    let minus = -a;
    let m = minus * s.hi;
    (p, fast_two_sum(m, minus.fma(s.lo, minus.fma(s.hi, -m))))
}

/// [`long_sum`] at `b + i (c + t)` from the row of erfcx about `c`: as `w(iζ) = erfcx ζ`, its
/// coefficients are those of w times powers of i, and what is zero stays zero.
#[inline(always)]
fn beside_imaginary_axis<R: Real, const SUM: u8>(
    (c, [c3, c4, c5]): ([R; 4], [R; 3]),
    centre: R,
    (t, b): (R, R),
    (qr, qs): (R, R),
) -> (Dd<R>, Dd<R>) {
    let zero = t.like(0.0);
    let leading = [c[0], c[1], zero, zero, zero, zero, -c[2], -c[3]];
    let next = [(zero, c3), (c4, zero), (zero, -c5)];
    let r = (-qr, b * qs);
    long_sum::<_, SUM>((leading, next), (zero, centre), (b, t), square(b, t), r)
}

/// [`summed_row`] at `b + i (c + t)` from the row of erfcx about `c`.
#[inline(always)]
pub(super) fn summed_real_row<L: Vectors, const SUM: u8>(
    lanes: L,
    row: &[f64; 20],
    centre: L::Scalar,
    (t, b): (L::Scalar, L::Scalar),
) -> (Dd<L::Scalar>, Dd<L::Scalar>) {
    if SUM == SHORT {
        return from_erfcx(b, real_row(lanes, row, t, b));
    }
    let (c, _, _, r) = real_polynomial(lanes, row, 8, t, b);
    let next = [t.like(row[5]), t.like(row[6]), t.like(row[7])];
    beside_imaginary_axis::<_, SUM>((c, next), centre, (t, b), r)
}

/// The first four numbers of a [`RealRow`], b², δ², and what is left.
type RealPolynomial<R> = ([R; 4], R, (R, R), (R, R));

/// The first four numbers of the row, b², δ² and the polynomial in δ whose coefficients stand from
/// `first` on, imaginary parts divided by `b`.
#[inline(always)]
fn real_polynomial<L: Vectors>(
    lanes: L,
    c: &[f64; 20],
    first: usize,
    t: L::Scalar,
    b: L::Scalar,
) -> RealPolynomial<L::Scalar> {
    let (zero, one) = (t.like(0.0), t.like(1.0));
    let bb = b * b;
    let (p, s) = real_powers(t, bb);
    let (p4, s4, bs4) = (lanes.splat(p[4]), lanes.splat(s[4]), lanes.splat(bb * s[4]));
    let mut re = lanes.entries(block(c, 16));
    let mut im = lanes.mul(s4, re);
    re = lanes.mul_add(p4, re, lanes.entries(block(c, 12)));
    let mut at = 12;
    while at > first {
        at -= 4;
        let v = lanes.entries(block(c, at));
        let r = lanes.mul_add(p4, re, lanes.neg_mul_add(bs4, im, v));
        im = lanes.mul_add(p4, im, lanes.mul(s4, re));
        re = r;
    }
    let bs = lanes.load([zero, bb, bb * s[2], bb * s[3]]);
    let (pv, sv) = (
        lanes.load([one, t, p[2], p[3]]),
        lanes.load([zero, one, s[2], s[3]]),
    );
    let qr = lanes.sum(lanes.neg_mul_add(bs, im, lanes.mul(pv, re)));
    let qs = lanes.sum(lanes.mul_add(pv, im, lanes.mul(sv, re)));
    (block(c, 0).map(|c| t.like(c)), bb, (p[2], s[2]), (qr, qs))
}

/// `f(c + t)` from a row of real coefficients, of which a [`RealRow`] has twenty; [`real_row`] has
/// the same bits for `b = 0`.
#[inline(always)]
pub(super) fn axis_row<L: Vectors, const N: usize>(
    lanes: L,
    c: &[f64; N],
    t: L::Scalar,
) -> Dd<L::Scalar> {
    let t4 = lanes.splat(fourth_power(t));
    let mut sums = lanes.entries(block(c, N - 4));
    let mut at = N - 4;
    while at > 4 {
        at -= 4;
        sums = lanes.mul_add(t4, sums, lanes.entries(block(c, at)));
    }
    axis_sum(block(c, 0).map(|c| t.like(c)), t, lanes.parts(sums))
}

#[inline(always)]
fn fourth_power<R: Real>(t: R) -> R {
    let t2 = t * t;
    t2 * t2
}

/// `c₀ + c₁t + t²(p₀ + p₁t + p₂t² + p₃t³)`; `c` as at the beginning of a row.
#[inline(always)]
fn axis_sum<R: Real>(c: [R; 4], t: R, p: [R; 4]) -> Dd<R> {
    let t2 = t * t;
    let q = (p[0] + t2 * p[2]) + (t * p[1] + (t * t2) * p[3]);
    let a = two_prod(c[2], t);
    let h = fast_two_sum(c[0], a.hi);
    fast_two_sum(h.hi, h.lo + (a.lo + c[3].fma(t, c[1]) + t2 * q))
}

/// [`axis_row`] for several points with a row each.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
pub(super) fn axis_rows<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    t: Pack<S>,
) -> Dd<Pack<S>> {
    let sums = simd.real_polynomials(rows, (4, N - 4), fourth_power(t));
    axis_sum(columns(simd, rows, 0), t, sums)
}

/// [`real_row`] for several points with a row each.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
pub(super) fn real_rows<S: Wide>(
    simd: S,
    rows: &[&[f64; 20]; 8],
    t: Pack<S>,
    b: Pack<S>,
) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
    let (c, bb, powers, q) = real_polynomials(simd, rows, 4, t, b);
    real_sum(c, (t, bb), powers, q)
}

/// [`summed_real_row`] for several points with a row each.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
pub(super) fn summed_real_rows<S: Wide, const SUM: u8>(
    simd: S,
    rows: &[&[f64; 20]; 8],
    centre: Pack<S>,
    (t, b): (Pack<S>, Pack<S>),
) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
    if SUM == SHORT {
        return from_erfcx(b, real_rows(simd, rows, t, b));
    }
    let (c, _, _, r) = real_polynomials(simd, rows, 8, t, b);
    let [_, c3, c4, c5] = columns(simd, rows, 4);
    let leading = (c, [c3, c4, c5]);
    beside_imaginary_axis::<_, SUM>(leading, centre, (t, b), r)
}

/// [`real_polynomial`] for several points with a row each.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
fn real_polynomials<S: Wide>(
    simd: S,
    rows: &[&[f64; 20]; 8],
    first: usize,
    t: Pack<S>,
    b: Pack<S>,
) -> RealPolynomial<Pack<S>> {
    let bb = b * b;
    let (p, s) = real_powers(t, bb);
    let bs4 = -(bb * s[4]);
    let mut re = columns(simd, rows, 16);
    let mut im = re.map(|r| s[4] * r);
    let c = columns(simd, rows, 12);
    for m in 0..4 {
        re[m] = p[4].fma(re[m], c[m]);
    }
    let mut at = 12;
    while at > first {
        at -= 4;
        let c = columns(simd, rows, at);
        for m in 0..4 {
            let r = p[4].fma(re[m], bs4.fma(im[m], c[m]));
            im[m] = p[4].fma(im[m], s[4] * re[m]);
            re[m] = r;
        }
    }
    let part = |m: usize| (-(bb * s[m])).fma(im[m], p[m] * re[m]);
    let slope = |m: usize| p[m].fma(im[m], s[m] * re[m]);
    let qr = (re[0] + part(2)) + (part(1) + part(3));
    let qs = (im[0] + slope(2)) + (slope(1) + slope(3));
    (columns(simd, rows, 0), bb, (p[2], s[2]), (qr, qs))
}

/// [`polynomial`] for several points with a row each.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
#[inline(always)]
pub(super) fn polynomials<S: Wide, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; 8],
    ends: (usize, usize),
    delta: (Pack<S>, Pack<S>),
    d2: (Pack<S>, Pack<S>),
) -> (Pack<S>, Pack<S>) {
    let (re, im) = simd.polynomials(rows, ends, square(d2.0, d2.1));
    interleaved(re, im, delta, d2)
}

/// Several points with a row each, and the distances from the centres.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
pub(super) struct OnRows<'a, S: Wide> {
    pub rows: [&'a [f64; 40]; 8],
    pub dx: Pack<S>,
    pub dy: Pack<S>,
}

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
impl<S: Wide> OnRows<'_, S> {
    /// [`complex_row`]
    #[inline(always)]
    pub(super) fn unevaluated(&self, simd: S) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
        let [d2, q] = self.polynomials(simd);
        complex_sum(self.leading(simd), (self.dx, self.dy), d2, q)
    }

    /// [`complex_row_rounded`]
    #[inline(always)]
    pub(super) fn rounded(&self, simd: S) -> (Pack<S>, Pack<S>) {
        let [d2, q] = self.polynomials(simd);
        complex_sum_rounded(self.leading(simd), (self.dx, self.dy), d2, q)
    }

    /// [`summed_row`]
    #[inline(always)]
    pub(super) fn summed<const SUM: u8>(
        &self,
        simd: S,
        centre: (Pack<S>, Pack<S>),
    ) -> (Dd<Pack<S>>, Dd<Pack<S>>) {
        if SUM == SHORT {
            return self.unevaluated(simd);
        }
        let delta = (self.dx, self.dy);
        let d2 = square(self.dx, self.dy);
        let mut r = polynomials(simd, &self.rows, (16, 32), delta, d2);
        if SUM == SLOPE {
            let [_, _, c16, c17] = self.block(simd, 32);
            r = with_next(r, centre, d2, [c16, c17]);
        }
        let [_, c3, c4, c5] = self.block(simd, 8);
        long_sum::<_, SUM>((self.leading(simd), [c3, c4, c5]), centre, delta, d2, r)
    }

    /// Four complex coefficients.
    #[inline(always)]
    fn block(&self, simd: S, at: usize) -> [(Pack<S>, Pack<S>); 4] {
        let [a, b, c, d] = columns(simd, &self.rows, at);
        let [p, q, r, s] = columns(simd, &self.rows, at + 4);
        [(a, p), (b, q), (c, r), (d, s)]
    }

    /// δ² and `q₀ + q₁δ + …`
    #[inline(always)]
    fn polynomials(&self, simd: S) -> [(Pack<S>, Pack<S>); 2] {
        let d2 = square(self.dx, self.dy);
        let delta = (self.dx, self.dy);
        [d2, polynomials(simd, &self.rows, (8, 32), delta, d2)]
    }

    #[inline(always)]
    fn leading(&self, simd: S) -> [Pack<S>; 8] {
        let (a, b) = (columns(simd, &self.rows, 0), columns(simd, &self.rows, 4));
        [a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]
    }
}

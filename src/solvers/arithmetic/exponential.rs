//! `e^{−z²}` without the error of a rounded `z²`.
//!
//! With `z = a + i y`: `−z² = (y − a)(y + a) − 2 a y i`. Both parts are formed exactly or to 2⁻¹⁰⁴
//! as two `f64`, then reduced by multiples of ln 2 and π/2 that are themselves kept to 160 bits
//! (Cody & Waite, *Software Manual for the Elementary Functions*, 1980; phases from 2³⁰ upwards are
//! left to [`payne_hanek`](super::payne_hanek)). The factors are returned as `hi + lo` with a
//! relative error of 0.06 · 2⁻⁵² at the worst found by their test (12 000 points), the power of two
//! apart.

use super::payne_hanek;
use super::tables::{self, HALF_PI, INVERSE_FACTORIAL};
use crate::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use crate::hex::hex;
use crate::real::{Masked, ROUND, Real, scaled};

const LOG2_E: f64 = std::f64::consts::LOG2_E;
/// ln 2, the first part with 12 trailing zeros, so that its product with an exponent is exact.
const LN_2: [f64; 2] = [hex("0x1.62e42fefa3p-1"), hex("0x1.3de6af278ece6p-42")];
const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
/// Phases below this are reduced by [`reduce`].
pub(crate) const LARGE_PHASE: f64 = hex("0x1p30");

/// Exponents are cut here: `e^{±1400}` is outside the range of `f64` whatever normal number it is
/// multiplied by, and half of its binary exponent inside. Subnormal factors need [`exp_wide`].
const CUT: f64 = 1400.0;

/// `y² − a² = (y − a)(y + a)`.
#[inline(always)]
pub(crate) fn exponent<R: Real>(a: R, y: R) -> Dd<R> {
    let (d, s) = (two_sum(y, -a), two_sum(y, a));
    let p = two_prod(d.hi, s.hi);
    fast_two_sum(p.hi, d.lo.fma(s.lo, d.hi.fma(s.lo, d.lo.fma(s.hi, p.lo))))
}

/// `y² − a²` for |y| ≤ 1/8, `a ≥ 9`.
#[inline(always)]
pub(crate) fn exponent_in_strip<R: Real>(a: R, y: R) -> Dd<R> {
    let p = two_prod(a, a);
    let y = y.magnitude().raised(1e-140);
    Dd::new(-p.hi, y.fma(y, -p.lo))
}

/// `2 a y`, exactly.
#[inline(always)]
pub(crate) fn phase<R: Real>(a: R, y: R) -> Dd<R> {
    two_prod(a + a, y)
}

/// `1/n!`
const fn inverse_factorial(n: u32) -> f64 {
    let mut f = 1.0;
    let mut k = 2;
    while k <= n {
        f *= k as f64;
        k += 1;
    }
    1.0 / f
}

/// Coefficients `sign^j/(first + 2j)!` or, with `step = 1`, `1/(first + j)!`.
const fn reciprocals<const N: usize>(first: u32, step: u32, sign: f64) -> [f64; N] {
    let mut c = [0.0; N];
    let mut j = 0;
    let mut s = 1.0;
    while j < N {
        c[j] = s * inverse_factorial(first + step * j as u32);
        s *= sign;
        j += 1;
    }
    c
}

const EXP: [f64; 12] = reciprocals(2, 1, 1.0);
const FEW_OF_EXP: [f64; 8] = reciprocals(2, 1, 1.0);
const EXP_FROM_CUBE: [f64; 11] = reciprocals(3, 1, 1.0);
const EXP_FROM_FOURTH: [f64; 11] = reciprocals(4, 1, 1.0);
const SIN: [f64; 8] = reciprocals(3, 2, -1.0);
const SIN_FROM_FIFTH: [f64; 7] = reciprocals(5, 2, -1.0);
/// 1/6.
const SIXTH: Dd = Dd::new(INVERSE_FACTORIAL[3][0], INVERSE_FACTORIAL[3][1]);
const COS: [f64; 7] = reciprocals(4, 2, -1.0);
const COS_FROM_SIXTH: [f64; 7] = reciprocals(6, 2, -1.0);
/// 1/3.
const THIRD: Dd = Dd::new(2.0 * INVERSE_FACTORIAL[3][0], 2.0 * INVERSE_FACTORIAL[3][1]);

/// `Σ c_k x^k` by even and odd terms: half the length of the chain of dependent operations.
#[inline(always)]
pub(crate) fn paired<R: Real, const N: usize>(c: &[f64; N], x: R) -> R {
    let xx = x * x;
    let top = |k: usize| x.like(c[k]);
    let (mut even, mut odd) = (top((N - 1) & !1), top((N - 2) | 1));
    let mut k = N - 2;
    while k > 0 {
        k -= 1;
        if k.is_multiple_of(2) {
            even = xx.fma(even, x.like(c[k]));
        } else {
            odd = xx.fma(odd, x.like(c[k]));
        }
    }
    x.fma(odd, even)
}

/// `ROUND + k` for the `k` with `e^x = m 2^k`, |x| cut at 1400.
#[inline(always)]
pub(crate) fn binary_exponent<R: Real>(x: R) -> (R, R) {
    let h = x.at_least(x.like(-CUT)).at_most(x.like(CUT));
    (h, h.fma(x.like(LOG2_E), x.like(ROUND)))
}

/// `e^x = (hi + lo) 2^k`, with `hi` between 0.7 and 1.42, and `ROUND + k`.
#[inline(always)]
pub(crate) fn exp<R: Real>(x: Dd<R>) -> (Dd<R>, R) {
    exp_to::<R, false>(x)
}

/// Computes [`exp`]; `LONG` takes an exact product in the term of third order, too.
#[inline(always)]
fn exp_to<R: Real, const LONG: bool>(x: Dd<R>) -> (Dd<R>, R) {
    let like = |c: f64| x.hi.like(c);
    let (h, n) = binary_exponent(x.hi);
    let k = n - like(ROUND);
    // Below one unless the exponent was cut.
    let lo = x.lo.at_least(like(-1.0)).at_most(like(1.0));
    // h − k ln 2, the first product and difference exact; what the second one rounds is 2⁻⁸⁴.
    let r = (-k).fma(like(LN_2[0]), h);
    let r = two_sum(r, (-k).fma(like(LN_2[1]), lo));
    // 1 + r + r²/2 + …, the first three terms with exact products.
    let h = two_prod(r.hi, like(0.5) * r.hi);
    let p = fast_two_sum(like(1.0), r.hi);
    let q = fast_two_sum(p.hi, h.hi);
    if LONG {
        let t = by_constant(times(h, r.hi), THIRD);
        let s = fast_two_sum(q.hi, t.hi);
        let fourth = like(4.0) * h.hi * h.hi;
        let low = r.lo.fma(r.hi + h.hi, r.lo) + t.lo;
        let tail = fourth.fma(paired(&EXP_FROM_FOURTH, r.hi), low);
        let lo = p.lo + q.lo + s.lo + (h.lo + tail);
        return (fast_two_sum(s.hi, lo), n);
    }
    let cube = r.hi * r.hi * r.hi;
    let tail = cube.fma(paired(&EXP_FROM_CUBE, r.hi), r.lo.fma(r.hi, r.lo));
    (fast_two_sum(q.hi, p.lo + q.lo + (h.lo + tail)), n)
}

/// `e^x = m 2^k` as one number `m` between 0.7 and 1.42, to about six tenths of a unit in the last
/// place, and `ROUND + k`.
#[inline(always)]
pub(crate) fn exp_rounded<R: Real>(x: Dd<R>) -> (R, R) {
    let like = |c: f64| x.hi.like(c);
    let (h, n) = binary_exponent(x.hi);
    let k = n - like(ROUND);
    let r = (-k).fma(like(LN_2[0]), h);
    let lo = (-k).fma(like(LN_2[1]), x.lo);
    let s = r + lo;
    let lo = lo - (s - r);
    (like(1.0) + (s + (s * s).fma(paired(&EXP, s), lo)), n)
}

/// The constants of [`exp_rounded`].
#[cfg(feature = "proof")]
pub(crate) fn of_rounded() -> (&'static [f64; 12], [f64; 2]) {
    (&EXP, LN_2)
}

/// The constants of [`exp`], those of the polynomial from `1/3!` on.
#[cfg(feature = "proof")]
pub(crate) fn of_pairs() -> (&'static [f64; 11], [f64; 2]) {
    (&EXP_FROM_CUBE, LN_2)
}

/// The constants of [`exp_minus_one`].
#[cfg(feature = "proof")]
pub(crate) fn of_few() -> &'static [f64; 8] {
    &FEW_OF_EXP
}

/// The coefficients of `e^s` from s³ on, of the sine from s³ and from s⁵ on, and of the cosine from
/// s⁴ on; 1/6 and π/2 in parts, and the digits of 2/π.
#[cfg(feature = "proof")]
pub(crate) struct Constants {
    pub exp: &'static [f64; 11],
    pub sin: &'static [f64; 8],
    pub sin_from_fifth: &'static [f64; 7],
    pub cos: &'static [f64; 7],
    pub sixth: [f64; 2],
    pub half_pi: [f64; 3],
    pub two_over_pi: &'static [u64],
}

#[cfg(feature = "proof")]
pub(crate) const CONSTANTS: Constants = Constants {
    exp: &EXP_FROM_CUBE,
    sin: &SIN,
    sin_from_fifth: &SIN_FROM_FIFTH,
    cos: &COS,
    sixth: [SIXTH.hi, SIXTH.lo],
    half_pi: HALF_PI,
    two_over_pi: &tables::TWO_OVER_PI_BITS,
};

/// `ROUND` plus the multiple of π/2 next to a phase.
#[inline(always)]
fn quarters<R: Real>(theta: R) -> R {
    theta.fma(theta.like(TWO_OVER_PI), theta.like(ROUND))
}

/// A phase modulo π/2: the rest in [−π/4, π/4] and `ROUND` plus the quadrant.
#[inline(always)]
pub(crate) fn reduce<R: Real>(theta: Dd<R>) -> (Dd<R>, R) {
    let n = quarters(theta.hi);
    (without_quarters(theta, n - n.like(ROUND)), n)
}

/// A phase less `k π/2`.
#[inline(always)]
pub(crate) fn without_quarters<R: Real>(theta: Dd<R>, k: R) -> Dd<R> {
    let like = |c: f64| theta.hi.like(c);
    // Exact: both are multiples of 2⁻⁵³ and the difference is below one.
    let r = (-k).fma(like(HALF_PI[0]), theta.hi);
    let p = two_prod(k, like(HALF_PI[1]));
    // Beside the difference, not after it: only k is waited for.
    let s = two_sum(theta.lo, -p.hi);
    let rest = (-k).fma(like(HALF_PI[2]), s.lo - p.lo);
    let t = two_sum(r, s.hi);
    fast_two_sum(t.hi, t.lo + rest)
}

/// `(sin, cos)` of a reduced phase.
#[inline(always)]
pub(crate) fn sin_cos_reduced<R: Real>(r: Dd<R>) -> (Dd<R>, Dd<R>) {
    let (x, xx) = (r.hi, r.hi * r.hi);
    let like = |c: f64| x.like(c);
    let s_lo = -(x * xx) * paired(&SIN, xx);
    let sin = fast_two_sum(x, r.lo.fma(like(-0.5).fma(xx, like(1.0)), s_lo));
    let h = two_prod(x, like(0.5) * x);
    let c = fast_two_sum(like(1.0), -h.hi);
    let cos_lo = (xx * xx).fma(paired(&COS, xx), (c.lo - h.lo) - x * r.lo);
    let cos = fast_two_sum(c.hi, cos_lo);
    (sin, cos)
}

/// `t x` of a pair that need not be normal, which the product is not either.
#[inline(always)]
fn times<R: Real>(t: Dd<R>, x: R) -> Dd<R> {
    let p = two_prod(t.hi, x);
    Dd::new(p.hi, t.lo.fma(x, p.lo))
}

/// The same with a pair of constants.
#[inline(always)]
fn by_constant<R: Real>(t: Dd<R>, c: Dd) -> Dd<R> {
    let p = times(t, t.hi.like(c.hi));
    Dd::new(p.hi, t.hi.fma(t.hi.like(c.lo), p.lo))
}

/// The same with exact products up to the third power.
#[inline(always)]
pub(crate) fn sin_cos_accurate<R: Real>(r: Dd<R>) -> (Dd<R>, Dd<R>) {
    sin_cos_to::<R, false>(r)
}

/// Computes [`sin_cos_accurate`]; `LONG` takes exact products in the term of fourth order, too.
#[inline(always)]
fn sin_cos_to<R: Real, const LONG: bool>(r: Dd<R>) -> (Dd<R>, Dd<R>) {
    let (x, xx) = (r.hi, r.hi * r.hi);
    let like = |c: f64| x.like(c);
    let h = two_prod(x, like(0.5) * x);
    let c = fast_two_sum(like(1.0), -h.hi);
    let cos = if LONG {
        // x⁴/24 = h²/6.
        let square = times(h, h.hi);
        let square = Dd::new(square.hi, h.hi.fma(h.lo, square.lo));
        let t = by_constant(square, SIXTH);
        let s = fast_two_sum(c.hi, t.hi);
        let down = x * r.lo;
        let low = (c.lo + s.lo) - h.lo + (t.lo - (xx * down).fma(like(-SIXTH.hi), down));
        let sixth = like(4.0) * square.hi * xx;
        fast_two_sum(s.hi, (-sixth).fma(paired(&COS_FROM_SIXTH, xx), low))
    } else {
        let cos_lo = (xx * xx).fma(paired(&COS, xx), (c.lo - h.lo) - x * r.lo);
        fast_two_sum(c.hi, cos_lo)
    };

    let cube = two_prod(xx, x);
    // x² = xx + 2 (h − xx/2).
    let square_lo = h.lo + h.lo;
    let cube_lo = x.fma(square_lo, cube.lo);
    let p = two_prod(cube.hi, like(SIXTH.hi));
    let p_lo = cube_lo.fma(like(SIXTH.hi), cube.hi.fma(like(SIXTH.lo), p.lo));
    let s = fast_two_sum(x, -p.hi);
    let rest = (cube.hi * xx).fma(paired(&SIN_FROM_FIFTH, xx), s.lo - p_lo);
    let sin = fast_two_sum(s.hi, r.lo.fma(-h.hi, r.lo) + rest);
    (sin, cos)
}

/// The same, each as one number.
#[inline(always)]
pub(crate) fn sin_cos_rounded<R: Real>(r: Dd<R>) -> (R, R) {
    let (x, xx) = (r.hi, r.hi * r.hi);
    let like = |c: f64| x.like(c);
    let sin = x + (-(x * xx)).fma(paired(&SIN, xx), r.lo);
    let rest = (xx * xx).fma(paired(&COS, xx), -(x * r.lo));
    (sin, like(1.0) + like(-0.5).fma(xx, rest))
}

/// Chooses and signs `(sin, cos)` by the quadrant, given as `ROUND + k`.
#[inline(always)]
pub(crate) fn turned<R: Real>(sin: R, cos: R, n: R) -> (R, R) {
    let swap = n.is_odd();
    let next = n + n.like(1.0);
    (
        n.flip(n.pick(swap, cos, sin)),
        next.flip(n.pick(swap, sin, cos)),
    )
}

/// The same for two `f64` each.
#[inline(always)]
pub(crate) fn turn<R: Real>(sin: Dd<R>, cos: Dd<R>, n: R) -> (Dd<R>, Dd<R>) {
    let (hi, lo) = (turned(sin.hi, cos.hi, n), turned(sin.lo, cos.lo, n));
    (Dd::new(hi.0, lo.0), Dd::new(hi.1, lo.1))
}

/// `e^{−z²} = (re + i im) 2^k` at `z = a + i y`, `a ≥ 0`, without the power of two, and
/// `ROUND + k`; the phase has to be below [`LARGE_PHASE`].
#[cfg_attr(
    not(all(target_arch = "x86_64", feature = "vectors")),
    allow(dead_code)
)]
#[inline(always)]
pub(crate) fn exp_minus_square<R: Real>(a: R, y: R) -> (Dd<R>, Dd<R>, R) {
    product::<R, false>(exp(exponent(a, y)), reduce(phase(a, y)))
}

/// The same as one number each, for phases below 2³⁰: to about two units in the last place.
#[inline(always)]
pub(crate) fn exp_minus_square_rounded<R: Real>(a: R, y: R) -> (R, R, R) {
    let (e, n) = exp_rounded(exponent(a, y));
    let (r, quadrant) = reduce(phase(a, y));
    let (sin, cos) = sin_cos_rounded(r);
    let (s, c) = turned(sin, cos, quadrant);
    (e * c, -(e * s), n)
}

/// The same with a relative error of about `2⁻⁵³ (3|Re z²| + 4)`, for phases below 2⁸ and `|Re z²|`
/// below 700.
#[inline(always)]
pub(crate) fn exp_minus_square_short<R: Real>(a: R, y: R) -> (R, R, R) {
    // y² − a² as one number.
    let (e, n) = exp_short((y - a) * (y + a));
    let theta = phase(a, y);
    let q = quarters(theta.hi);
    let (sin, cos) = sin_cos_short(theta, q - a.like(ROUND));
    let (s, c) = turned(sin, cos, q);
    (e * c, -(e * s), n)
}

/// `e^x − 1` for |x| up to 1/15.
#[inline(always)]
pub(crate) fn exp_minus_one<R: Real>(x: R) -> R {
    (x * x).fma(paired(&FEW_OF_EXP, x), x)
}

/// `e^t = m 2^k` and `ROUND + k`.
#[inline(always)]
pub(crate) fn exp_short<R: Real>(t: R) -> (R, R) {
    let like = |c: f64| t.like(c);
    let n = t.fma(like(LOG2_E), like(ROUND));
    let k = n - like(ROUND);
    let r = (-k).fma(like(LN_2[0]), t);
    let r = (-k).fma(like(LN_2[1]), r);
    (like(1.0) + (r * r).fma(paired(&EXP, r), r), n)
}

/// `(sin, cos)` of a phase less `k π/2`.
#[inline(always)]
pub(crate) fn sin_cos_short<R: Real>(theta: Dd<R>, k: R) -> (R, R) {
    let like = |c: f64| k.like(c);
    let x = (-k).fma(like(HALF_PI[0]), theta.hi);
    let x = x + (-k).fma(like(HALF_PI[1]), theta.lo);
    let xx = x * x;
    let sin = (-(x * xx)).fma(paired(&SIN, xx), x);
    let cos = (xx * xx).fma(paired(&COS, xx), like(-0.5).fma(xx, like(1.0)));
    (sin, cos)
}

/// `2 a y` modulo π/2 and `ROUND` plus the quadrant, for any size of the phase.
#[inline(always)]
fn reduce_any(a: f64, y: f64) -> (Dd, f64) {
    let theta = phase(a, y);
    if theta.hi.abs() < LARGE_PHASE {
        reduce(theta)
    } else {
        payne_hanek::reduce(a, y)
    }
}

/// [`exp_minus_square`] for a phase of any size.
#[inline(always)]
pub(crate) fn exp_minus_square_any(a: f64, y: f64) -> (Dd, Dd, f64) {
    product::<f64, false>(exp(exponent(a, y)), reduce_any(a, y))
}

/// Both parts of `t 2^k`, `n = ROUND + k`, `k` below 1000.
#[inline(always)]
pub(crate) fn pair_times_power<R: Real>(t: Dd<R>, n: R) -> Dd<R> {
    let n = n.raised(ROUND - 2040.0);
    Dd::new(scaled(t.hi, n), scaled(t.lo, n))
}

/// `t 2^k`, `n = ROUND + k`, for any `k`: in range where t is subnormal and k above 2040, too.
#[inline(always)]
pub(crate) fn times_power<R: Masked>(t: R, n: R) -> R {
    let like = |c: f64| t.like(c);
    let most = n
        .at_least(like(ROUND - 2040.0))
        .at_most(like(ROUND + 2040.0));
    let scaled_once = scaled(t, most);
    let beyond = most.below(n);
    if !t.any(beyond) {
        return scaled_once;
    }
    let rest = (like(ROUND) + (n - most)).at_most(like(ROUND + 2040.0));
    t.pick(beyond, scaled(scaled_once, rest), scaled_once)
}

/// The sine and cosine of `2 a y`, `a ≥ 0`, for any size of the phase.
#[inline(always)]
pub(crate) fn circle(a: f64, y: f64) -> (Dd, Dd) {
    let (r, quadrant) = reduce_any(a, y);
    let (s, c) = sin_cos_reduced(r);
    turn(s, c, quadrant)
}

/// `e^t` as [`exp`], whose exponents end at ±2020, with another 1024 of them: enough for
/// `2^{-1074} e^t`.
#[inline(always)]
pub(crate) fn exp_wide<R: Masked>(t: Dd<R>) -> (Dd<R>, R) {
    exp_wide_to::<R, false>(t)
}

/// Computes [`exp_wide`]; `LONG` makes it as accurate as [`product`] with `LONG`.
#[inline(always)]
pub(crate) fn exp_wide_to<R: Masked, const LONG: bool>(t: Dd<R>) -> (Dd<R>, R) {
    let like = |c: f64| t.hi.like(c);
    let usual = t.hi.magnitude().below(like(1000.0));
    if t.hi.all(usual) {
        return exp_to::<R, LONG>(t);
    }
    let k = like(1024.0).with_sign_of(t.hi);
    let less = t - Dd::new(like(tables::LN_2[0]) * k, like(tables::LN_2[1]) * k);
    let pick = |yes: R, no: R| t.hi.pick(usual, yes, no);
    let (e, n) = exp_to::<R, LONG>(Dd::new(pick(t.hi, less.hi), pick(t.lo, less.lo)));
    (e, n + pick(like(0.0), k))
}

/// `e^{−z²}` at `a + i y` as mantissas and `ROUND` plus the exponent, for any phase and as many
/// exponents as [`exp_wide`] has.
#[inline(always)]
pub(crate) fn gaussian(a: f64, y: f64) -> (Dd, Dd, f64) {
    let t = exponent(a, y);
    if t.hi.abs() < 1000.0 {
        return exp_minus_square_any(a, y);
    }
    let ((e, n), (s, c)) = (exp_wide(t), circle(a, y));
    (e * c, -(e * s), n)
}

/// `e^{−z²}` from `e^{Re −z²}` and the reduced phase, with their power of two and quadrant;
/// `LONG` reduces its error to a tenth.
#[inline(always)]
pub(crate) fn product<R: Real, const LONG: bool>(
    (e, n): (Dd<R>, R),
    (r, quadrant): (Dd<R>, R),
) -> (Dd<R>, Dd<R>, R) {
    let (sin, cos) = sin_cos_to::<R, LONG>(r);
    let (s, c) = turn(sin, cos, quadrant);
    (short_product(e, c), -short_product(e, s), n)
}

/// `a b` to about 2⁻¹⁰⁴, the parts not quite normalised.
#[inline(always)]
fn short_product<R: Real>(a: Dd<R>, b: Dd<R>) -> Dd<R> {
    let p = two_prod(a.hi, b.hi);
    fast_two_sum(p.hi, a.hi.fma(b.lo, a.lo.fma(b.hi, p.lo)))
}

#[cfg(test)]
mod tests;

//! `e^{−z²}` without the error of a rounded `z²`.
//!
//! With `z = a + i y`: `−z² = (y − a)(y + a) − 2 a y i`. Both parts are formed exactly or to 2⁻¹⁰⁴
//! as two `f64`, then reduced by multiples of ln 2 and π/2 that are themselves kept to 160 bits
//! (Cody & Waite, *Software Manual for the Elementary Functions*, 1980; phases from 2³⁰ upwards
//! are left to [`payne_hanek`](super::payne_hanek)). The factors are returned as `hi + lo` with
//! an error of about a tenth of a unit in the last place, the power of two apart.

use super::double_double::{Dd, fast_two_sum, two_prod, two_sum};
use super::payne_hanek;

/// Adding and subtracting this rounds an `f64` below 2⁵¹ to an integer.
const ROUND: f64 = 6_755_399_441_055_744.0;

const LOG2_E: f64 = std::f64::consts::LOG2_E;
/// ln 2, the first part with 12 trailing zeros, so that its product with an exponent is exact.
const LN_2: [f64; 3] = [
    0.693_147_180_559_663,
    2.823_529_056_303_157_7e-13,
    1.947_045_092_380_75e-31,
];
const TWO_OVER_PI: f64 = std::f64::consts::FRAC_2_PI;
/// π/2.
pub(super) const HALF_PI: [f64; 3] = [
    std::f64::consts::FRAC_PI_2,
    6.123_233_995_736_766e-17,
    -1.497_384_904_859_169_8e-33,
];

/// Phases below this are reduced by [`reduce`].
pub(super) const LARGE_PHASE: f64 = 1_073_741_824.0;

/// Exponents are cut here: `e^{±1500}` is outside the range of `f64` whatever it is multiplied by.
const CUT: f64 = 1500.0;

/// 2^k for a whole `k` within the normal exponents.
#[inline(always)]
pub(super) fn power_of_two(k: i32) -> f64 {
    f64::from_bits(((k + 1023) as u64) << 52)
}

/// `x · 2^k` for |k| < 2045, in two steps, so that only the last one may round or overflow.
#[inline(always)]
pub(super) fn scaled(x: f64, k: i32) -> f64 {
    let half = k >> 1;
    x * power_of_two(half) * power_of_two(k - half)
}

/// `y² − a² = (y − a)(y + a)`.
#[inline(always)]
pub(super) fn exponent(a: f64, y: f64) -> Dd {
    let (d, s) = (two_sum(y, -a), two_sum(y, a));
    let p = two_prod(d.hi, s.hi);
    fast_two_sum(
        p.hi,
        d.lo.mul_add(s.lo, d.hi.mul_add(s.lo, d.lo.mul_add(s.hi, p.lo))),
    )
}

/// `2 a y`, exactly.
#[inline(always)]
pub(super) fn phase(a: f64, y: f64) -> Dd {
    two_prod(2.0 * a, y)
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
const SIN: [f64; 8] = reciprocals(3, 2, -1.0);
const COS: [f64; 7] = reciprocals(4, 2, -1.0);

/// `Σ c_k x^k` by even and odd terms: half the length of the chain of dependent operations.
#[inline(always)]
fn paired<const N: usize>(c: &[f64; N], x: f64) -> f64 {
    let xx = x * x;
    let (mut even, mut odd) = (0.0, 0.0);
    let mut k = N;
    while k > 0 {
        k -= 1;
        if k % 2 == 0 {
            even = xx.mul_add(even, c[k]);
        } else {
            odd = xx.mul_add(odd, c[k]);
        }
    }
    x.mul_add(odd, even)
}

/// `e^x = (hi + lo) 2^k`, with `hi` between 0.7 and 1.42.
#[inline(always)]
pub(super) fn exp(x: Dd) -> (Dd, i32) {
    let h = x.hi.clamp(-CUT, CUT);
    let n = h.mul_add(LOG2_E, ROUND);
    let k = n - ROUND;
    // h − k ln 2, the first product exact.
    let r = (-k).mul_add(LN_2[0], h);
    let s = two_prod(k, LN_2[1]);
    let r = two_sum(r, -s.hi);
    let r = two_sum(r.hi, r.lo - s.lo + x.lo);
    // 1 + r + r²/2 + …
    let q = two_sum(1.0, r.hi);
    let tail = (r.hi * r.hi).mul_add(paired(&EXP, r.hi), r.lo.mul_add(r.hi, r.lo));
    (fast_two_sum(q.hi, q.lo + tail), n.to_bits() as i32)
}

/// A phase modulo π/2: the rest in [−π/4, π/4] and the quadrant (modulo four).
#[inline(always)]
pub(super) fn reduce(theta: Dd) -> (Dd, i32) {
    let n = theta.hi.mul_add(TWO_OVER_PI, ROUND);
    let k = n - ROUND;
    // Exact: both are multiples of 2⁻⁵³ and the difference is below one.
    let r = (-k).mul_add(HALF_PI[0], theta.hi);
    let p = two_prod(k, HALF_PI[1]);
    let s = two_sum(r, -p.hi);
    let t = two_sum(s.hi, theta.lo);
    let lo = (s.lo + t.lo) - p.lo - k * HALF_PI[2];
    (fast_two_sum(t.hi, lo), n.to_bits() as i32)
}

/// `(sin, cos)` of a reduced phase.
#[inline(always)]
pub(super) fn sin_cos_reduced(r: Dd) -> (Dd, Dd) {
    let (x, xx) = (r.hi, r.hi * r.hi);
    let s_lo = -(x * xx) * paired(&SIN, xx);
    let sin = fast_two_sum(x, r.lo.mul_add((-0.5f64).mul_add(xx, 1.0), s_lo));
    let h = two_prod(x, 0.5 * x);
    let c = fast_two_sum(1.0, -h.hi);
    let cos_lo = (xx * xx).mul_add(paired(&COS, xx), (c.lo - h.lo) - x * r.lo);
    let cos = fast_two_sum(c.hi, cos_lo);
    (sin, cos)
}

/// Chooses and signs `(sin, cos)` by the quadrant.
#[inline(always)]
pub(super) fn turn(sin: Dd, cos: Dd, quadrant: i32) -> (Dd, Dd) {
    let swap = quadrant & 1 != 0;
    let (s, c) = if swap { (cos, sin) } else { (sin, cos) };
    let s = if quadrant & 2 != 0 { -s } else { s };
    let c = if (quadrant + 1) & 2 != 0 { -c } else { c };
    (s, c)
}

/// `e^{−z²} = (re + i im) 2^k` at `z = a + i y`, `a ≥ 0`, without the power of two; the phase has
/// to be below [`LARGE_PHASE`] unless `ANY` is true.
#[inline(always)]
pub(super) fn exp_minus_square<const ANY: bool>(a: f64, y: f64) -> (Dd, Dd, i32) {
    let (e, k) = exp(exponent(a, y));
    let theta = phase(a, y);
    let (r, quadrant) = if ANY && !(theta.hi.abs() < LARGE_PHASE) {
        payne_hanek::reduce(a, y)
    } else {
        reduce(theta)
    };
    let (sin, cos) = sin_cos_reduced(r);
    let (s, c) = turn(sin, cos, quadrant);
    let by = |t: Dd| {
        let p = two_prod(e.hi, t.hi);
        fast_two_sum(p.hi, e.hi.mul_add(t.lo, e.lo.mul_add(t.hi, p.lo)))
    };
    (by(c), -by(s), k)
}

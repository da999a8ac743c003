//! Exponential, sine and cosine of double-double arguments, to about 2⁻¹⁰².

use super::double_double::{Dd, two_prod, two_sum};
use super::exponential::{HALF_PI, LARGE_PHASE, exponent, phase, turn};
use super::payne_hanek;
use super::real::ROUND;
use super::tables::INVERSE_FACTORIAL;

const LN_2: [f64; 3] = [
    std::f64::consts::LN_2,
    2.319_046_813_846_299_6e-17,
    5.707_708_438_416_212e-34,
];

/// `x − k (c₀ + c₁ + c₂)`.
#[inline(always)]
fn minus_multiple(x: Dd, k: f64, c: [f64; 3]) -> Dd {
    let (p, q) = (two_prod(k, c[0]), two_prod(k, c[1]));
    let s = two_sum(x.hi, -p.hi);
    let r = Dd::new(s.hi, 0.0).add_f(s.lo);
    let r = r + Dd::new(-p.lo, 0.0).add_f(x.lo);
    let r = r + Dd::new(-q.hi, -q.lo);
    r.add_f(-k * c[2])
}

/// `Σ_{j<N} s^j x^j/(first + step j)!` with the leading `dd` terms in double-double.
#[inline(always)]
fn series<const N: usize>(x: Dd, first: usize, step: usize, sign: f64, dd: usize) -> Dd {
    let c = |j: usize| {
        let v = INVERSE_FACTORIAL[first + step * j];
        let s = if j % 2 == 1 { sign } else { 1.0 };
        Dd::new(s * v[0], s * v[1])
    };
    let mut p = c(N - 1).hi;
    for j in (dd..N - 1).rev() {
        p = p.mul_add(x.hi, c(j).hi);
    }
    let mut p = Dd::from(p);
    for j in (0..dd).rev() {
        p = p * x + c(j);
    }
    p
}

/// `e^x = m · 2^k` as `m` and `ROUND + k`; `x` within ±1500.
#[inline(always)]
pub(super) fn exp(x: Dd) -> (Dd, f64) {
    let k = (x.hi * std::f64::consts::LOG2_E).round();
    // e^r = (e^{r/8})^8.
    let r = minus_multiple(x, k, LN_2).scale(0.125);
    // e^r − 1 keeps the bits that squaring would take.
    let mut m = series::<16>(r, 1, 1, 1.0, 8) * r;
    for _ in 0..3 {
        m = m.scale(2.0) + m.square();
    }
    (m.add_f(1.0), ROUND + k)
}

/// `(sin r, cos r)` for |r| ≤ π/4.
#[inline(always)]
pub(super) fn sin_cos_reduced(r: Dd) -> (Dd, Dd) {
    let x = r.square();
    let s = series::<13>(x, 1, 2, -1.0, 7) * r;
    let c = series::<14>(x, 0, 2, -1.0, 8);
    (s, c)
}

/// `x` modulo π/2 and `ROUND` plus the quadrant, for |x| < 2³⁰.
#[inline(always)]
pub(super) fn reduce(x: Dd) -> (Dd, f64) {
    let k = (x.hi * std::f64::consts::FRAC_2_PI).round();
    (minus_multiple(x, k, HALF_PI), ROUND + k)
}

/// `e^{−z²} = (re + i im) 2^k` at `z = a + i y`, `a ≥ 0`, without the power of two, and `ROUND + k`.
#[inline(always)]
pub(super) fn exp_minus_square(a: f64, y: f64) -> (Dd, Dd, f64) {
    let (e, k) = exp(exponent(a, y));
    let theta = phase(a, y);
    let (r, quadrant) = if theta.hi.abs() < LARGE_PHASE {
        reduce(theta)
    } else {
        payne_hanek::reduce(a, y)
    };
    let (s, c) = sin_cos_reduced(r);
    let (s, c) = turn(s, c, quadrant);
    (e * c, -(e * s), k)
}

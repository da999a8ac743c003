//! Exponential, sine and cosine of double-double arguments, to about 2⁻¹⁰², several at a time.

use super::exponential::{LARGE_PHASE, exponent, phase, turn};
use super::payne_hanek;
use super::tables::{HALF_PI, INVERSE_FACTORIAL, LN_2};
use crate::double_double::{Dd, two_prod, two_sum};
use crate::lanes::Lanes;
use crate::real::{ROUND, Real};

/// `1/n!`, and ln 2.
#[cfg(feature = "proof")]
pub(crate) const CONSTANTS: (&[[f64; 2]], [f64; 3]) = (&INVERSE_FACTORIAL, LN_2);

/// `x − k (c₀ + c₁ + c₂)`.
#[inline(always)]
fn minus_multiple<R: Real>(x: Dd<R>, k: R, c: [f64; 3]) -> Dd<R> {
    let (p, q) = (two_prod(k, k.like(c[0])), two_prod(k, k.like(c[1])));
    let r = two_sum(x.hi, -p.hi);
    let t = two_sum(x.lo, -p.lo);
    let r = r + t;
    let r = r + Dd::new(-q.hi, -q.lo);
    r.add_f(-k * k.like(c[2]))
}

/// `Σ_{j<N} c_j x^j`, the leading `dd` terms in double-double.
#[inline(always)]
fn series<R: Real, const N: usize>(x: Dd<R>, dd: usize, c: impl Fn(usize) -> Dd<R>) -> Dd<R> {
    let mut p = c(N - 1).hi;
    for j in (dd..N - 1).rev() {
        p = p.fma(x.hi, c(j).hi);
    }
    let mut p = Dd::new(p, p.like(0.0));
    for j in (0..dd).rev() {
        p = p * x + c(j);
    }
    p
}

/// `e^x = m · 2^k` as `m` and `ROUND + k`; `x` within ±1500.
#[inline(always)]
fn exp<R: Real>(x: Dd<R>) -> (Dd<R>, R) {
    let like = |c: f64| x.hi.like(c);
    let n = x.hi.fma(like(std::f64::consts::LOG2_E), like(ROUND));
    // e^r = (e^{r/8})^8.
    let r = minus_multiple(x, n - like(ROUND), LN_2);
    let r = Dd::new(r.hi * like(0.125), r.lo * like(0.125));
    // e^r − 1 keeps the bits that squaring would take.
    let mut m = r * series::<R, 16>(
        r,
        8,
        #[inline(always)]
        |j| {
            Dd::new(
                like(INVERSE_FACTORIAL[j + 1][0]),
                like(INVERSE_FACTORIAL[j + 1][1]),
            )
        },
    );
    for _ in 0..3 {
        m = Dd::new(m.hi + m.hi, m.lo + m.lo) + m * m;
    }
    (m.add_f(like(1.0)), n)
}

/// `x` modulo π/2 and `ROUND` plus the quadrant, for |x| < 2³⁰.
#[inline(always)]
fn reduce(x: Dd) -> (Dd, f64) {
    let n = x.hi.mul_add(std::f64::consts::FRAC_2_PI, ROUND);
    (minus_multiple(x, n - ROUND, HALF_PI), n)
}

/// `(sin, cos)` of two phases and two exponentials, `e^x = m 2^k` with `ROUND + k`.
pub(crate) struct Factors {
    pub circle: [(Dd, Dd); 2],
    pub exponentials: [(Dd, f64); 2],
}

/// The factors of two phases, reduced already, and two exponents.
#[inline(always)]
fn factors<L: Lanes>(lanes: L, phases: [(Dd, f64); 2], exponents: [Dd; 2]) -> Factors {
    let [(p, n), (q, m)] = phases;
    // Sine and cosine of both side by side.
    let r = Dd::new(
        lanes.quad([p.hi, p.hi, q.hi, q.hi]),
        lanes.quad([p.lo, p.lo, q.lo, q.lo]),
    );
    let sum = series::<L::Quad, 14>(
        r * r,
        8,
        #[inline(always)]
        |j| {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let (s, c) = (INVERSE_FACTORIAL[2 * j + 1], INVERSE_FACTORIAL[2 * j]);
            let part = |i: usize| lanes.quad([sign * s[i], sign * c[i], sign * s[i], sign * c[i]]);
            Dd::new(part(0), part(1))
        },
    );
    let by = Dd::new(
        lanes.quad([p.hi, 1.0, q.hi, 1.0]),
        lanes.quad([p.lo, 0.0, q.lo, 0.0]),
    );
    let sum = sum * by;
    let (hi, lo) = (lanes.array(sum.hi), lanes.array(sum.lo));
    let value = |i: usize| Dd::new(hi[i], lo[i]);

    let [e, g] = exponents;
    let x = Dd::new(
        lanes.quad([e.hi, g.hi, e.hi, g.hi]),
        lanes.quad([e.lo, g.lo, e.lo, g.lo]),
    );
    let (v, k) = exp(x);
    let (vh, vl, k) = (lanes.array(v.hi), lanes.array(v.lo), lanes.array(k));
    Factors {
        circle: [turn(value(0), value(1), n), turn(value(2), value(3), m)],
        exponentials: [(Dd::new(vh[0], vl[0]), k[0]), (Dd::new(vh[1], vl[1]), k[1])],
    }
}

/// Real and imaginary part of `e^{−z²}` without the power of two, and `ROUND` plus that.
pub(crate) type Gaussian = (Dd, Dd, f64);

/// `e^{−z²} = (re + i im) 2^k` at `z = a − i b`, without the power of two and with `ROUND + k`, and
/// beside it `(sin, cos)` of another phase (below 2³⁰) and another exponential.
#[inline(always)]
pub(crate) fn exp_minus_square<L: Lanes>(
    lanes: L,
    a: f64,
    b: f64,
    other_phase: Dd,
    other_exponent: Dd,
) -> (Gaussian, (Dd, Dd), (Dd, f64)) {
    let theta = phase(a, -b);
    let reduced = if theta.hi.abs() < LARGE_PHASE {
        reduce(theta)
    } else {
        payne_hanek::reduce(a, -b)
    };
    let f = factors(
        lanes,
        [reduced, reduce(other_phase)],
        [exponent(a, -b), other_exponent],
    );
    let ([(s, c), circle], [(e, k), other]) = (f.circle, f.exponentials);
    ((e * c, -(e * s), k), circle, other)
}

/// `(sin, cos)` of two phases below 2³⁰, and `e^x` of an exponent within ±700.
#[inline(always)]
pub(crate) fn circles_and_exponential<L: Lanes>(
    lanes: L,
    phases: [Dd; 2],
    exponent: Dd,
) -> ([(Dd, Dd); 2], Dd) {
    let f = factors(
        lanes,
        [reduce(phases[0]), reduce(phases[1])],
        [exponent, Dd::new(0.0, 0.0)],
    );
    let (m, n) = f.exponentials[0];
    (f.circle, m.scale(n.power_of_two()))
}

#[cfg(test)]
mod tests;

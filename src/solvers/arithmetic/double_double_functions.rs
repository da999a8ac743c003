//! Exponential, sine and cosine of double-double arguments, to about 2⁻¹⁰², several at a time.

use super::exponential::{LARGE_PHASE, exponent, phase, turn};
use super::payne_hanek;
use super::tables::{HALF_PI, INVERSE_FACTORIAL, LN_2};
use crate::double_double::{Dd, two_prod, two_sum};
use crate::numbers::Numbers;
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

/// `e^x = m · 2^k` as `m` and `ROUND + k`; `x` within ±1500. `SHORT` gives it to about 2⁻⁷⁰.
#[inline(always)]
fn exp<R: Real, const SHORT: bool>(x: Dd<R>) -> (Dd<R>, R) {
    let like = |c: f64| x.hi.like(c);
    let n = x.hi.fma(like(std::f64::consts::LOG2_E), like(ROUND));
    // e^r = (e^{r/8})^8.
    let r = minus_multiple(x, n - like(ROUND), LN_2);
    let r = Dd::new(r.hi * like(0.125), r.lo * like(0.125));
    // e^r − 1 keeps the bits that squaring would take.
    let mut m = r * series::<R, 16>(
        r,
        if SHORT { 3 } else { 8 },
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
fn reduce<R: Real>(x: Dd<R>) -> (Dd<R>, R) {
    let like = |c: f64| x.hi.like(c);
    let n = x.hi.fma(like(std::f64::consts::FRAC_2_PI), like(ROUND));
    (minus_multiple(x, n - like(ROUND), HALF_PI), n)
}

/// Sine and cosine.
type Circle<R> = (Dd<R>, Dd<R>);
/// An exponential without its power of two, and `ROUND` plus that.
type Exponential<R> = (Dd<R>, R);

/// `(sin, cos)` of two phases and two exponentials, `e^x = m 2^k` with `ROUND + k`.
pub(crate) struct Factors<R> {
    pub circle: [(Dd<R>, Dd<R>); 2],
    pub exponentials: [(Dd<R>, R); 2],
}

/// The factors of two phases, reduced already, and two exponents.
#[inline(always)]
fn factors<N: Numbers, const SHORT: bool>(
    numbers: N,
    phases: [(Dd<N::Number>, N::Number); 2],
    exponents: [Dd<N::Number>; 2],
) -> Factors<N::Number> {
    let [(p, n), (q, m)] = phases;
    let (zero, one) = (n.like(0.0), n.like(1.0));
    // Sine and cosine of both side by side.
    let r = Dd::new(
        numbers.quad([p.hi, p.hi, q.hi, q.hi]),
        numbers.quad([p.lo, p.lo, q.lo, q.lo]),
    );
    let sum = series::<N::Quad, 14>(
        r * r,
        if SHORT { 4 } else { 8 },
        #[inline(always)]
        |j| {
            let sign = if j % 2 == 0 { 1.0 } else { -1.0 };
            let (s, c) = (INVERSE_FACTORIAL[2 * j + 1], INVERSE_FACTORIAL[2 * j]);
            let (sh, sl) = (n.like(sign * s[0]), n.like(sign * s[1]));
            let (ch, cl) = (n.like(sign * c[0]), n.like(sign * c[1]));
            Dd::new(
                numbers.quad([sh, ch, sh, ch]),
                numbers.quad([sl, cl, sl, cl]),
            )
        },
    );
    let by = Dd::new(
        numbers.quad([p.hi, one, q.hi, one]),
        numbers.quad([p.lo, zero, q.lo, zero]),
    );
    let sum = sum * by;
    let (hi, lo) = (numbers.quarters(sum.hi), numbers.quarters(sum.lo));

    let [e, g] = exponents;
    let x = Dd::new(
        numbers.quad([e.hi, g.hi, e.hi, g.hi]),
        numbers.quad([e.lo, g.lo, e.lo, g.lo]),
    );
    let (v, k) = exp::<_, SHORT>(x);
    let (vh, vl) = (numbers.quarters(v.hi), numbers.quarters(v.lo));
    let k = numbers.quarters(k);
    Factors {
        circle: [
            turn(Dd::new(hi[0], lo[0]), Dd::new(hi[1], lo[1]), n),
            turn(Dd::new(hi[2], lo[2]), Dd::new(hi[3], lo[3]), m),
        ],
        exponentials: [(Dd::new(vh[0], vl[0]), k[0]), (Dd::new(vh[1], vl[1]), k[1])],
    }
}

/// Real and imaginary part of `e^{−z²}` without the power of two, and `ROUND` plus that.
pub(crate) type Gaussian<R = f64> = (Dd<R>, Dd<R>, R);
/// It, and the circle and the exponential that are computed beside it.
type WithOthers<R> = (Gaussian<R>, Circle<R>, Exponential<R>);

/// `e^{−z²} = (re + i im) 2^k` at `z = a − i b`, without the power of two and with `ROUND + k`, and
/// beside it `(sin, cos)` of another phase (below 2³⁰) and another exponential.
#[inline(always)]
pub(crate) fn exp_minus_square<N: Numbers>(
    numbers: N,
    a: N::Number,
    b: N::Number,
    other_phase: Dd<N::Number>,
    other_exponent: Dd<N::Number>,
) -> WithOthers<N::Number> {
    exp_minus_square_to::<N, false>(numbers, a, b, other_phase, other_exponent)
}

/// Computes [`exp_minus_square`]; `SHORT` gives it to about 2⁻⁷⁰.
#[inline(always)]
pub(crate) fn exp_minus_square_to<N: Numbers, const SHORT: bool>(
    numbers: N,
    a: N::Number,
    b: N::Number,
    other_phase: Dd<N::Number>,
    other_exponent: Dd<N::Number>,
) -> WithOthers<N::Number> {
    let theta = phase(a, -b);
    let (r, n) = reduce(theta);
    let small = theta.hi.magnitude().below(a.like(LARGE_PHASE));
    let [hi, lo, n] = numbers.replaced(small, [r.hi, r.lo, n], [a, b], |[a, b]| {
        let (r, n) = payne_hanek::reduce(a, -b);
        [r.hi, r.lo, n]
    });
    let f = factors::<N, SHORT>(
        numbers,
        [(Dd::new(hi, lo), n), reduce(other_phase)],
        [exponent(a, -b), other_exponent],
    );
    let ([(s, c), circle], [(e, k), other]) = (f.circle, f.exponentials);
    ((e * c, -(e * s), k), circle, other)
}

/// `(sin, cos)` of two phases below 2³⁰, and `e^x` of an exponent within ±700.
#[inline(always)]
pub(crate) fn circles_and_exponential<N: Numbers>(
    numbers: N,
    phases: [Dd<N::Number>; 2],
    exponent: Dd<N::Number>,
) -> ([Circle<N::Number>; 2], Dd<N::Number>) {
    let zero = exponent.hi.like(0.0);
    let f = factors::<N, false>(
        numbers,
        [reduce(phases[0]), reduce(phases[1])],
        [exponent, Dd::new(zero, zero)],
    );
    let (m, n) = f.exponentials[0];
    let by = n.power_of_two();
    (f.circle, Dd::new(m.hi * by, m.lo * by))
}

#[cfg(test)]
mod tests;

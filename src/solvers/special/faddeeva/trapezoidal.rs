//! The corrected trapezoidal rule in double-double: W(z) in the lower half-plane where `2e^{−z²}`
//! and `w(−z)` cancel.
//!
//! ```text
//! w(z) = (i h/π) Σ_k e^{−t_k²}/(z − t_k) + 2 e^{−z²}/(1 − e^{−2πi(z/h − σ)}) + R,   t_k = (k + σ)h
//! ```
//!
//! with `|R| ≲ 2 e^{−(π/h)²}` below the line `Im z = π/h` (Chiarella & Reichel, Math. Comp. 22
//! (1968); Trefethen & Weideman, SIAM Review 56 (2014), section 5). Here `h = 23/64`:
//! `e^{−(π/h)²} = 2^{−110}`, and the nodes left out weigh less than `2^{−107}`. σ is 0 or ½,
//! whichever puts the poles farther from z. The nodes' squares are exact in `f64`.
//!
//! With `r² = |z|²` and pairs `±t` the sums need no complex arithmetic and no subtraction of like
//! numbers:
//!
//! ```text
//! Re = y Σ a (r² + τ)/M,   Im = x Σ a (r² − τ)/M,
//! M = (r² − τ)² + 4τy²,   τ = t²,   a = (2h/π) e^{−τ}
//! ```

use super::pairs::Parts;
use super::places::Choose;
use super::tables::{TRAPEZOIDAL_NODES, TRAPEZOIDAL_WEIGHTS};
use crate::double_double::{Dd, two_prod};
use crate::double_double_functions::{Gaussian, exp_minus_square, exp_minus_square_to};
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::numbers::{Numbers, One};
use crate::real::{ROUND, Real, scaled};

/// Nodes of each rule.
pub(super) const NODES: usize = 24;
const LANES: usize = 8;
/// Where 2⁻⁶⁶ is enough, the nodes whose terms are computed in double-double, and those that count.
const SHORT: [usize; 2] = [12, 20];

const TWO_PI: Dd = Dd::new(2.0 * Dd::PI.hi, 2.0 * Dd::PI.lo);
/// 2π/23.
const TWO_PI_OVER_PER: Dd = Dd::new(hex("0x1.17bd03a9ebb32p-2"), hex("0x1.1d7c187b51ea1p-56"));
/// 2π and 2π/23.
#[cfg(feature = "proof")]
pub(super) const CONSTANTS: (Dd, Dd) = (TWO_PI, TWO_PI_OVER_PER);
/// 1/h = 64/23.
const STEPS: f64 = 64.0;
const PER: f64 = 23.0;

#[inline(always)]
fn total<R: Real>(first: Dd<R>, parts: &[Dd<R>]) -> Dd<R> {
    let mut sum = first;
    for part in parts {
        sum = sum + *part;
    }
    sum
}

/// The sums over the nodes of the second rule where the mask is true, else of the first, without
/// the factors `y` and `x`; all of them in double-double, or those that count as [`SHORT`] says.
#[inline(always)]
fn sums<R: Real, const PAIRS: usize>(second: R::Mask, r2: Dd<R>, y2: Dd<R>) -> (Dd<R>, Dd<R>) {
    let x = r2.hi;
    let ([t0, t1], [w0, w1]) = (&TRAPEZOIDAL_NODES, &TRAPEZOIDAL_WEIGHTS);
    let zero = Dd::ZERO.like(x);
    let mut plus = [zero; LANES];
    let mut minus = [zero; LANES];
    // Few nodes are taken sum by sum: sums side by side would leave their registers.
    let blocks = PAIRS.div_ceil(LANES);
    let [outer, inner] = match PAIRS {
        NODES => [blocks, LANES],
        _ => [LANES, blocks],
    };
    for m in 0..outer {
        for n in 0..inner {
            let (block, j) = if PAIRS == NODES { (m, n) } else { (n, m) };
            let k = block * LANES + j;
            if k >= PAIRS {
                continue;
            }
            let t = x.either(second, [t0[k], t1[k]]);
            let high = x.either(second, [w0[0][k], w1[0][k]]);
            let low = x.either(second, [w0[1][k], w1[1][k]]);
            let less = r2.add_f(-t);
            let m = less.square() + y2.mul_f(x.like(4.0) * t);
            let q = Dd::new(high, low).div(m);
            let (p, n) = (q * r2.add_f(t), q * less);
            // The sum of zero and a number is that number.
            (plus[j], minus[j]) = match PAIRS != NODES && block == 0 {
                true => (p, n),
                false => (plus[j] + p, minus[j] + n),
            };
        }
    }
    if PAIRS == NODES {
        return (total(zero, &plus), total(zero, &minus));
    }
    let plus = total(plus[0], &plus[1..]);
    let minus = total(minus[0], &minus[1..]);
    let (mut p, mut q) = (x.like(0.0), x.like(0.0));
    for k in PAIRS..SHORT[1] {
        let t = x.either(second, [t0[k], t1[k]]);
        let less = (r2.hi - t) + r2.lo;
        let m = less.fma(less, x.like(4.0) * t * y2.hi);
        let a = x.either(second, [w0[0][k], w1[0][k]]) / m;
        p = a.fma(r2.hi + t, p);
        q = a.fma(less, q);
    }
    (plus.add_f(p), minus.add_f(q))
}

/// Where `cos 2θ > 0`, which takes the second rule, and `|cos 2θ|`, and `sin 2θ` with the sign that
/// the rule gives it.
#[inline(always)]
fn chosen<R: Real>(sine: Dd<R>, cosine: Dd<R>) -> (R::Mask, Dd<R>, Dd<R>) {
    let second = sine.hi.like(0.0).below(cosine.hi);
    (
        second,
        cosine.or_else(second, -cosine),
        (-sine).or_else(second, sine),
    )
}

/// The phase `2πa/h`, less a multiple of 2π.
#[inline(always)]
fn phase_of_nodes<R: Real>(a: R) -> Dd<R> {
    let like = |c: f64| a.like(c);
    let n = (a * like(STEPS / PER) + like(ROUND)) - like(ROUND);
    let f = Dd::new(n.fma(like(-PER), a * like(STEPS)), like(0.0));
    f.div(Dd::from(PER).like(a)) * TWO_PI.like(a)
}

/// Both parts of `t 2^k`, `n = ROUND + k`.
#[inline(always)]
fn by<R: Real>(t: Dd<R>, n: R) -> Dd<R> {
    Dd::new(scaled(t.hi, n), scaled(t.lo, n))
}

/// Both parts times a power of two.
#[inline(always)]
fn times<R: Real>(t: Dd<R>, power: R) -> Dd<R> {
    Dd::new(t.hi * power, t.lo * power)
}

/// The value at `a − i b`, `a, b ≥ 0`, `|z| < 2²⁴`, away from overflow; relative error of each
/// component about 2⁻⁹² of the larger of the two terms it is the sum of. After it `|2e^{−z²}|`,
/// about.
#[inline(always)]
pub(super) fn lower<N: Numbers>(
    numbers: N,
    a: N::Number,
    b: N::Number,
) -> (Dd<N::Number>, Dd<N::Number>, N::Number) {
    let like = |c: f64| a.like(c);
    // The phase 2πa/h and G = e^{−2πb/h}.
    let ((c, s, k), (sine, cosine), (g, gk)) = exp_minus_square(
        numbers,
        a,
        b,
        phase_of_nodes(a),
        two_prod(b.at_most(like(8.0)), like(-STEPS)) * TWO_PI_OVER_PER.like(a),
    );
    let (rule, kappa, sine) = chosen(sine, cosine);
    let (xx, yy) = (two_prod(a, a), two_prod(b, b));
    let (plus, minus) = sums::<_, NODES>(rule, xx + yy, yy);
    // Tiny parts are lifted, lest the low halves become subnormal.
    let lift = a.pick(b.below(like(1e-200)), like(200.0), like(0.0));
    let (re, im) = (plus.mul_f(-scaled(b, like(ROUND) + lift)), minus.mul_f(a));

    // 2 e^{−z²} (1 + κG − i G sin 2θ)/(1 + G² + 2κG).
    let g = times(g, scaled(like(1.0), gk));
    let den = (g * (g + times(kappa, like(2.0)))).add_f(like(1.0));
    let (p, q) = ((kappa * g).add_f(like(1.0)), -(g * sine));
    let (c, s) = ((c * p - s * q).div(den), (c * q + s * p).div(den));
    let re = by(re + by(c, k + (like(1.0) + lift)), like(ROUND) - lift);
    let next = k + like(1.0);
    (re, im + by(s, next), scaled(like(1.0), next))
}

/// The value at `a + i b`, `a, b ≥ 0`, `|z| < 2²⁴`; relative error of each component about 2⁻¹⁰⁰ of
/// the larger of the two terms it is the sum of. After it `e^{−z²}`, where `|Re z²|` is below 1500.
#[inline(always)]
fn upper<N: Numbers>(numbers: N, a: N::Number, b: N::Number) -> WithGaussian<N::Number> {
    upper_to::<N, NODES>(numbers, a, b)
}

/// The same to about 2⁻⁶⁶.
#[inline(always)]
pub(super) fn upper_short<N: Numbers>(
    numbers: N,
    a: N::Number,
    b: N::Number,
) -> WithGaussian<N::Number> {
    upper_to::<N, { SHORT[0] }>(numbers, a, b)
}

/// W and `e^{−z²}`.
type WithGaussian<R> = (Parts<R>, Gaussian<R>);

#[inline(always)]
fn upper_to<N: Numbers, const PAIRS: usize>(
    numbers: N,
    a: N::Number,
    b: N::Number,
) -> WithGaussian<N::Number> {
    let like = |c: f64| a.like(c);
    // Beyond, what is left of the residue is below the error of the rule.
    let outside = a.or(like(8.0).below(b), like(30.0).below(a));
    let y = a.pick(outside, like(0.0), b);
    let others = (
        phase_of_nodes(a),
        two_prod(y, like(-STEPS)) * TWO_PI_OVER_PER.like(a),
    );
    let (gaussian, (sine, cosine), (g, gk)) = match PAIRS {
        NODES => exp_minus_square(numbers, a, -b, others.0, others.1),
        _ => exp_minus_square_to::<N, true>(numbers, a, -b, others.0, others.1),
    };
    let (c, s, k) = gaussian;
    let (rule, kappa, sine) = chosen(sine, cosine);
    let (xx, yy) = (two_prod(a, a), two_prod(b, b));
    let (plus, minus) = sums::<_, PAIRS>(rule, xx + yy, yy);
    let (re, im) = (plus.mul_f(b), minus.mul_f(a));
    if a.all(outside) {
        return ((re, im), gaussian);
    }
    // 2 e^{−z²} (g² + κg − i g sin 2θ)/(1 + g² + 2κg), g = e^{−2πb/h}.
    let g = times(g, scaled(like(1.0), gk));
    let den = (g * (g + times(kappa, like(2.0)))).add_f(like(1.0));
    let (p, q) = (g * (g + kappa), -(g * sine));
    let (c, s) = ((c * p - s * q).div(den), (c * q + s * p).div(den));
    let k = k + like(1.0);
    let parts = (
        re.or_else(outside, re + by(c, k)),
        im.or_else(outside, im + by(s, k)),
    );
    (parts, gaussian)
}

/// [`upper`] at one point, as a function of its own: each relative has a use for it.
pub(super) struct Upper {
    pub a: f64,
    pub b: f64,
}

impl Task for Upper {
    type Output = WithGaussian<f64>;
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> WithGaussian<f64> {
        upper(One(lanes), self.a, self.b)
    }
}

#[cfg(test)]
mod tests;

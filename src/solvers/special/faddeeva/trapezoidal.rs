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

use super::tables::{TRAPEZOIDAL_NODES, TRAPEZOIDAL_WEIGHTS};
use crate::double_double::{Dd, two_prod};
use crate::double_double_functions::exp_minus_square;
use crate::hex::hex;
use crate::lanes::{Lanes, Task};
use crate::real::{ROUND, scaled};

/// Nodes of each rule.
pub(super) const NODES: usize = 24;
const LANES: usize = 8;

const TWO_PI: Dd = Dd::new(2.0 * Dd::PI.hi, 2.0 * Dd::PI.lo);
/// 2π/23.
const TWO_PI_OVER_PER: Dd = Dd::new(hex("0x1.17bd03a9ebb32p-2"), hex("0x1.1d7c187b51ea1p-56"));
/// 2π and 2π/23.
#[cfg(feature = "proof")]
pub(super) const CONSTANTS: (Dd, Dd) = (TWO_PI, TWO_PI_OVER_PER);
/// 1/h = 64/23.
const STEPS: f64 = 64.0;
const PER: f64 = 23.0;

/// The sums over the nodes, without the factors `y` and `x`.
#[inline(always)]
fn sums(rule: usize, r2: Dd, y2: Dd) -> (Dd, Dd) {
    let (tau, a) = (&TRAPEZOIDAL_NODES[rule], &TRAPEZOIDAL_WEIGHTS[rule]);
    let zero = [0.0f64; LANES];
    let (mut ph, mut pl, mut mh, mut ml) = (zero, zero, zero, zero);
    for chunk in 0..NODES / LANES {
        for j in 0..LANES {
            let k = chunk * LANES + j;
            let t = tau[k];
            let less = r2.add_f(-t);
            let m = less.square() + y2.mul_f(4.0 * t);
            let q = Dd::new(a[0][k], a[1][k]).div(m);
            let plus = Dd::new(ph[j], pl[j]) + q * r2.add_f(t);
            let minus = Dd::new(mh[j], ml[j]) + q * less;
            ph[j] = plus.hi;
            pl[j] = plus.lo;
            mh[j] = minus.hi;
            ml[j] = minus.lo;
        }
    }
    let (mut plus, mut minus) = (Dd::ZERO, Dd::ZERO);
    for j in 0..LANES {
        plus = plus + Dd::new(ph[j], pl[j]);
        minus = minus + Dd::new(mh[j], ml[j]);
    }
    (plus, minus)
}

/// The rule for which `cos 2θ ≤ 0`, with `−cos 2θ` and `sin 2θ`.
#[inline(always)]
fn chosen(sine: Dd, cosine: Dd) -> (usize, Dd, Dd) {
    match cosine.hi <= 0.0 {
        true => (0, -cosine, sine),
        false => (1, cosine, -sine),
    }
}

/// The value at `a − i b`, `a, b ≥ 0`, `|z| < 2²⁴`, away from overflow; relative error of each
/// component about 2⁻⁹² of the larger of the two terms it is the sum of. After it `|2e^{−z²}|`,
/// about.
#[inline(always)]
pub(super) fn lower<L: Lanes>(lanes: L, a: f64, b: f64) -> (Dd, Dd, f64) {
    // The phase 2πa/h and G = e^{−2πb/h}.
    let n = (a * (STEPS / PER) + ROUND) - ROUND;
    let f = Dd::from(n.mul_add(-PER, a * STEPS)).div(Dd::from(PER));
    let ((c, s, k), (sine, cosine), (g, gk)) = exp_minus_square(
        lanes,
        a,
        b,
        f * TWO_PI,
        two_prod(b.min(8.0), -STEPS) * TWO_PI_OVER_PER,
    );
    let (rule, kappa, sine) = chosen(sine, cosine);
    let (xx, yy) = (two_prod(a, a), two_prod(b, b));
    let (plus, minus) = sums(rule, xx + yy, yy);
    // Tiny parts are lifted, lest the low halves become subnormal.
    let lift = if b < 1e-200 { 200.0 } else { 0.0 };
    let (re, im) = (plus.mul_f(-scaled(b, ROUND + lift)), minus.mul_f(a));

    // 2 e^{−z²} (1 + κG − i G sin 2θ)/(1 + G² + 2κG).
    let g = g.scale(scaled(1.0, gk));
    let den = (g * (g + kappa.scale(2.0))).add_f(1.0);
    let (p, q) = ((kappa * g).add_f(1.0), -(g * sine));
    let (c, s) = ((c * p - s * q).div(den), (c * q + s * p).div(den));
    let by = |t: Dd, k: f64| Dd::new(scaled(t.hi, k), scaled(t.lo, k));
    let re = re + by(c, k + (1.0 + lift));
    let down = ROUND - lift;
    let re = Dd::new(scaled(re.hi, down), scaled(re.lo, down));
    (re, im + by(s, k + 1.0), scaled(1.0, k + 1.0))
}

/// The value at `a + i b`, `a, b ≥ 0`, `|z| < 2²⁴`; relative error of each component about 2⁻¹⁰⁰ of
/// the larger of the two terms it is the sum of. A function of its own: each relative has a use for
/// it.
pub(super) struct Upper {
    pub a: f64,
    pub b: f64,
}

impl Task for Upper {
    type Output = (Dd, Dd);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (Dd, Dd) {
        let Upper { a, b } = self;
        let n = (a * (STEPS / PER) + ROUND) - ROUND;
        let f = Dd::from(n.mul_add(-PER, a * STEPS)).div(Dd::from(PER));
        // Beyond, what is left of the residue is below the error of the rule.
        let outside = b > 8.0 || a > 30.0;
        let (x, y) = if outside { (0.0, 0.0) } else { (a, b) };
        let ((c, s, k), (sine, cosine), (g, gk)) = exp_minus_square(
            lanes,
            x,
            -y,
            f * TWO_PI,
            two_prod(y, -STEPS) * TWO_PI_OVER_PER,
        );
        let (rule, kappa, sine) = chosen(sine, cosine);
        let (xx, yy) = (two_prod(a, a), two_prod(b, b));
        let (plus, minus) = sums(rule, xx + yy, yy);
        let (re, im) = (plus.mul_f(b), minus.mul_f(a));
        if outside {
            return (re, im);
        }
        // 2 e^{−z²} (g² + κg − i g sin 2θ)/(1 + g² + 2κg), g = e^{−2πb/h}.
        let g = g.scale(scaled(1.0, gk));
        let den = (g * (g + kappa.scale(2.0))).add_f(1.0);
        let (p, q) = (g * (g + kappa), -(g * sine));
        let (c, s) = ((c * p - s * q).div(den), (c * q + s * p).div(den));
        let by = |t: Dd| Dd::new(scaled(t.hi, k + 1.0), scaled(t.lo, k + 1.0));
        (re + by(c), im + by(s))
    }
}

#[cfg(test)]
mod tests;

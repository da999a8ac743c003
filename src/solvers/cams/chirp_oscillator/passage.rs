//! The free vibration that the passage through a resonance leaves behind.
//!
//! Where [`Sweep::beyond`](super::sweep::Sweep::beyond) changes, the particular solution changes
//! its branch by `C (w(z) + w(−z)) = 2C e^{−z²}`, which has to be made up for: with `X = ω + Im λ`
//! and `η = −Re λ`
//!
//! ```text
//! P = √(π/κ) (1 − i) e^{−ηX_t/κ} e^{i[t Im λ − δ + (X_0² − η²)/(2κ)]},
//! ```
//!
//! all exponents combined before any exponential; since `X_t > η ≥ 0` its modulus never exceeds
//! `√(2π/κ)`. As a function of λ its exponent is a parabola, so that for roots close together the
//! divided difference is, with `λ̄ = −n`, `d = (ω_t + in)/κ` and `x = gap d/2`,
//!
//! ```text
//! P[·] = P(λ̄) e^{−i gap²/(8κ)} d sinh(x)/x.
//! ```

use super::inlined::two;
use super::phase::{circle, decay};
use super::roots::Roots;
use super::sweep::Sweep;
use crate::double_double::Dd;
use num_complex::Complex;

type C = Complex<f64>;

/// `e^{−x}` is zero beyond.
const GONE: f64 = 746.0;
const SQRT_PI: f64 = 1.772_453_850_905_516;

/// `√(π/κ) (1 − i) e^{−ηX_t/κ} e^{i·phase}`, `phase = turned + (square)/(2κ) − δ`.
#[inline(always)]
fn term(sweep: &Sweep, nats: Dd, turned: Dd, square: Dd) -> C {
    if nats.hi > GONE {
        return C::ZERO;
    }
    let phase = turned + square.div(sweep.kappa + sweep.kappa);
    let size = SQRT_PI / sweep.root_kappa.hi * decay(nats);
    circle(phase.add_f(-sweep.delta)) * C::new(size, -size)
}

/// P for root number i.
#[inline(always)]
fn of_root(sweep: &Sweep, roots: &Roots, i: usize, t: f64, omega: Dd) -> C {
    let (eta, beta) = (roots.eta[i], roots.beta[i]);
    let (start, now) = (sweep.nu + beta, omega + beta);
    let nats = (eta * now).div(sweep.kappa);
    term(sweep, nats, beta.mul_f(t), (start - eta) * (start + eta))
}

/// `sinh x/x` for `|x| ≤ 1`.
fn sinhc(x: C) -> C {
    let xx = x * x;
    let mut sum = C::ONE;
    for j in (1..=9).rev() {
        sum = 1.0 + xx * sum / f64::from(2 * j * (2 * j + 1));
    }
    sum
}

/// The divided differences of `P, λP, λ²P` over the roots that have been passed between 0 and t.
#[inline(always)]
pub(super) fn passage(sweep: &Sweep, roots: &Roots, t: f64, omega: Dd) -> [C; 3] {
    let passed = two(
        #[inline(always)]
        |i| !sweep.beyond(roots, i, sweep.nu) && sweep.beyond(roots, i, omega),
    );
    if passed == [false, false] {
        return [C::ZERO; 3];
    }
    if sweep.joint {
        let d = C::new(omega.value(), roots.n) / sweep.kappa.hi;
        let x = roots.gap * d * 0.5;
        if x.norm_sqr() <= 1.0 {
            let n = Dd::from(roots.n);
            let half = roots.half.square();
            let half = if roots.over { half } else { -half };
            let square = sweep.nu.square() - n.square() - half;
            let nats = (n * omega).div(sweep.kappa);
            let p = term(sweep, nats, Dd::ZERO, square);
            let y = p * d * sinhc(x);
            let v = p * x.cosh() - y * roots.n;
            let a = -(v * (2.0 * roots.n) + y * (roots.w * roots.w));
            return [y, v, a];
        }
    }
    let mut sum = [C::ZERO; 3];
    for i in [0, 1] {
        if passed[i] {
            let lambda = roots.lambda[i];
            let sign = if i == 0 { 1.0 } else { -1.0 };
            let mut p = sign * of_root(sweep, roots, i, t, omega) / roots.gap;
            for part in &mut sum {
                *part += p;
                p *= lambda;
            }
        }
    }
    sum
}

/// `P, λP, λ²P` for root number i alone, without the division by the gap.
pub(super) fn passage_of_one(sweep: &Sweep, roots: &Roots, i: usize, t: f64, omega: Dd) -> [C; 3] {
    if sweep.beyond(roots, i, sweep.nu) || !sweep.beyond(roots, i, omega) {
        return [C::ZERO; 3];
    }
    let p = of_root(sweep, roots, i, t, omega);
    let lambda = roots.lambda[i];
    [p, p * lambda, p * lambda * lambda]
}

/// The passages as states at `t = 0` of the free vibration, per `w²`: for each root that has its
/// resonance ahead of it. `None` where they are no constants that `f64` holds, or would cancel.
pub(super) fn left_behind(sweep: &Sweep, roots: &Roots) -> Option<[[C; 2]; 2]> {
    if sweep.kappa.hi == 0.0 {
        return Some([[C::ZERO; 2]; 2]);
    }
    if roots.over || sweep.joint {
        return None;
    }
    let ahead = two(|i| !sweep.beyond(roots, i, sweep.nu));
    let mut states = [[C::ZERO; 2]; 2];
    for i in [0, 1] {
        let before = (sweep.nu + roots.beta[i]).value();
        if !ahead[i] {
            continue;
        }
        if roots.n * before.abs() / sweep.kappa.hi > FOLDED {
            return None;
        }
        let p = of_root(sweep, roots, i, 0.0, sweep.nu) / roots.gap;
        let p = if i == 0 { p } else { -p };
        states[i] = [p, p * roots.lambda[i]];
    }
    Some(states)
}

/// Largest decay, in nats, between the start and a passage that is folded into the start.
const FOLDED: f64 = 300.0;

#[cfg(test)]
mod tests;

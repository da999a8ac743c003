//! The convolution integral by Gauss–Legendre quadrature, where its phase is small: nothing cancels
//! then, and the particular solution and the free vibration, which would, are not needed.
//!
//! With the impulse response `K` (or `e^{λs}` for one root), integrated by parts so that every part
//! has the size of its result:
//!
//! ```text
//! ψ   = ∫_0^t K(s) e^{−iθ(t−s)} ds
//! ψ′  = K(t) e^{−iδ} + ∫ K(s) (−iω) e^{−iθ} ds
//! ψ″  = (K′(t) − iνK(t)) e^{−iδ} + ∫ K(s) (−ω² − iκ) e^{−iθ} ds
//! ```

use super::free::Free;
use super::phase::circle;
use super::roots::Roots;
use super::rules::{RULE_20, RULE_32};
use super::sweep::Sweep;
use crate::double_double::Dd;
use num_complex::Complex;

type C = Complex<f64>;

/// The three integrals `∫ kernel(s) (1, −iω, −ω² − iκ) e^{−i(θ(t−s) − θ(t))} ds`: with the first
/// one's components as accurate as the kernel's, however small the phase is.
fn integrals(sweep: &Sweep, t: f64, rule: &[[f64; 2]], kernel: impl Fn(f64) -> C) -> [C; 3] {
    let (omega, kappa) = (sweep.omega(t).value(), sweep.kappa.hi);
    let half = 0.5 * t;
    let mut sum = [C::ZERO; 3];
    for &[x, weight] in rule {
        for s in [half * (1.0 - x), half * (1.0 + x)] {
            let (sin, cos) = ((-0.5 * kappa).mul_add(s, omega) * s).sin_cos();
            let f = kernel(s) * C::new(cos, sin) * (weight * half);
            let here = (-kappa).mul_add(s, omega);
            sum[0] += f;
            sum[1] += C::new(here * f.im, -here * f.re);
            sum[2] -= f * C::new(here * here, kappa);
        }
    }
    sum
}

/// `ψ, ψ′, ψ″` for both roots, per `w²`, and `ψ e^{iθ}`.
#[cold]
#[inline(never)]
pub(super) fn both(sweep: &Sweep, roots: &Roots, free: &Free, t: f64) -> ([C; 3], C) {
    let kernel = |s: f64| C::new(Free::at(roots, s).k, 0.0);
    let sum = integrals(sweep, t, &RULE_32, kernel);
    let carrier = sweep.carrier(t);
    let [y, v, a] = sum.map(|x| x * carrier);
    let start = circle(Dd::from(-sweep.delta));
    let rate = C::new(free.k1, -sweep.nu.value() * free.k);
    ([y, v + start * free.k, a + start * rate], sum[0])
}

/// `φ, φ′, φ″` for root number i, and `φ e^{iθ}`.
pub(super) fn one(sweep: &Sweep, roots: &Roots, i: usize, t: f64) -> ([C; 3], C) {
    let (eta, beta) = (roots.eta[i].value(), roots.beta[i]);
    let kernel = |s: f64| circle(beta.mul_f(s)) * (-eta * s).exp();
    let carrier = sweep.carrier(t);
    let sum = integrals(sweep, t, &RULE_20, kernel);
    let [y, v, a] = sum.map(|x| x * carrier);
    let end = circle(beta.mul_f(t).add_f(-sweep.delta)) * (-eta * t).exp();
    let rate = roots.lambda[i] - C::new(0.0, sweep.nu.value());
    ([y, v + end, a + end * rate], sum[0])
}

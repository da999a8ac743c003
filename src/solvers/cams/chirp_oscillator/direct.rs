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

/// Positive nodes and weights on (−1, 1) of the rule with 32 points, computed at 40 digits and
/// rounded.
const RULE_32: [[f64; 2]; 16] = [
    [0.9972638618494816, 0.007018610009470096],
    [0.9856115115452684, 0.01627439473090567],
    [0.9647622555875064, 0.02539206530926206],
    [0.9349060759377397, 0.03427386291302143],
    [0.8963211557660521, 0.04283589802222668],
    [0.84936761373257, 0.050998059262376175],
    [0.7944837959679424, 0.058684093478535544],
    [0.7321821187402897, 0.06582222277636185],
    [0.6630442669302152, 0.0723457941088485],
    [0.5877157572407623, 0.07819389578707031],
    [0.5068999089322294, 0.08331192422694675],
    [0.42135127613063533, 0.08765209300440381],
    [0.33186860228212767, 0.09117387869576389],
    [0.23928736225213706, 0.09384439908080457],
    [0.1444719615827965, 0.09563872007927486],
    [0.04830766568773832, 0.0965400885147278],
];

/// The same with 20 points.
const RULE_20: [[f64; 2]; 10] = [
    [0.9931285991850949, 0.017614007139152118],
    [0.9639719272779138, 0.04060142980038694],
    [0.912234428251326, 0.06267204833410907],
    [0.8391169718222188, 0.08327674157670475],
    [0.7463319064601508, 0.10193011981724044],
    [0.636053680726515, 0.11819453196151841],
    [0.5108670019508271, 0.13168863844917664],
    [0.37370608871541955, 0.14209610931838204],
    [0.22778585114164507, 0.14917298647260374],
    [0.07652652113349734, 0.15275338713072584],
];

//! P. Thompson, D. E. Cox, J. B. Hastings, J. Appl. Cryst. 20 (1987) 79–83: the pseudo-Voigt
//! profile, a sum of a Lorentzian and a Gaussian of one width, `η L(x; f) + (1 − η) G(x; f)` with
//! `f⁵ = g⁵ + 2.69269 g⁴l + 2.42843 g³l² + 4.47163 g²l³ + 0.07842 g l⁴ + l⁵` and
//! `η = 1.36603 (l/f) − 0.47719 (l/f)² + 0.11116 (l/f)³`; g and l are the full widths at half the
//! height.
//!
//! As K(x, y): the Gaussian `e^{−t²}` has `g = 2 √ln 2`, the Lorentzian `l = 2y`, and K is √π times
//! the profile.

use crate::algorithm::{Algorithm, Parts, UPPER};
use crate::elementary::SQRT_PI;
use num_complex::{Complex, Complex64};
use std::f64::consts::{LN_2, PI};

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "thompson-cox-hastings-1987",
    title: "The pseudo-Voigt profile of powder diffraction",
    source: "P. Thompson, D. E. Cox, J. B. Hastings, J. Appl. Cryst. 20 (1987) 79-83",
    read_from: "the formulas as every Rietveld code has them",
    parts: Parts::Real,
    w: pseudo_voigt,
    ..UPPER
}];

fn pseudo_voigt(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let (g, l) = (2.0 * LN_2.sqrt(), 2.0 * y);
    // In units of the larger width: no fifth power overflows.
    let size = g.max(l);
    let (a, b) = (g / size, l / size);
    let cubic = a * (a * (a + 2.69269 * b) + 2.42843 * b * b) + 4.47163 * b * b * b;
    let inner = a * (a * cubic + 0.07842 * b.powi(4)) + b.powi(5);
    let f = size * libm::pow(inner, 0.2);
    let r = l / f;
    let eta = r * (1.36603 + r * (-0.47719 + r * 0.11116));
    let h = f / 2.0;
    let lorentz = h / PI / (x * x + h * h);
    let gauss = (LN_2.sqrt() / (h * SQRT_PI)) * libm::exp(-LN_2 * (x / h) * (x / h));
    Complex::new(SQRT_PI * (eta * lorentz + (1.0 - eta) * gauss), f64::NAN)
}

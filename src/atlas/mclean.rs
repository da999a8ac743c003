//! A. B. McLean, C. E. J. Mitchell, D. M. Swanston, J. Electron Spectrosc. Relat. Phenom. 69 (1994)
//! 125–132: four generalised Lorentzians,
//! `K(x, y) ≈ Σ_k (C_k (y − A_k) + D_k (x − B_k))/((y − A_k)² + (x − B_k)²)`.

use crate::algorithm::{Algorithm, Parts, UPPER};
use num_complex::{Complex, Complex64};

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "mclean-1994",
    title: "Four generalised Lorentzians",
    source: "A. B. McLean, C. E. J. Mitchell, D. M. Swanston, J. Electron Spectrosc. Relat. Phenom. 69 (1994) 125-132",
    read_from: "coefficients as in GRINS and in codes for gamma-ray and Mössbauer spectra, where the profile is \
                K(x, y) with x and y in units of half the Doppler width times sqrt(ln 2)",
    parts: Parts::Real,
    w: four,
    ..UPPER
}];

const A: [f64; 4] = [-1.2150, -1.3509, -1.2150, -1.3509];
const B: [f64; 4] = [1.2359, 0.3786, -1.2359, -0.3786];
const C: [f64; 4] = [-0.3085, 0.5906, -0.3085, 0.5906];
const D: [f64; 4] = [0.0210, -1.1858, -0.0210, 1.1858];

fn four(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let term = |k: usize| {
        let (u, v) = (y - A[k], x - B[k]);
        (C[k] * u + D[k] * v) / (u * u + v * v)
    };
    Complex::new((0..4).map(term).sum(), f64::NAN)
}

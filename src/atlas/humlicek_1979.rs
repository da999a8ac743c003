//! J. Humlíček, JQSRT 21 (1979) 309–313: twelve poles, `cpf12`.
//!
//! Gauss's formula after the shift of the contour by `i y₀`, `y₀ = 1.5`:
//! `w(z) ≈ (i/π) Σ_k W_k e^{y₀²} e^{2i t_k y₀}/(z + i y₀ − t_k)`, t_k and W_k the nodes and weights
//! of the twelve-point Gauss–Hermite formula; near the real axis the real part is `e^{−x²}` and y
//! times a sum.

use crate::algorithm::{Algorithm, UPPER};
use num_complex::{Complex, Complex64};

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "humlicek-1979",
    title: "Humlíček's twelve poles with e^(-x²) near the real axis (cpf12)",
    source: "J. Humlíček, JQSRT 21 (1979) 309-313",
    read_from: "constants and regions as in HAPI's cpf and in the copies of the paper's subroutine CPF12 in public \
                codes; compared with Gauss-Hermite nodes and weights",
    w: cpf12,
    formula: Some(formula),
    ..UPPER
}];

/// Nodes of the twelve-point Gauss–Hermite formula, as printed.
pub const T: [f64; 6] = [
    0.314240376,
    0.947788391,
    1.59768264,
    2.27950708,
    3.02063703,
    3.8897249,
];
/// `W_k e^{y₀²} cos(2 t_k y₀)/π`, as printed.
pub const C: [f64; 6] = [
    1.01172805,
    -0.75197147,
    1.2557727e-2,
    1.00220082e-2,
    -2.42068135e-4,
    5.00848061e-7,
];
/// `W_k e^{y₀²} sin(2 t_k y₀)/π`, as printed.
pub const S: [f64; 6] = [
    1.393237,
    0.231152406,
    -0.155351466,
    6.21836624e-3,
    9.19082986e-5,
    -6.27525958e-7,
];

fn formula(z: Complex64) -> u8 {
    u8::from(!(z.im > 0.85 || z.re.abs() < 18.1 * z.im + 1.65))
}

fn cpf12(z: Complex64) -> Complex64 {
    twelve_poles(z, formula(z) == 1)
}

/// The sum; beside the real axis with the real part's own formula.
pub fn twelve_poles(z: Complex64, beside: bool) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let (y1, y3) = (y + 1.5, y + 3.0);
    let y2 = y1 * y1;
    let mut w = Complex::new(0.0, 0.0);
    if beside && x.abs() < 12.0 {
        w.re = libm::exp(-x * x);
    }
    for k in 0..6 {
        let part = |r: f64, s: f64| {
            let r2 = r * r;
            let d = 1.0 / (r2 + y2);
            let (d1, d2) = (y1 * d, r * d);
            let re = match beside {
                true => y * (C[k] * (r * d2 - 1.5 * d1) + s * y3 * d2) / (r2 + 2.25),
                false => C[k] * d1 - s * d2,
            };
            Complex::new(re, C[k] * d2 + s * d1)
        };
        // The poles at −t_k have the opposite sine.
        let (right, left) = (part(x - T[k], S[k]), part(x + T[k], -S[k]));
        w += right + left;
    }
    w
}

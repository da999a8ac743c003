//! G. P. M. Poppe, C. M. J. Wijers, ACM TOMS 16 (1990) 38–46 and 47, algorithm 680: the Maclaurin
//! series near the origin, Gautschi's expansion with fewer terms around it, Laplace's continued
//! fraction beyond.

use crate::algorithm::{Algorithm, WHOLE};
use crate::elementary::{FRAC_2_SQRT_PI, continued_below, gaussian, mirrored};
use crate::laplace::expansion;
use num_complex::{Complex, Complex64};

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "poppe-wijers-1990",
    title: "Algorithm 680: Maclaurin series, Taylor expansion, continued fraction",
    source: "G. P. M. Poppe, C. M. J. Wijers, ACM TOMS 16 (1990) 38-46, 47",
    read_from: "parameters as in the paper's WOFZ and its translation by A. Shterenlikht (errfun.f90)",
    w: wofz,
    formula: Some(formula),
    ..WHOLE
}];

fn rho2(z: Complex64) -> f64 {
    let (x, y) = (z.re / 6.3, z.im / 4.4);
    x * x + y * y
}

fn formula(z: Complex64) -> u8 {
    match rho2(z) {
        r if r < 0.085264 => 0,
        r if r > 1.0 => 2,
        _ => 1,
    }
}

fn wofz(z: Complex64) -> Complex64 {
    continued_below(z, |z| mirrored(z, quadrant))
}

fn quadrant(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    let (rho2, low) = (rho2(z), y / 4.4);
    let w = match formula(z) {
        0 => {
            let rho = (1.0 - 0.85 * low) * rho2.sqrt();
            return maclaurin(z, (6.0 + 72.0 * rho).round() as i32);
        }
        2 => {
            let levels = 3.0 + 1442.0 / (26.0 * rho2.sqrt() + 77.0);
            expansion(z, levels as i32, None)
        }
        _ => {
            let rho = (1.0 - low) * (1.0 - rho2).max(0.0).sqrt();
            let count = |a: f64, b: f64| (a + b * rho).round() as i32;
            let about = (1.88 * rho, count(7.0, 34.0));
            expansion(z, count(16.0, 26.0), (rho > 0.0).then_some(about))
        }
    };
    match y == 0.0 {
        true => Complex::new(libm::exp(-x * x), w.im),
        false => w,
    }
}

/// `e^{−z²} (1 + (2i/√π) Σ z^{2n+1}/(n! (2n+1)))` (DLMF 7.6.1).
fn maclaurin(z: Complex64, terms: i32) -> Complex64 {
    let z2 = Complex::new((z.re - z.im) * (z.re + z.im), 2.0 * z.re * z.im);
    let mut sum = Complex::new(1.0 / f64::from(2 * terms + 1), 0.0);
    for i in (1..=terms).rev() {
        sum = sum * z2 / f64::from(i) + 1.0 / f64::from(2 * i - 1);
    }
    let erfi = FRAC_2_SQRT_PI * (sum * z);
    gaussian(z) * Complex::new(1.0 - erfi.im, erfi.re)
}

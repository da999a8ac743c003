//! J. A. C. Weideman, SIAM J. Numer. Anal. 31 (1994) 1497–1518, equation (38) and table I:
//! `w(z) ≈ (1/√π)/(L − iz) + 2/(L − iz)² Σ_{n=0}^{N−1} a_{n+1} Z^n`, `Z = (L + iz)/(L − iz)`,
//! `L = 2^{−1/4} √N`.
//!
//! The coefficients are computed as in the paper, by the trapezoidal rule with `2M = 4N` points for
//! the Fourier coefficients of `(L² + t²) e^{−t²}`, `t = L tan(θ/2)`.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{FRAC_1_SQRT_PI, horner, quotient};
use crate::real::Real;
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

const fn with(
    name: &'static str,
    title: &'static str,
    w: fn(Complex64) -> Complex64,
    single: fn(Complex<f32>) -> Complex<f32>,
) -> Algorithm {
    Algorithm {
        name,
        title,
        source: "J. A. C. Weideman, SIAM J. Numer. Anal. 31 (1994) 1497-1518",
        read_from: "equation (38) and the eight lines of Matlab of table I, as reproduced in HAPI's cef; coefficients \
                    computed from them",
        w,
        single: Some(single),
        ..UPPER
    }
}

/// N = 16, 24 and 32.
pub const ALGORITHMS: [Algorithm; 3] = [
    with(
        "weideman-1994-16",
        "Weideman's rational series, N = 16",
        |z| N16.at(z),
        |z| N16.at(z),
    ),
    with(
        "weideman-1994-24",
        "Weideman's rational series, N = 24",
        |z| N24.at(z),
        |z| N24.at(z),
    ),
    with(
        "weideman-1994-32",
        "Weideman's rational series, N = 32 (the usual choice, jax.scipy.special.wofz)",
        |z| N32.at(z),
        |z| N32.at(z),
    ),
];

/// A series.
pub struct Series {
    l: f64,
    /// From the highest power.
    a: Vec<f64>,
}

static N16: LazyLock<Series> = LazyLock::new(|| Series::new(16));
/// N = 24.
pub static N24: LazyLock<Series> = LazyLock::new(|| Series::new(24));
static N32: LazyLock<Series> = LazyLock::new(|| Series::new(32));

impl Series {
    fn new(n: usize) -> Series {
        let l = (n as f64 / 2f64.sqrt()).sqrt();
        let m = 2 * n;
        let points: Vec<(f64, f64)> = (0..2 * m)
            .map(|k| {
                let theta = PI * (k as f64 - m as f64) / m as f64;
                // The value at θ = −π is the limit.
                let t = l * libm::tan(theta / 2.0);
                let f = if k == 0 {
                    0.0
                } else {
                    libm::exp(-t * t) * (l * l + t * t)
                };
                (theta, f)
            })
            .collect();
        let coefficient = |j: usize| {
            let terms = points
                .iter()
                .map(|(theta, f)| f * libm::cos(j as f64 * theta));
            terms.sum::<f64>() / (2 * m) as f64
        };
        Series {
            l,
            a: (1..=n).rev().map(coefficient).collect(),
        }
    }

    /// w(z).
    pub fn at<T: Real>(&self, z: Complex<T>) -> Complex<T> {
        let l = T::of(self.l);
        let below = Complex::new(l + z.im, -z.re);
        let above = Complex::new(l - z.im, z.re);
        let p = horner(quotient(above, below), &self.a);
        let one = Complex::new(T::one(), T::zero());
        let inverse = quotient(one, below);
        (p * inverse * T::of(2.0) + T::of(FRAC_1_SQRT_PI)) * inverse
    }
}

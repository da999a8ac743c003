//! S. M. Abrarov, B. M. Quine, Appl. Math. Comput. 218 (2011) 1894–1902, equation (14): the Fourier
//! series of `e^{−t²/4}` over `|t| ≤ τ` integrated term by term, τ = 12, 23 terms,
//! `w ≈ (iτ²z/√π) (√π/τ (1 − e^{iτz})/(τz)² + Σ a_n ((−1)ⁿ e^{iτz} − 1)/(n²π² − τ²z²))`,
//! `a_n = (2√π/τ) e^{−n²π²/τ²}`; and the authors' program `fadf.m` of 2014–2016: that within
//! `|z| ≤ 8`, Laplace's continued fraction beyond, and for `Im z < 0.005` the same series with
//! `cos τz` and `e^{−z²}` in place of `e^{iτz}`.

use crate::algorithm::{Algorithm, UPPER, WHOLE};
use crate::elementary::{SQRT_PI, exp, gaussian, quotient, times_i};
use crate::laplace::convergent;
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The series alone, and the program.
pub const ALGORITHMS: [Algorithm; 2] = [
    Algorithm {
        name: "abrarov-quine-2011",
        title: "Fourier expansion of e^(-t²/4), τ = 12, 23 terms",
        source: "S. M. Abrarov, B. M. Quine, Appl. Math. Comput. 218 (2011) 1894-1902, eq. (14)",
        read_from: "fexp in the authors' fadf.m",
        w: |z| AT_12.integrated(z),
        ..UPPER
    },
    Algorithm {
        name: "abrarov-quine-2016",
        title: "The authors' fadf.m: series, continued fraction, a narrow band of its own",
        source: "S. M. Abrarov, B. M. Quine, program fadf.m (2014, July 2016), after the same and arXiv:1205.1768",
        read_from: "fadf.m",
        w: fadf,
        formula: Some(|z| formula(upper(z))),
        ..WHOLE
    },
];

/// A series with its margin τ.
struct Fourier {
    tau: f64,
    a: [f64; 23],
}

static AT_12: LazyLock<Fourier> = LazyLock::new(|| Fourier::new(12.0));
/// With other poles.
static AT_12_1: LazyLock<Fourier> = LazyLock::new(|| Fourier::new(12.1));

impl Fourier {
    fn new(tau: f64) -> Fourier {
        let a = std::array::from_fn(|k| {
            let n = (k + 1) as f64 * PI / tau;
            2.0 * SQRT_PI / tau * libm::exp(-n * n)
        });
        Fourier { tau, a }
    }

    /// `Σ a_n ((−1)ⁿ e − 1)/(n²π² − z2)`.
    fn sum(&self, e: Complex64, z2: Complex64) -> Complex64 {
        let term = |(k, a): (usize, &f64)| {
            let n = (k + 1) as f64 * PI;
            let above = if k % 2 == 0 { -e - 1.0 } else { e - 1.0 };
            *a * quotient(above, n * n - z2)
        };
        self.a.iter().enumerate().map(term).sum()
    }

    fn integrated(&self, z: Complex64) -> Complex64 {
        let tau = self.tau;
        let e = exp(times_i(z * tau));
        let z2 = tau * tau * (z * z);
        let first = SQRT_PI / tau * quotient(1.0 - e, z2);
        times_i(tau * tau / SQRT_PI * z * (first + self.sum(e, z2)))
    }

    fn beside_the_axis(&self, z: Complex64) -> Complex64 {
        let tau = self.tau;
        let cos = cosine(z * tau);
        let z2 = tau * tau * (z * z);
        let rest = quotient(cos - 1.0, z * tau) - tau * tau / SQRT_PI * z * self.sum(cos, z2);
        gaussian(z) - times_i(rest)
    }
}

fn cosine(z: Complex64) -> Complex64 {
    let (sin, cos) = libm::sincos(z.re);
    Complex::new(cos * libm::cosh(z.im), -sin * libm::sinh(z.im))
}

fn upper(z: Complex64) -> Complex64 {
    Complex::new(z.re, z.im.abs())
}

fn formula(z: Complex64) -> u8 {
    if z.re.hypot(z.im) > 8.0 {
        return 0;
    }
    if z.im >= 5e-3 {
        return 1;
    }
    if z.re.abs() < 5e-3 {
        return 2;
    }
    let pole = |k: i32| (z.re - f64::from(k) * PI / 12.0).abs() < 1e-4;
    if (1..=23).any(pole) { 3 } else { 4 }
}

fn fadf(z: Complex64) -> Complex64 {
    let up = upper(z);
    let w = match formula(up) {
        0 => convergent(up, 11),
        1 => AT_12.integrated(up),
        2 => small(up),
        3 => AT_12_1.beside_the_axis(up),
        _ => AT_12.beside_the_axis(up),
    };
    match z.im < 0.0 {
        true => (2.0 * gaussian(up) - w).conj(),
        false => w,
    }
}

/// Three terms of either factor of `e^{−z²} (1 + 2i/√π ∫ e^{t²})`.
fn small(z: Complex64) -> Complex64 {
    let p2 = z * z;
    let p4 = p2 * p2;
    let gauss = 6.0 - 6.0 * p2 + 3.0 * p4 - p2 * p4;
    let rest = 15.0 * SQRT_PI + times_i(z) * (30.0 + 10.0 * p2 + 3.0 * p4);
    gauss * rest / (90.0 * SQRT_PI)
}

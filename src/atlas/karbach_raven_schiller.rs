//! T. M. Karbach, G. Raven, M. Schiller, arXiv:1407.0748 (2014), section 5: Abrarov and Quine's
//! series in the form of equation (14), Taylor expansions about its removable poles `nπ/τ`,
//! Laplace's continued fraction for `|z| > τ`. RooFit's `faddeeva` (τ = 12, 24 terms) and
//! `faddeeva_fast` (τ = 8, 11 terms).

use crate::algorithm::{Algorithm, WHOLE};
use crate::elementary::{
    FRAC_1_SQRT_PI, FRAC_2_SQRT_PI, SQRT_PI, exp, gaussian, quotient, times_i,
};
use mechaudit_solvers::faddeeva::dawson_real;
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// RooFit's two.
pub const ALGORITHMS: [Algorithm; 2] = [
    with(
        "karbach-raven-schiller-2014",
        "RooFit's faddeeva: series τ = 12 with 24 terms",
        |z| EXACT.at(z),
        |z| EXACT.formula(z),
    ),
    with(
        "karbach-raven-schiller-2014-fast",
        "RooFit's faddeeva_fast: series τ = 8 with 11 terms",
        |z| FAST.at(z),
        |z| FAST.formula(z),
    ),
];

const fn with(
    name: &'static str,
    title: &'static str,
    w: fn(Complex64) -> Complex64,
    formula: fn(Complex64) -> u8,
) -> Algorithm {
    Algorithm {
        name,
        title,
        source: "T. M. Karbach, G. Raven, M. Schiller, arXiv:1407.0748 (2014)",
        read_from: "borders and numbers of terms as in RooFit's faddeeva_impl.h; its Taylor coefficients computed by \
                    w' = -2 z w + 2i/sqrt(pi)",
        w,
        formula: Some(formula),
        ..WHOLE
    }
}

/// Squared radius of the discs about the poles.
const DISC: f64 = 9e-6;

struct Series {
    tau: f64,
    a: Vec<f64>,
    /// About each pole, from the highest power.
    taylor: Vec<Vec<Complex64>>,
    levels: usize,
}

static EXACT: LazyLock<Series> = LazyLock::new(|| Series::new(12.0, 24, 6, 9));
static FAST: LazyLock<Series> = LazyLock::new(|| Series::new(8.0, 11, 3, 3));

impl Series {
    fn new(tau: f64, terms: usize, taylor: usize, levels: usize) -> Series {
        let place = |n: usize| n as f64 * PI / tau;
        Series {
            tau,
            a: (0..terms)
                .map(|n| 2.0 * SQRT_PI / tau * libm::exp(-place(n) * place(n)))
                .collect(),
            taylor: (0..terms).map(|n| expansion(place(n), taylor)).collect(),
            levels,
        }
    }

    /// The pole whose disc holds z, and where in it.
    fn pole(&self, z: Complex64) -> Option<(usize, Complex64)> {
        if z.im * z.im >= DISC {
            return None;
        }
        let nearest = (self.tau * z.re.abs() / PI + 0.5).floor();
        if nearest >= self.a.len() as f64 {
            return None;
        }
        let place = nearest * PI / self.tau;
        let from = Complex::new(z.re.abs() - place, z.im);
        (from.norm_sqr() < DISC).then_some((nearest as usize, from))
    }

    fn formula(&self, z: Complex64) -> u8 {
        match self.pole(z) {
            Some(_) => 0,
            None if z.norm_sqr() > self.tau * self.tau => 1,
            None => 2,
        }
    }

    fn at(&self, z: Complex64) -> Complex64 {
        if let Some((n, from)) = self.pole(z) {
            let zero = Complex::new(0.0, 0.0);
            let w = self.taylor[n].iter().fold(zero, |sum, c| sum * from + c);
            // w(−x + iy) is the conjugate of w(x + iy).
            return if z.re < 0.0 { w.conj() } else { w };
        }
        let up = if z.im < 0.0 { -z } else { z };
        let w = match z.norm_sqr() > self.tau * self.tau {
            true => self.fraction(up),
            false => self.series(up),
        };
        match z.im < 0.0 {
            true => 2.0 * gaussian(z) - w,
            false => w,
        }
    }

    /// `(−iz/√π)/(−z² + (1/2)/(1 + (2/2)/(−z² + …)))`.
    fn fraction(&self, z: Complex64) -> Complex64 {
        let z2 = Complex::new((z.re + z.im) * (z.re - z.im), 2.0 * z.re * z.im);
        let mut tail = Complex::new(1.0, 0.0);
        for k in (1..=self.levels).rev() {
            let turned = quotient(Complex::new(k as f64 / 2.0, 0.0), tail);
            tail = match k % 2 {
                1 => turned - z2,
                _ => turned + 1.0,
            };
        }
        -times_i(quotient(z * FRAC_1_SQRT_PI, tail))
    }

    fn series(&self, z: Complex64) -> Complex64 {
        let tz = z * self.tau;
        let e = exp(times_i(tz));
        let mut sum = -self.a[0] * quotient(1.0 - e, z);
        for (n, a) in self.a.iter().enumerate() {
            let p = n as f64 * PI;
            // n²π² − τ²z², from factors.
            let below = Complex::new(
                (p + tz.re) * (p - tz.re) + tz.im * tz.im,
                -2.0 * tz.re * tz.im,
            );
            let above = tz * if n % 2 == 0 { 1.0 - e } else { 1.0 + e };
            sum -= 2.0 * self.tau * a * quotient(above, below);
        }
        times_i(sum) / (2.0 * SQRT_PI)
    }
}

/// Taylor coefficients of w at a real point, from the highest: `w' = −2zw + 2i/√π`, and
/// `w⁽ᵏ⁺¹⁾ = −2z w⁽ᵏ⁾ − 2k w⁽ᵏ⁻¹⁾`.
fn expansion(x: f64, terms: usize) -> Vec<Complex64> {
    let w = Complex::new(libm::exp(-x * x), FRAC_2_SQRT_PI * dawson_real(x));
    let mut derivatives = vec![w, -2.0 * x * w + Complex::new(0.0, FRAC_2_SQRT_PI)];
    for k in 1..terms {
        let next = -2.0 * x * derivatives[k] - 2.0 * k as f64 * derivatives[k - 1];
        derivatives.push(next);
    }
    let mut factorial = 1.0;
    let mut all: Vec<Complex64> = (0..terms)
        .map(|k| {
            factorial *= if k > 0 { k as f64 } else { 1.0 };
            derivatives[k] / factorial
        })
        .collect();
    all.reverse();
    all
}

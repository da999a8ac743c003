//! F. Schreier's combinations.
//!
//! MNRAS 479 (2018) 3068–3075: Humlíček's poles with an even number n of Gauss–Hermite nodes and a
//! shift δ, `w(z) ≈ (i/π) Σ_k W_k e^{δ² + 2i t_k δ}/(z + iδ − t_k)`, without a formula of its own
//! beside the real axis; and n = 16 within `|x| + y < 10`, region II of w4 beyond (`hum2zpf16`).
//! JQSRT 112 (2011) 1010–1025: Weideman's N = 24 within `|x| + y < 15`, region I of w4 beyond
//! (`hum1wei24`).

#![allow(clippy::excessive_precision)] // Constants as printed.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{FRAC_1_SQRT_PI, horner, quotient, times_i};
use crate::gauss_hermite::positive;
use crate::real::Real;
use crate::weideman::N24;
use num_complex::{Complex, Complex64};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// The combinations.
pub const ALGORITHMS: [Algorithm; 5] = [
    Algorithm {
        name: "schreier-2011-hum1wei24",
        title: "Weideman N = 24 inside |x| + y < 15, one pole outside (HAPI's default)",
        source: "F. Schreier, JQSRT 112 (2011) 1010-1025",
        read_from: "HAPI's hum1_wei",
        w: hum1wei24::<f64>,
        single: Some(hum1wei24::<f32>),
        formula: Some(|z| u8::from(z.re.abs() + z.im < 15.0)),
        ..UPPER
    },
    Algorithm {
        name: "schreier-2018-16",
        title: "Humlíček's poles, n = 16, shift 1.35",
        source: "F. Schreier, MNRAS 479 (2018) 3068-3075",
        read_from: "the shift as in zpf16P of the paper's supplement cpfX.py; nodes and weights of Gauss's formula computed",
        w: |z| N16.at(z),
        ..UPPER
    },
    Algorithm {
        name: "schreier-2018-16-1.31183",
        title: "Humlíček's poles, n = 16, shift 1.31183",
        source: "F. Schreier, MNRAS 479 (2018) 3068-3075",
        read_from: "the shift as in zpf16p of the paper's supplement cpfX.py and of Py4CAtS; nodes and weights of Gauss's formula computed",
        w: shifted_16,
        ..UPPER
    },
    Algorithm {
        name: "schreier-2018-20",
        title: "Humlíček's poles, n = 20, shift 1.55",
        source: "F. Schreier, MNRAS 479 (2018) 3068-3075",
        read_from: "cpfX of the paper's supplement, where the shift is the caller's and 1.5 unless given; 1.55 is ours: \
                    from 1.35 to 1.8 all reach what the abstract states for 0 < x < 25, 1e-4 < y < 100 (tested)",
        w: |z| N20.at(z),
        ..UPPER
    },
    Algorithm {
        name: "schreier-2018-hum2zpf16",
        title: "Poles n = 16 as one fraction inside |x| + y < 10, two poles outside (astropy's Humlicek2)",
        source: "F. Schreier, MNRAS 479 (2018) 3068-3075",
        read_from: "coefficients as in astropy's Voigt1D._hum2zpf16c",
        w: hum2zpf16::<f64>,
        single: Some(hum2zpf16::<f32>),
        formula: Some(|z| u8::from(z.re.abs() + z.im < 10.0)),
        ..UPPER
    },
];

/// Weideman's series within `|x| + y < 15`, one pole beyond.
pub fn hum1wei24<T: Real>(z: Complex<T>) -> Complex<T> {
    if z.re.abs() + z.im < T::of(15.0) {
        return N24.at(z);
    }
    let t = Complex::new(z.im, -z.re);
    quotient(t * T::of(FRAC_1_SQRT_PI), t * t + T::of(0.5))
}

/// A sum over the poles `±t_k − iδ`.
pub struct Poles {
    shift: f64,
    /// Node, cosine and sine parts of its weight.
    terms: Vec<[f64; 3]>,
}

static N16: LazyLock<Poles> = LazyLock::new(|| Poles::new(16, 1.35));
static N16_LOWER: LazyLock<Poles> = LazyLock::new(|| Poles::new(16, 1.31183));
static N20: LazyLock<Poles> = LazyLock::new(|| Poles::new(20, 1.55));

/// Sixteen poles with the shift 1.31183.
pub fn shifted_16(z: Complex64) -> Complex64 {
    N16_LOWER.at(z)
}

impl Poles {
    /// With so many nodes and this shift.
    pub fn new(n: usize, shift: f64) -> Poles {
        let term = |(t, weight): (f64, f64)| {
            let size = weight * libm::exp(shift * shift) / PI;
            let (sin, cos) = libm::sincos(2.0 * t * shift);
            [t, size * cos, size * sin]
        };
        Poles {
            shift,
            terms: positive(n).into_iter().map(term).collect(),
        }
    }

    /// `i Σ (c + i s)/(z + iδ − t) + (c − i s)/(z + iδ + t)`, each with the quotient's parts apart.
    pub fn at(&self, z: Complex64) -> Complex64 {
        let y = z.im + self.shift;
        let mut w = Complex::new(0.0, 0.0);
        for [t, c, s] in &self.terms {
            for (r, s) in [(z.re - t, *s), (z.re + t, -s)] {
                let d = 1.0 / (r * r + y * y);
                w += Complex::new((c * y - s * r) * d, (c * r + s * y) * d);
            }
        }
        w
    }
}

/// In Z = z + 1.35 i: real coefficients of even powers, imaginary ones of odd powers, from the
/// lowest.
const NUMERATOR: [f64; 16] = [
    46236.3358828121,
    -147726.58393079657,
    -206562.80451354137,
    281369.1590631087,
    183092.74968253175,
    -184787.96830696272,
    -66155.39578477248,
    57778.05827983565,
    11682.770904216826,
    -9442.402767960672,
    -1052.8438624933142,
    814.0996198624186,
    45.94499030751872,
    -34.59751573708725,
    -0.7616559377907136,
    0.5641895835476449,
];
/// In Z², from the highest.
const DENOMINATOR: [f64; 9] = [
    1.0,
    -60.0,
    1365.0,
    -15015.0,
    84459.375,
    -236486.25,
    295607.8125,
    -126689.0625,
    7918.06640624997,
];

fn hum2zpf16<T: Real>(z: Complex<T>) -> Complex<T> {
    let c = T::of;
    if z.re.abs() + z.im < c(10.0) {
        let shifted = Complex::new(z.re, z.im + c(1.35));
        let mut above = Complex::new(T::zero(), T::zero());
        for (k, &a) in NUMERATOR.iter().enumerate().rev() {
            above = above * shifted;
            match k % 2 {
                0 => above.re = above.re + c(a),
                _ => above.im = above.im + c(a),
            }
        }
        return quotient(above, horner(shifted * shifted, &DENOMINATOR));
    }
    let u = z * z;
    let above = z * (u * c(FRAC_1_SQRT_PI) - c(1.410474));
    times_i(quotient(above, u * (u - c(3.0)) + c(0.75)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit_solvers::faddeeva::faddeeva;

    /// The largest relative error of a part over 0 < x < 25, 1e-4 < y < 100.
    fn worst(poles: &Poles) -> f64 {
        let mut worst = 0.0f64;
        for j in 0..60 {
            let y = libm::exp10(-4.0 + 0.1 * f64::from(j) + 0.01);
            for i in 0..250 {
                let z = Complex::new(0.1 * f64::from(i) + 0.037, y);
                let (got, due) = (poles.at(z), faddeeva(z));
                let re = ((got.re - due.re) / due.re).abs();
                let im = ((got.im - due.im) / due.im).abs();
                worst = worst.max(re).max(im);
            }
        }
        worst
    }

    #[test]
    fn what_twenty_poles_reach_by_their_shift() {
        for shift in [1.35, 1.5, 1.55, 1.65, 1.8] {
            assert!(worst(&Poles::new(20, shift)) < 1e-6, "{shift}");
        }
        assert!(worst(&Poles::new(20, 1.2)) > 1e-6);
    }
}

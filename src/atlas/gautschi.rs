//! W. Gautschi, Comm. ACM 12 (1969) 635, algorithm 363, and SIAM J. Numer. Anal. 7 (1970) 187–198:
//! Laplace's continued fraction far from the origin, and within `|x| < 5.33, |y| < 4.29` a
//! truncated Taylor expansion whose derivatives the continued fraction gives.
//!
//! CERNLIB's WWERF (C335, K. Kölbig) has the same numbers.

use crate::algorithm::{Algorithm, WHOLE};
use crate::elementary::{continued_below, mirrored};
use crate::laplace::expansion;
use num_complex::{Complex, Complex64};

/// The algorithm, and without its care of the real axis.
pub const ALGORITHMS: [Algorithm; 2] = [
    Algorithm {
        name: "gautschi-1970",
        title: "Gautschi's algorithm 363: Taylor expansion by Laplace's continued fraction",
        source: "W. Gautschi, Comm. ACM 12 (1969) 635; SIAM J. Numer. Anal. 7 (1970) 187-198",
        read_from: "borders and numbers of terms as in CERNLIB's WWERF, which has e^(-x²) on the real axis as a comment",
        w: algorithm_363,
        formula: Some(formula),
        ..WHOLE
    },
    Algorithm {
        name: "cernlib-wwerf",
        title: "CERNLIB's WWERF as beam codes carry it: algorithm 363 without e^(-x²) on the real axis",
        source: "K. Kölbig, CERNLIB C335, after W. Gautschi 1970",
        read_from: "the copies in MAD-X, SixTrack and PyHEADTAIL",
        w: wwerf,
        formula: Some(formula),
        ..WHOLE
    },
];

const X: f64 = 5.33;
const Y: f64 = 4.29;

fn formula(z: Complex64) -> u8 {
    u8::from(z.im.abs() < Y && z.re.abs() < X)
}

fn algorithm_363(z: Complex64) -> Complex64 {
    let w = wwerf(z);
    match z.im == 0.0 {
        true => Complex::new(libm::exp(-z.re * z.re), w.im),
        false => w,
    }
}

fn wwerf(z: Complex64) -> Complex64 {
    continued_below(z, |z| mirrored(z, quadrant))
}

fn quadrant(z: Complex64) -> Complex64 {
    let (x, y) = (z.re, z.im);
    if formula(z) == 0 {
        return expansion(z, 8, None);
    }
    let q = (1.0 - y / Y) * (1.0 - (x / X) * (x / X)).sqrt();
    let terms = 6 + (23.0 * q) as i32;
    expansion(z, 9 + (21.0 * q) as i32, Some((1.6 * q, terms)))
}

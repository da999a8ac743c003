//! W. Gautschi, Comm. ACM 12 (1969) 635, algorithm 363, and SIAM J. Numer. Anal. 7 (1970) 187–198: Laplace's
//! continued fraction far from the origin, and within `|x| < 5.33, |y| < 4.29` a truncated Taylor expansion
//! whose derivatives the continued fraction gives.
//!
//! CERNLIB's WWERF (C335, K. Kölbig) has the same numbers.

use crate::algorithm::{Algorithm, Parts, Plane};
use crate::elementary::{FRAC_2_SQRT_PI, continued_below, mirrored};
use num_complex::{Complex, Complex64};

/// The algorithm, and without its care of the real axis.
pub const ALGORITHMS: [Algorithm; 2] = [
    Algorithm {
        name: "gautschi-1970",
        title: "Gautschi's algorithm 363: Taylor expansion by Laplace's continued fraction",
        source: "W. Gautschi, Comm. ACM 12 (1969) 635; SIAM J. Numer. Anal. 7 (1970) 187-198",
        read_from: "borders and numbers of terms as in CERNLIB's WWERF, which has e^(-x²) on the real axis as a comment",
        plane: Plane::Whole,
        parts: Parts::Both,
        w: algorithm_363,
        single: None,
        formula: Some(formula),
    },
    Algorithm {
        name: "cernlib-wwerf",
        title: "CERNLIB's WWERF as beam codes carry it: algorithm 363 without e^(-x²) on the real axis",
        source: "K. Kölbig, CERNLIB C335, after W. Gautschi 1970",
        read_from: "the copies in MAD-X, SixTrack and PyHEADTAIL",
        plane: Plane::Whole,
        parts: Parts::Both,
        w: wwerf,
        single: None,
        formula: Some(formula),
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
    let near = formula(z) == 1;
    let q = match near {
        true => (1.0 - y / Y) * (1.0 - (x / X) * (x / X)).sqrt(),
        false => 0.0,
    };
    // Levels of the continued fraction, terms of the expansion, its step.
    let (levels, terms) = match near {
        true => (9 + (21.0 * q) as i32, 6 + (23.0 * q) as i32),
        false => (8, 0),
    };
    let h = 1.6 * q;
    let mut power = (2.0 * h).powi(terms);
    let (mut r, mut s) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
    for n in (0..=levels).rev() {
        let m = f64::from(n + 1);
        let t = Complex::new(y + h + m * r.re, x - m * r.im);
        let c = 0.5 / (t.re * t.re + t.im * t.im);
        r = Complex::new(c * t.re, c * t.im);
        if near && n <= terms {
            s = r * (s + power);
            power /= 2.0 * h;
        }
    }
    FRAC_2_SQRT_PI * if near { s } else { r }
}

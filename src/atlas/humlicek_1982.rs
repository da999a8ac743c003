//! J. Humlíček, JQSRT 27 (1982) 437–444: four rational approximations, `w4`.
//!
//! With `t = y − ix`, `s = |x| + y`: one, two and five poles farther out, and near the real axis
//! `e^{t²} − t P(t²)/Q(t²)`.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{exp, horner, quotient};
use crate::real::Real;
use num_complex::Complex;

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "humlicek-1982",
    title: "Humlíček's four regions (w4)",
    source: "J. Humlíček, JQSRT 27 (1982) 437-444",
    read_from: "constants and regions as in the copies of the paper's function W4 in public codes",
    w: w4::<f64>,
    single: Some(w4::<f32>),
    formula: Some(region::<f64>),
    ..UPPER
}];

/// Region IV: numerator and denominator in powers of `−t²`, from the highest.
const P4: [f64; 7] = [
    0.56419, 1.320522, 35.76683, 219.0313, 1540.787, 3321.9905, 36183.31,
];
const Q4: [f64; 8] = [
    1.0, 1.841439, 61.57037, 364.2191, 2186.181, 9022.228, 24322.84, 32066.6,
];

fn region<T: Real>(z: Complex<T>) -> u8 {
    let (x, y) = (z.re.abs(), z.im);
    let s = x + y;
    match s {
        s if s >= T::of(15.0) => 1,
        s if s >= T::of(5.5) => 2,
        _ if y >= T::of(0.195) * x - T::of(0.176) => 3,
        _ => 4,
    }
}

/// The asymptotic region I, `t/(√π (1/2 + t²))`.
pub fn one_pole<T: Real>(t: Complex<T>) -> Complex<T> {
    quotient(t * T::of(0.5641896), t * t + T::of(0.5))
}

/// Region III.
pub fn five_poles<T: Real>(t: Complex<T>) -> Complex<T> {
    quotient(
        horner(t, &[0.5642236, 3.778987, 11.96482, 20.20933, 16.4955]),
        horner(t, &[1.0, 6.699398, 21.69274, 39.27121, 38.82363, 16.4955]),
    )
}

fn w4<T: Real>(z: Complex<T>) -> Complex<T> {
    let t = Complex::new(z.im, -z.re);
    match region(z) {
        1 => one_pole(t),
        2 => {
            let u = t * t;
            quotient(
                t * (u * T::of(0.5641896) + T::of(1.410474)),
                u * (u + T::of(3.0)) + T::of(0.75),
            )
        }
        3 => five_poles(t),
        _ => {
            let u = t * t;
            exp(u) - quotient(t * horner(-u, &P4), horner(-u, &Q4))
        }
    }
}

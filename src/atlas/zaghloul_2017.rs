//! M. R. Zaghloul, ACM TOMS 44 (2017) article 22, algorithm 985: one to four convergents of
//! Laplace's continued fraction outside, region IV of Humlíček's w4 beside the real axis, Hui,
//! Armstrong and Wray's p = 6 inside.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{exp, horner, quotient, times_i};
use crate::real::Real;
use num_complex::Complex;

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "zaghloul-2017",
    title: "Algorithm 985: continued fraction, w4's region IV, p = 6",
    source: "M. R. Zaghloul, ACM TOMS 44 (2017) article 22",
    read_from: "constants and borders as in Faddeyeva985.jl, M. Baum's translation",
    w: algorithm_985::<f64>,
    single: Some(algorithm_985::<f32>),
    formula: Some(region::<f64>),
    ..UPPER
}];

/// `1/√π`.
const THETA: f64 = 0.564_189_583_547_756_3;
const ALPHA: [f64; 7] = [
    THETA, 5.9126262, 30.180142, 93.15558, 181.92853, 214.38239, 122.60793,
];
const BETA: [f64; 8] = [
    1.0, 10.479857, 53.992907, 170.35400, 348.70392, 457.33448, 352.73063, 122.60793,
];
const GAMMA: [f64; 7] = [
    THETA, 1.320522, 35.7668, 219.031, 1540.787, 3321.99, 36183.31,
];
const LAMBDA: [f64; 8] = [
    1.0, 1.841439, 61.57037, 364.2191, 2186.181, 9022.228, 24322.84, 32066.6,
];

fn region<T: Real>(z: Complex<T>) -> u8 {
    let (y2, s) = (z.im * z.im, z.re * z.re + z.im * z.im);
    match s {
        s if s >= T::of(38000.0) => 1,
        s if s >= T::of(256.0) => 2,
        s if s >= T::of(62.0) => 3,
        s if s >= T::of(30.0) && y2 >= T::of(1e-13) => 4,
        s if s > T::of(2.5) && y2 < T::of(5e-9) => 5,
        s if s > T::of(2.5) && y2 < T::of(0.072) => 6,
        _ => 7,
    }
}

fn algorithm_985<T: Real>(z: Complex<T>) -> Complex<T> {
    let c = T::of;
    let (x, y) = (z.re, z.im);
    let (x2, y2) = (x * x, y * y);
    let s = x2 + y2;
    let theta = c(THETA);
    match region(z) {
        1 => Complex::new(y * theta / s, x * theta / s),
        2 => {
            let f = theta / (s * s + (y2 - x2) + c(0.25));
            Complex::new(y * (c(0.5) + s) * f, x * (s - c(0.5)) * f)
        }
        3 => {
            let (q, r) = (y2 - x2 + c(1.5), c(4.0) * x2 * y2);
            let f = theta / (s * (q * q + r));
            let inner = (q - c(0.5)) * q + r;
            Complex::new(y * (inner + x2) * f, x * (inner - y2) * f)
        }
        4 => {
            let u = z * z;
            let above = Complex::new(-y, x) * (u - c(2.5)) * theta;
            quotient(above, u * (u - c(3.0)) + c(0.75))
        }
        k @ (5 | 6) => {
            let u = z * z;
            let ratio = quotient(z * horner(u, &GAMMA), horner(u, &LAMBDA));
            let gauss = match k {
                5 => Complex::new((-x2).exponential(), T::zero()),
                _ => exp(-u),
            };
            gauss + times_i(ratio)
        }
        _ => {
            let q = Complex::new(y, -x);
            quotient(horner(q, &ALPHA), horner(q, &BETA))
        }
    }
}

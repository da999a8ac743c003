//! A. K. Hui, B. H. Armstrong, A. A. Wray, JQSRT 19 (1978) 509–516: one rational function of
//! `t = y − ix` with p = 6, `w ≈ Σ a_k t^k/(t⁷ + Σ b_k t^k)`.

#![allow(clippy::excessive_precision)] // Constants as printed.

use crate::algorithm::{Algorithm, UPPER};
use crate::elementary::{horner, quotient};
use crate::real::Real;
use num_complex::Complex;

/// The algorithm.
pub const ALGORITHMS: [Algorithm; 1] = [Algorithm {
    name: "hui-armstrong-wray-1978",
    title: "One rational function, p = 6",
    source: "A. K. Hui, B. H. Armstrong, A. A. Wray, JQSRT 19 (1978) 509-516",
    read_from: "coefficients as printed, in public codes of solar physics (SIR, fvoigt)",
    w: p6::<f64>,
    single: Some(p6::<f32>),
    ..UPPER
}];

/// From the highest power.
const A: [f64; 7] = [
    0.564189583562615,
    5.912626209773153,
    30.180142196210589,
    93.155580458138441,
    181.928533092181549,
    214.382388694706425,
    122.607931777104326,
];
const B: [f64; 8] = [
    1.0,
    10.479857114260399,
    53.992906912940207,
    170.354001821091472,
    348.703917719495792,
    457.334478783897737,
    352.730625110963558,
    122.607931773875350,
];

fn p6<T: Real>(z: Complex<T>) -> Complex<T> {
    let t = Complex::new(z.im, -z.re);
    // In powers of 1/t far out, where t⁷ would overflow.
    if z.re.abs().max(z.im) > T::of(1e4) {
        let mut reversed = A;
        let mut below = B;
        reversed.reverse();
        below.reverse();
        let s = quotient(Complex::new(T::one(), T::zero()), t);
        return s * quotient(horner(s, &reversed), horner(s, &below));
    }
    quotient(horner(t, &A), horner(t, &B))
}

//! Complex arithmetic that several algorithms need.

use crate::real::Real;
use num_complex::{Complex, Complex64};

/// `1/√π`.
pub const FRAC_1_SQRT_PI: f64 = 0.564_189_583_547_756_3;
/// `2/√π`.
pub const FRAC_2_SQRT_PI: f64 = std::f64::consts::FRAC_2_SQRT_PI;
/// `√π`.
pub const SQRT_PI: f64 = 1.772_453_850_905_516;

/// `e^z`.
pub fn exp<T: Real>(z: Complex<T>) -> Complex<T> {
    let (size, (sin, cos)) = (z.re.exponential(), z.im.sine_cosine());
    Complex::new(size * cos, size * sin)
}

/// `e^{−z²}`, with `x² − y²` as a product.
pub fn gaussian(z: Complex64) -> Complex64 {
    exp(Complex::new(
        (z.im - z.re) * (z.im + z.re),
        -2.0 * z.re * z.im,
    ))
}

/// `a/b` by R. L. Smith's algorithm (Comm. ACM 5, 1962, 435): no `|b|²`.
pub fn quotient<T: Real>(a: Complex<T>, b: Complex<T>) -> Complex<T> {
    if b.re.abs() >= b.im.abs() {
        let r = b.im / b.re;
        let d = b.re + b.im * r;
        Complex::new((a.re + a.im * r) / d, (a.im - a.re * r) / d)
    } else {
        let r = b.re / b.im;
        let d = b.re * r + b.im;
        Complex::new((a.re * r + a.im) / d, (a.im * r - a.re) / d)
    }
}

/// `Σ_k c_k z^k` by Horner's rule; coefficients from the highest.
pub fn horner<T: Real>(z: Complex<T>, from_the_highest: &[f64]) -> Complex<T> {
    let zero = Complex::new(T::zero(), T::zero());
    from_the_highest
        .iter()
        .fold(zero, |sum, &c| sum * z + T::of(c))
}

/// `i z`.
pub fn times_i<T: Real>(z: Complex<T>) -> Complex<T> {
    Complex::new(-z.im, z.re)
}

/// Continues an algorithm of the upper half-plane below the real axis by `w(z) = 2e^{−z²} − w(−z)`.
pub fn continued_below(z: Complex64, upper: impl Fn(Complex64) -> Complex64) -> Complex64 {
    if z.im >= 0.0 {
        return upper(z);
    }
    2.0 * gaussian(z) - upper(-z)
}

/// Continues an algorithm of `Re z ≥ 0` by `w(−z̄) = conj w(z)`.
pub fn mirrored(z: Complex64, right: impl Fn(Complex64) -> Complex64) -> Complex64 {
    if z.re >= 0.0 {
        return right(z);
    }
    right(-z.conj()).conj()
}

//! The scaled complementary error function.

use super::faddeeva;
use num_complex::Complex;

/// DOC
pub fn erfcx(z: Complex<f64>) -> Complex<f64> {
    faddeeva(Complex::new(-z.im, z.re))
}

//! The Faddeeva function.
mod asymptotic;
mod double_double;
mod double_double_functions;
mod exponential;
mod payne_hanek;
mod plane;
mod special;
#[rustfmt::skip]
#[allow(clippy::all)]
mod tables;
mod taylor;
mod trapezoidal;
mod zeros;

use num_complex::Complex;

/// w
#[inline]
pub fn faddeeva(z: Complex<f64>) -> Complex<f64> {
    #[cfg(target_arch = "x86_64")]
    if let Some(v) = pulp::x86::V3::try_new() {
        let (re, im) = v.vectorize(
            #[inline(always)]
            || plane::w(z.re, z.im),
        );
        return Complex::new(re, im);
    }
    let (re, im) = plane::w(z.re, z.im);
    Complex::new(re, im)
}

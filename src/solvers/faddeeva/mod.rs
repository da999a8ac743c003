//! The Faddeeva function.
mod asymptotic;
#[cfg(target_arch = "x86_64")]
mod batch;
mod constants;
mod dawson;
mod derivative;
mod double_double;
mod double_double_functions;
mod erf;
mod erf_real;
mod erf_zeros;
mod erfcx;
mod exponential;
mod lanes;
mod lengths;
mod maclaurin;
mod odd_series;
#[cfg(target_arch = "x86_64")]
mod pack;
mod payne_hanek;
mod plane;
mod quadrant;
mod real;
mod special;
#[rustfmt::skip]
#[allow(clippy::all)]
mod tables;
mod taylor;
mod trapezoidal;
mod voigt;
mod zeros;

use num_complex::Complex;

pub use dawson::{dawson, dawson_batch, dawson_real};
pub use derivative::w_derivative;
pub use erf::{erf, erfc, erfi};
pub use erf_real::{erf_real, erfc_real, erfcx_real, erfi_real};
pub use erfcx::{erfcx, erfcx_batch};
pub use lengths::LengthMismatch;
pub use voigt::{voigt, voigt_batch};

use lanes::{Lanes, Task, with_best};

struct One(f64, f64);

impl Task for One {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        plane::w(lanes, self.0, self.1)
    }
}

/// Values at points stored as complex numbers.
struct Interleaved<'a> {
    z: &'a [Complex<f64>],
    w: &'a mut [Complex<f64>],
}

#[cfg(target_arch = "x86_64")]
impl batch::Points for Interleaved<'_> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.z.len()
    }
    #[inline(always)]
    fn load(&self, start: usize, x: &mut [f64], y: &mut [f64]) {
        let n = x.len();
        for ((z, x), y) in self.z[start..start + n].iter().zip(x).zip(y) {
            *x = z.re;
            *y = z.im;
        }
    }
    #[inline(always)]
    fn put(&mut self, i: usize, re: f64, im: f64) {
        self.w[i] = Complex::new(re, im);
    }
}

/// w
#[inline]
pub fn faddeeva(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(One(z.re, z.im));
    Complex::new(re, im)
}

/// batch
pub fn faddeeva_batch(z: &[Complex<f64>], w: &mut [Complex<f64>]) {
    assert_eq!(z.len(), w.len());
    #[cfg(target_arch = "x86_64")]
    if pack::batch_with_best(&mut Interleaved { z, w }) {
        return;
    }
    for (w, z) in w.iter_mut().zip(z) {
        *w = faddeeva(*z);
    }
}

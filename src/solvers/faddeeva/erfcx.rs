//! The scaled complementary error function, `erfcx z = e^{z²} erfc z = W(iz)` (DLMF 7.2.3).

use super::lanes::{Lanes, Task, with_best};
use super::lengths::{LengthMismatch, same_length};
use super::{Points, all, plane, real};
use num_complex::Complex;

/// Below this |Im z| the products in W keep no digits, and Im erfcx is linear in it.
const TINY: f64 = f64::from_bits((1023 - 900) << 52);
const LIFT: f64 = f64::from_bits((1023 + 300) << 52);

struct Erfcx(f64, f64);

impl Task for Erfcx {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (x, y) = (self.0, self.1);
        if y.abs() < TINY && x < 0.0 {
            return lanes.call(Tiny(x, y));
        }
        plane::w(lanes, -y, x)
    }
}

struct Tiny(f64, f64);

impl Task for Tiny {
    type Output = (f64, f64);
    #[inline(always)]
    fn run<L: Lanes>(self, lanes: L) -> (f64, f64) {
        let (re, im) = plane::w(lanes, -(self.1 * LIFT), self.0);
        (re, real::scaled(im, real::ROUND - 300.0))
    }
}

/// DOC
pub fn erfcx(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = with_best(Erfcx(z.re, z.im));
    Complex::new(re, im)
}

/// `W(iz)` at points stored as complex numbers.
struct Turned<'a> {
    z: &'a [Complex<f64>],
    f: &'a mut [Complex<f64>],
}

impl Points for Turned<'_> {
    #[inline(always)]
    fn len(&self) -> usize {
        self.z.len()
    }
    #[inline(always)]
    fn load(&self, start: usize, x: &mut [f64], y: &mut [f64]) {
        let n = x.len();
        for ((z, x), y) in self.z[start..start + n].iter().zip(x).zip(y) {
            *x = -z.im;
            *y = z.re;
        }
    }
    #[inline(always)]
    fn put(&mut self, i: usize, re: f64, im: f64) {
        self.f[i] = Complex::new(re, im);
    }
}

/// DOC
pub fn erfcx_batch(z: &[Complex<f64>], f: &mut [Complex<f64>]) -> Result<(), LengthMismatch> {
    same_length(z.len(), f.len())?;
    all(&mut Turned { z, f });
    for (f, z) in f.iter_mut().zip(z) {
        if z.im.abs() < TINY && z.re < 0.0 {
            *f = erfcx(*z);
        }
    }
    Ok(())
}

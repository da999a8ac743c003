//! W(z) at many points, by vectors where they pay.

#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
use super::batch;
use super::plane;
use super::points::Points;
use num_complex::Complex;

/// Batches shorter than this are not worth sorting.
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
const SHORT: usize = 64;

/// W at all points.
pub(super) fn all<P: Points>(points: &mut P) {
    #[cfg(all(target_arch = "x86_64", feature = "vectors"))]
    if points.len() >= SHORT && batch::with_best_vectors(points) {
        return;
    }
    for i in 0..points.len() {
        let mut z = [Complex::ZERO];
        points.load(i, &mut z);
        points.store(i, &z.map(one));
    }
}

/// W at one point.
#[inline]
pub(super) fn one(z: Complex<f64>) -> Complex<f64> {
    let (re, im) = plane::w_with_best(z.re, z.im);
    Complex::new(re, im)
}

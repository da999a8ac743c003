//! Where batches take points from and bring values to.

use num_complex::Complex;

/// Where points come from and values go to.
pub(super) trait Points {
    /// Their number.
    fn len(&self) -> usize;
    /// The points from `start` on.
    fn load(&self, start: usize, z: &mut [Complex<f64>]);
    /// Takes the values at the points from `start` on.
    fn store(&mut self, start: usize, w: &[Complex<f64>]);
    /// N points from `start` on and the room for their values, if they need not be moved.
    #[cfg_attr(
        not(all(target_arch = "x86_64", feature = "vectors")),
        allow(dead_code)
    )]
    fn chunk<const N: usize>(&mut self, _: usize) -> Option<Room<'_, N>> {
        None
    }
}

/// Points, and the room for their values.
#[cfg_attr(
    not(all(target_arch = "x86_64", feature = "vectors")),
    allow(dead_code)
)]
pub(super) type Room<'a, const N: usize> = (&'a [Complex<f64>; N], &'a mut [Complex<f64>; N]);

/// Points and values stored as complex numbers.
pub(super) struct Interleaved<'a> {
    pub z: &'a [Complex<f64>],
    pub w: &'a mut [Complex<f64>],
}

impl Points for Interleaved<'_> {
    fn len(&self) -> usize {
        self.z.len()
    }
    fn load(&self, start: usize, z: &mut [Complex<f64>]) {
        z.copy_from_slice(&self.z[start..start + z.len()]);
    }
    fn store(&mut self, start: usize, w: &[Complex<f64>]) {
        self.w[start..start + w.len()].copy_from_slice(w);
    }
    fn chunk<const N: usize>(&mut self, start: usize) -> Option<Room<'_, N>> {
        Some((
            self.z[start..].first_chunk()?,
            self.w[start..].first_chunk_mut()?,
        ))
    }
}

/// Points and values with real and imaginary parts apart.
pub(super) struct Apart<'a> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    pub re: &'a mut [f64],
    pub im: &'a mut [f64],
}

impl Points for Apart<'_> {
    fn len(&self) -> usize {
        self.x.len()
    }
    fn load(&self, start: usize, z: &mut [Complex<f64>]) {
        let parts = self.x[start..].iter().zip(&self.y[start..]);
        for (z, (x, y)) in z.iter_mut().zip(parts) {
            *z = Complex::new(*x, *y);
        }
    }
    fn store(&mut self, start: usize, w: &[Complex<f64>]) {
        let parts = self.re[start..].iter_mut().zip(&mut self.im[start..]);
        for (w, (re, im)) in w.iter().zip(parts) {
            (*re, *im) = (w.re, w.im);
        }
    }
}

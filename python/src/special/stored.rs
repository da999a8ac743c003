//! Numbers as arrays hold them, and as they are computed with.

use num_complex::Complex;

/// A number in an array; single precision is computed in double and rounded once.
pub trait Stored: Copy + 'static {
    /// The type that it is computed in.
    type Wide: Copy + Default + 'static;
    fn widen(self) -> Self::Wide;
    fn round(wide: Self::Wide) -> Self;
    /// Pointers to numbers that are stored as they are computed with.
    fn as_wide(pointer: *mut Self) -> Option<*mut Self::Wide>;
}

impl Stored for f64 {
    type Wide = f64;
    fn widen(self) -> f64 {
        self
    }
    fn round(wide: f64) -> f64 {
        wide
    }
    fn as_wide(pointer: *mut f64) -> Option<*mut f64> {
        Some(pointer)
    }
}

impl Stored for Complex<f64> {
    type Wide = Complex<f64>;
    fn widen(self) -> Complex<f64> {
        self
    }
    fn round(wide: Complex<f64>) -> Complex<f64> {
        wide
    }
    fn as_wide(pointer: *mut Complex<f64>) -> Option<*mut Complex<f64>> {
        Some(pointer)
    }
}

impl Stored for f32 {
    type Wide = f64;
    fn widen(self) -> f64 {
        self.into()
    }
    fn round(wide: f64) -> f32 {
        wide as f32
    }
    fn as_wide(_: *mut f32) -> Option<*mut f64> {
        None
    }
}

impl Stored for Complex<f32> {
    type Wide = Complex<f64>;
    fn widen(self) -> Complex<f64> {
        Complex::new(self.re.into(), self.im.into())
    }
    fn round(wide: Complex<f64>) -> Complex<f32> {
        Complex::new(wide.re as f32, wide.im as f32)
    }
    fn as_wide(_: *mut Complex<f32>) -> Option<*mut Complex<f64>> {
        None
    }
}

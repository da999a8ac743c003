//! Double and single precision, for algorithms that are audited in both.

use num_traits::Float;

/// `f64` or `f32`, with exponentials that come out the same on every machine.
pub trait Real: Float {
    /// The nearest number.
    fn of(x: f64) -> Self;
    /// `e^x`.
    fn exponential(self) -> Self;
    /// Sine and cosine.
    fn sine_cosine(self) -> (Self, Self);
}

impl Real for f64 {
    fn of(x: f64) -> f64 {
        x
    }
    fn exponential(self) -> f64 {
        libm::exp(self)
    }
    fn sine_cosine(self) -> (f64, f64) {
        libm::sincos(self)
    }
}

impl Real for f32 {
    fn of(x: f64) -> f32 {
        x as f32
    }
    fn exponential(self) -> f32 {
        libm::expf(self)
    }
    fn sine_cosine(self) -> (f32, f32) {
        libm::sincosf(self)
    }
}

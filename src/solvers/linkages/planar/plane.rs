//! Vectors of the plane as complex numbers, and angles.

use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Returns the scalar product.
pub(super) fn dot(a: Complex64, b: Complex64) -> f64 {
    a.re * b.re + a.im * b.im
}

/// Returns the vector product.
pub(super) fn cross(a: Complex64, b: Complex64) -> f64 {
    a.re * b.im - a.im * b.re
}

/// Returns `i a`: the vector after a quarter turn.
pub(super) fn quarter(a: Complex64) -> Complex64 {
    Complex64::new(-a.im, a.re)
}

/// Returns the angle in (−π, π] that differs by whole turns.
pub(super) fn wrapped(angle: f64) -> f64 {
    let a = angle - TAU * (angle / TAU).round();
    if a <= -PI { a + TAU } else { a }
}

//! Laplace's continued fraction, `w(z) = (i/√π)/(z − (1/2)/(z − (2/2)/(z − (3/2)/(z − …))))` (DLMF 7.9.3).

use crate::elementary::{FRAC_1_SQRT_PI, quotient, times_i};
use num_complex::{Complex, Complex64};

/// Its convergent with the partial numerators `1/2` to `terms/2`.
pub fn convergent(z: Complex64, terms: usize) -> Complex64 {
    let mut tail = Complex::new(0.0, 0.0);
    for k in (1..=terms).rev() {
        tail = quotient(Complex::new(k as f64 / 2.0, 0.0), z - tail);
    }
    times_i(quotient(Complex::new(FRAC_1_SQRT_PI, 0.0), z - tail))
}

//! Laplace's continued fraction, `w(z) = (i/√π)/(z − (1/2)/(z − (2/2)/(z − (3/2)/(z − …))))` (DLMF
//! 7.9.3).

use crate::elementary::{FRAC_1_SQRT_PI, FRAC_2_SQRT_PI, quotient, times_i};
use num_complex::{Complex, Complex64};

/// Its convergent with the partial numerators `1/2` to `terms/2`.
pub fn convergent(z: Complex64, terms: usize) -> Complex64 {
    let mut tail = Complex::new(0.0, 0.0);
    for k in (1..=terms).rev() {
        tail = quotient(Complex::new(k as f64 / 2.0, 0.0), z - tail);
    }
    times_i(quotient(Complex::new(FRAC_1_SQRT_PI, 0.0), z - tail))
}

/// In the first quadrant a convergent of so many levels, or Gautschi's truncated Taylor expansion
/// about `z + ih`, whose derivatives the continued fraction gives: h and the number of its terms.
pub fn expansion(z: Complex64, levels: i32, about: Option<(f64, i32)>) -> Complex64 {
    let (h, terms) = about.unwrap_or_default();
    let mut power = (2.0 * h).powi(terms);
    let (mut r, mut s) = (Complex::new(0.0, 0.0), Complex::new(0.0, 0.0));
    for n in (0..=levels).rev() {
        let m = f64::from(n + 1);
        let t = Complex::new(z.im + h + m * r.re, z.re - m * r.im);
        let c = 0.5 / (t.re * t.re + t.im * t.im);
        r = Complex::new(c * t.re, c * t.im);
        if about.is_some() && n <= terms {
            s = r * (s + power);
            power /= 2.0 * h;
        }
    }
    FRAC_2_SQRT_PI * if about.is_some() { s } else { r }
}

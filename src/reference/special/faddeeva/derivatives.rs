//! Derivatives and Taylor coefficients of w; [`super::recurrence`] has the formulas.

use super::argument::{Real, length};
use super::choice::once;
use super::recurrence::{self, coefficients};
use super::scaled::{Scaled, aligned};
use super::ziv::{balls, decide};
use crate::{Ball, ComplexBall, Undecided};
use rug::{Integer, Rational};

/// The Taylor coefficients `w^{(k)}(z)/k!`, k = 0 … n, each with a radius of at most 2^-bits times
/// its modulus (per coefficient, not per component; components that are zero by symmetry are
/// exactly zero).
///
/// On the real axis the imaginary parts are `(2/√π) F^{(k)}(x)/k!` with Dawson's function F; on the
/// imaginary axis `i^k c_k` are the real Taylor coefficients of erfcx at Im z.
///
/// # Errors
/// See the [module](super).
pub fn taylor(
    re: &Rational,
    im: &Rational,
    n: usize,
    bits: u32,
) -> Result<Vec<ComplexBall>, Undecided> {
    recurrence::taylor(once, re, im, n, bits)
}

/// The n-th derivative of w, each component with a relative radius of at most 2^-bits or exactly
/// zero.
///
/// # Errors
/// See the [module](super).
pub fn w_derivative(
    n: usize,
    re: &Rational,
    im: &Rational,
    bits: u32,
) -> Result<ComplexBall, Undecided> {
    if n == 1 {
        return balls(w_derivative_scaled(re, im, bits)?, bits);
    }
    let (x, y) = (Real::of(re), Real::of(im));
    let length = length(&x, &y);
    let factorial = Integer::from(Integer::factorial(u32::try_from(n).unwrap_or(u32::MAX)));
    let parts = decide("the derivative of w", bits, length, |prec| {
        let c = coefficients(once, &x, &y, n, prec)?.pop()?;
        let f = Ball::rational(prec, &Rational::from(&factorial));
        let part = |b: &Ball| Scaled::from(b * &f);
        Some([part(&c.re), part(&c.im)])
    })?;
    balls(parts, bits)
}

/// `a + b`
fn sum(a: &Scaled, b: &Scaled) -> Scaled {
    let (a, b, k) = aligned(a, b);
    Scaled::new(a + &b, k)
}

/// The first derivative, `w' = −2z w + 2i/√π`, with exponents of any size.
///
/// # Errors
/// As [`w_derivative`], but not for the size of the result.
pub fn w_derivative_scaled(
    re: &Rational,
    im: &Rational,
    bits: u32,
) -> Result<[Scaled; 2], Undecided> {
    let (x, y) = (Real::of(re), Real::of(im));
    let length = length(&x, &y);
    decide("the derivative of w", bits, length, |prec| {
        let [u, v] = once(x.clone(), y.clone(), prec)?;
        let (p, q) = (x.ball(prec).shift(1), y.ball(prec).shift(1));
        let times = |w: &Scaled, t: &Ball| Scaled::new(&w.ball * t, w.exponent.clone());
        let slope = Ball::integer(prec, 2) / &Ball::pi(prec).sqrt();
        let turned = sum(&times(&v, &p), &times(&u, &q));
        Some([
            sum(&times(&v, &q), &-times(&u, &p)),
            sum(&Scaled::from(slope), &-turned),
        ])
    })
}

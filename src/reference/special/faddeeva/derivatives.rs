//! Derivatives and Taylor coefficients of w.
//!
//! `w' = −2z w + 2i/√π`, `w^{(n+2)} = −2z w^{(n+1)} − 2(n+1) w^{(n)}` (DLMF 7.10.3), so that the
//! coefficients `c_n = w^{(n)}(z)/n!` obey
//!
//! ```text
//! c_1 = −2z c_0 + 2i/√π      c_{n+2} = −(2/(n+2)) (z c_{n+1} + c_n)
//! ```
//!
//! In the upper half-plane c_n is the minimal solution (repeated integrals of erfc) and the
//! recurrence loses digits; it is run in balls, which know how many, at a rising precision.

use super::argument::{Real, length};
use super::choice::once;
use super::scaled::{Scaled, aligned};
use super::ziv::{balls, cap, decide, first};
use crate::{Ball, ComplexBall, Undecided};
use rug::{Integer, Rational};

/// Bits that the recurrence may lose at each order until a coefficient is undecided.
const LOST: u32 = 64;

/// Orders that count for the precision; the coefficients of more do not fit into memory.
const MOST: usize = 1 << 20;

/// `c_0 … c_n` in ball arithmetic of `prec` bits.
fn coefficients(x: &Real, y: &Real, n: usize, prec: u32) -> Option<Vec<ComplexBall>> {
    let [re, im] = once(x.clone(), y.clone(), prec)?.map(|part| part.to_ball_or_tiny());
    let z = ComplexBall::new(x.ball(prec), y.ball(prec));
    let mut c = vec![ComplexBall::new(re, im)];
    let two = Ball::integer(prec, 2);
    let slope = &two / &Ball::pi(prec).sqrt();
    let product = (&z * &c[0]).scaled(&-two);
    c.push(ComplexBall::new(product.re, product.im + &slope));
    for k in 2..=n {
        let factor = Ball::rational(prec, &Rational::from((-2, k as i64)));
        let next = (&(&z * &c[k - 1]) + &c[k - 2]).scaled(&factor);
        c.push(next);
    }
    c.truncate(n + 1);
    Some(c)
}

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
    let (x, y) = (Real::of(re), Real::of(im));
    let order = n.min(MOST) as u32;
    let cap = cap(bits, length(&x, &y).saturating_add(LOST * order));
    let good = |c: &ComplexBall| {
        let r = c.radius();
        r.is_zero() || r <= c.mignitude().shift(-i64::from(bits))
    };
    let open = "a Taylor coefficient of w cannot be told from zero";
    first(bits + 32 + 2 * order, 2, cap, open, |prec| {
        coefficients(&x, &y, n, prec).filter(|c| c.iter().all(good))
    })
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
        let c = coefficients(&x, &y, n, prec)?.pop()?;
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

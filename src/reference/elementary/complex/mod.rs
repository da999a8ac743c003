//! Holomorphic functions of complex balls.
//!
//! # Branches
//! Principal ones, and a zero component counts as positive, as in C99: on a cut of the real axis a
//! function has its limit from above, on one of the imaginary axis its limit from the right. A box
//! with points on both sides of a cut is undecided.
//!
//! # Radii
//! A component that is a product of a function of x and one of y comes from real balls. Otherwise,
//! with m the midpoint and ρ the greatest distance of a point of the box from it,
//! `|f(z) − f(m)| ≤ ρ sup |f'|` enlarges both components (the box is convex). An overflow is one of
//! the modulus, and has no sign.

mod airy;
mod bessel;
mod error;
mod exponential;
mod exponential_integral;
mod gamma;
mod hypergeometric;
mod inverse;
pub(super) mod lambert;
mod rectangle;
mod trigonometric;
mod weierstrass;
mod zeta;

use super::support::{BITS, WIDE, ends, unsigned};
use super::{ComplexEvaluated, NoValue};
use crate::{Ball, ComplexBall, Mag};
use rug::Float;
use rug::float::Round;
use std::sync::{Arc, Mutex};

pub use airy::{airyai, airyaiprime, airybi, airybiprime};
pub use bessel::{Bessel, bessel, besseli, besselie, besselj};
pub use error::{dawson, erf, erfc, erfcx, erfi, w};
pub use exponential::{cbrt, div, exp, expm1, log, log1p, pow, recip, sqrt};
pub use exponential_integral::{ci, e1, ei, si};
pub(super) use gamma::coefficients as stirling_coefficients;
pub use gamma::{inverse_gamma, lgamma, tgamma};
pub use inverse::{acos, acosh, asin, asinh, atan, atanh};
pub use lambert::lambertw;
pub use rectangle::Rectangle;
pub use trigonometric::{cos, cosh, sech, sin, sinh, tan, tanh};
pub use weierstrass::{weierstrassp, weierstrasspprime};
pub use zeta::{zeta, zetaderivative};

/// Constants at the precisions that are in use, which are multiples of 64 bits.
struct Kept<T>(Mutex<Vec<(u32, Arc<T>)>>);

impl<T> Kept<T> {
    const fn new() -> Kept<T> {
        Kept(Mutex::new(Vec::new()))
    }

    /// Those at a precision or the next one above, made if they are not there or not enough.
    fn get(
        &self,
        p: u32,
        is_enough: impl Fn(&T) -> bool,
        make: impl FnOnce(u32) -> Result<T, NoValue>,
    ) -> Result<Arc<T>, NoValue> {
        /// Precisions that are kept.
        const MOST: usize = 8;
        let p = p.next_multiple_of(64);
        let mut known = self.0.lock().unwrap_or_else(|broken| broken.into_inner());
        if let Some((_, found)) = known.iter().find(|k| k.0 == p && is_enough(&k.1)) {
            return Ok(Arc::clone(found));
        }
        let found = Arc::new(make(p)?);
        known.retain(|k| k.0 != p);
        if known.len() >= MOST {
            known.remove(0);
        }
        known.push((p, Arc::clone(&found)));
        Ok(found)
    }
}

/// Reports the overflow of a function that grows like `e^a`, up to factors and divisors below
/// 2^5000, from a lower bound on a: `e^{7.6e8} > 2^{1.096e9}`.
fn overflow(a: f64) -> Result<(), NoValue> {
    match a >= 7.6e8 {
        true => Err(NoValue::Overflow { negative: false }),
        false => Ok(()),
    }
}

/// Bits beyond those of the result.
const GUARD: u32 = 16;

/// An overflow of a step that need not be one of the result.
fn inner<T>(found: Result<T, NoValue>) -> Result<T, NoValue> {
    found.map_err(|why| match why {
        NoValue::Overflow { .. } => NoValue::Undecided("a number beyond 2^(2^30 - 2)"),
        why => why,
    })
}

/// The same ball without its radius; a zero is positive.
fn middle(z: &ComplexBall) -> ComplexBall {
    let of = |x: &Ball| Ball::new(unsigned(x.mid().clone()), Mag::ZERO);
    ComplexBall::new(of(&z.re), of(&z.im))
}

/// The result with the radius of both components enlarged, at a precision.
fn widened(z: &ComplexBall, extra: Mag, prec: u32) -> ComplexEvaluated {
    let of = |x: &Ball| super::error::widened(super::support::with_prec(x, prec)?, extra);
    Ok(ComplexBall::new(of(&z.re)?, of(&z.im)?))
}

/// Both components rounded.
fn rounded(z: &ComplexBall, prec: u32) -> ComplexEvaluated {
    widened(z, Mag::ZERO, prec)
}

/// A lower bound on the modulus.
fn below(z: &ComplexBall) -> Mag {
    let (a, b) = (z.re.mignitude(), z.im.mignitude());
    super::trigonometric::root_below(a.mul_below(a).add_below(b.mul_below(b)))
}

/// `z + n` with the midpoint rounded to `prec` bits.
fn plus(z: &ComplexBall, n: i32, prec: u32) -> ComplexEvaluated {
    let re = super::add(&z.re, &super::support::exact(BITS, n), prec)?;
    Ok(ComplexBall::new(re, z.im.clone()))
}

/// `i z`.
fn turned(z: &ComplexBall) -> ComplexBall {
    z.turned()
}

/// `−i z`.
fn turned_back(z: &ComplexBall) -> ComplexBall {
    ComplexBall::new(z.im.clone(), -&z.re)
}

/// Returns true if a box has points above the real axis, or on it, and points below.
fn is_across(z: &ComplexBall) -> bool {
    if z.im.is_zero() {
        return false;
    }
    let [low, high] = ends(&z.im, BITS);
    low < 0 && high >= 0
}

/// Refuses a box that is unbounded, and one of which a component is too large to be reduced.
fn bounded(z: &ComplexBall) -> Result<(), NoValue> {
    let is_large = |x: &Ball| x.mid().get_exp().is_some_and(|e| e > REACH);
    if !z.is_finite() {
        return Err(WIDE);
    }
    if is_large(&z.re) || is_large(&z.im) {
        return Err(NoValue::Undecided("the argument is too large"));
    }
    Ok(())
}

/// Components beyond 2 to this power are left undecided, and those below its inverse are taken for
/// zero with a radius.
const REACH: i32 = 1 << 12;

/// The midpoint with components that are not very small, and the greatest distance from it.
fn clipped(z: &ComplexBall) -> (ComplexBall, Mag) {
    let of = |x: &Ball| match x.mid().get_exp() {
        Some(e) if e < -REACH => (Ball::new(Float::new(x.prec()), Mag::ZERO), x.magnitude()),
        _ => (Ball::new(unsigned(x.mid().clone()), Mag::ZERO), x.rad()),
    };
    let ((re, r), (im, s)) = (of(&z.re), of(&z.im));
    let rho = if s.is_zero() {
        r
    } else if r.is_zero() {
        s
    } else {
        r.mul(r).add(s.mul(s)).sqrt()
    };
    (ComplexBall::new(re, im), rho)
}

/// The reason of a whole box, of which one point was tried: an overflow there says nothing of the
/// other points.
fn of_box(why: NoValue, rho: Mag) -> NoValue {
    match why {
        NoValue::Overflow { .. } if rho > Mag::ZERO => WIDE,
        why => why,
    }
}

/// A float rounded down, as a double.
fn f64_down(x: &Float) -> f64 {
    x.to_f64_round(Round::Down)
}

#[cfg(test)]
mod tests;

//! Real functions that are those of complex balls on the real line.

use super::complex::{self, Bessel};
use super::support::{BITS, ends, exact};
use super::{ComplexEvaluated, Evaluated, NoValue};
use crate::{Ball, ComplexBall};
use rug::Rational;

fn point(x: &Ball) -> ComplexBall {
    ComplexBall::new(x.clone(), exact(64, 0))
}

/// The real part, and the sign of what overflows.
fn real(found: ComplexEvaluated, negative: bool) -> Evaluated {
    match found {
        Ok(z) => Ok(z.re),
        Err(NoValue::Overflow { .. }) => Err(NoValue::Overflow { negative }),
        Err(why) => Err(why),
    }
}

/// Refuses what is not positive.
fn positive(x: &Ball, why: &'static str) -> Result<(), NoValue> {
    if x.is_negative() || x.is_zero() {
        return Err(NoValue::Undefined(why));
    }
    match x.is_positive() {
        true => Ok(()),
        false => Err(NoValue::Undecided(why)),
    }
}

macro_rules! on_the_line {
    ($($(#[doc = $doc:literal])* $name:ident;)*) => {
        $($(#[doc = $doc])*
        pub fn $name(x: &Ball, prec: u32) -> Evaluated {
            real(complex::$name(&point(x), prec), false)
        })*
    };
}

on_the_line! {
    /// The Airy function Ai.
    airyai;
    /// Its derivative.
    airyaiprime;
    /// The Airy function Bi.
    airybi;
    /// Its derivative.
    airybiprime;
    /// The sine integral `∫_0^x sin t/t dt`.
    si;
    /// The exponential integral Ei, a principal value.
    ei;
    /// Riemann's zeta function.
    zeta;
}

/// The exponential integral `E₁(x) = ∫_x^∞ e^{−t}/t dt` of a positive number.
pub fn e1(x: &Ball, prec: u32) -> Evaluated {
    positive(
        x,
        "the exponential integral E1 of a number that is not positive",
    )?;
    real(complex::e1(&point(x), prec), false)
}

/// The cosine integral of a positive number.
pub fn ci(x: &Ball, prec: u32) -> Evaluated {
    positive(x, "the cosine integral of a number that is not positive")?;
    real(complex::ci(&point(x), prec), false)
}

/// Lambert's function W₀(x), at least −1.
pub fn lambertw(x: &Ball, prec: u32) -> Evaluated {
    complex::lambert::real_branch(x, false, prec)
}

/// Lambert's function W₋₁(x), at most −1, of a negative number.
pub fn lambertwm1(x: &Ball, prec: u32) -> Evaluated {
    complex::lambert::real_branch(x, true, prec)
}

/// Refuses a negative number where the order is broken.
fn of_order(order: &Ball, x: &Ball) -> Result<(), NoValue> {
    match order.rad().is_zero() && order.mid().is_integer() {
        true => Ok(()),
        false => not_negative(x),
    }
}

fn not_negative(x: &Ball) -> Result<(), NoValue> {
    const WHY: &str = "a Bessel function of a broken order at a negative number";
    match x.is_zero() || ends(x, BITS)[0] >= 0 {
        true => Ok(()),
        false if x.is_negative() => Err(NoValue::Undefined(WHY)),
        false => Err(NoValue::Undecided(WHY)),
    }
}

fn is_odd(order: &Ball) -> bool {
    order.mid().to_integer().is_some_and(|n| n.is_odd())
}

/// The Bessel function `J_ν(x)`: ν an integer, or a positive binary number.
pub fn besselj(order: &Ball, x: &Ball, prec: u32) -> Evaluated {
    of_order(order, x)?;
    real(complex::besselj(order, &point(x), prec), false)
}

/// The modified Bessel function `I_ν(x)`, as [`besselj`].
pub fn besseli(order: &Ball, x: &Ball, prec: u32) -> Evaluated {
    of_order(order, x)?;
    let negative = x.is_negative() && is_odd(order);
    real(complex::besseli(order, &point(x), prec), negative)
}

/// `e^{−x} I_ν(x)`, as [`besselj`].
pub fn besselie(order: &Ball, x: &Ball, prec: u32) -> Evaluated {
    of_order(order, x)?;
    let negative = x.is_negative() && is_odd(order);
    real(complex::besselie(order, &point(x), prec), negative)
}

/// A Bessel function of a positive order that is no integer.
pub fn bessel(which: Bessel, order: &Rational, x: &Ball, prec: u32) -> Evaluated {
    not_negative(x)?;
    real(complex::bessel(which, order, &point(x), prec), false)
}

/// The n-th derivative of the zeta function.
pub fn zetaderivative(n: &Ball, x: &Ball, prec: u32) -> Evaluated {
    real(complex::zetaderivative(n, &point(x), prec), false)
}

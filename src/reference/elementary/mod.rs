//! Functions of balls: the real functions of C99 with their domains, and holomorphic ones in
//! [`complex`].
//!
//! # Contract
//! If each operand's ball contains a number and the function has a value there, the result's ball
//! contains the exact value. A function that has a value at some points of the operands and none at
//! others is [`NoValue::Undecided`]; one that has a value at none of them is
//! [`NoValue::Undefined`]. `prec` is the precision of the midpoint of the result. No ball makes a
//! function panic or run without bound.
//!
//! # Radii
//! For a narrow ball of midpoint m and radius r the radius is that of the rounding and a bound on
//! `|f(x) − f(m)|` by the mean value theorem, which stands beside each function. For a wide one a
//! monotone function is evaluated at both ends, in doubles where their errors are known (`coarse`),
//! else with directed rounding.
//!
//! # Conventions
//! Those of C99 where it gives a real number: `pow(x, 0) = 1`, `pow(0, y) = 0` for y > 0, a negative
//! number to the power of an exact integer, `atan2(0, 0) = 0`, `atan2(0, x) = π` for x < 0. A zero
//! has no sign. There are no infinities: a pole is undefined, and a value beyond the exponents of
//! MPFR is [`NoValue::Overflow`]. A value that is too small for them is a ball around zero.

mod arithmetic;
mod coarse;
pub mod complex;
mod error;
mod exponential;
mod gamma;
mod hyperbolic;
mod special;
mod steps;
mod support;
mod trigonometric;
mod voigt;
pub mod words;

use crate::{Ball, ComplexBall};

pub use arithmetic::{
    add, cbrt, div, fabs, fdim, fma, fmax, fmin, hypot, mul, powi, recip, sqr, sqrt, sub,
};
pub use error::{dawson, erf, erfc, erfcx, erfi};
pub use exponential::{exp, exp2, exp10, expm1, log, log1p, log2, log10, pow};
pub use gamma::{digamma, lgamma, tgamma};
pub use hyperbolic::{acosh, asinh, atanh, cosh, sinh, tanh};
pub use special::{
    airyai, airyaiprime, airybi, airybiprime, bessel, besseli, besselie, besselj, ci, e1, ei,
    lambertw, lambertwm1, si, zeta, zetaderivative,
};
pub use steps::{ceil, copysign, floor, fmod, nearbyint, remainder, round, trunc};
pub use trigonometric::{acos, asin, atan, atan2, cos, cospi, sin, sinpi, tan, tanpi};
pub use voigt::voigt;

/// Reason why a function of balls gives no ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoValue {
    /// The function has no real value at any point of the operands: the logarithm of a negative
    /// number, a pole hit exactly, 0/0.
    #[error("undefined: {0}")]
    Undefined(&'static str),
    /// The operands are too wide to decide; more precision may help.
    #[error("undecided: {0}")]
    Undecided(&'static str),
    /// The value is certainly beyond `2^(2^30 − 2)` in magnitude, with this sign, at every point of
    /// the operands.
    #[error("a {} number beyond 2^(2^30 - 2)", if *.negative { "negative" } else { "positive" })]
    Overflow {
        /// True if the value is negative.
        negative: bool,
    },
}

/// The ball of a real function, or the reason why there is none.
pub type Evaluated = Result<Ball, NoValue>;

/// The ball of a complex function, or the reason why there is none.
pub type ComplexEvaluated = Result<ComplexBall, NoValue>;

#[cfg(test)]
mod radius_tests;
#[cfg(test)]
mod tests;

//! Maclaurin series of erf and of Dawson's function.

use crate::bounds::{above, power_up, rational};
use crate::interval::{product_up, quotient_up, sum_up, up};
use mechaudit_reference::Ball;
use rug::Rational;

/// The coefficients of a series `x (1 + c₁x² + c₂x⁴ + …)` from the one before.
pub(crate) type Next = fn(n: u32, before: Rational) -> Rational;

/// Returns what a stored series differs from the function by, as a part of it, for `x² ≤ ¼`; `low`
/// is what the second coefficient lacks.
///
/// `Σ |c̃_n − c_n| 4^{−n}`, and of what is left out, whose terms alternate and fall, the first one;
/// the function is at least 0.8 x. After each `c_n` it takes `c_n` from the one before by `next`.
pub(crate) fn odd_series_error(stored: &[f64], low: f64, next: Next) -> f64 {
    let mut sum = 0.0;
    let mut exact = Rational::from(1);
    for (n, c) in stored.iter().enumerate() {
        let lacks = if n == 1 { low } else { 0.0 };
        let off = (rational(*c) + rational(lacks) - &exact).abs();
        let off = up(off.to_f64().next_up());
        sum = sum_up(sum, product_up(off, power_up(0.25, n as u32)));
        exact = next(n as u32 + 1, exact);
    }
    let left = up(exact.abs().to_f64().next_up());
    sum = sum_up(sum, product_up(left, power_up(0.25, stored.len() as u32)));
    quotient_up(sum, 0.8)
}

/// Returns what the sum of two numbers differs from what it stands for by, as a part of it.
pub(crate) fn pair_error([hi, lo]: [f64; 2], exact: &Ball) -> f64 {
    const BITS: u32 = 300;
    let stored = Ball::rational(BITS, &(rational(hi) + rational(lo)));
    quotient_up(above(&(&stored - exact)), hi * 0.999)
}

#[cfg(test)]
mod tests;

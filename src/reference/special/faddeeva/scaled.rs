//! A ball times a power of two beyond MPFR's exponents.

use crate::arithmetic::decimal::exact;
use crate::{Ball, Mag};
use rug::float::Round;
use rug::{Float, Integer};
use std::ops::Neg;

/// Powers of two up to this one are applied to a ball directly.
pub(super) const REACH: i64 = 1 << 29;

/// Bits beyond those of the ball.
const GUARD: u32 = 16;

/// `ball · 2^exponent`, for values such as `e^{−x²}` at x = 10^300, whose exponent no floating
/// format holds.
#[derive(Clone, Debug)]
pub struct Scaled {
    /// The factor in front.
    pub ball: Ball,
    /// The exponent of two.
    pub exponent: Integer,
}

impl From<Ball> for Scaled {
    fn from(ball: Ball) -> Scaled {
        Scaled::new(ball, Integer::new())
    }
}

impl Scaled {
    /// The number with `digits` significant decimal digits, as [`Ball::to_decimal`] gives them,
    /// with a decimal exponent of any size; `None` when the radius does not allow that many.
    ///
    /// ```
    /// use mechaudit_reference::faddeeva;
    /// use rug::Rational;
    /// // Re w on the real axis is e^{−x²}.
    /// let [re, _] = faddeeva::w_scaled(&Rational::from(100_000), &Rational::new(), 100)?;
    /// assert_eq!(re.to_decimal(20).unwrap(), "9.2785844203248725781e-4342944820");
    /// # Ok::<(), mechaudit_reference::Undecided>(())
    /// ```
    pub fn to_decimal(&self, digits: usize) -> Option<String> {
        let direct = self.to_ball();
        if direct.is_finite() {
            return direct.to_decimal(digits);
        }
        // b 2^k = (b 2^k 10^-e) 10^e with e near k log10 2, the factor by logarithms.
        let size = self.exponent.significant_bits();
        let prec = self.ball.prec() + size + GUARD;
        let (ln2, ln10) = (Ball::integer(prec, 2).ln(), Ball::integer(prec, 10).ln());
        let k = Ball::new(exact(&self.exponent), Mag::ZERO);
        let e = (&(&k * &ln2) / &ln10).mid().to_integer()?;
        let f = Ball::new(exact(&e), Mag::ZERO);
        let rest = (&(&k * &ln2) - &(&f * &ln10)).exp();
        let value = &self.ball * &rest.with_prec(self.ball.prec() + GUARD);
        value.to_decimal(digits)?;
        let (minus, text, exponent) =
            value
                .mid()
                .to_sign_string_exp_round(10, Some(digits.max(1)), Round::Nearest);
        // 0.text · 10^exponent
        let exponent = e + exponent? - 1;
        let sign = if minus { "-" } else { "" };
        let (first, others) = text.split_at(1);
        let point = if others.is_empty() { "" } else { "." };
        Some(format!("{sign}{first}{point}{others}e{exponent}"))
    }

    pub(super) fn new(ball: Ball, exponent: Integer) -> Scaled {
        Scaled { ball, exponent }
    }

    /// The value as a ball; the whole line if the exponent is out of reach.
    pub fn to_ball(&self) -> Ball {
        if self.ball.is_zero() {
            return self.ball.clone();
        }
        match self.exponent.to_i64() {
            Some(k) if k.abs() < REACH => self.ball.shift(k as i32),
            _ => Ball::new(Float::new(self.ball.prec()), Mag::INFINITY),
        }
    }

    /// The value as a ball; one that is too small becomes `0 ± 2^-(2^29)`.
    pub(super) fn to_ball_or_tiny(&self) -> Ball {
        Scaled::shifted(&self.ball, &self.exponent)
    }

    /// `b 2^k`; too small a result becomes `0 ± 2^-(2^29)`, too large a one the whole line.
    pub(super) fn shifted(b: &Ball, k: &Integer) -> Ball {
        if b.is_zero() {
            return b.clone();
        }
        let zero = Float::new(b.prec());
        match k.to_i64() {
            Some(k) if k.abs() < REACH => b.shift(k as i32),
            _ if k.is_negative() && b.magnitude() <= Mag::from_f64(2.0) => {
                Ball::new(zero, Mag::power_of_two(1 - REACH))
            }
            _ => Ball::new(zero, Mag::INFINITY),
        }
    }
}

impl Neg for Scaled {
    type Output = Scaled;
    fn neg(self) -> Scaled {
        Scaled::new(-self.ball, self.exponent)
    }
}

/// Both numbers relative to the larger of their exponents, and that exponent. An exact zero has no
/// say in it.
pub(super) fn aligned(a: &Scaled, b: &Scaled) -> (Ball, Ball, Integer) {
    let top = match (a.ball.is_zero(), b.ball.is_zero()) {
        (true, _) => &b.exponent,
        (_, true) => &a.exponent,
        _ => (&a.exponent).max(&b.exponent),
    };
    let relative = |s: &Scaled| Scaled::shifted(&s.ball, &Integer::from(&s.exponent - top));
    (relative(a), relative(b), top.clone())
}

#[cfg(test)]
mod tests;

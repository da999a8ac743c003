//! A ball times a power of two beyond MPFR's exponents.

use crate::reference::{Ball, Mag};
use rug::{Float, Integer};
use std::ops::Neg;

/// Powers of two up to this one are applied to a ball directly.
const REACH: i64 = 1 << 29;

/// `ball · 2^exponent`, for values such as `e^{−x²}` at x = 10^300, whose exponent no floating
/// format holds.
#[derive(Clone, Debug)]
pub struct Scaled {
    /// The factor in front.
    pub ball: Ball,
    /// The exponent of two.
    pub exponent: Integer,
}

impl Scaled {
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
            _ if *k < 0 && b.magnitude() <= Mag::from_f64(2.0) => {
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

//! Coefficients of power series: multiple-precision and double numbers with one analysis of their
//! rounding.

use crate::{Ball, Mag, dot};
use rug::Float;
use rug::float::Round;

/// A coefficient of a power series. Every operation rounds to nearest: its result is off by at most
/// `u |result|` with `u = 2^−bits`, unless it underflows.
pub(super) trait Coefficient: Clone {
    /// A bound on what all underflows of the computation of one series lose.
    fn least() -> Mag;
    /// Zero.
    fn zero(bits: u32) -> Self;
    /// The midpoint of a ball and a bound on the distance of the ball's numbers from it.
    fn of(ball: &Ball, bits: u32) -> (Self, Mag);
    /// The exact number.
    fn to_ball(&self) -> Ball;
    /// An upper bound on the magnitude.
    fn above(&self) -> Mag;
    /// True if the number is zero.
    fn is_zero(&self) -> bool;
    /// `a + b`.
    fn plus(&self, other: &Self) -> Self;
    /// `a − b`.
    fn minus(&self, other: &Self) -> Self;
    /// `−a`.
    fn negative(&self) -> Self;
    /// `a / b`.
    fn over(&self, other: &Self) -> Self;
    /// `n a`.
    fn times(&self, n: i64) -> Self;
    /// `a / n`.
    fn divided(&self, n: i64) -> Self;
    /// `2 a`, exactly.
    fn doubled(&self) -> Self;
    /// `Σ a_i b_(k−i)` over `low ≤ i ≤ high`.
    fn convolution(a: &[Self], b: &[Self], k: usize, low: usize, high: usize, bits: u32) -> Self;
    /// `Σ w(i) a_i b_(k−i)` over `low ≤ i ≤ high`.
    fn weighted(
        a: &[Self],
        b: &[Self],
        k: usize,
        range: [usize; 2],
        weight: impl Fn(usize) -> i64,
        bits: u32,
    ) -> Self;
}

impl Coefficient for Float {
    fn least() -> Mag {
        // The exponents of MPFR have no end that a computation here reaches.
        Mag::ZERO
    }

    fn zero(bits: u32) -> Float {
        Float::new(bits)
    }

    fn of(ball: &Ball, bits: u32) -> (Float, Mag) {
        let rounded = ball.with_prec(bits);
        (rounded.mid().clone(), rounded.rad())
    }

    fn to_ball(&self) -> Ball {
        Ball::new(self.clone(), Mag::ZERO)
    }

    fn above(&self) -> Mag {
        Mag::above(self)
    }

    fn is_zero(&self) -> bool {
        Float::is_zero(self)
    }

    fn plus(&self, other: &Float) -> Float {
        Float::with_val(self.prec(), self + other)
    }

    fn minus(&self, other: &Float) -> Float {
        Float::with_val(self.prec(), self - other)
    }

    fn negative(&self) -> Float {
        Float::with_val(self.prec(), -self)
    }

    fn over(&self, other: &Float) -> Float {
        Float::with_val(self.prec(), self / other)
    }

    fn times(&self, n: i64) -> Float {
        Float::with_val(self.prec(), self * n)
    }

    fn divided(&self, n: i64) -> Float {
        Float::with_val(self.prec(), self / n)
    }

    fn doubled(&self) -> Float {
        self.clone() << 1u32
    }

    fn convolution(
        a: &[Float],
        b: &[Float],
        k: usize,
        low: usize,
        high: usize,
        bits: u32,
    ) -> Float {
        dot::convolution([a, b], k, [low, high], |_| 1, bits)
    }

    fn weighted(
        a: &[Float],
        b: &[Float],
        k: usize,
        [low, high]: [usize; 2],
        weight: impl Fn(usize) -> i64,
        bits: u32,
    ) -> Float {
        dot::convolution([a, b], k, [low, high], weight, bits)
    }
}

impl Coefficient for f64 {
    fn least() -> Mag {
        // One underflow loses at most 2^−1075, and a series meets fewer than 2^50 of them.
        Mag::power_of_two(-1020)
    }

    fn zero(_: u32) -> f64 {
        0.0
    }

    fn of(ball: &Ball, _: u32) -> (f64, Mag) {
        let x = ball.mid().to_f64_round(Round::Nearest);
        let off = match x.is_finite() {
            true => ball.distance_from(x).1,
            false => Mag::INFINITY,
        };
        (x, off)
    }

    fn to_ball(&self) -> Ball {
        Ball::exact(64, *self)
    }

    fn above(&self) -> Mag {
        Mag::from_f64(*self)
    }

    fn is_zero(&self) -> bool {
        *self == 0.0
    }

    fn plus(&self, other: &f64) -> f64 {
        self + other
    }

    fn minus(&self, other: &f64) -> f64 {
        self - other
    }

    fn negative(&self) -> f64 {
        -self
    }

    fn over(&self, other: &f64) -> f64 {
        self / other
    }

    fn times(&self, n: i64) -> f64 {
        self * n as f64
    }

    fn divided(&self, n: i64) -> f64 {
        self / n as f64
    }

    fn doubled(&self) -> f64 {
        2.0 * self
    }

    fn convolution(a: &[f64], b: &[f64], k: usize, low: usize, high: usize, _: u32) -> f64 {
        let mut sum = 0.0;
        for i in low..=high {
            sum += a[i] * b[k - i];
        }
        sum
    }

    fn weighted(
        a: &[f64],
        b: &[f64],
        k: usize,
        [low, high]: [usize; 2],
        weight: impl Fn(usize) -> i64,
        _: u32,
    ) -> f64 {
        let mut sum = 0.0;
        for i in low..=high {
            sum += a[i] * b[k - i] * weight(i) as f64;
        }
        sum
    }
}

/// An upper bound on `n u / (1 − n u)` for `u = 2^−bits` and `n u < 10^−4`.
pub(super) fn gamma(n: usize, bits: u32) -> Mag {
    debug_assert!(bits >= 40 && n < 1 << 22);
    Mag::from_f64(n as f64 * 1.0002).shift(-i64::from(bits))
}

//! The logarithm and special functions over rectangles.
//!
//! Sums of logarithms in doubles below are less than 2^17, and off by less than [`SLACK`].
//!
//! # The gamma function
//! For x > 0 (DLMF 5.6.1, 5.6.6, 5.6.7 and 5.6.9)
//!
//! ```text
//! 1 < Γ(x) / (√(2π) x^{x−1/2} e^{−x}) < e^{1/(12x)}
//! |Γ(x + iy)| ≤ Γ(x)
//! |Γ(z)| ≤ √(2π) |z|^{x−1/2} e^{−π|y|/2} e^{1/(6|z|)}
//! |Γ(x + iy)| ≥ Γ(x)/√cosh πy      for x ≥ 1/2
//! |Γ(x)/Γ(x + iy)|² = Π (1 + y²/(x + k)²) ≤ e^{y² (1/x + 1/x²)}
//! ```
//!
//! with DLMF 5.8.3 in the last line. Γ is convex, and its least value is above 0.88.
//!
//! # Lambert's W
//! The principal branch `w = W(z)` has `|Im w| < π` and Re w > −1, where Re w < 0 only with
//! `|Im w| < π/2`. For Re z ≥ 0 w and its angle have the sign of the angle of z, which is the sum of
//! the angle of w and Im w: then `|Im w| ≤ π/2` and Re w ≥ 0. With the bound h on |Im w| and Re w ≥
//! 0, `|w| e^{Re w} = |z|` with `Re w ≥ √(|w|² − h²)`. Any r > h with `r e^{√(r² − h²)} ≥ |z|` is a
//! bound on |w|.

use super::super::super::coarse;
use super::super::super::trigonometric::outwards;
use super::{Interval, Rectangle, TINY};
use std::f64::consts::{FRAC_PI_2, PI};

/// More than the error of the sums of logarithms here.
const SLACK: f64 = 1e-6;

/// The greatest number whose gamma function is bounded here.
const LARGEST: f64 = 1e4;

/// Left of minus this number it is not bounded here.
const LEFT: f64 = 8.0;

/// `ln √(2π)`.
const HALF_LOG: f64 = 0.918_938_533_204_672_8;

/// An enclosure by a bound `e^log` on the absolute value.
fn within(log: f64) -> Option<Rectangle> {
    let most = match log + SLACK {
        log if log <= coarse::EXPONENTS => outwards([0.0, coarse::exp(log.max(-600.0))])[1],
        _ => return None,
    };
    Rectangle::new([-most, most], [-most, most])
}

/// The lower bound on `ln Γ(x)`, x ≥ 1/2, by Stirling's formula.
fn stirling(x: f64) -> f64 {
    (x - 0.5) * coarse::ln(x) - x + HALF_LOG
}

impl Rectangle {
    /// The least and the greatest distance of an interval from zero.
    fn distances([low, high]: Interval) -> Interval {
        let least = low.max(-high).max(0.0);
        [least, high.max(-low)]
    }

    /// Bounds on the absolute value.
    fn sizes(&self) -> Interval {
        let [x, y] = [self.re, self.im].map(Rectangle::distances);
        let of = |k: usize| (x[k] * x[k] + y[k] * y[k]).sqrt();
        [of(0) * (1.0 - 1e-15), of(1) * (1.0 + 1e-15)]
    }

    /// `ln z` off its cut.
    pub fn log(&self) -> Option<Rectangle> {
        let sizes = self.sizes();
        if self.re[0] < TINY {
            // ln z = ln(−z) ± iπ, and ln z = ln(∓i z) ± iπ/2, the upper sign above the axis.
            let side = self.side()?;
            let (aside, turn) = match self.re[1] <= -TINY {
                true => (self.negative(), PI),
                false => (self.turned_by(-side), FRAC_PI_2),
            };
            let turn = [turn.next_down(), turn.next_up()];
            let turn = if side > 0.0 {
                turn
            } else {
                [-turn[1], -turn[0]]
            };
            let found = (aside.re[0] >= TINY).then(|| aside.log())??;
            return found.add(&Rectangle::new([0.0; 2], turn)?);
        }
        if sizes[1] > 1e140 {
            return None;
        }
        let [low, high] = sizes.map(coarse::ln);
        let off = |x: f64| coarse::ERROR * x.abs().max(1.0);
        let re = [(low - off(low)).next_down(), (high + off(high)).next_up()];
        let angle =
            |y: f64, [near, far]: Interval| coarse::atan2(y, if y < 0.0 { near } else { far });
        let [near, far] = self.re;
        let low = angle(self.im[0], [near, far])?;
        let high = angle(-self.im[1], [near, far])?;
        Rectangle::new(re, outwards([low, -high]))
    }

    /// The gamma function off its poles, not far left of the imaginary axis.
    pub fn tgamma(&self) -> Option<Rectangle> {
        let ([low, high], [least, most]) = (self.re, self.sizes());
        if (-LEFT..0.5).contains(&low) && most <= LARGEST {
            // Γ(z) = Γ(z + 1)/z
            let next = self.add(&Rectangle::real([1.0; 2])?)?;
            return next.tgamma()?.mul(&self.inverse()?);
        }
        if !(low >= 0.5 && most <= LARGEST) {
            return None;
        }
        let real = [low, high].map(|x| stirling(x) + 1.0 / (12.0 * x));
        let [least_height, _] = Rectangle::distances(self.im);
        let power = ((high - 0.5) * coarse::ln(most)).max(0.0);
        let apart = HALF_LOG + power - FRAC_PI_2 * least_height + 1.0 / (6.0 * least);
        within(real[0].max(real[1]).min(apart))
    }

    /// `1/Γ(z)`, not far left of the imaginary axis.
    pub fn inverse_gamma(&self) -> Option<Rectangle> {
        let [low, high] = self.re;
        if (-LEFT..0.5).contains(&low) && high <= LARGEST {
            // 1/Γ(z) = z/Γ(z + 1)
            let next = self.add(&Rectangle::real([1.0; 2])?)?;
            return self.mul(&next.inverse_gamma()?);
        }
        if !(low >= 0.5 && high <= LARGEST) {
            return None;
        }
        let least = if low >= 1.5 { stirling(low) } else { -0.13 };
        let [_, y] = Rectangle::distances(self.im);
        let [inverse, a] = [1.0 / low, PI * y];
        within((a / 2.0).min(y * y * (inverse + inverse * inverse) / 2.0) - least)
    }

    /// Lambert's W off its cut.
    pub fn lambertw(&self) -> Option<Rectangle> {
        let ([_, most], [low, _]) = (self.sizes(), self.re);
        let is_off = low > -0.3678 || self.im[0] > 0.0 || self.im[1] < 0.0;
        if !(is_off && most <= 1e140) {
            return None;
        }
        // A bound on h, its square, and a number above it.
        let (height, square, above, least) = match low >= 0.0 {
            true => (FRAC_PI_2.next_up(), 2.4675, 2.0, 0.0),
            false => (PI.next_up(), 9.8697, 3.3, -1.0),
        };
        let log = coarse::ln(most.max(3.0));
        let root = |r: f64| (r * r - square).sqrt();
        let rest = |r: f64| coarse::ln(r) + root(r) - log - SLACK;
        // Newton's method; the bound is proved of the number that comes out.
        let mut r = log.max(above);
        for _ in 0..4 {
            r = (r - rest(r) / (1.0 / r + r / root(r))).max(above);
        }
        r *= 1.001;
        if !(rest(r) >= 0.0) {
            return None;
        }
        Rectangle::new([least, r], [-height, height])
    }
}

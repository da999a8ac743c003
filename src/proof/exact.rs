//! An exact value over a rectangle: an interval, and beside it a linear function of the two
//! coordinates with a radius. The function keeps what two values that depend on the same
//! coordinates have in common, and each of the two makes the other narrower.

use crate::interval::{Interval, product_up, quotient_up, sum_up, up};
use std::ops::{Add, Mul, Neg};

/// `centre + slopes · ξ`, `ξ ∈ [−1, 1]²`, within `radius`, and within `range`.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Exact {
    /// Where the value lies.
    pub range: Interval,
    centre: f64,
    slopes: [f64; 2],
    radius: f64,
}

/// Returns what one rounded operation with result `x` may be off, with room for a second one.
fn slack(x: f64) -> f64 {
    up(up(x.abs() * f64::EPSILON) + f64::from_bits(2))
}

/// `x` and what its computation may be off added to a radius.
fn counted(x: f64, radius: &mut f64) -> f64 {
    *radius = sum_up(*radius, slack(x));
    x
}

impl Exact {
    pub const ZERO: Exact = Exact {
        range: Interval::ZERO,
        centre: 0.0,
        slopes: [0.0; 2],
        radius: 0.0,
    };

    /// One number.
    pub fn point(x: f64) -> Exact {
        Exact {
            range: Interval::point(x),
            centre: x,
            ..Exact::ZERO
        }
    }

    /// A constant known by an interval.
    pub fn within(range: Interval) -> Exact {
        if range.is_point() {
            return Exact::point(range.lo);
        }
        let centre = range.lo + 0.5 * (range.hi - range.lo);
        let radius = up(range.hi - centre).max(up(centre - range.lo));
        Exact {
            range,
            centre,
            slopes: [0.0; 2],
            radius,
        }
    }

    /// Coordinate number `i` of the rectangle.
    pub fn coordinate(range: Interval, i: usize) -> Exact {
        let constant = Exact::within(range);
        let mut slopes = [0.0; 2];
        slopes[i] = constant.radius;
        // Centre ± radius reaches beyond the ends; ξ just has less room.
        Exact {
            slopes,
            radius: 0.0,
            ..constant
        }
    }

    /// `centre + slopes · ξ` within the radius, which lies in the range too.
    fn linear(range: Interval, centre: f64, slopes: [f64; 2], radius: f64) -> Exact {
        let linear = Exact {
            range,
            centre,
            slopes,
            radius,
        };
        linear.tightened(range)
    }

    /// Both enclosures in one.
    fn tightened(mut self, range: Interval) -> Exact {
        let spread = sum_up(self.spread(), self.radius);
        let linear = Interval::point(self.centre).widened(spread);
        let lo = match linear.lo > range.lo {
            true => linear.lo,
            false => range.lo,
        };
        let hi = match linear.hi < range.hi {
            true => linear.hi,
            false => range.hi,
        };
        // Both hold the value, so that they meet; what is not a number is not believed.
        self.range = if lo <= hi {
            Interval::new(lo, hi)
        } else {
            range
        };
        let known = self.centre.is_finite() && self.radius.is_finite() && spread.is_finite();
        match known {
            true => self,
            false => Exact::within(self.range),
        }
    }

    /// All values within `r` of it.
    pub fn widened(mut self, r: f64) -> Exact {
        self.range = self.range.widened(r);
        self.radius = sum_up(self.radius, r);
        self
    }

    fn spread(&self) -> f64 {
        sum_up(self.slopes[0].abs(), self.slopes[1].abs())
    }

    pub fn is_zero(&self) -> bool {
        self.range.is_zero()
    }

    pub fn square(self) -> Exact {
        (self * self).tightened(self.range.square())
    }

    /// The number multiplied by a power of two, without rounding unless it underflows.
    pub fn scaled(self, by: f64, range: Interval) -> Exact {
        let mut radius = product_up(self.radius, by.abs());
        let centre = counted(self.centre * by, &mut radius);
        let slopes = self.slopes.map(|s| counted(s * by, &mut radius));
        match range.is_point() {
            true => Exact::point(range.lo),
            false => Exact::linear(range, centre, slopes, radius),
        }
    }

    /// `self/y`; y may not be zero.
    ///
    /// With `c` the quotient of the centres, `x/y = c + N/y`, `N = x − c y`, and
    /// `N/y = N/y₀ − N (y − y₀)/(y₀ y)` with `y₀` the centre of y.
    pub fn over(self, y: Exact) -> Exact {
        let range = self.range / y.range;
        let c = self.centre / y.centre;
        let least = y.range.mignitude();
        if !(c.is_finite() && least > 0.0 && y.centre != 0.0) {
            return Exact::within(range);
        }
        let n = self + -(Exact::point(c) * y);
        let size = sum_up(n.centre.abs(), sum_up(n.spread(), n.radius));
        let turn = sum_up(y.spread(), y.radius);
        let low = y.centre.abs();
        let second = quotient_up(quotient_up(product_up(size, turn), low), least);
        let mut radius = sum_up(second, quotient_up(n.radius, low));
        let first = counted(n.centre / y.centre, &mut radius);
        let centre = counted(c + first, &mut radius);
        let slopes = n.slopes.map(|s| counted(s / y.centre, &mut radius));
        Exact::linear(range, centre, slopes, radius)
    }
}

impl Neg for Exact {
    type Output = Exact;
    fn neg(self) -> Exact {
        Exact {
            range: -self.range,
            centre: -self.centre,
            slopes: self.slopes.map(|s| -s),
            radius: self.radius,
        }
    }
}

impl Add for Exact {
    type Output = Exact;
    fn add(self, other: Exact) -> Exact {
        if self.is_zero() {
            return other;
        }
        if other.is_zero() {
            return self;
        }
        let range = self.range + other.range;
        let mut radius = sum_up(self.radius, other.radius);
        let centre = counted(self.centre + other.centre, &mut radius);
        let slope = |i: usize, radius: &mut f64| match (self.slopes[i], other.slopes[i]) {
            (0.0, s) | (s, 0.0) => s,
            (s, t) => counted(s + t, radius),
        };
        let slopes = [slope(0, &mut radius), slope(1, &mut radius)];
        Exact::linear(range, centre, slopes, radius)
    }
}

impl Mul for Exact {
    type Output = Exact;
    fn mul(self, other: Exact) -> Exact {
        if self.is_zero() || other.is_zero() {
            return Exact::ZERO;
        }
        let range = self.range * other.range;
        let (p, q) = (self.spread(), other.spread());
        let (r, s) = (self.radius, other.radius);
        // c₁ r₂ + c₂ r₁ + (S₁ + r₁)(S₂ + r₂)
        let mut radius = sum_up(
            sum_up(
                product_up(self.centre.abs(), s),
                product_up(other.centre.abs(), r),
            ),
            product_up(sum_up(p, r), sum_up(q, s)),
        );
        let centre = counted(self.centre * other.centre, &mut radius);
        let slope = |i: usize, radius: &mut f64| {
            let (a, b) = (self.centre * other.slopes[i], other.centre * self.slopes[i]);
            if a == 0.0 && b == 0.0 && self.slopes[i] == 0.0 && other.slopes[i] == 0.0 {
                return 0.0;
            }
            *radius = sum_up(*radius, sum_up(slack(a), slack(b)));
            counted(a + b, radius)
        };
        let slopes = [slope(0, &mut radius), slope(1, &mut radius)];
        Exact::linear(range, centre, slopes, radius)
    }
}

#[cfg(test)]
mod tests;

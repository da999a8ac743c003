//! Intervals with `f64` ends, every operation rounded outwards.
//!
//! An operation rounded to nearest is within half a spacing of the exact result, so that the
//! neighbour below and the neighbour above enclose it, subnormal results and overflow (to infinity,
//! which stays) included.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// The numbers from `lo` to `hi`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    /// The least.
    pub lo: f64,
    /// The largest.
    pub hi: f64,
}

/// A number above an operation's exact result, from the rounded one.
pub fn up(rounded: f64) -> f64 {
    rounded.next_up()
}

/// A number below an operation's exact result, from the rounded one.
pub fn down(rounded: f64) -> f64 {
    rounded.next_down()
}

/// An upper bound of `a + b` for non-negative numbers; zero is kept.
pub fn sum_up(a: f64, b: f64) -> f64 {
    if a == 0.0 {
        return b;
    }
    if b == 0.0 {
        return a;
    }
    up(a + b)
}

/// An upper bound of `a b` for non-negative numbers; zero is kept, also beside infinity, which here
/// is an unknown finite number.
pub fn product_up(a: f64, b: f64) -> f64 {
    if a == 0.0 || b == 0.0 {
        return 0.0;
    }
    up(a * b)
}

/// An upper bound of `a/b`, `a ≥ 0`, from a lower bound `b` of the divisor; infinite where that is
/// not positive.
pub fn quotient_up(a: f64, b: f64) -> f64 {
    match (a == 0.0, b > 0.0) {
        (true, _) => 0.0,
        (false, true) => up(a / b),
        (false, false) => f64::INFINITY,
    }
}

/// An upper bound of `√a`, `a ≥ 0`.
pub fn sqrt_up(a: f64) -> f64 {
    if a == 0.0 { 0.0 } else { up(a.sqrt()) }
}

/// An upper bound of `√(a² + b²)`.
pub fn hypot_up(a: f64, b: f64) -> f64 {
    let (small, large) = if a < b { (a, b) } else { (b, a) };
    if small == 0.0 {
        return large;
    }
    if !large.is_finite() {
        return f64::INFINITY;
    }
    let t = quotient_up(small, large);
    product_up(large, sqrt_up(sum_up(1.0, product_up(t, t))))
}

/// A lower bound of `√(a² + b²)` for non-negative numbers.
pub fn hypot_down(a: f64, b: f64) -> f64 {
    let (small, large) = if a < b { (a, b) } else { (b, a) };
    if small == 0.0 || !large.is_finite() {
        return large;
    }
    let t = down(small / large).max(0.0);
    let root = down(down(1.0 + down(t * t).max(0.0)).sqrt());
    down(large * root).max(large)
}

/// The larger of two bounds; infinite where one of them is not a number, which `f64::max` would
/// pass over.
pub fn larger(a: f64, b: f64) -> f64 {
    if a >= b {
        a
    } else if b >= a {
        b
    } else {
        f64::INFINITY
    }
}

/// The largest of some bounds; infinite where there is none, or one that is not a number.
pub fn worst(bounds: impl IntoIterator<Item = f64>) -> f64 {
    let most = bounds.into_iter().reduce(larger);
    most.map_or(f64::INFINITY, |b| larger(b, 0.0))
}

impl Interval {
    /// Zero.
    pub const ZERO: Interval = Interval { lo: 0.0, hi: 0.0 };

    /// One number.
    pub fn point(x: f64) -> Interval {
        Interval { lo: x, hi: x }
    }

    /// All numbers.
    pub const ALL: Interval = Interval {
        lo: f64::NEG_INFINITY,
        hi: f64::INFINITY,
    };

    /// From one number to another; everything if that is not an interval.
    pub fn new(lo: f64, hi: f64) -> Interval {
        match lo <= hi {
            true => Interval { lo, hi },
            false => Interval::ALL,
        }
    }

    /// The least and the largest that an operation makes of the ends; none where a bound is lost:
    /// zero times infinity.
    fn extremes(self, other: Interval, f: impl Fn(f64, f64) -> f64) -> Option<[f64; 2]> {
        let (x, y) = (self, other);
        let p = [f(x.lo, y.lo), f(x.lo, y.hi), f(x.hi, y.lo), f(x.hi, y.hi)];
        let lo = p.into_iter().fold(f64::INFINITY, f64::min);
        let hi = p.into_iter().fold(f64::NEG_INFINITY, f64::max);
        (!p.iter().any(|x| x.is_nan())).then_some([lo, hi])
    }

    /// Returns whether it is one number, known exactly.
    pub fn is_point(self) -> bool {
        self.lo == self.hi
    }

    /// Returns whether it is the number zero.
    pub fn is_zero(self) -> bool {
        self.lo == 0.0 && self.hi == 0.0
    }

    /// The largest absolute value.
    pub fn magnitude(self) -> f64 {
        self.lo.abs().max(self.hi.abs())
    }

    /// The least absolute value.
    pub fn mignitude(self) -> f64 {
        if self.lo > 0.0 {
            self.lo
        } else if self.hi < 0.0 {
            -self.hi
        } else {
            0.0
        }
    }

    /// The squares.
    pub fn square(self) -> Interval {
        if self.is_zero() {
            return self;
        }
        let (m, n) = (self.mignitude(), self.magnitude());
        Interval::new(down(m * m).max(0.0), up(n * n))
    }

    /// The square roots; everything if a number is negative.
    pub fn sqrt(self) -> Interval {
        match self.lo >= 0.0 {
            true => Interval::new(down(self.lo.sqrt()).max(0.0), up(self.hi.sqrt())),
            false => Interval::ALL,
        }
    }

    /// All numbers between two of either.
    pub fn hull(self, other: Interval) -> Interval {
        Interval::new(self.lo.min(other.lo), self.hi.max(other.hi))
    }

    /// The numbers in both, for two enclosures of one number.
    pub fn meet(self, other: Interval) -> Interval {
        let (lo, hi) = (self.lo.max(other.lo), self.hi.min(other.hi));
        if lo <= hi { Interval { lo, hi } } else { self }
    }

    /// All numbers within `r` of it.
    pub fn widened(self, r: f64) -> Interval {
        if r == 0.0 {
            return self;
        }
        Interval::new(down(self.lo - r), up(self.hi + r))
    }
}

impl Add for Interval {
    type Output = Interval;
    fn add(self, other: Interval) -> Interval {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other;
        }
        Interval::new(down(self.lo + other.lo), up(self.hi + other.hi))
    }
}

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval {
            lo: -self.hi,
            hi: -self.lo,
        }
    }
}

impl Sub for Interval {
    type Output = Interval;
    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, other: Interval) -> Interval {
        if self.is_zero() || other.is_zero() {
            return Interval::ZERO;
        }
        let Some([lo, hi]) = self.extremes(other, f64::mul) else {
            return Interval::ALL;
        };
        let positive = self.lo >= 0.0 && other.lo >= 0.0;
        let lo = if positive {
            down(lo).max(0.0)
        } else {
            down(lo)
        };
        Interval::new(lo, up(hi))
    }
}

impl Div for Interval {
    type Output = Interval;
    fn div(self, other: Interval) -> Interval {
        if other.lo <= 0.0 && other.hi >= 0.0 {
            return Interval::ALL;
        }
        if self.is_zero() {
            return self;
        }
        let ends = self.extremes(other, f64::div);
        ends.map_or(Interval::ALL, |[lo, hi]| Interval::new(down(lo), up(hi)))
    }
}

#[cfg(test)]
mod tests;

//! Operations that round once, and what rounding costs.

use super::super::tape::{Op, Place};
use super::{Pass, Stop, stop};
use crate::grid::{exponent, power_of_two};
use crate::interval::{Interval, product_up, quotient_up, sqrt_up, sum_up};

/// Candidates for the end of a range: a rounded result, and whether the exact one is larger in
/// magnitude.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    pub lo: f64,
    pub hi: f64,
    pub most: f64,
    pub beyond: bool,
}

/// A result before its rounding.
pub(super) struct Unrounded {
    pub ends: Ends,
    /// All values on the path.
    pub value: Interval,
    /// Its exact value is a multiple of `2^grain`.
    pub grain: i32,
    /// The error that operands bring.
    pub error: f64,
    /// Known to be a number of the format.
    pub is_exact: bool,
    /// The exponent of the last bit of an operand that is multiplied by a power of two.
    pub shift: Option<i32>,
}

impl Unrounded {
    fn new(ends: Ends, value: Interval, grain: i32, error: f64) -> Unrounded {
        Unrounded {
            ends,
            value,
            grain,
            error,
            is_exact: false,
            shift: None,
        }
    }
}

impl Ends {
    pub fn new() -> Ends {
        Ends {
            lo: f64::INFINITY,
            hi: f64::NEG_INFINITY,
            most: 0.0,
            beyond: false,
        }
    }

    /// One result, which is not larger before its rounding.
    pub fn at(most: f64) -> Ends {
        Ends {
            lo: most,
            hi: most,
            most,
            beyond: false,
        }
    }

    /// Results that are in an interval before their rounding.
    pub fn within(mut self, range: Interval) -> Ends {
        let (lo, hi) = (self.lo.max(range.lo), self.hi.min(range.hi));
        if lo <= hi {
            (self.lo, self.hi) = (lo, hi);
        }
        let most = range.magnitude();
        if most < self.most {
            (self.most, self.beyond) = (most, true);
        }
        self
    }

    /// The least absolute value after the rounding.
    pub fn least(self) -> f64 {
        Interval::new(self.lo, self.hi).mignitude()
    }

    /// Takes in a result with the sign of exact less rounded.
    pub fn take(&mut self, x: f64, residual: f64) {
        let beyond = if x >= 0.0 {
            residual > 0.0
        } else {
            residual < 0.0
        };
        // A residual may underflow.
        let beyond = beyond || x.abs() < 1e-270;
        self.lo = self.lo.min(x);
        self.hi = self.hi.max(x);
        if x.abs() > self.most {
            (self.most, self.beyond) = (x.abs(), beyond);
        } else if x.abs() == self.most {
            self.beyond |= beyond;
        }
        if x.is_nan() {
            self.most = f64::NAN;
        }
    }
}

/// `a + b` and its residual.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let c = s - a;
    (s, (a - (s - c)) + (b - c))
}

fn product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    (p, a.mul_add(b, -p))
}

fn quotient(a: f64, b: f64) -> (f64, f64) {
    let q = a / b;
    let rest = (-q).mul_add(b, a);
    (q, if b < 0.0 { -rest } else { rest })
}

impl Pass {
    /// Returns whether results between ends that are multiples of `2^grain` before rounding are
    /// numbers of the format.
    pub(super) fn is_on_grid(&self, ends: Ends, grain: i32) -> Result<bool, Stop> {
        if !(ends.most <= self.setting.largest()) {
            return stop("may overflow");
        }
        Ok(grain >= self.setting.lowest()
            && (ends.most == 0.0 || {
                let e = exponent(ends.most);
                // Below 2^{grain + bits} every multiple of 2^grain is a number of the format.
                e < grain.saturating_add(self.setting.bits())
            }))
    }

    /// The error of rounding them.
    pub(super) fn rounding(&self, ends: Ends, grain: i32) -> Result<f64, Stop> {
        Ok(match self.is_on_grid(ends, grain)? {
            true => 0.0,
            false => self.half_ulp(ends),
        })
    }

    pub(super) fn rounded_ends(&self, ends: Ends) -> Interval {
        Interval::new(self.rounded(ends.lo), self.rounded(ends.hi))
    }

    pub(super) fn sum(&mut self, op: Op, a: Place, b: Place) -> Result<(), Stop> {
        let negated = matches!(op, Op::Sub(..));
        let (x, y) = (self.float[a], self.float[b]);
        let y = if negated { -y } else { y };
        let mut ends = Ends::new();
        for (p, q) in [(x.lo, y.lo), (x.hi, y.hi)] {
            let (s, rest) = two_sum(p, q);
            ends.take(s, rest);
        }
        let grain = self.grain[a].min(self.grain[b]);
        // Sterbenz: neither of two numbers is more than twice the other.
        let opposite = -y;
        let near = |x: Interval, y: Interval| {
            x.lo > 0.0 && y.lo > 0.0 && x.hi <= 2.0 * y.lo && y.hi <= 2.0 * x.lo
        };
        // Two numbers whose sum is a number of the format, as those of counters.
        let known = x.is_point() && y.is_point() && {
            let (s, rest) = two_sum(x.lo, y.lo);
            rest == 0.0 && s.is_finite() && self.rounded(s) == s
        };
        let is_exact =
            known || x.is_zero() || y.is_zero() || near(x, opposite) || near(-x, -opposite);
        let (v, w) = (self.value[a], self.value[b]);
        let value = match (negated, a == b) {
            (true, true) => Interval::ZERO,
            (true, false) => v - w,
            (false, _) => v + w,
        };
        let error = sum_up(self.error[a], self.error[b]);
        let unrounded = Unrounded::new(ends, value, grain, error);
        self.finish(
            op,
            Unrounded {
                is_exact,
                ..unrounded
            },
        )
    }

    /// Adds a result that is rounded once.
    fn finish(&mut self, op: Op, u: Unrounded) -> Result<(), Stop> {
        if self.solver.is_some() {
            return self.finish_of_solver(op, u);
        }
        let noise = match u.is_exact {
            true => 0.0,
            false => self.rounding(u.ends, u.grain)?,
        };
        let noise = self.scaled(noise, u.shift);
        let error = sum_up(u.error, noise);
        let rounding = (noise, self.unit());
        // A quotient or a root is a multiple of nothing but what every number is.
        let grain = u.grain.max(self.setting.lowest());
        self.push_rounded(self.rounded_ends(u.ends), u.value, rounding, grain, error);
        Ok(())
    }

    /// The exponent of a power of two that an operand is everywhere.
    pub(super) fn power_of_two(&self, a: Place) -> Option<i32> {
        let x = self.float[a];
        let known = x.is_point() && self.error[a] == 0.0;
        let size = x.lo.abs();
        let normal = known && (f64::MIN_POSITIVE..f64::INFINITY).contains(&size);
        (normal && size == power_of_two(exponent(size))).then(|| exponent(size))
    }

    pub(super) fn product(&mut self, op: Op, a: Place, b: Place) -> Result<(), Stop> {
        let (x, y) = (self.float[a], self.float[b]);
        let mut ends = Ends::new();
        if a == b {
            for p in [x.mignitude(), x.magnitude()] {
                let (s, rest) = product(p, p);
                ends.take(s, rest);
            }
        } else {
            for (p, q) in [(x.lo, y.lo), (x.lo, y.hi), (x.hi, y.lo), (x.hi, y.hi)] {
                let (s, rest) = product(p, q);
                ends.take(s, rest);
            }
        }
        let grain = self.grain[a].saturating_add(self.grain[b]);
        let shift = match (self.power_of_two(a), self.power_of_two(b)) {
            (Some(k), _) => Some(self.grain[b] + k),
            (_, Some(k)) => Some(self.grain[a] + k),
            _ => None,
        };
        let (v, w) = (self.value[a], self.value[b]);
        let value = if a == b { v.square() } else { v * w };
        let error = sum_up(
            product_up(v.magnitude(), self.error[b]),
            product_up(w.magnitude(), self.error[a]),
        );
        let unrounded = Unrounded::new(ends, value, grain, error);
        self.finish(op, Unrounded { shift, ..unrounded })
    }

    /// The error of a multiplication by a power of two: none but below the normal numbers.
    fn scaled(&self, noise: f64, grain: Option<i32>) -> f64 {
        match grain {
            None => noise,
            Some(grain) if grain >= self.setting.lowest() => 0.0,
            Some(_) => noise.min(power_of_two((self.setting.lowest() - 1).max(-1074))),
        }
    }

    pub(super) fn quotient(&mut self, op: Op, a: Place, b: Place) -> Result<(), Stop> {
        let (x, y) = (self.float[a], self.float[b]);
        let (v, w) = (self.value[a], self.value[b]);
        if w.mignitude() == 0.0 || y.mignitude() == 0.0 {
            return stop("a divisor that may be zero");
        }
        let mut ends = Ends::new();
        for (p, q) in [(x.lo, y.lo), (x.lo, y.hi), (x.hi, y.lo), (x.hi, y.hi)] {
            let (s, rest) = quotient(p, q);
            ends.take(s, rest);
        }
        let shift = self
            .power_of_two(b)
            .map(|k| self.grain[a].saturating_sub(k));
        let value = v / w;
        let error = quotient_up(
            sum_up(self.error[a], product_up(value.magnitude(), self.error[b])),
            w.mignitude(),
        );
        let unrounded = Unrounded {
            is_exact: x.is_zero(),
            shift,
            ..Unrounded::new(ends, value, i32::MIN, error)
        };
        self.finish(op, unrounded)
    }

    pub(super) fn root(&mut self, op: Op, a: Place) -> Result<(), Stop> {
        let (x, v) = (self.float[a], self.value[a]);
        if x.lo < 0.0 || v.lo < 0.0 {
            return stop("the square root of a number that may be negative");
        }
        let mut ends = Ends::new();
        for p in [x.lo, x.hi] {
            let root = p.sqrt();
            ends.take(root, (-root).mul_add(root, p));
        }
        let value = v.sqrt();
        // |√x − √y| = |x − y|/(√x + √y), and at most √|x − y|.
        let e = self.error[a];
        let error = quotient_up(e, 2.0 * value.lo).min(sqrt_up(e));
        let is_exact = x.is_zero();
        let unrounded = Unrounded::new(ends, value, i32::MIN, error);
        self.finish(
            op,
            Unrounded {
                is_exact,
                ..unrounded
            },
        )
    }

    pub(super) fn fused(&mut self, op: Op, a: Place, b: Place, c: Place) -> Result<(), Stop> {
        let (x, y, z) = (self.float[a], self.float[b], self.float[c]);
        let mut ends = Ends::new();
        for (p, q) in [(x.lo, y.lo), (x.lo, y.hi), (x.hi, y.lo), (x.hi, y.hi)] {
            for r in [z.lo, z.hi] {
                let s = match self.setting.is_single() {
                    true => f64::from((p as f32).mul_add(q as f32, r as f32)),
                    false => p.mul_add(q, r),
                };
                ends.take(s, s.signum());
            }
        }
        let grain = self.grain[a]
            .saturating_add(self.grain[b])
            .min(self.grain[c]);
        let (v, w, u) = (self.value[a], self.value[b], self.value[c]);
        let both = if a == b { v.square() } else { v * w };
        let error = sum_up(
            product_up(v.magnitude(), self.error[b]),
            product_up(w.magnitude(), self.error[a]),
        );
        let error = sum_up(error, self.error[c]);
        self.finish(op, Unrounded::new(ends, both + u, grain, error))
    }
}

//! Operations that round once, and what rounding costs.

use super::super::tape::Place;
use super::{Pass, Stop, stop};
use crate::form::{exponent, power_of_two};
use crate::interval::{Interval, product_up, quotient_up, sqrt_up, sum_up};

/// Candidates for the end of a range: a rounded result, and whether the exact one is larger in
/// magnitude.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    pub lo: f64,
    pub hi: f64,
    most: f64,
    beyond: bool,
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
    /// The error of rounding results between ends that are multiples of `2^grain` before rounding.
    pub(super) fn rounding(&self, ends: Ends, grain: i32) -> Result<f64, Stop> {
        if !(ends.most <= self.setting.largest()) {
            return stop("may overflow");
        }
        let exact = grain >= self.setting.lowest()
            && (ends.most == 0.0 || {
                let e = exponent(ends.most);
                // Below 2^{grain + bits} every multiple of 2^grain is a number of the format.
                e < grain.saturating_add(self.setting.bits())
            });
        Ok(if exact {
            0.0
        } else {
            self.half_ulp(ends.most, ends.beyond)
        })
    }

    pub(super) fn rounded_ends(&self, ends: Ends) -> Interval {
        Interval::new(self.rounded(ends.lo), self.rounded(ends.hi))
    }

    pub(super) fn sum(&mut self, a: Place, b: Place, negated: bool) -> Result<(), Stop> {
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
        let exact = known || x.is_zero() || y.is_zero() || near(x, opposite) || near(-x, -opposite);
        let noise = if exact {
            0.0
        } else {
            self.rounding(ends, grain)?
        };
        let (v, w) = (self.value[a], self.value[b]);
        let value = match (negated, a == b) {
            (true, true) => Interval::ZERO,
            (true, false) => v - w,
            (false, _) => v + w,
        };
        let error = sum_up(sum_up(self.error[a], self.error[b]), noise);
        self.push_result(ends, value, noise, grain, error);
        Ok(())
    }

    /// Adds a result that is rounded once.
    fn push_result(&mut self, ends: Ends, value: Interval, noise: f64, grain: i32, error: f64) {
        let rounding = (noise, self.unit());
        self.push_rounded(self.rounded_ends(ends), value, rounding, grain, error);
    }

    /// The exponent of a power of two that an operand is everywhere.
    fn power_of_two(&self, a: Place) -> Option<i32> {
        let x = self.float[a];
        let known = x.is_point() && self.noise[a] == 0.0 && self.error[a] == 0.0;
        let size = x.lo.abs();
        let normal = known && (f64::MIN_POSITIVE..f64::INFINITY).contains(&size);
        (normal && size == power_of_two(exponent(size))).then(|| exponent(size))
    }

    pub(super) fn product(&mut self, a: Place, b: Place) -> Result<(), Stop> {
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
        let mut noise = self.rounding(ends, grain)?;
        noise = self.scaled(noise, shift);
        let (v, w) = (self.value[a], self.value[b]);
        let value = if a == b { v.square() } else { v * w };
        let error = sum_up(
            product_up(v.magnitude(), self.error[b]),
            product_up(w.magnitude(), self.error[a]),
        );
        let error = sum_up(error, noise);
        self.push_result(ends, value, noise, grain, error);
        Ok(())
    }

    /// The error of a multiplication by a power of two: none but below the normal numbers.
    pub(super) fn scaled(&self, noise: f64, grain: Option<i32>) -> f64 {
        match grain {
            None => noise,
            Some(grain) if grain >= self.setting.lowest() => 0.0,
            Some(_) => noise.min(power_of_two((self.setting.lowest() - 1).max(-1074))),
        }
    }

    pub(super) fn quotient(&mut self, a: Place, b: Place) -> Result<(), Stop> {
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
        let mut noise = match x.is_zero() {
            true => 0.0,
            false => self.rounding(ends, i32::MIN)?,
        };
        noise = self.scaled(noise, shift);
        let value = v / w;
        let error = quotient_up(
            sum_up(self.error[a], product_up(value.magnitude(), self.error[b])),
            w.mignitude(),
        );
        let error = sum_up(error, noise);
        let grain = self.setting.lowest();
        self.push_result(ends, value, noise, grain, error);
        Ok(())
    }

    pub(super) fn root(&mut self, a: Place) -> Result<(), Stop> {
        let (x, v) = (self.float[a], self.value[a]);
        if x.lo < 0.0 || v.lo < 0.0 {
            return stop("the square root of a number that may be negative");
        }
        let mut ends = Ends::new();
        for p in [x.lo, x.hi] {
            let root = p.sqrt();
            ends.take(root, (-root).mul_add(root, p));
        }
        let noise = match x.is_zero() {
            true => 0.0,
            false => self.rounding(ends, i32::MIN)?,
        };
        let value = v.sqrt();
        // |√x − √y| = |x − y|/(√x + √y), and at most √|x − y|.
        let e = self.error[a];
        let carried = quotient_up(e, 2.0 * value.lo).min(sqrt_up(e));
        let error = sum_up(carried, noise);
        let lowest = self.setting.lowest();
        self.push_result(ends, value, noise, lowest, error);
        Ok(())
    }

    pub(super) fn fused(&mut self, a: Place, b: Place, c: Place) -> Result<(), Stop> {
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
        let noise = self.rounding(ends, grain)?;
        let (v, w, u) = (self.value[a], self.value[b], self.value[c]);
        let both = if a == b { v.square() } else { v * w };
        let error = sum_up(
            product_up(v.magnitude(), self.error[b]),
            product_up(w.magnitude(), self.error[a]),
        );
        let error = sum_up(sum_up(error, self.error[c]), noise);
        let value = both + u;
        self.push_result(ends, value, noise, grain, error);
        Ok(())
    }
}

//! Ranges, rounding errors and derivatives of all operations of a tape over a box of inputs.
//!
//! For an input x of the box let `δ_i` be the error that operation i makes in the execution: the
//! number computed less what exact arithmetic makes of its computed operands. Multiplied by `θ` in
//! `[0, 1]` these errors lead from the exact values (`θ = 0`) to the computed ones (`θ = 1`), and by
//! the mean value theorem along this path
//!
//! ```text
//! f̂(x) − f(x) = Σ_i δ_i ∂f/∂δ_i    at some θ.
//! ```
//!
//! A [`Pass`] encloses every operation over the box twice: what the execution may give ([`Pass::float`]),
//! from which `|δ_i|` follows, and all values on the path ([`Pass::value`]), over which derivatives
//! are taken. So no term of second order is left to be added: it is in the width of the path.

use super::Setting;
use super::elementary::{pi, power, range, slopes};
use super::tape::{Condition, Op, Place, Tape};
use crate::form::{exponent, grain_of_point, power_of_two};
use crate::interval::{Interval, product_up, quotient_up, sqrt_up, sum_up};
use mechaudit_symbolic::{Func, Relation};

/// Why an operation has no bound over a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stop {
    /// The reason.
    pub reason: &'static str,
}

fn stop<T>(reason: &'static str) -> Result<T, Stop> {
    Err(Stop { reason })
}

/// Ranges, errors and derivatives over one box; see the [module](self).
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    setting: Setting,
    /// The number of inputs.
    inputs: usize,
    /// What the execution may give.
    pub float: Vec<Interval>,
    /// Values on the path from exact to computed.
    pub value: Vec<Interval>,
    /// What is computed is a multiple of `2^grain`.
    grain: Vec<i32>,
    /// Bounds of `|δ_i|`.
    pub noise: Vec<f64>,
    /// Bounds of the difference between computed and exact values, operation by operation.
    pub error: Vec<f64>,
    /// Derivatives by the operands.
    partial: Vec<[Interval; 3]>,
    /// Derivatives by the inputs, input by input.
    pub slope: Vec<Interval>,
    /// Derivatives of the partial ones by the inputs.
    curve: Vec<Interval>,
    /// `∂f/∂δ_i`.
    pub adjoint: Vec<Interval>,
    /// Derivatives of these by the inputs.
    pub adjoint_slope: Vec<Interval>,
    /// Operations whose error counts: their own or that of an operand is not zero.
    noisy: Vec<bool>,
    /// Conditions that the box does not decide, in the order of the tape.
    pub open: Vec<usize>,
    /// Errors that operations may make elsewhere, where the path of another point is followed.
    pub given: Vec<f64>,
}

/// Candidates for the end of a range: a rounded result, and whether the exact one is larger in
/// magnitude.
#[derive(Clone, Copy)]
struct Ends {
    lo: f64,
    hi: f64,
    most: f64,
    beyond: bool,
}

impl Ends {
    fn new() -> Ends {
        Ends {
            lo: f64::INFINITY,
            hi: f64::NEG_INFINITY,
            most: 0.0,
            beyond: false,
        }
    }

    /// Takes in a result with the sign of exact less rounded.
    fn take(&mut self, x: f64, residual: f64) {
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

fn one() -> Interval {
    Interval::point(1.0)
}

impl Pass {
    /// Creates a pass without a tape.
    pub fn new(setting: Setting, inputs: usize) -> Pass {
        Pass {
            setting,
            inputs,
            float: Vec::new(),
            value: Vec::new(),
            grain: Vec::new(),
            noise: Vec::new(),
            error: Vec::new(),
            partial: Vec::new(),
            slope: Vec::new(),
            curve: Vec::new(),
            adjoint: Vec::new(),
            adjoint_slope: Vec::new(),
            noisy: Vec::new(),
            open: Vec::new(),
            given: Vec::new(),
        }
    }

    /// The exponent of the last bit of numbers not smaller than `least` in magnitude.
    fn last_bit(&self, least: f64) -> i32 {
        let lowest = self.setting.lowest();
        if least == 0.0 {
            return lowest;
        }
        (exponent(least) + 1 - self.setting.bits()).max(lowest)
    }

    /// Half a unit in the last place of the largest result.
    fn half_ulp(&self, most: f64, beyond: bool) -> f64 {
        let e = exponent(most);
        let whole = e >= -1022 && most == power_of_two(e);
        let e = if whole && !beyond { e - 1 } else { e };
        let last = (e + 1 - self.setting.bits()).max(self.setting.lowest());
        power_of_two((last - 1).max(-1074))
    }

    /// The format's numbers next to the ends, which rounding does not leave.
    fn rounded(&self, x: f64) -> f64 {
        if self.setting.is_single() {
            f64::from(x as f32)
        } else {
            x
        }
    }

    /// Computes ranges, errors and, if asked, derivatives by inputs. Of the conditions that the box
    /// does not decide, those at the end of `picks` are taken as it says: it holds the branch of the
    /// exact value.
    pub fn forward(
        &mut self,
        tape: &Tape,
        at: &[Interval],
        slopes: bool,
        picks: &[bool],
    ) -> Result<(), Stop> {
        self.float.clear();
        self.value.clear();
        self.grain.clear();
        self.noise.clear();
        self.error.clear();
        self.partial.clear();
        self.noisy.clear();
        self.slope.clear();
        self.curve.clear();
        self.open.clear();
        for op in &tape.ops {
            self.step(tape, *op, at, slopes, picks)?;
        }
        Ok(())
    }

    fn push(&mut self, float: Interval, value: Interval, noise: f64, grain: i32, error: f64) {
        let given = self.given.get(self.noise.len()).copied().unwrap_or(0.0);
        let (value, error) = match given > noise {
            true => (value.widened(given), sum_up(error, given)),
            false => (value, error),
        };
        let noise = noise.max(given);
        // Rounding gives a multiple of the last bit of the smallest result, and keeps the grain.
        let grain = grain.max(self.last_bit(float.mignitude()));
        self.float.push(float);
        self.value.push(value);
        self.noise.push(noise);
        self.grain.push(grain);
        self.error.push(error);
        self.partial.push([Interval::ZERO; 3]);
        self.noisy.push(noise > 0.0);
    }

    /// The error of rounding results between ends that are multiples of `2^grain` before rounding.
    fn rounding(&self, ends: Ends, grain: i32) -> Result<f64, Stop> {
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

    fn rounded_ends(&self, ends: Ends) -> Interval {
        Interval::new(self.rounded(ends.lo), self.rounded(ends.hi))
    }

    fn step(
        &mut self,
        tape: &Tape,
        op: Op,
        at: &[Interval],
        slopes: bool,
        picks: &[bool],
    ) -> Result<(), Stop> {
        let lowest = self.setting.lowest();
        match op {
            Op::Input(k) => {
                let x = at[k];
                match self.setting.round_inputs {
                    false => self.push(x, x, 0.0, lowest, 0.0),
                    true => {
                        let mut ends = Ends::new();
                        ends.take(x.lo, 0.0);
                        ends.take(x.hi, 0.0);
                        let noise = match x.is_point() && self.rounded(x.lo) == x.lo {
                            true => 0.0,
                            false => self.rounding(ends, i32::MIN)?,
                        };
                        self.push(
                            self.rounded_ends(ends),
                            x.widened(noise),
                            noise,
                            lowest,
                            noise,
                        );
                    }
                }
            }
            Op::Constant(real, nearest, noise) => {
                let point = Interval::point(nearest);
                if !(nearest.abs() <= self.setting.largest()) {
                    return stop("a constant overflows");
                }
                self.push(
                    point,
                    real.hull(point),
                    noise,
                    grain_of_point(nearest),
                    noise,
                );
            }
            Op::Neg(a) => {
                let (f, v) = (-self.float[a], -self.value[a]);
                self.push(f, v, 0.0, self.grain[a], self.error[a]);
            }
            Op::Abs(a) => {
                let of = |x: Interval| Interval::new(x.mignitude(), x.magnitude());
                let (f, v) = (of(self.float[a]), of(self.value[a]));
                self.push(f, v, 0.0, self.grain[a], self.error[a]);
            }
            Op::Add(a, b) => self.sum(a, b, false)?,
            Op::Sub(a, b) => self.sum(a, b, true)?,
            Op::Mul(a, b) => self.product(a, b)?,
            Op::Div(a, b) => self.quotient(a, b)?,
            Op::Sqrt(a) => self.root(a)?,
            Op::Fma(a, b, c) => self.fused(a, b, c)?,
            Op::Smooth(f, a, accuracy) => {
                let value = range(f, self.value[a]);
                let [first, _] = super::elementary::slopes(f, self.value[a], value);
                let error = product_up(first.magnitude(), self.error[a]);
                self.function(value, accuracy.ulps, error)?;
            }
            Op::Power(a, k, accuracy) => {
                let x = self.value[a];
                let slope = Interval::point(k.into()) * power(x, k - 1);
                let error = product_up(slope.magnitude(), self.error[a]);
                self.function(power(x, k), accuracy.ulps, error)?;
            }
            Op::Pow(a, b, accuracy) => {
                let (x, y) = (self.value[a], self.value[b]);
                if !(x.lo > 0.0) {
                    return stop("a power whose base may be zero or negative");
                }
                let log = range(Func::Log, x);
                let value = range(Func::Exp, y * log);
                let error = sum_up(
                    product_up((value * y / x).magnitude(), self.error[a]),
                    product_up((value * log).magnitude(), self.error[b]),
                );
                self.function(value, accuracy.ulps, error)?;
            }
            Op::Hypot(a, b, accuracy) => {
                let (x, y) = (self.value[a], self.value[b]);
                let value = (x.square() + y.square()).sqrt();
                let error = sum_up(self.error[a], self.error[b]);
                self.function(value, accuracy.ulps, error)?;
            }
            Op::Atan2(a, b, accuracy) => {
                let (y, x) = (self.value[a], self.value[b]);
                let half = pi() * Interval::point(0.5);
                let value = if x.lo > 0.0 {
                    range(Func::Arctan, y / x)
                } else if y.lo > 0.0 {
                    half - range(Func::Arctan, x / y)
                } else if y.hi < 0.0 {
                    -half - range(Func::Arctan, x / y)
                } else {
                    return stop("an angle that may jump");
                };
                let square = x.square() + y.square();
                let error = sum_up(
                    product_up((x / square).magnitude(), self.error[a]),
                    product_up((y / square).magnitude(), self.error[b]),
                );
                self.function(value, accuracy.ulps, error)?;
            }
            Op::Min(a, b) | Op::Max(a, b) => {
                let is_min = matches!(op, Op::Min(..));
                let of = |x: Interval, y: Interval| match is_min {
                    true => Interval::new(x.lo.min(y.lo), x.hi.min(y.hi)),
                    false => Interval::new(x.lo.max(y.lo), x.hi.max(y.hi)),
                };
                let f = of(self.float[a], self.float[b]);
                let v = of(self.value[a], self.value[b]);
                let grain = self.grain[a].min(self.grain[b]);
                let error = self.error[a].max(self.error[b]);
                self.push(f, v, 0.0, grain, error);
            }
            Op::Step(f, a) => {
                let of = |x: f64| match f {
                    Func::Floor => x.floor(),
                    Func::Ceil => x.ceil(),
                    Func::Trunc => x.trunc(),
                    Func::Round => x.round(),
                    _ => x.round_ties_even(),
                };
                let x = self.value[a];
                let (from, to) = (of(x.lo), of(x.hi));
                if !(from == to) {
                    return stop("a step function that jumps");
                }
                let value = Interval::point(from);
                self.push(value, value, 0.0, grain_of_point(from), 0.0);
            }
            Op::If(condition, a, b) => self.choose(tape, condition, a, b, picks)?,
        }
        self.link(op, slopes);
        Ok(())
    }

    /// The result of a function that is off by some units in the last place.
    fn function(&mut self, value: Interval, ulps: f64, carried: f64) -> Result<(), Stop> {
        let most = value.magnitude();
        if !(most <= self.setting.largest()) {
            return stop("may be undefined or overflow");
        }
        let noise = match value.is_zero() {
            true => 0.0,
            false => product_up(2.0 * ulps, self.half_ulp(most, false)),
        };
        let computed = value.widened(noise);
        if !(computed.magnitude() <= self.setting.largest()) {
            return stop("may overflow");
        }
        let error = sum_up(carried, noise);
        self.push(computed, computed, noise, self.setting.lowest(), error);
        Ok(())
    }

    fn sum(&mut self, a: Place, b: Place, negated: bool) -> Result<(), Stop> {
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
        let exact = x.is_zero() || y.is_zero() || near(x, opposite) || near(-x, -opposite);
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
        self.push(
            self.rounded_ends(ends),
            value.widened(noise),
            noise,
            grain,
            error,
        );
        Ok(())
    }

    /// The exponent of a power of two that an operand is everywhere.
    fn power_of_two(&self, a: Place) -> Option<i32> {
        let x = self.float[a];
        let known = x.is_point() && self.noise[a] == 0.0 && self.error[a] == 0.0;
        let size = x.lo.abs();
        let normal = known && size >= f64::MIN_POSITIVE && size < f64::INFINITY;
        (normal && size == power_of_two(exponent(size))).then(|| exponent(size))
    }

    fn product(&mut self, a: Place, b: Place) -> Result<(), Stop> {
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
        self.push(
            self.rounded_ends(ends),
            value.widened(noise),
            noise,
            grain,
            error,
        );
        Ok(())
    }

    /// The error of a multiplication by a power of two: none but below the normal numbers.
    fn scaled(&self, noise: f64, grain: Option<i32>) -> f64 {
        match grain {
            None => noise,
            Some(grain) if grain >= self.setting.lowest() => 0.0,
            Some(_) => noise.min(power_of_two((self.setting.lowest() - 1).max(-1074))),
        }
    }

    fn quotient(&mut self, a: Place, b: Place) -> Result<(), Stop> {
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
        self.push(
            self.rounded_ends(ends),
            value.widened(noise),
            noise,
            grain,
            error,
        );
        Ok(())
    }

    fn root(&mut self, a: Place) -> Result<(), Stop> {
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
        self.push(
            self.rounded_ends(ends),
            value.widened(noise),
            noise,
            lowest,
            error,
        );
        Ok(())
    }

    fn fused(&mut self, a: Place, b: Place, c: Place) -> Result<(), Stop> {
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
        let value = (both + u).widened(noise);
        self.push(self.rounded_ends(ends), value, noise, grain, error);
        Ok(())
    }

    /// Returns whether a condition holds for every value on the path, or for none.
    pub fn holds(&self, tape: &Tape, condition: usize) -> Option<bool> {
        match tape.conditions[condition] {
            Condition::Truth(t) => Some(t),
            Condition::Not(a) => self.holds(tape, a).map(|t| !t),
            Condition::And(a, b) => match (self.holds(tape, a), self.holds(tape, b)) {
                (Some(false), _) | (_, Some(false)) => Some(false),
                (Some(true), Some(true)) => Some(true),
                _ => None,
            },
            Condition::Or(a, b) => match (self.holds(tape, a), self.holds(tape, b)) {
                (Some(true), _) | (_, Some(true)) => Some(true),
                (Some(false), Some(false)) => Some(false),
                _ => None,
            },
            Condition::Compare(relation, a, b) => {
                let (x, y) = (self.value[a], self.value[b]);
                let all = |all: bool, none: bool| match (all, none) {
                    (true, _) => Some(true),
                    (_, true) => Some(false),
                    _ => None,
                };
                let equal = x.is_point() && y.is_point() && x.lo == y.lo;
                let apart = x.hi < y.lo || y.hi < x.lo;
                match relation {
                    Relation::Less => all(x.hi < y.lo, x.lo >= y.hi),
                    Relation::LessEqual => all(x.hi <= y.lo, x.lo > y.hi),
                    Relation::Greater => all(x.lo > y.hi, x.hi <= y.lo),
                    Relation::GreaterEqual => all(x.lo >= y.hi, x.hi < y.lo),
                    Relation::Equal => all(equal, apart),
                    Relation::NotEqual => all(apart, equal),
                }
            }
        }
    }

    /// The branch of the exact value, and what the other one differs by where the execution may take
    /// it.
    fn choose(
        &mut self,
        tape: &Tape,
        condition: usize,
        a: Place,
        b: Place,
        picks: &[bool],
    ) -> Result<(), Stop> {
        let (taken, jump) = match self.holds(tape, condition) {
            Some(true) => (a, 0.0),
            Some(false) => (b, 0.0),
            None => {
                let known = self.open.iter().position(|c| *c == condition);
                let place = known.unwrap_or_else(|| {
                    self.open.push(condition);
                    self.open.len() - 1
                });
                let first = picks.get(place).copied().unwrap_or(true);
                let jump = match a == b {
                    true => 0.0,
                    false => (self.float[a] - self.float[b]).magnitude(),
                };
                if !jump.is_finite() {
                    return stop("a jump without a bound");
                }
                (if first { a } else { b }, jump)
            }
        };
        let (f, grain) = match jump > 0.0 {
            true => (
                self.float[a].hull(self.float[b]),
                self.grain[a].min(self.grain[b]),
            ),
            false => (self.float[taken], self.grain[taken]),
        };
        let value = self.value[taken].widened(jump);
        let error = sum_up(self.error[taken], jump);
        self.push(f, value, jump, grain, error);
        let last = self.partial.len() - 1;
        let side = usize::from(taken == b && a != b);
        self.partial[last][side] = one();
        Ok(())
    }

    /// Derivatives of the last operation.
    fn link(&mut self, op: Op, with_slopes: bool) {
        let last = self.partial.len() - 1;
        let (operands, count) = op.operands();
        let noisy = operands[..count].iter().any(|a| self.noisy[*a]);
        self.noisy[last] |= noisy;
        let v = |k: usize| self.value[operands[k]];
        let here = self.value[last];
        let constant = Interval::ZERO;
        // First derivatives, and the second ones by pairs of operands: aa, ab, bb.
        let mut second = [constant; 3];
        let first = match op {
            Op::Input(_) | Op::Constant(..) | Op::Step(..) => [constant; 3],
            Op::If(..) => self.partial[last],
            Op::Neg(_) => [-one(), constant, constant],
            Op::Add(..) => [one(), one(), constant],
            Op::Sub(..) => [one(), -one(), constant],
            Op::Abs(_) => {
                let x = v(0);
                let sign = if x.lo >= 0.0 {
                    one()
                } else if x.hi <= 0.0 {
                    -one()
                } else {
                    second[0] = Interval::ALL;
                    Interval { lo: -1.0, hi: 1.0 }
                };
                [sign, constant, constant]
            }
            Op::Min(..) | Op::Max(..) => {
                let (x, y) = (v(0), v(1));
                let (low, high) = (x.hi <= y.lo, y.hi <= x.lo);
                let is_min = matches!(op, Op::Min(..));
                let share = match (low, high) {
                    (true, _) => Interval::point(f64::from(u8::from(is_min))),
                    (_, true) => Interval::point(f64::from(u8::from(!is_min))),
                    _ => {
                        second = [Interval::ALL; 3];
                        Interval { lo: 0.0, hi: 1.0 }
                    }
                };
                [share, one() - share, constant]
            }
            Op::Mul(a, b) if a == b => {
                second[0] = Interval::point(2.0);
                [Interval::point(2.0) * v(0), constant, constant]
            }
            Op::Mul(..) => {
                second[1] = one();
                [v(1), v(0), constant]
            }
            Op::Fma(a, b, _) if a == b => {
                second[0] = Interval::point(2.0);
                [Interval::point(2.0) * v(0), constant, one()]
            }
            Op::Fma(..) => {
                second[1] = one();
                [v(1), v(0), one()]
            }
            Op::Div(..) => {
                let (x, y) = (v(0), v(1));
                let square = y.square();
                second[1] = -(one() / square);
                second[2] = Interval::point(2.0) * x / (square * y);
                [one() / y, -(x / square), constant]
            }
            Op::Sqrt(_) => {
                let root = v(0).sqrt();
                let slope = Interval::point(0.5) / root;
                second[0] = Interval::point(-0.5) * slope / v(0);
                [slope, constant, constant]
            }
            Op::Smooth(f, ..) => {
                let [slope, curve] = slopes(f, v(0), here);
                second[0] = curve;
                [slope, constant, constant]
            }
            Op::Power(_, k, _) => {
                let x = v(0);
                let of = |c: i64, k: i32| Interval::point(c as f64) * power(x, k);
                let k_long = i64::from(k);
                second[0] = of(k_long * (k_long - 1), k - 2);
                [of(k_long, k - 1), constant, constant]
            }
            Op::Pow(..) => {
                let (x, y) = (v(0), v(1));
                let log = range(Func::Log, x);
                let less = y - one();
                let slope = range(Func::Exp, less * log);
                let value = range(Func::Exp, y * log);
                second[0] = y * less * range(Func::Exp, (less - one()) * log);
                second[1] = slope * (one() + y * log);
                second[2] = value * log.square();
                [y * slope, value * log, constant]
            }
            Op::Hypot(..) => {
                let (x, y) = (v(0), v(1));
                let h = (x.square() + y.square()).sqrt();
                let cube = h * h.square();
                second[0] = y.square() / cube;
                second[1] = -(x * y / cube);
                second[2] = x.square() / cube;
                [x / h, y / h, constant]
            }
            Op::Atan2(..) => {
                let (y, x) = (v(0), v(1));
                let square = x.square() + y.square();
                let fourth = square.square();
                second[0] = Interval::point(-2.0) * x * y / fourth;
                second[1] = (y.square() - x.square()) / fourth;
                second[2] = -second[0];
                [x / square, -(y / square), constant]
            }
        };
        self.partial[last] = first;
        if !with_slopes {
            return;
        }
        let n = self.inputs;
        for j in 0..n {
            let slopes = [0, 1, 2].map(|k| match k < count {
                true => self.slope[operands[k] * n + j],
                false => Interval::ZERO,
            });
            let mut own = match op {
                Op::Input(k) if k == j => one(),
                _ => Interval::ZERO,
            };
            for (partial, slope) in first.iter().zip(slopes) {
                // A factor twice has its derivative with the first.
                own = own + *partial * slope;
            }
            self.slope.push(own);
            let [x, y, _] = slopes;
            self.curve.push(second[0] * x + second[1] * y);
            self.curve.push(second[1] * x + second[2] * y);
        }
    }

    /// Computes `∂f/∂δ_i` of the operation at a place, and the derivatives of these by the inputs.
    pub fn backward(&mut self, tape: &Tape, root: Place, with_slopes: bool) {
        let (n, len) = (self.inputs, tape.ops.len());
        self.adjoint.clear();
        self.adjoint.resize(len, Interval::ZERO);
        self.adjoint_slope.clear();
        self.adjoint_slope
            .resize(if with_slopes { len * n } else { 0 }, Interval::ZERO);
        self.adjoint[root] = one();
        for i in (0..=root).rev() {
            let (operands, count) = tape.ops[i].operands();
            let above = self.adjoint[i];
            let flat = !with_slopes
                || self.adjoint_slope[i * n..(i + 1) * n]
                    .iter()
                    .all(|s| s.is_zero());
            if count == 0 || (above.is_zero() && flat) {
                continue;
            }
            for (k, a) in operands.iter().copied().enumerate().take(count) {
                let partial = self.partial[i][k];
                if !self.noisy[a] {
                    continue;
                }
                self.adjoint[a] = self.adjoint[a] + above * partial;
                if !with_slopes {
                    continue;
                }
                for j in 0..n {
                    let curve = match k {
                        2 => Interval::ZERO,
                        k => self.curve[(i * n + j) * 2 + k],
                    };
                    let add = self.adjoint_slope[i * n + j] * partial + above * curve;
                    self.adjoint_slope[a * n + j] = self.adjoint_slope[a * n + j] + add;
                }
            }
        }
    }

    /// The unit in the last place of numbers not smaller than `least` in magnitude.
    pub fn ulp(&self, least: f64) -> f64 {
        power_of_two(self.last_bit(least).max(-1074))
    }

    /// `Σ |δ_i| |∂f/∂δ_i|`, and not more than the error carried forward.
    pub fn total(&self, root: Place) -> f64 {
        let mut sum = 0.0;
        for i in 0..=root {
            sum = sum_up(sum, product_up(self.noise[i], self.adjoint[i].magnitude()));
        }
        let carried = self.error[root];
        match sum <= carried {
            true => sum,
            false if carried.is_nan() => f64::INFINITY,
            false => carried,
        }
    }
}

//! Ranges, rounding errors and derivatives of all operations of a tape over a box of inputs.
//!
//! For an input x of the box let `δ_i` be the error that operation i makes in the execution: the
//! number computed less what exact arithmetic makes of its computed operands. Multiplied by `θ` in
//! `[0, 1]` these errors lead from the exact values (`θ = 0`) to the computed ones (`θ = 1`), and
//! by the mean value theorem along this path
//!
//! ```text
//! f̂(x) − f(x) = Σ_i δ_i ∂f/∂δ_i    at some θ.
//! ```
//!
//! A [`Pass`] encloses every operation over the box twice: what the execution may give
//! ([`Pass::float`]), from which `|δ_i|` follows, and all values on the path ([`Pass::value`]),
//! over which derivatives are taken. So no term of second order is left to be added: it is in the
//! width of the path.

mod adjoint;
mod condition;
mod derivative;
mod narrowing;
mod operation;
mod solver;

pub(crate) use narrowing::Narrowing;
use operation::Ends;
pub(crate) use solver::{Solver, joined};

use super::Setting;
use super::elementary::{pi, power, range};
use super::tape::{Op, Place, Tape};
use crate::grid::{exponent, grain_of_point, power_of_two};
use crate::interval::{Interval, down, product_up, sum_up, up};
use mechaudit_symbolic::Func;

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
#[derive(Clone, Debug, Default)]
pub(crate) struct Pass {
    setting: Setting,
    /// The number of inputs.
    inputs: usize,
    /// The values that the execution may give.
    pub float: Vec<Interval>,
    /// Values on the path from exact to computed.
    pub value: Vec<Interval>,
    /// Computed values are multiples of `2^grain`.
    pub grain: Vec<i32>,
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
    /// `∂f/∂δ_i`, where there is no solver.
    pub adjoint: Vec<Interval>,
    /// Derivatives of these by the inputs.
    pub adjoint_slope: Vec<Interval>,
    /// Operations whose error counts: their own or that of an operand is not zero.
    noisy: Vec<bool>,
    /// Conditions that the box does not decide, in the order of the tape.
    pub open: Vec<usize>,
    /// Errors that operations may make elsewhere, where the path of another point is followed.
    pub given: Vec<f64>,
    /// The condition on the inputs over the box.
    pub narrowing: Option<Narrowing>,
    /// Operations whose range, or that of an operand, holds only where the condition does.
    is_narrowed: Vec<bool>,
    /// Operations whose derivatives by the inputs hold only there.
    is_bent: Vec<bool>,
    /// More of the numbers of a solver.
    pub solver: Option<Solver>,
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
            ..Pass::default()
        }
    }

    /// Returns whether a range holds only where the condition on the inputs does: then nothing is
    /// known of the way to other points.
    pub fn is_narrowed(&self) -> bool {
        self.is_narrowed.contains(&true)
    }

    /// The exponent of the last bit of numbers not smaller than `least` in magnitude.
    fn last_bit(&self, least: f64) -> i32 {
        let lowest = self.setting.lowest();
        if least == 0.0 {
            return lowest;
        }
        (exponent(least) + 1 - self.setting.bits()).max(lowest)
    }

    /// The largest error of one rounding as a part of the result.
    fn unit(&self) -> f64 {
        power_of_two(-self.setting.bits())
    }

    /// Half a unit in the last place of the largest result.
    fn half_ulp(&self, ends: Ends) -> f64 {
        let least = self.setting.lowest() - 1;
        power_of_two(self.half_exponent(ends).max(least).max(-1074))
    }

    /// Its exponent, if that is no subnormal number.
    fn half_exponent(&self, ends: Ends) -> i32 {
        let e = exponent(ends.most);
        let whole = e >= -1022 && ends.most == power_of_two(e);
        let e = if whole && !ends.beyond { e - 1 } else { e };
        e - self.setting.bits()
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
    /// does not decide, those at the end of `picks` are taken as it says: it holds the branch of
    /// the exact value.
    pub fn forward(
        &mut self,
        tape: &Tape,
        at: &[Interval],
        slopes: bool,
        picks: &[bool],
    ) -> Result<(), Stop> {
        self.clear();
        for op in &tape.ops {
            self.step(tape, *op, at, slopes, picks)?;
        }
        Ok(())
    }

    /// Begins with nothing.
    pub fn clear(&mut self) {
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
        self.is_narrowed.clear();
        self.is_bent.clear();
        if let Some(solver) = &mut self.solver {
            solver.clear();
        }
    }

    /// Computes ranges of all operations, also behind one that has no value: everything.
    pub fn forward_beyond(&mut self, tape: &Tape, at: &[Interval]) {
        self.clear();
        for op in &tape.ops {
            if self.step(tape, *op, at, false, &[]).is_err() {
                let all = Interval::ALL;
                self.push(all, all, 0.0, self.setting.lowest(), f64::INFINITY);
            }
        }
    }

    /// An operation without a rounding that is a part of its result.
    fn push(&mut self, float: Interval, value: Interval, noise: f64, grain: i32, error: f64) {
        self.push_rounded(float, value, (noise, f64::INFINITY), grain, error);
    }

    /// An operation whose error is at most the noise, and but for subnormal results a share of the
    /// exact result on the computed operands.
    ///
    /// That result is within the error of the one on the path: a result there of at least lo, not
    /// negative, is with its rounding at least `lo − share (lo + error)`, and so on.
    fn push_rounded(
        &mut self,
        float: Interval,
        value: Interval,
        (noise, share): (f64, f64),
        grain: i32,
        error: f64,
    ) {
        let given = self.given.get(self.noise.len()).copied().unwrap_or(0.0);
        let (error, share) = match given > noise {
            true => (sum_up(error, given), f64::INFINITY),
            false => (error, share),
        };
        let noise = noise.max(given);
        let least = power_of_two(self.setting.lowest());
        let reach = |end: f64| {
            let part = product_up(share, sum_up(end.abs(), sum_up(error, least)));
            noise.min(sum_up(part, least))
        };
        let value = match noise == 0.0 {
            true => value,
            false => Interval::new(
                down(value.lo - reach(value.lo)),
                up(value.hi + reach(value.hi)),
            ),
        };
        // Without any error all of the path is what is computed.
        let value = if error == 0.0 {
            value.meet(float)
        } else {
            value
        };
        // Rounding gives a multiple of the last bit of the smallest result, and keeps the grain.
        let grain = grain.max(self.last_bit(float.mignitude()));
        self.record(float, value, noise, grain, error);
    }

    fn record(&mut self, float: Interval, value: Interval, noise: f64, grain: i32, error: f64) {
        self.float.push(float);
        self.value.push(value);
        self.noise.push(noise);
        self.grain.push(grain);
        self.error.push(error);
        self.partial.push([Interval::ZERO; 3]);
        self.noisy.push(noise > 0.0);
    }

    /// Adds the result of an operation and its derivatives.
    pub fn step(
        &mut self,
        tape: &Tape,
        op: Op,
        at: &[Interval],
        slopes: bool,
        picks: &[bool],
    ) -> Result<(), Stop> {
        let lowest = self.setting.lowest();
        match op {
            Op::Add(a, b) => self.sum(op, a, b)?,
            Op::Sub(a, b) => self.sum(op, a, b)?,
            Op::Mul(a, b) => self.product(op, a, b)?,
            Op::Div(a, b) => self.quotient(op, a, b)?,
            Op::Fma(a, b, c) => self.fused(op, a, b, c)?,
            _ if self.solver.is_some() => self.unrounded(tape, op)?,
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
                        let noises = (noise, self.unit());
                        self.push_rounded(self.rounded_ends(ends), x, noises, lowest, noise);
                    }
                }
            }
            Op::Constant(real, nearest, off) => {
                let noise = off.magnitude();
                let point = Interval::point(nearest);
                if !(nearest.abs() <= self.setting.largest()) {
                    return stop("a constant overflows");
                }
                self.push(point, real, noise, grain_of_point(nearest), noise);
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
            Op::Sqrt(a) => self.root(op, a)?,
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
            Op::Plain(_) | Op::Lost(_) | Op::Near(..) => return stop("no number of a solver"),
        }
        self.link(op, slopes);
        if slopes {
            self.narrow(tape, op);
        }
        Ok(())
    }

    /// The result of a function that is off by some units in the last place.
    fn function(&mut self, exact: Interval, ulps: f64, carried: f64) -> Result<(), Stop> {
        let most = exact.magnitude();
        if !(most <= self.setting.largest()) {
            return stop("may be undefined or overflow");
        }
        let noise = match exact.is_zero() {
            true => 0.0,
            false => product_up(2.0 * ulps, self.half_ulp(Ends::at(most))),
        };
        let computed = exact.widened(noise);
        if !(computed.magnitude() <= self.setting.largest()) {
            return stop("may overflow");
        }
        let error = sum_up(carried, noise);
        let share = product_up(2.0 * ulps, self.unit()).max(self.unit());
        let lowest = self.setting.lowest();
        self.push_rounded(computed, exact, (noise, share), lowest, error);
        Ok(())
    }

    /// The unit in the last place of numbers not smaller than `least` in magnitude.
    pub fn ulp(&self, least: f64) -> f64 {
        power_of_two(self.last_bit(least).max(-1074))
    }

    /// `Σ |δ_i| |∂f/∂δ_i|`, and not more than the error carried forward.
    ///
    /// The errors of a solver's constants are known: they may cancel.
    pub fn total(&self, tape: &Tape, root: Place) -> f64 {
        let (mut sum, mut known) = (0.0, Interval::ZERO);
        for i in 0..=root {
            let noise = self.noise[i];
            let slope = self.coefficient(i);
            match tape.ops[i] {
                Op::Constant(_, _, off) => known = known + off * slope,
                _ => sum = sum_up(sum, product_up(noise, slope.magnitude())),
            }
        }
        sum = sum_up(sum, known.magnitude());
        // A power of two divides exactly but where the quotient underflows.
        let unit = self.unit_of_adjoints(root);
        sum = match sum / unit {
            exact if exact * unit == sum => exact,
            less => up(less),
        };
        let carried = self.error[root];
        match sum <= carried {
            true => sum,
            false if carried.is_nan() => f64::INFINITY,
            false => carried,
        }
    }
}

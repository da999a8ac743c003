//! A solver's numbers: what exact arithmetic gives, apart from what rounding does to it.
//!
//! An operation of a solver computes `s (m + d) + t`: m is what exact arithmetic gives, a function
//! of the inputs ([`Exact`]); s is one or the small input σ ([`Op::Plain`] multiplies it out); d is
//! at most [`Pass::error`]; and t is what underflowed, at most `2⁻¹⁰⁷⁵ tiny`. All errors and
//! derivatives are those of `m + d`.

use super::super::tape::{Op, Place, Tape};
use super::adjoint::Combination;
use super::operation::Unrounded;
use super::{Pass, Stop, stop};
use crate::exact::Exact;
use crate::grid::{TINIEST, grain_of_point, power_of_two};
use crate::interval::{Interval, product_up, quotient_up, sum_up, up};

/// The numbers of a solver as a pass knows them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver {
    /// The range of the small input, not negative.
    pub sigma: Exact,
    /// Results in exact arithmetic, divided by σ if they are small.
    pub exact: Vec<Exact>,
    /// Bounds of t in units of 2⁻¹⁰⁷⁵, what a rounding below the normal numbers may be off.
    pub tiny: Vec<f64>,
    /// Tells of which numbers σ is a factor.
    pub small: Vec<bool>,
    /// Bounds of `|d/m|` that sums of numbers of one sign keep; see [`Pass::relative`].
    pub share: Vec<f64>,
    /// The parts that operations themselves add to t.
    pub absolute: Vec<f64>,
    /// Derivatives by errors, but for what [`Op::Lost`] takes back.
    pub(super) adjoint: Vec<Exact>,
    /// Which of them are sums of others; and the derivatives by what is taken back.
    pub(super) adjoint_of: Vec<Combination>,
    pub(super) taken_of: Vec<Combination>,
    /// The operation, counted from 1, that truncates.
    pub truncates: Option<u32>,
    /// Operations that rounded.
    roundings: u32,
    /// Sums and products are not rounded.
    pub is_unrounded: bool,
}

/// `(1 + p)(1 + q) − 1`
pub(crate) fn joined(p: f64, q: f64) -> f64 {
    sum_up(sum_up(p, q), product_up(p, q))
}

/// A number that a solver's operation gives, in units of s.
struct Number {
    exact: Exact,
    noise: f64,
    error: f64,
    tiny: f64,
    small: bool,
    grain: i32,
    share: f64,
}

impl Number {
    /// A number without an error.
    fn new(exact: Exact, grain: i32) -> Number {
        Number {
            exact,
            noise: 0.0,
            error: 0.0,
            tiny: 0.0,
            small: false,
            grain,
            share: f64::INFINITY,
        }
    }
}

impl Solver {
    /// Begins with nothing.
    pub fn clear(&mut self) {
        self.exact.clear();
        self.tiny.clear();
        self.small.clear();
        self.share.clear();
        self.absolute.clear();
        (self.roundings, self.is_unrounded) = (0, false);
    }
}

impl Pass {
    fn of_solver(&self) -> &Solver {
        self.solver.as_ref().expect("a solver's tape")
    }

    /// The error as a part of the exact result: of the sum of two numbers of one sign no larger
    /// than the larger of theirs, however different their sizes are over the box.
    pub fn relative(&self, a: Place, error: f64) -> f64 {
        let s = self.of_solver();
        s.share[a].min(quotient_up(error, s.exact[a].range.mignitude()))
    }

    /// Returns whether the number is zero, without any error.
    pub fn is_zero(&self, a: Place) -> bool {
        let s = self.of_solver();
        s.exact[a].is_zero() && self.error[a] == 0.0 && s.tiny[a] == 0.0
    }

    /// The number, if it is the same all over the box.
    pub fn constant(&self, a: Place) -> Option<f64> {
        let s = self.of_solver();
        let range = s.exact[a].range;
        let alone = self.error[a] == 0.0 && s.tiny[a] == 0.0 && !s.small[a];
        (alone && range.is_point()).then_some(range.lo)
    }

    /// Adds an input, or another number without an error: any multiple of `2^grain`.
    pub fn enter(&mut self, exact: Exact, grain: i32, small: bool) {
        let number = Number {
            small,
            ..Number::new(exact, grain)
        };
        self.record_number(Interval::ALL, number);
    }

    /// The numbers that `s (m + d) + t` may be.
    fn reach(&self, exact: Exact, error: f64, small: bool, tiny: f64) -> Interval {
        let value = exact.range.widened(error);
        let value = match small {
            true => value * self.of_solver().sigma.range,
            false => value,
        };
        value.widened(product_up(tiny, TINIEST))
    }

    fn record_number(&mut self, float: Interval, n: Number) {
        let float = float.meet(self.reach(n.exact, n.error, n.small, n.tiny));
        let value = n.exact.range.widened(n.error);
        self.record(float, value, n.noise, n.grain, n.error);
        let Some(s) = &mut self.solver else { return };
        s.exact.push(n.exact);
        s.tiny.push(n.tiny);
        s.small.push(n.small);
        s.share.push(n.share);
        s.absolute.push(0.0);
    }

    /// Operations that a solver's tape has alone, or that do not round.
    pub(super) fn unrounded(&mut self, tape: &Tape, op: Op) -> Result<(), Stop> {
        let s = self.of_solver();
        let same = |a: Place| Number {
            error: self.error[a],
            tiny: s.tiny[a],
            small: s.small[a],
            share: s.share[a],
            ..Number::new(s.exact[a], self.grain[a])
        };
        let (float, number) = match op {
            Op::Constant(real, stored, off) => {
                let error = off.magnitude();
                let number = Number {
                    noise: error,
                    error,
                    ..Number::new(Exact::within(real), grain_of_point(stored))
                };
                (Interval::point(stored), number)
            }
            Op::Neg(a) => {
                let exact = -s.exact[a];
                (-self.float[a], Number { exact, ..same(a) })
            }
            Op::Abs(a) => {
                let of = |x: Interval| Interval::new(x.mignitude(), x.magnitude());
                let exact = Exact::within(Interval::new(0.0, s.exact[a].range.magnitude()));
                let share = f64::INFINITY;
                let number = Number {
                    exact,
                    share,
                    ..same(a)
                };
                (of(self.float[a]), number)
            }
            Op::Plain(a) => {
                let number = Number {
                    exact: s.exact[a] * s.sigma,
                    error: product_up(self.error[a], s.sigma.range.hi),
                    small: false,
                    ..same(a)
                };
                (self.float[a], number)
            }
            Op::Near(a, r) => {
                // A number that is not rounded: what underflowed is a part of the error now.
                let noise = sum_up(r, product_up(s.tiny[a], TINIEST));
                let number = Number {
                    noise,
                    error: sum_up(self.error[a], noise),
                    tiny: 0.0,
                    share: f64::INFINITY,
                    grain: self.setting.lowest(),
                    ..same(a)
                };
                (self.float[a].widened(r), number)
            }
            Op::Lost(a) => {
                let grain = match tape.ops[a] {
                    Op::Mul(p, q) => self.grain[p].saturating_add(self.grain[q]),
                    Op::Add(p, q) => self.grain[p].min(self.grain[q]),
                    _ => i32::MIN,
                };
                let number = Number {
                    error: self.noise[a],
                    tiny: s.absolute[a],
                    small: s.small[a],
                    ..Number::new(Exact::ZERO, grain)
                };
                (Interval::ALL, number)
            }
            _ => return stop("an operation that no solver has"),
        };
        self.record_number(float, number);
        if let Op::Lost(a) = op {
            self.noisy[self.noise.len() - 1] = self.noise[a] > 0.0;
        }
        Ok(())
    }

    /// A product in exact arithmetic.
    fn exact_product(&self, a: Place, b: Place) -> Exact {
        let exact = &self.of_solver().exact;
        let (x, y) = (exact[a], exact[b]);
        let times = |x: Exact, by: f64| {
            let by = Interval::point(by);
            let range = x.range * by;
            // Exact unless it underflows.
            let back = |p: f64, q: f64| if q / by.lo == p { q } else { f64::NAN };
            let ends = [x.range.lo, x.range.hi].map(|p| back(p, p * by.lo));
            let (lo, hi) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            let known = ends[0].is_finite() && ends[1].is_finite();
            x.scaled(by.lo, if known { Interval::new(lo, hi) } else { range })
        };
        let power = |a: Place, x: Exact| x.range.is_point() && self.power_of_two(a).is_some();
        match (power(a, x), power(b, y)) {
            _ if a == b => x.square(),
            (_, true) => times(x, y.range.lo),
            (true, _) => times(y, x.range.lo),
            _ => x * y,
        }
    }

    /// Adds the result of an operation that rounds once.
    pub(super) fn finish_of_solver(&mut self, op: Op, u: Unrounded) -> Result<(), Stop> {
        let s = self.of_solver();
        let product = |a: Place, b: Place| {
            // x y = (x − t)(y − u) + t y + u (x − t), with t and u what underflowed.
            let size = |t: f64, other: Place| {
                let rest = product_up(s.tiny[other], TINIEST);
                product_up(t, sum_up(self.float[other].magnitude(), rest))
            };
            let (p, q) = (
                self.relative(a, self.error[a]),
                self.relative(b, self.error[b]),
            );
            let tiny = sum_up(size(s.tiny[a], b), size(s.tiny[b], a));
            (
                self.exact_product(a, b),
                tiny,
                joined(p, q),
                s.small[a] | s.small[b],
            )
        };
        let sum = |x: (Exact, f64, f64), y: (Exact, f64, f64)| {
            let one_sign = x.0.range.lo >= 0.0 && y.0.range.lo >= 0.0;
            let share = if one_sign {
                x.2.max(y.2)
            } else {
                f64::INFINITY
            };
            (x.0 + y.0, sum_up(x.1, y.1), share)
        };
        let known = |a: Place| (s.exact[a], s.tiny[a], self.relative(a, self.error[a]));
        let (exact, tiny, share, small) = match op {
            Op::Add(a, b) => {
                let (exact, tiny, share) = sum(known(a), known(b));
                (exact, tiny, share, s.small[a] | s.small[b])
            }
            Op::Mul(a, b) => product(a, b),
            Op::Fma(a, b, c) => {
                let (exact, tiny, share, small) = product(a, b);
                let carried = sum_up(
                    product_up(self.value[a].magnitude(), self.error[b]),
                    product_up(self.value[b].magnitude(), self.error[a]),
                );
                let by_size = quotient_up(carried, exact.range.mignitude());
                let (exact, tiny, share) = sum((exact, tiny, share.min(by_size)), known(c));
                (exact, tiny, share, small)
            }
            Op::Div(a, b) if s.tiny[b] == 0.0 && !s.small[b] => {
                let tiny = quotient_up(s.tiny[a], self.float[b].mignitude());
                (s.exact[a].over(s.exact[b]), tiny, f64::INFINITY, s.small[a])
            }
            Op::Div(..) => return stop("a divisor may be zero"),
            _ => return stop("an operation that no solver has"),
        };
        let ends = u.ends.within(self.reach(exact, u.error, small, tiny));
        let factor = match s.truncates {
            _ if s.is_unrounded => 0.0,
            Some(k) if k == s.roundings + 1 => 2.0,
            _ => 1.0,
        };
        let rounds = factor != 0.0 && !u.is_exact && !self.is_on_grid(ends, u.grain)?;
        let (noise, absolute) = match (rounds, u.shift) {
            (false, _) => (0.0, 0.0),
            (true, Some(grain)) if grain >= -1074 || ends.least() > f64::MIN_POSITIVE => (0.0, 0.0),
            (true, Some(_)) => (0.0, factor),
            (true, None) => {
                let half = self.half_exponent(ends);
                match small {
                    false if half < -1074 => (0.0, factor),
                    false => (factor * power_of_two(half), 0.0),
                    true => self.small_rounding((exact, u.error, tiny), ends, half, factor),
                }
            }
        };
        let rounded = noise != 0.0 || absolute != 0.0;
        let share = share.min(quotient_up(u.error, exact.range.mignitude()));
        let least = match share < 0.5 && !small {
            true => 0.5 * exact.range.mignitude(),
            false => ends.least(),
        };
        let float = match factor == 1.0 {
            true => self.rounded_ends(ends),
            false => Interval::new(ends.lo.next_down(), ends.hi.next_up()),
        };
        let grain = if u.shift.is_some() {
            u.grain.max(-1074)
        } else {
            u.grain
        };
        let number = Number {
            exact,
            noise,
            error: sum_up(u.error, noise),
            tiny: sum_up(tiny, absolute),
            small,
            grain: grain.max(self.last_bit(float.mignitude())),
            share: match rounded && u.shift.is_none() {
                false => share,
                true if tiny == 0.0 && least > f64::MIN_POSITIVE => {
                    joined(share, factor * power_of_two(-53))
                }
                true => f64::INFINITY,
            },
        };
        let place = self.noise.len();
        self.record_number(float, number);
        if let Some(s) = &mut self.solver {
            s.absolute[place] = absolute;
            s.roundings += u32::from(rounded);
        }
        Ok(())
    }

    /// The error of one rounding in units of σ, and the part of it that is absolute.
    fn small_rounding(
        &self,
        (exact, error, tiny): (Exact, f64, f64),
        ends: super::Ends,
        half: i32,
        factor: f64,
    ) -> (f64, f64) {
        let sigma = self.of_solver().sigma.range;
        // Half a unit in the last place of v is at most 2⁻⁵³|v|.
        let most = exact.range.widened(error).magnitude();
        let relative = up(most * factor * power_of_two(-53));
        let by_size = match half >= -1074 && sigma.lo > 0.0 {
            true => quotient_up(factor * power_of_two(half), sigma.lo),
            false => f64::INFINITY,
        };
        if by_size <= relative {
            return (by_size, 0.0);
        }
        // At most 2⁻⁵³ (|s (v − t)| + |t|), or half the spacing of subnormal numbers.
        let of_tiny = if tiny == 0.0 {
            0.0
        } else {
            sum_up(1.0, tiny * 1e-15)
        };
        let subnormal = if ends.least() <= f64::MIN_POSITIVE {
            1.0
        } else {
            0.0
        };
        (relative, factor * sum_up(of_tiny, subnormal))
    }
}

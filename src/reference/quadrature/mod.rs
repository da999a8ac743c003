//! Certified integrals of functions that are given by an enclosure.
//!
//! The integrand is a black box, [`Integrand`]: it encloses its values on rectangles of the complex
//! plane, and says where it is proved to be holomorphic. Everything else is proved here.
//!
//! * *Finite intervals* are bisected. A panel counts as the width times an enclosure of the values
//!   where that is narrow enough (so steps, kinks and bounded singularities converge, one panel
//!   being halved each time), and else as a Gauss–Legendre rule, whose error is bounded by the
//!   greatest value on an ellipse of Bernstein around the panel; ellipse and degree are chosen to
//!   need the fewest nodes. The method is that of K. Petras, *Self-validating integration and
//!   approximation of piecewise analytic functions*, J. Comput. Appl. Math. 145 (2002) 345–359, and
//!   of F. Johansson, *Numerical integration in arbitrary-precision ball arithmetic*, ICMS 2018,
//!   LNCS 10931, 255–263; the error bound is that of P. Rabinowitz, *Math. Comp.* 23 (1969)
//!   765–768, in the form of L. N. Trefethen, *Approximation Theory and Approximation Practice*,
//!   2013, Thm 19.3.
//! * *Singular and infinite ends* are cut off where a proved bound on the integrand ([`Growth`])
//!   makes the rest negligible; the rest widens the result. The panels next to the end are laid out
//!   in geometric progression. Up to an end next to which the integrand is a sum of [`Waves`], they
//!   are integrated along lines in the complex plane on which they decay.
//! * An integral that does not reach its goal says where ([`Hindrance`]). Its ball holds the
//!   integral nevertheless.

mod adaptive;
mod bounds;
mod germ;
mod growth;
mod improper;
mod nodes;
mod oscillation;
mod series;

pub use adaptive::Crossing;
pub use germ::Germ;
pub use growth::Growth;
pub use oscillation::{Sector, Waves};

use crate::{Ball, Ball128, Complex128, ComplexBall, Mag};
use adaptive::{Budget, Path, Tolerance, Value, adaptive};
use rug::Float;
use std::fmt;

/// A function that can be enclosed.
pub trait Integrand {
    /// Encloses the values on a rectangle, or gives none where that is not decided.
    ///
    /// With `holomorphic` an answer means a proof that the function is holomorphic on the whole
    /// closed rectangle: it holds no cut, no pole and no jump of a step. Without it an enclosure of
    /// the values at the points of the rectangle where the function is defined by its formula
    /// suffices, and none is given unless it is defined at all of them.
    fn enclose(&mut self, z: &ComplexBall, holomorphic: bool, bits: u32) -> Option<ComplexBall>;

    /// Encloses the values on a real interval, all of them real.
    fn enclose_real(&mut self, x: &Ball, bits: u32) -> Option<Ball> {
        let z = ComplexBall::new(x.clone(), Ball::integer(bits, 0));
        let value = self.enclose(&z, false, bits)?;
        value.im.is_zero().then_some(value.re)
    }

    /// Encloses the value at a number in machine words, where these decide.
    fn enclose_short(&mut self, _: &Ball128) -> Option<Ball128> {
        None
    }

    /// Encloses the complex value at a real number in machine words, where these decide.
    fn enclose_short_complex(&mut self, _: &Ball128) -> Option<Complex128> {
        None
    }

    /// Returns true if there are choices, such as the sign under an absolute value or a step, that
    /// [`Integrand::is_settled`] tells of.
    fn has_choices(&mut self) -> bool {
        false
    }

    /// Returns true if every choice is proved to be the same at all numbers of a real interval.
    fn is_settled(&mut self, _: &Ball) -> bool {
        false
    }

    /// Guesses where between two real numbers choices change. Nothing is proved by it.
    fn crossing(&mut self, _between: [&Ball; 2]) -> Option<Crossing> {
        None
    }

    /// Encloses on a rectangle the function that the choices made at a real number continue to, where
    /// it is holomorphic.
    fn enclose_chosen(&mut self, _at: &Ball, _z: &ComplexBall, _bits: u32) -> Option<ComplexBall> {
        None
    }

    /// Bounds the absolute value next to an end where [`Integrand::enclose_real`] fails or that is
    /// infinite, for all distances `0 < s ≤ 2^−k` (all `|x| ≥ 2^k` at infinity). None where no
    /// bound is proved.
    fn growth(&mut self, end: &End, k: u32) -> Option<Growth> {
        let _ = (end, k);
        None
    }

    /// The waves of which the integrand is the sum next to an end, if it oscillates there.
    fn waves(&mut self, _: &End) -> Option<Box<dyn Waves>> {
        None
    }
}

/// An end of an interval and the side on which the interval lies.
#[derive(Clone, Debug)]
pub enum End {
    /// The interval begins here: `x = a + s`.
    Above(Ball),
    /// The interval ends here: `x = a − s`.
    Below(Ball),
    /// `x = 1/s`.
    PlusInfinity,
    /// `x = −1/s`.
    MinusInfinity,
}

/// A limit of integration.
#[derive(Clone, Debug)]
pub enum Limit {
    /// Less than every number.
    MinusInfinity,
    /// A number.
    Finite(Ball),
    /// More than every number.
    PlusInfinity,
}

/// The accuracy asked for, and the work allowed.
#[derive(Clone, Debug)]
pub struct Goal {
    /// A radius of `2^−bits` times the absolute value is enough.
    pub bits: u32,
    /// This radius is enough as well. It may be zero.
    pub absolute: Mag,
    /// Evaluations of the integrand before it is given up.
    pub evaluations: u64,
}

impl Goal {
    /// Asks for `bits` bits of the value, or `bits` places after the binary point if that is less.
    pub fn bits(bits: u32) -> Goal {
        let absolute = Mag::power_of_two(-i64::from(bits));
        Goal {
            bits,
            absolute,
            evaluations: 1 << 20,
        }
    }

    /// Asks for `digits` decimal digits.
    pub fn digits(digits: u32) -> Goal {
        Goal::bits((f64::from(digits) * std::f64::consts::LOG2_10).ceil() as u32 + 1)
    }

    /// The radius that suffices for a value.
    fn radius(&self, least: Mag) -> Mag {
        self.absolute.max(least.shift(-i64::from(self.bits)))
    }
}

/// The reason why an integral did not reach its goal, and where.
#[derive(Clone, Debug, PartialEq)]
pub enum Hindrance {
    /// The evaluations allowed did not suffice: the worst interval left, of x or of the parameter
    /// of a segment.
    Interval(Float, Float),
    /// No bound on the integrand at an end is proved, or it is not integrable there.
    End(&'static str),
    /// The sum of the parts is less accurate than its goal.
    Accuracy,
}

impl fmt::Display for Hindrance {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Hindrance::Interval(a, b) => {
                write!(
                    f,
                    "between {:.17e} and {:.17e} the integrand is not enclosed well enough",
                    a, b
                )
            }
            Hindrance::End(end) => {
                write!(f, "no integrable bound on the integrand is proved at {end}")
            }
            Hindrance::Accuracy => write!(f, "the parts cancel beyond the accuracy allowed"),
        }
    }
}

/// An integral: a ball that holds it, and what hindered it from reaching its goal.
#[derive(Clone, Debug)]
pub struct Integral<V> {
    /// Holds the integral, if it is known at all.
    pub value: Option<V>,
    /// Why the goal is not reached.
    pub hindrance: Option<Hindrance>,
    /// Evaluations of the integrand.
    pub evaluations: u64,
}

/// The integral of a real function along the real line; the limits may be infinite, and the
/// function singular there.
pub fn integrate(f: &mut dyn Integrand, from: &Limit, to: &Limit, goal: &Goal) -> Integral<Ball> {
    repeated(goal, |run| improper::integral(f, from, to, run))
}

/// The integral along the straight line between two points of the complex plane.
pub fn integrate_segment(
    f: &mut dyn Integrand,
    from: &ComplexBall,
    to: &ComplexBall,
    goal: &Goal,
) -> Integral<ComplexBall> {
    repeated(goal, |run| {
        let mut path = Segment {
            f,
            origin: from.clone(),
            direction: to - from,
        };
        let breaks = [0, 1].map(|t| Float::with_val(64, t));
        let sum = adaptive(&mut path, &breaks, &mut run.tolerance, &mut run.budget);
        run.hinder(sum.hindered);
        sum.value
    })
}

/// Bits by which the error of a panel lies below the radius asked for: room for as many panels.
const ROOM: i64 = 8;

/// The budget of a run of an integral, and its result so far.
struct Run {
    tolerance: Tolerance,
    budget: Budget,
    /// The error that may be made at an end.
    tail: Mag,
    hindrance: Option<Hindrance>,
}

impl Run {
    fn hinder(&mut self, at: Option<(Float, Float)>) {
        if let (None, Some((a, b))) = (&self.hindrance, at) {
            self.hindrance = Some(Hindrance::Interval(a, b));
        }
    }
}

/// Runs until the goal is reached: it depends on the value, which the first run finds.
fn repeated<V: Value>(goal: &Goal, mut run: impl FnMut(&mut Run) -> Option<V>) -> Integral<V> {
    const RUNS: usize = 4;
    let relative = i64::from(goal.bits) + ROOM;
    let mut spent = 0;
    // The first run takes the value for about 1.
    let mut radius = goal.radius(Mag::from_f64(1.0));
    let mut panel = goal.absolute.shift(-ROOM);
    let mut room = relative;
    let mut result = Integral {
        value: None,
        hindrance: None,
        evaluations: 0,
    };
    for _ in 0..RUNS {
        let mut now = Run {
            tolerance: Tolerance {
                now: panel,
                relative: room,
            },
            budget: Budget {
                spent,
                limit: goal.evaluations,
                words: 0,
            },
            tail: radius.shift(-3),
            hindrance: None,
        };
        let value = run(&mut now);
        spent = now.budget.spent;
        let stopped = now.hindrance.is_some();
        result = Integral {
            value,
            hindrance: now.hindrance,
            evaluations: spent,
        };
        let Some(value) = &result.value else { break };
        let due = goal.radius(value.mignitude());
        let found = value.radius();
        if found <= due {
            result.hindrance = None;
            break;
        }
        if stopped || spent >= goal.evaluations {
            result.hindrance.get_or_insert(Hindrance::Accuracy);
            break;
        }
        result.hindrance = Some(Hindrance::Accuracy);
        // A value about zero may be as small as the radius.
        let due = if due.is_zero() {
            found.shift(-relative)
        } else {
            due
        };
        radius = due;
        let short = found.exponent().unwrap_or(0) - due.exponent().unwrap_or(0);
        // From now on the error of a panel is absolute.
        panel = due.shift(-ROOM - 4);
        room += short + 4;
    }
    result
}

/// The line `origin + t · direction`, times the direction.
struct Segment<'a> {
    f: &'a mut dyn Integrand,
    origin: ComplexBall,
    direction: ComplexBall,
}

impl Path for Segment<'_> {
    type Value = ComplexBall;
    const MIRRORS: bool = false;

    fn value(&mut self, t: &Ball, bits: u32) -> Option<ComplexBall> {
        let z = &self.origin + &self.direction.scaled(t);
        let value = self.f.enclose(&z, false, bits)?;
        Some(&value * &self.direction)
    }

    fn short_sum(&mut self, rule: &nodes::Rule, around: [&Ball; 2]) -> Option<ComplexBall> {
        if !self.origin.im.is_zero() || !self.direction.im.is_zero() {
            return None;
        }
        let [origin, direction] = [&self.origin.re, &self.direction.re].map(Ball128::of_ball);
        let (origin, direction) = (origin?, direction?);
        rule.short_sum(around, |t| {
            let x = origin.add(&direction.mul(t)?)?;
            self.f.enclose_short_complex(&x)?.scaled(&direction)
        })
    }

    fn bound(&mut self, t: &ComplexBall, bits: u32) -> Option<Mag> {
        let z = &self.origin + &(&self.direction * t);
        let value = self.f.enclose(&z, true, bits)?;
        Some(value.magnitude().mul(self.direction.magnitude()))
    }
}

#[cfg(test)]
mod tests;

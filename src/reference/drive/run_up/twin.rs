//! An explicit Runge–Kutta method along given steps, without its rounding.
//!
//! The answer of a program that takes those steps differs from this by rounding alone, and this
//! differs from the motion by the truncation of the method alone.
//!
//! # Proof
//! The coefficients of the equation are Taylor models `f = P + ρ`, `|ρ| ≤ rad`. A step is taken
//! from an exactly known point z in balls; its midpoint, a floating-point vector, is the next point
//! and its radius δ bounds what that step adds. What is left from the steps before, `|y − z| ≤ e`,
//! goes on by the mean value theorem,
//!
//! ```text
//! e' = sup |∂Φ/∂y| e + δ      over the box z ± e,
//! ```
//!
//! in which Φ is the step as a function of the starting point with the values of ρ **held at those
//! met on the way from y**: numbers within the models' bounds, so that derivatives of P alone are
//! needed. Where a stage may lie in one of two panels, P jumps by no more than both radii, and the
//! jump counts as a part of ρ.

use super::coefficients::Coefficients;
use super::integrate::Run;
use super::linkage_panel::Panel;
use super::motor::Characteristic;
use crate::taylor_model::TaylorModel;
use crate::{Ball, Mag, Undecided};
use rug::{Float, Integer};

/// An explicit Runge–Kutta method for an equation that does not contain the time.
///
/// ```text
/// k_i = f(y + h Σ_{j<i} a_ij k_j)      y' = y + h Σ b_i k_i
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RungeKutta {
    /// `a[i][j]` for `j < i`.
    pub a: Vec<Vec<f64>>,
    /// `b[i]`.
    pub b: Vec<f64>,
}

/// One step of a method, between two moments in seconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg<'a> {
    /// The method.
    pub method: &'a RungeKutta,
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
}

/// Crank angle and speed after steps of Runge–Kutta methods from the start of `run`.
///
/// Coefficients, steps and starting values are taken as they are, exactly.
///
/// ```
/// use mechaudit_reference::class_iii::ExactAngle;
/// use mechaudit_reference::run_up::{Coefficients, Leg, Motor, Run, RungeKutta, follow_steps};
/// use rug::Rational;
/// let q = |a, b| Rational::from((a, b));
/// // 3 N·m on 2 kg m² from rest: the midpoint rule is exact.
/// let model = Coefficients::constant(&q(2, 1), &q(0, 1), 128);
/// let run = Run {
///     motor: Motor::Constant { torque: q(3, 1) },
///     rotor_inertia: q(0, 1),
///     angle: ExactAngle::Radians(q(0, 1)),
///     speed: q(0, 1),
/// };
/// let method = RungeKutta { a: vec![vec![], vec![0.5]], b: vec![0.0, 1.0] };
/// let leg = |from, to| Leg { method: &method, from, to };
/// let [angle, speed] = follow_steps(&model, &run, &[leg(0.0, 0.5), leg(0.5, 2.0)])?;
/// assert!(angle.contains(&q(3, 1)) && speed.contains(&q(3, 1)));
/// # Ok::<(), mechaudit_reference::Undecided>(())
/// ```
///
/// # Errors
/// [`Undecided`]: numbers that are no motor, a linkage that cannot be followed, an inertia that
/// cannot be told from zero, an error that outgrew the precision.
pub fn follow_steps(model: &Coefficients, run: &Run, legs: &[Leg]) -> Result<[Ball; 2], Undecided> {
    let bits = model.bits();
    let start = [run.angle.to_ball(bits), Ball::rational(bits, &run.speed)];
    follow_from(model, run, start, legs)
}

/// [`follow_steps`] from any point of a box.
pub(super) fn follow_from(
    model: &Coefficients,
    run: &Run,
    start: [Ball; 2],
    legs: &[Leg],
) -> Result<[Ball; 2], Undecided> {
    let bits = model.bits();
    let undecided = |reason: &str| Undecided::new(bits, reason);
    if let Some(fault) = run.motor.fault() {
        return Err(undecided(fault));
    }
    let system = System {
        model,
        motor: run.motor.at(bits),
        rotor: Ball::rational(bits, &run.rotor_inertia),
    };
    let mut error = [start[0].rad(), start[1].rad()];
    let mut point = start.map(|b| b.mid().clone());
    for leg in legs {
        let step = system.step(leg, &point, error)?;
        error = step.error;
        if !error.iter().all(|e| e.is_finite()) {
            return Err(undecided("the error of the steps outgrows the precision"));
        }
        point = step.point;
    }
    let [angle, speed] = point;
    Ok([Ball::new(angle, error[0]), Ball::new(speed, error[1])])
}

/// A quantity at a point, over the box about it, and its derivatives with respect to the start of
/// the step over that box.
#[derive(Clone)]
struct Spread {
    at: Ball,
    over: Ball,
    rate: [Ball; 2],
}

impl Spread {
    /// `self + factor · other`.
    fn plus(&self, factor: &Ball, other: &Spread) -> Spread {
        let sum = |x: &Ball, y: &Ball| x + &(factor * y);
        Spread {
            at: sum(&self.at, &other.at),
            over: sum(&self.over, &other.over),
            rate: [0, 1].map(|k| sum(&self.rate[k], &other.rate[k])),
        }
    }
}

/// A coefficient at a point, over a range, and the slope of its polynomials over the range.
struct Coefficient {
    at: Ball,
    over: Ball,
    slope: Ball,
}

struct Step {
    point: [Float; 2],
    error: [Mag; 2],
}

struct System<'a> {
    model: &'a Coefficients,
    motor: Characteristic,
    rotor: Ball,
}

impl System<'_> {
    fn step(&self, leg: &Leg, point: &[Float; 2], error: [Mag; 2]) -> Result<Step, Undecided> {
        let bits = self.model.bits();
        let unit = |k: usize, i: usize| Ball::integer(bits, i64::from(k == i));
        let start: [Spread; 2] = std::array::from_fn(|i| Spread {
            at: Ball::new(point[i].clone(), Mag::ZERO),
            over: Ball::new(point[i].clone(), error[i]),
            rate: [unit(0, i), unit(1, i)],
        });
        let h = Ball::exact(bits, leg.to) - Ball::exact(bits, leg.from);
        let mut rates: Vec<[Spread; 2]> = Vec::with_capacity(leg.method.b.len());
        let combined = |weights: &[f64], rates: &[[Spread; 2]]| {
            let mut y = start.clone();
            for (w, k) in weights.iter().zip(rates).filter(|(w, _)| **w != 0.0) {
                let factor = &h * &Ball::exact(bits, *w);
                for (y, k) in y.iter_mut().zip(k) {
                    *y = y.plus(&factor, k);
                }
            }
            y
        };
        for row in &leg.method.a {
            let stage = combined(row, &rates);
            rates.push(self.right_hand_side(&stage)?);
        }
        let end = combined(&leg.method.b, &rates);
        #[cfg(test)]
        let error = match planted::FORGET_EARLIER.get() {
            true => [Mag::ZERO; 2],
            false => error,
        };
        Ok(Step {
            error: [0, 1].map(|i| {
                let carried = [0, 1].map(|k| end[i].rate[k].magnitude().mul(error[k]));
                carried[0].add(carried[1]).add(end[i].at.rad())
            }),
            point: end.map(|y| y.at.mid().clone()),
        })
    }

    /// `(ψ, (M_d(ψ) + M_o − ½ψ² S)/(I_n + I_1))`.
    fn right_hand_side(&self, [phi, psi]: &[Spread; 2]) -> Result<[Spread; 2], Undecided> {
        let [inertia, slope, moment] = self.model.over(&phi.at, &phi.over)?;
        let acceleration = |psi: &Ball, i: &Ball, s: &Ball, m: &Ball| {
            let torque = self.motor.torque(psi) + m - (psi.square() * s).shift(-1);
            torque / (i + &self.rotor)
        };
        let at = acceleration(&psi.at, &inertia.at, &slope.at, &moment.at);
        let over = acceleration(&psi.over, &inertia.over, &slope.over, &moment.over);
        let total = (&inertia.over + &self.rotor).recip();
        let by_phi = &total
            * &(&moment.slope
                - &(psi.over.square() * &slope.slope).shift(-1)
                - &over * &inertia.slope);
        let by_psi = &total * &(self.motor.slope(&psi.over) - &psi.over * &slope.over);
        let rate = [0, 1].map(|k| &by_phi * &phi.rate[k] + &by_psi * &psi.rate[k]);
        Ok([psi.clone(), Spread { at, over, rate }])
    }
}

impl Coefficients {
    /// I_n, S and M_o at the crank angle `at`, which lies in `over`.
    fn over(&self, at: &Ball, over: &Ball) -> Result<[Coefficient; 3], Undecided> {
        let [at, over] = [at, over].map(|phi| self.place_of(phi));
        let index = |x: Float| x.to_integer_round(rug::float::Round::Down);
        let whole = |x: Float| {
            index(x)
                .and_then(|(i, _): (Integer, _)| i.to_i64())
                .ok_or_else(|| Undecided::new(self.bits, "the crank angle is too large"))
        };
        let (first, last) = (whole(over.lower())?, whole(over.upper())?);
        if last - first > 1 {
            return Err(Undecided::new(
                self.bits,
                "the error of the steps outgrows a panel",
            ));
        }
        let per_radian = self.half_width().recip();
        let panels = (first..=last).map(|i| Ok((i, self.panel(i)?)));
        let panels: Vec<_> = panels.collect::<Result<_, Undecided>>()?;
        let one = |model: &dyn Fn(&Panel) -> &TaylorModel| {
            let mut found: Option<Coefficient> = None;
            let mut jump = Mag::ZERO;
            for (i, panel) in &panels {
                let f = model(panel);
                let derivative = f.derivative(Mag::ZERO);
                jump = jump.add(f.rad()).add(f.rad());
                // A place that the other panel holds leaves the end of this one.
                let x = |place: &Ball| within((place - &Ball::integer(self.bits, *i)).shift(1));
                let part = Coefficient {
                    at: f.eval(&x(&at)),
                    over: f.eval(&x(&over)),
                    slope: derivative.eval(&x(&over)) * &per_radian,
                };
                found = Some(match found {
                    None => part,
                    Some(before) => Coefficient {
                        at: before.at.union(&part.at),
                        over: before.over.union(&part.over),
                        slope: before.slope.union(&part.slope),
                    },
                });
            }
            let mut found = found.expect("one panel at least");
            if panels.len() > 1 {
                found.at = found.at.widened(jump);
                found.over = found.over.widened(jump);
            }
            found
        };
        Ok([
            one(&|p| &p.inertia),
            one(&|p| &p.slope),
            one(&|p| &p.moment),
        ])
    }
}

/// `2 (place − index) − 1` from `2 (place − index)`, cut to −1 … 1.
fn within(double: Ball) -> Ball {
    let x = double - Ball::integer(64, 1);
    let (low, high) = (x.lower(), x.upper());
    if low >= -1 && high <= 1 {
        return x;
    }
    let clamp = |v: Float| v.clamp(&-1, &1);
    Ball::between(x.prec(), &clamp(low), &clamp(high))
}

#[cfg(test)]
pub(super) mod planted {
    use std::cell::Cell;
    thread_local! {
        /// The contributions of earlier steps are dropped.
        pub static FORGET_EARLIER: Cell<bool> = const { Cell::new(false) };
    }
}

#[cfg(test)]
mod tests;

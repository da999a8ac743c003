//! Integration from the start to the requested times.

use super::coefficients::Coefficients;
use super::motor::Motor;
use super::piece::Piece;
use super::setting::Setting;
use super::step::{GRID, Start, step};
use crate::class_iii::ExactAngle;
use crate::{Ball, Mag, Undecided};
use rug::{Float, Rational};

/// A run: what drives the crank, and from where.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The motor.
    pub motor: Motor,
    /// I_1 ≥ 0 in kg·m²: rotor, gears and flywheel, reduced to the crank.
    pub rotor_inertia: Rational,
    /// Crank angle at time 0.
    pub angle: ExactAngle,
    /// Speed of the crank at time 0 in rad/s, of any sign or zero.
    pub speed: Rational,
}

/// The motion at one time.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Time in seconds.
    pub time: Rational,
    /// Crank angle in radians, counted through the turns.
    pub angle: Ball,
    /// Speed of the crank in rad/s.
    pub speed: Ball,
}

impl Sample {
    /// Returns the hull of both, of the same time.
    fn union(&self, other: &Sample) -> Sample {
        Sample {
            time: self.time.clone(),
            angle: self.angle.union(&other.angle),
            speed: self.speed.union(&other.speed),
        }
    }
}

/// A proved motion.
#[derive(Clone, Debug)]
pub struct Motion {
    /// At the times asked for.
    pub samples: Vec<Sample>,
    /// Steps taken.
    pub steps: usize,
    /// Degree of the Taylor polynomials.
    pub order: usize,
    /// Largest radius of the speed at the end of any step.
    pub largest_radius: Mag,
}

/// Steps after which a run is given up.
const MOST_STEPS: usize = 200_000;
/// Longest step, in half-widths of a panel.
const LONGEST: f64 = 1.0;

/// The motion of `run` at `times` (seconds, not negative, increasing), enclosed.
///
/// The run may start from rest, and forward or backward; it must not stop later on.
///
/// # Errors
/// [`Undecided`] when a bound cannot be shown at this precision: the crank comes to a stop, the
/// linkage cannot be followed, I_n + I_1 or the starting torque cannot be told from zero, numbers
/// that are no motor, times that do not increase.
pub fn integrate(model: &Coefficients, run: &Run, times: &[Rational]) -> Result<Motion, Undecided> {
    integrate_with(model, run, times, order_for(model.bits))
}

/// The degree that costs least per radian where the step is limited by the radius of convergence
/// is `½ ln 2` times the bits; stiff stretches want more.
fn order_for(bits: u32) -> usize {
    (f64::from(bits) * 0.45) as usize + 4
}

/// [`integrate`] with Taylor polynomials of the given degree.
///
/// # Errors
/// As [`integrate`].
pub fn integrate_with(
    model: &Coefficients,
    run: &Run,
    times: &[Rational],
    order: usize,
) -> Result<Motion, Undecided> {
    integrate_within(model, run, times, order, MOST_STEPS)
}

/// [`integrate_with`] in `most_steps` steps at most.
pub(super) fn integrate_within(
    model: &Coefficients,
    run: &Run,
    times: &[Rational],
    order: usize,
    most_steps: usize,
) -> Result<Motion, Undecided> {
    let bits = model.bits;
    let undecided = |reason: &str| Undecided::new(bits, reason);
    if let Some(fault) = run.motor.fault() {
        return Err(undecided(fault));
    }
    if run.rotor_inertia < 0 {
        return Err(undecided("I_1 must not be negative"));
    }
    if times.first().is_some_and(|t| *t < 0) || times.windows(2).any(|w| w[0] >= w[1]) {
        return Err(undecided(
            "the times must not be negative and must increase",
        ));
    }
    let mut walk = Walk::new(model, run, order)?;
    let mut samples = Vec::with_capacity(times.len());
    let mut pending = times;
    if let [first, rest @ ..] = pending
        && *first == 0
    {
        samples.push(Sample {
            time: first.clone(),
            angle: run.angle.to_ball(bits),
            speed: Ball::rational(bits, &run.speed),
        });
        pending = rest;
    }
    let (mut steps, mut largest_radius) = (0, Mag::ZERO);
    // Times that may lie on either side of the end of a step are read from both steps: the first of
    // those pending.
    let mut earlier: Vec<Sample> = Vec::new();
    while !pending.is_empty() {
        if steps == most_steps {
            return Err(undecided("too many steps"));
        }
        let piece = walk.step()?;
        let end = &walk.time + &piece.duration;
        let (mut done, mut open) = (0, Vec::new());
        for (k, time) in pending.iter().enumerate() {
            let t = Ball::rational(bits, time);
            let left = &end - &t;
            if left.is_negative() {
                break;
            }
            let sample = walk.sample(&piece, time, &t);
            let sample = match earlier.get(k) {
                Some(before) => before.union(&sample),
                None => sample,
            };
            if left.is_positive() && open.is_empty() {
                samples.push(sample);
                done += 1;
            } else {
                open.push(sample);
            }
        }
        open.extend(earlier.drain(..).skip(done + open.len()));
        earlier = open;
        pending = &pending[done..];
        steps += 1;
        largest_radius = largest_radius.max(piece.speed.rad());
        walk.advance(piece, end);
    }
    Ok(Motion {
        samples,
        steps,
        order,
        largest_radius,
    })
}

/// The state between two steps.
pub(super) struct Walk<'a> {
    model: &'a Coefficients,
    set: Setting,
    index: i64,
    here: Start,
    time: Ball,
}

impl Walk<'_> {
    pub(super) fn new<'a>(
        model: &'a Coefficients,
        run: &Run,
        order: usize,
    ) -> Result<Walk<'a>, Undecided> {
        let bits = model.bits;
        let undecided = |reason: &str| Undecided::new(bits, reason);
        let place = model.place(&run.angle);
        let below = place.lower().floor();
        let exact = place.rad().is_zero() && place.mid().is_integer();
        if !exact && below != place.upper().floor() {
            return Err(undecided(
                "the start cannot be told from the end of a panel",
            ));
        }
        let mut index = below
            .to_integer()
            .and_then(|i| i.to_i64())
            .ok_or_else(|| undecided("the start angle is too large"))?;
        let inside = (&place - &Ball::integer(bits, index)).shift(1) - Ball::integer(bits, 1);
        let mut x = inside.mid().clone();
        let motor = run.motor.at(bits);
        let rotor = Ball::rational(bits, &run.rotor_inertia);
        let backward = if run.speed == 0 {
            let panel = model.panel(index)?;
            let moment = panel.moment.eval(&inside);
            let force = moment + motor.torque(&Ball::integer(bits, 0));
            if !force.is_positive() && !force.is_negative() {
                return Err(undecided(
                    "the torque at the start cannot be told from zero",
                ));
            }
            force.is_negative()
        } else {
            run.speed < 0
        };
        if backward && exact {
            index -= 1;
            x += 2;
        }
        let speed = Ball::rational(bits, &run.speed).abs();
        Ok(Walk {
            model,
            set: Setting {
                bits,
                order,
                half_width: model.half_width(),
                rotor,
                motor: if backward { motor.reversed() } else { motor },
                backward,
            },
            index,
            here: Start {
                x,
                slack: inside.rad(),
                speed: (run.speed != 0).then_some(speed),
            },
            time: Ball::integer(bits, 0),
        })
    }

    /// A proved step: as long as it can be, shorter where the proof fails.
    pub(super) fn step(&self) -> Result<Piece, Undecided> {
        let panel = self.model.panel(self.index)?;
        let limit = Float::with_val(64, if self.set.backward { -1 } else { 1 });
        let mut longest = LONGEST;
        let mut reason = "";
        for _ in 0..GRID {
            match step(&self.set, &panel, &self.here, &limit, longest) {
                Ok(piece) => return Ok(piece),
                Err(why) => reason = why,
            }
            longest *= 0.5;
        }
        Err(Undecided::new(
            self.set.bits,
            format!("at t = {:.6} s: {reason}", self.time.to_f64()),
        ))
    }

    /// The motion at a time within a step.
    fn sample(&self, piece: &Piece, time: &Rational, t: &Ball) -> Sample {
        let (x, speed) = piece.at(&(t - &self.time));
        Sample {
            time: time.clone(),
            angle: self.angle(&x),
            speed: if self.set.backward { -speed } else { speed },
        }
    }

    fn angle(&self, x: &Ball) -> Ball {
        let bits = self.set.bits;
        let halves = Ball::integer(bits, 2 * self.index + 1) + x;
        self.model.offset.to_ball(bits) + halves * &self.set.half_width
    }

    pub(super) fn advance(&mut self, piece: Piece, end: Ball) {
        let forward = !self.set.backward;
        let mut x = piece.x1;
        if x == 1 && forward {
            self.index += 1;
            x = Float::with_val(64, -1);
        } else if x == -1 && !forward {
            self.index -= 1;
            x = Float::with_val(64, 1);
        }
        self.here = Start {
            x,
            slack: Mag::ZERO,
            speed: Some(piece.speed),
        };
        self.time = end;
    }
}

/// Starts that no run has, for tests of what a step does with them.
#[cfg(test)]
impl Walk<'_> {
    /// The speed is known to a radius only.
    pub(super) fn uncertain(&mut self, radius: Mag) {
        self.here.speed = self.here.speed.as_ref().map(|v| v.widened(radius));
    }

    /// The place is known to a slack only.
    pub(super) fn displaced(&mut self, slack: Mag) {
        self.here.slack = self.here.slack.add(slack);
    }

    /// Another place.
    pub(super) fn moved(&mut self, by: &Float) {
        let bits = self.here.x.prec().max(by.prec()) + 64;
        self.here.x = Float::with_val(bits, &self.here.x + by);
    }

    /// Speed and time at the place `x` of this panel, in as many steps as it takes.
    pub(super) fn state_at(mut self, x: &Float) -> Result<(Ball, Ball), Undecided> {
        loop {
            let panel = self.model.panel(self.index)?;
            let piece = step(&self.set, &panel, &self.here, x, LONGEST)
                .map_err(|reason| Undecided::new(self.set.bits, reason))?;
            let end = &self.time + &piece.duration;
            if piece.x1 == *x {
                return Ok((piece.speed, end));
            }
            self.advance(piece, end);
        }
    }
}

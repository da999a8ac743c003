//! Run-up and run-down: the motion over time, what happens on the way, and how it ends.

use super::crossing::{Limits, Pause};
use super::equation::{Equation, EquationError};
use super::integrate::{Counts, Integrator, Stuck};
use super::motion::{Event, EventKind, Motion, Outcome, Plan, RunError, Sample, Turn};
use super::record::Stretch;
use super::stepper::{PHI, PSI, WORK};
use super::timed::TimedTorque;
use std::f64::consts::TAU;

/// The largest number of events that are kept.
const MOST_EVENTS: usize = 1_000_000;

impl<'a> Integrator<'a> {
    pub(super) fn error(&self, stuck: Stuck) -> RunError {
        let t = self.t;
        match stuck {
            Stuck::Equation(source) => RunError::Equation { t, source },
            Stuck::Budget => {
                let steps = self.counts.steps + self.counts.rejected;
                match self.stiff_from() {
                    Some(from) => RunError::Stiff { t, steps, from },
                    None => RunError::Budget { t, steps },
                }
            }
            Stuck::Method(reason) => RunError::Method { t, reason },
        }
    }
}

/// Where a crank angle repeats with each turn: the neighbours of `phi` among `angles + 2πk`.
///
/// An angle within rounding of `phi` counts as `phi` itself.
pub(super) fn neighbours(angles: &[f64], phi: f64) -> (f64, f64) {
    let mut near = (f64::NEG_INFINITY, f64::INFINITY);
    let here = 1e-12 * (1.0 + phi.abs());
    for &a in angles {
        let below = a + TAU * ((phi - a) / TAU).floor();
        // One more on either side: the floor may be off by one beside a whole number.
        for k in [-1.0, 0.0, 1.0, 2.0] {
            let x = below + k * TAU;
            if x < phi - here {
                near.0 = near.0.max(x);
            } else if x > phi + here {
                near.1 = near.1.min(x);
            }
        }
    }
    near
}

/// The neighbours of `psi` among the speeds.
fn between(speeds: &[f64], psi: f64) -> (f64, f64) {
    let here = 1e-14 * psi.abs();
    let below = speeds.iter().copied().filter(|s| *s < psi - here);
    let above = speeds.iter().copied().filter(|s| *s > psi + here);
    (
        below.fold(f64::NEG_INFINITY, f64::max),
        above.fold(f64::INFINITY, f64::min),
    )
}

fn sample(
    equation: &Equation,
    t: f64,
    y: &[f64; 6],
    sign: f64,
    start_energy: f64,
) -> Result<Sample, EquationError> {
    let f = equation.forces_at(t, y[PHI], y[PSI], sign)?;
    let kinetic_energy = 0.5 * f.inertia * y[PSI] * y[PSI];
    let work = WORK.map(|i| y[i]);
    Ok(Sample {
        t,
        phi: y[PHI],
        psi: y[PSI],
        acceleration: f.acceleration,
        inertia: f.inertia,
        motor: f.motor,
        weights: f.linkage.moment,
        resistance: f.resistance,
        kinetic_energy,
        work,
        balance: kinetic_energy - start_energy - (work[0] + work[1] + work[2]),
    })
}

/// The direction in which a crank at rest goes, that of the torque; `Err` with the torque where it
/// stays.
fn from_rest(equation: &Equation, t: f64, phi: f64) -> Result<Result<f64, f64>, EquationError> {
    // No resistance at rest but its constant part, which is compared below.
    let f = equation.forces_at(t, phi, 0.0, 0.0)?;
    let torque = f.motor + f.linkage.moment;
    let held = torque.abs() <= equation.drive().resistance().constant.n_m();
    let sign = torque.signum();
    // A table of speeds may end at standstill.
    let drive = equation.drive();
    let known = drive.motor().is_known_beside_rest(sign * drive.ratio());
    Ok(match held || !known {
        true => Err(torque),
        false => Ok(sign),
    })
}

/// The direction in which the crank starts: that of its speed, else that of the torque. `Err` with
/// the torque where it cannot start.
fn direction(equation: &Equation, plan: &Plan) -> Result<Result<f64, f64>, EquationError> {
    let f = equation.forces(plan.phi, plan.psi, 0.0)?;
    if plan.psi != 0.0 {
        return Ok(Ok(plan.psi.signum()));
    }
    let torque = f.motor + f.linkage.moment;
    // Weights that turn the crank against its motor: it does not start. One that changes with time
    // may yet do so.
    let wrong_way = f.motor * torque < 0.0 && equation.drive().motor().timed().is_none();
    match wrong_way {
        true => Ok(Err(torque)),
        false => from_rest(equation, 0.0, plan.phi),
    }
}

/// The time from `t` on at which a motor's torque over time moves a crank that is held at rest.
fn release(equation: &Equation, t: f64, phi: f64) -> Result<Option<f64>, EquationError> {
    let drive = equation.drive();
    let Some(timed) = drive.motor().timed() else {
        return Ok(None);
    };
    let moment = equation.model().coefficients(phi)?.moment;
    let held = drive.resistance().constant.n_m();
    let mut limits = [-held, held].map(|limit| (limit - moment) / drive.ratio());
    limits.sort_by(f64::total_cmp);
    Ok(timed.first_outside(t, limits))
}

/// Runs the machine.
///
/// ```
/// use mechaudit_solvers::run_up::{
///     ConstantInertia, Drive, Equation, Kloss, Motor, Outcome, Plan, run,
/// };
/// use mechaudit_solvers::units::{AngularVelocity, Torque};
/// let speed = AngularVelocity::from_rad_per_s(157.0);
/// let motor = Kloss::rated(speed, Torque::from_n_m(10.0), 2.2, 0.05)?;
/// let drive = Drive::direct(Motor::Kloss(motor));
/// let rotor = ConstantInertia(0.9);
/// let plan = Plan { target: Some(150.0), ..Plan::new(0.0, 60.0) };
/// let motion = run(&Equation::new(&rotor, &drive), &plan)?;
/// assert_eq!(motion.outcome, Outcome::Target);
/// assert_eq!(motion.end.psi, 150.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RunError`]: settings that make no sense, a linkage that cannot go on, a used-up budget.
pub fn run(equation: &Equation, plan: &Plan) -> Result<Motion, RunError> {
    run_with(equation, plan, None).map(|(motion, _)| motion)
}

/// [`run`], with the stretches that make up the motion: none if it does not start.
///
/// # Errors
/// As [`run`].
pub fn run_recorded(equation: &Equation, plan: &Plan) -> Result<(Motion, Vec<Stretch>), RunError> {
    run_with(equation, plan, Some(Vec::new()))
}

fn run_with(
    equation: &Equation,
    plan: &Plan,
    stretches: Option<Vec<Stretch>>,
) -> Result<(Motion, Vec<Stretch>), RunError> {
    plan.check()?;
    let at_start = |source| RunError::Equation { t: 0.0, source };
    let (sign, held) = match direction(equation, plan).map_err(at_start)? {
        Ok(sign) => (sign, false),
        Err(torque) => {
            let later = release(equation, 0.0, plan.phi).map_err(at_start)?;
            if !later.is_some_and(|t| t < plan.duration) {
                let motion = not_started(equation, plan, torque).map_err(at_start)?;
                return Ok((motion, Vec::new()));
            }
            (0.0, true)
        }
    };
    let mut run = Run::begin(equation, plan, sign)?;
    run.integrator.stretches = stretches;
    if held {
        run.start = at_rest(run.start);
        run.samples.iter_mut().for_each(|s| *s = at_rest(*s));
        run.go_on_from_rest()?;
    }
    let outcome = run.all()?;
    let stretches = run.integrator.stretches.take().unwrap_or_default();
    Ok((run.end(outcome)?, stretches))
}

fn not_started(equation: &Equation, plan: &Plan, torque: f64) -> Result<Motion, EquationError> {
    let y = [plan.phi, 0.0, 0.0, 0.0, 0.0, 0.0];
    let start = sample(equation, 0.0, &y, 0.0, 0.0)?;
    Ok(Motion {
        start,
        end: start,
        samples: plan.sampling.map(|_| start).into_iter().collect(),
        events: vec![Event {
            t: 0.0,
            phi: plan.phi,
            psi: 0.0,
            kind: EventKind::Rest,
        }],
        turns: Vec::new(),
        outcome: Outcome::Stalled { torque },
        counts: Counts::default(),
        stiff_from: None,
    })
}

/// The sample of a crank that the resistance holds.
fn at_rest(sample: Sample) -> Sample {
    Sample {
        acceleration: 0.0,
        resistance: -(sample.motor + sample.weights),
        ..sample
    }
}

/// The last passage of the angle at the start, whole turns on.
#[derive(Clone, Copy)]
struct Passage {
    /// Whole turns since the start.
    turns: i64,
    t: f64,
    psi: f64,
    balance: f64,
}

/// A run under way.
struct Run<'a> {
    equation: &'a Equation<'a>,
    plan: &'a Plan,
    sign: f64,
    integrator: Integrator<'a>,
    start: Sample,
    samples: Vec<Sample>,
    events: Vec<Event>,
    turns: Vec<Turn>,
    passage: Passage,
    /// When the crank was at rest last.
    rested: Option<f64>,
    /// Angles at which to stop, in one turn.
    angles: Vec<f64>,
    /// Speeds at which to stop.
    speeds: Vec<f64>,
}

impl<'a> Run<'a> {
    fn begin(equation: &'a Equation<'a>, plan: &'a Plan, sign: f64) -> Result<Run<'a>, RunError> {
        let integrator = Integrator::new(*equation, plan.settings, 0.0, plan.phi, plan.psi, sign);
        let start = sample(equation, 0.0, &integrator.y, sign, 0.0)
            .and_then(|s| sample(equation, 0.0, &integrator.y, sign, s.kinetic_energy))
            .map_err(|e| integrator.error(Stuck::Equation(e)))?;
        let model = equation.model();
        let mut angles = vec![plan.phi];
        angles.extend_from_slice(model.knots());
        angles.extend_from_slice(model.dead_positions());
        let mut speeds = equation.drive().kinks();
        speeds.extend(plan.target);
        speeds.push(0.0);
        Ok(Run {
            equation,
            plan,
            sign,
            integrator,
            start,
            samples: plan.sampling.map(|_| start).into_iter().collect(),
            events: Vec::new(),
            turns: Vec::new(),
            passage: Passage {
                turns: 0,
                t: 0.0,
                psi: plan.psi,
                balance: 0.0,
            },
            rested: None,
            angles,
            speeds,
        })
    }

    fn all(&mut self) -> Result<Outcome, RunError> {
        loop {
            let (phi, psi) = (self.integrator.y[PHI], self.integrator.y[PSI]);
            let (low, high) = between(&self.speeds, psi);
            let limits = Limits {
                end: self.next_moment(),
                angles: neighbours(&self.angles, phi),
                speeds: match (psi == 0.0, self.sign > 0.0) {
                    (false, _) => (low, high),
                    // Leaving rest in the one direction.
                    (true, true) => (0.0, high),
                    (true, false) => (low, 0.0),
                },
                extrema: false,
            };
            match self.advance(&limits)? {
                Pause::End if self.integrator.t < self.plan.duration => {}
                Pause::End => return Ok(Outcome::TimeUp),
                Pause::Speed(0.0) => {
                    self.event(EventKind::Rest);
                    if let Some(outcome) = self.go_on_from_rest()? {
                        return Ok(outcome);
                    }
                }
                Pause::Speed(w) if self.plan.target == Some(w) => {
                    self.event(EventKind::Target);
                    return Ok(Outcome::Target);
                }
                Pause::Speed(_) | Pause::Extremum => {}
                Pause::Angle(angle) => {
                    if let Some(outcome) = self.passed(angle) {
                        return Ok(outcome);
                    }
                }
            }
        }
    }

    /// The end of the run, or the next moment at which the motor's torque has a kink.
    fn next_moment(&self) -> f64 {
        let times = self
            .equation
            .drive()
            .motor()
            .timed()
            .map(TimedTorque::times);
        let mut later = times
            .into_iter()
            .flatten()
            .filter(|t| **t > self.integrator.t);
        let end = self.plan.duration;
        later.next().map_or(end, |t| t.min(end))
    }

    /// Turns the crank in the direction of the torque, once there is enough of it; the outcome
    /// where it stays at rest.
    fn go_on_from_rest(&mut self) -> Result<Option<Outcome>, RunError> {
        let (t, phi) = (self.integrator.t, self.integrator.y[PHI]);
        let refused = |e| RunError::Equation { t, source: e };
        let mut way = from_rest(self.equation, t, phi).map_err(refused)?;
        if let Err(torque) = way {
            let later = release(self.equation, t, phi).map_err(refused)?;
            match later.filter(|later| *later < self.plan.duration) {
                Some(later) => self.wait(later)?,
                None => return Ok(Some(Outcome::Stalled { torque })),
            }
            way = from_rest(self.equation, self.integrator.t, phi).map_err(refused)?;
        }
        let again = self.rested.replace(self.integrator.t) == Some(self.integrator.t);
        match way {
            Ok(sign) if !again => {
                self.sign = sign;
                self.integrator.turn(sign);
                Ok(None)
            }
            // Nothing has moved since: the torque is too small to be told from none.
            Ok(_) => Ok(Some(Outcome::Stalled { torque: 0.0 })),
            Err(torque) => Ok(Some(Outcome::Stalled { torque })),
        }
    }

    /// Stays at rest until the time `later`.
    fn wait(&mut self, later: f64) -> Result<(), RunError> {
        if let Some(dt) = self.plan.sampling {
            loop {
                let t = self.samples.len() as f64 * dt;
                if t > later {
                    break;
                }
                let (y, energy) = (&self.integrator.y, self.start.kinetic_energy);
                let found = sample(self.equation, t, y, 0.0, energy);
                let found = found.map_err(|e| self.integrator.error(Stuck::Equation(e)))?;
                self.samples.push(at_rest(found));
            }
        }
        self.integrator.t = later;
        Ok(())
    }

    fn advance(&mut self, limits: &Limits) -> Result<Pause, RunError> {
        let (equation, sign, energy) = (self.equation, self.sign, self.start.kinetic_energy);
        let sampling = self.plan.sampling;
        let samples = &mut self.samples;
        if let Some(dt) = sampling.filter(|_| self.integrator.ends_steps_at_samples()) {
            let due = samples.len() as f64 * dt;
            let end = limits.end.min(due);
            let limits = Limits { end, ..*limits };
            let pause = self.integrator.advance(&limits, &mut |_, _, _| ());
            let pause = pause.map_err(|s| self.integrator.error(s))?;
            if pause == Pause::End && end == due {
                let s = self.sample()?;
                self.samples.push(s);
            }
            return Ok(pause);
        }
        let mut refused = None;
        let pause = self.integrator.advance(limits, &mut |a, b, between| {
            let Some(dt) = sampling else { return };
            loop {
                let t = samples.len() as f64 * dt;
                if !(t <= b) || refused.is_some() {
                    return;
                }
                match sample(equation, t, &between(t.max(a)), sign, energy) {
                    Ok(s) => samples.push(s),
                    Err(e) => refused = Some(e),
                }
            }
        });
        let pause = pause.map_err(|s| self.integrator.error(s))?;
        match refused {
            Some(e) => Err(self.integrator.error(Stuck::Equation(e))),
            None => Ok(pause),
        }
    }

    /// The motion at this moment.
    fn sample(&self) -> Result<Sample, RunError> {
        let (i, energy) = (&self.integrator, self.start.kinetic_energy);
        sample(self.equation, i.t, &i.y, self.sign, energy).map_err(|e| i.error(Stuck::Equation(e)))
    }

    fn event(&mut self, kind: EventKind) {
        if self.events.len() < MOST_EVENTS {
            self.events.push(Event {
                t: self.integrator.t,
                phi: self.integrator.y[PHI],
                psi: self.integrator.y[PSI],
                kind,
            });
        }
    }

    /// The crank has come to one of the angles.
    fn passed(&mut self, phi: f64) -> Option<Outcome> {
        let is = |a: f64| {
            (((phi - a) / TAU).round() * TAU - (phi - a)).abs() <= 1e-12 * (1.0 + phi.abs())
        };
        if self
            .equation
            .model()
            .dead_positions()
            .iter()
            .any(|a| is(*a))
        {
            self.event(EventKind::DeadPosition);
        }
        if !is(self.plan.phi) {
            return None;
        }
        let now = Passage {
            turns: ((phi - self.plan.phi) / TAU).round() as i64,
            t: self.integrator.t,
            psi: self.integrator.y[PSI],
            balance: self.sample().map_or(f64::NAN, |s| s.balance),
        };
        let before = std::mem::replace(&mut self.passage, now);
        if now.turns == before.turns {
            return None;
        }
        self.event(EventKind::Turn(now.turns));
        self.turn(before, now)
    }

    fn turn(&mut self, before: Passage, now: Passage) -> Option<Outcome> {
        let turn = Turn {
            t: now.t,
            psi: now.psi,
            mean: self.sign * TAU / (now.t - before.t),
            imbalance: now.balance - before.balance,
        };
        self.turns.push(turn);
        let settled = self.plan.settled?;
        if !((turn.psi - before.psi).abs() <= settled * turn.psi.abs()) {
            return None;
        }
        let mean = turn.mean;
        let short =
            |limit: Option<f64>| limit.is_some_and(|w| mean.abs() < w.abs() && w * mean > 0.0);
        Some(
            match short(self.plan.target) || short(self.equation.drive().pull_out_speed()) {
                true => Outcome::Captured { mean },
                false => Outcome::Settled { mean },
            },
        )
    }

    fn end(self, outcome: Outcome) -> Result<Motion, RunError> {
        let end = self.sample()?;
        let mut samples = self.samples;
        if self.plan.sampling.is_some() && samples.last().is_some_and(|s| s.t < end.t) {
            samples.push(end);
        }
        Ok(Motion {
            start: self.start,
            end,
            samples,
            events: self.events,
            turns: self.turns,
            outcome,
            counts: self.integrator.counts,
            stiff_from: self.integrator.stiff_from(),
        })
    }
}

#[cfg(test)]
mod tests;

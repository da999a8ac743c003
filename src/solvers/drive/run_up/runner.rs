//! Run-up and run-down: the motion over time, what happens on the way, and how it ends.

use super::crossing::{Limits, Pause};
use super::equation::{Equation, EquationError};
use super::integrate::{Counts, Integrator, Stuck};
use super::motion::{Event, EventKind, Motion, Outcome, Plan, RunError, Sample, Turn};
use super::record::Stretch;
use super::stepper::{PHI, PSI, WORK};
use std::f64::consts::TAU;

/// Events kept at most; a run of so many turns has said what it had to say.
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
    let f = equation.forces(y[PHI], y[PSI], sign)?;
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

/// The direction in which the crank starts: that of its speed, else that of the torque. `Err` with
/// the torque where it cannot start.
fn direction(equation: &Equation, plan: &Plan) -> Result<Result<f64, f64>, EquationError> {
    // No resistance at rest but its constant part, which is compared below.
    let f = equation.forces(plan.phi, plan.psi, 0.0)?;
    if plan.psi != 0.0 {
        return Ok(Ok(plan.psi.signum()));
    }
    let torque = f.motor + f.linkage.moment;
    let held = torque.abs() <= equation.drive().resistance().constant.n_m();
    // Weights that turn the crank against its motor: it does not start.
    let wrong_way = f.motor * torque < 0.0;
    Ok(match held || wrong_way {
        true => Err(torque),
        false => Ok(torque.signum()),
    })
}

/// Runs the machine.
///
/// ```
/// use mechaudit_solvers::run_up::{ConstantInertia, Drive, Equation, Kloss, Motor, Outcome, Plan, run};
/// use mechaudit_solvers::units::{AngularVelocity, Torque};
/// let motor = Kloss::rated(AngularVelocity::from_rad_per_s(157.0), Torque::from_n_m(10.0), 2.2, 0.05)?;
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
    let sign = match direction(equation, plan).map_err(at_start)? {
        Ok(sign) => sign,
        Err(torque) => {
            let motion = not_started(equation, plan, torque).map_err(at_start)?;
            return Ok((motion, Vec::new()));
        }
    };
    let mut run = Run::begin(equation, plan, sign)?;
    run.integrator.stretches = stretches;
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
            angles,
            speeds,
        })
    }

    fn all(&mut self) -> Result<Outcome, RunError> {
        loop {
            let (phi, psi) = (self.integrator.y[PHI], self.integrator.y[PSI]);
            let (low, high) = between(&self.speeds, psi);
            let limits = Limits {
                end: self.plan.duration,
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
                    let torque = self
                        .equation
                        .forces(self.integrator.y[PHI], 0.0, 0.0)
                        .map(|f| f.motor + f.linkage.moment)
                        .map_err(|e| self.integrator.error(Stuck::Equation(e)))?;
                    return Ok(Outcome::Stalled { torque });
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

    fn advance(&mut self, limits: &Limits) -> Result<Pause, RunError> {
        let (equation, sign, energy) = (self.equation, self.sign, self.start.kinetic_energy);
        let sampling = self.plan.sampling;
        let samples = &mut self.samples;
        if let Some(dt) = sampling.filter(|_| self.integrator.ends_steps_at_samples()) {
            let end = limits.end.min(samples.len() as f64 * dt);
            let limits = Limits { end, ..*limits };
            let pause = self.integrator.advance(&limits, &mut |_, _, _| ());
            let pause = pause.map_err(|s| self.integrator.error(s))?;
            if pause == Pause::End {
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
        self.event(EventKind::Turn(((phi - self.plan.phi) / TAU).round() as i64));
        self.turn()
    }

    fn turn(&mut self) -> Option<Outcome> {
        let y = self.integrator.y;
        let balance = self.sample().map_or(f64::NAN, |s| s.balance);
        let (t0, psi0) = match self.turns.last() {
            Some(last) => (last.t, last.psi),
            None => (0.0, self.plan.psi),
        };
        let before: f64 = self.turns.iter().map(|t| t.imbalance).sum();
        let turn = Turn {
            t: self.integrator.t,
            psi: y[PSI],
            mean: self.sign * TAU / (self.integrator.t - t0),
            imbalance: balance - before,
        };
        self.turns.push(turn);
        let settled = self.plan.settled?;
        if !((turn.psi - psi0).abs() <= settled * turn.psi.abs()) {
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
#[path = "runner_tests.rs"]
mod tests;

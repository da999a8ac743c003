//! Integration over time with stops: the library takes the steps, this file ends them where
//! something happens.

use super::crossing::{Limits, Pause, crossing};
use super::equation::{Equation, EquationError};
use super::record::{Stretch, Taken};
use super::stepper::{DAMPING, Method, PHI, PSI, State, Stepper, Tried, begin};
use differential_equations::ode::ODE;
use std::cell::{Cell, RefCell};

/// How finely to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Relative and absolute tolerance of one step in φ (rad), ψ (rad/s) and the works (J).
    pub tolerance: f64,
    /// The method.
    pub method: Method,
    /// Tells whether an explicit method gives way to Radau's where the equation is stiff
    /// ([`Motion::stiff_from`](super::Motion::stiff_from)).
    pub switch_when_stiff: bool,
    /// Steps at most, rejected ones included. A run that needs more ends with an error. The
    /// default, two million, is some thousand turns of the sand screen at 1e-12.
    pub max_steps: u64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            tolerance: 1e-10,
            method: Method::default(),
            switch_when_stiff: false,
            max_steps: 2_000_000,
        }
    }
}

/// Settings that make no sense.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// A tolerance that rounding would drown or that controls nothing.
    #[error("the tolerance {value} must lie between 1e-14 and 1e-2")]
    Tolerance {
        /// The value.
        value: f64,
    },
    /// A number that is NaN, infinite, or not positive where it has to be.
    #[error("{name} = {value} {rule}")]
    Number {
        /// Which.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The rule that it breaks.
        rule: &'static str,
    },
}

impl Settings {
    pub(super) fn check(&self) -> Result<(), SettingsError> {
        let value = self.tolerance;
        match (1e-14..=1e-2).contains(&value) {
            true => Ok(()),
            false => Err(SettingsError::Tolerance { value }),
        }
    }

    fn tolerances(&self) -> State {
        let t = self.tolerance;
        // The last component only serves Newton's method of the steady cycle.
        let loose = t.max(1e-7);
        [t, t, t, t, t, loose]
    }
}

/// Describes what a run cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps that make up the motion.
    pub steps: u64,
    /// Steps whose error was too large.
    pub rejected: u64,
    /// Steps taken again because something happened within them.
    pub retaken: u64,
    /// Evaluations of the right-hand side.
    pub evaluations: u64,
}

impl Counts {
    /// Both together.
    pub fn plus(self, o: Counts) -> Counts {
        Counts {
            steps: self.steps + o.steps,
            rejected: self.rejected + o.rejected,
            retaken: self.retaken + o.retaken,
            evaluations: self.evaluations + o.evaluations,
        }
    }
}

/// Why the integration could not go on.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Stuck {
    Equation(EquationError),
    Budget,
    Method(String),
}

/// The equation as the library wants it.
struct Rhs<'a> {
    equation: Equation<'a>,
    /// Direction of motion, ±1.
    sign: f64,
    evaluations: Cell<u64>,
    /// The last refusal since it was cleared.
    refused: RefCell<Option<EquationError>>,
}

impl ODE<f64, State> for Rhs<'_> {
    fn diff(&self, t: f64, y: &State, dydt: &mut State) {
        self.evaluations.set(self.evaluations.get() + 1);
        let psi = y[PSI];
        match self.equation.forces_at(t, y[PHI], psi, self.sign) {
            Ok(f) => {
                *dydt = [
                    psi,
                    f.acceleration,
                    f.motor * psi,
                    f.linkage.moment * psi,
                    f.resistance * psi,
                    f.damping,
                ];
            }
            // A step with NaN in it is rejected.
            Err(e) => {
                // The first one is the cause; NaN in the next stage is not.
                self.refused.borrow_mut().get_or_insert(e);
                *dydt = [f64::NAN; 6];
            }
        }
    }
}

/// Counts the steps in which a disturbance of the speed decays by more than e⁻².
///
/// An explicit method at these tolerances resolves a decay by shorter steps, and after that number
/// of them in a row nothing of it is left: what keeps the steps short then is the method's
/// stability (Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.2).
#[derive(Clone, Copy, Debug, Default)]
struct Stiffness {
    /// Such steps less the others, not below zero.
    steps: u32,
    /// When the first of those counted began.
    since: f64,
    /// When the equation became stiff, if it did.
    from: Option<f64>,
}

impl Stiffness {
    const DECAY: f64 = 2.0;
    const ENOUGH: u32 = 300;

    /// Looks at a step from `t` with so much decay, `−∫ ∂(dψ/dt)/∂ψ dt`; whether the equation is
    /// stiff.
    fn look(&mut self, decay: f64, t: f64) -> bool {
        if decay > Stiffness::DECAY {
            if self.steps == 0 {
                self.since = t;
            }
            self.steps += 1;
            if self.steps >= Stiffness::ENOUGH {
                self.from.get_or_insert(self.since);
                return true;
            }
        } else {
            self.steps = self.steps.saturating_sub(1);
        }
        false
    }
}

/// Called for every stretch of the motion, with its ends and the state between.
pub(super) type Watch<'w> = &'w mut dyn FnMut(f64, f64, &mut dyn FnMut(f64) -> State);

/// The motion under way.
pub(super) struct Integrator<'a> {
    rhs: Rhs<'a>,
    settings: Settings,
    tolerances: State,
    /// The method that takes the steps.
    pub method: Method,
    stiffness: Stiffness,
    pub t: f64,
    pub y: State,
    h: f64,
    /// Tells whether the acceleration is zero here but for rounding.
    at_extremum: bool,
    pub counts: Counts,
    /// The stretches that make up the motion, where they are asked for.
    pub stretches: Option<Vec<Stretch>>,
}

/// Steps in a row without a right-hand side, each a quarter of the one before: after that number
/// what stops the motion is closer than rounding.
const UNSOUND: u32 = 25;

/// Rejections in a row after which an implicit method starts afresh.
const STUBBORN: u32 = 2;

impl<'a> Integrator<'a> {
    pub fn new(
        equation: Equation<'a>,
        settings: Settings,
        t: f64,
        phi: f64,
        psi: f64,
        sign: f64,
    ) -> Integrator<'a> {
        Integrator {
            rhs: Rhs {
                equation,
                sign,
                evaluations: Cell::new(0),
                refused: RefCell::new(None),
            },
            settings,
            tolerances: settings.tolerances(),
            method: settings.method,
            stiffness: Stiffness::default(),
            t,
            y: [phi, psi, 0.0, 0.0, 0.0, 0.0],
            h: 0.0,
            at_extremum: false,
            counts: Counts::default(),
            stretches: None,
        }
    }

    /// From here on the crank turns in the direction `sign`.
    pub fn turn(&mut self, sign: f64) {
        self.rhs.sign = sign;
    }

    fn derivative(&self, t: f64, y: &State) -> State {
        let mut d = [0.0; 6];
        self.rhs.diff(t, y, &mut d);
        d
    }

    /// A first step short beside everything that changes at the start; the library would try one
    /// over a good part of the whole time, where there may be no linkage or motor any more. Steps
    /// grow up to tenfold at a time.
    fn first_step(&self, end: f64) -> f64 {
        let (d, psi) = (self.derivative(self.t, &self.y), self.y[PSI].abs());
        let (acceleration, damping) = (d[PSI].abs(), d[DAMPING].abs());
        let shortest = [
            1.0 / damping,
            (1.0 + psi) / acceleration,
            1.0 / (psi + acceleration.sqrt()),
            end - self.t,
        ];
        1e-3 * shortest
            .iter()
            .copied()
            .filter(|h| *h > 0.0)
            .fold(1.0, f64::min)
    }

    fn begin(&self, end: f64) -> Result<Box<dyn Stepper>, Stuck> {
        let h = match self.h {
            0.0 => self.first_step(end),
            h => h,
        };
        // The library refuses a first step beyond the end.
        let h = h.min(end - self.t);
        let stepper = begin(
            self.method,
            &self.tolerances,
            &self.rhs,
            (self.t, &self.y),
            (end, h),
        )
        .map_err(|e| self.stuck(e))?;
        // Where the equation has no right-hand side at the start itself, no step can help.
        match self.rhs.refused.borrow_mut().take() {
            Some(e) => Err(Stuck::Equation(e)),
            None => Ok(stepper),
        }
    }

    /// Returns whether a step was computed without a refusal.
    fn sound(&self, y: &State) -> bool {
        self.rhs.refused.borrow().is_none() && y.iter().all(|v| v.is_finite())
    }

    /// The equation's own refusal explains more than the method's.
    fn stuck(&self, method: String) -> Stuck {
        match self.rhs.refused.borrow_mut().take() {
            Some(e) => Stuck::Equation(e),
            None => Stuck::Method(method),
        }
    }

    /// Goes on until one of the limits.
    pub fn advance(&mut self, limits: &Limits, watch: Watch) -> Result<Pause, Stuck> {
        let found = self.steps(limits.end, Some(limits), watch)?;
        self.counts.evaluations = self.rhs.evaluations.get();
        let Some((t, pause)) = found else {
            return Ok(Pause::End);
        };
        // Once more from the beginning of that step, up to the event.
        self.counts.retaken += 1;
        let proposed = self.h;
        self.steps(t, None, watch)?;
        self.h = proposed;
        self.settle(pause);
        self.counts.evaluations = self.rhs.evaluations.get();
        Ok(pause)
    }

    /// Steps until `end`, or until one in which a limit is crossed. That one is not taken; returned
    /// are the time and kind of the crossing.
    fn steps(
        &mut self,
        end: f64,
        limits: Option<&Limits>,
        watch: Watch,
    ) -> Result<Option<(f64, Pause)>, Stuck> {
        // Less than this cannot be told from the end.
        let nothing = |t: f64| end - t <= 4.0 * f64::EPSILON * end.abs().max(t.abs());
        if nothing(self.t) {
            self.t = end;
            return Ok(None);
        }
        let mut stepper = self.begin(end)?;
        let mut h = match self.h {
            0.0 => stepper.proposed(),
            h => h,
        };
        let (mut rejections, mut unsound) = (0, 0);
        let mut acceleration = limits
            .filter(|l| l.extrema)
            .map(|_| match self.at_extremum {
                // Its sign says nothing; that at the first look does.
                true => 0.0,
                false => self.derivative(self.t, &self.y)[PSI],
            });
        loop {
            if self.counts.steps + self.counts.rejected >= self.settings.max_steps {
                return Err(Stuck::Budget);
            }
            let last = self.t + h >= end;
            let step = if last { end - self.t } else { h };
            let earlier = self.rhs.refused.borrow_mut().take();
            let tried = stepper.step(&self.rhs, step);
            if tried == Tried::Accepted && !self.sound(stepper.y()) {
                // The library's largest component of an error ignores NaN.
                self.counts.rejected += 1;
                unsound += 1;
                h = 0.25 * step;
                if unsound > UNSOUND || !(self.t + h > self.t) {
                    return Err(self.stuck("the state is not finite".into()));
                }
                self.h = h;
                let cause = self.rhs.refused.borrow_mut().take();
                stepper = self.begin(end)?;
                *self.rhs.refused.borrow_mut() = cause;
                continue;
            }
            match tried {
                Tried::Accepted => {}
                Tried::Rejected => {
                    self.counts.rejected += 1;
                    rejections += 1;
                    h = stepper.proposed();
                    // Its linear system belongs to the step that failed, and it keeps it.
                    if self.method == Method::Radau5 && rejections % STUBBORN == 0 {
                        self.h = h;
                        self.rhs.refused.borrow_mut().take();
                        stepper = self.begin(end)?;
                    }
                    continue;
                }
                Tried::Stiff => {
                    // Its steps are still controlled; they are only many. The budget ends it.
                    self.counts.rejected += 1;
                    self.h = step;
                    stepper = self.begin(end)?;
                    continue;
                }
                Tried::Failed(why) => {
                    if let Some(e) = earlier {
                        self.rhs.refused.borrow_mut().get_or_insert(e);
                    }
                    return Err(self.stuck(why));
                }
            }
            (rejections, unsound) = (0, 0);
            let found = limits.and_then(|limits| {
                let of = |t: f64, y: &State| self.derivative(t, y)[PSI];
                crossing(&mut *stepper, limits, &mut acceleration, &of)
            });
            if found.is_some() {
                self.h = step;
                return Ok(found);
            }
            self.counts.steps += 1;
            let decay = self.y[DAMPING] - stepper.y()[DAMPING];
            let stiff = self.stiffness.look(decay, self.t) && self.method != Method::Radau5;
            let (a, b) = (stepper.t_before(), stepper.t());
            watch(a, b, &mut |t| stepper.between(t));
            self.t = b;
            self.y = *stepper.y();
            h = stepper.proposed();
            let done = last || nothing(self.t);
            if done {
                self.t = end;
            }
            self.record(a, Taken::Step);
            if done {
                // The last step was cut, so its successor's proposal may be short.
                self.h = if last { self.h.max(h) } else { h };
                return Ok(None);
            }
            self.h = h;
            if stiff && self.settings.switch_when_stiff {
                self.method = Method::Radau5;
                stepper = self.begin(end)?;
                h = stepper.proposed();
            }
        }
    }

    /// The time from which on stability alone keeps the steps of an explicit method short.
    pub fn stiff_from(&self) -> Option<f64> {
        self.stiffness
            .from
            .filter(|_| self.settings.method != Method::Radau5)
    }

    /// Returns whether the dense output is not good enough for samples: of DOP853, and of Radau's
    /// method where it took over from a better one.
    pub fn ends_steps_at_samples(&self) -> bool {
        self.method.ends_steps_at_samples() || self.method != self.settings.method
    }

    fn record(&mut self, from: f64, taken: Taken) {
        let to = self.t;
        if let Some(stretches) = self.stretches.as_mut().filter(|_| from != to) {
            stretches.push(Stretch { from, to, taken });
        }
    }

    /// Puts the state on the limit exactly: what is left is the difference between the dense output
    /// and the step, undone to first order.
    fn settle(&mut self, pause: Pause) {
        self.at_extremum = pause == Pause::Extremum;
        let d = self.derivative(self.t, &self.y);
        let shift = match pause {
            Pause::Angle(phi) => (phi - self.y[PHI]) / d[PHI],
            Pause::Speed(psi) => (psi - self.y[PSI]) / d[PSI],
            Pause::End | Pause::Extremum => 0.0,
        };
        // Next to a turning point the crank would turn within the shift, and the standstill be
        // missed.
        let turns = matches!(pause, Pause::Angle(_)) && (shift * d[PSI]).abs() >= d[PHI].abs();
        // Where what changes stands still, the quotient is infinite or not a number.
        if shift.abs() <= self.h && !turns {
            let before = self.t;
            self.t += shift;
            self.record(before, Taken::Tangent);
            for (y, d) in self.y.iter_mut().zip(d) {
                *y += shift * d;
            }
        }
        match pause {
            Pause::Angle(phi) => self.y[PHI] = phi,
            Pause::Speed(psi) => self.y[PSI] = psi,
            Pause::End | Pause::Extremum => {}
        }
    }
}

#[cfg(test)]
mod tests;

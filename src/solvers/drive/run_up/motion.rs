//! Describes what is asked of a run, and what comes of it.

use super::equation::EquationError;
use super::integrate::{Counts, Settings, SettingsError};

/// Describes what is asked of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Crank angle at the start, rad.
    pub phi: f64,
    /// Crank speed at the start, rad/s.
    pub psi: f64,
    /// How long, s.
    pub duration: f64,
    /// Ends the run when the crank reaches this speed, rad/s.
    pub target: Option<f64>,
    /// Ends the run when two turns in a row begin with speeds that differ by less than this, as a
    /// fraction.
    pub settled: Option<f64>,
    /// Time between samples, s; `None` for none.
    pub sampling: Option<f64>,
    /// Tolerance, method and budget.
    pub settings: Settings,
}

impl Plan {
    /// From rest at the crank angle `phi` (rad) for `duration` seconds.
    pub fn new(phi: f64, duration: f64) -> Plan {
        Plan {
            phi,
            psi: 0.0,
            duration,
            target: None,
            settled: None,
            sampling: None,
            settings: Settings::default(),
        }
    }

    pub(super) fn check(&self) -> Result<(), SettingsError> {
        self.settings.check()?;
        let number = |good: bool, name, value, rule| match good {
            true => Ok(()),
            false => Err(SettingsError::Number { name, value, rule }),
        };
        let finite =
            |name, value: f64| number(value.is_finite(), name, value, "is not a finite number");
        let positive = |name, value: f64| {
            number(value > 0.0, name, value, "must be greater than zero")?;
            finite(name, value)
        };
        finite("the angle at the start", self.phi)?;
        finite("the speed at the start", self.psi)?;
        positive("the duration", self.duration)?;
        if let Some(w) = self.target {
            finite("the target speed", w)?;
        }
        if let Some(s) = self.settled {
            positive("the settling tolerance", s)?;
        }
        if let Some(dt) = self.sampling {
            positive("the sampling step", dt)?;
            // Ten million rows are a gigabyte.
            let few = self.duration / dt <= 1e7;
            let rule = "gives more than ten million samples";
            number(few, "the sampling step", dt, rule)?;
        }
        Ok(())
    }
}

/// The motion at one moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Time, s.
    pub t: f64,
    /// Crank angle, rad.
    pub phi: f64,
    /// Crank speed, rad/s.
    pub psi: f64,
    /// Crank acceleration, rad/s².
    pub acceleration: f64,
    /// I_n + I_1, kg·m².
    pub inertia: f64,
    /// Motor's torque at the crank, N·m.
    pub motor: f64,
    /// M_o, N·m.
    pub weights: f64,
    /// Torque of the resistance, N·m.
    pub resistance: f64,
    /// `½ (I_n + I_1) ψ²`, J.
    pub kinetic_energy: f64,
    /// Work done since the start by motor, weights and resistance, J.
    pub work: [f64; 3],
    /// Kinetic energy less that at the start less the works, J: zero for a model whose dI_n/dφ
    /// belongs to its I_n.
    pub balance: f64,
}

/// Describes what happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum EventKind {
    /// The driven links turned back.
    DeadPosition,
    /// A number of turns was completed since the start. A crank that swings back through an angle that it has just
    /// passed has not made one.
    Turn(i64),
    /// The target speed was reached.
    Target,
    /// The crank came to rest, to turn back or to stay.
    Rest,
}

/// Something that happened.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Event {
    /// Time, s.
    pub t: f64,
    /// Crank angle, rad.
    pub phi: f64,
    /// Crank speed, rad/s.
    pub psi: f64,
    /// Holds what happened.
    pub kind: EventKind,
}

/// A whole turn of the crank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Time at its end, s.
    pub t: f64,
    /// Speed at its end, rad/s.
    pub psi: f64,
    /// 2π over its duration, rad/s.
    pub mean: f64,
    /// Kinetic energy gained less work done in it, J.
    pub imbalance: f64,
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The time was over.
    TimeUp,
    /// The target speed was reached.
    Target,
    /// The crank came to rest and stays there, or did not start: what drives it does not overcome
    /// what holds it, or it would turn at a speed that the motor's table does not cover. At the
    /// start a motor that weights overcome counts as held; later the crank turns back.
    Stalled {
        /// Sum of the torques at rest there, the constant resistance left out, N·m.
        torque: f64,
    },
    /// Successive turns repeat.
    Settled {
        /// Mean speed of the last turn, rad/s.
        mean: f64,
    },
    /// Successive turns repeat at a speed below the motor's pull-out torque or below the target:
    /// resistance and motor balance there and the motor cannot pass (the capture that Sommerfeld
    /// described).
    Captured {
        /// Mean speed of the last turn, rad/s.
        mean: f64,
    },
}

/// A run.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The first moment.
    pub start: Sample,
    /// The last moment.
    pub end: Sample,
    /// Moments between, if asked for; the first and the last are among them.
    pub samples: Vec<Sample>,
    /// Holds what happened, in order.
    pub events: Vec<Event>,
    /// The whole turns.
    pub turns: Vec<Turn>,
    /// How it ended.
    pub outcome: Outcome,
    /// Holds what it cost.
    pub counts: Counts,
    /// The time in s from which on the equation is stiff, if it is: stability alone keeps the steps
    /// of the explicit method short there. With
    /// [`Settings::switch_when_stiff`](super::Settings::switch_when_stiff) Radau's method took
    /// over.
    pub stiff_from: Option<f64>,
}

/// Why there is no motion, or no more.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The request makes no sense.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The equation has no right-hand side any more.
    #[error("after {t} s: {source}")]
    Equation {
        /// Time, s.
        t: f64,
        /// Why.
        source: EquationError,
    },
    /// Too many steps, short for the method's stability.
    #[error(
        "after {t} s: {steps} steps are used up; the equation is stiff from {from:.3e} s on, which Radau's method (radau5) is made for"
    )]
    Stiff {
        /// Time, s.
        t: f64,
        /// Steps taken.
        steps: u64,
        /// From when on, s.
        from: f64,
    },
    /// Too many steps.
    #[error("after {t} s: {steps} steps are used up; ask for a looser tolerance or less time")]
    Budget {
        /// Time, s.
        t: f64,
        /// Steps taken.
        steps: u64,
    },
    /// The method gave up.
    #[error("after {t} s the integration gave up: {reason}")]
    Method {
        /// Time, s.
        t: f64,
        /// The library's words.
        reason: String,
    },
}

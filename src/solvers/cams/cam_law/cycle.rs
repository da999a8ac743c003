//! Cycles: rise, high dwell, return, low dwell.

use super::error::{CamLawError, finite};
use super::law::MotionLaw;
use super::motion::Motion;
use std::f64::consts::TAU;

/// The phases may differ from a turn by this much together.
const SUM_TOLERANCE: f64 = 1e-9;

/// A rise or a return: its law and how much of a turn it takes.
#[derive(Clone, Debug)]
pub struct Stroke {
    /// The law; of a return it is the law of the way down.
    pub law: MotionLaw,
    /// Length in turns of the shaft.
    pub turns: f64,
}

/// Where in the cycle the shaft is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// On the way up.
    Rise,
    /// At the top.
    HighDwell,
    /// On the way down.
    Return,
    /// At the bottom.
    LowDwell,
}

/// Describes what a follower does in one turn of the shaft. Angles are fractions of a turn, so that
/// multiples of them can be reduced exactly.
///
/// ```
/// use mechaudit_solvers::cam_law::{CamCycle, MotionLaw, Phase, Stroke};
/// let law = MotionLaw::modified_sine();
/// let stroke = |degrees: f64| Stroke { law: law.clone(), turns: degrees / 360.0 };
/// let cycle = CamCycle::new(10.0, stroke(120.0), 60.0 / 360.0, stroke(90.0), 90.0 / 360.0)?;
/// assert_eq!(cycle.at(150.0 / 360.0)?.displacement, 10.0);
/// assert_eq!(cycle.phase(150.0 / 360.0), Phase::HighDwell);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct CamCycle {
    lift: f64,
    rise: Stroke,
    high_dwell: f64,
    fall: Option<Stroke>,
    start: f64,
}

impl CamCycle {
    /// Rise, high dwell, return, low dwell, in turns; dwells may be 0. The rise starts at angle 0,
    /// see [`CamCycle::starting_at`]; the low dwell is what the others leave of the turn.
    ///
    /// # Errors
    /// Numbers that are not finite, a stroke that is not longer than 0, a negative dwell, phases
    /// whose sum is further than 1e-9 from one turn, a lift of 0.
    pub fn new(
        lift: f64,
        rise: Stroke,
        high_dwell: f64,
        fall: Stroke,
        low_dwell: f64,
    ) -> Result<CamCycle, CamLawError> {
        stroke("return", fall.turns)?;
        dwell("high dwell", high_dwell)?;
        let used = rise.turns + high_dwell + fall.turns;
        CamCycle::checked(lift, rise, high_dwell, Some(fall), used, low_dwell)
    }

    /// Rise and return without dwells.
    ///
    /// # Errors
    /// As [`CamCycle::new`].
    pub fn rise_return(lift: f64, rise: Stroke, fall: Stroke) -> Result<CamCycle, CamLawError> {
        CamCycle::new(lift, rise, 0.0, fall, 0.0)
    }

    /// Rise and dwell without a return: the follower is carried on by the lift in every turn
    /// (indexing). The displacement is that of the first turn; what repeats is the displacement
    /// less `lift · angle` in turns.
    ///
    /// # Errors
    /// As [`CamCycle::new`].
    pub fn rise_dwell(lift: f64, rise: Stroke, dwell: f64) -> Result<CamCycle, CamLawError> {
        let used = rise.turns;
        CamCycle::checked(lift, rise, 0.0, None, used, dwell)
    }

    fn checked(
        lift: f64,
        rise: Stroke,
        high_dwell: f64,
        fall: Option<Stroke>,
        used: f64,
        low_dwell: f64,
    ) -> Result<CamCycle, CamLawError> {
        if finite("lift", lift)? == 0.0 {
            return Err(CamLawError::NoLift);
        }
        stroke("rise", rise.turns)?;
        let name = if fall.is_some() { "low dwell" } else { "dwell" };
        dwell(name, low_dwell)?;
        let sum = used + low_dwell;
        if !((sum - 1.0).abs() <= SUM_TOLERANCE) {
            return Err(CamLawError::PhasesSum { sum });
        }
        Ok(CamCycle {
            lift,
            rise,
            high_dwell,
            fall,
            start: 0.0,
        })
    }

    /// The same cycle with the rise starting at an angle in turns; whole turns are taken away.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn starting_at(mut self, turns: f64) -> Result<CamCycle, CamLawError> {
        self.start = finite("start of the rise", turns)? % 1.0;
        Ok(self)
    }

    /// The lift.
    pub fn lift(&self) -> f64 {
        self.lift
    }

    /// The rise.
    pub fn rise(&self) -> &Stroke {
        &self.rise
    }

    /// Length of the high dwell in turns.
    pub fn high_dwell(&self) -> f64 {
        self.high_dwell
    }

    /// The return; none if the follower is carried on.
    pub fn fall(&self) -> Option<&Stroke> {
        self.fall.as_ref()
    }

    /// Angle in turns at which the rise starts.
    pub fn start(&self) -> f64 {
        self.start
    }

    /// Phase, and the part of a turn since its start.
    fn place(&self, turns: f64) -> (Phase, f64) {
        let mut since = (turns - self.start).rem_euclid(1.0);
        let strokes = [
            (Phase::Rise, self.rise.turns),
            (Phase::HighDwell, self.high_dwell),
            (Phase::Return, self.fall.as_ref().map_or(0.0, |f| f.turns)),
        ];
        for (phase, length) in strokes {
            if since < length {
                return (phase, since);
            }
            since -= length;
        }
        (Phase::LowDwell, since)
    }

    /// The phase at an angle in turns.
    pub fn phase(&self, turns: f64) -> Phase {
        self.place(turns).0
    }

    /// Displacement and its derivatives in the shaft's angle **in radians**, at an angle in turns.
    ///
    /// # Errors
    /// An angle that is not finite.
    pub fn at(&self, turns: f64) -> Result<Motion, CamLawError> {
        finite("angle", turns)?;
        let (phase, since) = self.place(turns);
        let resting = |displacement| Motion {
            displacement,
            ..Motion::default()
        };
        let moving = |stroke: &Stroke| -> Result<(Motion, f64), CamLawError> {
            let (m, remaining) = stroke.law.both((since / stroke.turns).min(1.0))?;
            let per_radian = 1.0 / (TAU * stroke.turns);
            let rates = Motion {
                displacement: self.lift * m.displacement,
                velocity: self.lift * m.velocity * per_radian,
                acceleration: self.lift * m.acceleration * per_radian * per_radian,
                jerk: self.lift * m.jerk * per_radian.powi(3),
            };
            Ok((rates, self.lift * remaining))
        };
        match (phase, &self.fall) {
            (Phase::Rise, _) => Ok(moving(&self.rise)?.0),
            (Phase::Return, Some(fall)) => {
                let (down, displacement) = moving(fall)?;
                Ok(Motion {
                    displacement,
                    velocity: -down.velocity,
                    acceleration: -down.acceleration,
                    jerk: -down.jerk,
                })
            }
            (Phase::LowDwell, Some(_)) => Ok(resting(0.0)),
            _ => Ok(resting(self.lift)),
        }
    }
}

fn stroke(phase: &'static str, value: f64) -> Result<(), CamLawError> {
    match finite(phase, value)? > 0.0 {
        true => Ok(()),
        false => Err(CamLawError::PhaseNotPositive { phase, value }),
    }
}

fn dwell(phase: &'static str, value: f64) -> Result<(), CamLawError> {
    match finite(phase, value)? >= 0.0 {
        true => Ok(()),
        false => Err(CamLawError::PhaseNegative { phase, value }),
    }
}

//! Where within a step a limit is crossed.

use super::stepper::{PHI, PSI, State, Stepper};
use crate::initial_value::first_crossing;
use std::convert::Infallible;

/// Where the integration has to pause.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limits {
    /// Time.
    pub end: f64,
    /// Crank angles: the motion starts inside or on an edge.
    pub angles: (f64, f64),
    /// Crank speeds, likewise.
    pub speeds: (f64, f64),
    /// Tells whether to pause where the acceleration changes its sign.
    pub extrema: bool,
}

/// Why it paused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Pause {
    End,
    /// At this edge of the angles, exactly.
    Angle(f64),
    /// At this edge of the speeds, exactly.
    Speed(f64),
    Extremum,
}

impl Limits {
    /// The edge that lies behind.
    fn outside(&self, y: &State) -> Option<Pause> {
        let ((p0, p1), (s0, s1)) = (self.angles, self.speeds);
        if y[PHI] > p1 {
            Some(Pause::Angle(p1))
        } else if y[PHI] < p0 {
            Some(Pause::Angle(p0))
        } else if y[PSI] > s1 {
            Some(Pause::Speed(s1))
        } else if y[PSI] < s0 {
            Some(Pause::Speed(s0))
        } else {
            None
        }
    }
}

/// The first crossing of a limit found within the step just taken, with its time.
///
/// `before` is the acceleration at the beginning of the step where extrema are looked for, zero if
/// its sign is not known; it becomes that at the end. `acceleration` is that of a time and state.
pub(super) fn crossing(
    stepper: &mut dyn Stepper,
    limits: &Limits,
    before: &mut Option<f64>,
    acceleration: &dyn Fn(f64, &State) -> f64,
) -> Option<(f64, Pause)> {
    let (from, to) = (stepper.t_before(), stepper.t());
    let look = |t: f64, is_forth: bool| -> Result<_, Infallible> {
        let y = match is_forth && t == to {
            true => *stepper.y(),
            false => stepper.between(t),
        };
        let reference = before.filter(|b| *b != 0.0);
        let known = if is_forth { *before } else { reference };
        let now = known.map(|_| acceleration(t, &y));
        let turned = |now: &f64| reference.is_some_and(|r| r * now < 0.0);
        let found = limits.outside(&y);
        let found = found.or_else(|| now.filter(turned).map(|_| Pause::Extremum));
        if is_forth && found.is_none() {
            // A look that falls onto the turning point itself says nothing; the next one does.
            *before = now.filter(|n| *n != 0.0).or(*before);
        }
        Ok(found)
    };
    let Ok(found) = first_crossing([from, to], look);
    found
}

#[cfg(test)]
mod tests;

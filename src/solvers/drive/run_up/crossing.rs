//! Where within a step a limit is crossed.

use super::stepper::{PHI, PSI, State, Stepper};

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

/// Inner points of a step at which the limits are looked at.
const LOOKS: u32 = 4;

/// Halvings of a part of a step: down to rounding.
const HALVINGS: u32 = 60;

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
    let (a, b) = (stepper.t_before(), stepper.t());
    let mut left = a;
    for look in 1..=LOOKS {
        let (right, y) = match look == LOOKS {
            true => (b, *stepper.y()),
            false => {
                let t = a + (b - a) * f64::from(look) / f64::from(LOOKS);
                (t, stepper.between(t))
            }
        };
        let reference = before.filter(|b| *b != 0.0);
        let now = before.map(|_| acceleration(right, &y));
        let turned = |now: f64| reference.is_some_and(|r| r * now < 0.0);
        let here = |y: &State, now: Option<f64>| {
            limits
                .outside(y)
                .or_else(|| now.filter(|n| turned(*n)).map(|_| Pause::Extremum))
        };
        if let Some(mut pause) = here(&y, now) {
            let (mut lo, mut hi) = (left, right);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (lo + hi);
                if !(lo < middle && middle < hi) {
                    break;
                }
                let y = stepper.between(middle);
                let now = reference.map(|_| acceleration(middle, &y));
                // The first crossing may change on the way.
                match here(&y, now) {
                    Some(earlier) => (hi, pause) = (middle, earlier),
                    None => lo = middle,
                }
            }
            return Some((hi, pause));
        }
        left = right;
        // A look that falls onto the turning point itself says nothing; the next one does.
        *before = now.filter(|n| *n != 0.0).or(*before);
    }
    None
}

#[cfg(test)]
mod tests;

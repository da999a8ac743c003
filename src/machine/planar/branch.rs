//! The choice of a branch, and how far the drive goes on it.

use super::Machine;
use crate::machine::reach::{self, TURNS};
use crate::solvers::planar::{Loads, Modes, SingularKind, State};
use std::f64::consts::TAU;

/// Angles that differ by less, in radians, are one but for rounding.
const SAME: f64 = 1e-9;
/// How near the bodies' angles have to be to choose a mode: 15 degrees.
const NEAR: f64 = 0.262;
/// How close to a singular position rows are computed, in radians.
pub const MARGIN: f64 = 1e-6;

/// The end of a branch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The user's drive there, in radians or metres.
    pub drive: f64,
    /// A fold or a change point; `None` if the singular position could not be refined.
    pub kind: Option<SingularKind>,
}

/// The range of the drive; an end is `None` where a displacement goes as far as its range.
pub type Reach = reach::Reach<Option<End>>;

/// A branch.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Number of the mode at the start.
    pub mode: usize,
    /// Their number.
    pub modes: usize,
    /// True if these are all; not where one may be singular.
    pub complete: bool,
    /// The position at the start.
    pub start: State,
    /// The range of the drive.
    pub reach: Reach,
    /// Masses and loads, if the file has them.
    pub loads: Option<Loads>,
}

impl Branch {
    /// A value of the drive (user's, radians or metres) on the branch's own count of turns; nothing
    /// where the branch does not reach.
    pub fn turned_to(&self, machine: &Machine, drive: f64) -> Option<f64> {
        let Reach::Part { low, high } = self.reach else {
            return Some(drive);
        };
        let low = low.map_or(f64::NEG_INFINITY, |e| e.drive + MARGIN);
        let high = high.map_or(f64::INFINITY, |e| e.drive - MARGIN);
        let at = match machine.rotary() && low.is_finite() {
            true => drive + ((low - drive) / TAU).ceil() * TAU,
            false => drive,
        };
        (low <= at && at <= high).then_some(at)
    }

    /// The end of the branch at which a value of the drive lies: there the position is singular and
    /// has no row.
    pub fn end_at(&self, machine: &Machine, drive: f64) -> Option<End> {
        let Reach::Part { low, high } = self.reach else {
            return None;
        };
        let off = |end: &End| match machine.rotary() {
            true => wrapped(drive - end.drive).abs(),
            false => (drive - end.drive).abs(),
        };
        let ends = [low, high].into_iter().flatten();
        let mut near =
            ends.filter(|e| off(e) <= MARGIN && self.turned_to(machine, drive).is_none());
        near.next()
    }
}

/// Why there is no branch.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanarError {
    /// There are fewer assembly modes.
    #[error("there is no branch {number} at {at}; there are {count}, counted from 0")]
    NoSuchMode {
        /// The number asked for.
        number: usize,
        /// The drive with its unit.
        at: String,
        /// Their number.
        count: usize,
    },
    /// No mode is near the angles given.
    #[error("no assembly mode at {at} has its bodies within 15 deg of {what}; {listed}")]
    NoModeNear {
        /// The drive with its unit.
        at: String,
        /// `start.near` or the drawing.
        what: &'static str,
        /// The modes that there are.
        listed: String,
    },
    /// There are several, and nothing says which.
    #[error("which branch? {listed}; write --branch N, --all-branches, or start.near in the file")]
    Ambiguous {
        /// The modes that there are.
        listed: String,
    },
    /// The loops do not close.
    #[error("the mechanism cannot be assembled at {at}{more}")]
    NotHere {
        /// The drive with its unit.
        at: String,
        /// Where it can be.
        more: String,
    },
    /// A group that is not solved.
    #[error(
        "the positions at {at} were not found: a group has gears among its unknowns, is too large, has special dimensions, or the position is singular"
    )]
    Unsolved {
        /// The drive with its unit.
        at: String,
    },
}

impl Machine {
    /// The user's drive in words.
    pub fn drive_text(&self, drive: f64) -> String {
        self.rounded_text(drive, [1e9, 1e12])
    }

    /// The user's drive at the end of a branch in words. A change point is a double root, so that
    /// half of the digits are known; a fold is refined to nearly all.
    pub fn end_text(&self, drive: f64, kind: Option<SingularKind>) -> String {
        match kind {
            Some(SingularKind::ChangePoint) => self.rounded_text(drive, [1e6, 1e8]),
            _ => self.drive_text(drive),
        }
    }

    /// The drive rounded to parts of a degree or of a metre.
    fn rounded_text(&self, drive: f64, [degree, metre]: [f64; 2]) -> String {
        // Adding 0 takes the sign from a zero.
        let rounded = |x: f64, parts: f64| (x * parts).round() / parts + 0.0;
        match self.rotary() {
            true => format!("{} deg", rounded(drive.to_degrees(), degree)),
            false => format!("{} m", rounded(drive, metre)),
        }
    }

    /// The angle of a body's line in radians.
    pub fn line(&self, state: &State, body: usize) -> f64 {
        self.solver.body_angle(state, body).angle.rad() + self.lines[body]
    }

    fn listed(&self, modes: &Modes) -> String {
        let of = |(k, s): (usize, &State)| {
            let angles = (1..self.bodies.len()).map(|b| {
                let degrees = wrapped(self.line(s, b)).to_degrees();
                format!("{} {:.3}", self.bodies[b], degrees)
            });
            format!("{k}: {} deg", angles.collect::<Vec<_>>().join(", "))
        };
        let most = 20;
        let mut all: Vec<String> = modes.states.iter().take(most).enumerate().map(of).collect();
        if modes.states.len() > most {
            all.push(format!("{} more", modes.states.len() - most));
        }
        format!("there are {}", all.join("; "))
    }

    /// Where over a turn, or the drive's range, the mechanism can be assembled.
    fn elsewhere(&self) -> String {
        const TRIED: u32 = 360;
        let (from, to) = match self.window {
            Some([from, to, _]) => (from, to),
            None => (0.0, TAU),
        };
        let at = |k: u32| from + (to - from) * f64::from(k) / f64::from(TRIED);
        let good = (0..TRIED).find(|&k| {
            !self
                .solver
                .assembly_modes(self.inner(at(k)))
                .states
                .is_empty()
        });
        match good {
            Some(k) => format!(", but can be at {}", self.drive_text(at(k))),
            None => format!(", nor at any of {TRIED} values of the drive"),
        }
    }
}

/// The angle within half a turn of zero.
pub(super) fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// The mode at the drive (user's, radians or metres) that is asked for.
fn mode_at(
    machine: &Machine,
    drive: f64,
    number: Option<usize>,
    use_start: bool,
) -> Result<(usize, Modes), PlanarError> {
    let modes = machine.solver.assembly_modes(machine.inner(drive));
    let at = machine.drive_text(drive);
    let count = modes.states.len();
    if count == 0 {
        return Err(match modes.complete && !modes.near_singular {
            false => PlanarError::Unsolved { at },
            true => PlanarError::NotHere {
                at,
                more: machine.elsewhere(),
            },
        });
    }
    let start = &machine.start;
    let number = number.or(start.mode.filter(|_| use_start));
    if let Some(number) = number {
        return match number < count {
            true => Ok((number, modes)),
            false => Err(PlanarError::NoSuchMode { number, at, count }),
        };
    }
    if use_start && !start.near.is_empty() {
        let apart = |s: &State| {
            let of = |(b, a): &(usize, f64)| wrapped(machine.line(s, *b) - a).abs();
            start.near.iter().map(of).fold(0.0, f64::max)
        };
        // Frames are drawn unturned: that tells apart modes that differ in bodies drawn by one
        // point.
        let turned = |s: &State| {
            let of = |b| wrapped(machine.solver.body_angle(s, b).angle.rad()).abs();
            let bodies = (1..machine.bodies.len()).filter(|_| start.drawn);
            bodies.map(of).fold(0.0, f64::max)
        };
        let order = |&a: &usize, &b: &usize| {
            let (a, b) = (&modes.states[a], &modes.states[b]);
            let (near, other) = (apart(a), apart(b));
            match (near - other).abs() < SAME {
                true => turned(a).total_cmp(&turned(b)),
                false => near.total_cmp(&other),
            }
        };
        let best = (0..count).min_by(order);
        return match best.filter(|&k| apart(&modes.states[k]) <= NEAR) {
            Some(k) => Ok((k, modes)),
            None => Err(PlanarError::NoModeNear {
                at,
                what: if start.drawn {
                    "the drawing"
                } else {
                    "start.near"
                },
                listed: machine.listed(&modes),
            }),
        };
    }
    match count {
        1 => Ok((0, modes)),
        _ => Err(PlanarError::Ambiguous {
            listed: machine.listed(&modes),
        }),
    }
}

/// The branch through the mode asked for at a drive (user's, radians or metres): the mode of that
/// number, or what the file's start says.
///
/// # Errors
/// [`PlanarError`].
pub fn choose(machine: &Machine, drive: f64, number: Option<usize>) -> Result<Branch, PlanarError> {
    let (mode, found) = mode_at(machine, drive, number, number.is_none())?;
    let complete = found.complete && !found.near_singular;
    let modes = found.states.len();
    let start = found.states.into_iter().nth(mode).expect("a mode there is");
    let reach = reach(machine, &start);
    let loads = machine.loads_on(&start);
    Ok(Branch {
        loads,
        mode,
        modes,
        complete,
        start,
        reach,
    })
}

fn reach(machine: &Machine, start: &State) -> Reach {
    let solver = &machine.solver;
    let from = solver.drive_of(start);
    let end = |to: f64| -> (State, Option<End>) {
        let (last, error) = solver.follow_as_far(start, to);
        let end = error.map(|_| {
            let at = solver.singularity(&last);
            let drive = at.as_ref().map_or(solver.drive_of(&last), |s| s.drive);
            End {
                drive: machine.outer(drive),
                kind: at.map(|s| s.kind),
            }
        });
        (last, end)
    };
    if let Some([low, high, _]) = machine.window {
        return Reach::Part {
            low: end(low).1,
            high: end(high).1,
        };
    }
    let (mut here, high) = end(from + TAU);
    if high.is_some() {
        // The other end is met within a turn, or the branch would go round.
        return Reach::Part {
            low: end(from - TAU).1,
            high,
        };
    }
    for turn in 1..=TURNS {
        let back = (1..machine.bodies.len())
            .all(|b| wrapped(machine.line(&here, b) - machine.line(start, b)).abs() < 1e-6);
        if back {
            return Reach::Whole { turns: Some(turn) };
        }
        match solver.follow(&here, solver.drive_of(&here) + TAU) {
            Ok(next) => here = next,
            Err(_) => break,
        }
    }
    Reach::Whole { turns: None }
}

#[cfg(test)]
mod tests;

//! The branch that is meant, and how far the crank can turn on it.

use super::failure::Failure;
use super::linkage_file::Start;
use super::quantity::nearest;
use mechaudit::solvers::class_iii::{ClassIii, ContinuationError, DeadPosition, State};
use rug::Rational;
use std::f64::consts::TAU;

/// Crank angles tried before a linkage is said not to be assembled anywhere.
const TRIED: u32 = 3600;
/// Turns after which a branch is given up to close.
const TURNS: u32 = 12;
/// How near φ4 has to be to choose a mode: 15 degrees, as a chord.
const NEAR: f64 = 0.261;
/// How close to a fold rows are computed, in radians.
const MARGIN: f64 = 1e-6;

/// The end of a branch, where the linkage is singular.
#[derive(Clone, Copy, Debug)]
pub struct End {
    /// Crank angle of the fold in radians, on the branch's own count of turns.
    pub phi1: f64,
    /// The last crank angle in use, a millionth of a radian within the branch.
    pub reached: f64,
    /// φ4 of the two modes that merge, in radians.
    pub phi4: f64,
}

/// How far the crank turns.
#[derive(Clone, Copy, Debug)]
pub enum Reach {
    /// All round; the linkage is back where it was after so many turns (`None`: not within 12).
    Whole { turns: Option<u32> },
    /// Between two folds.
    Part { low: End, high: End },
}

/// A branch with what is known of it.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Number of the mode at the start, counted from 0 by φ4.
    pub mode: usize,
    pub start: State,
    pub reach: Reach,
    pub dead: Vec<DeadPosition>,
}

/// Finds the branch: the mode `number`, else what the file says, else the only one.
pub fn choose(
    linkage: &ClassIii,
    phi1: &Rational,
    number: Option<usize>,
    start: &Start,
) -> Result<Branch, Failure> {
    let degrees = nearest(phi1);
    let angle = degrees.to_radians();
    let modes = linkage.assembly_modes(angle).modes;
    if modes.is_empty() {
        return Err(unassembled(linkage, degrees));
    }
    let mode = match (number.or(start.mode), &start.phi4) {
        (Some(n), _) if n < modes.len() => n,
        (Some(n), _) => {
            return Err(Failure::new(format!(
                "there is no branch {n} at phi1 = {degrees} deg; {}",
                listed(&modes)
            )));
        }
        (None, Some(phi4)) => {
            let off = |k: usize| 2.0 * (0.5 * (modes[k].phi4 - phi4.to_f64())).sin().abs();
            let nearest = (0..modes.len()).min_by(|&a, &b| off(a).total_cmp(&off(b)));
            match nearest.filter(|&k| off(k) <= NEAR) {
                Some(k) => k,
                None => {
                    return Err(Failure::new(format!(
                        "no assembly mode at phi1 = {degrees} deg has phi4 within 15 deg of start.phi4 = {} deg; {}",
                        (phi4.to_f64().to_degrees() * 1e6).round() / 1e6,
                        listed(&modes)
                    )));
                }
            }
        }
        (None, None) if modes.len() == 1 => 0,
        (None, None) => {
            return Err(Failure::new(format!(
                "which branch? {}; write --branch N, --all-branches, or start.phi4 in the file",
                listed(&modes)
            )));
        }
    };
    let state = linkage
        .state_near(angle, modes[mode])
        .map_err(|e| Failure::new(e.to_string()))?;
    explore(linkage, mode, state)
}

fn listed(modes: &[mechaudit::solvers::class_iii::Positions]) -> String {
    let all: Vec<String> = modes
        .iter()
        .enumerate()
        .map(|(k, m)| format!("{k} (phi4 = {:.3} deg)", m.phi4.to_degrees()))
        .collect();
    format!("the assembly modes there are {}", all.join(", "))
}

/// Why there is no mode at the angle.
pub fn unassembled(linkage: &ClassIii, degrees: f64) -> Failure {
    let angle = |k: u32| f64::from(k) * 360.0 / f64::from(TRIED);
    let possible = |k: &u32| {
        !linkage
            .assembly_modes(angle(*k).to_radians())
            .modes
            .is_empty()
    };
    let some: Vec<u32> = (0..TRIED).filter(possible).collect();
    if some.is_empty() {
        return Failure::new(format!(
            "the linkage cannot be assembled: no position closes the loops at any of {TRIED} crank angles over the turn"
        ));
    }
    let mut parts: Vec<(u32, u32)> = Vec::new();
    for k in some {
        match parts.last_mut() {
            Some(last) if last.1 + 1 == k => last.1 = k,
            _ => parts.push((k, k)),
        }
    }
    let parts: Vec<String> = parts
        .iter()
        .map(|p| format!("{:.1} to {:.1} deg", angle(p.0), angle(p.1)))
        .collect();
    Failure::new(format!(
        "the linkage cannot be assembled at phi1 = {degrees} deg, but can be from {}; choose start.phi1 or --from-deg there",
        parts.join(" and from ")
    ))
}

/// Follows the branch both ways.
fn explore(linkage: &ClassIii, mode: usize, start: State) -> Result<Branch, Failure> {
    let mut here = start;
    let mut turns = None;
    let mut high = None;
    for k in 1..=TURNS {
        match linkage.follow(&here, start.phi1 + TAU * f64::from(k)) {
            Ok(state) => here = state,
            Err(e) => {
                high = Some(end(linkage, &start, e, 1.0)?);
                break;
            }
        }
        if same(&here, &start) {
            turns = Some(k);
            break;
        }
    }
    let Some(high) = high else {
        let to = start.phi1 + TAU * f64::from(turns.unwrap_or(1));
        return Ok(Branch {
            mode,
            start,
            reach: Reach::Whole { turns },
            dead: linkage.dead_positions(&start, to).unwrap_or_else(|e| e.0),
        });
    };
    let low = match linkage.follow(&start, start.phi1 - TAU * f64::from(TURNS)) {
        Err(e) => end(linkage, &start, e, -1.0)?,
        // A fold on one side only would have to be met from the other side too.
        Ok(_) => return Err(Failure::new("the branch ends on one side only")),
    };
    let dead = |to: f64| linkage.dead_positions(&start, to).unwrap_or_else(|e| e.0);
    let mut all = dead(low.reached);
    all.extend(dead(high.reached));
    all.sort_by(|a, b| a.state.phi1.total_cmp(&b.state.phi1));
    all.dedup_by(|a, b| (a.state.phi1 - b.state.phi1).abs() < 1e-12);
    Ok(Branch {
        mode,
        start,
        reach: Reach::Part { low, high },
        dead: all,
    })
}

fn same(a: &State, b: &State) -> bool {
    let (p, q) = (a.positions.to_array(), b.positions.to_array());
    p.iter()
        .zip(q)
        .all(|(x, y)| (0.5 * (x - y)).sin().abs() < 1e-6)
}

/// The fold that ended the branch, refined by the branch tracer.
fn end(
    linkage: &ClassIii,
    start: &State,
    why: ContinuationError,
    direction: f64,
) -> Result<End, Failure> {
    let ContinuationError::Fold { phi1: reached } = why else {
        return Err(Failure::new(why.to_string()));
    };
    let last = match linkage.follow(start, reached) {
        Ok(state) => state,
        Err(ContinuationError::Fold { .. }) => *start,
        Err(e) => return Err(Failure::new(e.to_string())),
    };
    let inset = MARGIN.min(0.5 * (last.phi1 - start.phi1).abs());
    let plain = End {
        phi1: reached,
        reached: last.phi1 - direction * inset,
        phi4: last.positions.phi4,
    };
    // From a little before the last angle reached to a little beyond the fold.
    let before = last.phi1 - direction * 1e-4;
    let Ok(before) = linkage.follow(&last, before) else {
        return Ok(plain);
    };
    let map = linkage.trace_branches(&[before.phi1, last.phi1 + direction * 2e-3]);
    let Some(ours) = map.rows[0].iter().find(|s| same(&s.state, &before)) else {
        return Ok(plain);
    };
    let fold = map
        .folds
        .iter()
        .find(|f| !f.begins && f.branches.contains(&ours.branch));
    Ok(fold.map_or(plain, |f| End {
        phi1: f.phi1,
        phi4: f.phi4,
        ..plain
    }))
}

impl Branch {
    /// One line about how far the crank turns.
    pub fn range_line(&self) -> String {
        match self.reach {
            Reach::Whole { turns: Some(1) } => "the crank turns fully on this branch".into(),
            Reach::Whole { turns: Some(n) } => format!(
                "the crank turns fully on this branch; the linkage is back in its position after {n} turns"
            ),
            Reach::Whole { turns: None } => {
                format!("the crank turns fully on this branch, at least {TURNS} times")
            }
            Reach::Part { low, high } => format!(
                "the crank cannot turn fully on this branch: it reaches from {:.6} deg to {:.6} deg, where assembly modes merge",
                low.phi1.to_degrees(),
                high.phi1.to_degrees()
            ),
        }
    }

    /// One line about the dead positions.
    pub fn dead_line(&self) -> Option<String> {
        let all: Vec<String> = self
            .dead
            .iter()
            .map(|d| {
                let how = if d.stretched { "stretched" } else { "folded" };
                format!("{:.6} deg ({how})", d.state.phi1.to_degrees())
            })
            .collect();
        let line = "dead positions, crank and link 2 in line, at";
        (!all.is_empty()).then(|| format!("{line} {}", all.join(", ")))
    }
}

//! The choice of a branch, and the crank's range on it.

use super::Start;
use crate::machine::reach;
pub use crate::machine::reach::TURNS;
use crate::reference::nearest_f64;
use crate::solvers::class_iii::{ClassIii, ContinuationError, DeadPosition, Positions, State};
use crate::solvers::units::Angle;
use rug::Rational;
use std::f64::consts::TAU;

/// Crank angles tried before a linkage is said not to be assembled anywhere.
const TRIED: u32 = 3600;
/// How near φ4 has to be to choose a mode: 15 degrees, as a chord.
const NEAR: f64 = 0.261;
/// How close to a fold rows are computed, in radians.
const MARGIN: f64 = 1e-6;
/// Angles between which the branch tracer looks for a fold, before and beyond the last position, in
/// radians.
const BEFORE: f64 = 1e-4;
const BEYOND: f64 = 2e-3;

/// The end of a branch, where the linkage is singular.
#[derive(Clone, Copy, Debug)]
pub struct End {
    /// Crank angle of the fold in radians, on the branch's own count of turns.
    pub phi1: f64,
    /// The last crank angle in use, a millionth of a radian before the last position found.
    pub reached: f64,
    /// φ4 of the two modes that merge, in radians.
    pub phi4: f64,
}

/// The range of the crank's turn, all round or between two folds.
pub type Reach = reach::Reach<End>;

/// A branch with its range and dead positions.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Number of the mode at the start, counted from 0 by φ4.
    pub mode: usize,
    /// The position at the start.
    pub start: State,
    /// The range of the crank's turn.
    pub reach: Reach,
    /// Where crank and link 2 are in line.
    pub dead: Vec<DeadPosition>,
}

/// Why there is no branch.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BranchError {
    /// There are fewer assembly modes.
    #[error(
        "there is no branch {number} at phi1 = {degrees} deg; {}",
        listed(modes)
    )]
    NoSuchMode {
        /// The number asked for.
        number: usize,
        /// The crank angle in degrees.
        degrees: f64,
        /// φ4 of the modes that there are, in radians.
        modes: Vec<f64>,
    },
    /// No mode is near the φ4 that the file gives.
    #[error(
        "no assembly mode at phi1 = {degrees} deg has phi4 within 15 deg of start.phi4 = {} deg; {}",
        (phi4.to_degrees() * 1e6).round() / 1e6, listed(modes)
    )]
    NoModeNear {
        /// The crank angle in degrees.
        degrees: f64,
        /// The φ4 asked for, in radians.
        phi4: f64,
        /// φ4 of the modes that there are, in radians.
        modes: Vec<f64>,
    },
    /// Nothing says which.
    #[error(
        "which branch? {}; write --branch N, --all-branches, or start.phi4 in the file",
        listed(modes)
    )]
    Ambiguous {
        /// φ4 of the modes that there are, in radians.
        modes: Vec<f64>,
    },
    /// The loops close at no crank angle.
    #[error(
        "the linkage cannot be assembled: no position closes the loops at any of {TRIED} crank angles over the turn"
    )]
    Nowhere,
    /// The loops close at other crank angles.
    #[error(
        "the linkage cannot be assembled at phi1 = {degrees} deg, but can be {}; choose start.phi1 or --from-deg there",
        spans(parts)
    )]
    NotHere {
        /// The crank angle in degrees.
        degrees: f64,
        /// Where it can be, from and to in degrees.
        parts: Vec<[f64; 2]>,
    },
    /// A fold on one side only would have to be met from the other side too.
    #[error("the branch ends on one side only")]
    OneSided,
    /// The continuation does not go on.
    #[error(transparent)]
    Continuation(#[from] ContinuationError),
}

fn listed(modes: &[f64]) -> String {
    let one = |(k, phi4): (usize, &f64)| format!("{k} (phi4 = {:.3} deg)", phi4.to_degrees());
    let all: Vec<String> = modes.iter().enumerate().map(one).collect();
    format!("the assembly modes there are {}", all.join(", "))
}

fn spans(parts: &[[f64; 2]]) -> String {
    let one = |[from, to]: &[f64; 2]| format!("from {from:.1} to {to:.1} deg");
    parts.iter().map(one).collect::<Vec<_>>().join(" and ")
}

/// Finds the branch at the crank angle `phi1` in degrees: the mode `number`, else what `start`
/// says. Modes come in pairs, so one of them has to be named.
///
/// ```
/// use mechaudit_cli::machine::{class_iii, Linkage, Source};
/// let source = Source::toml(include_str!(concat!(
///     env!("CARGO_MANIFEST_DIR"), "/../../examples/no-full-turn.toml"
/// )));
/// let Linkage::ClassIii(linkage) = Linkage::read(&source)? else { unreachable!() };
/// let start = linkage.start_degrees().unwrap_or_default();
/// let branch = class_iii::choose(&linkage.solver, &start, None, &linkage.start)?;
/// assert!(matches!(branch.reach, class_iii::Reach::Part { .. }));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BranchError`].
pub fn choose(
    linkage: &ClassIii,
    phi1: &Rational,
    number: Option<usize>,
    start: &Start,
) -> Result<Branch, BranchError> {
    let degrees = nearest_f64(phi1);
    let angle = Angle::from_deg(degrees);
    let found = linkage.assembly_modes(angle).modes;
    if found.is_empty() {
        return Err(unassembled(linkage, degrees));
    }
    let modes: Vec<f64> = found.iter().map(|m| m.phi4).collect();
    let mode = match (number.or(start.mode), &start.phi4) {
        (Some(number), _) if number < modes.len() => number,
        (Some(number), _) => {
            return Err(BranchError::NoSuchMode {
                number,
                degrees,
                modes,
            });
        }
        (None, Some(phi4)) => {
            let phi4 = phi4.to_f64();
            let off = |k: usize| 2.0 * (0.5 * (modes[k] - phi4)).sin().abs();
            let nearest = (0..modes.len()).min_by(|&a, &b| off(a).total_cmp(&off(b)));
            match nearest.filter(|&k| off(k) <= NEAR) {
                Some(k) => k,
                None => {
                    return Err(BranchError::NoModeNear {
                        degrees,
                        phi4,
                        modes,
                    });
                }
            }
        }
        (None, None) => return Err(BranchError::Ambiguous { modes }),
    };
    let state = linkage.state_near(angle, found[mode])?;
    explore(linkage, mode, state)
}

/// Why there is no mode at the angle: [`BranchError::Nowhere`] or [`BranchError::NotHere`].
pub fn unassembled(linkage: &ClassIii, degrees: f64) -> BranchError {
    let angle = |k: u32| f64::from(k) * 360.0 / f64::from(TRIED);
    let modes =
        |k: u32| -> Vec<Positions> { linkage.assembly_modes(Angle::from_deg(angle(k))).modes };
    let mut parts: Vec<(u32, u32)> = Vec::new();
    for k in (0..TRIED).filter(|k| !modes(*k).is_empty()) {
        match parts.last_mut() {
            Some(last) if last.1 + 1 == k => last.1 = k,
            _ => parts.push((k, k)),
        }
    }
    match parts.is_empty() {
        true => BranchError::Nowhere,
        false => BranchError::NotHere {
            degrees,
            parts: parts.iter().map(|p| [angle(p.0), angle(p.1)]).collect(),
        },
    }
}

/// Follows the branch both ways.
fn explore(linkage: &ClassIii, mode: usize, start: State) -> Result<Branch, BranchError> {
    let mut here = start;
    let mut turns = None;
    let mut high = None;
    for k in 1..=TURNS {
        match linkage.follow(&here, Angle::from_rad(start.phi1 + TAU * f64::from(k))) {
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
        let to = Angle::from_rad(start.phi1 + TAU * f64::from(turns.unwrap_or(1)));
        return Ok(Branch {
            mode,
            start,
            reach: Reach::Whole { turns },
            dead: linkage.dead_positions(&start, to).unwrap_or_else(|e| e.0),
        });
    };
    let low = match linkage.follow(&start, Angle::from_rad(start.phi1 - TAU * f64::from(TURNS))) {
        Err(e) => end(linkage, &start, e, -1.0)?,
        Ok(_) => return Err(BranchError::OneSided),
    };
    let dead = |to: f64| {
        let found = linkage.dead_positions(&start, Angle::from_rad(to));
        found.unwrap_or_else(|e| e.0)
    };
    let mut all = dead(low.reached);
    all.extend(dead(high.reached));
    all.sort_by(|a, b| a.state.phi1.total_cmp(&b.state.phi1));
    // The start is on both ways.
    all.dedup_by_key(|d| d.state.phi1);
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
) -> Result<End, BranchError> {
    let ContinuationError::Fold { phi1: reached } = why else {
        return Err(why.into());
    };
    let last = match linkage.follow(start, Angle::from_rad(reached)) {
        Ok(state) => state,
        Err(ContinuationError::Fold { .. }) => *start,
        Err(e) => return Err(e.into()),
    };
    let inset = MARGIN.min(0.5 * (last.phi1 - start.phi1).abs());
    let plain = End {
        phi1: reached,
        reached: last.phi1 - direction * inset,
        phi4: last.positions.phi4,
    };
    // From a little before the last angle reached, where the position is too near to the fold to be
    // followed from, to a little beyond the fold.
    let before = last.phi1 - direction * BEFORE;
    let Ok(before) = linkage.follow(start, Angle::from_rad(before)) else {
        return Ok(plain);
    };
    let map =
        linkage.trace_branches(&[before.phi1, last.phi1 + direction * BEYOND].map(Angle::from_rad));
    let Some(ours) = map.rows[0].iter().find(|s| same(&s.state, &before)) else {
        return Ok(plain);
    };
    let fold = map.folds.iter().find(|f| f.branches.contains(&ours.branch));
    Ok(fold.map_or(plain, |f| End {
        phi1: f.phi1,
        phi4: f.phi4,
        ..plain
    }))
}

#[cfg(test)]
mod tests;

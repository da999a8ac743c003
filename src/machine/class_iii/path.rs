//! Positions along a branch.

use super::{Branch, Linkage, Reach};
use crate::solvers::class_iii::{ContinuationError, State};
use crate::solvers::units::Angle;
use std::f64::consts::TAU;

/// `n + 1` positions of the branch over one turn from its start, or over its whole range.
///
/// # Errors
/// Why the branch could not be followed so far.
pub fn path(linkage: &Linkage, branch: &Branch, n: u32) -> Result<Vec<State>, ContinuationError> {
    let (from, to) = match branch.reach {
        Reach::Whole { .. } => (branch.start.phi1, branch.start.phi1 + TAU),
        Reach::Part { low, high } => (low.reached, high.reached),
    };
    let angle = |k: u32| from + (to - from) * f64::from(k) / f64::from(n);
    let angles = (0..=n).map(|k| Angle::from_rad(angle(k)));
    let all = linkage.solver.sweep(&branch.start, angles);
    all.map_err(|(_, e)| e)
}

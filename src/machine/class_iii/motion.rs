//! A branch in motion.

use super::{Branch, Linkage, Reach, path};
use crate::machine::reach::insert_shown;
use crate::motion::{self, Motion};
use crate::solvers::class_iii::{ContinuationError, State};
use crate::solvers::units::Angle;
use std::f64::consts::TAU;

/// Positions of the branch over the turns after which it closes, from `shown` on; or over its whole
/// range, with `shown` among them. Also the number of `shown`.
///
/// # Errors
/// Why the branch could not be followed so far.
pub fn positions(
    linkage: &Linkage,
    branch: &Branch,
    n: u32,
    shown: &State,
) -> Result<(Vec<State>, usize), ContinuationError> {
    let Reach::Whole { turns } = branch.reach else {
        let mut all = path(linkage, branch, n)?;
        let k = insert_shown(&mut all, *shown, |s| s.phi1);
        return Ok((all, k));
    };
    let whole = TAU * f64::from(turns.unwrap_or(1));
    let angle = |k| Angle::from_rad(shown.phi1 + whole * f64::from(k) / f64::from(n));
    let all = linkage.solver.sweep(shown, (0..n).map(angle));
    Ok((all.map_err(|(_, e)| e)?, 0))
}

/// The linkage at these positions, without quantities; `closed` if the first follows the last.
pub fn motion(linkage: &Linkage, states: &[State], start: usize, closed: bool) -> Motion {
    let degrees = states.iter().map(|s| s.phi1.to_degrees()).collect();
    let all = motion::class_iii(&linkage.solver, states, degrees);
    Motion {
        name: linkage.name.clone().unwrap_or(all.name),
        start,
        closed,
        ..all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::{self, Source};

    #[test]
    fn the_shown_position_is_among_those_of_the_range_once() {
        let text = include_str!("../../../examples/no-full-turn.toml");
        let file = machine::Linkage::read(&Source::toml(text)).unwrap();
        let machine::Linkage::ClassIii(linkage) = file else {
            unreachable!("of class III");
        };
        let degrees = linkage.start_degrees().unwrap();
        let branch = super::super::choose(&linkage.solver, &degrees, None, &linkage.start).unwrap();
        let along = path(&linkage, &branch, 4).unwrap();
        let (all, k) = positions(&linkage, &branch, 4, &along[2]).unwrap();
        assert_eq!((all.len(), k), (5, 2));
        let (all, k) = positions(&linkage, &branch, 4, &branch.start).unwrap();
        assert_eq!((all.len(), all[k].phi1), (6, branch.start.phi1));
        assert!(all.is_sorted_by_key(|s| s.phi1));
    }
}

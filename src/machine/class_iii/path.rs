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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::class_iii::{choose, motion, positions};
    use crate::machine::{self, Source};

    fn read(text: &str) -> (Linkage, Branch) {
        let machine::Linkage::ClassIii(linkage) =
            machine::Linkage::read(&Source::toml(text)).unwrap()
        else {
            unreachable!("of class III");
        };
        let degrees = linkage.start_degrees().unwrap();
        let branch = choose(&linkage.solver, &degrees, None, &linkage.start).unwrap();
        (*linkage, branch)
    }

    fn assert_near(found: &[State], due: &[f64]) {
        assert_eq!(found.len(), due.len());
        for (state, due) in found.iter().zip(due) {
            assert!((state.phi1 - due).abs() < 1e-12, "{} {due}", state.phi1);
        }
    }

    /// Over one turn from the start, or between the ends; in motion without the turn's end, over
    /// all turns that it takes.
    #[test]
    fn branches_are_passed_in_equal_steps() {
        let shares = [0.0, 0.25, 0.5, 0.75, 1.0];
        let (linkage, branch) = read(include_str!("../../../examples/sand-screen.toml"));
        let due = shares.map(|s| branch.start.phi1 + s * TAU);
        assert_near(&path(&linkage, &branch, 4).unwrap(), &due);
        for (turns, factor) in [(Some(1), 1.0), (Some(2), 2.0), (None, 1.0)] {
            let branch = Branch {
                reach: Reach::Whole { turns },
                ..branch.clone()
            };
            let (all, k) = positions(&linkage, &branch, 4, &branch.start).unwrap();
            let due = shares.map(|s| branch.start.phi1 + factor * s * TAU);
            assert_eq!(k, 0);
            assert_near(&all, &due[..4]);
        }
        let shown = motion(&linkage, &path(&linkage, &branch, 4).unwrap(), 3, false);
        assert_eq!(
            (Some(shown.name), shown.start, shown.closed),
            (linkage.name.clone(), 3, false)
        );
        for (degrees, phi1) in shown.drive.values.iter().zip(due) {
            assert!((degrees - phi1.to_degrees()).abs() < 1e-10);
        }
        let nameless = Linkage {
            name: None,
            ..linkage
        };
        assert_eq!(
            motion(&nameless, &[branch.start], 0, true).name,
            "class-III linkage"
        );
        let (linkage, branch) = read(include_str!("../../../examples/no-full-turn.toml"));
        let Reach::Part { low, high } = branch.reach else {
            panic!("the crank does not turn fully");
        };
        let due = shares.map(|s| low.reached + s * (high.reached - low.reached));
        assert_near(&path(&linkage, &branch, 4).unwrap(), &due);
    }
}

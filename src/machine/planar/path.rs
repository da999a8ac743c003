//! Positions along a branch.

use super::{Branch, MARGIN, Machine, Reach};
use crate::solvers::planar::State;
use std::f64::consts::TAU;

/// Up to `n + 1` positions of the branch over one turn from its start, or over its whole range, each with the
/// user's drive in radians or metres.
pub fn path(machine: &Machine, branch: &Branch, n: u32) -> Vec<(f64, State)> {
    along(machine, branch, n, &branch.start, 1)
}

/// Positions of the branch over the turns after which it closes, from `shown` on; or over its whole range, with
/// `shown` among them. Also the number of `shown`.
pub fn positions(
    machine: &Machine,
    branch: &Branch,
    n: u32,
    shown: &State,
) -> (Vec<(f64, State)>, usize) {
    if let Reach::Whole { turns } = branch.reach {
        let mut all = along(machine, branch, n, shown, turns.unwrap_or(1));
        all.pop();
        return (all, 0);
    }
    let mut all = along(machine, branch, n, &branch.start, 1);
    let drive = machine.outer(machine.solver.drive_of(shown));
    let k = all.partition_point(|p| p.0 < drive);
    if all.get(k).is_none_or(|p| p.0 != drive) {
        all.insert(k, (drive, shown.clone()));
    }
    (all, k)
}

fn along(
    machine: &Machine,
    branch: &Branch,
    n: u32,
    start: &State,
    turns: u32,
) -> Vec<(f64, State)> {
    let solver = &machine.solver;
    let from = machine.outer(solver.drive_of(start));
    let (low, high) = match (branch.reach, machine.window) {
        (Reach::Whole { .. }, _) => (from, from + TAU * f64::from(turns)),
        (Reach::Part { low, high }, window) => {
            let [a, b] = window.map_or([from; 2], |w| [w[0], w[1]]);
            let low = low.map_or(a, |e| e.drive + MARGIN);
            (low, high.map_or(b, |e| e.drive - MARGIN))
        }
    };
    let mut here = start.clone();
    let mut all = Vec::new();
    for k in 0..=n {
        let drive = low + (high - low) * f64::from(k) / f64::from(n);
        let (next, error) = solver.follow_as_far(&here, machine.inner(drive));
        here = next;
        if error.is_none() {
            all.push((drive, here.clone()));
        }
    }
    all
}

//! Positions along a branch.

use super::{Branch, MARGIN, Machine, Reach};
use crate::machine::reach::insert_shown;
use crate::solvers::planar::State;
use std::f64::consts::TAU;

/// Up to `n + 1` positions of the branch over one turn from its start, or over its whole range,
/// each with the user's drive in radians or metres.
pub fn path(machine: &Machine, branch: &Branch, n: u32) -> Vec<(f64, State)> {
    along(machine, branch, n, &branch.start, 1)
}

/// Positions of the branch over the turns after which it closes, from `shown` on; or over its whole
/// range, with `shown` among them. Also the number of `shown`.
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
    let k = insert_shown(&mut all, (drive, shown.clone()), |p| p.0);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Source;
    use crate::machine::planar::choose;

    fn read(text: &str) -> Machine {
        Machine::read(&Source::toml(text)).unwrap()
    }

    fn assert_near(found: &[(f64, State)], due: &[f64]) {
        assert_eq!(found.len(), due.len());
        for ((drive, _), due) in found.iter().zip(due) {
            assert!((drive - due).abs() < 1e-9, "{drive} {due}");
        }
    }

    /// Each position is the solver's at its drive, a millionth of a radian off the folds.
    #[test]
    fn a_part_of_a_turn_is_passed_in_equal_steps() {
        let machine = read(include_str!("../../../examples/watt-1.toml"));
        let start = machine.start.at.unwrap().to_radians();
        let branch = choose(&machine, start, None).unwrap();
        let Reach::Part { low, high } = branch.reach else {
            panic!("no full turn");
        };
        let (low, high) = (low.unwrap().drive + 1e-6, high.unwrap().drive - 1e-6);
        let due = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| low + s * (high - low));
        let all = path(&machine, &branch, 4);
        assert_near(&all, &due);
        for (drive, state) in &all {
            assert!((machine.outer(machine.solver.drive_of(state)) - drive).abs() < 1e-14);
            let there = machine
                .solver
                .follow(&branch.start, machine.inner(*drive))
                .unwrap();
            let turn = |s: &State| machine.solver.body_angle(s, 3).angle.rad();
            assert!((turn(state) - turn(&there)).abs() < 1e-9);
        }
        // The position shown is among them, once.
        let (same, k) = positions(&machine, &branch, 4, &all[2].1);
        assert_eq!((same.len(), k), (5, 2));
        let (more, k) = positions(&machine, &branch, 4, &branch.start);
        assert_eq!(more.len(), 6);
        assert!((more[k].0 - start).abs() < 1e-14 && more.is_sorted_by(|a, b| a.0 < b.0));
    }

    #[test]
    fn a_turn_is_passed_from_its_start() {
        let machine = read(include_str!("../../../examples/watt-2.toml"));
        let start = machine.start.at.unwrap_or(10.0).to_radians();
        let branch = choose(&machine, start, None).unwrap();
        let due = [0.0, 0.25, 0.5, 0.75, 1.0].map(|s| start + s * TAU);
        assert_near(&path(&machine, &branch, 4), &due);
        let (all, k) = positions(&machine, &branch, 4, &branch.start);
        assert_eq!(k, 0);
        assert_near(&all, &due[..4]);
    }

    /// To the ends of the range, or to the fold within it.
    #[test]
    fn a_displacement_goes_over_its_range() {
        let boom = include_str!("../../../examples/cylinder-boom.toml");
        let fold = 1.2f64.hypot(0.1) + 0.4f64.hypot(0.6) - 1e-6;
        for (to, end) in [("1.4 m", 1.4), ("3 m", fold)] {
            let machine = read(&boom.replace("\"1.4 m\"", &format!("\"{to}\"")));
            let branch = choose(&machine, 1.0, None).unwrap();
            let due = [0.0, 0.5, 1.0].map(|s| 0.9 + s * (end - 0.9));
            assert_near(&path(&machine, &branch, 2), &due);
        }
    }
}

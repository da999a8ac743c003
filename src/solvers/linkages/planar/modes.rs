//! All assembly modes: every real solution of every group in turn.

use super::chain::Block;
use super::circles::meet;
use super::homotopy::{self, MOST_UNKNOWNS};
use super::isotropic::{Isotropic, NoForms};
use super::mechanism::Mechanism;
use super::newton::Work;
use super::pose::Pose;
use super::state::State;
use super::windings::wind;

/// Every position that closes the loops at one value of the drive.
#[derive(Clone, Debug)]
pub struct Modes {
    /// The drive in radians or metres.
    pub drive: f64,
    /// The positions, ordered by their unknowns. Singular ones, which have no rates, are left out.
    pub states: Vec<State>,
    /// Tells whether the method finds every isolated position: a closed form or a resultant for
    /// dyads and triads, for other groups a homotopy none of whose paths was lost; and whether all
    /// windings were tried: whole turns of an angle behind which gears or racks are somewhere else.
    pub complete: bool,
    /// Tells whether positions are so close to merging that rounding may have added or removed
    /// them, or one of them is singular.
    pub near_singular: bool,
}

/// Solutions of one group.
#[derive(Default)]
struct Found {
    poses: Vec<Pose>,
    incomplete: bool,
    near: bool,
}

impl Found {
    /// Returns what the ends of the homotopy's paths say beside the solutions.
    fn take(&mut self, ends: &homotopy::Ends) {
        self.incomplete |= ends.lost > 0;
        self.near |= ends.merged > 0;
    }
}

/// How far, in radians or units of length, Newton's method may move a solution.
const FARTHEST: f64 = 1e-2;
/// Solutions nearer than this are one.
const SAME: f64 = 1e-9;
/// Solutions nearer than this may have been told apart, or not, by rounding: it moves them by its
/// root where they merge.
const MERGING: f64 = 1e-6;
/// Positions kept at most; beyond them the result is not complete.
const MOST_POSITIONS: usize = 10_000;

impl Mechanism {
    /// All assembly modes at one value of the drive, in radians or metres.
    ///
    /// Dyads and other groups with one complex unknown in closed form, triads by a polynomial of
    /// degree 6, other groups by a homotopy with C(2n, n) paths up to n = 6. Groups that have gears
    /// among their unknowns, and larger ones, are not solved: then the result is empty and not
    /// complete.
    ///
    /// Where a gear or rack follows an angle that pins give up to whole turns, each turn that moves
    /// something is a mode of its own: a wheel with twice the teeth has two positions. With gears
    /// these are as many as the least common denominator of the ratios; with a rack they are
    /// finitely many where pins join it to its guide, else endless, and the result is not complete.
    pub fn assembly_modes(&self, drive: f64) -> Modes {
        let chain = &self.chain;
        let mut modes = Modes {
            drive,
            states: Vec::new(),
            complete: true,
            near_singular: false,
        };
        if !drive.is_finite() {
            return modes;
        }
        let mut work = Work::new(chain);
        let start = Pose::new(chain, self.inner_drive(drive), vec![0.0; chain.unknowns]);
        let mut poses = vec![start];
        for k in 0..chain.blocks.len() {
            let mut next = Vec::new();
            for pose in &self.windings.before(chain, k, poses) {
                let found = self.solve_block(k, pose, &mut work);
                modes.complete &= !found.incomplete;
                modes.near_singular |= found.near;
                next.extend(found.poses);
            }
            poses = self.windings.after(k, next);
            if poses.len() > MOST_POSITIONS {
                modes.complete = false;
                poses.truncate(MOST_POSITIONS);
            }
        }
        modes.complete &= !self.windings.endless;
        if self.windings.overlap() {
            self.keep_one_of_each(&mut poses);
        }
        modes.states.reserve_exact(poses.len());
        for pose in poses {
            match State::within(self, pose, &mut work) {
                Some(state) => modes.states.push(state),
                None => modes.near_singular = true,
            }
        }
        modes.states.sort_by(|a, b| {
            let pairs = a.pose.u.iter().zip(&b.pose.u).map(|(x, y)| x.total_cmp(y));
            pairs.fold(std::cmp::Ordering::Equal, std::cmp::Ordering::then)
        });
        modes
    }

    /// Removes positions that are another one but for whole turns.
    fn keep_one_of_each(&self, poses: &mut Vec<Pose>) {
        let chain = &self.chain;
        let same =
            |a: &Pose, b: &Pose| (0..chain.unknowns).all(|k| chain.apart(k, a.u[k], b.u[k]) < SAME);
        let mut kept: Vec<Pose> = Vec::new();
        for pose in poses.drain(..) {
            if !kept.iter().any(|k| same(k, &pose)) {
                kept.push(pose);
            }
        }
        *poses = kept;
    }

    fn solve_block(&self, k: usize, pose: &Pose, work: &mut Work) -> Found {
        let block = &self.chain.blocks[k];
        let mut found = Found::default();
        if let Some((modes, near)) = self.triads[k].as_ref().and_then(|t| t.modes(pose)) {
            found.near = near;
            for angles in modes {
                let mut trial = pose.clone();
                for (body, angle) in angles {
                    if let Some(u) = self.chain.turns[body].unknown {
                        trial.u[u] = angle;
                    }
                }
                trial.place(&self.chain, &block.placed);
                self.collect(block, trial, work, &mut found);
            }
            return found;
        }
        let system = match Isotropic::new(&self.chain, block, pose) {
            Ok(system) => system,
            Err(NoForms::Contradiction) => return found,
            Err(NoForms::Gears | NoForms::Special) => {
                found.incomplete = true;
                return found;
            }
        };
        let solutions = match system.n {
            0 => vec![Vec::new()],
            1 => {
                let meeting = meet(&system.forms);
                found.near |= meeting.near;
                found.incomplete |= meeting.same;
                meeting.points.into_iter().map(|x| vec![x]).collect()
            }
            n if n <= MOST_UNKNOWNS => {
                let ends = homotopy::all(&system.forms);
                found.take(&ends);
                ends.real
            }
            _ => {
                found.incomplete = true;
                Vec::new()
            }
        };
        for x in solutions {
            let mut trial = pose.clone();
            system.settle(&self.chain, block, &mut trial, &x);
            wind(&self.chain, block, &mut trial);
            self.collect(block, trial, work, &mut found);
        }
        found
    }

    /// Refines a solution and adds it if it is new.
    fn collect(&self, block: &Block, mut pose: Pose, work: &mut Work, found: &mut Found) {
        work.before.clone_from(&pose.u);
        if !self.chain.newton(&mut pose, Some(block), work) {
            found.near = true;
            return;
        }
        let range = block.unknowns.clone();
        let before = &work.before;
        let scale = |k: usize| {
            if self.chain.lengths[k] {
                1.0 + before[k].abs()
            } else {
                1.0
            }
        };
        let apart = |a: &[f64], b: &[f64]| -> f64 {
            let of = |k: usize| self.chain.apart(k, a[k], b[k]) / scale(k);
            range.clone().map(of).fold(0.0, f64::max)
        };
        if apart(&pose.u, before) > FARTHEST {
            found.near = true;
            return;
        }
        let nearest = found.poses.iter().map(|p| apart(&p.u, &pose.u));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        found.near |= (SAME..MERGING).contains(&nearest);
        if !(nearest < SAME) {
            found.poses.push(pose);
        }
    }
}

#[cfg(test)]
mod tests;

//! All branches over a range of the drive, and the singular positions where they begin and end.

use super::continuation::Follower;
use super::mechanism::Mechanism;
use super::singular::Singularity;
use super::state::State;

/// One position with the branch it lies on.
#[derive(Clone, Debug)]
pub struct BranchSample {
    /// The branch, numbered from 0 in the order of appearance.
    pub branch: usize,
    /// The mechanism there.
    pub state: State,
}

/// Where branches end or begin.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchEnd {
    /// The singular position; `None` if it could not be refined.
    pub at: Option<Singularity>,
    /// The last value of the drive reached on the branches, in radians or metres.
    pub drive: f64,
    /// The branches.
    pub branches: Vec<usize>,
    /// Tells whether they begin here (in the direction of travel) rather than end.
    pub begins: bool,
}

/// Every position at a list of values of the drive, tagged with its branch.
#[derive(Clone, Debug, Default)]
pub struct BranchMap {
    /// For each value of the drive, the positions there.
    pub rows: Vec<Vec<BranchSample>>,
    /// Number of branches met.
    pub branches: usize,
    /// Their ends and beginnings between the first and the last value.
    pub ends: Vec<BranchEnd>,
    /// Tells whether at every value all positions were found, and none is singular or nearly so:
    /// those may have been left out.
    pub complete: bool,
    /// Positions found by continuation that the search for all modes did not give, or the other way
    /// round: should be zero away from singular positions.
    pub unmatched: usize,
}

/// How near a position has to be to one found by continuation to be the same.
const SAME: f64 = 1e-6;

impl Mechanism {
    /// Traces all branches over values of the drive, in order.
    ///
    /// Branches are joined only by [`Mechanism::follow`], which proves each step; a position that
    /// no branch reaches begins a new one.
    pub fn trace_branches(&self, drives: &[f64]) -> BranchMap {
        let mut map = BranchMap {
            complete: true,
            ..BranchMap::default()
        };
        let mut living: Vec<BranchSample> = Vec::new();
        for (row, &drive) in drives.iter().enumerate() {
            let before = (row > 0).then(|| drives[row - 1]);
            living = self.next_row(&mut map, living, before, drive);
            map.rows.push(living.clone());
        }
        map
    }

    fn next_row(
        &self,
        map: &mut BranchMap,
        living: Vec<BranchSample>,
        before: Option<f64>,
        drive: f64,
    ) -> Vec<BranchSample> {
        let modes = self.assembly_modes(drive);
        map.complete &= modes.complete && !modes.near_singular;
        let mut open = modes.states;
        let mut next = Vec::new();
        let mut follower = Follower::new(&self.chain);
        let mut ended = Vec::new();
        for mut sample in living {
            match self.advance(&mut sample.state, drive, &mut follower) {
                Ok(()) => {
                    let apart = |s: &State| self.distance(s, &sample.state);
                    let nearest = (0..open.len())
                        .min_by(|&a, &b| apart(&open[a]).total_cmp(&apart(&open[b])));
                    match nearest.filter(|&k| apart(&open[k]) < SAME) {
                        Some(k) => drop(open.remove(k)),
                        None => map.unmatched += 1,
                    }
                    next.push(sample);
                }
                Err(_) => ended.push(sample),
            }
        }
        let mut born = Vec::new();
        for state in open {
            let branch = map.branches;
            map.branches += 1;
            if let Some(before) = before {
                let mut back = state.clone();
                match self.advance(&mut back, before, &mut follower) {
                    Ok(()) => map.unmatched += 1,
                    Err(_) => born.push(BranchSample {
                        branch,
                        state: back,
                    }),
                }
            }
            next.push(BranchSample { branch, state });
        }
        map.ends.extend(self.grouped(ended, false));
        map.ends.extend(self.grouped(born, true));
        next
    }

    /// The largest difference of two positions, angles to the nearest turn.
    fn distance(&self, a: &State, b: &State) -> f64 {
        let apart = |k: usize| self.chain.apart(k, a.pose.u[k], b.pose.u[k]);
        (0..self.chain.unknowns).map(apart).fold(0.0, f64::max)
    }

    /// Ends of branches at one singular position each.
    fn grouped(&self, samples: Vec<BranchSample>, begins: bool) -> Vec<BranchEnd> {
        let mut ends: Vec<BranchEnd> = Vec::new();
        for BranchSample { branch, state } in samples {
            let drive = self.drive_of(&state);
            let at = self.singularity(&state);
            let same = |e: &&mut BranchEnd| match (&e.at, &at) {
                (Some(a), Some(b)) => is_same(a, b),
                _ => false,
            };
            match ends.iter_mut().find(same) {
                Some(e) => e.branches.push(branch),
                None => ends.push(BranchEnd {
                    at,
                    drive,
                    branches: vec![branch],
                    begins,
                }),
            }
        }
        ends.sort_by(|a, b| a.drive.total_cmp(&b.drive));
        ends
    }
}

/// Returns whether two singular positions are one: angles are known by the square root of rounding
/// alone.
fn is_same(a: &Singularity, b: &Singularity) -> bool {
    let near = |(x, y): (&f64, &f64)| super::plane::wrapped(x - y).abs() < 1e-3;
    (a.drive - b.drive).abs() < 1e-7 && a.angles.iter().zip(&b.angles).all(near)
}

#[cfg(test)]
mod tests;

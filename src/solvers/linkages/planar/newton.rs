//! Newton's method on the closures, and memory for it.

use super::chain::{Block, Bound, Chain};
use super::dense::{Factors, Matrix};
use super::pose::{LITTLE, Pose};

/// Memory that is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Work {
    pub jacobian: Matrix,
    pub factors: Factors,
    pub residual: Vec<f64>,
    pub step: Vec<f64>,
    /// Residuals and corrections of linear systems.
    pub correction: Vec<f64>,
    pub bounds: Vec<Bound>,
    /// Row sums of `|J⁻¹|` times the bounds.
    pub sums: Vec<[f64; 4]>,
    /// Unknowns before they are refined.
    pub before: Vec<f64>,
    /// The last first correction of [`Chain::newton_within`].
    pub size: f64,
}

impl Work {
    pub(super) fn new(chain: &Chain) -> Work {
        let n = chain.unknowns;
        Work {
            jacobian: Matrix::new(n, n + 1),
            step: vec![0.0; n],
            ..Work::default()
        }
    }

    /// Factors the Jacobian of all closures; `false` if it is singular.
    pub(super) fn factor(&mut self, chain: &Chain) -> bool {
        let blocks = chain.blocks.iter().map(|b| b.rows.clone());
        self.factors.of_blocks(&self.jacobian, 0, blocks)
    }
}

/// The most rounds.
const MOST: usize = 30;
/// Corrections above this lead nowhere.
const FARTHEST: f64 = 10.0;
/// Beside a fold the corrections stay near the square root of the rounding error.
const BESIDE_FOLD: f64 = 1e-6;
/// States what a last correction may leave: half a unit of an angle's rounding error.
const NOTHING: f64 = 0.25 * f64::EPSILON;

/// Describes what follows a correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum After {
    Done,
    Lost,
    /// Another one, by a Jacobian of its own or by the factors that are there.
    Another {
        fresh: bool,
    },
}

/// Returns what follows a correction of `size` after one of `last`; `fresh` if the Jacobian was its
/// own.
fn after(size: f64, last: f64, fresh: bool) -> After {
    // Below 2⁻⁵⁰, or below 1e-12 and no longer halved.
    if size <= f64::EPSILON * 4.0 || (size <= 1e-12 && size >= last * 0.5) {
        return After::Done;
    }
    if !(size <= FARTHEST) {
        return After::Lost;
    }
    // After a small correction the factors are good for more, as long as each of them gains two
    // digits.
    let good = size <= 1e-5 && (fresh || size <= 1e-2 * last);
    After::Another { fresh: !good }
}

/// Returns whether nothing is left of a correction that leaves a share of itself.
fn done_by_share(share: f64, size: f64) -> bool {
    share * size <= NOTHING
}

/// Returns whether nothing is left of one by a Jacobian of its own.
fn done_by_curvature(curvature: f64, size: f64) -> bool {
    curvature * (size * size) <= NOTHING
}

impl Chain {
    /// Newton's method on the equations of one group, or of all; the pose is the solution where it
    /// settles.
    pub(super) fn newton(&self, pose: &mut Pose, block: Option<&Block>, work: &mut Work) -> bool {
        let (unknowns, closures, order) = match block {
            Some(b) => (b.unknowns.clone(), b.closures.clone(), &b.placed),
            None => (0..self.unknowns, 0..self.closures.len(), &self.order),
        };
        let n = unknowns.len();
        let (mut last, mut fresh) = (f64::INFINITY, true);
        for _ in 0..MOST {
            pose.residual(self, &self.closures[closures.clone()], &mut work.residual);
            if fresh {
                pose.jacobian(self, closures.clone(), &mut work.jacobian);
                let factored = match block {
                    Some(_) => work.factors.of(&work.jacobian, n, unknowns.start),
                    None => work.factor(self),
                };
                if !factored {
                    return false;
                }
            }
            let residual = &work.residual;
            work.factors.solve(|r| -residual[r], &mut work.step[..n]);
            let size = self.moved(pose, unknowns.clone(), &work.step);
            pose.place(self, order);
            match after(size, last, fresh) {
                After::Done => return true,
                After::Lost => return false,
                After::Another { fresh: own } => fresh = own,
            }
            last = size;
        }
        last < BESIDE_FOLD
    }

    /// Moves unknowns by a step, and returns its size: a displacement is as good as its own. A step
    /// that is no number has none.
    fn moved(&self, pose: &mut Pose, unknowns: std::ops::Range<usize>, step: &[f64]) -> f64 {
        let mut size = 0.0f64;
        for (k, d) in unknowns.zip(step) {
            let scale = match self.lengths[k] {
                true => pose.u[k].abs().max(1.0),
                false => 1.0,
            };
            let part = d.abs() / scale;
            if !(size >= part || size.is_nan()) {
                size = part;
            }
            pose.u[k] += d;
        }
        size
    }

    /// [`Chain::newton`] on all equations where much is known: corrections by the factors of a
    /// state close by leave at most `near.1` of themselves, one of d by a Jacobian of its own at
    /// most `curvature` d².
    pub(super) fn newton_within(
        &self,
        pose: &mut Pose,
        near: (&Factors, f64),
        curvature: f64,
        work: &mut Work,
    ) -> bool {
        let all = 0..self.unknowns;
        pose.residual(self, &self.closures, &mut work.residual);
        // Tried where it would have been enough the last time.
        if done_by_share(near.1, work.size) {
            near.0.solve(|r| -work.residual[r], &mut work.step);
            work.size = self.moved(pose, all.clone(), &work.step);
            if done_by_share(near.1, work.size) {
                pose.turn_by(self, &work.step);
                return true;
            }
            pose.place(self, &self.order);
            pose.residual(self, &self.closures, &mut work.residual);
        }
        pose.jacobian(self, 0..self.closures.len(), &mut work.jacobian);
        if !work.factor(self) {
            return false;
        }
        work.factors.solve(|r| -work.residual[r], &mut work.step);
        work.size = self.moved(pose, all, &work.step);
        if done_by_curvature(curvature, work.size) {
            pose.turn_by(self, &work.step);
            return true;
        }
        pose.place(self, &self.order);
        self.newton(pose, None, work)
    }
}

impl Pose {
    /// One more correction of Newton's method, by which directions turn as computed, where an angle
    /// beyond a radian is rounded by more than a direction is: rates are theirs.
    pub(super) fn settle(&mut self, chain: &Chain, factors: &Factors, work: &mut Work) {
        self.residual(chain, &chain.closures, &mut work.residual);
        let (residual, step) = (&work.residual, &mut work.step);
        factors.solve(|r| -residual[r], step);
        if step.iter().all(|d| d.abs() <= LITTLE) {
            self.u.iter_mut().zip(&*step).for_each(|(u, d)| *u += d);
            self.turn_by(chain, step);
        }
    }
}

#[cfg(test)]
mod tests;

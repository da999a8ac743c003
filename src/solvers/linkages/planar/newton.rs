//! Newton's method on the closures, and memory for it.

use super::bounds::Bound;
use super::chain::{Block, Chain};
use super::continuation::Anchor;
use super::dense::{Factors, Matrix};
use super::pose::Pose;
use super::state::State;

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
    pub sums: Vec<[f64; 3]>,
    /// The last first correction of [`Chain::newton_within`].
    pub size: f64,
    /// What is proved about the way ahead of a continuation.
    pub anchor: Anchor,
    /// Memory for the next state of a continuation.
    pub spare: Option<State>,
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
}

/// Whether Newton's method is done after corrections of `last` and `size`: below 2⁻⁵⁰, or below
/// 1e-12 and no longer halved.
fn settled(size: f64, last: f64) -> bool {
    size <= f64::EPSILON * 4.0 || (size <= 1e-12 && size >= last * 0.5)
}

/// The most rounds.
const MOST: usize = 30;

impl Chain {
    /// Newton's method on the equations of one group, or of all; the pose is the solution where it
    /// settles.
    pub(super) fn newton(&self, pose: &mut Pose, block: Option<&Block>, work: &mut Work) -> bool {
        let (unknowns, closures, bodies) = match block {
            Some(b) => (b.unknowns.clone(), b.closures.clone(), Some(&b.bodies)),
            None => (0..self.unknowns, 0..self.closures.len(), None),
        };
        let n = unknowns.len();
        let order: Vec<usize> = match bodies {
            Some(bodies) => self
                .order
                .iter()
                .copied()
                .filter(|b| bodies.contains(b))
                .collect(),
            None => Vec::new(),
        };
        let order = if bodies.is_some() {
            &order
        } else {
            &self.order
        };
        let mut last = f64::INFINITY;
        let mut fresh = true;
        for _ in 0..MOST {
            pose.residual(self, &self.closures[closures.clone()], &mut work.residual);
            if fresh {
                pose.jacobian(self, closures.clone(), &mut work.jacobian);
                let factored = match block {
                    Some(_) => work.factors.of(&work.jacobian, n, unknowns.start),
                    None => {
                        let blocks = self.blocks.iter().map(|b| b.rows.clone());
                        work.factors.of_blocks(&work.jacobian, 0, blocks)
                    }
                };
                if !factored {
                    return n == 0;
                }
            }
            let residual = &work.residual;
            work.factors.solve(|r| -residual[r], &mut work.step[..n]);
            let size = self.moved(pose, unknowns.clone(), &work.step);
            pose.place(self, order);
            if settled(size, last) {
                return true;
            }
            if !(size <= 10.0) {
                return false;
            }
            // After a small correction the factors are good for more, as long as each of them gains two
            // digits.
            fresh = !(size <= 1e-5 && (fresh || size <= 1e-2 * last));
            last = size;
        }
        // Beside a fold the corrections stay near the square root of the rounding error.
        last < 1e-6
    }

    /// Moves unknowns by a step, and returns its size: a displacement is as good as its own.
    fn moved(&self, pose: &mut Pose, unknowns: std::ops::Range<usize>, step: &[f64]) -> f64 {
        let mut size = 0.0f64;
        for (k, d) in unknowns.zip(step) {
            let scale = match self.lengths[k] {
                true => pose.u[k].abs().max(1.0),
                false => 1.0,
            };
            size = size.max(d.abs() / scale);
            pose.u[k] += d;
        }
        size
    }

    /// [`Chain::newton`] on all equations where much is known: corrections by the factors of a state close by leave at
    /// most `near.1` of themselves, one of d by a Jacobian of its own at most `curvature` d².
    pub(super) fn newton_within(
        &self,
        pose: &mut Pose,
        near: (&Factors, f64),
        curvature: f64,
        work: &mut Work,
    ) -> bool {
        // What is left may be half a unit of an angle's rounding error.
        const NOTHING: f64 = 0.25 * f64::EPSILON;
        let all = 0..self.unknowns;
        pose.residual(self, &self.closures, &mut work.residual);
        // Tried where it would have been enough the last time.
        if near.1 * work.size <= NOTHING {
            near.0.solve(|r| -work.residual[r], &mut work.step);
            work.size = self.moved(pose, all.clone(), &work.step);
            if near.1 * work.size <= NOTHING {
                pose.turn_little(self, &work.step);
                return true;
            }
            pose.place(self, &self.order);
            pose.residual(self, &self.closures, &mut work.residual);
        }
        pose.jacobian(self, 0..self.closures.len(), &mut work.jacobian);
        let blocks = self.blocks.iter().map(|b| b.rows.clone());
        if !work.factors.of_blocks(&work.jacobian, 0, blocks) {
            return self.unknowns == 0;
        }
        work.factors.solve(|r| -work.residual[r], &mut work.step);
        let size = self.moved(pose, all, &work.step);
        work.size = size;
        if curvature * (size * size) <= NOTHING {
            pose.turn_little(self, &work.step);
            return true;
        }
        pose.place(self, &self.order);
        self.newton(pose, None, work)
    }
}

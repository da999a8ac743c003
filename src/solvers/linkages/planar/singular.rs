//! Where a branch ends: folds, and points where branches cross.
//!
//! A singular position solves `F(u, φ) = 0, J v = 0, v·v₀ = 1` (Moore & Spence, *The calculation of
//! turning points of nonlinear equations*, SIAM J. Numer. Anal. 17 (1980)). With the left null
//! vector w of J it is a fold, where two modes merge and end, if `w·F_φ ≠ 0`; otherwise branches
//! meet there, the system is singular itself, and the smallest singular value of J, which passes
//! through zero along the branch, is followed to its zero instead.

use super::chain::Chain;
use super::dense::{Factors, Matrix};
use super::mechanism::Mechanism;
use super::newton::Work;
use super::pose::Pose;
use super::state::State;

/// A singular position.
#[derive(Clone, Debug, PartialEq)]
pub struct Singularity {
    /// The drive in radians or metres.
    pub drive: f64,
    /// Holds what happens there.
    pub kind: SingularKind,
    /// Angles of all moving bodies there in radians.
    pub angles: Vec<f64>,
}

/// Describes what happens at a singular position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularKind {
    /// Two modes merge and end.
    Fold,
    /// Branches meet, and which one continues which is not defined: a change point.
    ChangePoint,
}

/// Below this share of `‖F_φ‖`, `w·F_φ` counts as zero. A branch is followed to within about 1e-7
/// of a change point.
const NOTHING: f64 = 1e-5;

/// The most corrections of the search for a fold, and the size from which one leads somewhere else.
const ROUNDS: usize = 40;
const FARTHEST: f64 = 0.5;

/// Returns whether a correction is the last one: rounding, or small and no longer halved.
fn is_last(moved: f64, before: f64) -> bool {
    moved < 1e-14 || (moved < 1e-9 && moved > 0.5 * before)
}

/// Returns whether a fold is the one ahead: the last correction but one was small, and the drive is
/// not far off.
fn is_near(before: f64, off: f64) -> bool {
    before < 1e-4 && off.abs() < 1e-2
}

/// Returns whether `w·F_φ` is not zero.
fn is_fold(w: &[f64], column: &[f64]) -> bool {
    let along: f64 = w.iter().zip(column).map(|(w, f)| w * f).sum();
    let largest = column.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    along.abs() > NOTHING * largest
}

impl Mechanism {
    /// The singular position that a branch ran into, refined from the last state before it; `None`
    /// if there is none near.
    pub fn singularity(&self, last: &State) -> Option<Singularity> {
        let n = self.chain.unknowns;
        let (v, w) = null_vectors(&last.factors, n);
        let column: Vec<f64> = (0..n).map(|r| last.jacobian[(r, n)]).collect();
        let (kind, pose) = match is_fold(&w, &column) {
            true => (SingularKind::Fold, self.fold(last, v)?),
            false => (
                SingularKind::ChangePoint,
                self.change_point(last, [&v, &w])?,
            ),
        };
        let angles = (1..self.chain.body_count())
            .map(|b| pose.angle(&self.chain, b))
            .collect();
        Some(Singularity {
            drive: self.outer_drive(pose.drive),
            kind,
            angles,
        })
    }

    /// Along the tangent to where `w J v` is zero.
    fn change_point(&self, last: &State, [v, w]: [&[f64]; 2]) -> Option<Pose> {
        let n = self.chain.unknowns;
        let moved = |h: f64| {
            let u = last
                .pose
                .u
                .iter()
                .zip(&last.rates[0])
                .map(|(u, d)| u + h * d)
                .collect();
            Pose::new(&self.chain, last.pose.drive + h, u)
        };
        let Work { mut jacobian, .. } = Work::new(&self.chain);
        let mut sigma = |pose: &Pose| {
            pose.jacobian(&self.chain, 0..self.chain.closures.len(), &mut jacobian);
            let row = |r: usize| (0..n).map(|c| jacobian[(r, c)] * v[c]).sum::<f64>();
            (0..n).map(|r| w[r] * row(r)).sum::<f64>()
        };
        let h = 1e-5;
        let slope = (sigma(&moved(h)) - sigma(&moved(-h))) / (2.0 * h);
        let step = -sigma(&last.pose) / slope;
        (step.abs() < 1e-4).then(|| moved(step))
    }

    /// Newton's method on the system of Moore and Spence.
    fn fold(&self, last: &State, v: Vec<f64>) -> Option<Pose> {
        let mut search = Search::new(&self.chain, last.pose.clone(), v);
        let mut before = f64::INFINITY;
        for _ in 0..ROUNDS {
            let Some(moved) = search.correct(&self.chain) else {
                break;
            };
            if !(moved < FARTHEST) {
                return None;
            }
            if is_last(moved, before) {
                break;
            }
            before = moved;
        }
        let Search { pose, .. } = search;
        is_near(before, pose.drive - last.pose.drive).then_some(pose)
    }
}

/// Newton's method for a fold.
struct Search {
    pose: Pose,
    v: Vec<f64>,
    v0: Vec<f64>,
    work: Work,
    shifted: Matrix,
    matrix: Matrix,
    factors: Factors,
    step: Vec<f64>,
}

impl Search {
    fn new(chain: &Chain, pose: Pose, v: Vec<f64>) -> Search {
        let size = 2 * v.len() + 1;
        let work = Work::new(chain);
        Search {
            pose,
            v0: v.clone(),
            v,
            shifted: work.jacobian.clone(),
            work,
            matrix: Matrix::new(size, size),
            factors: Factors::default(),
            step: vec![0.0; size],
        }
    }

    /// One correction of the pose and v: its size; `None` where the system is singular.
    fn correct(&mut self, chain: &Chain) -> Option<f64> {
        let n = chain.unknowns;
        let all = 0..chain.closures.len();
        let (pose, v, matrix) = (&mut self.pose, &mut self.v, &mut self.matrix);
        pose.residual(chain, &chain.closures, &mut self.work.residual);
        pose.jacobian(chain, all.clone(), &mut self.work.jacobian);
        // The derivative of J v along every unknown and the drive, by central differences of the
        // Jacobian along v: (J(u + h v) − J(u − h v)) / 2h is symmetric in its arguments.
        let h = 1e-5;
        let shifted = &mut self.shifted;
        let mut change = |h: f64| {
            let u = pose.u.iter().zip(&*v).map(|(u, v)| u + h * v).collect();
            Pose::new(chain, pose.drive, u).jacobian(chain, all.clone(), shifted);
            shifted.clone()
        };
        let (plus, minus) = (change(h), change(-h));
        let jacobian = &self.work.jacobian;
        for r in 0..n {
            for c in 0..=n {
                let column = if c == n { 2 * n } else { c };
                matrix[(r, column)] = jacobian[(r, c)];
                matrix[(n + r, column)] = (plus[(r, c)] - minus[(r, c)]) / (2.0 * h);
            }
            for c in 0..n {
                matrix[(n + r, n + c)] = jacobian[(r, c)];
            }
            matrix[(2 * n, n + r)] = self.v0[r];
        }
        if !self.factors.of(matrix, 2 * n + 1, 0) {
            return None;
        }
        let product = |r: usize| (0..n).map(|c| jacobian[(r, c)] * v[c]).sum::<f64>();
        let norm: f64 = v.iter().zip(&self.v0).map(|(a, b)| a * b).sum();
        let right = |r: usize| match r {
            r if r < n => -self.work.residual[r],
            r if r < 2 * n => -product(r - n),
            _ => 1.0 - norm,
        };
        let step = &mut self.step;
        self.factors.solve(right, step);
        let u = pose.u.iter().zip(&*step).map(|(u, d)| u + d).collect();
        *pose = Pose::new(chain, pose.drive + step[2 * n], u);
        v.iter_mut().zip(&step[n..]).for_each(|(v, d)| *v += d);
        Some(step.iter().fold(0.0f64, |m, x| m.max(x.abs())))
    }
}

/// Unit vectors near the right and left null spaces, by inverse iteration; of no numbers where the
/// inverse is beyond their range, which is no fold and leads to no change point.
fn null_vectors(factors: &Factors, n: usize) -> (Vec<f64>, Vec<f64>) {
    let unit = |v: &mut Vec<f64>| {
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        v.iter_mut().for_each(|x| *x /= norm);
    };
    // Nothing special about the start.
    let mut right: Vec<f64> = (0..n).map(|k| 1.0 + 0.1 * (k as f64).sin()).collect();
    let mut left = right.clone();
    let mut out = vec![0.0; n];
    for _ in 0..3 {
        // (Jᵀ J)⁻¹ and (J Jᵀ)⁻¹.
        factors.solve_transposed(&right, &mut out);
        factors.solve(|r| out[r], &mut right);
        unit(&mut right);
        factors.solve(|r| left[r], &mut out);
        factors.solve_transposed(&out, &mut left);
        unit(&mut left);
    }
    (right, left)
}

#[cfg(test)]
mod tests;

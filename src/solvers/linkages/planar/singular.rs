//! Where a branch ends: folds, and points where branches cross.
//!
//! A singular position solves `F(u, φ) = 0, J v = 0, v·v₀ = 1` (Moore & Spence, *The calculation of
//! turning points of nonlinear equations*, SIAM J. Numer. Anal. 17 (1980)). With the left null vector
//! w of J it is a fold, where two modes merge and end, if `w·F_φ ≠ 0`; otherwise branches meet there,
//! the system is singular itself, and the smallest singular value of J, which passes through zero along
//! the branch, is followed to its zero instead.

use super::dense::{Factors, Matrix};
use super::mechanism::Mechanism;
use super::pose::Pose;
use super::state::State;

/// A singular position.
#[derive(Clone, Debug, PartialEq)]
pub struct Singularity {
    /// The drive in radians or metres.
    pub drive: f64,
    /// What happens there.
    pub kind: SingularKind,
    /// Angles of all moving bodies there in radians.
    pub angles: Vec<f64>,
}

/// What happens at a singular position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularKind {
    /// Two modes merge and end.
    Fold,
    /// Branches meet, and which one continues which is not defined: a change point.
    ChangePoint,
}

/// Below this share of `‖F_φ‖`, `w·F_φ` counts as zero. A branch is followed to within about 1e-8 of a
/// change point.
const NOTHING: f64 = 1e-5;

/// Whether `w·F_φ` is not zero.
fn is_fold(w: &[f64], column: &[f64]) -> bool {
    let along: f64 = w.iter().zip(column).map(|(w, f)| w * f).sum();
    let largest = column.iter().fold(0.0f64, |m, f| m.max(f.abs()));
    along.abs() > NOTHING * largest
}

impl Mechanism {
    /// The singular position that a branch ran into, refined from the last state before it; `None` if
    /// there is none near.
    pub fn singularity(&self, last: &State) -> Option<Singularity> {
        let n = self.chain.unknowns;
        let (v, w) = null_vectors(&last.factors, n)?;
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
        let mut jacobian = Matrix::new(n, n + 1);
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
    fn fold(&self, last: &State, mut v: Vec<f64>) -> Option<Pose> {
        let n = self.chain.unknowns;
        let mut pose = last.pose.clone();
        let v0 = v.clone();
        let size = 2 * n + 1;
        let mut matrix = Matrix::new(size, size);
        let mut factors = Factors::default();
        let mut jacobian = Matrix::new(n, n + 1);
        let mut shifted = Matrix::new(n, n + 1);
        let mut residual = Vec::new();
        let mut step = vec![0.0; size];
        let mut last_size = f64::INFINITY;
        for _ in 0..40 {
            pose.residual(&self.chain, &self.chain.closures, &mut residual);
            pose.jacobian(&self.chain, 0..self.chain.closures.len(), &mut jacobian);
            // The derivative of J v along every unknown and the drive, by central differences of the
            // Jacobian along v: (J(u + h v) − J(u − h v)) / 2h is symmetric in its arguments.
            let h = 1e-5;
            let mut change = |sign: f64| {
                let u = pose
                    .u
                    .iter()
                    .zip(&v)
                    .map(|(u, v)| u + sign * h * v)
                    .collect();
                let moved = Pose::new(&self.chain, pose.drive, u);
                moved.jacobian(&self.chain, 0..self.chain.closures.len(), &mut shifted);
                shifted.clone()
            };
            let (plus, minus) = (change(1.0), change(-1.0));
            matrix.clear();
            for r in 0..n {
                for c in 0..=n {
                    let column = if c == n { 2 * n } else { c };
                    matrix[(r, column)] = jacobian[(r, c)];
                    matrix[(n + r, column)] = (plus[(r, c)] - minus[(r, c)]) / (2.0 * h);
                }
                for c in 0..n {
                    matrix[(n + r, n + c)] = jacobian[(r, c)];
                }
                matrix[(2 * n, n + r)] = v0[r];
            }
            if !factors.of(&matrix, size, 0) {
                break;
            }
            let product = |r: usize| (0..n).map(|c| jacobian[(r, c)] * v[c]).sum::<f64>();
            let norm: f64 = v.iter().zip(&v0).map(|(a, b)| a * b).sum();
            let right = |r: usize| match r {
                r if r < n => -residual[r],
                r if r < 2 * n => -product(r - n),
                _ => 1.0 - norm,
            };
            factors.solve(right, &mut step);
            let moved = step.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            if !(moved < 0.5) {
                return None;
            }
            let u: Vec<f64> = pose.u.iter().zip(&step).map(|(u, d)| u + d).collect();
            v.iter_mut().zip(&step[n..]).for_each(|(v, d)| *v += d);
            pose = Pose::new(&self.chain, pose.drive + step[2 * n], u);
            if moved < 1e-14 || (moved < 1e-9 && moved > 0.5 * last_size) {
                break;
            }
            last_size = moved;
        }
        (last_size < 1e-4 && (pose.drive - last.pose.drive).abs() < 1e-2).then_some(pose)
    }
}

/// Unit vectors near the right and left null spaces, by inverse iteration.
fn null_vectors(factors: &Factors, n: usize) -> Option<(Vec<f64>, Vec<f64>)> {
    let unit = |v: &mut Vec<f64>| -> Option<()> {
        let norm = v.iter().map(|x| x * x).sum::<f64>().sqrt();
        (norm.is_finite() && norm > 0.0).then(|| v.iter_mut().for_each(|x| *x /= norm))
    };
    // Nothing special about the start.
    let mut right: Vec<f64> = (0..n).map(|k| 1.0 + 0.1 * (k as f64).sin()).collect();
    let mut left = right.clone();
    let mut out = vec![0.0; n];
    for _ in 0..3 {
        // (Jᵀ J)⁻¹ and (J Jᵀ)⁻¹.
        factors.solve_transposed(&right, &mut out);
        factors.solve(|r| out[r], &mut right);
        unit(&mut right)?;
        factors.solve(|r| left[r], &mut out);
        factors.solve_transposed(&out, &mut left);
        unit(&mut left)?;
    }
    Some((right, left))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The drive's column is measured by its largest member, whatever its size.
    #[test]
    fn folds_are_told_from_change_points() {
        assert!(is_fold(&[1.0, 0.0], &[1.0, 0.0]));
        assert!(is_fold(&[0.0, 1.0], &[1.0, 2e-5]));
        assert!(!is_fold(&[0.0, -1.0], &[1.0, 5e-6]));
        assert!(!is_fold(&[0.0, 1.0], &[-1.0, 5e-6]));
        assert!(is_fold(&[0.0, -1.0], &[1e-3, 2e-8]));
        assert!(!is_fold(&[0.0, 1.0], &[1e-3, 5e-9]));
        // Several closures of which each has its part: they cancel.
        assert!(!is_fold(&[0.6, 0.8], &[0.8, -0.6]));
    }
}

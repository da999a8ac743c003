//! Dense linear systems of balls by an approximate inverse.
//!
//! For any matrix R, a matrix A with `‖I − R A‖∞ ≤ q < 1` is regular, and so is R. For any x̃ with
//! `δ = R (b − A x̃)` the error `e = x − x̃` is `δ + (I − R A) e`, so that `‖e‖∞ ≤ ‖δ‖∞/(1 − q)`
//! and `|e_i| ≤ |δ_i| + Σ_k |I − R A|_ik ‖e‖∞` (Rump, *Acta Numerica* 19 (2010), 10.5 and 10.6). A
//! and b are balls: all that is said holds for each matrix and each side in them. R is computed in
//! floating-point numbers and taken as exact; a bad one can only make the test fail. A ball matrix
//! is not eliminated, because radii would grow by a factor in each row.

use super::dense;
use super::matrix::{LinearError, Matrix};
use crate::{Ball, Mag, dot};
use rug::Float;

/// Rounds of refinement; each gains as many bits as the contraction has.
const ROUNDS: u32 = 30;

/// A matrix of balls that is proved to be regular.
pub(crate) struct Verified {
    matrix: Matrix<Ball>,
    inverse: Matrix<Ball>,
    /// Upper bounds on the row sums of `|I − R A|`.
    defect: Vec<Mag>,
    bits: u32,
}

fn exactly(x: &Float) -> Ball {
    Ball::new(x.clone(), Mag::ZERO)
}

/// Inverts a matrix of floating-point numbers by Gauss and Jordan's elimination with the largest
/// pivot of each column; none if that is zero or no number.
pub(crate) fn approximate_inverse(a: &Matrix<Ball>, bits: u32) -> Option<Matrix<Float>> {
    let n = a.rows();
    let mut rows: Vec<Vec<Float>> = (0..n)
        .map(|i| {
            a.row(i)
                .iter()
                .map(|x| Float::with_val(bits, x.mid()))
                .collect()
        })
        .collect();
    let mut exchanges = Vec::with_capacity(n);
    for k in 0..n {
        let at = (k..n).max_by(|&i, &j| {
            rows[i][k]
                .cmp_abs(&rows[j][k])
                .unwrap_or(std::cmp::Ordering::Equal)
        })?;
        rows.swap(k, at);
        exchanges.push(at);
        let pivot = std::mem::replace(&mut rows[k][k], Float::with_val(bits, 1));
        if pivot.is_zero() || !pivot.is_finite() {
            return None;
        }
        let unit = pivot.recip();
        rows[k].iter_mut().for_each(|x| *x *= &unit);
        let row = std::mem::take(&mut rows[k]);
        for other in rows.iter_mut().filter(|r| !r.is_empty()) {
            let f = std::mem::replace(&mut other[k], Float::new(bits));
            if !f.is_zero() {
                for (x, y) in other.iter_mut().zip(&row) {
                    *x -= &f * y;
                }
            }
        }
        rows[k] = row;
    }
    for (k, at) in exchanges.into_iter().enumerate().rev() {
        rows.iter_mut().for_each(|row| row.swap(k, at));
    }
    Matrix::new(n, n, rows.into_iter().flatten().collect()).ok()
}

fn largest(sizes: impl IntoIterator<Item = Mag>) -> Mag {
    sizes.into_iter().fold(Mag::ZERO, Mag::max)
}

impl Verified {
    /// Proves that a square matrix is regular; none if the test fails with `bits` bits.
    pub(crate) fn new(matrix: Matrix<Ball>, bits: u32) -> Option<Verified> {
        let n = matrix.rows();
        let inverse = approximate_inverse(&matrix, bits)?.map(exactly);
        let mut defect = vec![Mag::ZERO; n];
        for j in 0..n {
            let column: Vec<&Ball> = (0..n).map(|k| matrix.at(k, j)).collect();
            for (i, sum) in defect.iter_mut().enumerate() {
                let terms = inverse.row(i).iter().zip(column.iter().copied());
                let entry = dot(bits, terms.filter(|(_, a)| !a.is_zero()));
                let rest = Ball::integer(bits, i64::from(i == j)) - entry;
                *sum = sum.add(rest.magnitude());
            }
        }
        let verified = Verified {
            matrix,
            inverse,
            defect,
            bits,
        };
        (verified.contraction() < Mag::from_f64(1.0)).then_some(verified)
    }

    fn contraction(&self) -> Mag {
        largest(self.defect.iter().copied())
    }

    /// Computes `R (b − A x)` for a side and exact numbers x.
    fn step(&self, b: &[Ball], x: &[Ball]) -> Vec<Ball> {
        let residual =
            |(i, b): (usize, &Ball)| b - dot(self.bits, self.matrix.row(i).iter().zip(x));
        let residual: Vec<Ball> = b.iter().enumerate().map(residual).collect();
        (0..b.len())
            .map(|i| dot(self.bits, self.inverse.row(i).iter().zip(&residual)))
            .collect()
    }

    /// Encloses the solution with one side.
    pub(crate) fn solve(&self, b: &[Ball]) -> Vec<Ball> {
        let mut x = vec![Ball::integer(self.bits, 0); b.len()];
        let mut last = Mag::INFINITY;
        let mut step = self.step(b, &x);
        for _ in 0..ROUNDS {
            let size = largest(step.iter().map(Ball::magnitude));
            if !(size < last.shift(-1)) {
                break;
            }
            last = size;
            for (x, s) in x.iter_mut().zip(&step) {
                *x = exactly((&*x + s).mid());
            }
            step = self.step(b, &x);
        }
        let size = largest(step.iter().map(Ball::magnitude));
        let error = size.div(Mag::from_f64(1.0).sub_below(self.contraction()));
        let component =
            |((x, step), defect): ((&Ball, &Ball), &Mag)| (x + step).widened(defect.mul(error));
        x.iter()
            .zip(&step)
            .zip(&self.defect)
            .map(component)
            .collect()
    }

    /// Encloses the solutions with all columns of b.
    pub(crate) fn solve_all(&self, b: &Matrix<Ball>) -> Matrix<Ball> {
        let column =
            |j: usize| -> Vec<Ball> { (0..b.rows()).map(|i| b.at(i, j).clone()).collect() };
        let columns: Vec<Vec<Ball>> = (0..b.columns()).map(|j| self.solve(&column(j))).collect();
        Matrix::from_fn(b.rows(), b.columns(), |i, j| columns[j][i].clone())
    }

    /// Encloses the determinant: that of the midpoints M is computed exactly, and with
    /// `f ≥ ‖M⁻¹ (A − M)‖∞` the others differ from it by a factor within
    /// `(1 + f)^n − 1 ≤ n f/(1 − n f)` of 1, since the eigenvalues of a matrix are not above its
    /// norm.
    pub(crate) fn determinant(&self) -> Result<Ball, LinearError> {
        let n = self.matrix.rows();
        let exact = |x: &Ball| x.mid().to_rational().unwrap_or_default();
        let middle = dense::determinant_exactly(&self.matrix.map(exact))?;
        let widths: Vec<Mag> = (0..n)
            .map(|k| {
                self.matrix
                    .row(k)
                    .iter()
                    .fold(Mag::ZERO, |s, x| s.add(x.rad()))
            })
            .collect();
        let row = |i: usize| {
            let pairs = self.inverse.row(i).iter().zip(&widths);
            pairs.fold(Mag::ZERO, |s, (r, w)| s.add(r.magnitude().mul(*w)))
        };
        let one = Mag::from_f64(1.0);
        let f = largest((0..n).map(row)).div(one.sub_below(self.contraction()));
        let nf = f.mul(Mag::from_f64(n as f64));
        let off = nf.div(one.sub_below(nf));
        let middle = Ball::rational(self.bits, &middle);
        Ok(middle.widened(middle.magnitude().mul(off)))
    }
}

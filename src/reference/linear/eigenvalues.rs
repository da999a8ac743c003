//! Certified eigenvalues of symmetric matrices and of definite pencils `A x = λ B x`.
//!
//! For a matrix W let `C = Wᵀ A W` and `‖Wᵀ B W − I‖ ≤ g < 1`. Then W is regular and B is positive
//! definite, and the eigenvalues in ascending order satisfy `λ_i(A, B) = θ_i λ_i(C)` with
//! `1/(1 + g) ≤ θ_i ≤ 1/(1 − g)` (Ostrowski; Horn and Johnson, *Matrix Analysis*, 2013, Thm 4.5.9).
//! If C is nearly diagonal, `|λ_i(C) − c_i| ≤ ‖C − diag‖` with the diagonal in ascending order
//! (Weyl; the same, Cor. 4.3.15). Norms are row sums, which bound the spectral norm of symmetric
//! matrices. So each eigenvalue has a ball, near and multiple ones too. Jacobi's rotations find W
//! (Golub and Van Loan, *Matrix Computations*, 2013, 8.5); W is taken as exact, and a bad one can
//! only make the balls wide.

use super::dense::{are_known, check_most};
use super::exact::null_vector;
use super::matrix::{LinearError, Matrix, inner};
use crate::{Ball, Mag, Undecided, dot};
use rug::{Float, Rational};
use std::cmp::Ordering;

/// Bits of working precision beyond the accuracy asked for that are tried first, and the number of
/// times that the precision is doubled.
const SPARE: u32 = 64;
const DOUBLINGS: u32 = 5;

/// Rotations of every pair; convergence is quadratic after a few.
const SWEEPS: u32 = 60;

/// The largest order: a rotation of every pair takes some seconds.
const ROWS: usize = 300;

/// Returns the eigenvalues of a symmetric matrix in ascending order, each as often as its
/// multiplicity, to a relative accuracy of `2^-goal`; zeros are exact.
///
/// ```
/// use mechaudit_reference::{Matrix, eigenvalues};
/// let a = Matrix::from_f64(2, 2, &[2.0, 1.0, 1.0, 2.0])?;
/// let found = eigenvalues::symmetric(&a, 100)?;
/// assert!(found[0].contains(&1.into()) && found[1].contains(&3.into()));
/// assert!(found.iter().all(|x| x.accuracy_bits() >= 100));
/// # Ok::<(), mechaudit_reference::LinearError>(())
/// ```
///
/// # Errors
/// [`LinearError`]: not square, not symmetric, or undecided.
pub fn symmetric(a: &Matrix<Rational>, goal: u32) -> Result<Vec<Ball>, LinearError> {
    let n = a.check_symmetric()?;
    known(a, None, n, goal)
}

/// Returns the eigenvalues λ of `A x = λ B x` in ascending order, each as often as its
/// multiplicity, to a relative accuracy of `2^-goal`; zeros are exact. A is symmetric, and B is
/// proved to be positive definite.
///
/// # Errors
/// [`LinearError`]: wrong shapes, not symmetric, B not positive definite with a vector that proves
/// it, or undecided.
pub fn generalised(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
    goal: u32,
) -> Result<Vec<Ball>, LinearError> {
    let n = a.check_symmetric()?;
    let rows = b.check_symmetric()?;
    super::matrix::check_length("rows of the second matrix", rows, n)?;
    known(a, Some(b), n, goal)
}

fn known(
    a: &Matrix<Rational>,
    b: Option<&Matrix<Rational>>,
    n: usize,
    goal: u32,
) -> Result<Vec<Ball>, LinearError> {
    check_most(n, ROWS)?;
    let mut bits = goal + SPARE;
    let mut directions = None;
    let mut is_definite = false;
    for _ in 0..=DOUBLINGS {
        let (first, second) = (a.balls(bits), b.map(|b| b.balls(bits)));
        let start = directions
            .take()
            .or_else(|| conjugate(second.as_ref(), n, bits));
        if let Some(start) = start {
            let w = diagonalise(&first, second.as_ref(), start, bits);
            if let Some(mut found) = enclosures(&first, second.as_ref(), &w, bits) {
                is_definite = true;
                if !are_known(&found, goal) {
                    set_zeros(a, &mut found);
                }
                if are_known(&found, goal) {
                    return Ok(found.iter().map(|x| x.with_prec(goal + 32)).collect());
                }
                directions = Some(w);
            }
        }
        if let (Some(b), false) = (b, is_definite)
            && let Some(witness) = not_positive(b, bits)
        {
            return Err(LinearError::NotPositiveDefinite { witness });
        }
        bits *= 2;
    }
    let reason = match is_definite {
        true => "an eigenvalue is known to fewer bits than were asked for",
        false => "the second matrix was not proved to be positive definite",
    };
    Err(Undecided::new(bits / 2, reason).into())
}

/// Encloses the eigenvalues of all symmetric matrices in the balls, or of all pencils with
/// matrices in them, in `bits` bits. Balls that mirror each other have to have equal midpoints.
///
/// # Errors
/// Wrong shapes, balls without bounds, midpoints that are not symmetric, or undecided.
pub fn balls(
    a: &Matrix<Ball>,
    b: Option<&Matrix<Ball>>,
    bits: u32,
) -> Result<Vec<Ball>, LinearError> {
    let n = a.check_square()?;
    for m in [Some(a), b].into_iter().flatten() {
        super::matrix::check_length("rows of the second matrix", m.check_square()?, n)?;
        m.check_finite()?;
        for row in 0..n {
            if let Some(column) = (0..row).find(|&j| m.at(row, j).mid() != m.at(j, row).mid()) {
                return Err(LinearError::NotSymmetric { row, column });
            }
        }
    }
    check_most(n, ROWS)?;
    let undecided = |reason| LinearError::from(Undecided::new(bits, reason));
    let start = conjugate(b, n, bits)
        .ok_or_else(|| undecided("a pivot of the second matrix is not positive"))?;
    let w = diagonalise(a, b, start, bits);
    enclosures(a, b, &w, bits)
        .ok_or_else(|| undecided("the second matrix was not proved to be positive definite"))
}

fn identity(n: usize, bits: u32) -> Matrix<Float> {
    Matrix::from_fn(n, n, |i, j| Float::with_val(bits, u32::from(i == j)))
}

/// Finds W with `Wᵀ B W` near the unit matrix, by Cholesky's factors; none if a pivot is not
/// positive.
fn conjugate(b: Option<&Matrix<Ball>>, n: usize, bits: u32) -> Option<Matrix<Float>> {
    let Some(b) = b else {
        return Some(identity(n, bits));
    };
    let mut l = Matrix::from_fn(n, n, |_, _| Float::new(bits));
    for j in 0..n {
        for i in j..n {
            let mut sum = Float::with_val(bits, b.at(i, j).mid());
            for k in 0..j {
                sum -= l.at(i, k) * l.at(j, k);
            }
            if i == j {
                if !(sum > 0) {
                    return None;
                }
                *l.at_mut(i, j) = sum.sqrt();
            } else {
                *l.at_mut(i, j) = sum / l.at(j, j);
            }
        }
    }
    // The columns of W are those of the inverse of Lᵀ: w_ij l_jj = δ_ij − Σ_{i≤k<j} w_ik l_jk.
    let mut w = Matrix::from_fn(n, n, |_, _| Float::new(bits));
    for i in 0..n {
        for j in i..n {
            let mut sum = Float::with_val(bits, u32::from(i == j));
            for k in i..j {
                sum -= w.at(i, k) * l.at(j, k);
            }
            *w.at_mut(i, j) = sum / l.at(j, j);
        }
    }
    Some(w)
}

/// Computes `Wᵀ M W` in balls, with W exact; none for the matrix is the unit matrix.
fn congruent(m: Option<&Matrix<Ball>>, w: &Matrix<Ball>, bits: u32) -> Matrix<Ball> {
    let n = w.rows();
    let columns: Vec<Vec<Ball>> = (0..n)
        .map(|j| (0..n).map(|i| w.at(i, j).clone()).collect())
        .collect();
    let applied = |column: &Vec<Ball>| -> Vec<Ball> {
        match m {
            None => column.clone(),
            Some(m) => (0..n)
                .map(|i| dot(bits, m.row(i).iter().zip(column)))
                .collect(),
        }
    };
    let images: Vec<Vec<Ball>> = columns.iter().map(applied).collect();
    Matrix::from_fn(n, n, |i, j| dot(bits, columns[i].iter().zip(&images[j])))
}

fn exactly(w: &Matrix<Float>) -> Matrix<Ball> {
    w.map(|x| Ball::new(x.clone(), Mag::ZERO))
}

/// Turns the columns of W until `Wᵀ A W` is nearly diagonal, and brings `Wᵀ B W` near the unit
/// matrix first where W has been found in fewer bits.
fn diagonalise(
    a: &Matrix<Ball>,
    b: Option<&Matrix<Ball>>,
    mut w: Matrix<Float>,
    bits: u32,
) -> Matrix<Float> {
    let n = w.rows();
    w = w.map(|x| Float::with_val(bits, x));
    // W (3 I − Wᵀ B W)/2 is nearer to a conjugate matrix by twice as many bits.
    for _ in 0..2 {
        let h = congruent(b, &exactly(&w), bits);
        let correction = h.map(|x| Float::with_val(bits, -x.mid()) / 2u32);
        w = Matrix::from_fn(n, n, |i, j| {
            let mut sum = Float::with_val(bits, w.at(i, j) * 1.5f64);
            for k in 0..n {
                sum += w.at(i, k) * correction.at(k, j);
            }
            sum
        });
    }
    let c = congruent(Some(a), &exactly(&w), bits);
    let mut c: Vec<Vec<Float>> = (0..n)
        .map(|i| {
            c.row(i)
                .iter()
                .map(|x| Float::with_val(bits, x.mid()))
                .collect()
        })
        .collect();
    let mut columns: Vec<Vec<Float>> = (0..n)
        .map(|j| (0..n).map(|i| w.at(i, j).clone()).collect())
        .collect();
    // Entries below the rounding of the largest one stay.
    let size = c
        .iter()
        .flatten()
        .fold(Float::new(bits), |m, x| m.max(&x.clone().abs()));
    let negligible = size >> (bits - 4);
    for _ in 0..SWEEPS {
        let mut is_turned = false;
        for p in 0..n {
            for q in p + 1..n {
                is_turned |= rotate(&mut c, &mut columns, [p, q], &negligible);
            }
        }
        if !is_turned {
            break;
        }
    }
    Matrix::from_fn(n, n, |i, j| columns[j][i].clone())
}

/// Turns columns p and q so that their entry vanishes; false where it is negligible already.
fn rotate(
    c: &mut [Vec<Float>],
    w: &mut [Vec<Float>],
    [p, q]: [usize; 2],
    negligible: &Float,
) -> bool {
    let (n, bits) = (c.len(), negligible.prec());
    let off = c[p][q].clone();
    if off.cmp_abs(negligible) != Some(Ordering::Greater) {
        return false;
    }
    let theta = Float::with_val(bits, &c[q][q] - &c[p][p]) / Float::with_val(bits, &off * 2u32);
    if !theta.is_finite() {
        return false;
    }
    let root = Float::with_val(bits, theta.square_ref()) + 1u32;
    let size = theta.clone().abs() + root.sqrt();
    let t = if theta.is_sign_negative() {
        -size.recip()
    } else {
        size.recip()
    };
    let cosine = (Float::with_val(bits, t.square_ref()) + 1u32)
        .sqrt()
        .recip();
    let sine = Float::with_val(bits, &t * &cosine);
    let turn = |a: &mut Float, b: &mut Float| {
        let first = Float::with_val(bits, &cosine * &*a) - Float::with_val(bits, &sine * &*b);
        let second = Float::with_val(bits, &sine * &*a) + Float::with_val(bits, &cosine * &*b);
        (*a, *b) = (first, second);
    };
    let change = Float::with_val(bits, &t * &off);
    c[p][p] -= &change;
    c[q][q] += &change;
    c[p][q] = Float::new(bits);
    c[q][p] = Float::new(bits);
    for k in (0..n).filter(|&k| k != p && k != q) {
        let row = &mut c[k];
        let (low, high) = row.split_at_mut(q);
        turn(&mut low[p], &mut high[0]);
        let (a, b) = (row[p].clone(), row[q].clone());
        (c[p][k], c[q][k]) = (a, b);
    }
    let (low, high) = w.split_at_mut(q);
    for (a, b) in low[p].iter_mut().zip(&mut high[0]) {
        turn(a, b);
    }
    true
}

fn row_sum<'a>(row: impl IntoIterator<Item = &'a Ball>) -> Mag {
    row.into_iter().fold(Mag::ZERO, |s, x| s.add(x.magnitude()))
}

/// The eigenvalues in ascending order by the theorems of Ostrowski and Weyl; none unless
/// `‖Wᵀ B W − I‖ < 1`.
fn enclosures(
    a: &Matrix<Ball>,
    b: Option<&Matrix<Ball>>,
    w: &Matrix<Float>,
    bits: u32,
) -> Option<Vec<Ball>> {
    let n = w.rows();
    let w = exactly(w);
    let mut h = congruent(b, &w, bits);
    for i in 0..n {
        *h.at_mut(i, i) = h.at(i, i) - Ball::integer(bits, 1);
    }
    let g = (0..n).fold(Mag::ZERO, |g, i| g.max(row_sum(h.row(i))));
    // 1/(1 − g) − 1 = g/(1 − g), which is more than 1 − 1/(1 + g); without a bound unless g < 1.
    let theta = Ball::integer(bits, 1).widened(g.div(Mag::from_f64(1.0).sub_below(g)));
    let c = congruent(Some(a), &w, bits);
    let off = |i: usize| {
        let others = c.row(i).iter().enumerate().filter(|(j, _)| *j != i);
        row_sum(others.map(|(_, x)| x))
    };
    let weyl = (0..n).fold(Mag::ZERO, |m, i| m.max(off(i)));
    // Midpoints are ordered; the diagonal of the matrix in the ball may have another order, and is
    // within the largest radius of them, to which Weyl's theorem applies too.
    let widest = (0..n).fold(Mag::ZERO, |m, i| m.max(c.at(i, i).rad()));
    let mut diagonal: Vec<Float> = (0..n).map(|i| c.at(i, i).mid().clone()).collect();
    diagonal.sort_by(Float::total_cmp);
    let ball = |x: Float| Ball::new(x, weyl.add(widest)) * &theta;
    let found: Vec<Ball> = diagonal.into_iter().map(ball).collect();
    found.iter().all(Ball::is_finite).then_some(found)
}

/// Sets those balls around zero to zero that have to be, by the exact rank of A: it is the number
/// of eigenvalues of a pencil that are not zero.
fn set_zeros(a: &Matrix<Rational>, found: &mut [Ball]) {
    let zeros: Vec<usize> = (0..found.len())
        .filter(|&i| found[i].contains_zero())
        .collect();
    if zeros.is_empty() || nullity(a) < zeros.len() {
        return;
    }
    for i in zeros {
        found[i] = Ball::integer(found[i].prec(), 0);
    }
}

/// A lower bound on the dimension of the kernel, by vectors that are in it: each one is
/// independent of those before it, as the matrix of the rest does not have its last column.
fn nullity(a: &Matrix<Rational>) -> usize {
    let n = a.columns();
    let mut kept: Vec<usize> = (0..n).collect();
    loop {
        let part = Matrix::from_fn(a.rows(), kept.len(), |i, j| a.at(i, kept[j]).clone());
        let Some(null) = null_vector(&part) else {
            return n - kept.len();
        };
        let Some(last) = null.iter().rposition(|x| *x != 0) else {
            return n - kept.len();
        };
        kept.remove(last);
    }
}

/// Finds a vector with `xᵀ B x ≤ 0`, computed exactly: the direction of the least eigenvalue, or
/// one that B maps to zero.
fn not_positive(b: &Matrix<Rational>, bits: u32) -> Option<Vec<Rational>> {
    let n = b.rows();
    let balls = b.balls(bits);
    let w = diagonalise(&balls, None, identity(n, bits), bits);
    let form = |x: &[Rational]| inner(x, &b.times(x));
    let is_proof = |x: &Vec<Rational>| x.iter().any(|x| *x != 0) && form(x) <= 0;
    let column = |j: usize| -> Vec<Rational> {
        let entry = |i: usize| Float::with_val(53, w.at(i, j)).to_rational();
        (0..n).map(|i| entry(i).unwrap_or_default()).collect()
    };
    (0..n)
        .map(column)
        .find(is_proof)
        .or_else(|| null_vector(b).filter(is_proof))
}

#[cfg(test)]
mod tests;

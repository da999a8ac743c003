//! Dense linear systems with certified solutions: systems, determinants, inverses, least squares.
//!
//! Data are exact. Where the work is within a bound, solutions are computed exactly, whatever the
//! condition of the matrix, and rounded once; elsewhere an approximate inverse and a residual
//! enclose them at a precision that is raised until the accuracy asked for is proved: each entry to
//! `2^-goal` of its size, or of `2^-goal` of the largest entry where it is smaller than that. The
//! functions with `balls` in their names take data that are known to lie in balls, and their
//! answers hold for all of them.
//!
//! ```
//! use mechaudit_reference::{LinearError, Matrix, dense};
//! let a = Matrix::from_f64(2, 2, &[2.0, 1.0, 1.0, 2.0])?;
//! let b = Matrix::from_f64(2, 1, &[1.0, 3.0])?;
//! let x = dense::solve(&a, &b, 64)?;
//! assert!(x.at(0, 0).accuracy_bits() >= 64);
//! assert_eq!(*dense::solve_exactly(&a, &b)?.at(1, 0), rug::Rational::from((5, 3)));
//! let flat = Matrix::from_f64(2, 2, &[1.0, 2.0, 2.0, 4.0])?;
//! assert!(matches!(dense::solve(&flat, &b, 64), Err(LinearError::Singular { .. })));
//! # Ok::<(), LinearError>(())
//! ```

use super::exact::{self, Cleared};
use super::matrix::{LinearError, Matrix, check_length};
use super::modular;
use super::verified::Verified;
use crate::{Ball, Mag, Undecided};
use rug::Rational;

/// Word operations of an exact solution; 10¹⁰ of them take about a minute.
const WORK: f64 = 1e10;

/// The same where an exact answer is asked for.
const EXACT_WORK: f64 = 1e11;

/// The order of the largest matrix that is inverted in balls: that takes minutes.
const ROWS: usize = 1000;

/// Bits of working precision beyond the accuracy asked for that are tried first, and the number of
/// times that the precision is doubled.
const SPARE: u32 = 96;
const DOUBLINGS: u32 = 5;

fn check_system<T, U>(a: &Matrix<T>, b: &Matrix<U>) -> Result<usize, LinearError> {
    let n = a.check_square()?;
    check_length("rows of the right-hand sides", b.rows(), n)?;
    check_order(n)?;
    Ok(n)
}

/// Refuses an order whose work nobody waits for.
pub(super) fn check_most(n: usize, most: usize) -> Result<(), LinearError> {
    match n <= most {
        true => Ok(()),
        false => Err(Undecided::new(0, format!("order {n} is above {most}")).into()),
    }
}

fn check_order(n: usize) -> Result<(), LinearError> {
    check_most(n, modular::ROWS)
}

fn check_inverse(n: usize) -> Result<(), LinearError> {
    check_most(n, ROWS)
}

/// Refuses an exact answer whose work nobody waits for.
fn check_work(cleared: &Cleared, sides: usize) -> Result<(), LinearError> {
    let work = cleared.work(sides);
    match work <= EXACT_WORK {
        true => Ok(()),
        false => {
            let reason =
                format!("an exact answer takes {work:.0e} operations, above {EXACT_WORK:.0e}");
            Err(Undecided::new(0, reason).into())
        }
    }
}

fn rounded(x: &Matrix<Rational>, goal: u32) -> Matrix<Ball> {
    x.balls(goal + 2)
}

/// Checks that every ball is zero or known to a relative accuracy of `2^-goal`.
pub(super) fn are_known<'a>(values: impl IntoIterator<Item = &'a Ball>, goal: u32) -> bool {
    let is_known = |x: &Ball| x.is_zero() || x.accuracy_bits() >= i64::from(goal);
    values.into_iter().all(is_known)
}

/// Checks that every ball is known to `2^-goal` of its size, or of `2^-goal` of the largest one
/// where it is smaller than that.
pub(super) fn are_settled(values: &[Ball], goal: u32) -> bool {
    // Two bits more, which `Ball::accuracy_bits` may round off.
    let shift = -i64::from(goal) - 2;
    let largest = values.iter().fold(Mag::ZERO, |m, x| m.max(x.mignitude()));
    let is_settled = |x: &Ball| x.rad() <= x.mignitude().max(largest.shift(shift)).shift(shift);
    values.iter().all(is_settled)
}

fn identity(n: usize) -> Matrix<Rational> {
    Matrix::from_fn(n, n, |i, j| Rational::from(u32::from(i == j)))
}

/// Solves `A X = B` for every column of B, to a relative accuracy of `2^-goal` of each entry; long
/// systems as the module says.
///
/// # Errors
/// [`LinearError`]: wrong shapes, a singular matrix with a vector that proves it, or undecided.
pub fn solve(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
    goal: u32,
) -> Result<Matrix<Ball>, LinearError> {
    let n = check_system(a, b)?;
    if n == 0 {
        return Ok(Matrix::from_fn(0, b.columns(), |_, _| unreachable!()));
    }
    let cleared = Cleared::new(a);
    if cleared.work(b.columns()) <= WORK {
        return Ok(rounded(&exact::solve(a, &cleared, b)?, goal));
    }
    exact::check_regular(a, &cleared)?;
    check_inverse(n)?;
    let mut bits = goal + SPARE;
    for _ in 0..=DOUBLINGS {
        if let Some(verified) = Verified::new(a.balls(bits), bits) {
            let x = verified.solve_all(&b.balls(bits));
            if are_settled(x.entries(), goal) {
                return Ok(x);
            }
        }
        bits *= 2;
    }
    let reason = "the matrix was not proved to be regular";
    Err(Undecided::new(bits / 2, reason).into())
}

/// Solves `A X = B` exactly, for every column of B.
///
/// # Errors
/// As [`solve`].
pub fn solve_exactly(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
) -> Result<Matrix<Rational>, LinearError> {
    if check_system(a, b)? == 0 {
        return Ok(b.clone());
    }
    let cleared = Cleared::new(a);
    check_work(&cleared, b.columns())?;
    exact::solve(a, &cleared, b)
}

/// Returns the determinant to a relative accuracy of `2^-goal`; it is zero exactly where the
/// matrix is singular.
///
/// # Errors
/// [`LinearError::NotSquare`] or undecided.
pub fn determinant(a: &Matrix<Rational>, goal: u32) -> Result<Ball, LinearError> {
    Ok(Ball::rational(goal + 2, &determinant_exactly(a)?))
}

/// Returns the exact determinant.
///
/// # Errors
/// As [`determinant`].
pub fn determinant_exactly(a: &Matrix<Rational>) -> Result<Rational, LinearError> {
    let n = a.check_square()?;
    check_order(n)?;
    if n == 0 {
        return Ok(Rational::from(1));
    }
    let cleared = Cleared::new(a);
    // The second half is residues modulo primes that a bound asks for.
    check_work(&cleared, 2)?;
    exact::determinant(a, &cleared)
}

/// Returns the inverse to a relative accuracy of `2^-goal` of each entry.
///
/// # Errors
/// As [`solve`].
pub fn inverse(a: &Matrix<Rational>, goal: u32) -> Result<Matrix<Ball>, LinearError> {
    solve(a, &identity(a.check_square()?), goal)
}

/// Returns the exact inverse.
///
/// # Errors
/// As [`solve`].
pub fn inverse_exactly(a: &Matrix<Rational>) -> Result<Matrix<Rational>, LinearError> {
    solve_exactly(a, &identity(a.check_square()?))
}

/// Returns the x that minimises `‖A x − b‖₂`, for every column of b, to a relative accuracy of
/// `2^-goal` of each entry.
///
/// The normal equations are formed exactly, so that squaring the condition costs digits but no
/// accuracy; they are regular exactly where the columns of A are independent.
///
/// # Errors
/// As [`solve`], with [`LinearError::Singular`] where the columns of A are dependent.
pub fn least_squares(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
    goal: u32,
) -> Result<Matrix<Ball>, LinearError> {
    let (square, side) = normal_equations(a, b)?;
    solve(&square, &side, goal)
}

/// Returns the exact x that minimises `‖A x − b‖₂`.
///
/// # Errors
/// As [`least_squares`].
pub fn least_squares_exactly(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
) -> Result<Matrix<Rational>, LinearError> {
    let (square, side) = normal_equations(a, b)?;
    solve_exactly(&square, &side)
}

/// The vectors that `Aᵀ A` maps to zero are those that A maps to zero.
fn normal_equations(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
) -> Result<(Matrix<Rational>, Matrix<Rational>), LinearError> {
    check_length("rows of the right-hand sides", b.rows(), a.rows())?;
    check_order(a.columns())?;
    Ok(exact::normal_equations(a, b))
}

fn verified(a: &Matrix<Ball>, bits: u32) -> Result<Verified, LinearError> {
    check_inverse(a.check_square()?)?;
    a.check_finite()?;
    let reason = "the matrix of balls was not proved regular";
    Verified::new(a.clone(), bits).ok_or_else(|| Undecided::new(bits, reason).into())
}

/// Encloses the solutions of `A X = B` for all matrices and sides in the balls, in `bits` bits.
///
/// # Errors
/// Wrong shapes, balls without bounds, or undecided where a matrix in the balls may be singular.
pub fn solve_balls(
    a: &Matrix<Ball>,
    b: &Matrix<Ball>,
    bits: u32,
) -> Result<Matrix<Ball>, LinearError> {
    check_system(a, b)?;
    b.check_finite()?;
    Ok(verified(a, bits)?.solve_all(b))
}

/// Encloses the inverses of all matrices in the balls, in `bits` bits.
///
/// # Errors
/// As [`solve_balls`].
pub fn inverse_balls(a: &Matrix<Ball>, bits: u32) -> Result<Matrix<Ball>, LinearError> {
    Ok(verified(a, bits)?.solve_all(&identity(a.rows()).balls(bits)))
}

/// Encloses the determinants of all matrices in the balls, in `bits` bits.
///
/// # Errors
/// As [`solve_balls`].
pub fn determinant_balls(a: &Matrix<Ball>, bits: u32) -> Result<Ball, LinearError> {
    verified(a, bits)?.determinant()
}

/// Encloses the x that minimise `‖A x − b‖₂` for all matrices and sides in the balls, in `bits`
/// bits, by the regular system `r + A x = b`, `Aᵀ r = 0` (Björck, *BIT* 7 (1967) 1–21).
///
/// # Errors
/// As [`solve_balls`].
pub fn least_squares_balls(
    a: &Matrix<Ball>,
    b: &Matrix<Ball>,
    bits: u32,
) -> Result<Matrix<Ball>, LinearError> {
    let (m, n) = (a.rows(), a.columns());
    check_length("rows of the right-hand sides", b.rows(), m)?;
    check_inverse(m + n)?;
    a.check_finite()?;
    b.check_finite()?;
    let zero = || Ball::integer(bits, 0);
    let square = Matrix::from_fn(m + n, m + n, |i, j| match (i < m, j < m) {
        (true, true) => Ball::integer(bits, i64::from(i == j)),
        (true, false) => a.at(i, j - m).clone(),
        (false, true) => a.at(j, i - m).clone(),
        (false, false) => zero(),
    });
    let side = Matrix::from_fn(m + n, b.columns(), |i, j| {
        if i < m { b.at(i, j).clone() } else { zero() }
    });
    let all = verified(&square, bits)?.solve_all(&side);
    Ok(Matrix::from_fn(n, b.columns(), |i, j| {
        all.at(m + i, j).clone()
    }))
}

#[cfg(test)]
mod tests;

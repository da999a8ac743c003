//! One system with one right-hand side, by elimination from both ends at once.
//!
//! The rows above the middle one are eliminated downwards, those below it upwards, and the middle
//! row meets both (twisted factorization): two chains of operations that do not wait for each other.
//! With `r_i = 1/p_i`, from above
//!
//! ```text
//! p_i = diagonal_i − lower_{i−1} upper_{i−1} r_{i−1},   η_i = (d_i − lower_{i−1} η_{i−1}) r_i
//! x_i = η_i − upper_i r_i x_{i+1}
//! ```
//!
//! and likewise from below. As elimination of a matrix whose rows are permuted it is as stable for
//! matrices that are diagonally dominant as [`Sweep`]'s (Higham, *Accuracy and Stability of Numerical
//! Algorithms*, 2nd ed., theorems 9.11–9.13).

use super::error::{TridiagonalError, check_finite, check_length, check_matrix};
use super::{Stability, Sweep};
use crate::lanes::{Lanes, Task, with_best};

/// Products of entries from here on are rounded to their last place.
const LEAST: f64 = 1e-290;

/// Solves one system. Where a pivot vanishes, the sweep downwards is tried before the system is
/// refused. After an error the content of `x` is unspecified.
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_into;
/// let mut x = [0.0; 3];
/// solve_into(&[1.0, 1.0], &[4.0, 4.0, 4.0], &[1.0, 1.0], &[5.0, 6.0, 5.0], &mut x)?;
/// assert_eq!(x, [1.0, 1.0, 1.0]);
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`Sweep::factor`] and [`Sweep::solve`].
pub fn solve_into(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
    x: &mut [f64],
) -> Result<(), TridiagonalError> {
    solve::<false>(lower, diagonal, upper, d, x).map(|_| ())
}

/// [`solve_into`], and an estimate of the error of the solution relative to its largest entry,
/// `4 u · growth · skeel` as [`Stability::relative_error`](super::Stability::relative_error).
///
/// Here `skeel = ‖ |U⁻¹||L⁻¹||A| ‖_∞`, which the same passes give: Skeel's condition for a matrix that
/// is diagonally dominant by rows or columns, positive definite or an M-matrix, where
/// `|U⁻¹||L⁻¹| = |A⁻¹|`, and an upper bound of it for any other (Higham, *Efficient algorithms for
/// computing the condition number of a tridiagonal matrix*, SIAM J. Sci. Stat. Comput. 7, 1986).
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_into_with_error;
/// let mut x = [0.0; 2];
/// let error = solve_into_with_error(&[1.0], &[1e-20, 1.0], &[1.0], &[1.0, 2.0], &mut x)?;
/// assert!(error > 1.0); // without pivoting nothing is left
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`solve_into`].
pub fn solve_into_with_error(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
    x: &mut [f64],
) -> Result<f64, TridiagonalError> {
    solve::<true>(lower, diagonal, upper, d, x)
}

fn solve<const ESTIMATE: bool>(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
    x: &mut [f64],
) -> Result<f64, TridiagonalError> {
    let n = diagonal.len();
    if n == 0 || lower.len() != n - 1 || upper.len() != n - 1 {
        check_matrix(lower, diagonal, upper)?;
    }
    check_length("right-hand side", d, n)?;
    check_length("solution", x, n)?;
    let mut factors = vec![0.0; n];
    let mut sizes = vec![0.0; if ESTIMATE { n } else { 0 }];
    let found = with_best(Both::<ESTIMATE> {
        lower,
        diagonal,
        upper,
        d,
        x,
        factors: &mut factors,
        sizes: &mut sizes,
    });
    if let Some(estimate) = found {
        return Ok(estimate);
    }
    // Something is not finite or a pivot vanishes: the sweep tells which, or can do without.
    check_matrix(lower, diagonal, upper)?;
    check_finite("right-hand side", d)?;
    let sweep = Sweep::factor(lower, diagonal, upper)?;
    x.copy_from_slice(d);
    sweep.solve_in_place(x)?;
    Ok(match ESTIMATE {
        true => Stability::relative_error(&sweep.stability()),
        false => 0.0,
    })
}

/// Elimination from both ends; `None` if it fails.
struct Both<'a, const ESTIMATE: bool> {
    lower: &'a [f64],
    diagonal: &'a [f64],
    upper: &'a [f64],
    d: &'a [f64],
    x: &'a mut [f64],
    /// Room for what the next unknown is multiplied with.
    factors: &'a mut [f64],
    /// Room for the sums that bound the condition.
    sizes: &'a mut [f64],
}

/// One end's elimination: the row before.
#[derive(Clone, Copy)]
struct End {
    /// Reciprocal of its pivot.
    reciprocal: f64,
    /// Its part of the solution without the unknowns to come.
    eta: f64,
    /// The bound of that for the sums of absolute values.
    size: f64,
    growth: f64,
    ok: bool,
}

impl End {
    const BEFORE: End = End {
        reciprocal: 0.0,
        eta: 0.0,
        size: 0.0,
        growth: 1.0,
        ok: true,
    };

    /// Eliminates a row: `before · x_before + b x + after · x_after = d`, where `facing` is the entry
    /// of the row before that multiplies x. Returns the factor of the unknown after it, negated.
    #[inline(always)]
    fn row<const ESTIMATE: bool>(
        &mut self,
        [before, facing]: [f64; 2],
        b: f64,
        after: f64,
        d: f64,
    ) -> f64 {
        let product = before * facing;
        let p = (-product).mul_add(self.reciprocal, b);
        let r = 1.0 / p;
        self.ok &= p.is_normal() & r.is_normal();
        self.ok &= (product.abs() >= LEAST) | (before == 0.0) | (facing == 0.0);
        if ESTIMATE {
            let row = before.abs() + b.abs() + after.abs();
            let grown = (product * self.reciprocal).abs() + p.abs();
            if grown > self.growth * row {
                self.growth = grown / row;
            }
            self.size = before.abs().mul_add(self.size, row) * r.abs();
        }
        self.eta = (-before).mul_add(self.eta, d) * r;
        self.reciprocal = r;
        after * r
    }
}

impl<const ESTIMATE: bool> Task for Both<'_, ESTIMATE> {
    type Output = Option<f64>;
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> Option<f64> {
        let Both {
            lower,
            diagonal,
            upper,
            d,
            x,
            factors,
            sizes,
        } = self;
        let n = x.len();
        let middle = n / 2;
        let (mut down, mut up) = (End::BEFORE, End::BEFORE);
        let mut from_above = |i: usize, x: &mut [f64], factors: &mut [f64], sizes: &mut [f64]| {
            let facing = match i {
                0 => [0.0, 0.0],
                _ => [lower[i - 1], upper[i - 1]],
            };
            factors[i] = down.row::<ESTIMATE>(facing, diagonal[i], upper[i], d[i]);
            x[i] = down.eta;
            if ESTIMATE {
                sizes[i] = down.size;
            }
            down
        };
        let mut from_below = |i: usize, x: &mut [f64], factors: &mut [f64], sizes: &mut [f64]| {
            let facing = match i + 1 == n {
                true => [0.0, 0.0],
                false => [upper[i], lower[i]],
            };
            factors[i] = up.row::<ESTIMATE>(facing, diagonal[i], lower[i - 1], d[i]);
            x[i] = up.eta;
            if ESTIMATE {
                sizes[i] = up.size;
            }
            up
        };
        let (mut above, mut below) = (End::BEFORE, End::BEFORE);
        for k in 0..n - 1 - middle {
            above = from_above(k, x, factors, sizes);
            below = from_below(n - 1 - k, x, factors, sizes);
        }
        if middle > n - 1 - middle {
            above = from_above(middle - 1, x, factors, sizes);
        }
        // The middle row has no unknown after it.
        let (mut b, mut rest, mut size) = (diagonal[middle], d[middle], diagonal[middle].abs());
        let mut row = size;
        let mut ok = above.ok & below.ok;
        let mut grown = 0.0;
        let mut meet = |end: End, before: f64, facing: f64| {
            let product = before * facing;
            b = (-product).mul_add(end.reciprocal, b);
            rest = (-before).mul_add(end.eta, rest);
            row += before.abs();
            size += before.abs() + before.abs() * end.size;
            grown += (product * end.reciprocal).abs();
            ok &= (product.abs() >= LEAST) | (before == 0.0) | (facing == 0.0);
        };
        if middle > 0 {
            meet(above, lower[middle - 1], upper[middle - 1]);
        }
        if middle + 1 < n {
            meet(below, upper[middle], lower[middle]);
        }
        let r = 1.0 / b;
        ok &= b.is_normal() & r.is_normal();
        let value = rest * r;
        x[middle] = value;
        let growth = above.growth.max(below.growth).max((grown + b.abs()) / row);

        let (mut p, mut q) = (value, value);
        let mut size = [size * r.abs(); 2];
        let mut skeel = size[0];
        // A number that is not finite makes its product with zero none, and so the sum.
        let mut finite = value * 0.0;
        let back = |i: usize, next: &mut f64, size: &mut f64, x: &mut [f64]| {
            *next = (-factors[i]).mul_add(*next, x[i]);
            x[i] = *next;
            if ESTIMATE {
                *size = factors[i].abs().mul_add(*size, sizes[i]);
            }
            *next * 0.0
        };
        for k in 0..n - 1 - middle {
            finite += back(middle + 1 + k, &mut q, &mut size[1], x);
            if k < middle {
                finite += back(middle - 1 - k, &mut p, &mut size[0], x);
            }
            if ESTIMATE {
                skeel = skeel.max(size[0]).max(size[1]);
            }
        }
        if middle > n - 1 - middle {
            finite += back(0, &mut p, &mut size[0], x);
            skeel = skeel.max(size[0]);
        }
        if !ok || finite != 0.0 {
            return None;
        }
        Some(2.0 * f64::EPSILON * growth * skeel)
    }
}

#[cfg(test)]
mod tests;

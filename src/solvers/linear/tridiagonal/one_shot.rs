//! One system with one right-hand side, by elimination from both ends at once.
//!
//! The rows above the middle one are eliminated downwards, those below it upwards, and the middle
//! row meets both (twisted factorization): two chains of operations that do not wait for each
//! other. With `r_i = 1/p_i`, from above
//!
//! ```text
//! p_i = diagonal_i − lower_{i−1} upper_{i−1} r_{i−1},   η_i = (d_i − lower_{i−1} η_{i−1}) r_i
//! x_i = η_i − upper_i r_i x_{i+1}
//! ```
//!
//! and likewise from below. As elimination of a matrix whose rows are permuted it is as stable for
//! matrices that are diagonally dominant as [`Sweep`]'s (Higham, *Accuracy and Stability of
//! Numerical Algorithms*, 2nd ed., theorems 9.11–9.13).

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
/// Here `skeel = ‖ |U⁻¹||L⁻¹||A| ‖_∞`, which the same passes give: Skeel's condition for a matrix
/// that is diagonally dominant by rows or columns, positive definite or an M-matrix, where
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

    /// Eliminates a row: `before · x_before + b x + after · x_after = d`, where `facing` is the
    /// entry of the row before that multiplies x. Returns the factor of the unknown after it,
    /// negated.
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
        self.ok &= is_accurate(product, before, facing);
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

/// Returns whether the product of two entries is rounded to its last place.
#[inline(always)]
fn is_accurate(product: f64, a: f64, b: f64) -> bool {
    (product.abs() >= LEAST) | (a == 0.0) | (b == 0.0)
}

/// Where both ends write.
struct Room<'a> {
    x: &'a mut [f64],
    factors: &'a mut [f64],
    sizes: &'a mut [f64],
}

impl End {
    /// Eliminates row `i`.
    #[inline(always)]
    fn eliminate<const ESTIMATE: bool>(
        &mut self,
        i: usize,
        facing: [f64; 2],
        b: f64,
        after: f64,
        d: f64,
        room: &mut Room<'_>,
    ) {
        room.factors[i] = self.row::<ESTIMATE>(facing, b, after, d);
        room.x[i] = self.eta;
        if ESTIMATE {
            room.sizes[i] = self.size;
        }
    }
}

/// Back substitution from the middle row.
struct Back {
    next: f64,
    size: f64,
    /// The largest size.
    most: f64,
    /// A number that is not finite makes its product with zero none, and so this sum.
    finite: f64,
}

impl Back {
    fn new(next: f64, size: f64) -> Back {
        let finite = next * 0.0;
        Back {
            next,
            size,
            most: size,
            finite,
        }
    }

    /// Unknown `i` from the one before.
    #[inline(always)]
    fn substitute<const ESTIMATE: bool>(&mut self, i: usize, room: &mut Room<'_>) {
        let factor = room.factors[i];
        self.next = (-factor).mul_add(self.next, room.x[i]);
        room.x[i] = self.next;
        self.finite += self.next * 0.0;
        if ESTIMATE {
            self.size = factor.abs().mul_add(self.size, room.sizes[i]);
            self.most = self.most.max(self.size);
        }
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
        let (left, right) = (middle, n - 1 - middle);
        let (mut above, mut below) = (End::BEFORE, End::BEFORE);
        let room = &mut Room { x, factors, sizes };
        for k in 0..right {
            let (i, j) = (k, n - 1 - k);
            let facing = if k > 0 {
                [lower[i - 1], upper[i - 1]]
            } else {
                [0.0; 2]
            };
            above.eliminate::<ESTIMATE>(i, facing, diagonal[i], upper[i], d[i], room);
            let facing = if k > 0 {
                [upper[j], lower[j]]
            } else {
                [0.0; 2]
            };
            below.eliminate::<ESTIMATE>(j, facing, diagonal[j], lower[j - 1], d[j], room);
        }
        if left > right {
            let i = middle - 1;
            let facing = if i > 0 {
                [lower[i - 1], upper[i - 1]]
            } else {
                [0.0; 2]
            };
            above.eliminate::<ESTIMATE>(i, facing, diagonal[i], upper[i], d[i], room);
        }
        // The middle row has no unknown after it.
        let facing = |there: bool, at: usize| {
            if there {
                [lower[at], upper[at]]
            } else {
                [0.0; 2]
            }
        };
        let [a, a_facing] = facing(left > 0, middle.wrapping_sub(1));
        let [c_facing, c] = facing(right > 0, middle);
        let products = [a * a_facing, c * c_facing];
        let b = diagonal[middle];
        let p = (-products[0]).mul_add(above.reciprocal, b);
        let p = (-products[1]).mul_add(below.reciprocal, p);
        let rest = (-a).mul_add(above.eta, d[middle]);
        let rest = (-c).mul_add(below.eta, rest);
        let r = 1.0 / p;
        let mut ok = above.ok & below.ok & p.is_normal() & r.is_normal();
        ok &= is_accurate(products[0], a, a_facing) & is_accurate(products[1], c, c_facing);
        let row = a.abs() + b.abs() + c.abs();
        let grown = (products[0] * above.reciprocal).abs() + (products[1] * below.reciprocal).abs();
        let size = (a.abs() * above.size + c.abs() * below.size + row) * r.abs();
        let value = rest * r;
        room.x[middle] = value;
        let growth = above.growth.max(below.growth).max((grown + p.abs()) / row);

        let (mut upwards, mut downwards) = (Back::new(value, size), Back::new(value, size));
        for k in 0..right {
            downwards.substitute::<ESTIMATE>(middle + 1 + k, room);
            upwards.substitute::<ESTIMATE>(middle - 1 - k, room);
        }
        if left > right {
            upwards.substitute::<ESTIMATE>(0, room);
        }
        let skeel = upwards.most.max(downwards.most);
        let finite = upwards.finite + downwards.finite;
        if !ok || finite != 0.0 {
            return None;
        }
        Some(2.0 * f64::EPSILON * growth * skeel)
    }
}

#[cfg(test)]
mod tests;

//! Tridiagonal and cyclic tridiagonal systems.

use crate::border::{Error, Failure, Status, guarded};
use crate::strided::{Output, slice};
use mechaudit_solvers::cyclic_tridiagonal::CyclicSweep;
use mechaudit_solvers::tridiagonal::{TridiagonalError, solve_into, solve_into_with_error};

impl From<TridiagonalError> for Failure {
    fn from(e: TridiagonalError) -> Failure {
        use TridiagonalError as E;
        let (status, index, value) = match e {
            E::TooFew { .. } | E::Length { .. } => (Status::Size, 0, f64::NAN),
            E::NotFinite { index, value, .. } => (Status::NotFinite, index, value),
            E::Pivot { row, value } => (Status::Pivot, row, value),
            E::Overflow { row } => (Status::Overflow, row, f64::NAN),
        };
        Failure::new(status, e.to_string())
            .at(index)
            .because_of(value)
    }
}

/// The part of the system that does not depend on its kind.
struct System {
    n: usize,
    d: *const f64,
    x: *mut f64,
    error_estimate: *mut f64,
}

impl System {
    /// Copies the right-hand side, solves, and brings the solution to its place.
    ///
    /// # Safety
    /// n doubles can be read from `d` and written to `x`; `error_estimate` is NULL or can be written to.
    unsafe fn solve(
        &self,
        solved: impl FnOnce(&[f64]) -> Result<(Vec<f64>, f64), TridiagonalError>,
    ) -> Result<(), Failure> {
        Output::new("x", self.x, 1, self.n.max(1))?;
        // SAFETY: as promised; the slice is not used after `x` is written to.
        let (x, estimate) = solved(unsafe { slice("d", self.d, self.n) }?)?;
        // SAFETY: n doubles, which no slice of ours covers any more.
        unsafe { std::ptr::copy(x.as_ptr(), self.x, self.n) };
        if !self.error_estimate.is_null() {
            // SAFETY: not NULL, so it can be written to.
            unsafe { self.error_estimate.write(estimate) };
        }
        Ok(())
    }
}

/// Solves a tridiagonal system of n equations by elimination without pivoting from both ends: row i is
/// `lower[i-1] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = d[i]`; `lower` and `upper` have n - 1 numbers,
/// `diagonal`, `d` and `x` n. `x` may be `d`. For a matrix that is diagonally dominant by rows or columns the
/// solution is that of a system off by a few roundings (Higham, Accuracy and Stability, theorems 9.11-9.13).
/// For others `*error_estimate`, unless NULL, tells an estimate of the relative error; without pivoting it
/// may be large. Accuracy: `mechaudit audit tridiagonal`.
///
/// Errors: `NULL_POINTER`, `SIZE` (n = 0), `NOT_FINITE`, `PIVOT` (index: the row), `OVERFLOW`; `x` is as
/// it was then. `error` may be NULL.
///
/// # Safety
/// The arrays have these lengths; `error_estimate` and `error` are NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_tridiagonal_solve(
    n: usize,
    lower: *const f64,
    diagonal: *const f64,
    upper: *const f64,
    d: *const f64,
    x: *mut f64,
    error_estimate: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        let others = n.saturating_sub(1);
        // SAFETY: the caller promises arrays of these lengths.
        let [lower, diagonal, upper] = unsafe {
            [
                slice("lower", lower, others)?,
                slice("diagonal", diagonal, n)?,
                slice("upper", upper, others)?,
            ]
        };
        let system = System {
            n,
            d,
            x,
            error_estimate,
        };
        let solved = |d: &[f64]| {
            let mut x = vec![0.0; n];
            let estimate = match error_estimate.is_null() {
                true => solve_into(lower, diagonal, upper, d, &mut x).map(|()| 0.0),
                false => solve_into_with_error(lower, diagonal, upper, d, &mut x),
            }?;
            Ok((x, estimate))
        };
        // SAFETY: the caller promises n numbers of `d` and room for n of `x`.
        unsafe { system.solve(solved) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// Solves a cyclic tridiagonal system of n >= 3 equations, as `mechaudit_tridiagonal_solve`, but all
/// arrays have n numbers: `lower[0]` multiplies `x[n-1]` in row 0, `upper[n-1]` multiplies `x[0]` in row n - 1.
///
/// # Safety
/// The arrays have n doubles; `error_estimate` and `error` are NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_cyclic_tridiagonal_solve(
    n: usize,
    lower: *const f64,
    diagonal: *const f64,
    upper: *const f64,
    d: *const f64,
    x: *mut f64,
    error_estimate: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        // SAFETY: the caller promises arrays of n numbers.
        let [lower, diagonal, upper] = unsafe {
            [
                slice("lower", lower, n)?,
                slice("diagonal", diagonal, n)?,
                slice("upper", upper, n)?,
            ]
        };
        let system = System {
            n,
            d,
            x,
            error_estimate,
        };
        let solved = |d: &[f64]| {
            let sweep = CyclicSweep::factor(lower, diagonal, upper)?;
            let estimate = match error_estimate.is_null() {
                true => 0.0,
                false => sweep.stability().relative_error(),
            };
            Ok((sweep.solve(d)?, estimate))
        };
        // SAFETY: the caller promises n numbers of `d` and room for n of `x`.
        unsafe { system.solve(solved) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

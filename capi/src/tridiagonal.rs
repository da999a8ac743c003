//! Tridiagonal and cyclic tridiagonal systems.

use crate::border::{Error, Failure, Status, guarded};
use crate::strided::{Output, slice};
use mechaudit_solvers::cyclic_tridiagonal;
use mechaudit_solvers::tridiagonal::{
    TridiagonalError, solve_batch_in_place, solve_in_place, solve_into, solve_into_with_error,
};

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
    /// Copies the right-hand side to where the solution goes, solves there, and writes the estimate.
    /// The copy goes to `x` itself unless that overlaps the bands.
    ///
    /// # Safety
    /// n doubles can be read from `d` and written to `x`; `error_estimate` is NULL or can be written to.
    unsafe fn solve(
        &self,
        bands: [&[f64]; 3],
        solved: impl FnOnce(Option<&[f64]>, &mut [f64]) -> Result<f64, TridiagonalError>,
    ) -> Result<(), Failure> {
        let n = self.n;
        let (_, place) = Output::new("x", self.x, 1, n.max(1))?;
        let is_apart = |v: &[f64]| {
            let range = v.as_ptr_range();
            range.end.addr() <= place.start || place.end <= range.start.addr()
        };
        // SAFETY: as promised; not used after `x` is written to, unless it lies apart.
        let d = unsafe { slice("d", self.d, n) }?;
        let alone = bands.into_iter().all(is_apart);
        let estimate = if alone && is_apart(d) {
            // SAFETY: n doubles, which no slice covers.
            solved(Some(d), unsafe {
                std::slice::from_raw_parts_mut(self.x, n)
            })?
        } else if alone && self.d.addr() == self.x.addr() {
            // SAFETY: n doubles, which no slice covers that is used from here on.
            solved(None, unsafe { std::slice::from_raw_parts_mut(self.x, n) })?
        } else {
            let mut x = d.to_vec();
            let estimate = solved(None, &mut x)?;
            // SAFETY: n doubles; no slice is used any more.
            unsafe { std::ptr::copy(x.as_ptr(), self.x, n) };
            estimate
        };
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
/// Errors: `NULL_POINTER`, `SIZE` (n = 0), `NOT_FINITE`, `PIVOT` (index: the row), `OVERFLOW`; what `x`
/// holds then is unspecified. `error` may be NULL.
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
        let wanted = !error_estimate.is_null();
        let solved = |d: Option<&[f64]>, x: &mut [f64]| match (d, wanted) {
            (None, _) => solve_in_place(lower, diagonal, upper, x, wanted),
            (Some(d), false) => solve_into(lower, diagonal, upper, d, x).map(|()| 0.0),
            (Some(d), true) => solve_into_with_error(lower, diagonal, upper, d, x),
        };
        // SAFETY: the caller promises n numbers of `d` and room for n of `x`.
        unsafe { system.solve([lower, diagonal, upper], solved) }
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
        let wanted = !error_estimate.is_null();
        let solved = |d: Option<&[f64]>, x: &mut [f64]| {
            if let Some(d) = d {
                x.copy_from_slice(d);
            }
            cyclic_tridiagonal::solve_in_place(lower, diagonal, upper, x, wanted)
        };
        // SAFETY: the caller promises n numbers of `d` and room for n of `x`.
        unsafe { system.solve([lower, diagonal, upper], solved) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// Solves m tridiagonal systems of n equations each, which lie one after the other, n numbers each in all
/// arrays; of each system the first number of `lower` and the last one of `upper` are not used. `x` may be `d`.
/// Several systems are solved side by side: for many small ones. Of no system, m = 0, no array is touched.
///
/// Errors: as `mechaudit_tridiagonal_solve` with the place in the whole array, and `SIZE` where m n numbers
/// do not fit in memory; what `x` holds then is unspecified.
///
/// # Safety
/// The arrays have m n doubles, `x` does not overlap `lower`, `diagonal` or `upper`, nor `d` unless it is `d`;
/// `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_tridiagonal_solve_batch(
    m: usize,
    n: usize,
    lower: *const f64,
    diagonal: *const f64,
    upper: *const f64,
    d: *const f64,
    x: *mut f64,
    error: *mut Error,
) -> Status {
    let run = || {
        if m == 0 && n > 0 {
            return Ok(());
        }
        let all = m.saturating_mul(n);
        // SAFETY: the caller promises arrays of m n numbers.
        let [lower, diagonal, upper] = unsafe {
            [
                slice("lower", lower, all)?,
                slice("diagonal", diagonal, all)?,
                slice("upper", upper, all)?,
            ]
        };
        let system = System {
            n: all,
            d,
            x,
            error_estimate: std::ptr::null_mut(),
        };
        let solved = |d: Option<&[f64]>, x: &mut [f64]| {
            if let Some(d) = d {
                x.copy_from_slice(d);
            }
            solve_batch_in_place(n, lower, diagonal, upper, x).map(|()| 0.0)
        };
        // SAFETY: the caller promises m n numbers of `d` and room for as many of `x`.
        unsafe { system.solve([lower, diagonal, upper], solved) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

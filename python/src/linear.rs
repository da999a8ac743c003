//! Tridiagonal systems.

use crate::errors::value_error;
use mechaudit::solvers::cyclic_tridiagonal::{CyclicSweep, solve_in_place};
use mechaudit::solvers::tridiagonal::{
    Stability, Sweep, TridiagonalError, solve_into, solve_many_in_place,
};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;

type Evidence = (f64, bool, f64, f64, f64, bool);

fn evidence(s: &Stability) -> Evidence {
    (
        s.growth,
        s.dominant,
        s.rcond,
        s.skeel,
        s.relative_error(),
        s.is_reliable(),
    )
}

/// `A x = d` for a tridiagonal A; `d` holds several right-hand sides one after the other. The
/// solution alone: `tridiagonal_stability` tells how far it can be trusted.
#[pyfunction]
pub fn solve_tridiagonal<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
    d: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    let d = d.as_slice()?;
    solution(py, d, |x| match d.len() == diagonal.len() {
        true => solve_into(lower, diagonal, upper, d, x),
        false => {
            x.copy_from_slice(d);
            solve_many_in_place(lower, diagonal, upper, x)
        }
    })
}

/// An array as long as the right-hand sides, with the solutions. Its memory is numpy's, which comes
/// in larger pages.
fn solution<'py>(
    py: Python<'py>,
    d: &[f64],
    solve: impl FnOnce(&mut [f64]) -> Result<(), TridiagonalError> + Send,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let all = PyArray1::zeros(py, d.len(), false);
    let mut borrowed = all.readwrite();
    let x = borrowed.as_slice_mut()?;
    py.detach(|| solve(x)).map_err(value_error)?;
    drop(borrowed);
    Ok(all)
}

/// Error bound and condition of solutions with a tridiagonal matrix.
#[pyfunction]
pub fn tridiagonal_stability<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
) -> PyResult<Evidence> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    let run = || Ok(Sweep::factor(lower, diagonal, upper)?.stability());
    let s = py
        .detach(run)
        .map_err(|e: TridiagonalError| value_error(e))?;
    Ok(evidence(&s))
}

/// `A x = d` for a cyclic matrix: the first row's lower entry and the last row's upper entry stand
/// in the corners.
#[pyfunction]
pub fn solve_cyclic<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
    d: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    let d = d.as_slice()?;
    solution(py, d, |x| {
        x.copy_from_slice(d);
        match d.len() == diagonal.len() {
            true => solve_in_place(lower, diagonal, upper, x, false).map(|_| ()),
            false => CyclicSweep::factor(lower, diagonal, upper)?.solve_many_in_place(x),
        }
    })
}

/// Error bound and condition of solutions with a cyclic matrix.
#[pyfunction]
pub fn cyclic_stability<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
) -> PyResult<Evidence> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    let run = || Ok(CyclicSweep::factor(lower, diagonal, upper)?.stability());
    let s = py
        .detach(run)
        .map_err(|e: TridiagonalError| value_error(e))?;
    Ok(evidence(&s))
}

//! Tridiagonal systems.

use crate::errors::value_error;
use mechaudit::solvers::cyclic_tridiagonal::CyclicSweep;
use mechaudit::solvers::tridiagonal::{Stability, Sweep, TridiagonalError, solve_into};
use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
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
    let x = py
        .detach(|| {
            if d.len() == diagonal.len() {
                let mut x = vec![0.0; d.len()];
                solve_into(lower, diagonal, upper, d, &mut x)?;
                return Ok(x);
            }
            let mut x = d.to_vec();
            Sweep::factor(lower, diagonal, upper)?.solve_many_in_place(&mut x)?;
            Ok(x)
        })
        .map_err(|e: TridiagonalError| value_error(e))?;
    Ok(x.into_pyarray(py))
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
    let mut x = d.as_slice()?.to_vec();
    py.detach(|| CyclicSweep::factor(lower, diagonal, upper)?.solve_many_in_place(&mut x))
        .map_err(value_error)?;
    Ok(x.into_pyarray(py))
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

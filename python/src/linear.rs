//! Tridiagonal systems.

use crate::errors::value_error;
use mechaudit::solvers::cyclic_tridiagonal::CyclicSweep;
use mechaudit::solvers::tridiagonal::{Stability, Sweep, TridiagonalError};
use numpy::{PyArray1, PyReadonlyArray1, ToPyArray};
use pyo3::prelude::*;

type Solved<'py> = (Bound<'py, PyArray1<f64>>, (f64, bool, f64, f64, f64, bool));

/// Right-hand sides one after the other, solved in place, and how far the solutions can be trusted.
fn solve<'py>(
    py: Python<'py>,
    d: &[f64],
    run: impl FnOnce(&mut [f64]) -> Result<Stability, TridiagonalError> + Send,
) -> PyResult<Solved<'py>> {
    let mut x = d.to_vec();
    let s = py.detach(|| run(&mut x)).map_err(value_error)?;
    let evidence = (
        s.growth,
        s.dominant,
        s.rcond,
        s.skeel,
        s.relative_error(),
        s.is_reliable(),
    );
    Ok((x.to_pyarray(py), evidence))
}

/// `A x = d` for a tridiagonal A; `d` holds several right-hand sides one after the other.
#[pyfunction]
pub fn solve_tridiagonal<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
    d: PyReadonlyArray1<'py, f64>,
) -> PyResult<Solved<'py>> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    solve(py, d.as_slice()?, |x| {
        let sweep = Sweep::factor(lower, diagonal, upper)?;
        sweep.solve_many_in_place(x)?;
        Ok(sweep.stability())
    })
}

/// The same for a cyclic matrix: the first row's lower entry and the last row's upper entry stand in
/// the corners.
#[pyfunction]
pub fn solve_cyclic<'py>(
    py: Python<'py>,
    lower: PyReadonlyArray1<'py, f64>,
    diagonal: PyReadonlyArray1<'py, f64>,
    upper: PyReadonlyArray1<'py, f64>,
    d: PyReadonlyArray1<'py, f64>,
) -> PyResult<Solved<'py>> {
    let (lower, diagonal, upper) = (lower.as_slice()?, diagonal.as_slice()?, upper.as_slice()?);
    solve(py, d.as_slice()?, |x| {
        let sweep = CyclicSweep::factor(lower, diagonal, upper)?;
        sweep.solve_many_in_place(x)?;
        Ok(sweep.stability())
    })
}

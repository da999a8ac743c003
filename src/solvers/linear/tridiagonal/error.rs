//! Why a system is refused, and the checks that all elimination begins and ends with.

/// Why a tridiagonal or cyclic system was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TridiagonalError {
    /// Fewer unknowns than the method needs.
    #[error("{got} unknowns, at least {needed} are needed")]
    TooFew {
        /// The least number.
        needed: usize,
        /// The number given.
        got: usize,
    },
    /// A slice of the wrong length.
    #[error("{name} has {got} entries, {expected} are needed")]
    Length {
        /// Which slice.
        name: &'static str,
        /// The length due.
        expected: usize,
        /// The length given.
        got: usize,
    },
    /// An entry that is not a finite number.
    #[error("{name}[{index}] = {value} is not finite")]
    NotFinite {
        /// Which slice.
        name: &'static str,
        /// The place in it.
        index: usize,
        /// The entry.
        value: f64,
    },
    /// Elimination met a pivot that is zero or too small to divide by.
    #[error("the pivot of row {row} is {value}")]
    Pivot {
        /// The row, counted from 0.
        row: usize,
        /// The pivot.
        value: f64,
    },
    /// The solution does not fit in an `f64`.
    #[error("unknown {row} overflows")]
    Overflow {
        /// The unknown, counted from 0.
        row: usize,
    },
}

use TridiagonalError as Error;

impl TridiagonalError {
    /// The same of a system that begins `by` entries further on.
    pub(super) fn further(mut self, by: usize) -> TridiagonalError {
        if let Error::NotFinite { index: at, .. }
        | Error::Pivot { row: at, .. }
        | Error::Overflow { row: at } = &mut self
        {
            *at += by;
        }
        self
    }
}

pub(crate) fn check_length(
    name: &'static str,
    v: &[f64],
    expected: usize,
) -> Result<(), TridiagonalError> {
    if v.len() == expected {
        Ok(())
    } else {
        Err(Error::Length {
            name,
            expected,
            got: v.len(),
        })
    }
}

pub(crate) fn check_finite(name: &'static str, v: &[f64]) -> Result<(), TridiagonalError> {
    match v.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(index) => Err(Error::NotFinite {
            name,
            index,
            value: v[index],
        }),
    }
}

pub(crate) fn check_solution(x: &[f64]) -> Result<(), TridiagonalError> {
    match x.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(row) => Err(Error::Overflow { row }),
    }
}

pub(super) fn check_matrix(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
) -> Result<(), TridiagonalError> {
    let n = diagonal.len();
    if n == 0 {
        return Err(Error::TooFew { needed: 1, got: 0 });
    }
    check_length("lower", lower, n - 1)?;
    check_length("upper", upper, n - 1)?;
    check_finite("lower", lower)?;
    check_finite("diagonal", diagonal)?;
    check_finite("upper", upper)
}

/// Returns what can be divided by: normal, so that its reciprocal neither overflows nor loses bits.
pub(crate) fn check_pivot(row: usize, value: f64) -> Result<(), TridiagonalError> {
    if value.is_normal() {
        Ok(())
    } else {
        Err(Error::Pivot { row, value })
    }
}

//! Exceptions.

use mechaudit::message::readable;
use pyo3::PyErr;
use pyo3::create_exception;
use pyo3::exceptions::{PyArithmeticError, PyValueError};

create_exception!(
    mechaudit,
    Undecided,
    PyArithmeticError,
    "The digits asked for could not be proved at the precision that was allowed."
);
create_exception!(
    mechaudit,
    DomainError,
    PyValueError,
    "The function has no certified value at the argument."
);

/// A refusal by its own words.
pub fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(readable(&error.to_string()).into_owned())
}

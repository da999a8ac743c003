//! The methods that arguments name.

use crate::cli::failure::Failure;
use mechaudit::methods::{self, Evaluable};

/// Returns the method that an argument names.
pub fn method(text: &str) -> Result<Box<dyn Evaluable>, Failure> {
    methods::resolve(text).map_err(Failure::caused)
}

/// Returns the method that an argument names, or all methods without one.
pub fn methods(text: Option<&str>) -> Result<Vec<Box<dyn Evaluable>>, Failure> {
    match text {
        Some(text) => Ok(vec![method(text)?]),
        None => Ok(methods::registry()),
    }
}

//! The code whose error is bounded.

use crate::ProofError;
use crate::tables::Tables;
use crate::tracked::Rounding;
use mechaudit_solvers::faddeeva::{Branch, branch};
use num_complex::Complex;

/// The code whose error is bounded, and how its operations round.
#[derive(Clone)]
pub struct Code {
    /// Its rows.
    pub tables: Tables,
    /// Which formula it uses at a point of the closed quadrant.
    pub branch: fn(f64, f64) -> Branch,
    /// How operations round.
    pub rounding: Rounding,
}

/// The solver's choice.
fn solvers_branch(a: f64, b: f64) -> Branch {
    branch(Complex::new(a, b))
}

impl Code {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver() -> Result<Code, ProofError> {
        Ok(Code {
            tables: Tables::of_the_solver()?,
            branch: solvers_branch,
            rounding: Rounding::default(),
        })
    }
}

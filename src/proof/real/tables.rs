//! The solver's rows and constants with their errors, each computed once.

use super::Function;
use crate::ProofError;
use crate::tables::{imaginary_axis_at, on_imaginary_axis};
use crate::truncation::{RowErrors, exponential_error, odd_series_error, pair_error};
use mechaudit_reference::Ball;
use mechaudit_solvers::faddeeva::proof::AxisRow;
use mechaudit_solvers::faddeeva::proof::real_line as code;
use rayon::prelude::*;
use rug::Rational;
use std::collections::HashMap;

/// Describes what the formulas of one function are made of.
#[derive(Clone)]
pub struct Tables {
    /// By the bits of the centre.
    pub(super) rows: HashMap<u64, (AxisRow, RowErrors)>,
    /// Holds what is wrong without rounding, as a part of the value: the exponential, the Maclaurin
    /// series, and 2/√π, √π/2 and 1/√π.
    pub(super) exponential: f64,
    pub(super) near: f64,
    pub(super) constants: [f64; 3],
}

/// `1/2!` and the stored coefficients that follow in the polynomial of the exponential.
pub(super) fn exponential_coefficients() -> (Vec<f64>, [f64; 2]) {
    let (from_cube, ln_2) = code::exponential_constants();
    let all = std::iter::once(0.5).chain(from_cube.iter().copied());
    (all.collect(), ln_2)
}

/// Above the binary exponents of `e^{±x²}`, `x² ≤ 900`.
pub(super) const MOST: f64 = 1300.0;

/// The error of the Maclaurin series of Dawson's function, or of erf, with these coefficients.
pub(super) fn near_error(function: Function, (c, low): (&[f64], f64)) -> f64 {
    match function {
        // (−2)ⁿ/(2n + 1)!!
        Function::Dawson => {
            odd_series_error(c, low, |n, before| before * Rational::from((-2, 2 * n + 1)))
        }
        // (−1)ⁿ/(n! (2n + 1))
        _ => odd_series_error(c, low, |n, before| {
            before * Rational::from((-(2 * i64::from(n) - 1), n * (2 * n + 1)))
        }),
    }
}

/// The centres of the rows.
fn centres(function: Function) -> Vec<f64> {
    match function {
        Function::Dawson => (8..=144).map(|k| f64::from(k) / 16.0).collect(),
        Function::Erf => (1..=24).map(|k| f64::from(k) / 4.0).collect(),
        _ => on_imaginary_axis().collect(),
    }
}

fn row_of(function: Function, x: f64) -> (f64, AxisRow) {
    match function {
        Function::Dawson => {
            let (row, t) = code::dawson_row(x);
            (x - t, row)
        }
        Function::Erf => {
            let (row, t) = code::erf_row(x);
            (x - t, *row)
        }
        _ => {
            let (centre, row) = imaginary_axis_at(x);
            (centre, *row)
        }
    }
}

impl Tables {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver(function: Function) -> Result<Tables, ProofError> {
        const BITS: u32 = 300;
        let rows = centres(function).into_par_iter().map(|x| {
            let (centre, row) = row_of(function, x);
            let errors = match function {
                Function::Dawson => RowErrors::of_dawson(&row, centre)?,
                Function::Erf => RowErrors::of_erf(&row, centre)?,
                _ => RowErrors::on_axis(&row, centre)?,
            };
            Ok((centre.to_bits(), (row, errors)))
        });
        let rows = rows.collect::<Result<HashMap<_, _>, ProofError>>()?;
        let (coefficients, ln_2) = exponential_coefficients();
        let [erf, dawson] = code::odd_series();
        let root = Ball::pi(BITS).sqrt();
        let two = Ball::integer(BITS, 2);
        let [p, q, r] = code::constants();
        Ok(Tables {
            rows,
            exponential: exponential_error(&coefficients, ln_2, MOST),
            near: match function {
                Function::Dawson => near_error(function, dawson),
                _ => near_error(function, erf),
            },
            constants: [
                pair_error(p, &(&two / &root)),
                pair_error(q, &(&root / &two)),
                pair_error(r, &root.recip()),
            ],
        })
    }

    pub(super) fn row(&self, centre: f64) -> Result<&(AxisRow, RowErrors), &'static str> {
        self.rows.get(&centre.to_bits()).ok_or("no such centre")
    }
}

#[cfg(test)]
mod tests;

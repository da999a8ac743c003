//! The solver's rows and constants with their errors, each computed once.

use super::Function;
use crate::ProofError;
use crate::truncation::{ErfcRow, RowErrors, exponential_error, odd_series_error, pair_error};
use mechaudit_reference::Ball;
use mechaudit_solvers::faddeeva::proof::real_line::{self as code, OfRows};
use rayon::prelude::*;
use rug::Rational;
use std::collections::HashMap;
use std::ops::RangeInclusive;

/// Describes what the formulas of one function are made of.
#[derive(Clone)]
pub struct Tables {
    /// By the bits of the centre.
    pub(super) rows: HashMap<u64, (Vec<f64>, RowErrors)>,
    /// The rows of erfc or erfcx, likewise.
    pub(super) complement: HashMap<u64, ErfcRow>,
    /// Holds what is wrong without rounding, as a part of the value: the exponential, the Maclaurin
    /// series of Dawson's function, and 2/√π, √π/2 and 1/√π.
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

/// The error of the Maclaurin series of Dawson's function with these coefficients, `(−2)ⁿ/(2n + 1)!!`.
pub(super) fn near_error((c, low): (&[f64], f64)) -> f64 {
    odd_series_error(c, low, |n, before| before * Rational::from((-2, 2 * n + 1)))
}

/// Points with a row each, and whose rows they are.
fn points(function: Function) -> Vec<(OfRows, f64)> {
    let sixteenths = |of, range: RangeInclusive<u32>| range.map(move |k| (of, f64::from(k) / 16.0));
    match function {
        Function::Dawson => sixteenths(OfRows::Dawson, 8..=144).collect(),
        Function::Erf => sixteenths(OfRows::Erf, 0..=95).collect(),
        Function::Erfc | Function::Erfcx => Vec::new(),
    }
}

/// erfcx at a centre of either sign, and −2/√π.
fn erfcx_row(centre: f64) -> [f64; 4] {
    let [hi, lo, left_hi, left_lo] = *code::erfcx_row(centre.abs());
    let [slope, slope_low] = code::constants()[0].map(|c| -c);
    match centre.is_sign_negative() {
        true => [left_hi, left_lo, slope, slope_low],
        false => [hi, lo, slope, slope_low],
    }
}

/// The errors of a row.
pub(super) fn errors(of: OfRows, row: &[f64], centre: f64) -> Result<RowErrors, ProofError> {
    match of {
        OfRows::Dawson => RowErrors::of_dawson(row, centre),
        OfRows::Erf => RowErrors::of_erf(row, centre),
    }
}

impl Tables {
    /// The solver's.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver(function: Function) -> Result<Tables, ProofError> {
        const BITS: u32 = 300;
        let rows = points(function).into_par_iter().map(|(of, x)| {
            let (row, t) = code::row(of, x);
            let centre = x - t;
            let errors = errors(of, row, centre)?;
            Ok((centre.to_bits(), (row.to_vec(), errors)))
        });
        let rows = rows.collect::<Result<HashMap<_, _>, ProofError>>()?;
        let signs: &[f64] = match function {
            Function::Erfc => &[1.0],
            Function::Erfcx => &[1.0, -1.0],
            _ => &[],
        };
        let centres: Vec<f64> = (0..1024)
            .flat_map(|k| signs.iter().map(move |s| s * (f64::from(k) / 128.0)))
            .collect();
        let complement = centres.into_par_iter().map(|centre| {
            let row = match function {
                Function::Erfc => *code::erfc_row(centre).0,
                _ => erfcx_row(centre),
            };
            let row = ErfcRow::new(function == Function::Erfcx, row, centre)?;
            Ok((centre.to_bits(), row))
        });
        let complement = complement.collect::<Result<HashMap<_, _>, ProofError>>()?;
        let (coefficients, ln_2) = exponential_coefficients();
        let root = Ball::pi(BITS).sqrt();
        let two = Ball::integer(BITS, 2);
        let [p, q, r] = code::constants();
        Ok(Tables {
            rows,
            complement,
            exponential: exponential_error(&coefficients, ln_2, MOST),
            near: near_error(code::odd_series()),
            constants: [
                pair_error(p, &(&two / &root)),
                pair_error(q, &(&root / &two)),
                pair_error(r, &root.recip()),
            ],
        })
    }

    pub(super) fn row(&self, centre: f64) -> Result<&(Vec<f64>, RowErrors), &'static str> {
        self.rows.get(&centre.to_bits()).ok_or("no such centre")
    }

    pub(super) fn complement(&self, centre: f64) -> Result<&ErfcRow, &'static str> {
        let row = self.complement.get(&centre.to_bits());
        row.ok_or("no such centre of erfc or erfcx")
    }
}

#[cfg(test)]
mod tests;

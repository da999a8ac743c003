//! Taylor rows as the lower half-plane uses them.

use crate::ProofError;
use crate::bounds::{above, power_up};
use crate::interval::{hypot_up, product_up, quotient_up, sum_up};
use crate::tables::{cell_at, in_cells, on_real_axis, real_axis_at};
use mechaudit_reference::{Ball, faddeeva};
use mechaudit_solvers::faddeeva::proof::{Row, lower as code};
use rayon::prelude::*;
use rug::Rational;
use std::collections::HashMap;

const BITS: u32 = 300;
const STORED: usize = 18;
const TERMS: usize = 41;

/// Which rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Kind {
    /// Cells of the first quadrant, values unevaluated.
    Cell,
    /// Cells of the lower half-disc, values rounded.
    Disc,
    /// About centres on the real axis, values unevaluated.
    RealAxis,
}

/// A row, and how far each of its coefficients is from that of w.
#[derive(Clone)]
pub(crate) struct RowWithErrors {
    pub row: Row,
    errors: Vec<f64>,
    most: f64,
}

fn rational(x: f64) -> Rational {
    Rational::from_f64(x).expect("finite")
}

/// Places of a coefficient's parts in a row: real, its low part, imaginary, its low part.
fn places(n: usize) -> [Option<usize>; 4] {
    match n {
        0 => [0, 1, 2, 3].map(Some),
        1 => [4, 5, 6, 7].map(Some),
        _ => {
            let at = 8 + 8 * ((n - 2) / 4) + (n - 2) % 4;
            [Some(at), None, Some(at + 4), None]
        }
    }
}

impl RowWithErrors {
    /// # Errors
    /// If the reference is undecided.
    pub fn of(row: &Row, centre: (f64, f64), kind: Kind) -> Result<RowWithErrors, ProofError> {
        let c = faddeeva::taylor(&rational(centre.0), &rational(centre.1), TERMS - 1, BITS)?;
        let errors = c.iter().enumerate().map(|(n, c)| {
            if n >= STORED {
                return hypot_up(above(&c.re), above(&c.im));
            }
            let [p, q, r, s] =
                places(n).map(|at| at.map_or_else(Rational::new, |at| rational(row[at])));
            let off = |stored: Rational, exact: &Ball| {
                above(&(&Ball::rational(4 * BITS, &stored) - exact))
            };
            hypot_up(off(p + q, &c.re), off(r + s, &c.im))
        });
        // erfcx(Im z) ≤ 2e^{(Im z)²} on the circle of radius 3, down to Im z = −3, or −4: 2e⁹ and 2e¹⁶.
        let most = if kind == Kind::Disc { 1.78e7 } else { 16207.0 };
        Ok(RowWithErrors {
            row: *row,
            errors: errors.collect(),
            most,
        })
    }

    /// A bound of `|p(δ) − w|` for `|δ| ≤ D`.
    pub fn within(&self, d: f64) -> f64 {
        if !(d <= 1.0) {
            return f64::INFINITY;
        }
        let (mut sum, mut power) = (0.0, 1.0);
        for e in &self.errors {
            sum = sum_up(sum, product_up(*e, power));
            power = product_up(power, d);
        }
        let q = quotient_up(d, 3.0);
        sum_up(
            sum,
            product_up(100.0 * self.most, power_up(q, TERMS as u32 - 1)),
        )
    }
}

type Key = (Kind, u64, u64);

/// The rows of the lower half-plane by their centres.
#[derive(Clone)]
pub struct Rows(HashMap<Key, RowWithErrors>);

fn key(kind: Kind, (x, y): (f64, f64)) -> Key {
    (kind, x.to_bits(), (y + 0.0).to_bits())
}

/// Centre and row of the cell of the lower half-disc around `a − i b`.
pub(crate) fn disc_at(a: f64, b: f64) -> ((f64, f64), &'static Row) {
    let (row, dx, dy) = code::disc(a, b);
    ((a - dx, -b - dy), row)
}

impl Rows {
    /// Those of the solver.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver() -> Result<Rows, ProofError> {
        let mut all: HashMap<Key, (Kind, (f64, f64), &'static Row)> = HashMap::new();
        let mut insert = |kind, (centre, row)| {
            all.insert(key(kind, centre), (kind, centre, row));
        };
        for (a, b) in in_cells() {
            insert(Kind::Cell, cell_at(a, b));
            if a.max(b) < 1.1 {
                insert(Kind::Disc, disc_at(a, b));
            }
        }
        for a in on_real_axis() {
            let (centre, row) = real_axis_at(a);
            insert(Kind::RealAxis, ((centre, 0.0), row));
        }
        all.into_par_iter()
            .map(|(key, (kind, centre, row))| Ok((key, RowWithErrors::of(row, centre, kind)?)))
            .collect::<Result<_, ProofError>>()
            .map(Rows)
    }

    pub(crate) fn get(
        &self,
        kind: Kind,
        centre: (f64, f64),
    ) -> Result<&RowWithErrors, &'static str> {
        self.0.get(&key(kind, centre)).ok_or("no such row")
    }

    #[cfg(test)]
    pub(crate) fn change(&mut self, kind: Kind, centre: (f64, f64), change: impl FnOnce(&mut Row)) {
        let found = self.0.get_mut(&key(kind, centre)).expect("a row");
        let mut row = found.row;
        change(&mut row);
        *found = RowWithErrors::of(&row, centre, kind).expect("decided");
    }
}

#[cfg(test)]
#[path = "tests/rows.rs"]
mod tests;

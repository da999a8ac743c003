//! Taylor rows as the lower half-plane uses them.

use crate::ProofError;
use crate::interval::{product_up, sum_up};
use crate::tables::{cell_at, in_cells, on_real_axis, real_axis_at};
use crate::truncation::RowErrors;
use crate::truncation::rows::tail;
use mechaudit_solvers::faddeeva::proof::{Row, lower as code};
use rayon::prelude::*;
use std::collections::HashMap;

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

impl RowWithErrors {
    /// # Errors
    /// If the reference is undecided.
    pub fn of(row: &Row, centre: (f64, f64), kind: Kind) -> Result<RowWithErrors, ProofError> {
        // erfcx(Im z) ≤ 2e^{(Im z)²} on the circle of radius 3, down to Im z = −3, or −4: 2e⁹ and
        // 2e¹⁶.
        let most = if kind == Kind::Disc { 1.78e7 } else { 16207.0 };
        Ok(RowWithErrors {
            row: *row,
            errors: RowErrors::of(row, centre)?.sizes().collect(),
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
        sum_up(sum, tail(d, self.most))
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
mod tests;

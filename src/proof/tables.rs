//! The solver's tables with their errors, each computed once.

use crate::ProofError;
use crate::bound::Bound;
use crate::truncation::{RowErrors, exponential_error, polynomial_error};
use mechaudit_solvers::faddeeva::proof as code;
use mechaudit_solvers::faddeeva::proof::{AxisRow, Row};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::{Arc, Mutex};

type Key = (u64, u64);

fn key((x, y): (f64, f64)) -> Key {
    (x.to_bits(), (y + 0.0).to_bits())
}

/// A row and its errors.
type WithErrors<R> = (R, RowErrors);

/// Rows by their centres with their errors, each on a core of its own.
fn with_errors<R: Copy + Send + Sync + 'static>(
    rows: impl Iterator<Item = ((f64, f64), &'static R)>,
    errors: impl Fn(&R, (f64, f64)) -> Result<RowErrors, ProofError> + Sync,
) -> Result<HashMap<Key, WithErrors<R>>, ProofError> {
    let rows: Vec<_> = rows.collect();
    let each = rows.into_par_iter();
    each.map(|(centre, row)| Ok((key(centre), (*row, errors(row, centre)?))))
        .collect()
}

/// Rows by their centres.
#[derive(Clone)]
pub struct Tables {
    cells: HashMap<Key, WithErrors<Row>>,
    discs: HashMap<Key, WithErrors<Row>>,
    real_axis: HashMap<Key, WithErrors<Row>>,
    imaginary_axis: HashMap<Key, WithErrors<AxisRow>>,
    pub(crate) real_line: [f64; 2],
    /// Holds what the exponential beside the real axis is wrong by without rounding.
    pub(crate) exponential: f64,
    /// Bounds of the scaled formula, whose rectangles are the same in every shell.
    pub(crate) scaled: Arc<Mutex<HashMap<Scaled, Bound>>>,
}

/// A scaled rectangle by its bits, and how operations round.
pub(crate) type Scaled = ([u64; 4], bool, Option<u32>);

/// Centre and row of the cell around a point.
pub(crate) fn cell_at(a: f64, b: f64) -> ((f64, f64), &'static Row) {
    let (row, dx, dy) = code::cell(a, b);
    ((a - dx, b - dy), row)
}

/// Centre and row of the cell of the lower half-disc around `a − i b`.
pub(crate) fn disc_at(a: f64, b: f64) -> ((f64, f64), &'static Row) {
    let (row, dx, dy) = code::lower::disc(a, b);
    ((a - dx, -b - dy), row)
}

/// Centre and row on the real axis.
pub(crate) fn real_axis_at(a: f64) -> (f64, &'static Row) {
    let (row, t) = code::real_axis(a);
    (a - t, row)
}

/// Centre and row on the imaginary axis.
pub(crate) fn imaginary_axis_at(b: f64) -> (f64, &'static AxisRow) {
    let (row, t) = code::imaginary_axis(b);
    (b - t, row)
}

/// Points in all cells that a point of the closed quadrant may have: just inside the corners of the
/// fine cells, which no line between cells meets.
pub(crate) fn in_cells() -> impl Iterator<Item = (f64, f64)> {
    let near = |i: i32, s: f64| (0.25 * f64::from(i) + s).max(0.0);
    let corners = [(-0.1, -0.1), (-0.1, 0.1), (0.1, -0.1), (0.1, 0.1)];
    let fine = (0..=30).flat_map(|i| (0..=30).map(move |j| (i, j)));
    let all = fine.flat_map(move |(i, j)| corners.map(|(s, t)| (near(i, s), near(j, t))));
    all.filter(|(a, b)| a * a + b * b < 56.0)
}

/// The centres on the real axis.
pub(crate) fn on_real_axis() -> impl Iterator<Item = f64> {
    (18..=144).map(|k| 0.0625 * f64::from(k))
}

/// The centres on the imaginary axis.
pub(crate) fn on_imaginary_axis() -> impl Iterator<Item = f64> {
    (0..=28).map(|k| 0.25 * f64::from(k))
}

impl Tables {
    /// Those of the solver, at every centre that a point of either half-plane may have.
    ///
    /// # Errors
    /// If the reference is undecided about a coefficient.
    pub fn of_the_solver() -> Result<Tables, ProofError> {
        type Rows = HashMap<Key, ((f64, f64), &'static Row)>;
        let rows = |points: &mut dyn Iterator<Item = (f64, f64)>, at: fn(f64, f64) -> _| {
            let all = points.map(|(a, b)| at(a, b));
            all.map(|(centre, row)| (key(centre), (centre, row)))
                .collect::<Rows>()
        };
        let cells = rows(&mut in_cells(), cell_at);
        let discs = rows(&mut in_cells().filter(|(a, b)| a.max(*b) < 1.1), disc_at);
        let real = on_real_axis().map(|a| {
            let (centre, row) = real_axis_at(a);
            ((centre, 0.0), row)
        });
        let imaginary = on_imaginary_axis().map(|b| {
            let (centre, row) = imaginary_axis_at(b);
            ((0.0, centre), row)
        });
        let line = code::real_line_polynomials();
        let (coefficients, ln_2) = code::exponential();
        Ok(Tables {
            cells: with_errors(cells.into_values(), RowErrors::of)?,
            discs: with_errors(discs.into_values(), RowErrors::of)?,
            real_axis: with_errors(real, RowErrors::of)?,
            imaginary_axis: with_errors(imaginary, |row, (_, s)| RowErrors::on_axis(row, s))?,
            real_line: [
                polynomial_error(&line[0], false),
                polynomial_error(&line[1], true),
            ],
            exponential: exponential_error(coefficients, ln_2, 1200.0),
            scaled: Arc::default(),
        })
    }

    pub(crate) fn cell(&self, centre: (f64, f64)) -> Result<&WithErrors<Row>, &'static str> {
        self.cells.get(&key(centre)).ok_or("no such cell")
    }

    pub(crate) fn disc(&self, centre: (f64, f64)) -> Result<&WithErrors<Row>, &'static str> {
        self.discs
            .get(&key(centre))
            .ok_or("no such cell of the lower half-disc")
    }

    pub(crate) fn real_axis(&self, centre: f64) -> Result<&WithErrors<Row>, &'static str> {
        let key = key((centre, 0.0));
        self.real_axis.get(&key).ok_or("no such centre")
    }

    pub(crate) fn imaginary_axis(&self, centre: f64) -> Result<&WithErrors<AxisRow>, &'static str> {
        let key = key((0.0, centre));
        self.imaginary_axis.get(&key).ok_or("no such centre")
    }

    /// The rows of cells, of the lower half-disc and about a centre changed: their errors are
    /// computed anew.
    #[cfg(test)]
    pub(crate) fn change(&mut self, centre: (f64, f64), change: impl Fn(&mut Row)) {
        let all = [&mut self.cells, &mut self.discs, &mut self.real_axis];
        let found = all
            .into_iter()
            .filter_map(|rows| rows.get_mut(&key(centre)));
        let mut changed = 0;
        for (row, errors) in found {
            change(row);
            *errors = RowErrors::of(row, centre).expect("decided");
            changed += 1;
        }
        assert!(changed > 0, "no row about {centre:?}");
    }
}

#[cfg(test)]
mod tests;

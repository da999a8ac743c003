//! Dense matrices by rows, and the reasons why a linear problem has no certified answer.

use crate::{Ball, Undecided};
use rug::Rational;

/// A dense matrix, stored by rows.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix<T> {
    rows: usize,
    columns: usize,
    entries: Vec<T>,
}

/// The reason why a linear problem has no certified answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LinearError {
    /// The number of rows differs from the number of columns.
    #[error("a matrix of {rows} rows and {columns} columns is not square")]
    NotSquare {
        /// The number of rows.
        rows: usize,
        /// The number of columns.
        columns: usize,
    },
    /// A list has another length than the problem needs.
    #[error("{name}: {found} entries where {due} are needed")]
    Length {
        /// The list.
        name: &'static str,
        /// Its length.
        found: usize,
        /// The length that the problem needs.
        due: usize,
    },
    /// A number is NaN or infinite, or a ball has no bound.
    #[error("row {row}, column {column}: the entry is not a finite number")]
    NotFinite {
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// Two entries that mirror each other differ.
    #[error("the entries ({row}, {column}) and ({column}, {row}) of a symmetric matrix differ")]
    NotSymmetric {
        /// The row, counted from 0.
        row: usize,
        /// The column, counted from 0.
        column: usize,
    },
    /// The columns are linearly dependent: `A null = 0`, computed exactly.
    #[error("the matrix maps a vector to zero that is not zero: its columns are dependent")]
    Singular {
        /// A vector that is not zero, with `A null = 0`.
        null: Vec<Rational>,
    },
    /// The matrix is not positive definite: `witnessᵀ B witness ≤ 0`, computed exactly.
    #[error("the matrix is not positive definite: its quadratic form is not positive at a vector")]
    NotPositiveDefinite {
        /// A vector that is not zero, with `witnessᵀ B witness ≤ 0`.
        witness: Vec<Rational>,
    },
    /// No proof was found.
    #[error(transparent)]
    Undecided(#[from] Undecided),
}

impl<T> Matrix<T> {
    /// Takes the entries row by row.
    ///
    /// # Errors
    /// [`LinearError::Length`] if there are not `rows · columns` entries.
    pub fn new(rows: usize, columns: usize, entries: Vec<T>) -> Result<Matrix<T>, LinearError> {
        let due = rows.saturating_mul(columns);
        check_length("entries of the matrix", entries.len(), due)?;
        Ok(Matrix {
            rows,
            columns,
            entries,
        })
    }

    /// Takes the entry of row i and column j from a function.
    pub fn from_fn(
        rows: usize,
        columns: usize,
        mut at: impl FnMut(usize, usize) -> T,
    ) -> Matrix<T> {
        let mut entries = Vec::with_capacity(rows * columns);
        for i in 0..rows {
            entries.extend((0..columns).map(|j| at(i, j)));
        }
        Matrix {
            rows,
            columns,
            entries,
        }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Returns the number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Returns a row.
    pub fn row(&self, i: usize) -> &[T] {
        &self.entries[i * self.columns..(i + 1) * self.columns]
    }

    /// Returns the entry of row i and column j.
    pub fn at(&self, i: usize, j: usize) -> &T {
        &self.entries[i * self.columns + j]
    }

    pub(super) fn at_mut(&mut self, i: usize, j: usize) -> &mut T {
        &mut self.entries[i * self.columns + j]
    }

    /// Returns the entries row by row.
    pub fn entries(&self) -> &[T] {
        &self.entries
    }

    /// Applies a function to every entry.
    pub fn map<U>(&self, to: impl FnMut(&T) -> U) -> Matrix<U> {
        Matrix {
            rows: self.rows,
            columns: self.columns,
            entries: self.entries.iter().map(to).collect(),
        }
    }

    pub(super) fn check_square(&self) -> Result<usize, LinearError> {
        if self.rows != self.columns {
            let (rows, columns) = (self.rows, self.columns);
            return Err(LinearError::NotSquare { rows, columns });
        }
        Ok(self.rows)
    }
}

impl Matrix<Rational> {
    /// Takes the exact values of floating-point numbers.
    ///
    /// # Errors
    /// [`LinearError::Length`], and [`LinearError::NotFinite`] for NaN and infinities.
    pub fn from_f64(
        rows: usize,
        columns: usize,
        entries: &[f64],
    ) -> Result<Matrix<Rational>, LinearError> {
        check_length(
            "entries of the matrix",
            entries.len(),
            rows.saturating_mul(columns),
        )?;
        let exact = |(k, x): (usize, &f64)| {
            Rational::from_f64(*x).ok_or(LinearError::NotFinite {
                row: k / columns,
                column: k % columns,
            })
        };
        let entries = entries
            .iter()
            .enumerate()
            .map(exact)
            .collect::<Result<_, _>>()?;
        Matrix::new(rows, columns, entries)
    }

    /// Returns the entries rounded to `bits` bits.
    pub fn balls(&self, bits: u32) -> Matrix<Ball> {
        self.map(|q| Ball::rational(bits, q))
    }

    /// Checks that every two entries that mirror each other are equal.
    pub(super) fn check_symmetric(&self) -> Result<usize, LinearError> {
        let n = self.check_square()?;
        for row in 0..n {
            if let Some(column) = (0..row).find(|&j| self.at(row, j) != self.at(j, row)) {
                return Err(LinearError::NotSymmetric { row, column });
            }
        }
        Ok(n)
    }

    /// Computes `A v` exactly.
    pub(super) fn times(&self, v: &[Rational]) -> Vec<Rational> {
        (0..self.rows).map(|i| inner(self.row(i), v)).collect()
    }
}

impl Matrix<Ball> {
    /// Checks that every ball is bounded.
    pub(super) fn check_finite(&self) -> Result<(), LinearError> {
        match self.entries.iter().position(|x| !x.is_finite()) {
            None => Ok(()),
            Some(k) => Err(LinearError::NotFinite {
                row: k / self.columns,
                column: k % self.columns,
            }),
        }
    }
}

/// Computes `Σ a_i b_i` exactly.
pub(super) fn inner(a: &[Rational], b: &[Rational]) -> Rational {
    let pairs = a.iter().zip(b).filter(|(a, b)| **a != 0 && **b != 0);
    pairs.map(|(a, b)| Rational::from(a * b)).sum()
}

pub(super) fn check_length(
    name: &'static str,
    found: usize,
    due: usize,
) -> Result<(), LinearError> {
    match found == due {
        true => Ok(()),
        false => Err(LinearError::Length { name, found, due }),
    }
}

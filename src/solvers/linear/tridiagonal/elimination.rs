//! Describes what open and cyclic sweeps share.

use super::error::{TridiagonalError, check_finite, check_length, check_solution};
use super::stability::{Stability, stability};

/// The factors of a tridiagonal matrix, without pivoting: [`Sweep`](super::Sweep) where it is open,
/// [`CyclicSweep`](crate::cyclic_tridiagonal::CyclicSweep) where it is cyclic.
#[derive(Clone, Debug)]
pub struct Elimination<S> {
    pub(crate) lower: Vec<f64>,
    pub(crate) pivot: Vec<f64>,
    /// The quotients `λ_i` by which the next unknown enters.
    pub(crate) lambda: Vec<f64>,
    pub(crate) row_sums: Vec<f64>,
    pub(crate) norm_1: f64,
    pub(crate) growth: f64,
    pub(crate) dominant: bool,
    pub(crate) shape: S,
}

/// Right-hand sides that are solved for side by side: their chains of operations do not wait for
/// each other.
pub(crate) const SEVERAL: usize = 8;

/// Row by row what lies column by column.
pub(crate) fn gather(columns: &[f64], rows: &mut [[f64; SEVERAL]]) {
    let n = rows.len();
    for (k, column) in columns.chunks_exact(n).enumerate() {
        for (row, x) in rows.iter_mut().zip(column) {
            row[k] = *x;
        }
    }
}

/// The reverse of it.
pub(crate) fn scatter(rows: &[[f64; SEVERAL]], columns: &mut [f64]) {
    let n = rows.len();
    for (k, column) in columns.chunks_exact_mut(n).enumerate() {
        for (row, x) in rows.iter().zip(column) {
            *x = row[k];
        }
    }
}

/// How the matrix is closed.
pub trait Shape: Sized {
    /// Solves with the matrix in place.
    #[doc(hidden)]
    fn run(s: &Elimination<Self>, d: &mut [f64]);
    /// Solves for [`SEVERAL`] right-hand sides that lie one after the other; `rows` has room for as
    /// many rows as the matrix has. The solutions have the bits of single ones.
    #[doc(hidden)]
    fn run_several(s: &Elimination<Self>, d: &mut [f64], _rows: &mut [[f64; SEVERAL]]) {
        for column in d.chunks_exact_mut(s.n()) {
            Self::run(s, column);
        }
    }
    /// Solves with the transposed matrix in place.
    #[doc(hidden)]
    fn run_transposed(s: &Elimination<Self>, d: &mut [f64]);
}

impl<S: Shape> Elimination<S> {
    /// The number of unknowns.
    pub fn n(&self) -> usize {
        self.pivot.len()
    }

    /// Returns whether the matrix is diagonally dominant by rows or by columns.
    pub fn is_dominant(&self) -> bool {
        self.dominant
    }

    /// Solves for one right-hand side.
    ///
    /// # Errors
    /// A wrong length, an entry that is not finite, an overflow.
    pub fn solve(&self, d: &[f64]) -> Result<Vec<f64>, TridiagonalError> {
        let mut x = d.to_vec();
        self.solve_in_place(&mut x)?;
        Ok(x)
    }

    /// Solves for one right-hand side, which the solution replaces. After an error the content of
    /// `d` is unspecified.
    ///
    /// # Errors
    /// As [`Elimination::solve`].
    pub fn solve_in_place(&self, d: &mut [f64]) -> Result<(), TridiagonalError> {
        check_length("right-hand side", d, self.n())?;
        check_finite("right-hand side", d)?;
        S::run(self, d);
        check_solution(d)
    }

    /// Solves for several right-hand sides that lie one after the other, `n` entries each; eight at
    /// a time where there are as many. The solutions have the bits of single ones.
    ///
    /// # Errors
    /// As [`Elimination::solve`]; the length has to be a multiple of `n`. An overflow names the
    /// place in the whole slice.
    pub fn solve_many_in_place(&self, d: &mut [f64]) -> Result<(), TridiagonalError> {
        let n = self.n();
        check_length("right-hand sides", d, d.len().div_ceil(n) * n)?;
        check_finite("right-hand sides", d)?;
        let mut groups = d.chunks_exact_mut(n * SEVERAL);
        if groups.len() > 0 {
            let mut rows = vec![[0.0; SEVERAL]; n];
            for group in groups.by_ref() {
                S::run_several(self, group, &mut rows);
            }
        }
        for column in groups.into_remainder().chunks_exact_mut(n) {
            S::run(self, column);
        }
        check_solution(d)
    }

    /// Returns the error bound and condition of solutions; costs up to a dozen and a half solves.
    pub fn stability(&self) -> Stability {
        stability(
            self.growth,
            self.dominant,
            self.norm_1,
            &self.row_sums,
            |v| S::run(self, v),
            |v| S::run_transposed(self, v),
        )
    }
}

//! Small dense systems, row by row in one piece of memory that is used again.

use std::ops::{Index, IndexMut};

/// A matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Matrix {
    columns: usize,
    values: Vec<f64>,
}

impl Matrix {
    pub(super) fn new(rows: usize, columns: usize) -> Matrix {
        Matrix {
            columns,
            values: vec![0.0; rows * columns],
        }
    }

    /// All values zero.
    pub(super) fn clear(&mut self) {
        self.values.fill(0.0);
    }

    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..][..self.columns]
    }
}

impl Index<(usize, usize)> for Matrix {
    type Output = f64;
    fn index(&self, (row, column): (usize, usize)) -> &f64 {
        &self.values[row * self.columns + column]
    }
}

impl IndexMut<(usize, usize)> for Matrix {
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut f64 {
        &mut self.values[row * self.columns + column]
    }
}

/// `P A = L U` of the leading square part of a matrix.
#[derive(Clone, Debug, Default)]
pub(super) struct Factors {
    n: usize,
    lu: Vec<f64>,
    /// Where each row comes from.
    rows: Vec<usize>,
    odd: bool,
}

impl Factors {
    /// Factors the columns and rows in the range given; `false` if a pivot is zero or not finite.
    pub(super) fn of(&mut self, a: &Matrix, rows: usize, first_column: usize) -> bool {
        let n = rows;
        self.n = n;
        self.odd = false;
        self.lu.clear();
        for r in 0..n {
            self.lu
                .extend_from_slice(&a.row(r)[first_column..first_column + n]);
        }
        self.rows.clear();
        self.rows.extend(0..n);
        let lu = &mut self.lu;
        for k in 0..n {
            let mut pivot = k;
            for r in k + 1..n {
                if lu[r * n + k].abs() > lu[pivot * n + k].abs() {
                    pivot = r;
                }
            }
            if pivot != k {
                for c in 0..n {
                    lu.swap(k * n + c, pivot * n + c);
                }
                self.rows.swap(k, pivot);
                self.odd = !self.odd;
            }
            let d = lu[k * n + k];
            if d == 0.0 || !d.is_finite() {
                return false;
            }
            let (upper, lower) = lu.split_at_mut((k + 1) * n);
            let source = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                let m = row[k] / d;
                row[k] = m;
                if m != 0.0 {
                    for c in k + 1..n {
                        row[c] -= m * source[c];
                    }
                }
            }
        }
        true
    }

    /// Solves `A x = b`.
    pub(super) fn solve(&self, b: impl Fn(usize) -> f64, x: &mut [f64]) {
        let (n, lu) = (self.n, &self.lu);
        for r in 0..n {
            let mut sum = b(self.rows[r]);
            for c in 0..r {
                sum -= lu[r * n + c] * x[c];
            }
            x[r] = sum;
        }
        for r in (0..n).rev() {
            let mut sum = x[r];
            for c in r + 1..n {
                sum -= lu[r * n + c] * x[c];
            }
            x[r] = sum / lu[r * n + r];
        }
    }

    /// Solves `Aᵀ y = b`.
    pub(super) fn solve_transposed(&self, b: &[f64], y: &mut [f64]) {
        let (n, lu) = (self.n, &self.lu);
        let mut z = b.to_vec();
        for r in 0..n {
            let mut sum = z[r];
            for c in 0..r {
                sum -= lu[c * n + r] * z[c];
            }
            z[r] = sum / lu[r * n + r];
        }
        for r in (0..n).rev() {
            let mut sum = z[r];
            for c in r + 1..n {
                sum -= lu[c * n + r] * z[c];
            }
            z[r] = sum;
        }
        for r in 0..n {
            y[self.rows[r]] = z[r];
        }
    }

    /// The determinant.
    pub(super) fn determinant(&self) -> f64 {
        let sign = if self.odd { -1.0 } else { 1.0 };
        (0..self.n)
            .map(|k| self.lu[k * self.n + k])
            .product::<f64>()
            * sign
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solutions_of_both_systems() {
        let mut a = Matrix::new(3, 4);
        for (k, v) in [0.0, 2.0, 1.0, 9.0, 1.0, -1.0, 3.0, 9.0, 4.0, 0.5, 0.0, 9.0]
            .iter()
            .enumerate()
        {
            a[(k / 4, k % 4)] = *v;
        }
        let mut f = Factors::default();
        assert!(f.of(&a, 3, 0));
        // By the rule of Sarrus.
        approx::assert_relative_eq!(f.determinant(), 28.5, max_relative = 1e-15);
        let due = [1.0, -2.0, 0.5];
        let times = |r: usize| (0..3).map(|c| a[(r, c)] * due[c]).sum::<f64>();
        let mut x = [0.0; 3];
        f.solve(times, &mut x);
        let transposed: Vec<f64> = (0..3)
            .map(|c| (0..3).map(|r| a[(r, c)] * due[r]).sum())
            .collect();
        let mut y = [0.0; 3];
        f.solve_transposed(&transposed, &mut y);
        for k in 0..3 {
            assert!((x[k] - due[k]).abs() < 1e-15 && (y[k] - due[k]).abs() < 1e-15);
        }
        a[(0, 1)] = 0.0;
        a[(0, 2)] = 0.0;
        assert!(!f.of(&a, 3, 0));
    }
}

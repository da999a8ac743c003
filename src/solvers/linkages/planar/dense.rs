//! Small dense systems, row by row in one piece of memory that is used again.

use std::ops::{Index, IndexMut, Range};

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

    /// A row and the next.
    pub(super) fn pair(&mut self, row: usize) -> (&mut [f64], &mut [f64]) {
        let both = &mut self.values[row * self.columns..][..2 * self.columns];
        both.split_at_mut(self.columns)
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

/// A block lower triangular matrix with `P A = L U` of each block on its diagonal; the rest of a
/// block's rows is kept as it is.
///
/// A block's part of a solution depends on its own rows and those before it alone, so that large
/// numbers in later groups of a mechanism leave no rounding errors in earlier ones, which
/// elimination with pivots from all rows would.
#[derive(Clone, Debug, Default)]
pub(super) struct Factors {
    n: usize,
    lu: Vec<f64>,
    /// Reciprocals of the pivots: a product for a quotient, where each waits for the one before.
    over: Vec<f64>,
    /// Where each row comes from.
    rows: Vec<usize>,
    /// The rows and columns of each block, all in turn.
    blocks: Vec<Range<usize>>,
    odd: bool,
    /// The smallest and the largest pivot.
    pivots: [f64; 2],
}

/// Solutions are corrected where pivots differ by more than this factor.
const UNEVEN: f64 = 16.0;

impl Factors {
    /// Factors the first rows of a matrix, a square from `first_column` on, as one block; `false`
    /// if a pivot is zero or not finite.
    pub(super) fn of(&mut self, a: &Matrix, rows: usize, first_column: usize) -> bool {
        self.of_blocks(a, first_column, std::iter::once(0..rows))
    }

    /// [`Factors::of`] of a block lower triangular matrix: what stands to the right of a block is
    /// not looked at.
    pub(super) fn of_blocks(
        &mut self,
        a: &Matrix,
        first_column: usize,
        blocks: impl Iterator<Item = Range<usize>>,
    ) -> bool {
        self.begin(blocks);
        let columns = first_column..first_column + self.n;
        for r in 0..self.n {
            self.lu.extend_from_slice(&a.row(r)[columns.clone()]);
        }
        self.eliminated()
    }

    /// [`Factors::of`] of these columns, as many as rows.
    pub(super) fn of_columns(&mut self, a: &Matrix, columns: &[usize]) -> bool {
        self.begin(std::iter::once(0..columns.len()));
        let lines = a.values.chunks_exact(a.columns).take(columns.len());
        for row in lines {
            self.lu.extend(columns.iter().map(|c| row[*c]));
        }
        self.eliminated()
    }

    fn begin(&mut self, blocks: impl Iterator<Item = Range<usize>>) {
        self.blocks.clear();
        self.blocks.extend(blocks.filter(|b| !b.is_empty()));
        let n = self.blocks.last().map_or(0, |b| b.end);
        self.n = n;
        self.odd = false;
        self.pivots = [f64::INFINITY, 0.0];
        self.lu.clear();
        self.lu.reserve_exact(n * n);
        self.over.reserve_exact(n);
        self.over.clear();
        self.rows.clear();
        self.rows.extend(0..n);
    }

    /// Factors the blocks; `false` if a pivot is zero or not finite.
    fn eliminated(&mut self) -> bool {
        // Sizes of dyads and triads by loops that the compiler unrolls.
        (0..self.blocks.len()).all(|k| {
            let block = self.blocks[k].clone();
            match block.len() {
                2 => self.eliminate::<2>(block.start),
                4 => self.eliminate::<4>(block.start),
                _ => self.eliminate_any(block),
            }
        })
    }

    /// Notes a pivot; its reciprocal, if there is one.
    #[inline(always)]
    fn pivot(&mut self, d: f64) -> Option<f64> {
        let over = 1.0 / d;
        self.over.push(over);
        self.pivots = [self.pivots[0].min(d.abs()), self.pivots[1].max(d.abs())];
        (over.is_finite() && over != 0.0).then_some(over)
    }

    /// Factors the block of N rows that starts at `from`.
    #[inline(always)]
    fn eliminate<const N: usize>(&mut self, from: usize) -> bool {
        let n = self.n;
        let place = |r: usize| (from + r) * n + from;
        let mut a: [[f64; N]; N] = std::array::from_fn(|r| {
            let line = &self.lu[place(r)..][..N];
            std::array::from_fn(|c| line[c])
        });
        for k in 0..N {
            let mut pivot = k;
            for r in k + 1..N {
                if a[r][k].abs() > a[pivot][k].abs() {
                    pivot = r;
                }
            }
            if pivot != k {
                a.swap(k, pivot);
                for c in 0..from {
                    self.lu.swap((from + k) * n + c, (from + pivot) * n + c);
                }
                self.rows.swap(from + k, from + pivot);
                self.odd = !self.odd;
            }
            let source = a[k];
            let Some(over) = self.pivot(source[k]) else {
                return false;
            };
            for row in &mut a[k + 1..] {
                let m = row[k] * over;
                for c in k + 1..N {
                    row[c] -= m * source[c];
                }
                row[k] = m;
            }
        }
        for (r, row) in a.iter().enumerate() {
            self.lu[place(r)..][..N].copy_from_slice(row);
        }
        true
    }

    fn eliminate_any(&mut self, block: Range<usize>) -> bool {
        let n = self.n;
        for k in block.clone() {
            let size = |r: usize| self.lu[r * n + k].abs();
            let pivot = (k + 1..block.end).fold(k, |p, r| if size(r) > size(p) { r } else { p });
            if pivot != k {
                for c in 0..block.end {
                    self.lu.swap(k * n + c, pivot * n + c);
                }
                self.rows.swap(k, pivot);
                self.odd = !self.odd;
            }
            let Some(over) = self.pivot(self.lu[k * n + k]) else {
                return false;
            };
            let (upper, lower) = self.lu.split_at_mut((k + 1) * n);
            let source = &upper[k * n..][k + 1..block.end];
            for row in lower.chunks_exact_mut(n).take(block.end - k - 1) {
                let m = row[k] * over;
                row[k] = m;
                if m != 0.0 {
                    for (x, s) in row[k + 1..block.end].iter_mut().zip(source) {
                        *x -= m * s;
                    }
                }
            }
        }
        true
    }

    /// Solves `A x = b`.
    #[inline]
    pub(super) fn solve(&self, b: impl Fn(usize) -> f64, x: &mut [f64]) {
        for block in &self.blocks {
            match block.len() {
                2 => self.solve_block::<2>(block.start, &b, x),
                4 => self.solve_block::<4>(block.start, &b, x),
                _ => self.solve_any(block, &b, x),
            }
        }
    }

    /// The part of the block of N rows that starts at `from`.
    #[inline(always)]
    fn solve_block<const N: usize>(&self, from: usize, b: impl Fn(usize) -> f64, x: &mut [f64]) {
        let n = self.n;
        let (before, own) = x.split_at_mut(from);
        let mut y = [0.0; N];
        let mut upper = [[0.0; N]; N];
        for r in 0..N {
            let line = &self.lu[(from + r) * n..][..from + N];
            let (known, line) = line.split_at(from);
            let known = known.iter().zip(&*before);
            let mut sum = known.fold(b(self.rows[from + r]), |sum, (a, x)| sum - a * x);
            for c in 0..r {
                sum -= line[c] * y[c];
            }
            y[r] = sum;
            upper[r].copy_from_slice(line);
        }
        for r in (0..N).rev() {
            for c in r + 1..N {
                y[r] -= upper[r][c] * y[c];
            }
            y[r] *= self.over[from + r];
        }
        own[..N].copy_from_slice(&y);
    }

    fn solve_any(&self, block: &Range<usize>, b: impl Fn(usize) -> f64, x: &mut [f64]) {
        let n = self.n;
        let (from, end) = (block.start, block.end);
        // With L of the block, and what the blocks before it give.
        for r in from..end {
            let row = &self.lu[r * n..][..r];
            let known = row.iter().zip(&*x);
            x[r] = known.fold(b(self.rows[r]), |sum, (a, x)| sum - a * x);
        }
        for r in (from..end).rev() {
            let row = &self.lu[r * n..][..end];
            let known = row[r + 1..].iter().zip(&x[r + 1..end]);
            let sum = known.fold(x[r], |sum, (a, x)| sum - a * x);
            x[r] = sum * self.over[r];
        }
    }

    /// Solves `A x = b` for the matrix that was factored. Where its pivots are uneven the solution
    /// is corrected once by its residual, which makes it that of a system with every entry of A and
    /// b off by a few units alone, whatever the scales of the rows (Skeel, *Math. Comp.* 35
    /// (1980)). `room` is used for it.
    pub(super) fn solve_closely(
        &self,
        a: &Matrix,
        b: impl Fn(usize) -> f64,
        x: &mut [f64],
        room: &mut Vec<f64>,
    ) {
        self.solve(&b, x);
        if self.are_even() {
            return;
        }
        room.resize(2 * self.n, 0.0);
        let (residual, step) = room.split_at_mut(self.n);
        for block in &self.blocks {
            for &row in &self.rows[block.clone()] {
                let known = a.row(row)[..block.end].iter().zip(&*x);
                residual[row] = known.fold(b(row), |sum, (a, x)| sum - a * x);
            }
        }
        self.solve(|r| residual[r], step);
        x.iter_mut().zip(step).for_each(|(x, d)| *x += *d);
    }

    /// Solves `Aᵀ y = b`.
    pub(super) fn solve_transposed(&self, b: &[f64], y: &mut [f64]) {
        let (n, lu) = (self.n, &self.lu);
        let mut z = b.to_vec();
        for block in self.blocks.iter().rev() {
            let (from, end) = (block.start, block.end);
            for r in from..end {
                let mut sum = z[r];
                for c in from..r {
                    sum -= lu[c * n + r] * z[c];
                }
                z[r] = sum * self.over[r];
            }
            for r in (from..end).rev() {
                let mut sum = z[r];
                for c in r + 1..end {
                    sum -= lu[c * n + r] * z[c];
                }
                z[r] = sum;
            }
            // The contribution of the block to the equations of the columns before it.
            for c in 0..from {
                for r in from..end {
                    z[c] -= lu[r * n + c] * z[r];
                }
            }
        }
        for r in 0..n {
            y[self.rows[r]] = z[r];
        }
    }

    /// [`Factors::solve_closely`] of `Aᵀ y = b`.
    pub(super) fn solve_transposed_closely(&self, a: &Matrix, b: &[f64], y: &mut [f64]) {
        self.solve_transposed(b, y);
        if self.are_even() {
            return;
        }
        let mut residual = b.to_vec();
        for block in &self.blocks {
            for row in block.clone() {
                let entries = residual.iter_mut().zip(a.row(row)).take(block.end);
                entries.for_each(|(sum, a)| *sum -= a * y[row]);
            }
        }
        let mut step = vec![0.0; self.n];
        self.solve_transposed(&residual, &mut step);
        y.iter_mut().zip(step).for_each(|(y, d)| *y += d);
    }

    fn are_even(&self) -> bool {
        self.pivots[1] <= UNEVEN * self.pivots[0]
    }

    /// The determinant.
    pub(super) fn determinant(&self) -> f64 {
        let pivots = (0..self.n).map(|k| self.lu[k * self.n + k]);
        let product: f64 = pivots.product();
        if self.odd { -product } else { product }
    }
}

#[cfg(test)]
mod tests;

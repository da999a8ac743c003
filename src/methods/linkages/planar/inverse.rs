//! The inverse of a small matrix in `f64`, for many vectors that are mostly zero.

/// The inverse of a matrix, by columns.
pub(super) struct Inverse(Vec<Vec<f64>>);

impl Inverse {
    /// Returns the inverse of the matrix with these rows, by Gauss's and Jordan's elimination with
    /// the largest pivots of their columns; none if a pivot is zero.
    pub(super) fn of(mut rows: Vec<Vec<f64>>) -> Option<Inverse> {
        let n = rows.len();
        for (k, row) in rows.iter_mut().enumerate() {
            row.extend((0..n).map(|j| f64::from(u8::from(j == k))));
        }
        for k in 0..n {
            let size = |i: &usize| rows[*i][k].abs();
            let largest = (k..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
            rows.swap(k, largest);
            let pivot = rows[k][k];
            if pivot == 0.0 {
                return None;
            }
            rows[k][k..].iter_mut().for_each(|x| *x /= pivot);
            let pivoted = rows[k].clone();
            for (i, row) in rows.iter_mut().enumerate() {
                if i != k && row[k] != 0.0 {
                    let factor = -row[k];
                    add(&mut row[k..], factor, &pivoted[k..]);
                }
            }
        }
        let column = |j| rows.iter().map(|row| row[j]).collect();
        Some(Inverse((n..2 * n).map(column).collect()))
    }

    /// Returns the product with a vector.
    pub(super) fn times(&self, right: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; right.len()];
        for (column, x) in self.0.iter().zip(right) {
            if *x != 0.0 {
                add(&mut product, *x, column);
            }
        }
        product
    }

    /// Returns the absolute values of the entries.
    pub(super) fn abs(&self) -> Inverse {
        let column = |column: &Vec<f64>| column.iter().map(|x| x.abs()).collect();
        Inverse(self.0.iter().map(column).collect())
    }
}

/// Adds a multiple of a vector to another.
pub(super) fn add(to: &mut [f64], factor: f64, vector: &[f64]) {
    for (to, x) in to.iter_mut().zip(vector) {
        *to += factor * x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_by_its_inverse_is_one() {
        // Without an exchange of rows the first pivot would be zero.
        let rows = [[0.0, 2.0, 1.0], [4.0, 1.0, -1.0], [-2.0, 3.0, 0.5]];
        let inverse = Inverse::of(rows.map(Vec::from).to_vec()).unwrap();
        for (k, row) in rows.iter().enumerate() {
            let unit: Vec<f64> = (0..3).map(|j| f64::from(u8::from(j == k))).collect();
            let column = inverse.times(&unit);
            for (i, other) in rows.iter().enumerate() {
                let product: f64 = other.iter().zip(&column).map(|(a, b)| a * b).sum();
                assert!((product - unit[i]).abs() < 1e-15, "{row:?} {product}");
            }
            let sizes: Vec<f64> = column.iter().map(|x| x.abs()).collect();
            assert_eq!(inverse.abs().times(&unit), sizes);
        }
    }

    #[test]
    fn a_singular_matrix_has_none() {
        assert!(Inverse::of(vec![vec![1.0, 2.0], vec![2.0, 4.0]]).is_none());
        assert!(Inverse::of(vec![vec![0.0]]).is_none());
    }
}

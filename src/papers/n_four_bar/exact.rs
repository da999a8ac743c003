//! Matrices of fractions: rank and solution by elimination.

use rug::Rational;

/// Rows of equal length.
pub(super) type Matrix = Vec<Vec<Rational>>;

/// Brings a matrix to echelon form over its first `columns`; the columns with a pivot.
fn eliminate(m: &mut Matrix, columns: usize) -> Vec<usize> {
    let mut pivots = Vec::new();
    for c in 0..columns {
        let r = pivots.len();
        let Some(p) = (r..m.len()).find(|&i| m[i][c] != 0) else {
            continue;
        };
        m.swap(r, p);
        let (above, below) = m.split_at_mut(r + 1);
        let pivot = &above[r];
        for row in below.iter_mut().filter(|row| row[c] != 0) {
            let factor = Rational::from(&row[c] / &pivot[c]);
            for (x, y) in row.iter_mut().zip(pivot).skip(c).filter(|(_, y)| **y != 0) {
                *x -= Rational::from(&factor * y);
            }
        }
        pivots.push(c);
    }
    pivots
}

/// The rank.
pub(super) fn rank(mut m: Matrix) -> usize {
    let columns = m.first().map_or(0, Vec::len);
    eliminate(&mut m, columns).len()
}

/// The solution of `A x = b` for the rows `[A b]`; none unless there is exactly one.
pub(super) fn solve(mut m: Matrix) -> Option<Vec<Rational>> {
    let n = m.first()?.len() - 1;
    if m.len() != n || eliminate(&mut m, n).len() < n {
        return None;
    }
    let mut x = vec![Rational::new(); n];
    for i in (0..n).rev() {
        let known = (i + 1..n).map(|k| Rational::from(&m[i][k] * &x[k]));
        let known: Rational = known.sum();
        x[i] = Rational::from(&m[i][n] - &known) / &m[i][i];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix<const C: usize>(rows: &[[i32; C]]) -> Matrix {
        let row = |r: &[i32; C]| r.iter().map(|x| Rational::from(*x)).collect();
        rows.iter().map(row).collect()
    }

    #[test]
    fn ranks_and_solutions_are_exact() {
        assert_eq!(rank(matrix(&[[1, 2, 3], [2, 4, 6], [0, 0, 5]])), 2);
        assert_eq!(rank(matrix(&[[0, 0], [0, 0]])), 0);
        assert_eq!(rank(matrix(&[[0, 1], [3, 0], [3, 1]])), 2);
        let x = solve(matrix(&[[0, 2, 1], [3, 1, 1]])).unwrap();
        assert_eq!(x, [Rational::from((1, 6)), Rational::from((1, 2))]);
        assert!(solve(matrix(&[[1, 2, 1], [2, 4, 2]])).is_none());
    }

    #[test]
    fn only_square_systems_of_full_rank_are_solved() {
        assert!(solve(matrix(&[[1, 2, 1]])).is_none());
        assert!(solve(matrix(&[[1, 1], [2, 2]])).is_none());
        assert!(solve(Vec::new()).is_none());
        let x = solve(matrix(&[[2, 1, 1, 9], [4, 1, 2, 17], [1, 3, 5, 16]])).unwrap();
        assert_eq!(x, [3, 1, 2]);
        assert_eq!(
            rank(matrix(&[[1, 2, 3], [4, 5, 6], [7, 8, 9], [1, 1, 1]])),
            2
        );
        assert_eq!(rank(matrix(&[[0, 0, 1], [0, 2, 1], [3, 1, 1]])), 3);
        assert_eq!(rank(Vec::new()), 0);
    }
}

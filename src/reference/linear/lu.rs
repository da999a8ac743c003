//! Linear systems of balls.

use crate::ball::Ball;
use std::cmp::Ordering;

/// An LU factorisation of a square matrix of balls.
///
/// Gaussian elimination in ball arithmetic: the factors contain the exact factors of every matrix
/// in the ball matrix, provided no pivot contains zero, which is checked.
#[derive(Clone, Debug)]
pub struct BallLu {
    lu: Vec<Vec<Ball>>,
    order: Vec<usize>,
}

impl BallLu {
    /// Factors `a`; `None` if a pivot cannot be told from zero.
    pub fn new(mut a: Vec<Vec<Ball>>) -> Option<BallLu> {
        let n = a.len();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let best = (k..n).max_by(|&i, &j| {
                let m = |r: usize| a[r][k].mignitude();
                m(i).partial_cmp(&m(j)).unwrap_or(Ordering::Equal)
            })?;
            a.swap(k, best);
            order.swap(k, best);
            if a[k][k].mignitude().is_zero() {
                return None;
            }
            for i in k + 1..n {
                if a[i][k].is_zero() {
                    continue;
                }
                let f = &a[i][k] / &a[k][k];
                for j in k + 1..n {
                    if !a[k][j].is_zero() {
                        a[i][j] = &a[i][j] - &(&f * &a[k][j]);
                    }
                }
                a[i][k] = f;
            }
        }
        Some(BallLu { lu: a, order })
    }

    /// Solves `A x = b`.
    pub fn solve(&self, b: &[Ball]) -> Vec<Ball> {
        let n = self.lu.len();
        let mut x: Vec<Ball> = self.order.iter().map(|&i| b[i].clone()).collect();
        for i in 0..n {
            for j in (0..i).filter(|&j| !self.lu[i][j].is_zero()) {
                x[i] = &x[i] - &(&self.lu[i][j] * &x[j]);
            }
        }
        for i in (0..n).rev() {
            for j in (i + 1..n).filter(|&j| !self.lu[i][j].is_zero()) {
                x[i] = &x[i] - &(&self.lu[i][j] * &x[j]);
            }
            x[i] = &x[i] / &self.lu[i][i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn hilbert_matrix() {
        // x = (1, 2, …) with an ill-conditioned matrix: contained, and sharp enough to be useful.
        let n = 6;
        let q = |i: usize, j: usize| Rational::from((1, (i + j + 1) as u32));
        let a = (0..n)
            .map(|i| (0..n).map(|j| Ball::rational(200, &q(i, j))).collect())
            .collect();
        let b: Vec<Ball> = (0..n)
            .map(|i| {
                Ball::rational(
                    200,
                    &(0..n).map(|j| q(i, j) * (j as u32 + 1)).sum::<Rational>(),
                )
            })
            .collect();
        let found = BallLu::new(a).unwrap().solve(&b);
        assert_eq!(found.len(), n);
        for (x, due) in found.iter().zip(1u32..) {
            assert!(x.contains(&Rational::from(due)));
            assert!(x.accuracy_bits() > 150);
        }
    }

    #[test]
    fn singular_is_not_decided() {
        let one = || Ball::integer(64, 1);
        assert!(BallLu::new(vec![vec![one(), one()], vec![one(), one()]]).is_none());
    }
}

//! Cyclic tridiagonal systems that are too long for exact arithmetic: elimination in balls.

use crate::{Ball, BallLu};
use rug::Rational;

/// Rows of the longest ring: its factors are held as a square of balls.
const ROWS: usize = 2000;

/// Bits of working precision that are tried first, and the largest number of them.
const FIRST: u32 = 256;
const LAST: u32 = 4096;

/// The matrix as a square of balls; entries that fall on one place are added.
fn square(bits: u32, [lower, diagonal, upper]: [&[Rational]; 3]) -> Vec<Vec<Ball>> {
    let n = diagonal.len();
    let mut rows = vec![vec![Ball::integer(bits, 0); n]; n];
    for (i, row) in rows.iter_mut().enumerate() {
        for (j, entry) in [
            ((i + n - 1) % n, &lower[i]),
            (i, &diagonal[i]),
            ((i + 1) % n, &upper[i]),
        ] {
            row[j] = &row[j] + Ball::rational(bits, entry);
        }
    }
    rows
}

fn are_known(values: &[Ball], bits: u32) -> bool {
    values
        .iter()
        .all(|x| x.is_zero() || x.accuracy_bits() >= i64::from(bits))
}

/// Returns the result of `found` from the factors, at the first working precision at which it is
/// known to `bits` bits, or what is known at the last; nothing where the ring is too long or the
/// matrix may be singular.
fn known(
    matrix: [&[Rational]; 3],
    bits: u32,
    found: impl Fn(u32, &BallLu) -> Vec<Ball>,
) -> Option<Vec<Ball>> {
    if matrix[1].len() > ROWS {
        return None;
    }
    let mut best = None;
    let mut working = FIRST.max(2 * bits);
    while working <= LAST.max(2 * bits) {
        if let Some(factors) = BallLu::new(square(working, matrix)) {
            let values = found(working, &factors);
            let done = are_known(&values, bits);
            best = Some(values);
            if done {
                break;
            }
        }
        working *= 2;
    }
    best
}

/// The solution to `bits` bits, or what is known of it.
pub(super) fn solve(matrix: [&[Rational]; 3], d: &[Rational], bits: u32) -> Option<Vec<Ball>> {
    known(matrix, bits, |working, factors| {
        let d: Vec<Ball> = d.iter().map(|q| Ball::rational(working, q)).collect();
        factors.solve(&d)
    })
}

/// `|A⁻¹| (|A| |x| + |d|)`, from the columns of the inverse.
pub(super) fn conditions(matrix: [&[Rational]; 3], d: &[Rational]) -> Option<Vec<Ball>> {
    let [lower, diagonal, upper] = matrix;
    let n = diagonal.len();
    known(matrix, 40, |working, factors| {
        let ball = |q: &Rational| Ball::rational(working, q);
        let right: Vec<Ball> = d.iter().map(ball).collect();
        let x = factors.solve(&right);
        let term = |a: &Rational, x: &Ball| (ball(a) * x).abs();
        let mut sums = vec![Ball::integer(working, 0); n];
        for j in 0..n {
            let size = term(&lower[j], &x[(j + n - 1) % n])
                + term(&diagonal[j], &x[j])
                + term(&upper[j], &x[(j + 1) % n])
                + right[j].abs();
            let mut unit = vec![Ball::integer(working, 0); n];
            unit[j] = Ball::integer(working, 1);
            let column = factors.solve(&unit);
            for (sum, entry) in sums.iter_mut().zip(&column) {
                *sum = &*sum + entry.abs() * &size;
            }
        }
        sums
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tridiagonal::{inverse_cyclic, solve_cyclic};

    /// Balls hold what elimination in fractions gives.
    #[test]
    fn rings_are_enclosed() {
        let n = 12;
        let q = |f: fn(i32) -> i32| {
            (0..n)
                .map(|i| Rational::from((f(i), 7)))
                .collect::<Vec<_>>()
        };
        let (l, b, u, d) = (
            q(|i| i % 3 - 1),
            q(|i| 20 - i),
            q(|i| 2 - i % 5),
            q(|i| i * i - 9),
        );
        let x = solve_cyclic(&l, &b, &u, &d).unwrap();
        let found = solve([&l, &b, &u], &d, 100).unwrap();
        assert!(
            found
                .iter()
                .zip(&x)
                .all(|(f, x)| f.contains(x) && f.accuracy_bits() >= 100)
        );
        let rows = inverse_cyclic(&l, &b, &u).unwrap();
        let n = x.len();
        let size = |j: usize| {
            [(&l, (j + n - 1) % n), (&b, j), (&u, (j + 1) % n)]
                .iter()
                .map(|(a, k)| Rational::from(&a[j] * &x[*k]).abs())
                .sum::<Rational>()
                + d[j].clone().abs()
        };
        let found = conditions([&l, &b, &u], &d).unwrap();
        for (row, found) in rows.iter().zip(&found) {
            let terms = row
                .iter()
                .enumerate()
                .map(|(j, a)| a.clone().abs() * size(j));
            assert!(found.contains(&terms.sum::<Rational>()));
        }
        // Constants are in the kernel of this one, and no ring is longer than there is room for.
        let (off, on) = (vec![Rational::from(-1); 5], vec![Rational::from(2); 5]);
        assert!(solve([&off, &on, &off], &on, 64).is_none());
        let long = vec![Rational::from(1); ROWS + 1];
        assert!(solve([&long, &long, &long], &long, 64).is_none());
    }
}

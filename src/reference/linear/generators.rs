//! Tridiagonal systems by the generators of the inverse, in O(n) operations.
//!
//! With the leading minors `θ_i` of a tridiagonal matrix of order `n`, the determinants of its
//! first `i` rows and columns, and its trailing minors `φ_i`, those of the rows and columns from
//! `i` on, the entries of the inverse are (Usmani, *Linear Algebra and its Applications* 212/213,
//! 1994)
//!
//! ```text
//! (A⁻¹)_ij = (−1)^{i+j} upper_i … upper_{j−1} θ_i φ_{j+1}/θ_n        i ≤ j
//!            (−1)^{i+j} lower_j … lower_{i−1} θ_j φ_{i+1}/θ_n        i > j
//! ```
//!
//! for rows counted from 0, `θ_0 = φ_n = 1`, where a row's lower entry stands before the diagonal
//! of the next one. This holds for every regular matrix, also where leading minors vanish and
//! elimination without pivoting ends. `A⁻¹ w` is then `θ_i φ_{i+1} w_i`, what comes from the rows
//! before and what comes from the rows after, each of which follows from its neighbour. `|A⁻¹| w`
//! for `w ≥ 0` is the same with magnitudes, as every entry is one product.

use crate::{Ball, Mag};
use rug::{Float, Rational};

/// The arithmetic that minors are computed in: exact, or enclosed.
pub(super) trait Scalar: Clone {
    fn integer(like: &Self, n: i64) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn over(&self, other: &Self) -> Self;
    fn magnitude(&self) -> Self;
    fn opposite(&self) -> Self;
}

impl Scalar for Rational {
    fn integer(_: &Rational, n: i64) -> Rational {
        Rational::from(n)
    }
    fn times(&self, other: &Rational) -> Rational {
        Rational::from(self * other)
    }
    fn plus(&self, other: &Rational) -> Rational {
        Rational::from(self + other)
    }
    fn over(&self, other: &Rational) -> Rational {
        Rational::from(self / other)
    }
    fn magnitude(&self) -> Rational {
        Rational::from(self.abs_ref())
    }
    fn opposite(&self) -> Rational {
        Rational::from(-self)
    }
}

impl Scalar for Ball {
    fn integer(like: &Ball, n: i64) -> Ball {
        Ball::integer(like.prec(), n)
    }
    fn times(&self, other: &Ball) -> Ball {
        self * other
    }
    fn plus(&self, other: &Ball) -> Ball {
        self + other
    }
    fn over(&self, other: &Ball) -> Ball {
        self / other
    }
    fn magnitude(&self) -> Ball {
        self.abs()
    }
    fn opposite(&self) -> Ball {
        -self
    }
}

/// A tridiagonal matrix with its minors.
pub(super) struct Minors<T> {
    lower: Vec<T>,
    diagonal: Vec<T>,
    upper: Vec<T>,
    /// `θ_0` to `θ_n`.
    leading: Vec<T>,
    /// `φ_0` to `φ_n`.
    trailing: Vec<T>,
}

impl<T: Scalar> Minors<T> {
    /// Of a matrix of at least one row, in the precision of `one`; entries may have a lower one.
    pub(super) fn new(one: T, lower: Vec<T>, diagonal: Vec<T>, upper: Vec<T>) -> Minors<T> {
        let n = diagonal.len();
        // One row more, with the entries beside the diagonal at `off`.
        let next = |row: usize, off: usize, minors: &[T]| {
            let last = minors.len() - 1;
            let straight = diagonal[row].times(&minors[last]);
            if last == 0 {
                return straight;
            }
            let across = lower[off].times(&upper[off].times(&minors[last - 1]));
            straight.plus(&across.opposite())
        };
        let mut leading = vec![one.clone()];
        for i in 0..n {
            leading.push(next(i, i.saturating_sub(1), &leading));
        }
        let mut trailing = vec![one];
        for i in (0..n).rev() {
            trailing.push(next(i, i, &trailing));
        }
        trailing.reverse();
        Minors {
            lower,
            diagonal,
            upper,
            leading,
            trailing,
        }
    }

    /// `θ_n`.
    pub(super) fn determinant(&self) -> &T {
        &self.leading[self.diagonal.len()]
    }

    /// Returns true if a leading minor of an order less than `n` has the property.
    pub(super) fn any_leading(&self, has: impl Fn(&T) -> bool) -> bool {
        self.leading[1..self.diagonal.len()].iter().any(has)
    }

    /// `A⁻¹ w`.
    pub(super) fn solve(&self, w: &[T]) -> Vec<T> {
        self.through(w, T::clone, T::opposite)
    }

    /// `|A⁻¹| w` for `w ≥ 0`.
    pub(super) fn solve_magnitudes(&self, w: &[T]) -> Vec<T> {
        self.through(w, T::magnitude, T::magnitude)
    }

    /// `|A| |x| + |d|`.
    pub(super) fn sums(&self, x: &[T], d: &[T]) -> Vec<T> {
        let n = x.len();
        let term = |a: &T, x: &T| a.times(x).magnitude();
        let row = |i: usize| {
            let mut sum = term(&self.diagonal[i], &x[i]).plus(&d[i].magnitude());
            if i > 0 {
                sum = sum.plus(&term(&self.lower[i - 1], &x[i - 1]));
            }
            if i + 1 < n {
                sum = sum.plus(&term(&self.upper[i], &x[i + 1]));
            }
            sum
        };
        (0..n).map(row).collect()
    }

    /// The sums of `(A⁻¹)_ij w_j` with factors that have gone through `minor`, and `off` beside
    /// the diagonal.
    fn through(&self, w: &[T], minor: fn(&T) -> T, off: fn(&T) -> T) -> Vec<T> {
        let n = w.len();
        let (theta, phi) = (
            |i: usize| minor(&self.leading[i]),
            |i: usize| minor(&self.trailing[i]),
        );
        let determinant = minor(self.determinant());
        // Of the rows after each: Σ_j (−1)^{i+j} upper_i … upper_{j−1} φ_{j+1} w_j.
        let mut after = vec![T::integer(&determinant, 0)];
        for i in (0..n - 1).rev() {
            let next = &after[after.len() - 1];
            let sum = next.plus(&phi(i + 2).times(&w[i + 1]));
            after.push(off(&self.upper[i]).times(&sum));
        }
        after.reverse();
        let mut before = T::integer(&determinant, 0);
        let mut all = Vec::with_capacity(n);
        for (i, after) in after.iter().enumerate() {
            if i > 0 {
                let sum = before.plus(&theta(i - 1).times(&w[i - 1]));
                before = off(&self.lower[i - 1]).times(&sum);
            }
            let (theta, phi) = (theta(i), phi(i + 1));
            let here = theta.times(&phi.times(&w[i]).plus(after));
            let sum = here.plus(&phi.times(&before));
            all.push(sum.over(&determinant));
        }
        all
    }
}

/// Bits of working precision that are tried first, and the largest number of them: of a dominant
/// matrix at most 1.3 bits are lost in a row (a ball's relative radius grows by `1 + √2` where the
/// minors do not grow), so that 2·10⁴ rows are decided.
const FIRST: u32 = 512;
const LAST: u32 = 1 << 15;

/// Returns true if all are known to `2^-bits` of their size.
fn are_known(values: &[Ball], bits: u32) -> bool {
    let is_known = |x: &Ball| x.is_finite() && x.rad() <= x.mignitude().shift(-i64::from(bits));
    values.iter().all(is_known)
}

/// The matrix and a right-hand side at a working precision; entries that are floating-point
/// numbers in 53 bits, by which products take no time.
fn at(bits: u32, [lower, diagonal, upper, d]: [&[Rational]; 4]) -> (Minors<Ball>, Vec<Ball>) {
    let ball = |q: &Rational| {
        let short = Float::with_val(53, q);
        match short == *q {
            true => Ball::new(short, Mag::ZERO),
            false => Ball::rational(bits, q),
        }
    };
    let balls = |v: &[Rational]| v.iter().map(ball).collect();
    let one = Ball::new(Float::with_val(bits, 1), Mag::ZERO);
    let minors = Minors::new(one, balls(lower), balls(diagonal), balls(upper));
    (minors, balls(d))
}

/// The solution with a relative accuracy of `2^-bits`, or what is known of it at the largest
/// working precision; `None` where the determinant could not be told from zero.
pub(super) fn solve(parts: [&[Rational]; 4], bits: u32) -> Option<Vec<Ball>> {
    let mut found = None;
    let mut working = FIRST.max(2 * bits);
    while working <= LAST.max(2 * bits) {
        let (minors, d) = at(working, parts);
        if !minors.determinant().mignitude().is_zero() {
            let x = minors.solve(&d);
            let done = are_known(&x, bits);
            found = Some(x.iter().map(|x| x.with_prec(bits + 32)).collect());
            if done {
                break;
            }
        }
        working *= 2;
    }
    found
}

/// `|A⁻¹| (|A| |x| + |d|)` to 60 bits; `None` if it is undecided.
pub(super) fn conditions(parts: [&[Rational]; 4]) -> Option<Vec<Ball>> {
    let mut working = FIRST;
    while working <= LAST {
        let (minors, d) = at(working, parts);
        if !minors.determinant().mignitude().is_zero() {
            let x = minors.solve(&d);
            let found = minors.solve_magnitudes(&minors.sums(&x, &d));
            if are_known(&found, 60) {
                return Some(found);
            }
        }
        working *= 2;
    }
    None
}

#[cfg(test)]
mod tests;

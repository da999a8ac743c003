//! Exact solutions of sparse linear systems, in particular tridiagonal and cyclic ones.
//!
//! Gaussian elimination in integers: every row is cleared of denominators, eliminated by
//! cross-multiplication and divided by the greatest common divisor of its entries; the pivot of a
//! column is the shortest candidate. Nothing is rounded, so a system without a pivot is singular,
//! and that is an answer.
//!
//! Exact numbers grow with the number of rows: [`solution`] and [`conditions`] compute in balls
//! where a tridiagonal system is long, by a formula that takes O(n) operations.

use super::generators::{self, Minors};
use super::ring;
use crate::Ball;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// One equation: the coefficients by column, and its right-hand sides.
pub type Equation = (BTreeMap<usize, Rational>, Vec<Rational>);

struct IntegerRow {
    entries: BTreeMap<usize, Integer>,
    rhs: Vec<Integer>,
}

impl IntegerRow {
    fn new((entries, rhs): Equation) -> IntegerRow {
        let mut lcm = Integer::from(1);
        for q in entries.values().chain(&rhs) {
            lcm.lcm_mut(q.denom());
        }
        let clear = |q: &Rational| -> Integer {
            let factor = Integer::from(lcm.div_exact_ref(q.denom()));
            factor * q.numer()
        };
        let mut row = IntegerRow {
            entries: entries
                .iter()
                .filter(|(_, q)| **q != 0)
                .map(|(&j, q)| (j, clear(q)))
                .collect(),
            rhs: rhs.iter().map(clear).collect(),
        };
        row.reduce();
        row
    }

    /// Divides by the content.
    fn reduce(&mut self) {
        let mut gcd = Integer::new();
        for v in self.entries.values().chain(&self.rhs) {
            gcd.gcd_mut(v);
            if gcd == 1 {
                return;
            }
        }
        if gcd > 1 {
            for v in self.entries.values_mut().chain(&mut self.rhs) {
                v.div_exact_mut(&gcd);
            }
        }
    }

    /// Removes `column` with the help of `pivot`, which begins there.
    fn eliminate(&mut self, column: usize, pivot: &IntegerRow) {
        let Some(f) = self.entries.remove(&column) else {
            return;
        };
        let p = &pivot.entries[&column];
        let gcd = Integer::from(f.gcd_ref(p));
        let (f, p) = (f / &gcd, Integer::from(p / &gcd));
        for v in self.entries.values_mut().chain(&mut self.rhs) {
            *v *= &p;
        }
        for (&j, v) in pivot.entries.range(column + 1..) {
            *self.entries.entry(j).or_default() -= Integer::from(v * &f);
        }
        for (a, b) in self.rhs.iter_mut().zip(&pivot.rhs) {
            *a -= Integer::from(b * &f);
        }
        self.entries.retain(|_, v| *v != 0);
        self.reduce();
    }

    fn size(&self) -> (usize, u32) {
        let bits = self.entries.values().map(Integer::significant_bits).sum();
        (self.entries.len(), bits)
    }
}

/// The solution of `n` equations in `n` unknowns for every right-hand side: `x[unknown][side]`.
/// `None` if and only if the matrix is singular.
///
/// # Panics
/// When the numbers of equations, columns and right-hand sides do not fit together.
pub fn solve_sparse(n: usize, equations: Vec<Equation>) -> Option<Vec<Vec<Rational>>> {
    assert_eq!(equations.len(), n, "as many equations as unknowns");
    let sides = equations.first().map_or(0, |e| e.1.len());
    let mut begins: Vec<Vec<IntegerRow>> = (0..n).map(|_| Vec::new()).collect();
    for e in equations {
        assert_eq!(
            e.1.len(),
            sides,
            "as many right-hand sides in every equation"
        );
        let row = IntegerRow::new(e);
        let first = *row.entries.keys().next()?;
        begins[first].push(row);
    }
    let mut pivots = Vec::with_capacity(n);
    for column in 0..n {
        let mut rows = std::mem::take(&mut begins[column]);
        let best = (0..rows.len()).min_by_key(|&i| rows[i].size())?;
        let pivot = rows.swap_remove(best);
        for mut row in rows {
            row.eliminate(column, &pivot);
            let first = *row.entries.keys().next()?;
            begins[first].push(row);
        }
        pivots.push(pivot);
    }
    let mut x: Vec<Vec<Rational>> = vec![Vec::new(); n];
    for column in (0..n).rev() {
        let row = &pivots[column];
        let p = &row.entries[&column];
        let mut rest = row.entries.range(column + 1..);
        let only = rest.next().filter(|_| rest.next().is_none());
        x[column] = (0..sides)
            .map(|k| {
                // One greatest common divisor in place of three.
                if let Some((&j, a)) = only {
                    let (n, d) = (x[j][k].numer(), x[j][k].denom());
                    let above = Integer::from(&row.rhs[k] * d) - a * n;
                    return Rational::from((above, Integer::from(p * d)));
                }
                let mut v = Rational::from(&row.rhs[k]);
                for (&j, a) in row.entries.range(column + 1..) {
                    v -= Rational::from(&x[j][k] * a);
                }
                v / p
            })
            .collect();
    }
    Some(x)
}

/// Entries that fall on one place are added.
pub(crate) fn equation(
    entries: impl IntoIterator<Item = (usize, Rational)>,
    rhs: Vec<Rational>,
) -> Equation {
    let mut row: BTreeMap<usize, Rational> = BTreeMap::new();
    for (j, v) in entries {
        *row.entry(j).or_default() += v;
    }
    (row, rhs)
}

/// The equations of a tridiagonal matrix, with `rhs[i]` the right-hand sides of row `i`.
fn band(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    rhs: Vec<Vec<Rational>>,
) -> Vec<Equation> {
    let n = diagonal.len();
    let row = |(i, rhs): (usize, Vec<Rational>)| {
        let mut e = vec![(i, diagonal[i].clone())];
        if i > 0 {
            e.push((i - 1, lower[i - 1].clone()));
        }
        if i + 1 < n {
            e.push((i + 1, upper[i].clone()));
        }
        equation(e, rhs)
    };
    rhs.into_iter().enumerate().map(row).collect()
}

/// The equations of a cyclic tridiagonal matrix; entries that fall on one place are added.
fn ring(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    rhs: Vec<Vec<Rational>>,
) -> Vec<Equation> {
    let n = diagonal.len();
    let row = |(i, rhs): (usize, Vec<Rational>)| {
        let e = [
            ((i + n - 1) % n, lower[i].clone()),
            (i, diagonal[i].clone()),
            ((i + 1) % n, upper[i].clone()),
        ];
        equation(e, rhs)
    };
    rhs.into_iter().enumerate().map(row).collect()
}

fn single(d: &[Rational]) -> Vec<Vec<Rational>> {
    d.iter().map(|d| vec![d.clone()]).collect()
}

fn identity(n: usize) -> Vec<Vec<Rational>> {
    let row = |i| (0..n).map(|j| Rational::from(u32::from(i == j))).collect();
    (0..n).map(row).collect()
}

/// The exact solution of a tridiagonal system (`lower` and `upper` one shorter than `diagonal`),
/// `None` if it is singular.
///
/// ```
/// use mechaudit_reference::tridiagonal::solve;
/// use rug::Rational;
/// let q = |v: &[i32]| -> Vec<Rational> { v.iter().map(|&v| v.into()).collect() };
/// let x = solve(&q(&[1]), &q(&[0, 1]), &q(&[1]), &q(&[2, 5]));
/// assert_eq!(x, Some(q(&[3, 2])));
/// assert_eq!(solve(&q(&[1]), &q(&[1, 1]), &q(&[1]), &q(&[2, 5])), None);
/// ```
///
/// # Panics
/// When the lengths do not fit.
pub fn solve(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
) -> Option<Vec<Rational>> {
    let x = solve_sparse(diagonal.len(), band(lower, diagonal, upper, single(d)))?;
    Some(x.into_iter().flatten().collect())
}

/// The exact solution of a cyclic system: all slices have `n` entries, `lower[0]` stands in the
/// last column and `upper[n-1]` in the first. `None` if it is singular.
///
/// # Panics
/// When the lengths do not fit.
pub fn solve_cyclic(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
) -> Option<Vec<Rational>> {
    let x = solve_sparse(diagonal.len(), ring(lower, diagonal, upper, single(d)))?;
    Some(x.into_iter().flatten().collect())
}

/// The bits of all entries of a system up to which it is solved exactly: some 70 rows of
/// floating-point numbers.
const EXACT_BITS: u64 = 1 << 15;

fn is_short(parts: [&[Rational]; 4]) -> bool {
    let bits = |q: &Rational| {
        u64::from(q.numer().significant_bits()) + u64::from(q.denom().significant_bits())
    };
    parts
        .iter()
        .flat_map(|part| part.iter())
        .map(bits)
        .sum::<u64>()
        <= EXACT_BITS
}

/// The solution of a tridiagonal system.
#[derive(Clone, Debug)]
pub enum Solution {
    /// The matrix is singular.
    Singular,
    /// The exact solution.
    Exact(Vec<Rational>),
    /// The unknowns enclosed: the system is long.
    Enclosed(Vec<Ball>),
    /// The matrix is long, and its determinant could not be told from zero.
    Open,
}

/// The solution of a tridiagonal system of any length, to a relative accuracy of `2^-bits` where
/// it is not exact.
///
/// ```
/// use mechaudit_reference::tridiagonal::{Solution, solution};
/// use rug::Rational;
/// let (off, on) = (vec![Rational::from(1); 3999], vec![Rational::from(4); 4000]);
/// let d = vec![Rational::from(6); 4000];
/// let Solution::Enclosed(x) = solution(&off, &on, &off, &d, 128) else { unreachable!() };
/// assert!(x[1000].accuracy_bits() >= 128);
/// ```
///
/// # Panics
/// When the lengths do not fit.
pub fn solution(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
    bits: u32,
) -> Solution {
    let parts = [lower, diagonal, upper, d];
    if is_short(parts) {
        return solve(lower, diagonal, upper, d).map_or(Solution::Singular, Solution::Exact);
    }
    generators::solve(parts, bits).map_or(Solution::Open, Solution::Enclosed)
}

fn minors(lower: &[Rational], diagonal: &[Rational], upper: &[Rational]) -> Minors<Rational> {
    let [lower, diagonal, upper] = [lower, diagonal, upper].map(<[Rational]>::to_vec);
    Minors::new(Rational::from(1), lower, diagonal, upper)
}

/// `|A⁻¹| (|A| |x| + |d|)` of a tridiagonal system, entry by entry: the sum over all data of
/// `|datum · ∂x_i/∂datum|`. Computed exactly and rounded once, or in balls to 60 bits where the
/// system is long; `None` where the matrix is singular or no enclosure was found.
///
/// # Panics
/// When the lengths do not fit.
pub fn conditions(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
) -> Option<Vec<f64>> {
    let parts = [lower, diagonal, upper, d];
    if !is_short(parts) {
        let found = generators::conditions(parts)?;
        return Some(found.iter().map(Ball::to_f64).collect());
    }
    if diagonal.is_empty() {
        return None;
    }
    let minors = minors(lower, diagonal, upper);
    if *minors.determinant() == 0 {
        return None;
    }
    let sums = minors.sums(&minors.solve(d), d);
    let found = minors.solve_magnitudes(&sums);
    Some(found.iter().map(Rational::to_f64).collect())
}

/// The solution of a cyclic system, as [`solution`] gives that of an open one; a ring of more than
/// 2000 rows is open.
///
/// # Panics
/// When the lengths do not fit.
pub fn solution_cyclic(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
    bits: u32,
) -> Solution {
    if is_short([lower, diagonal, upper, d]) {
        return solve_cyclic(lower, diagonal, upper, d).map_or(Solution::Singular, Solution::Exact);
    }
    ring::solve([lower, diagonal, upper], d, bits).map_or(Solution::Open, Solution::Enclosed)
}

/// [`conditions`] of a cyclic system.
///
/// # Panics
/// When the lengths do not fit.
pub fn conditions_cyclic(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
    d: &[Rational],
) -> Option<Vec<f64>> {
    let n = diagonal.len();
    if n > 16 {
        let found = ring::conditions([lower, diagonal, upper], d)?;
        return Some(found.iter().map(Ball::to_f64).collect());
    }
    let inverse = inverse_cyclic(lower, diagonal, upper)?;
    let x = solve_cyclic(lower, diagonal, upper, d)?;
    let size = |k: usize| {
        Rational::from(&lower[k] * &x[(k + n - 1) % n]).abs()
            + Rational::from(&diagonal[k] * &x[k]).abs()
            + Rational::from(&upper[k] * &x[(k + 1) % n]).abs()
            + d[k].clone().abs()
    };
    let sizes: Vec<Rational> = (0..n).map(size).collect();
    let sum = |row: &Vec<Rational>| {
        let terms = row
            .iter()
            .zip(&sizes)
            .map(|(a, v)| Rational::from(a * v).abs());
        terms.sum::<Rational>().to_f64()
    };
    Some(inverse.iter().map(sum).collect())
}

/// Returns true if elimination without row exchanges certainly meets a pivot that is exactly zero
/// before the last row, where the matrix may be regular. Only short matrices are searched.
///
/// # Panics
/// When the lengths do not fit.
pub fn has_zero_pivot(lower: &[Rational], diagonal: &[Rational], upper: &[Rational]) -> bool {
    let is_zero = |minor: &Rational| *minor == 0;
    is_short([lower, diagonal, upper, &[]])
        && !diagonal.is_empty()
        && minors(lower, diagonal, upper).any_leading(is_zero)
}

/// The exact inverse of a tridiagonal matrix, by rows; `None` if it is singular.
///
/// # Panics
/// When the lengths do not fit.
pub fn inverse(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
) -> Option<Vec<Vec<Rational>>> {
    let n = diagonal.len();
    solve_sparse(n, band(lower, diagonal, upper, identity(n)))
}

/// The exact inverse of a cyclic matrix, by rows; `None` if it is singular.
///
/// # Panics
/// When the lengths do not fit.
pub fn inverse_cyclic(
    lower: &[Rational],
    diagonal: &[Rational],
    upper: &[Rational],
) -> Option<Vec<Vec<Rational>>> {
    let n = diagonal.len();
    solve_sparse(n, ring(lower, diagonal, upper, identity(n)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn q(v: &[i32]) -> Vec<Rational> {
        v.iter().map(|&v| v.into()).collect()
    }

    /// Rows without denominators and without a common factor, as they come and after an
    /// elimination.
    #[test]
    fn rows_are_whole_and_have_no_common_factor() {
        let row = |entries: &[(usize, (i32, i32))], rhs: (i32, i32)| {
            let entries = entries.iter().map(|&(j, q)| (j, Rational::from(q)));
            IntegerRow::new((entries.collect(), vec![Rational::from(rhs)]))
        };
        let parts = |r: &IntegerRow| {
            let entries = r.entries.iter().map(|(&j, v)| (j, v.to_i32().unwrap()));
            (entries.collect::<Vec<_>>(), r.rhs[0].to_i32().unwrap())
        };
        let integers = row(&[(0, (6, 1)), (2, (0, 1)), (3, (-9, 1))], (12, 1));
        assert_eq!(parts(&integers), (vec![(0, 2), (3, -3)], 4));
        let even = row(&[(0, (4, 1)), (3, (-6, 1))], (8, 1));
        assert_eq!(parts(&even), (vec![(0, 2), (3, -3)], 4));
        let prime = row(&[(1, (4, 1)), (3, (6, 1))], (-9, 1));
        assert_eq!(parts(&prime), (vec![(1, 4), (3, 6)], -9));
        let pivot = row(&[(0, (1, 2)), (3, (1, 3))], (1, 6));
        assert_eq!(parts(&pivot), (vec![(0, 3), (3, 2)], 1));
        // Three times the one less twice the other: −13 in column 3, 10 on the right.
        let mut reduced = row(&[(0, (2, 1)), (3, (-3, 1))], (4, 1));
        reduced.eliminate(0, &pivot);
        assert_eq!(parts(&reduced), (vec![(3, -13)], 10));
        let mut reduced = row(&[(0, (3, 1)), (2, (4, 1)), (3, (8, 1))], (7, 1));
        reduced.eliminate(0, &pivot);
        assert_eq!(parts(&reduced), (vec![(2, 2), (3, 3)], 3));
    }

    /// 2x + y = 1, x + 2y = 3, as it stands and closed to a ring.
    #[test]
    fn small_systems_have_their_solutions() {
        let thirds = |v: &[i32]| v.iter().map(|&v| (v, 3).into()).collect::<Vec<Rational>>();
        let (one, two) = (q(&[1]), q(&[2, 2]));
        assert_eq!(solve(&one, &two, &one, &q(&[1, 3])), Some(thirds(&[-1, 5])));
        let rows = inverse(&one, &two, &one).unwrap();
        assert_eq!(rows, [thirds(&[2, -1]), thirds(&[-1, 2])]);
        // Both neighbours of a row of two are the other one.
        let halves: Vec<Rational> = [(1, 2), (1, 2)].map(Rational::from).to_vec();
        assert_eq!(
            solve_cyclic(&halves, &two, &halves, &q(&[1, 3])),
            Some(thirds(&[-1, 5]))
        );
        assert_eq!(inverse_cyclic(&halves, &two, &halves).unwrap(), rows);
    }

    #[test]
    fn singular_is_an_answer() {
        assert_eq!(
            solve(&q(&[1, 1]), &q(&[1, 1, 0]), &q(&[1, 0]), &q(&[1, 1, 1])),
            None
        );
        assert_eq!(solve(&[], &q(&[0]), &[], &q(&[1])), None);
        let (a, b) = (q(&[-1; 5]), q(&[2; 5]));
        assert_eq!(solve_cyclic(&a, &b, &a, &q(&[1, 0, 0, 0, -1])), None);
        assert!(inverse(&q(&[0]), &q(&[1, 0]), &q(&[0])).is_none());
    }

    proptest! {
        #[test]
        fn solutions_solve(v in prop::collection::vec(-1000i32..1000, 4..48)) {
            let n = v.len() / 4;
            let part = |k: usize| -> Vec<Rational> {
                v[k * n..(k + 1) * n].iter().map(|&v| Rational::from((v, 16))).collect()
            };
            let (l, d, u, r) = (part(0), part(1), part(2), part(3));
            if let Some(x) = solve_cyclic(&l, &d, &u, &r) {
                for i in 0..n {
                    let mut s = Rational::from(&l[i] * &x[(i + n - 1) % n]);
                    s += Rational::from(&d[i] * &x[i]);
                    s += Rational::from(&u[i] * &x[(i + 1) % n]);
                    prop_assert_eq!(&s, &r[i]);
                }
                let inv = inverse_cyclic(&l, &d, &u).unwrap();
                for (row, x) in inv.iter().zip(&x) {
                    let y: Rational = row.iter().zip(&r).map(|(a, b)| Rational::from(a * b)).sum();
                    prop_assert_eq!(&y, x);
                }
            }
            if let Some(x) = solve(&l[1..], &d, &u[..n - 1], &r) {
                for i in 0..n {
                    let mut s = Rational::from(&d[i] * &x[i]);
                    if i > 0 { s += Rational::from(&l[i] * &x[i - 1]); }
                    if i + 1 < n { s += Rational::from(&u[i] * &x[i + 1]); }
                    prop_assert_eq!(&s, &r[i]);
                }
            }
        }
    }
}

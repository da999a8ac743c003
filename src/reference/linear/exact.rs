//! Exact solutions of dense linear systems by lifting modulo powers of a prime.
//!
//! The rows are cleared of denominators and of common factors. With the inverse modulo p, digits
//! of the solution to the base p follow one by one, each by a product with the inverse and an
//! exact residual (Dixon, *Numerische Mathematik* 40 (1982) 137–141), and a fraction is found from
//! its residue by Euclid's algorithm (Wang, *SYMSAC* 1981, 212–217). Neither has to be trusted: a
//! solution `N/d` is returned only after `A N = d b` has been computed exactly, with a matrix whose
//! determinant is a unit modulo p. The condition of the matrix plays no part.

use super::matrix::{LinearError, Matrix, inner};
use super::modular::{self, Rows};
use crate::Undecided;
use rug::{Complete, Integer, Rational};

/// Primes that are tried: a regular matrix of order 500 with entries of 64 bits has less than 700
/// prime divisors of its determinant near 2⁵⁸, so that three of them in a row are a rare chance.
const TRIALS: usize = 4;

/// Bits by which a fraction has to be shorter than its residue before it is tested exactly.
const SPARE: u32 = 32;

/// An integer matrix with the factors of rows and columns that were taken out of it:
/// `integer_ij = row_i · a_ij / column_j`.
pub(super) struct Cleared {
    matrix: Matrix<Integer>,
    row: Vec<Rational>,
    column: Vec<Integer>,
}

/// Solutions with a common denominator.
struct Fractions {
    numerators: Vec<Integer>,
    denominator: Integer,
}

fn content<'a>(values: impl IntoIterator<Item = &'a Integer>) -> Integer {
    let mut gcd = Integer::new();
    for v in values {
        gcd.gcd_mut(v);
        if gcd == 1 {
            break;
        }
    }
    if gcd == 0 { Integer::from(1) } else { gcd }
}

fn common_denominator<'a>(values: impl IntoIterator<Item = &'a Rational>) -> Integer {
    let mut lcm = Integer::from(1);
    for q in values {
        lcm.lcm_mut(q.denom());
    }
    lcm
}

/// Multiplies by an integer that clears the denominator.
fn cleared(q: &Rational, lcm: &Integer) -> Integer {
    lcm.div_exact_ref(q.denom()).complete() * q.numer()
}

fn residue(a: &Integer, p: &Integer) -> u64 {
    a.modulo_ref(p)
        .complete()
        .to_u64()
        .expect("residue of a word")
}

impl Cleared {
    pub(super) fn new(a: &Matrix<Rational>) -> Cleared {
        let mut row = Vec::with_capacity(a.rows());
        let mut entries = Vec::with_capacity(a.entries().len());
        for i in 0..a.rows() {
            let lcm = common_denominator(a.row(i));
            let mut whole: Vec<Integer> = a.row(i).iter().map(|q| cleared(q, &lcm)).collect();
            let gcd = content(&whole);
            whole.iter_mut().for_each(|v| v.div_exact_mut(&gcd));
            row.push(Rational::from((lcm, gcd)));
            entries.extend(whole);
        }
        let n = a.columns();
        let column: Vec<Integer> = (0..n)
            .map(|j| content(entries.iter().skip(j).step_by(n.max(1))))
            .collect();
        for (k, v) in entries.iter_mut().enumerate() {
            v.div_exact_mut(&column[k % n]);
        }
        let matrix = Matrix::new(a.rows(), n, entries).expect("as many entries as before");
        Cleared {
            matrix,
            row,
            column,
        }
    }

    fn modulo(&self, p: u64) -> Rows {
        modulo(&self.matrix, p)
    }

    /// Returns the bits of the longest entry.
    fn bits(&self) -> u32 {
        longest(&self.matrix)
    }

    /// Returns an upper bound on the number of word operations of a solution with `sides` sides,
    /// from Hadamard's bound on the minors.
    pub(super) fn work(&self, sides: usize) -> f64 {
        let n = self.matrix.rows() as f64;
        let bits = f64::from(self.bits()) + n.max(1.0).log2() / 2.0;
        let digits = (2.0 * n * bits / 58.0).max(1.0);
        n * n * n + sides as f64 * digits * n * n * (2.0 + f64::from(self.bits()) / 64.0)
    }
}

fn longest(matrix: &Matrix<Integer>) -> u32 {
    let bits = matrix.entries().iter().map(Integer::significant_bits);
    bits.max().unwrap_or(0)
}

fn modulo(matrix: &Matrix<Integer>, p: u64) -> Rows {
    let m = Integer::from(p);
    let row = |i: usize| matrix.row(i).iter().map(|a| residue(a, &m)).collect();
    (0..matrix.rows()).map(row).collect()
}

/// A regular integer matrix with its inverse modulo p.
struct Lifting<'a> {
    matrix: &'a Matrix<Integer>,
    inverse: Rows,
    p: u64,
}

impl<'a> Lifting<'a> {
    /// None if the matrix is singular modulo each of a few primes.
    fn new(matrix: &'a Matrix<Integer>) -> Option<Lifting<'a>> {
        modular::primes().take(TRIALS).find_map(|p| {
            let inverse = modular::inverse(modulo(matrix, p), p)?;
            Some(Lifting { matrix, inverse, p })
        })
    }

    /// Solves `A x = b`; none would contradict Hadamard's bound.
    fn solve(&self, b: &[Integer]) -> Option<Fractions> {
        let n = self.matrix.rows();
        let p = Integer::from(self.p);
        let length = b.iter().map(Integer::significant_bits).max().unwrap_or(0);
        let size = longest(self.matrix) + n.ilog2() + 1;
        // Numerators and denominators are minors, by Cramer's rule.
        let last = 2 * (u64::from(size) * n as u64 + u64::from(length)) / 57 + 8;
        let mut residual = b.to_vec();
        let mut x = vec![Integer::new(); n];
        let mut power = Integer::from(1);
        let mut next = 2;
        for step in 1..=last {
            let short: Vec<u64> = residual.iter().map(|r| residue(r, &p)).collect();
            let digits: Vec<Integer> = self
                .inverse
                .iter()
                .map(|row| Integer::from(modular::dot(row, &short, self.p)))
                .collect();
            for (i, r) in residual.iter_mut().enumerate() {
                for (a, d) in self.matrix.row(i).iter().zip(&digits) {
                    *r -= a * d;
                }
                r.div_exact_mut(&p);
            }
            for (x, d) in x.iter_mut().zip(&digits) {
                *x += d * &power;
            }
            power *= &p;
            if step == next || step == last {
                // Short in sum, which is soon; or each short, which is the only such solution.
                for is_balanced in [false, true] {
                    if let Some(found) = fractions(&x, &power, is_balanced)
                        && self.is_solution(&found, b)
                    {
                        return Some(found);
                    }
                }
                next += next / 4 + 1;
            }
        }
        None
    }

    /// Checks `A N = d b`, exactly.
    fn is_solution(&self, found: &Fractions, b: &[Integer]) -> bool {
        let equation = |(i, b): (usize, &Integer)| {
            let mut rest = (b * &found.denominator).complete();
            for (a, x) in self.matrix.row(i).iter().zip(&found.numerators) {
                rest -= a * x;
            }
            rest == 0
        };
        found.denominator != 0 && b.iter().enumerate().all(equation)
    }
}

/// Finds fractions with a common denominator from their residues; none if they are too long: in
/// sum, or balanced, which is each of them beside half of the residues' length.
fn fractions(x: &[Integer], power: &Integer, is_balanced: bool) -> Option<Fractions> {
    let length = power.significant_bits();
    let is_short = |n: &Integer, d: &Integer| {
        let (n, d) = (n.significant_bits(), d.significant_bits());
        let due = if is_balanced { 2 * n.max(d) } else { n + d };
        due + SPARE < length
    };
    let half = Integer::from(power >> 1u32);
    let mut denominator = Integer::from(1);
    let mut numerators: Vec<Integer> = Vec::with_capacity(x.len());
    for x in x {
        let mut n = (x * &denominator).complete() % power;
        if n > half {
            n -= power;
        }
        if !is_short(&n, &denominator) {
            let (shorter, factor) = fraction(&n, power);
            denominator *= &factor;
            numerators.iter_mut().for_each(|n| *n *= &factor);
            n = shorter;
            if !is_short(&n, &denominator) {
                return None;
            }
        }
        numerators.push(n);
    }
    Some(Fractions {
        numerators,
        denominator,
    })
}

/// Finds n and d, both near the root of m or shorter, with `n ≡ d x` modulo m.
fn fraction(x: &Integer, m: &Integer) -> (Integer, Integer) {
    let root = m.sqrt_ref().complete();
    let (mut r, mut s) = (m.clone(), x.modulo_ref(m).complete());
    let (mut u, mut v) = (Integer::new(), Integer::from(1));
    while s > root {
        let (q, rest) = r.div_rem_ref(&s).complete();
        (r, s) = (s, rest);
        u -= &q * &v;
        std::mem::swap(&mut u, &mut v);
    }
    let gcd = Integer::from(s.gcd_ref(&v));
    let (s, v) = (s / &gcd, v / gcd);
    if v < 0 { (-s, -v) } else { (s, v) }
}

/// Returns a vector that is not zero and that the matrix maps to zero, computed exactly; none if
/// none was found.
pub(super) fn null_vector(a: &Matrix<Rational>) -> Option<Vec<Rational>> {
    let cleared = Cleared::new(a);
    let n = a.columns();
    for p in modular::primes().take(TRIALS) {
        let profile = modular::profile(cleared.modulo(p), n, p)?;
        let free = (0..n).find(|j| !profile.columns.contains(j))?;
        // The columns of the regular part before the first free one are enough.
        let order = profile.columns.iter().filter(|&&j| j < free).count();
        let mut null = vec![Rational::new(); n];
        null[free] = Rational::from(1);
        if order > 0 {
            let part = Matrix::from_fn(order, order, |i, j| {
                cleared
                    .matrix
                    .at(profile.rows[i], profile.columns[j])
                    .clone()
            });
            let side: Vec<Integer> = (0..order)
                .map(|i| -cleared.matrix.at(profile.rows[i], free).clone())
                .collect();
            let lifting = Lifting::new(&part)?;
            let found = lifting.solve(&side)?;
            for (j, x) in found.numerators.into_iter().enumerate() {
                null[profile.columns[j]] = Rational::from((x, found.denominator.clone()));
            }
        }
        for (x, c) in null.iter_mut().zip(&cleared.column) {
            *x /= c;
        }
        if a.times(&null).iter().all(|r| *r == 0) {
            return Some(null);
        }
    }
    None
}

/// Returns the refusal of a matrix that was found singular modulo several primes.
pub(super) fn singular(a: &Matrix<Rational>) -> LinearError {
    match null_vector(a) {
        Some(null) => LinearError::Singular { null },
        None => {
            undecided("the matrix is singular modulo primes, without a vector that it maps to 0")
        }
    }
}

fn undecided(reason: &str) -> LinearError {
    Undecided::new(58, reason).into()
}

/// Checks that a matrix is regular modulo a prime, and so regular.
pub(super) fn check_regular(a: &Matrix<Rational>, cleared: &Cleared) -> Result<(), LinearError> {
    let is_regular = |p| modular::inverse(cleared.modulo(p), p).is_some();
    match modular::primes().take(TRIALS).any(is_regular) {
        true => Ok(()),
        false => Err(singular(a)),
    }
}

/// Solves `A X = B` exactly, for every column of B.
pub(super) fn solve(
    a: &Matrix<Rational>,
    cleared_a: &Cleared,
    b: &Matrix<Rational>,
) -> Result<Matrix<Rational>, LinearError> {
    let (n, sides) = (a.rows(), b.columns());
    let Some(lifting) = Lifting::new(&cleared_a.matrix) else {
        return Err(singular(a));
    };
    let mut x = Matrix::from_fn(n, sides, |_, _| Rational::new());
    for k in 0..sides {
        let side: Vec<Rational> = (0..n)
            .map(|i| Rational::from(b.at(i, k) * &cleared_a.row[i]))
            .collect();
        let lcm = common_denominator(&side);
        let mut whole: Vec<Integer> = side.iter().map(|q| cleared(q, &lcm)).collect();
        let gcd = content(&whole);
        whole.iter_mut().for_each(|v| v.div_exact_mut(&gcd));
        let found = lifting
            .solve(&whole)
            .ok_or_else(|| undecided("the solution is longer than Hadamard's bound"))?;
        for (j, numerator) in found.numerators.into_iter().enumerate() {
            let below = (&found.denominator * &lcm).complete() * &cleared_a.column[j];
            *x.at_mut(j, k) = Rational::from((numerator * &gcd, below));
        }
    }
    Ok(x)
}

/// Returns the determinant of a square matrix, exactly.
///
/// The denominator of any solution divides the determinant of an integer matrix; the quotient
/// follows from its residues modulo primes whose product exceeds twice Hadamard's bound on it.
pub(super) fn determinant(
    a: &Matrix<Rational>,
    cleared: &Cleared,
) -> Result<Rational, LinearError> {
    let n = a.rows();
    let Some(lifting) = Lifting::new(&cleared.matrix) else {
        return match singular(a) {
            LinearError::Singular { .. } => Ok(Rational::new()),
            other => Err(other),
        };
    };
    // Any side will do; one that has little in common with the rows leaves the least quotient.
    let side: Vec<Integer> = (0..n as u64)
        .map(|i| Integer::from(i * i % 97 * 31 + 7 * i + 1))
        .collect();
    let found = lifting
        .solve(&side)
        .ok_or_else(|| undecided("the solution is longer than Hadamard's bound"))?;
    let mut divisor = found.denominator;
    divisor.div_exact_mut(&content(found.numerators.iter().chain([&divisor.clone()])));
    let bound = hadamard(&cleared.matrix).div_rem_floor(divisor.clone()).0 * 2u32 + 3u32;
    let (mut quotient, mut product) = (Integer::new(), Integer::from(1));
    for p in modular::primes() {
        if product > bound {
            break;
        }
        let m = Integer::from(p);
        let Some(profile) = modular::profile(cleared.modulo(p), n, p) else {
            continue;
        };
        let Some(unit) = modular::reciprocal(residue(&divisor, &m), p) else {
            continue;
        };
        // Garner: quotient + product · t has the right residue modulo p too.
        let due = (Integer::from(profile.determinant) * unit - &quotient).modulo(&m);
        let inverse = modular::reciprocal(residue(&product, &m), p).expect("distinct primes");
        quotient += (due * inverse).modulo(&m) * &product;
        product *= m;
    }
    if Integer::from(&quotient * 2u32) > product {
        quotient -= product;
    }
    let mut value = Rational::from(divisor * quotient);
    for (row, column) in cleared.row.iter().zip(&cleared.column) {
        value /= row;
        value *= column;
    }
    Ok(value)
}

/// Returns Hadamard's upper bound on the absolute value of the determinant, rounded up.
fn hadamard(a: &Matrix<Integer>) -> Integer {
    let square = |i: usize| {
        a.row(i)
            .iter()
            .map(|v| v.square_ref().complete())
            .sum::<Integer>()
    };
    let product: Integer = (0..a.rows()).map(square).product();
    product.sqrt() + 1u32
}

/// Computes `Aᵀ A` and `Aᵀ b` for every column of b.
pub(super) fn normal_equations(
    a: &Matrix<Rational>,
    b: &Matrix<Rational>,
) -> (Matrix<Rational>, Matrix<Rational>) {
    let column = |m: &Matrix<Rational>, j: usize| -> Vec<Rational> {
        (0..m.rows()).map(|i| m.at(i, j).clone()).collect()
    };
    let columns: Vec<_> = (0..a.columns()).map(|j| column(a, j)).collect();
    let sides: Vec<_> = (0..b.columns()).map(|j| column(b, j)).collect();
    let n = columns.len();
    (
        Matrix::from_fn(n, n, |i, j| inner(&columns[i], &columns[j])),
        Matrix::from_fn(n, sides.len(), |i, j| inner(&columns[i], &sides[j])),
    )
}

#[cfg(test)]
mod tests;

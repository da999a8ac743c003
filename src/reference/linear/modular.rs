//! Linear algebra modulo an integer of one machine word.
//!
//! Elimination divides by units alone, so that a determinant is a unit wherever an inverse is
//! returned, and a regular integer matrix follows also if the modulus were not a prime.

/// Moduli lie below this, so that [`dot`] can add 2¹² products in 128 bits.
const LARGEST: u64 = 1 << 58;

/// The order of the largest matrix.
pub(super) const ROWS: usize = 1 << 12;

/// Returns the largest primes below 2⁵⁸, the largest first.
pub(super) fn primes() -> impl Iterator<Item = u64> {
    let is_prime =
        |p: &u64| rug::Integer::from(*p).is_probably_prime(30) != rug::integer::IsPrime::No;
    (0..LARGEST / 2)
        .map(|k| LARGEST - 1 - 2 * k)
        .filter(is_prime)
}

fn times(a: u64, b: u64, p: u64) -> u64 {
    (u128::from(a) * u128::from(b) % u128::from(p)) as u64
}

/// Returns the inverse of a unit; none of anything else.
pub(super) fn reciprocal(a: u64, p: u64) -> Option<u64> {
    let (mut r, mut s) = (i128::from(p), i128::from(a));
    let (mut x, mut y) = (0i128, 1i128);
    while s != 0 {
        let q = r / s;
        (r, s) = (s, r - q * s);
        (x, y) = (y, x - q * y);
    }
    (r == 1).then(|| x.rem_euclid(i128::from(p)) as u64)
}

/// Computes `Σ a_i b_i` modulo p.
pub(super) fn dot(a: &[u64], b: &[u64], p: u64) -> u64 {
    let pairs = a.iter().zip(b);
    let sum = pairs.fold(0u128, |sum, (a, b)| sum + u128::from(*a) * u128::from(*b));
    (sum % u128::from(p)) as u64
}

/// A multiplier with its quotient by the modulus, by which a product takes no division (Shoup's
/// device: Harvey, *J. Symbolic Computation* 60 (2014) 113–119).
#[derive(Clone, Copy)]
struct Factor {
    f: u64,
    quotient: u64,
    p: u64,
}

impl Factor {
    fn new(f: u64, p: u64) -> Factor {
        let quotient = ((u128::from(f) << 64) / u128::from(p)) as u64;
        Factor { f, quotient, p }
    }

    fn times(self, x: u64) -> u64 {
        let q = ((u128::from(self.quotient) * u128::from(x)) >> 64) as u64;
        let r = self.f.wrapping_mul(x).wrapping_sub(q.wrapping_mul(self.p));
        if r >= self.p { r - self.p } else { r }
    }
}

/// Subtracts `f` times `row` from `from`.
fn subtract(from: &mut [u64], row: &[u64], f: u64, p: u64) {
    let f = Factor::new(f, p);
    for (a, b) in from.iter_mut().zip(row) {
        let d = a.wrapping_sub(f.times(*b));
        *a = if d > *a { d.wrapping_add(p) } else { d };
    }
}

/// A square matrix of residues by rows.
pub(super) type Rows = Vec<Vec<u64>>;

/// Finds a row from `k` on with a unit in `column`.
fn pivot(rows: &Rows, k: usize, column: usize, p: u64) -> Option<(usize, u64)> {
    let unit = |i: usize| Some((i, reciprocal(rows[i][column], p)?));
    (k..rows.len()).find_map(unit)
}

fn two_rows(rows: &mut Rows, k: usize, i: usize) -> (&[u64], &mut [u64]) {
    let (low, high) = rows.split_at_mut(k.max(i));
    match i < k {
        true => (&high[0], &mut low[i]),
        false => (&low[k], &mut high[0]),
    }
}

/// Inverts a matrix in its place by Gauss and Jordan's elimination; none if a column has no unit.
pub(super) fn inverse(mut rows: Rows, p: u64) -> Option<Rows> {
    let n = rows.len();
    let mut exchanges = Vec::with_capacity(n);
    for k in 0..n {
        let (at, unit) = pivot(&rows, k, k, p)?;
        rows.swap(k, at);
        exchanges.push(at);
        rows[k][k] = 1;
        let unit = Factor::new(unit, p);
        rows[k].iter_mut().for_each(|a| *a = unit.times(*a));
        for i in (0..n).filter(|&i| i != k) {
            let (pivot, row) = two_rows(&mut rows, k, i);
            let f = std::mem::take(&mut row[k]);
            if f != 0 {
                subtract(row, pivot, f, p);
            }
        }
    }
    for (k, at) in exchanges.into_iter().enumerate().rev() {
        rows.iter_mut().for_each(|row| row.swap(k, at));
    }
    Some(rows)
}

/// The result of elimination of a matrix modulo p.
pub(super) struct Profile {
    /// The rows of a regular part of the largest order.
    pub rows: Vec<usize>,
    /// Its columns.
    pub columns: Vec<usize>,
    /// The determinant of a square matrix.
    pub determinant: u64,
}

/// Eliminates column by column; none where the only pivots are not units.
pub(super) fn profile(mut rows: Rows, columns: usize, p: u64) -> Option<Profile> {
    let n = rows.len();
    let mut order: Vec<usize> = (0..n).collect();
    let mut found = Profile {
        rows: Vec::new(),
        columns: Vec::new(),
        determinant: 1 % p,
    };
    for column in 0..columns {
        let k = found.columns.len();
        let Some((at, unit)) = pivot(&rows, k, column, p) else {
            if rows[k..].iter().any(|row| row[column] != 0) {
                return None;
            }
            found.determinant = 0;
            continue;
        };
        rows.swap(k, at);
        order.swap(k, at);
        if at != k {
            found.determinant = (p - found.determinant) % p;
        }
        found.determinant = times(found.determinant, rows[k][column], p);
        found.columns.push(column);
        for i in k + 1..n {
            let (pivot, row) = two_rows(&mut rows, k, i);
            if row[column] != 0 {
                let f = times(row[column], unit, p);
                subtract(&mut row[column..], &pivot[column..], f, p);
            }
        }
    }
    found.rows = order[..found.columns.len()].to_vec();
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn primes_fall_from_below_the_bound() {
        let first: Vec<u64> = primes().take(3).collect();
        // 2⁵⁸ − 27, − 57 and − 63 are prime.
        assert_eq!(first, [27, 57, 63].map(|k| LARGEST - k));
        assert_eq!(reciprocal(4, 9), Some(7));
        assert_eq!(reciprocal(6, 9), None);
    }

    proptest! {
        /// The inverse times the matrix is the unit matrix; where there is none, the rank is less.
        #[test]
        fn an_inverse_is_an_inverse(v in prop::collection::vec(0u64..LARGEST, 25), small: bool) {
            let p = if small { 7 } else { primes().next().unwrap() };
            let a: Rows = v.chunks(5).map(|r| r.iter().map(|x| x % p).collect()).collect();
            let profile = profile(a.clone(), 5, p).unwrap();
            match inverse(a.clone(), p) {
                None => prop_assert!(profile.columns.len() < 5 && profile.determinant == 0),
                Some(x) => {
                    prop_assert_eq!(profile.columns.len(), 5);
                    for i in 0..5 {
                        for j in 0..5 {
                            let column: Vec<u64> = (0..5).map(|k| x[k][j]).collect();
                            prop_assert_eq!(dot(&a[i], &column, p), u64::from(i == j));
                        }
                    }
                }
            }
        }
    }
}

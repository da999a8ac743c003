//! Banded linear systems with certified solutions, in a number of operations proportional to the
//! number of rows.
//!
//! With `S = Aᵀ A`, again banded, a unit lower triangle L and a diagonal `D ≥ 0`, let
//! `S − σ I = L D Lᵀ + E`. Since `L D Lᵀ` is positive semidefinite, the least eigenvalue of S is
//! `σ − ‖E‖` or more (the proof of definiteness in Rump, *BIT* 46 (2006) 433–452, for any L and D).
//! If that is `λ > 0`, A is regular, and any x̃ with the residual `r = b − A x̃` has
//! `‖x − x̃‖₂ ≤ ‖r‖₂/√λ`. L and D are computed in floating-point numbers and taken as exact; S, E
//! and r are enclosed in balls. Squaring the condition costs bits of precision, which are cheap
//! here. Nothing is stored outside the band.

use super::dense::{self, are_settled};
use super::matrix::{LinearError, Matrix, check_length, inner};
use crate::{Ball, Mag, Undecided};
use rug::{Float, Rational};

/// Bits of precision of the factors that are tried first, and the number of times that they are
/// doubled: the square of a condition of 2⁶⁰⁰ is left out.
const FIRST: u32 = 192;
const DOUBLINGS: u32 = 3;

/// Shifts σ that are tried, each a 32nd of the one before.
const SHIFTS: u32 = 4;

/// Rounds of refinement.
const ROUNDS: u32 = 40;

/// Rows of the longest matrix that is solved exactly where it is not proved to be regular.
const EXACT_ROWS: usize = 300;

/// The largest denominator of a vector that a long matrix may map to zero.
const DENOMINATOR: u32 = 1 << 16;

/// A square banded matrix of exact numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Banded {
    n: usize,
    lower: usize,
    upper: usize,
    entries: Vec<Rational>,
}

impl Banded {
    /// Takes `n` rows of `lower + 1 + upper` entries, each with the diagonal after `lower` of them.
    /// Places to the left of the first column and to the right of the last are not looked at.
    ///
    /// ```
    /// use mechaudit_reference::banded::{Banded, solve};
    /// use rug::Rational;
    /// let q = |v: &[i32]| v.iter().map(|&v| Rational::from(v)).collect::<Vec<_>>();
    /// // 2 1 0, 1 2 1, 0 1 2
    /// let a = Banded::new(3, 1, 1, q(&[0, 2, 1, 1, 2, 1, 1, 2, 0]))?;
    /// let x = solve(&a, &q(&[4, 8, 8]), 64)?;
    /// assert!((1..).zip(&x).all(|(due, x)| x.contains(&Rational::from(due))));
    /// # Ok::<(), mechaudit_reference::LinearError>(())
    /// ```
    ///
    /// # Errors
    /// [`LinearError::Length`] if there are other than `n · (lower + 1 + upper)` entries.
    pub fn new(
        n: usize,
        lower: usize,
        upper: usize,
        entries: Vec<Rational>,
    ) -> Result<Banded, LinearError> {
        let due = n.saturating_mul(lower.saturating_add(upper).saturating_add(1));
        check_length("entries of the band", entries.len(), due)?;
        Ok(Banded {
            n,
            lower,
            upper,
            entries,
        })
    }

    /// Takes the exact values of floating-point numbers, as [`Banded::new`] does.
    ///
    /// # Errors
    /// [`LinearError::Length`], and [`LinearError::NotFinite`] for NaN and infinities, with the
    /// place in the band as column.
    pub fn from_f64(
        n: usize,
        lower: usize,
        upper: usize,
        entries: &[f64],
    ) -> Result<Banded, LinearError> {
        let width = lower.saturating_add(upper).saturating_add(1);
        let band = Matrix::from_f64(n, width, entries)?;
        Banded::new(n, lower, upper, band.entries().to_vec())
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.n
    }

    /// The columns of a row.
    fn columns(&self, i: usize) -> std::ops::Range<usize> {
        i.saturating_sub(self.lower)..(i + self.upper + 1).min(self.n)
    }

    /// The entries of a row, from its first column on.
    fn row(&self, i: usize) -> &[Rational] {
        let columns = self.columns(i);
        let first = i * (self.lower + self.upper + 1) + self.lower - (i - columns.start);
        &self.entries[first..first + columns.len()]
    }

    /// Computes `A v` exactly.
    fn times(&self, v: &[Rational]) -> Vec<Rational> {
        (0..self.n)
            .map(|i| inner(self.row(i), &v[self.columns(i)]))
            .collect()
    }

    fn dense(&self) -> Matrix<Rational> {
        Matrix::from_fn(self.n, self.n, |i, j| {
            let columns = self.columns(i);
            match columns.contains(&j) {
                true => self.row(i)[j - columns.start].clone(),
                false => Rational::new(),
            }
        })
    }
}

/// Rows in balls, multiplied by powers of two so that their largest entries are near 1.
struct Scaled<'a> {
    band: &'a Banded,
    rows: Vec<Vec<Ball>>,
    exponents: Vec<i32>,
}

/// A ball with no more bits than the number has, where it has few.
fn short(q: &Rational, bits: u32) -> Ball {
    let double = Float::with_val(53, q);
    match double == *q {
        true => Ball::new(double, Mag::ZERO),
        false => Ball::rational(bits, q),
    }
}

impl<'a> Scaled<'a> {
    fn new(band: &'a Banded, bits: u32) -> Scaled<'a> {
        let mut rows = Vec::with_capacity(band.n);
        let mut exponents = Vec::with_capacity(band.n);
        for i in 0..band.n {
            let row: Vec<Ball> = band.row(i).iter().map(|q| short(q, bits)).collect();
            // The same at any number of bits, since a bound for one scale is used at another.
            let exponent = |q: &Rational| Float::with_val(53, q).get_exp();
            let e = band.row(i).iter().filter_map(exponent).max().unwrap_or(0);
            rows.push(row.iter().map(|x| x.shift(-e)).collect());
            exponents.push(e);
        }
        Scaled {
            band,
            rows,
            exponents,
        }
    }

    /// The entry of row i and column j of the band.
    fn at(&self, i: usize, j: usize) -> &Ball {
        &self.rows[i][j - self.band.columns(i).start]
    }

    /// The rows that have entries in both columns i ≤ j.
    fn rows_of(&self, i: usize, j: usize) -> std::ops::Range<usize> {
        j.saturating_sub(self.band.upper)..(i + self.band.lower + 1).min(self.band.n)
    }

    /// `Aᵀ A`: row i holds the columns from `i − w` to i, w the reach of the band.
    fn square(&self, bits: u32) -> Symmetric<Ball> {
        let w = self.band.lower + self.band.upper;
        let row = |j: usize| {
            let entry = |i: usize| {
                let terms = self.rows_of(i, j).map(|k| (self.at(k, i), self.at(k, j)));
                sum_of_products(bits, terms)
            };
            (j.saturating_sub(w)..=j).map(entry).collect()
        };
        let rows = (0..self.band.n).map(row).collect();
        Symmetric { rows }
    }

    /// `b − A x`, with the sides scaled as the rows are.
    fn residual(&self, b: &[Ball], x: &[Ball], bits: u32) -> Vec<Ball> {
        let row = |(i, b): (usize, &Ball)| {
            let terms = self.rows[i].iter().zip(&x[self.band.columns(i)]);
            b - sum_of_products(bits, terms)
        };
        b.iter().enumerate().map(row).collect()
    }

    /// `Aᵀ r` in floating-point numbers.
    fn transposed(&self, r: &[Ball], bits: u32) -> Vec<Float> {
        let column = |j: usize| {
            let mut sum = Float::new(bits);
            for k in self.rows_of(j, j) {
                sum += self.at(k, j).mid() * r[k].mid();
            }
            sum
        };
        (0..r.len()).map(column).collect()
    }
}

fn sum_of_products<'a>(bits: u32, terms: impl Iterator<Item = (&'a Ball, &'a Ball)>) -> Ball {
    crate::dot(bits, terms.filter(|(a, b)| !a.is_zero() && !b.is_zero()))
}

/// The lower half of a symmetric banded matrix: row i ends with its diagonal.
struct Symmetric<T> {
    rows: Vec<Vec<T>>,
}

impl<T> Symmetric<T> {
    fn first(&self, i: usize) -> usize {
        i + 1 - self.rows[i].len()
    }
}

/// Floating-point factors `L D Lᵀ`: row i of L ends before its diagonal, which is 1.
struct Factors {
    l: Vec<Vec<Float>>,
    d: Vec<Float>,
}

impl Factors {
    /// Factors `S − σ I`; none if an entry of D is not positive.
    fn new(s: &Symmetric<Ball>, sigma: &Float, bits: u32) -> Option<Factors> {
        let n = s.rows.len();
        let (mut l, mut d): (Vec<Vec<Float>>, Vec<Float>) =
            (Vec::with_capacity(n), Vec::with_capacity(n));
        for i in 0..n {
            let first = s.first(i);
            // l_ij d_j for the columns before i, then the row of L itself.
            let mut products: Vec<Float> = Vec::with_capacity(i - first);
            let mut row = Vec::with_capacity(i - first);
            let mut pivot = Float::with_val(bits, s.rows[i][i - first].mid() - sigma);
            for j in first..i {
                let mut sum = Float::with_val(bits, s.rows[i][j - first].mid());
                let start = s.first(j).max(first);
                for k in start..j {
                    sum -= &products[k - first] * &l[j][k - s.first(j)];
                }
                let entry = Float::with_val(bits, &sum / &d[j]);
                pivot -= &sum * &entry;
                products.push(sum);
                row.push(entry);
            }
            if !(pivot > 0) {
                return None;
            }
            l.push(row);
            d.push(pivot);
        }
        Some(Factors { l, d })
    }

    /// Solves `L D Lᵀ x = b` in the place of b.
    fn solve(&self, x: &mut [Float]) {
        let n = x.len();
        for i in 0..n {
            let first = i - self.l[i].len();
            let (before, rest) = x.split_at_mut(i);
            for (l, x) in self.l[i].iter().zip(&before[first..]) {
                rest[0] -= l * x;
            }
        }
        for (x, d) in x.iter_mut().zip(&self.d) {
            *x /= d;
        }
        for i in (0..n).rev() {
            let first = i - self.l[i].len();
            let (before, rest) = x.split_at_mut(i);
            for (l, x) in self.l[i].iter().zip(&mut before[first..]) {
                *x -= l * &rest[0];
            }
        }
    }

    /// Bounds `‖S − σ I − L D Lᵀ‖` by the largest row sum.
    fn defect(&self, s: &Symmetric<Ball>, sigma: &Float, bits: u32) -> Mag {
        let n = self.d.len();
        let exact = |x: &Float| Ball::new(x.clone(), Mag::ZERO);
        let l: Vec<Vec<Ball>> = self
            .l
            .iter()
            .map(|row| {
                row.iter()
                    .map(exact)
                    .chain([Ball::integer(bits, 1)])
                    .collect()
            })
            .collect();
        let d: Vec<Ball> = self.d.iter().map(exact).collect();
        let sigma = exact(sigma);
        let mut sums = vec![Mag::ZERO; n];
        for i in 0..n {
            let first = s.first(i);
            let products: Vec<Ball> = l[i].iter().zip(&d[first..]).map(|(l, d)| l * d).collect();
            for j in first..=i {
                let start = s.first(j).max(first);
                let terms = products[start - first..=j - first]
                    .iter()
                    .zip(&l[j][start - s.first(j)..]);
                let mut rest = &s.rows[i][j - first] - sum_of_products(bits, terms);
                if i == j {
                    rest = rest - &sigma;
                }
                let size = rest.magnitude();
                sums[i] = sums[i].add(size);
                if i != j {
                    sums[j] = sums[j].add(size);
                }
            }
        }
        sums.into_iter().fold(Mag::ZERO, Mag::max)
    }
}

/// Approximates a vector of the least eigenvalue, of length 1, and the eigenvalue.
fn least(factors: &Factors, bits: u32) -> (Vec<Float>, Float) {
    let n = factors.d.len();
    // Any start will do that is not orthogonal to it by chance.
    let start = |i: usize| Float::with_val(bits, 1.0 + ((i * i + 3 * i) % 17) as f64 / 16.0);
    let mut v: Vec<Float> = (0..n).map(start).collect();
    let mut grown = Float::with_val(bits, 1);
    for _ in 0..4 {
        factors.solve(&mut v);
        let mut norm = Float::new(bits);
        v.iter().for_each(|x| norm += x * x);
        grown = norm.sqrt();
        v.iter_mut().for_each(|x| *x /= &grown);
    }
    (v, grown.recip())
}

/// A lower bound on the least eigenvalue of S, by a shift below an estimate of it; none if no shift
/// is proved.
fn least_eigenvalue(s: &Symmetric<Ball>, estimate: &Float, bits: u32) -> Option<Mag> {
    let mut sigma = Float::with_val(53, estimate) / 4u32;
    for _ in 0..SHIFTS {
        if !(sigma > 0) || !sigma.is_finite() {
            return None;
        }
        if let Some(factors) = Factors::new(s, &sigma, bits) {
            let bound = Mag::below(&sigma).sub_below(factors.defect(s, &sigma, bits));
            if !bound.is_zero() {
                return Some(bound);
            }
        }
        sigma /= 32u32;
    }
    None
}

/// Solves `A x = b`. Each entry is known to `2^-goal` of its size, or of `2^-goal` of the largest
/// one where it is smaller than that.
///
/// # Errors
/// [`LinearError`]: a side of another length, a singular matrix with a vector that proves it, or
/// undecided.
pub fn solve(a: &Banded, b: &[Rational], goal: u32) -> Result<Vec<Ball>, LinearError> {
    check_length("the right-hand side", b.len(), a.n)?;
    if a.n == 0 {
        return Ok(Vec::new());
    }
    let mut bits = FIRST;
    for _ in 0..=DOUBLINGS {
        if let Some(x) = enclosed(a, b, goal, bits) {
            return Ok(x);
        }
        bits *= 2;
    }
    if a.n <= EXACT_ROWS {
        let side = Matrix::new(a.n, 1, b.to_vec())?;
        return Ok(dense::solve(&a.dense(), &side, goal)?.entries().to_vec());
    }
    if let Some(null) = null_vector(a, bits / 2) {
        return Err(LinearError::Singular { null });
    }
    let reason = "the banded matrix was not proved to be regular";
    Err(Undecided::new(bits / 2, reason).into())
}

fn enclosed(a: &Banded, b: &[Rational], goal: u32, bits: u32) -> Option<Vec<Ball>> {
    let scaled = Scaled::new(a, bits);
    let s = scaled.square(bits);
    let factors = Factors::new(&s, &Float::new(bits), bits)?;
    let (_, estimate) = least(&factors, bits);
    let lambda = least_eigenvalue(&s, &estimate, bits)?;
    drop(s);
    // The residual in more bits than the solution needs, for what cancels.
    let lost = estimate.get_exp().map_or(0, |e| e.unsigned_abs() / 2);
    let fine = 2 * goal + 64 + lost;
    let scaled = if fine > bits {
        Scaled::new(a, fine)
    } else {
        scaled
    };
    let side: Vec<Ball> = b
        .iter()
        .zip(&scaled.exponents)
        .map(|(q, e)| short(q, fine).shift(-e))
        .collect();
    refined(&scaled, &side, &factors, lambda, [goal, bits, fine])
}

/// Refines the solution until the bound on its error is as small as asked for.
fn refined(
    scaled: &Scaled,
    side: &[Ball],
    factors: &Factors,
    lambda: Mag,
    [goal, bits, fine]: [u32; 3],
) -> Option<Vec<Ball>> {
    let n = side.len();
    let mut x = vec![Ball::new(Float::new(fine), Mag::ZERO); n];
    for _ in 0..ROUNDS {
        let residual = scaled.residual(side, &x, fine);
        let error = distance(&residual, lambda);
        let balls: Vec<Ball> = x.iter().map(|x| x.widened(error)).collect();
        if are_settled(&balls, goal) {
            return Some(balls.iter().map(|x| x.with_prec(goal + 32)).collect());
        }
        let mut step = scaled.transposed(&residual, bits);
        factors.solve(&mut step);
        for (x, s) in x.iter_mut().zip(step) {
            *x = Ball::new(Float::with_val(fine, x.mid() + s), Mag::ZERO);
        }
    }
    None
}

/// Bounds `‖r‖₂/√λ` by the root of `‖r‖₂²/λ`.
fn distance(residual: &[Ball], lambda: Mag) -> Mag {
    let square = |sum: Mag, r: &Ball| sum.add(r.magnitude().mul(r.magnitude()));
    let sum = residual.iter().fold(Mag::ZERO, square);
    sum.div(lambda).sqrt()
}

/// Finds a vector of short fractions that is not zero and that the matrix maps to zero, computed
/// exactly.
fn null_vector(a: &Banded, bits: u32) -> Option<Vec<Rational>> {
    let mut s = Scaled::new(a, bits).square(bits);
    // Positive definite by so little that the vector is not moved.
    let shift = Ball::new(Float::with_val(bits, 1) >> (bits / 2), Mag::ZERO);
    for row in &mut s.rows {
        let last = row.len() - 1;
        row[last] = &row[last] + &shift;
    }
    let factors = Factors::new(&s, &Float::new(bits), bits)?;
    let (v, _) = least(&factors, bits);
    let largest = v
        .iter()
        .max_by(|a, b| a.cmp_abs(b).expect("numbers"))?
        .clone();
    let fraction = |x: &Float| nearby(&Float::with_val(bits, x / &largest));
    let null = v.iter().map(fraction).collect::<Option<Vec<_>>>()?;
    let is_null = null.iter().any(|x| *x != 0) && a.times(&null).iter().all(|x| *x == 0);
    is_null.then_some(null)
}

/// The last convergent of the continued fraction with a short denominator.
fn nearby(x: &Float) -> Option<Rational> {
    let (mut p, mut q) = (
        [rug::Integer::from(1), rug::Integer::new()],
        [rug::Integer::new(), rug::Integer::from(1)],
    );
    let mut rest = x.clone();
    loop {
        let whole = rest.to_integer_round(rug::float::Round::Down)?.0;
        let next = |v: &[rug::Integer; 2]| rug::Integer::from(&v[0] * &whole) + &v[1];
        let (a, b) = (next(&p), next(&q));
        if b > DENOMINATOR {
            break;
        }
        let [first, _] = p;
        p = [a, first];
        let [first, _] = q;
        q = [b, first];
        rest -= whole;
        if rest.is_zero() {
            break;
        }
        rest.recip_mut();
    }
    (q[0] != 0).then(|| Rational::from((p[0].clone(), q[0].clone())))
}

#[cfg(test)]
mod tests;

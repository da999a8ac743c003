//! One system with one right-hand side, by elimination from both ends at once.
//!
//! The rows above the middle one are eliminated downwards, those below it upwards, and the middle
//! row meets both (twisted factorization). The pivots are quotients of continuants,
//! `p_i = θ_i/θ_{i−1}`, so that no division waits for another one: from above, with `r_i = 1/p_i`,
//!
//! ```text
//! θ_i = diagonal_i θ_{i−1} − lower_{i−1} upper_{i−1} θ_{i−2},   r_i = θ_{i−1}/θ_i
//! η_i = d_i r_i − lower_{i−1} r_i η_{i−1},                      x_i = η_i − upper_i r_i x_{i+1}
//! ```
//!
//! and likewise from below. The quotients of the rounded continuants are pivots of a matrix whose
//! entries are off by a few roundings, since `θ_i/θ_{i−1} = diagonal_i (1 + δ) − lower_{i−1}
//! upper_{i−1} (1 + δ')/(θ_{i−1}/θ_{i−2})`. As elimination of a matrix whose rows are permuted it
//! is therefore as stable for matrices that are diagonally dominant as [`Sweep`]'s (Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 2nd ed., theorems 9.11–9.13).
//!
//! Long systems are eliminated twice, the second time block by block from the middle outwards: that
//! takes less time than fresh memory for the factors of all rows.

use super::elimination::SEVERAL;
use super::error::{TridiagonalError, check_finite, check_length, check_matrix, check_solution};
use super::{Stability, Sweep};
use crate::hex::hex;
use crate::lanes::{Lanes, Task, with_best};
use std::cell::Cell;

/// Products of entries from here on are rounded to their last place.
const LEAST: f64 = 1e-290;
/// Continuants are set back to this outside of a span about it, and four rows on they have to lie
/// within the limits: then their quotients are normal numbers, and so are those of the pivots.
const REST: f64 = hex("0x1p400");
const SPAN: [f64; 2] = [hex("0x1p200"), hex("0x1p600")];
const LIMITS: [f64; 2] = [hex("0x1p-20"), hex("0x1p1000")];
/// Rows of each end whose factors are kept.
const BLOCK: usize = 16_384;

/// The rows of a system: the entries before, on and after the diagonal, and K right-hand sides.
pub(crate) trait Rows<const K: usize> {
    /// The number of rows, at least one.
    fn len(&self) -> usize;
    /// Row `i`; what lies outside of the matrix is zero.
    fn row(&self, i: usize) -> ([f64; 3], [f64; K]);
    /// Rows `i … i + 3`, neither the first nor the last one among them: each kind of entry together.
    fn four(&self, i: usize) -> ([[f64; 4]; 3], [[f64; 4]; K]);
}

/// A matrix as three slices.
#[derive(Clone, Copy)]
pub(crate) struct Bands<'a, D> {
    pub lower: &'a [f64],
    pub diagonal: &'a [f64],
    pub upper: &'a [f64],
    pub d: D,
}

/// A right-hand side, which may be where the solution goes.
pub(crate) trait Right {
    fn at(&self, i: usize) -> f64;
    fn four(&self, i: usize) -> [f64; 4];
}

impl Right for &[f64] {
    #[inline(always)]
    fn at(&self, i: usize) -> f64 {
        self[i]
    }
    #[inline(always)]
    fn four(&self, i: usize) -> [f64; 4] {
        four(self, i)
    }
}

impl Right for &[Cell<f64>] {
    #[inline(always)]
    fn at(&self, i: usize) -> f64 {
        self[i].get()
    }
    #[inline(always)]
    fn four(&self, i: usize) -> [f64; 4] {
        let d: &[Cell<f64>; 4] = self[i..].first_chunk().expect("four more rows");
        [d[0].get(), d[1].get(), d[2].get(), d[3].get()]
    }
}

#[inline(always)]
fn four(v: &[f64], i: usize) -> [f64; 4] {
    *v[i..].first_chunk().expect("four more rows")
}

impl<D> Bands<'_, D> {
    #[inline(always)]
    fn bands(&self, i: usize) -> [f64; 3] {
        let before = if i > 0 { self.lower[i - 1] } else { 0.0 };
        [
            before,
            self.diagonal[i],
            self.upper.get(i).copied().unwrap_or(0.0),
        ]
    }
    #[inline(always)]
    fn four_bands(&self, i: usize) -> [[f64; 4]; 3] {
        let (a, b, c) = (self.lower, self.diagonal, self.upper);
        [four(a, i - 1), four(b, i), four(c, i)]
    }
}

impl<const K: usize, D: Right> Rows<K> for Bands<'_, [D; K]> {
    fn len(&self) -> usize {
        self.diagonal.len()
    }
    #[inline(always)]
    fn row(&self, i: usize) -> ([f64; 3], [f64; K]) {
        let mut d = [0.0; K];
        for j in 0..K {
            d[j] = self.d[j].at(i);
        }
        (self.bands(i), d)
    }
    #[inline(always)]
    fn four(&self, i: usize) -> ([[f64; 4]; 3], [[f64; 4]; K]) {
        let mut d = [[0.0; 4]; K];
        for j in 0..K {
            d[j] = self.d[j].four(i);
        }
        (self.four_bands(i), d)
    }
}

/// Solves one system. Where a pivot vanishes, the sweep downwards is tried before the system is
/// refused. After an error `x` is as it was, unless the error is an overflow.
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_into;
/// let mut x = [0.0; 3];
/// solve_into(&[1.0, 1.0], &[4.0, 4.0, 4.0], &[1.0, 1.0], &[5.0, 6.0, 5.0], &mut x)?;
/// assert_eq!(x, [1.0, 1.0, 1.0]);
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`Sweep::factor`] and [`Sweep::solve`].
pub fn solve_into(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
    x: &mut [f64],
) -> Result<(), TridiagonalError> {
    check_length("right-hand side", d, diagonal.len())?;
    let d = (lower, diagonal, upper, d);
    solve::<false, _>(d, Cell::from_mut(x).as_slice_of_cells()).map(|_| ())
}

/// [`solve_into`], and an estimate of the error of the solution relative to its largest entry,
/// `4 u · growth · skeel` as [`Stability::relative_error`](super::Stability::relative_error).
///
/// Here `skeel = ‖ |U⁻¹||L⁻¹||A| ‖_∞`, which the same passes give: Skeel's condition for a matrix
/// that is diagonally dominant by rows or columns, positive definite or an M-matrix, where
/// `|U⁻¹||L⁻¹| = |A⁻¹|`, and an upper bound of it for any other (Higham, *Efficient algorithms for
/// computing the condition number of a tridiagonal matrix*, SIAM J. Sci. Stat. Comput. 7, 1986).
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_into_with_error;
/// let mut x = [0.0; 2];
/// let error = solve_into_with_error(&[1.0], &[1e-20, 1.0], &[1.0], &[1.0, 2.0], &mut x)?;
/// assert!(error > 1.0); // without pivoting nothing is left
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`solve_into`].
pub fn solve_into_with_error(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
    x: &mut [f64],
) -> Result<f64, TridiagonalError> {
    check_length("right-hand side", d, diagonal.len())?;
    let d = (lower, diagonal, upper, d);
    solve::<true, _>(d, Cell::from_mut(x).as_slice_of_cells())
}

/// [`solve_into`] where the right-hand side stands in `x`, with the estimate of the error if it is
/// asked for.
///
/// # Errors
/// As [`solve_into`].
pub fn solve_in_place(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    x: &mut [f64],
    estimate: bool,
) -> Result<f64, TridiagonalError> {
    let x: &[Cell<f64>] = Cell::from_mut(x).as_slice_of_cells();
    match estimate {
        true => solve::<true, _>((lower, diagonal, upper, x), x),
        false => solve::<false, _>((lower, diagonal, upper, x), x),
    }
}

/// Solves for several right-hand sides that lie one after the other in `x`, which the solutions
/// replace; eight at a time, as [`solve_into`] does for one. After an error the content of `x` is
/// unspecified.
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_many_in_place;
/// let mut x = [5.0, 6.0, 5.0, 10.0, 12.0, 10.0];
/// solve_many_in_place(&[1.0, 1.0], &[4.0, 4.0, 4.0], &[1.0, 1.0], &mut x)?;
/// assert_eq!(x, [1.0, 1.0, 1.0, 2.0, 2.0, 2.0]);
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`solve_into`], with the place in the whole slice.
pub fn solve_many_in_place(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    x: &mut [f64],
) -> Result<(), TridiagonalError> {
    let n = diagonal.len();
    if n == 0 || lower.len() != n - 1 || upper.len() != n - 1 {
        check_matrix(lower, diagonal, upper)?;
    }
    check_length("right-hand sides", x, x.len().div_ceil(n) * n)?;
    for (group, x) in x.chunks_mut(n * SEVERAL).enumerate() {
        let from = group * n * SEVERAL;
        if x.len() == n * SEVERAL {
            let cells: &[Cell<f64>] = Cell::from_mut(&mut *x).as_slice_of_cells();
            let columns: [&[Cell<f64>]; SEVERAL] = std::array::from_fn(|j| &cells[j * n..][..n]);
            let rows = Bands {
                lower,
                diagonal,
                upper,
                d: columns,
            };
            let found = both_ends::<false, SEVERAL, _>(&rows, columns);
            if found.map_err(|e| e.further(from))?.is_some() {
                continue;
            }
        }
        for (j, x) in x.chunks_exact_mut(n).enumerate() {
            let solved = solve_in_place(lower, diagonal, upper, x, false);
            solved.map_err(|e| match e {
                TridiagonalError::Pivot { .. } => e,
                TridiagonalError::NotFinite { name, .. } if name != "right-hand side" => e,
                e => e.further(from + j * n),
            })?;
        }
    }
    Ok(())
}

fn solve<const ESTIMATE: bool, D: Right + Copy>(
    (lower, diagonal, upper, d): (&[f64], &[f64], &[f64], D),
    x: &[Cell<f64>],
) -> Result<f64, TridiagonalError> {
    let n = diagonal.len();
    if n == 0 || lower.len() != n - 1 || upper.len() != n - 1 {
        check_matrix(lower, diagonal, upper)?;
    }
    if x.len() != n {
        return Err(TridiagonalError::Length {
            name: "solution",
            expected: n,
            got: x.len(),
        });
    }
    let bands = Bands {
        lower,
        diagonal,
        upper,
        d: [d],
    };
    match both_ends::<ESTIMATE, 1, _>(&bands, [x])? {
        Some(found) => Ok(2.0 * f64::EPSILON * found.growth * found.size),
        // Something is not finite or a pivot vanishes: the sweep tells which, or can do without.
        None => swept::<ESTIMATE>(lower, diagonal, upper, (0..n).map(|i| d.at(i)).collect(), x),
    }
}

/// Solves by the sweep downwards.
fn swept<const ESTIMATE: bool>(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    mut d: Vec<f64>,
    x: &[Cell<f64>],
) -> Result<f64, TridiagonalError> {
    check_matrix(lower, diagonal, upper)?;
    check_finite("right-hand side", &d)?;
    let sweep = Sweep::factor(lower, diagonal, upper)?;
    sweep.solve_in_place(&mut d)?;
    x.iter().zip(d).for_each(|(x, d)| x.set(d));
    Ok(match ESTIMATE {
        true => Stability::relative_error(&sweep.stability()),
        false => 0.0,
    })
}

/// [`solve_into`] for rows that are made as they are needed.
///
/// # Errors
/// As [`solve_into`].
pub(crate) fn solve_rows<R: Rows<1>>(rows: &R, x: &mut [f64]) -> Result<(), TridiagonalError> {
    let x: &[Cell<f64>] = Cell::from_mut(x).as_slice_of_cells();
    if both_ends::<false, 1, R>(rows, [x])?.is_some() {
        return Ok(());
    }
    let all: Vec<_> = (0..rows.len()).map(|i| rows.row(i)).collect();
    let of = |k: usize| all.iter().map(move |(row, _)| row[k]);
    let d = all.iter().map(|(_, [d])| *d).collect();
    let (lower, upper): (Vec<f64>, Vec<f64>) =
        (of(0).skip(1).collect(), of(2).take(all.len() - 1).collect());
    swept::<false>(&lower, &of(1).collect::<Vec<_>>(), &upper, d, x).map(|_| ())
}

/// The evidence for a solution.
pub(crate) struct Found {
    /// The largest of `(|L||U|)_ii / Σ_j |A_ij|`.
    pub growth: f64,
    /// The largest entry of `|U⁻¹||L⁻¹||A|e`, with ones in e, and the first and last one.
    pub size: f64,
    pub sizes: [f64; 2],
}

/// Solves a system for K right-hand sides from both ends. Returns none where the elimination fails,
/// and then nothing is written to `x`. The sizes are there with `ESTIMATE` alone.
///
/// # Errors
/// A solution that overflows.
pub(crate) fn both_ends<const ESTIMATE: bool, const K: usize, R: Rows<K>>(
    rows: &R,
    x: [&[Cell<f64>]; K],
) -> Result<Option<Found>, TridiagonalError> {
    let kept = (rows.len() / 2 + 1).min(BLOCK + 4);
    let mut room = vec![0.0; kept * 2 * (1 + K + usize::from(ESTIMATE))];
    let mut parts = room.chunks_exact_mut(kept);
    let mut end = || [(); 2].map(|()| parts.next().unwrap_or_default());
    let found = with_best(Both::<ESTIMATE, K, R> {
        rows,
        x,
        room: Room {
            factors: end(),
            etas: [(); K].map(|()| end()),
            sizes: end(),
        },
        growth: 1.0,
        ok: true,
    });
    let Some((finite, found)) = found else {
        return Ok(None);
    };
    if !finite {
        for (j, x) in x.into_iter().enumerate() {
            let x: Vec<f64> = x.iter().map(Cell::get).collect();
            check_solution(&x).map_err(|e| e.further(j * x.len()))?;
        }
    }
    Ok(Some(found))
}

/// Where the ends from above and from below keep the rows of a block.
struct Room<'a, const K: usize> {
    /// The next unknown is multiplied with these, negated.
    factors: [&'a mut [f64]; 2],
    etas: [[&'a mut [f64]; 2]; K],
    /// The sums that bound the condition.
    sizes: [&'a mut [f64]; 2],
}

/// Elimination from both ends.
struct Both<'a, const ESTIMATE: bool, const K: usize, R> {
    rows: &'a R,
    x: [&'a [Cell<f64>]; K],
    room: Room<'a, K>,
    growth: f64,
    ok: bool,
}

/// The last row that one end has eliminated.
#[derive(Clone, Copy)]
struct End<const K: usize> {
    /// Its continuant and the one before.
    theta: [f64; 2],
    /// Reciprocal of its pivot.
    reciprocal: f64,
    /// Its entry after the diagonal.
    after: f64,
    /// Its part of the solutions without the unknowns to come.
    eta: [f64; K],
    /// The bound of that for the sums of absolute values.
    size: f64,
}

impl<const K: usize> End<K> {
    /// Sets the continuants back. Where the one before is beyond the limits, so are the next ones.
    #[inline(always)]
    fn rest(&mut self) {
        let before = REST * self.reciprocal;
        let inside = before.abs() >= LIMITS[0] && before.abs() <= LIMITS[1];
        self.theta = [if inside { REST } else { f64::NAN }, before];
    }

    const BEFORE: End<K> = End {
        theta: [REST, 0.0],
        reciprocal: 0.0,
        after: 0.0,
        eta: [0.0; K],
        size: 0.0,
    };
}

/// Returns whether the product of two entries is rounded to its last place.
#[inline(always)]
fn is_accurate(product: f64, a: f64, b: f64) -> bool {
    (product.abs() >= LEAST) | (a == 0.0) | (b == 0.0)
}

/// `f` of the numbers from 0 to 3.
#[inline(always)]
fn each(f: impl Fn(usize) -> f64) -> [f64; 4] {
    [f(0), f(1), f(2), f(3)]
}

impl<const ESTIMATE: bool, const K: usize, R: Rows<K>> Both<'_, ESTIMATE, K, R> {
    fn len(&self) -> usize {
        self.rows.len()
    }

    /// Notes how an entry has grown.
    #[inline(always)]
    fn note(&mut self, grown: f64, row: f64) {
        if grown > self.growth * row {
            self.growth = grown / row;
        }
    }

    /// Eliminates one row and keeps it at `k`: a function of its own, without fused operations, which
    /// not all instructions have that it may be compiled for.
    #[inline(never)]
    fn one(
        &mut self,
        end: &mut End<K>,
        side: usize,
        k: usize,
        ([before, b, after], d): ([f64; 3], [f64; K]),
    ) {
        let product = before * end.after;
        let filled = product * end.reciprocal;
        let p = b - filled;
        let r = 1.0 / p;
        self.ok &= p.is_normal() & r.is_normal() & is_accurate(product, before, end.after);
        let by_before = before * r;
        if ESTIMATE {
            let row = before.abs() + b.abs() + after.abs();
            self.note(filled.abs() + p.abs(), row);
            end.size = by_before.abs() * end.size + row * r.abs();
            self.room.sizes[side][k] = end.size;
        }
        for (j, d) in d.into_iter().enumerate() {
            end.eta[j] = d * r - by_before * end.eta[j];
            self.room.etas[j][side][k] = end.eta[j];
        }
        (end.reciprocal, end.after) = (r, after);
        end.rest();
        self.room.factors[side][k] = after * r;
    }

    /// Eliminates four rows, the one at `k` first.
    #[inline(always)]
    fn four(
        &mut self,
        end: &mut End<K>,
        side: usize,
        k: usize,
        ([before, b, after], d): ([[f64; 4]; 3], [[f64; 4]; K]),
    ) {
        let facing = [end.after, after[0], after[1], after[2]];
        let e = each(|i| before[i] * facing[i]);
        let mut t = [end.theta[1], end.theta[0], 0.0, 0.0, 0.0, 0.0];
        for i in 0..4 {
            t[i + 2] = b[i].mul_add(t[i + 1], -(e[i] * t[i]));
        }
        // A product that underflows is off by 2⁻¹⁰⁷⁵, which is nothing beside these.
        let inside = |t: f64| (t.abs() >= LIMITS[0]) & (t.abs() <= LIMITS[1]);
        if !(inside(t[2]) & inside(t[3]) & inside(t[4]) & inside(t[5])) {
            return self.singly(end, side, k, &([before, b, after], d));
        }
        let r = each(|i| t[i + 1] / t[i + 2]);
        let by_before = each(|i| before[i] * r[i]);
        for (j, d) in d.into_iter().enumerate() {
            let mut eta = each(|i| d[i] * r[i]);
            for i in 0..4 {
                end.eta[j] = (-by_before[i]).mul_add(end.eta[j], eta[i]);
                eta[i] = end.eta[j];
            }
            self.room.etas[j][side][k..k + 4].copy_from_slice(&eta);
        }
        if ESTIMATE {
            let reciprocals = [end.reciprocal, r[0], r[1], r[2]];
            let row = each(|i| before[i].abs() + b[i].abs() + after[i].abs());
            let filled = each(|i| e[i] * reciprocals[i]);
            let grown = each(|i| filled[i].abs() + (b[i] - filled[i]).abs());
            let mut more = false;
            for i in 0..4 {
                more |= grown[i] > self.growth * row[i];
            }
            if more {
                (0..4).for_each(|i| self.note(grown[i], row[i]));
            }
            let mut size = each(|i| row[i] * r[i].abs());
            for i in 0..4 {
                end.size = by_before[i].abs().mul_add(end.size, size[i]);
                size[i] = end.size;
            }
            self.room.sizes[side][k..k + 4].copy_from_slice(&size);
        }
        let factors = each(|i| after[i] * r[i]);
        self.room.factors[side][k..k + 4].copy_from_slice(&factors);
        (end.reciprocal, end.after) = (r[3], after[3]);
        end.theta = [t[5], t[4]];
        if !(t[5].abs() >= SPAN[0] && t[5].abs() <= SPAN[1]) {
            end.rest();
        }
    }

    /// Eliminates four rows one after the other.
    #[cold]
    #[inline(never)]
    fn singly(
        &mut self,
        end: &mut End<K>,
        side: usize,
        k: usize,
        (bands, d): &([[f64; 4]; 3], [[f64; 4]; K]),
    ) {
        for i in 0..4 {
            let row = (bands.map(|band| band[i]), d.map(|d| d[i]));
            self.one(end, side, k + i, row);
        }
    }

    /// Row number `k` from an end, as this end sees it.
    #[inline(always)]
    fn seen(&self, side: usize, k: usize) -> ([f64; 3], [f64; K]) {
        if side == 0 {
            return self.rows.row(k);
        }
        let ([a, b, c], d) = self.rows.row(self.len() - 1 - k);
        ([c, b, a], d)
    }

    /// Eliminates the rows from number `from` up to `to` of each end.
    #[inline(always)]
    fn eliminate(&mut self, ends: &mut [End<K>; 2], from: usize, to: [usize; 2]) {
        let n = self.len();
        let mut k = from;
        if from == 0 {
            for side in 0..2 {
                if to[side] > 0 {
                    self.one(&mut ends[side], side, 0, self.seen(side, 0));
                }
            }
            k = 1;
        }
        let [mut above, mut below] = *ends;
        while k + 4 <= to[1] {
            self.four(&mut above, 0, k - from, self.rows.four(k));
            let ([a, b, c], d) = self.rows.four(n - 4 - k);
            let turn = |[p, q, r, s]: [f64; 4]| [s, r, q, p];
            let turned = ([c, b, a].map(turn), d.map(turn));
            self.four(&mut below, 1, k - from, turned);
            k += 4;
        }
        *ends = [above, below];
        for side in 0..2 {
            for k in k..to[side] {
                self.one(&mut ends[side], side, k - from, self.seen(side, k));
            }
        }
    }

    /// Substitutes back row number `k` of an end, which is kept at `at`.
    #[inline(always)]
    fn back(&self, next: &mut Back<K>, side: usize, k: usize, at: usize) {
        let room = &self.room;
        let factor = room.factors[side][at];
        let place = if side == 0 { k } else { self.len() - 1 - k };
        for j in 0..K {
            next.x[j] = (-factor).mul_add(next.x[j], room.etas[j][side][at]);
            self.x[j][place].set(next.x[j]);
        }
        if ESTIMATE {
            next.size = factor.abs().mul_add(next.size, room.sizes[side][at]);
            next.most = next.most.max(next.size);
        }
    }

    /// Substitutes back the rows from number `from` up to `to` of each end.
    #[inline(always)]
    fn substitute(&self, next: &mut [Back<K>; 2], from: usize, to: [usize; 2]) {
        let [mut above, mut below] = *next;
        for k in (to[1].max(from)..to[0]).rev() {
            self.back(&mut above, 0, k, k - from);
        }
        for k in (from..to[1]).rev() {
            self.back(&mut above, 0, k, k - from);
            self.back(&mut below, 1, k, k - from);
        }
        *next = [above, below];
    }
}

/// The row that was substituted back last.
#[derive(Clone, Copy)]
struct Back<const K: usize> {
    x: [f64; K],
    size: f64,
    /// The largest size.
    most: f64,
}

impl<const ESTIMATE: bool, const K: usize, R: Rows<K>> Task for Both<'_, ESTIMATE, K, R> {
    /// Tells whether the solution is finite.
    type Output = Option<(bool, Found)>;
    #[inline(always)]
    fn run<L: Lanes>(mut self, _: L) -> Self::Output {
        let n = self.len();
        let middle = n / 2;
        let to = [middle, n - 1 - middle];
        // A block begins behind the first row, with four more at a time.
        let starts = (0..).map(|j| if j > 0 { 1 + j * BLOCK } else { 0 });
        let starts: Vec<usize> = starts.take_while(|s| *s == 0 || s + 4 <= to[1]).collect();
        let stop = |j: usize| starts.get(j + 1).map_or(to, |s| [*s; 2]);
        let mut ends = [End::BEFORE; 2];
        let mut before = Vec::with_capacity(starts.len());
        for (j, from) in starts.iter().enumerate() {
            before.push(ends);
            self.eliminate(&mut ends, *from, stop(j));
        }
        // The middle row has no unknown after it.
        let ([a, b, c], d) = self.rows.row(middle);
        let [above, below] = ends;
        let products = [a * above.after, c * below.after];
        let p = (-products[0]).mul_add(above.reciprocal, b);
        let p = (-products[1]).mul_add(below.reciprocal, p);
        let r = 1.0 / p;
        let value: [f64; K] = std::array::from_fn(|j| {
            let rest = (-a).mul_add(above.eta[j], d[j]);
            (-c).mul_add(below.eta[j], rest) * r
        });
        let mut ok = self.ok & p.is_normal() & r.is_normal();
        ok &= is_accurate(products[0], a, above.after) & is_accurate(products[1], c, below.after);
        if !ok || value.iter().any(|v| !v.is_finite()) {
            return None;
        }
        let row = a.abs() + b.abs() + c.abs();
        let filled =
            (products[0] * above.reciprocal).abs() + (products[1] * below.reciprocal).abs();
        self.note(filled + p.abs(), row);
        let size = (a.abs() * above.size + c.abs() * below.size + row) * r.abs();
        let growth = self.growth;

        for (x, value) in self.x.iter().zip(value) {
            x[middle].set(value);
        }
        let mut next = [Back {
            x: value,
            size,
            most: size,
        }; 2];
        for (j, from) in starts.iter().enumerate().rev() {
            if j + 1 < starts.len() {
                self.eliminate(&mut before[j], *from, stop(j));
            }
            self.substitute(&mut next, *from, stop(j));
        }
        // A number that is not finite makes all rows after it so.
        let [above, below] = next;
        let finite = |x: &[f64]| x.iter().all(|x| x.is_finite());
        let sizes = [above.size, below.size];
        let found = Found {
            growth,
            size: match (finite(&sizes), ESTIMATE) {
                (true, true) => above.most.max(below.most),
                (false, true) => f64::INFINITY,
                (_, false) => 0.0,
            },
            sizes,
        };
        Some((finite(&above.x) && finite(&below.x), found))
    }
}

#[cfg(test)]
mod tests;

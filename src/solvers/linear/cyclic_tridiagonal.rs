//! Cyclic (periodic) tridiagonal systems.
//!
//! ```text
//! lower[i] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = d[i],   i = 0 .. n-1, indices mod n
//! ```
//!
//! All three slices have `n ≥ 3` entries; `lower[0]` multiplies `x[n-1]` and `upper[n-1]`
//! multiplies `x[0]`. With fewer than three unknowns the three coefficients of a row do not belong
//! to three unknowns, so such systems are refused.
//!
//! The sweep of the open system is carried on with one more column: `x_i = λ_i x_{i+1} + φ_i
//! x_{n-1} + η_i`, while the last row is eliminated alongside. That is Gaussian elimination without
//! pivoting of the matrix as it stands, hence as stable as the open sweep for dominant matrices;
//! no rank-one correction with a free parameter is involved.

use std::cell::Cell;

use super::tridiagonal::elimination::{Elimination, Shape};
use super::tridiagonal::{Bands, Rows, both_ends};
use super::tridiagonal::{TridiagonalError as Error, check_finite, check_length, check_pivot};

/// The factors of a cyclic tridiagonal matrix, without pivoting.
///
/// ```
/// use mechaudit_solvers::cyclic_tridiagonal::CyclicSweep;
/// let a = CyclicSweep::factor(&[1.0; 4], &[4.0; 4], &[1.0; 4])?;
/// let x = a.solve(&[6.0; 4])?;
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
pub type CyclicSweep = Elimination<Cyclic>;

/// The last row and the first are neighbours.
#[derive(Clone, Debug)]
pub struct Cyclic {
    /// `φ_i`, for rows 0 to n−2; `λ_i` are there for rows 0 to n−3.
    phi: Vec<f64>,
    /// Holds what is left of the last row in column i when it is eliminated, for columns 0 to n−2.
    last_row: Vec<f64>,
}

impl Shape for Cyclic {
    fn run(s: &Elimination<Self>, d: &mut [f64]) {
        let n = d.len();
        let mut last = d[n - 1];
        for i in 0..n - 1 {
            let before = if i > 0 { s.lower[i] * d[i - 1] } else { 0.0 };
            d[i] = (d[i] - before) / s.pivot[i];
            last -= s.shape.last_row[i] * d[i];
        }
        last /= s.pivot[n - 1];
        d[n - 1] = last;
        for i in (0..n - 1).rev() {
            let next = if i < n - 2 {
                s.lambda[i] * d[i + 1]
            } else {
                0.0
            };
            d[i] = (d[i] + s.shape.phi[i] * last) + next;
        }
    }

    fn run_transposed(s: &Elimination<Self>, d: &mut [f64]) {
        let n = d.len();
        let mut last = d[n - 1];
        for i in 0..n - 1 {
            if i > 0 {
                d[i] += s.lambda[i - 1] * d[i - 1];
            }
            last += s.shape.phi[i] * d[i];
        }
        last /= s.pivot[n - 1];
        d[n - 1] = last;
        for i in (0..n - 1).rev() {
            let below = if i < n - 2 {
                s.lower[i + 1] * d[i + 1]
            } else {
                0.0
            };
            d[i] = (d[i] - s.shape.last_row[i] * last - below) / s.pivot[i];
        }
    }
}

impl Elimination<Cyclic> {
    /// Factors the matrix.
    ///
    /// # Errors
    /// [`TridiagonalError`](Error): fewer than three rows, lengths that do not fit, an entry that
    /// is not finite, a pivot that is zero, subnormal or overflows.
    pub fn factor(lower: &[f64], diagonal: &[f64], upper: &[f64]) -> Result<CyclicSweep, Error> {
        let n = diagonal.len();
        if n < 3 {
            return Err(Error::TooFew { needed: 3, got: n });
        }
        check_length("lower", lower, n)?;
        check_length("upper", upper, n)?;
        check_finite("lower", lower)?;
        check_finite("diagonal", diagonal)?;
        check_finite("upper", upper)?;
        let sum = |a: f64, b: f64, c: f64| a.abs() + b.abs() + c.abs();
        let row_sums: Vec<f64> = (0..n)
            .map(|i| sum(lower[i], diagonal[i], upper[i]))
            .collect();
        let column = |i: usize| (upper[(i + n - 1) % n], lower[(i + 1) % n]);
        let norm_1 = (0..n)
            .map(|i| sum(column(i).0, diagonal[i], column(i).1))
            .fold(0.0, f64::max);
        let by_rows = (0..n).all(|i| diagonal[i].abs() >= lower[i].abs() + upper[i].abs());
        let by_columns = (0..n).all(|i| diagonal[i].abs() >= column(i).0.abs() + column(i).1.abs());
        let mut s = Elimination {
            lower: lower.to_vec(),
            pivot: Vec::with_capacity(n),
            lambda: Vec::with_capacity(n - 2),
            row_sums,
            norm_1,
            growth: 1.0,
            dominant: by_rows || by_columns,
            shape: Cyclic {
                phi: Vec::with_capacity(n - 1),
                last_row: Vec::with_capacity(n - 1),
            },
        };
        let mut corner = diagonal[n - 1];
        let mut corner_size = corner.abs();
        let mut left = upper[n - 1];
        for i in 0..n - 1 {
            // Column n−1 of row i, and column i of row n−1, with the entries of the band added
            // where the band meets them.
            let a = lower[i];
            let mut wide = if i == 0 { a } else { a * s.shape.phi[i - 1] };
            if i == n - 2 {
                wide += upper[i];
                left += lower[n - 1];
            }
            let fill = if i == 0 { 0.0 } else { a * s.lambda[i - 1] };
            let p = diagonal[i] + fill;
            check_pivot(i, p)?;
            let phi = -wide / p;
            let lambda = if i < n - 2 { -upper[i] / p } else { 0.0 };
            if !(phi.is_finite() && lambda.is_finite() && left.is_finite()) {
                return Err(Error::Pivot { row: i, value: p });
            }
            s.growth = s
                .growth
                .max((fill.abs() + p.abs() + wide.abs()) / s.row_sums[i]);
            corner_size += (left * phi).abs();
            corner += left * phi;
            s.shape.last_row.push(left);
            s.pivot.push(p);
            s.shape.phi.push(phi);
            if i < n - 2 {
                s.lambda.push(lambda);
                left *= lambda;
            }
        }
        check_pivot(n - 1, corner)?;
        s.growth = s.growth.max(corner_size / s.row_sums[n - 1]);
        s.pivot.push(corner);
        Ok(s)
    }
}

/// The rows of a cyclic matrix but for the last one, and the last unknown's column as a second
/// right-hand side.
struct Bordered<'a> {
    open: Bands<'a, [&'a [Cell<f64>]; 1]>,
    /// Its entries in the first and last row.
    column: [f64; 2],
}

impl Rows<2> for Bordered<'_> {
    fn len(&self) -> usize {
        self.open.diagonal.len()
    }
    #[inline(always)]
    fn row(&self, i: usize) -> ([f64; 3], [f64; 2]) {
        let (bands, [d]) = self.open.row(i);
        let [first, last] = self.column;
        let border = match i {
            0 => first,
            _ if i + 1 == Rows::len(self) => last,
            _ => 0.0,
        };
        (bands, [d, border])
    }
    #[inline(always)]
    fn four(&self, i: usize) -> ([[f64; 4]; 3], [[f64; 4]; 2]) {
        let (bands, [d]) = self.open.four(i);
        (bands, [d, [0.0; 4]])
    }
}

/// Solves one cyclic system whose right-hand side stands in `x`, and returns an estimate of the
/// error as [`solve_into_with_error`](super::tridiagonal::solve_into_with_error) has it, if it is
/// asked for. After an error the content of `x` is unspecified.
///
/// The rows but the last are eliminated from both ends at once, for the right-hand side and for the
/// column of the last unknown; the last row then has that unknown alone. Where a pivot of theirs
/// vanishes, [`CyclicSweep`] is tried before the system is refused.
///
/// ```
/// use mechaudit_solvers::cyclic_tridiagonal::solve_in_place;
/// let mut x = [6.0; 5];
/// solve_in_place(&[1.0; 5], &[4.0; 5], &[1.0; 5], &mut x, false)?;
/// assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`CyclicSweep::factor`](Elimination::factor) and [`CyclicSweep::solve`](Elimination::solve).
pub fn solve_in_place(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    x: &mut [f64],
    estimate: bool,
) -> Result<f64, Error> {
    let n = diagonal.len();
    let fits = n >= 3 && [lower.len(), upper.len(), x.len()] == [n; 3];
    // Nothing is written over before the other rows are known to be finite.
    let last = |v: &[f64]| v[n - 1].is_finite();
    if fits && last(lower) && last(diagonal) && last(upper) && last(x) {
        let cells: &[Cell<f64>] = Cell::from_mut(x).as_slice_of_cells();
        let found = match estimate {
            true => bordered::<true>([lower, diagonal, upper], cells)?,
            false => bordered::<false>([lower, diagonal, upper], cells)?,
        };
        if let Some(error) = found {
            return Ok(error);
        }
    }
    let sweep = CyclicSweep::factor(lower, diagonal, upper)?;
    sweep.solve_in_place(x)?;
    Ok(match estimate {
        true => sweep.stability().relative_error(),
        false => 0.0,
    })
}

/// Returns none, with `x` as it was, where a pivot of the rows but the last vanishes.
fn bordered<const ESTIMATE: bool>(
    [lower, diagonal, upper]: [&[f64]; 3],
    x: &[Cell<f64>],
) -> Result<Option<f64>, Error> {
    let last = x.len() - 1;
    let (inner, rest) = (&x[..last], x[last].get());
    let rows = Bordered {
        open: Bands {
            lower: &lower[1..last],
            diagonal: &diagonal[..last],
            upper: &upper[..last - 1],
            d: [inner],
        },
        column: [lower[0], upper[last - 1]],
    };
    let mut column = vec![0.0; last];
    let column: &[Cell<f64>] = Cell::from_mut(&mut column[..]).as_slice_of_cells();
    let found = both_ends::<ESTIMATE, 2, _>(&rows, [inner, column]).map_err(|e| match e {
        // Of the column: the last unknown is its factor.
        Error::Overflow { row } => Error::Overflow { row: row.min(last) },
        e => e,
    });
    let Some(found) = found? else {
        return Ok(None);
    };
    let (a, b, c) = (lower[last], diagonal[last], upper[last]);
    let [first_v, last_v] = [column[0].get(), column[last - 1].get()];
    let filled = [a * last_v, c * first_v];
    let corner = (b - filled[0]) - filled[1];
    check_pivot(last, corner)?;
    let z = ((rest - a * inner[last - 1].get()) - c * inner[0].get()) / corner;
    if !z.is_finite() {
        return Err(Error::Overflow { row: last });
    }
    let (mut widest, mut finite) = (0.0f64, 0.0);
    for (x, v) in inner.iter().zip(column) {
        let value = (-z).mul_add(v.get(), x.get());
        widest = widest.max(v.get().abs());
        finite += value * 0.0;
        x.set(value);
    }
    x[last].set(z);
    if let (true, Some(row)) = (finite != 0.0, x.iter().position(|x| !x.get().is_finite())) {
        return Err(Error::Overflow { row });
    }
    if !ESTIMATE {
        return Ok(Some(0.0));
    }
    let row = a.abs() + b.abs() + c.abs();
    let growth = (b.abs() + filled[0].abs() + filled[1].abs()) / row;
    // The unknown of the border, and the others with it.
    let size = (row + a.abs() * found.sizes[1] + c.abs() * found.sizes[0]) / corner.abs();
    let size = size.max(size.mul_add(widest, found.size));
    let growth = growth.max(found.growth * (1.0 + widest));
    Ok(Some(2.0 * f64::EPSILON * growth * size))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn product(l: &[f64], d: &[f64], u: &[f64], x: &[f64]) -> Vec<f64> {
        let n = x.len();
        (0..n)
            .map(|i| l[i] * x[(i + n - 1) % n] + d[i] * x[i] + u[i] * x[(i + 1) % n])
            .collect()
    }

    #[test]
    fn every_entry_is_in_its_place() {
        // Small integers: the products are exact, the solution is found to rounding.
        for n in 3..8 {
            let l: Vec<f64> = (0..n).map(|i| 1.0 + i as f64).collect();
            let u: Vec<f64> = (0..n).map(|i| 2.0 - i as f64).collect();
            let d: Vec<f64> = (0..n).map(|i| 20.0 + (i * i) as f64).collect();
            let x: Vec<f64> = (0..n).map(|i| i as f64 - 1.5).collect();
            let a = CyclicSweep::factor(&l, &d, &u).unwrap();
            let got = a.solve(&product(&l, &d, &u, &x)).unwrap();
            for (g, x) in got.iter().zip(&x) {
                assert!((g - x).abs() < 1e-13, "{n}: {got:?}");
            }
            // The transposed matrix has its bands exchanged and shifted.
            let lt: Vec<f64> = (0..n).map(|i| u[(i + n - 1) % n]).collect();
            let ut: Vec<f64> = (0..n).map(|i| l[(i + 1) % n]).collect();
            let mut got = product(&lt, &d, &ut, &x);
            Cyclic::run_transposed(&a, &mut got);
            for (g, x) in got.iter().zip(&x) {
                assert!((g - x).abs() < 1e-13, "{n} transposed: {got:?}");
            }
        }
    }

    /// One system at a time, as by the sweep; more rows than are kept.
    #[test]
    fn solved_in_place() {
        for n in (3..40).chain([8197, 8198, 20_001]) {
            let some = |k: usize| -> Vec<f64> {
                (0..n).map(|i| ((i * k + n) % 13) as f64 - 6.0).collect()
            };
            let (l, u, x) = (some(5), some(7), some(3));
            let d: Vec<f64> = some(11).iter().map(|v| v + 20.0).collect();
            let right = product(&l, &d, &u, &x);
            for estimate in [false, true] {
                let mut got = right.clone();
                let error = solve_in_place(&l, &d, &u, &mut got, estimate).unwrap();
                let off = got.iter().zip(&x).map(|(p, q)| (p - q).abs());
                assert!(off.fold(0.0, f64::max) < 1e-14, "{n}");
                if estimate {
                    let s = CyclicSweep::factor(&l, &d, &u).unwrap().stability();
                    let times = error / s.relative_error();
                    assert!((0.9..30.0).contains(&times), "{n}: {times}");
                }
            }
        }
        let solve = |l: &[f64], d: &[f64], u: &[f64], mut x: Vec<f64>| {
            solve_in_place(l, d, u, &mut x, true).map(|error| (x, error))
        };
        let e = solve(&[-1.0; 3], &[2.0; 3], &[-1.0; 3], vec![1.0; 3]);
        assert_eq!(e.unwrap_err(), Error::Pivot { row: 2, value: 0.0 });
        let e = solve(&[1.0; 2], &[4.0; 2], &[1.0; 2], vec![1.0; 2]);
        assert_eq!(e.unwrap_err(), Error::TooFew { needed: 3, got: 2 });
        for bad in [f64::NAN, f64::INFINITY] {
            for place in 0..4 {
                let mut d = vec![1.0; 4];
                d[place] = bad;
                let e = solve(&[1.0; 4], &[4.0; 4], &[1.0; 4], d.clone());
                assert!(matches!(e, Err(Error::NotFinite { index, .. }) if index == place));
                let e = solve(&[1.0; 4], &d, &[1.0; 4], vec![1.0; 4]);
                assert!(
                    matches!(e, Err(Error::NotFinite { name: "diagonal", index, .. }) if index == place)
                );
                let e = solve(&d, &[4.0; 4], &[1.0; 4], vec![1.0; 4]);
                assert!(
                    matches!(e, Err(Error::NotFinite { name: "lower", index, .. }) if index == place)
                );
            }
        }
        // A pivot that vanishes from above alone: by the sweep, which finds another that does.
        assert!(solve(&[1.0; 4], &[0.0, 4.0, 4.0, 4.0], &[1.0; 4], vec![1.0; 4]).is_err());
        // Nearly singular, and said so.
        let (_, error) = solve(&[-1.0; 9], &[2.0 + 1e-14; 9], &[-1.0; 9], vec![1.0; 9]).unwrap();
        assert!(error > 1e-2, "{error}");
    }

    #[test]
    fn typed_errors() {
        let e = CyclicSweep::factor(&[1.0; 2], &[4.0; 2], &[1.0; 2]).unwrap_err();
        assert_eq!(e, Error::TooFew { needed: 3, got: 2 });
        // −1, 2, −1 around the circle: constants are in the kernel.
        let e = CyclicSweep::factor(&[-1.0; 3], &[2.0; 3], &[-1.0; 3]).unwrap_err();
        assert_eq!(e, Error::Pivot { row: 2, value: 0.0 });
        // With more rows the pivots are rounded, and the evidence has to say so.
        if let Ok(a) = CyclicSweep::factor(&[-1.0; 7], &[2.0; 7], &[-1.0; 7]) {
            assert!(!a.stability().is_reliable());
        }
        assert!(CyclicSweep::factor(&[1.0; 4], &[4.0; 3], &[1.0; 3]).is_err());
        let a = CyclicSweep::factor(&[1.0; 3], &[4.0; 3], &[1.0; 3]).unwrap();
        assert!(a.is_dominant() && a.stability().is_reliable());
        assert!(a.solve(&[1.0, f64::NAN, 0.0]).is_err());
        assert!(a.solve(&[1.0]).is_err());
    }

    #[test]
    fn sums_of_rows_and_columns() {
        let (lower, diagonal) = ([1.0, -2.0, 4.0, 8.0], [16.0, -32.0, 64.0, 128.0]);
        let upper = [0.5, 0.25, -0.125, 0.0625];
        let s = CyclicSweep::factor(&lower, &diagonal, &upper).unwrap();
        assert_eq!(s.row_sums, [17.5, 34.25, 68.125, 136.0625]);
        // Column i: upper of the row before, diagonal, lower of the row after. The last: −⅛, 128, 1.
        assert_eq!(s.norm_1, 129.125);
        assert_eq!(
            (s.lambda.len(), s.shape.phi.len(), s.pivot.len()),
            (2, 3, 4)
        );
        for (at, due) in [(0, 18.0625), (1, 36.5), (2, 72.25), (3, 129.125)] {
            let mut d = [0.0; 4];
            d[at] = 512.0;
            for (i, d) in d.iter_mut().enumerate() {
                *d += diagonal[i];
            }
            let s = CyclicSweep::factor(&lower, &d, &upper).unwrap();
            assert_eq!(
                s.norm_1,
                due - diagonal[at].abs() + (512.0 + diagonal[at]).abs()
            );
        }
    }

    /// A multiplier that overflows is named by its row, whichever of the three it is.
    #[test]
    fn multipliers_that_overflow() {
        let row = |lower: [f64; 4], diagonal: [f64; 4], upper: [f64; 4]| match CyclicSweep::factor(
            &lower, &diagonal, &upper,
        ) {
            Err(Error::Pivot { row, .. }) => Some(row),
            Ok(_) => None,
            Err(other) => panic!("{other}"),
        };
        let d = [1e-10, 1.0, 1.0, 1.0];
        // The last column of row 0; its entry on the right; the first of the last row, times that.
        assert_eq!(row([1e300, 0.0, 0.0, 0.0], d, [0.0; 4]), Some(0));
        assert_eq!(row([0.0; 4], d, [1e300, 0.0, 0.0, 0.0]), Some(0));
        let left = [1e200, 0.0, 0.0, 1e200];
        assert_eq!(row([0.0; 4], [1.0; 4], left), Some(1));
        assert_eq!(row([0.0; 4], [1.0; 4], [1e100, 0.0, 0.0, 1e100]), None);
    }

    /// In the last row but one the entry on the right is part of the last column: where the two
    /// cancel nothing overflows.
    #[test]
    fn an_entry_that_cancels() {
        let s = CyclicSweep::factor(&[-1.0, -1e300, 1.0], &[1.0, 1e-10, 1.0], &[0.0, 1e300, 1.0]);
        let s = s.unwrap();
        assert_eq!((s.shape.phi, s.lambda.len()), (vec![1.0, -0.0], 1));
    }
}

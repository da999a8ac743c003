//! Tridiagonal systems.
//!
//! ```text
//! lower[i-1] x[i-1] + diagonal[i] x[i] + upper[i] x[i+1] = d[i],   i = 0 .. n-1
//! ```
//!
//! `diagonal` has `n ≥ 1` entries, `lower` and `upper` have `n − 1`.
//!
//! [`Sweep`] eliminates without pivoting (the sweep, or Thomas, algorithm): O(n), the right choice
//! for diagonally dominant matrices. [`Pivoted`] exchanges rows and is meant for the others.
//! [`solve`] runs the sweep and reports how far it can be trusted; [`solve_into`] solves one system
//! from both ends at once, several times as fast.
//!
//! # Source
//! Zinchenko 2008, eqs (18)–(20). There the middle coefficient carries a minus sign,
//! `a_i m_{i−1} − b_i m_i + c_i m_{i+1} = d_i`, so `b_i = −diagonal[i]`; the sweep is
//! `λ_{i+1} = c_i/(b_i − a_i λ_i)`, `η_{i+1} = (a_i η_i − d_i)/(b_i − a_i λ_i)`,
//! `m_i = λ_{i+1} m_{i+1} + η_{i+1}`. Three places of the print need correction: eq. (18) repeats
//! the index `i−1` in the middle term, Table 1 has `b_n = 1` where `−1` is meant, and
//! `λ_1 = η_1 = 0` holds only for `U_0 = 0` (row 0 gives `η_1 = U_0`).

mod batch;
pub(crate) mod elimination;
mod error;
mod one_shot;
mod pivoted;
mod stability;

pub use batch::solve_batch_in_place;
pub use elimination::Elimination;
use elimination::{SEVERAL, Shape, gather, scatter};
pub use error::TridiagonalError;
use error::TridiagonalError as Error;
use error::check_matrix;
pub(crate) use error::{check_finite, check_length, check_pivot};
pub(crate) use one_shot::{Bands, Rows, both_ends, solve_rows};
pub use one_shot::{solve_in_place, solve_into, solve_into_with_error, solve_many_in_place};
pub use pivoted::Pivoted;
pub use stability::Stability;

/// The factors of a tridiagonal matrix, without pivoting.
///
/// With the pivots `p_i = diagonal_i + lower_{i-1} λ_{i-1}` and `λ_i = −upper_i / p_i` a right-hand
/// side costs one pass up and one pass down:
/// `η_i = (d_i − lower_{i-1} η_{i-1}) / p_i`, `x_i = λ_i x_{i+1} + η_i`.
///
/// For a matrix that is diagonally dominant by rows or columns the computed solution solves a
/// system whose entries are off by a small multiple of the rounding unit (Higham, *Accuracy and
/// Stability of Numerical Algorithms*, 2nd ed., theorems 9.11–9.13). For other matrices
/// [`Sweep::stability`] tells.
///
/// ```
/// use mechaudit_solvers::tridiagonal::Sweep;
/// let a = Sweep::factor(&[1.0, 1.0], &[4.0, 4.0, 4.0], &[1.0, 1.0])?;
/// assert_eq!(a.solve(&[5.0, 6.0, 5.0])?, [1.0, 1.0, 1.0]);
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
pub type Sweep = Elimination<Open>;

/// The matrix ends with its first and last row.
#[derive(Clone, Copy, Debug)]
pub struct Open;

impl Shape for Open {
    fn run(s: &Elimination<Self>, d: &mut [f64]) {
        let n = d.len();
        d[0] /= s.pivot[0];
        for i in 1..n {
            d[i] = (d[i] - s.lower[i - 1] * d[i - 1]) / s.pivot[i];
        }
        for i in (0..n - 1).rev() {
            d[i] += s.lambda[i] * d[i + 1];
        }
    }

    fn run_several(s: &Elimination<Self>, d: &mut [f64], rows: &mut [[f64; SEVERAL]]) {
        gather(d, rows);
        let n = rows.len();
        let mut before = [0.0; SEVERAL];
        for (i, row) in rows.iter_mut().enumerate() {
            let (a, p) = (if i > 0 { s.lower[i - 1] } else { 0.0 }, s.pivot[i]);
            for (d, before) in row.iter_mut().zip(before) {
                // As for one of them: the first row has nothing to subtract.
                *d = if i > 0 { *d - a * before } else { *d } / p;
            }
            before = *row;
        }
        for i in (0..n - 1).rev() {
            let after = rows[i + 1];
            for (d, after) in rows[i].iter_mut().zip(after) {
                *d += s.lambda[i] * after;
            }
        }
        scatter(rows, d);
    }

    fn run_transposed(s: &Elimination<Self>, d: &mut [f64]) {
        let n = d.len();
        for i in 1..n {
            d[i] += s.lambda[i - 1] * d[i - 1];
        }
        d[n - 1] /= s.pivot[n - 1];
        for i in (0..n - 1).rev() {
            d[i] = (d[i] - s.lower[i] * d[i + 1]) / s.pivot[i];
        }
    }
}

impl Elimination<Open> {
    /// Factors the matrix.
    ///
    /// # Errors
    /// [`TridiagonalError`]: no rows, lengths that do not fit, an entry that is not finite, a
    /// pivot that is zero, subnormal or overflows.
    pub fn factor(
        lower: &[f64],
        diagonal: &[f64],
        upper: &[f64],
    ) -> Result<Sweep, TridiagonalError> {
        check_matrix(lower, diagonal, upper)?;
        let n = diagonal.len();
        let mut s = Elimination {
            lower: lower.to_vec(),
            pivot: Vec::with_capacity(n),
            lambda: Vec::with_capacity(n - 1),
            row_sums: Vec::with_capacity(n),
            norm_1: 0.0,
            growth: 1.0,
            dominant: true,
            shape: Open,
        };
        let mut by_columns = true;
        for i in 0..n {
            let a = if i > 0 { lower[i - 1] } else { 0.0 };
            let c = if i + 1 < n { upper[i] } else { 0.0 };
            let up = if i > 0 { upper[i - 1] } else { 0.0 };
            let down = if i + 1 < n { lower[i] } else { 0.0 };
            let b = diagonal[i];
            let fill = if i > 0 { a * s.lambda[i - 1] } else { 0.0 };
            let p = b + fill;
            check_pivot(i, p)?;
            if i + 1 < n {
                let lambda = -c / p;
                if !lambda.is_finite() {
                    return Err(Error::Pivot { row: i, value: p });
                }
                s.lambda.push(lambda);
            }
            s.pivot.push(p);
            let row = a.abs() + b.abs() + c.abs();
            let column = up.abs() + b.abs() + down.abs();
            s.row_sums.push(row);
            s.norm_1 = s.norm_1.max(column);
            s.growth = s.growth.max((fill.abs() + p.abs()) / row);
            s.dominant &= b.abs() >= a.abs() + c.abs();
            by_columns &= b.abs() >= up.abs() + down.abs();
        }
        s.dominant |= by_columns;
        Ok(s)
    }
}

/// A solution with the evidence for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// The unknowns.
    pub x: Vec<f64>,
    /// Their error bound and condition.
    pub stability: Stability,
}

/// Solves one system by the sweep and reports its stability.
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve;
/// // The first pivot is tiny: elimination without pivoting loses what row 0 said.
/// let s = solve(&[1.0], &[1e-20, 1.0], &[1.0], &[1.0, 2.0])?;
/// assert_eq!(s.x, [0.0, 1.0]); // the solution is [1, 1] to twenty digits
/// assert!(!s.stability.is_reliable());
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`Sweep::factor`] and [`Sweep::solve`].
pub fn solve(
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    d: &[f64],
) -> Result<Solution, TridiagonalError> {
    let sweep = Sweep::factor(lower, diagonal, upper)?;
    let x = sweep.solve(d)?;
    Ok(Solution {
        x,
        stability: sweep.stability(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_factors() {
        let s = Sweep::factor(
            &[1.0, -2.0, 4.0],
            &[8.0, -16.0, 32.0, 64.0],
            &[0.5, 0.25, -0.125],
        )
        .unwrap();
        assert_eq!(s.row_sums, [8.5, 17.25, 34.125, 68.0]);
        assert_eq!(s.norm_1, 64.125);
        assert_eq!((s.pivot.len(), s.lambda.len()), (4, 3));
        // With the largest column first, in the middle, and made by the entry below or above.
        for (lower, diagonal, upper, due) in [
            ([7.0, 1.0], [2.0, 3.0, 4.0], [1.0, 2.0], 9.0),
            ([1.0, 7.0], [2.0, 3.0, 4.0], [1.0, 2.0], 11.0),
            ([1.0, 2.0], [2.0, 3.0, 4.0], [7.0, 2.0], 12.0),
            ([1.0, 1.0], [2.0, 3.0, 4.0], [1.0, 7.0], 11.0),
        ] {
            assert_eq!(
                Sweep::factor(&lower, &diagonal, &upper).unwrap().norm_1,
                due
            );
        }
    }

    #[test]
    fn typed_errors() {
        let e = |l: &[f64], d: &[f64], u: &[f64]| Sweep::factor(l, d, u).unwrap_err();
        assert_eq!(e(&[], &[], &[]), Error::TooFew { needed: 1, got: 0 });
        let long = e(&[1.0], &[1.0], &[]);
        assert!(matches!(long, Error::Length { name: "lower", .. }));
        let nan = e(&[1.0], &[1.0, f64::NAN], &[1.0]);
        assert!(matches!(
            nan,
            Error::NotFinite {
                name: "diagonal",
                index: 1,
                ..
            }
        ));
        let zero = e(&[1.0, 1.0], &[1.0, 1.0, 1.0], &[1.0, 1.0]);
        assert_eq!(zero, Error::Pivot { row: 1, value: 0.0 });
        let a = Sweep::factor(&[], &[2f64.powi(-1000)], &[]).unwrap();
        assert_eq!(a.solve(&[1e300]), Err(Error::Overflow { row: 0 }));
        assert!(a.solve(&[1.0, 2.0]).is_err());
        assert!(a.solve(&[f64::INFINITY]).is_err());
        assert!(a.solve_many_in_place(&mut []).is_ok());
    }

    #[test]
    fn many_right_hand_sides_are_single_ones() {
        let a = Sweep::factor(&[1.0, -0.3], &[4.0, 5.0, 3.0], &[0.7, 1.0]).unwrap();
        let mut both = vec![1.0, 2.0, 3.0, -4.0, 0.5, 0.1];
        a.solve_many_in_place(&mut both).unwrap();
        assert_eq!(both[..3], a.solve(&[1.0, 2.0, 3.0]).unwrap());
        assert_eq!(both[3..], a.solve(&[-4.0, 0.5, 0.1]).unwrap());
        // Eight at a time, and what is left.
        let mut many: Vec<f64> = (0..3 * 21).map(|k| f64::from(k * k % 17) - 8.0).collect();
        let due: Vec<_> = many.chunks(3).map(|d| a.solve(d).unwrap()).collect();
        a.solve_many_in_place(&mut many).unwrap();
        assert_eq!(many, due.concat());
    }

    #[test]
    fn dominance_and_growth() {
        let a = Sweep::factor(&[1.0; 9], &[4.0; 10], &[1.0; 9]).unwrap();
        let s = a.stability();
        assert!(s.dominant && s.growth < 3.0 && s.is_reliable());
        assert!(s.rcond > 0.3 && s.skeel < 3.1);
        // Rows scaled apart: the norm-wise condition suffers, the one that counts does not.
        let a = Sweep::factor(&[1e200, 1.0], &[4.0, 4e200, 4.0], &[1.0, 1e200]).unwrap();
        let s = a.stability();
        assert!(s.rcond < 1e-190 && s.is_reliable(), "{s:?}");
    }
}

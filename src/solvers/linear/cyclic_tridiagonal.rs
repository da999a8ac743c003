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

use super::tridiagonal::elimination::{Elimination, Shape};
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

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

    proptest! {
        #[test]
        fn no_bits_panic(v in prop::collection::vec(any::<u64>(), 0..32)) {
            let v: Vec<f64> = v.into_iter().map(f64::from_bits).collect();
            let n = v.len() / 4;
            let parts: Vec<&[f64]> = (0..4).map(|k| &v[k * n..(k + 1) * n]).collect();
            if let Ok(a) = CyclicSweep::factor(parts[0], parts[1], parts[2]) {
                let _ = a.stability();
                if let Ok(x) = a.solve(parts[3]) {
                    prop_assert!(x.iter().all(|x| x.is_finite()));
                }
            }
        }
    }
}

#[cfg(test)]
mod factor_tests;

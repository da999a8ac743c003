//! Many systems of one size, eight side by side.

use super::elimination::SEVERAL;
use super::error::{TridiagonalError, check_length};
use super::one_shot::solve_in_place;
use crate::lanes::{Lanes, Task, with_best};

/// Solves systems of `n` unknowns that lie one after the other, `n` entries each in all four slices;
/// of each system the first entry of `lower` and the last one of `upper` are not used. The
/// right-hand sides stand in `x`, which the solutions replace. After an error its content is
/// unspecified.
///
/// Each is eliminated downwards without pivoting, and where a pivot vanishes as by
/// [`solve_into`](super::solve_into).
///
/// ```
/// use mechaudit_solvers::tridiagonal::solve_batch_in_place;
/// let mut x = [5.0, 6.0, 5.0, 1.0, 2.0, 3.0];
/// let diagonal = [4.0, 4.0, 4.0, 1.0, 1.0, 1.0];
/// let (lower, upper) = ([0.0, 1.0, 1.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]);
/// solve_batch_in_place(3, &lower, &diagonal, &upper, &mut x)?;
/// assert_eq!(x, [1.0, 1.0, 1.0, 1.0, 2.0, 3.0]);
/// # Ok::<(), mechaudit_solvers::tridiagonal::TridiagonalError>(())
/// ```
///
/// # Errors
/// As [`solve_into`](super::solve_into), with the place in the whole slice; lengths that differ or
/// are not a multiple of `n`.
pub fn solve_batch_in_place(
    n: usize,
    lower: &[f64],
    diagonal: &[f64],
    upper: &[f64],
    x: &mut [f64],
) -> Result<(), TridiagonalError> {
    if n == 0 {
        return Err(TridiagonalError::TooFew { needed: 1, got: 0 });
    }
    check_length("diagonal", diagonal, diagonal.len().div_ceil(n) * n)?;
    let all = diagonal.len();
    check_length("lower", lower, all)?;
    check_length("upper", upper, all)?;
    check_length("right-hand sides", x, all)?;
    let mut rows = vec![[[0.0; SEVERAL]; 2]; n];
    for (group, x) in x.chunks_mut(n * SEVERAL).enumerate() {
        let from = group * n * SEVERAL;
        let of = |v| -> &[f64] { &<[f64]>::split_at(v, from).1[..x.len()] };
        let bands = [of(lower), of(diagonal), of(upper)];
        let solved = with_best(Group {
            bands,
            x,
            rows: &mut rows,
        });
        if solved {
            continue;
        }
        for (k, x) in x.chunks_mut(n).enumerate() {
            let [a, b, c] = bands.map(|band| &band[k * n..(k + 1) * n]);
            let solved = solve_in_place(&a[1..], b, &c[..n - 1], x, false);
            // The slice without the first entry begins one further on.
            let skipped = |e: &TridiagonalError| {
                matches!(e, TridiagonalError::NotFinite { name: "lower", .. })
            };
            solved.map_err(|e| {
                let by = from + k * n + usize::from(skipped(&e));
                e.further(by)
            })?;
        }
    }
    Ok(())
}

/// As many systems as `x` has room for, at most [`SEVERAL`].
struct Group<'a> {
    bands: [&'a [f64]; 3],
    x: &'a mut [f64],
    /// For each row what the next unknown is multiplied with, negated, and the part of the solution
    /// without the unknowns to come.
    rows: &'a mut [[[f64; SEVERAL]; 2]],
}

impl Task for Group<'_> {
    /// Tells whether all systems are solved; if not, nothing is written.
    type Output = bool;
    #[inline(always)]
    fn run<L: Lanes>(self, _: L) -> bool {
        let n = self.rows.len();
        let systems = self.x.len() / n;
        // The last one again in the places that are left.
        let places: [usize; SEVERAL] = std::array::from_fn(|k| k.min(systems - 1) * n);
        let row =
            |v: &[f64], i: usize| -> [f64; SEVERAL] { std::array::from_fn(|k| v[places[k] + i]) };
        let zero = [0.0; SEVERAL];
        let (mut factor, mut eta, mut off) = (zero, zero, zero);
        let mut ok = true;
        for (i, kept) in self.rows.iter_mut().enumerate() {
            let [mut a, b, mut c] = self.bands.map(|band| row(band, i));
            let d = row(self.x, i);
            if i == 0 {
                a = zero;
            }
            if i + 1 == n {
                c = zero;
            }
            for k in 0..SEVERAL {
                let p = (-a[k]).mul_add(factor[k], b[k]);
                let r = 1.0 / p;
                ok &= (p.abs() >= f64::MIN_POSITIVE) & (r.abs() >= f64::MIN_POSITIVE);
                factor[k] = c[k] * r;
                eta[k] = (-a[k]).mul_add(eta[k], d[k]) * r;
                // Not zero where anything is not finite.
                off[k] += (factor[k] + eta[k]) * 0.0;
            }
            *kept = [factor, eta];
        }
        if !ok || off.iter().any(|off| *off != 0.0) {
            return false;
        }
        let mut x = zero;
        for [factor, eta] in self.rows.iter_mut().rev() {
            for k in 0..SEVERAL {
                x[k] = (-factor[k]).mul_add(x[k], eta[k]);
                off[k] += x[k] * 0.0;
            }
            *eta = x;
        }
        if off.iter().any(|off| *off != 0.0) {
            return false;
        }
        for (k, column) in self.x.chunks_exact_mut(n).enumerate() {
            for (x, [_, solution]) in column.iter_mut().zip(self.rows.iter()) {
                *x = solution[k];
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::super::{TridiagonalError as Error, solve_into};
    use super::*;
    use crate::arithmetic::tests::Random;

    /// As one by one, in groups and behind them.
    #[test]
    fn systems_side_by_side() {
        let mut random = Random(44);
        for n in [1, 2, 5, 30] {
            for systems in [0, 1, 7, 8, 9, 20] {
                let mut some = |low: f64, high: f64| -> Vec<f64> {
                    (0..n * systems)
                        .map(|_| random.between(low, high))
                        .collect()
                };
                let (lower, upper, d) = (some(-1.0, 1.0), some(-1.0, 1.0), some(-1.0, 1.0));
                let mut diagonal = some(2.0, 3.0);
                for singular in [false, true] {
                    if let (true, Some(first)) = (singular, diagonal.first_mut()) {
                        *first = 0.0;
                    }
                    let mut x = d.clone();
                    let solved = solve_batch_in_place(n, &lower, &diagonal, &upper, &mut x);
                    if singular && systems > 0 && n < 3 {
                        // From below the pivots do not vanish, but with one row or two.
                        assert!(n == 2 || matches!(solved, Err(Error::Pivot { row: 0, .. })));
                        continue;
                    }
                    let Ok(()) = solved else {
                        assert!(singular);
                        continue;
                    };
                    for k in 0..systems {
                        let at = k * n..(k + 1) * n;
                        let [a, b, c, d] = [&lower, &diagonal, &upper, &d].map(|v| &v[at.clone()]);
                        let mut due = vec![0.0; n];
                        solve_into(&a[1..], b, &c[..n - 1], d, &mut due).expect("solved");
                        for (x, due) in x[at].iter().zip(&due) {
                            assert!((x - due).abs() < 1e-13, "{n} {systems} {k}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn refused_with_the_place_in_all() {
        let solve = |diagonal: &[f64], mut x: Vec<f64>| {
            let other = vec![1.0; diagonal.len()];
            solve_batch_in_place(2, &other, diagonal, &other, &mut x).map(|()| x)
        };
        let mut diagonal = [4.0; 40];
        diagonal[25] = f64::NAN;
        let e = solve(&diagonal, vec![1.0; 40]).unwrap_err();
        assert!(matches!(
            e,
            Error::NotFinite {
                name: "diagonal",
                index: 25,
                ..
            }
        ));
        diagonal[25] = 4.0;
        let mut lower = [1.0; 40];
        lower[23] = f64::NAN;
        let e = solve_batch_in_place(2, &lower, &diagonal, &[1.0; 40], &mut [1.0; 40]);
        assert!(matches!(
            e,
            Err(Error::NotFinite {
                name: "lower",
                index: 23,
                ..
            })
        ));
        let mut d = vec![1.0; 40];
        d[39] = f64::INFINITY;
        let e = solve(&diagonal, d).unwrap_err();
        assert!(matches!(e, Error::NotFinite { index: 39, .. }));
        (diagonal[20], diagonal[21]) = (1.0, 1.0);
        assert!(matches!(
            solve(&diagonal, vec![1.0; 40]),
            Err(Error::Pivot { row: 21, .. })
        ));
        assert!(solve(&[4.0; 3], vec![1.0; 3]).is_err());
        assert!(solve(&[4.0; 4], vec![1.0; 3]).is_err());
        assert!(solve_batch_in_place(0, &[], &[], &[], &mut []).is_err());
        // The unused entries may be anything.
        let (mut lower, mut upper) = ([1.0; 4], [1.0; 4]);
        (lower[0], upper[3], lower[2], upper[1]) = (f64::NAN, 1e300, f64::INFINITY, f64::NAN);
        let mut x = [5.0; 4];
        solve_batch_in_place(2, &lower, &[4.0; 4], &upper, &mut x).expect("solved");
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-15));
    }
}

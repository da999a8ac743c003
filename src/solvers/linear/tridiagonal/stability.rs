//! Bounds of the errors of an elimination without pivoting.

/// Evidence about a factored matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stability {
    /// The largest of `(|L||U|)_ii / Σ_j |A_ij|`: the factor by which elimination enlarged the
    /// rows. At most 3 for a tridiagonal matrix that is dominant by rows.
    pub growth: f64,
    /// Tells whether the matrix is diagonally dominant by rows or by columns.
    pub dominant: bool,
    /// Estimate of `1 / (‖A‖₁ ‖A⁻¹‖₁)`; small also for rows of different scale, which do no harm.
    pub rcond: f64,
    /// Estimate of Skeel's condition `‖ |A⁻¹| |A| ‖_∞`, which does not depend on row scaling.
    pub skeel: f64,
}

impl Stability {
    /// `4 u · growth · skeel`: an estimate of the error of the solution relative to its largest
    /// entry. Not a bound: `skeel` is itself an estimate from below, seldom by more than a factor
    /// of three.
    pub fn relative_error(&self) -> f64 {
        2.0 * f64::EPSILON * self.growth * self.skeel
    }

    /// Returns whether at least half of the digits can be expected to be right:
    /// [`relative_error`](Stability::relative_error) below 2⁻²⁶.
    pub fn is_reliable(&self) -> bool {
        // Written so that NaN is not reliable.
        self.relative_error() < f64::EPSILON.sqrt()
    }
}

/// Hager's estimate of `‖B‖₁` as Higham improved it (*Accuracy and Stability of Numerical
/// Algorithms*, 2nd ed., algorithm 15.4): a lower bound from at most five products with `B` and
/// `Bᵀ` and one with a fixed vector of alternating signs. Infinite when a product overflows.
fn inverse_norm_1(
    n: usize,
    mut apply: impl FnMut(&mut [f64]),
    mut apply_transposed: impl FnMut(&mut [f64]),
) -> f64 {
    let norm = |v: &[f64]| v.iter().map(|x| x.abs()).sum::<f64>();
    let mut x = vec![1.0 / n as f64; n];
    let mut best = 0.0f64;
    let mut last = usize::MAX;
    for _ in 0..5 {
        let mut y = x.clone();
        apply(&mut y);
        let size = norm(&y);
        if !size.is_finite() {
            return f64::INFINITY;
        }
        best = best.max(size);
        let mut z: Vec<f64> = y.iter().map(|v| 1f64.copysign(*v)).collect();
        apply_transposed(&mut z);
        let Some((j, top)) = z
            .iter()
            .map(|v| v.abs())
            .enumerate()
            .max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            return best;
        };
        if !top.is_finite() {
            return f64::INFINITY;
        }
        let along: f64 = z.iter().zip(&x).map(|(a, b)| a * b).sum();
        if top <= along || j == last {
            break;
        }
        last = j;
        x.fill(0.0);
        x[j] = 1.0;
    }
    let step = 1.0 / (n.max(2) - 1) as f64;
    for (i, v) in x.iter_mut().enumerate() {
        let size = 1.0 + i as f64 * step;
        *v = if i % 2 == 0 { size } else { -size };
    }
    apply(&mut x);
    let size = 2.0 * norm(&x) / (3 * n) as f64;
    if size.is_finite() {
        best.max(size)
    } else {
        f64::INFINITY
    }
}

/// Gathers the evidence. `run` and `run_transposed` solve with `A` and `Aᵀ`.
pub(crate) fn stability(
    growth: f64,
    dominant: bool,
    norm_1: f64,
    row_sums: &[f64],
    run: impl Fn(&mut [f64]),
    run_transposed: impl Fn(&mut [f64]),
) -> Stability {
    let n = row_sums.len();
    let inverse = inverse_norm_1(n, &run, &run_transposed);
    let rcond = 1.0 / norm_1 / inverse;
    let scale = |v: &mut [f64]| {
        for (x, s) in v.iter_mut().zip(row_sums) {
            *x *= s;
        }
    };
    // ‖ |A⁻¹||A| ‖_∞ = ‖A⁻¹ D‖_∞ = ‖D A⁻ᵀ‖₁ with D the row sums of |A|.
    let skeel = inverse_norm_1(
        n,
        |v| {
            run_transposed(v);
            scale(v);
        },
        |v| {
            scale(v);
            run(v);
        },
    );
    Stability {
        growth,
        dominant,
        rcond,
        skeel,
    }
}

#[cfg(test)]
mod tests;

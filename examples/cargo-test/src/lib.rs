//! A crate that solves tridiagonal systems: the code that is audited in `tests/accuracy.rs`.

/// The solution of a tridiagonal system by elimination without pivoting; none where a pivot
/// vanishes.
///
/// `lower` and `upper` are one shorter than `diagonal` and `d`.
pub fn sweep(lower: &[f64], diagonal: &[f64], upper: &[f64], d: &[f64]) -> Option<Vec<f64>> {
    let (mut pivots, mut x) = (diagonal.to_vec(), d.to_vec());
    for i in 0..x.len() {
        if i > 0 {
            let factor = lower[i - 1] / pivots[i - 1];
            pivots[i] -= factor * upper[i - 1];
            x[i] -= factor * x[i - 1];
        }
        if pivots[i] == 0.0 {
            return None;
        }
    }
    for i in (0..x.len()).rev() {
        if i + 1 < x.len() {
            x[i] -= upper[i] * x[i + 1];
        }
        x[i] /= pivots[i];
    }
    Some(x)
}

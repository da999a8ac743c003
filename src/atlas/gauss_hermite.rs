//! Nodes and weights of Gauss's formula for `∫ e^{−t²} f(t) dt`.

use crate::elementary::SQRT_PI;

/// The positive nodes of the formula with an even number `n` of nodes, ascending, with their
/// weights.
///
/// Changes of sign of the orthonormal Hermite polynomial `h_n` (DLMF 18.3) on a lattice finer than
/// its nodes, each refined by Newton's method; `w_k = 1/(n h_{n−1}(t_k)²)` (DLMF 3.5.22 with
/// `h_n' = √(2n) h_{n−1}`). The nodes of n = 12 are those that Humlíček prints.
pub fn positive(n: usize) -> Vec<(f64, f64)> {
    let mut found: Vec<(f64, f64)> = Vec::new();
    let end = ((2 * n + 1) as f64).sqrt();
    // Signs change at every node; nodes are at least π/(2√(2n+1)) apart.
    let step = 0.25 / end;
    let mut left = 0.0;
    while found.len() < n / 2 && left < end {
        let right = left + step;
        if (orthonormal(n, left).0 > 0.0) != (orthonormal(n, right).0 > 0.0) {
            found.push(refined(n, left, right));
        }
        left = right;
    }
    found
}

/// The orthonormal Hermite polynomials of degrees `n` and `n − 1` (without the Gaussian).
fn orthonormal(n: usize, t: f64) -> (f64, f64) {
    let (mut before, mut now) = (0.0, 1.0 / SQRT_PI.sqrt());
    for k in 0..n {
        let j = k as f64;
        let next = t * (2.0 / (j + 1.0)).sqrt() * now - (j / (j + 1.0)).sqrt() * before;
        (before, now) = (now, next);
    }
    (now, before)
}

fn refined(n: usize, left: f64, right: f64) -> (f64, f64) {
    let mut t = 0.5 * (left + right);
    for _ in 0..60 {
        let (h, before) = orthonormal(n, t);
        // h_n' = √(2n) h_{n−1}.
        let next = t - h / ((2 * n) as f64).sqrt() / before;
        if next == t {
            break;
        }
        t = next.clamp(left, right);
    }
    let (_, before) = orthonormal(n, t);
    (t, 1.0 / (n as f64 * before * before))
}

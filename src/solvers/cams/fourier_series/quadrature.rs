//! Gauss–Legendre quadrature with 20 nodes.

use num_complex::Complex64;
use std::sync::LazyLock;

const NODES: usize = 20;

/// Positive nodes on (−1, 1) with their weights.
static RULE: LazyLock<[(f64, f64); NODES / 2]> = LazyLock::new(|| {
    std::array::from_fn(|i| {
        let n = NODES as f64;
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 0.0;
        // Newton from Tricomi's estimate converges in four steps.
        for _ in 0..6 {
            let (mut before, mut p) = (1.0, x);
            for k in 1..NODES {
                let k = k as f64;
                (before, p) = (p, ((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0));
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    })
});

/// `∫ f` from `a` to `b`.
pub(super) fn integral(a: f64, b: f64, mut f: impl FnMut(f64) -> Complex64) -> Complex64 {
    let half = 0.5 * (b - a);
    let mut sum = Complex64::ZERO;
    for &(node, weight) in RULE.iter() {
        let offset = half * (1.0 - node);
        sum += (f(a + offset) + f(b - offset)) * weight;
    }
    sum * half
}

#[cfg(test)]
mod tests {
    use super::integral;
    use num_complex::Complex64;

    #[test]
    fn polynomials_and_exponentials() {
        let p = integral(0.0, 2.0, |x| Complex64::from(x.powi(39)));
        assert!((p.re / (2f64.powi(40) / 40.0) - 1.0).abs() < 1e-13);
        let e = integral(-1.0, 1.0, |x| Complex64::cis(6.0 * x));
        assert!((e.re - 6f64.sin() / 3.0).abs() < 1e-15 && e.im.abs() < 1e-15);
    }
}

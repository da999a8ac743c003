//! Means of errors, with their intervals.

use serde::Serialize;

/// A mean with what it is known to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Mean {
    /// The sample's mean.
    pub mean: f64,
    /// Four standard errors: the half-width of the interval. By the central limit theorem it misses
    /// the mean once in 16,000 samples; where a few points carry the mean it may miss it more
    /// often.
    pub within: f64,
    /// The sample.
    pub points: u64,
}

/// Of a sample.
pub fn mean(errors: &[f64]) -> Mean {
    let n = errors.len() as f64;
    let mean = errors.iter().sum::<f64>() / n;
    let squares: f64 = errors.iter().map(|e| (e - mean) * (e - mean)).sum();
    Mean {
        mean,
        within: 4.0 * (squares / (n - 1.0).max(1.0) / n).sqrt(),
        points: errors.len() as u64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_one_and_two() {
        assert_eq!(mean(&[3.0]).within, 0.0);
        // The standard error of two values is half their distance.
        assert_eq!(mean(&[0.0, 1.0]).within, 2.0);
    }

    #[test]
    fn of_a_uniform_sample() {
        let errors: Vec<f64> = (0..1000).map(|k| f64::from(k) / 999.0).collect();
        let m = mean(&errors);
        assert!((m.mean - 0.5).abs() < 1e-12);
        // √(1/12/1000) four times.
        assert!((m.within - 4.0 * (1.0f64 / 12000.0).sqrt()).abs() < 1e-4);
    }
}

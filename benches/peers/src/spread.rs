//! Worst, 99th percentile and root mean square of many errors in constant memory.

use num_complex::Complex64;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// Bins to an octave: a percentile is at most 1.1 % above the true one.
const BINS: f64 = 64.0;

/// The distribution of an error over the points.
#[derive(Clone, Debug, Default)]
pub struct Spread {
    count: u64,
    worst: f64,
    worst_at: Complex64,
    /// Sum of the squares of the errors divided by `scale`, the largest error.
    squares: f64,
    scale: f64,
    bins: BTreeMap<i32, u64>,
}

impl Spread {
    /// Adds an error, not NaN, found at `z`.
    pub fn add(&mut self, error: f64, z: Complex64) {
        if self.count == 0 || error > self.worst {
            self.worst = error;
            self.worst_at = z;
        }
        self.count += 1;
        self.add_squares(1.0, error);
        // Zero goes into the lowest bin, infinity into the highest: the cast saturates.
        let bin = (error.log2() * BINS).ceil() as i32;
        *self.bins.entry(bin).or_default() += 1;
    }

    /// Adds all errors of `other`.
    pub fn merge(&mut self, other: &Spread) {
        if other.count > 0 && (self.count == 0 || other.worst > self.worst) {
            self.worst = other.worst;
            self.worst_at = other.worst_at;
        }
        self.count += other.count;
        self.add_squares(other.squares, other.scale);
        for (&bin, n) in &other.bins {
            *self.bins.entry(bin).or_default() += n;
        }
    }

    /// Adds `squares scale²` without overflow.
    fn add_squares(&mut self, squares: f64, scale: f64) {
        if !(scale > 0.0) {
            return;
        }
        if scale > self.scale {
            self.squares *= (self.scale / scale).powi(2);
            self.scale = scale;
        }
        // One infinity makes it infinite.
        self.squares += match scale.is_infinite() {
            true => f64::INFINITY,
            false => squares * (scale / self.scale).powi(2),
        };
    }

    /// The largest found; NaN without any.
    pub fn worst(&self) -> f64 {
        if self.count == 0 {
            f64::NAN
        } else {
            self.worst
        }
    }

    /// Root mean square; NaN without any.
    pub fn rms(&self) -> f64 {
        let mean = self.squares / self.count as f64;
        if mean == 0.0 {
            return 0.0;
        }
        self.scale * mean.sqrt()
    }

    /// The 99th percentile (nearest rank): the upper edge of its bin; NaN without any.
    pub fn p99(&self) -> f64 {
        let rank = (self.count * 99).div_ceil(100);
        let mut below = 0;
        for (&bin, n) in &self.bins {
            below += n;
            if below >= rank {
                return (f64::from(bin) / BINS).exp2().min(self.worst);
            }
        }
        f64::NAN
    }
}

impl Serialize for Spread {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Summary {
            worst: f64,
            p99: f64,
            rms: f64,
            worst_at: [String; 2],
        }
        let hex = mechaudit::audit::hex_float;
        let summary = Summary {
            worst: self.worst(),
            p99: self.p99(),
            rms: self.rms(),
            worst_at: [hex(self.worst_at.re), hex(self.worst_at.im)],
        };
        summary.serialize(serializer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_to_a_thousand() {
        let mut whole = Spread::default();
        let mut parts = [Spread::default(), Spread::default()];
        for i in 1..=1000 {
            let z = Complex64::new(f64::from(i), 0.0);
            whole.add(f64::from(i), z);
            parts[i as usize % 2].add(f64::from(i), z);
        }
        let [mut a, b] = parts;
        a.merge(&b);
        for s in [&whole, &a] {
            assert_eq!((s.worst(), s.worst_at.re), (1000.0, 1000.0));
            assert!((990.0..1001.0).contains(&s.p99()));
            assert!((s.rms() - 333_833.5f64.sqrt()).abs() < 1e-9);
        }
    }

    #[test]
    fn zero_infinity_and_nothing() {
        let mut s = Spread::default();
        assert!(s.worst().is_nan() && s.p99().is_nan() && s.rms().is_nan());
        s.add(0.0, Complex64::ZERO);
        assert_eq!((s.worst(), s.p99(), s.rms()), (0.0, 0.0, 0.0));
        s.add(f64::INFINITY, Complex64::ONE);
        assert_eq!([s.worst(), s.p99(), s.rms()], [f64::INFINITY; 3]);
    }

    #[test]
    fn huge_errors_have_a_mean() {
        let mut s = Spread::default();
        let mut t = Spread::default();
        s.add(3e300, Complex64::ONE);
        t.add(4e300, Complex64::ONE);
        s.merge(&t);
        assert!((s.rms() / (12.5f64.sqrt() * 1e300) - 1.0).abs() < 1e-12);
    }
}

//! The regions compared, and the points drawn in them.

use mechaudit::audit::Draw;
use num_complex::Complex64;
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// A region of the plane with its sampler.
pub struct Region {
    /// One letter.
    pub name: &'static str,
    /// Describes the set of points.
    pub description: &'static str,
    sample: fn(&mut Draw) -> Complex64,
}

/// The first five zeros of W in the fourth quadrant, each component to within half an ulp; the
/// others are their mirror images `−z̄`.
pub const ZEROS: [(f64, f64); 5] = [
    (1.9914668428338795, -1.3548101281120062),
    (2.691149024251439, -2.1770449060896158),
    (3.2353308683528166, -2.7843876132304284),
    (3.6973097024684685, -3.2874107893898485),
    (4.106107284682632, -3.7259487194457903),
];

/// All regions.
pub const REGIONS: [Region; 7] = [
    Region {
        name: "a",
        description: "|z| log-uniform in 1e-8..1e8, any angle, Im z > 0",
        sample: |d| Complex64::from_polar(d.log_uniform(1e-8, 1e8), PI * open_unit(d)),
    },
    Region {
        name: "b",
        description: "square |Re z| <= 8, 0 <= Im z <= 8",
        sample: |d| Complex64::new(d.uniform(-8.0, 8.0), d.uniform(0.0, 8.0)),
    },
    Region {
        name: "c",
        description: "disc |z| < 1, uniform",
        sample: |d| Complex64::from_polar(d.unit().sqrt(), TAU * d.unit()),
    },
    Region {
        name: "d",
        description: "below the real axis: |Re z| <= 8, -6 <= Im z < 0",
        sample: |d| Complex64::new(d.uniform(-8.0, 8.0), -6.0 * open_unit(d)),
    },
    Region {
        name: "e",
        description: "diagonal rays (1-i)(s+i|s|r), |z| log-uniform in 0.01..1e4, r in 0..0.1, half log-uniform",
        sample: |d| {
            // Beside the ray itself the residue 2 e^{-z²} counts at every |z|.
            let r = match d.chance(0.5) {
                true => d.uniform(0.0, 0.1),
                false => d.log_uniform(1e-10, 0.1),
            };
            let length = d.log_uniform(1e-2, 1e4);
            let s = d.signed(length * FRAC_1_SQRT_2 / (1.0 + r * r).sqrt());
            let n = s.abs() * r;
            Complex64::new(s + n, n - s)
        },
    },
    Region {
        name: "f",
        description: "at 1e-12..1e-1 (log-uniform) from one of the first five zeros of W",
        sample: |d| {
            let (x, y) = ZEROS[d.integer(0, ZEROS.len() - 1)];
            let step = Complex64::from_polar(d.log_uniform(1e-12, 1e-1), TAU * d.unit());
            Complex64::new(x, y) + step
        },
    },
    Region {
        name: "g",
        description: "beside the real axis: Im z log-uniform in 1e-300..1e-1, 0 <= Re z < 30",
        sample: |d| Complex64::new(d.uniform(0.0, 30.0), d.log_uniform(1e-300, 1e-1)),
    },
];

/// Uniform on the open interval (0, 1).
fn open_unit(d: &mut Draw) -> f64 {
    loop {
        let u = d.unit();
        if u > 0.0 {
            return u;
        }
    }
}

impl Region {
    /// The points with numbers `first..first + count`. Each has a random stream of its own, so
    /// they depend neither on the other regions nor on the number of threads.
    pub fn points(&self, seed: u64, first: u64, count: usize) -> Vec<Complex64> {
        (first..first + count as u64)
            .map(|i| (self.sample)(&mut Draw::new(seed, "faddeeva.w", self.name, i)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(name: &str, holds: impl Fn(Complex64) -> bool) {
        let region = REGIONS.iter().find(|r| r.name == name).unwrap();
        for z in region.points(1, 0, 20_000) {
            assert!(
                z.re.is_finite() && z.im.is_finite() && holds(z),
                "{name}: {z}"
            );
        }
    }

    #[test]
    fn the_points_are_where_they_are_said_to_be() {
        all("a", |z| z.im > 0.0 && (0.99e-8..1.01e8).contains(&z.norm()));
        all("b", |z| z.re.abs() <= 8.0 && (0.0..=8.0).contains(&z.im));
        all("c", |z| z.norm() < 1.0);
        all("d", |z| z.re.abs() <= 8.0 && (-6.0..0.0).contains(&z.im));
        all("e", |z| {
            (0.0099..1.01e4).contains(&z.norm()) && z.re * z.im < 0.0
        });
        all("f", |z| {
            ZEROS
                .iter()
                .any(|&(x, y)| (z - Complex64::new(x, y)).norm() < 0.11)
        });
        all("g", |z| {
            (0.0..30.0).contains(&z.re) && (0.99e-300..0.11).contains(&z.im)
        });
    }

    #[test]
    fn a_point_does_not_depend_on_where_the_block_starts() {
        let whole = REGIONS[1].points(3, 0, 10);
        assert_eq!(whole[4..7], REGIONS[1].points(3, 4, 3));
        assert_ne!(whole, REGIONS[1].points(4, 0, 10));
    }
}

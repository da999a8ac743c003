//! Where the Voigt profile is audited.

use crate::audit::{CheckPoint, Draw, Region};
use crate::methods::common::{point, region};
use crate::methods::special::faddeeva::regions::{beside, listed_seams, seam};
use crate::solvers::faddeeva::{LIMITS_OF_VOIGT, SEAMS};
use std::sync::LazyLock;

/// Half the widths, normalised: `σ`, and x and γ in units of `σ√2`.
fn in_widths(p: f64, q: f64, d: &mut Draw) -> Vec<f64> {
    let sigma = d.log_uniform(1e-3, 1e3);
    let unit = sigma * std::f64::consts::SQRT_2;
    vec![d.signed(p * unit), sigma, q * unit]
}

/// Any bits, mostly not negative.
pub(in crate::methods::special) fn any_bits(negative: f64, d: &mut Draw) -> f64 {
    let x = d.any_bits();
    if d.chance(negative) { x } else { x.abs() }
}

/// The lines of W on which x may lie, and the function's own limits, in units of `σ√2`.
static UPRIGHT: LazyLock<Vec<f64>> = LazyLock::new(|| [SEAMS.re, &LIMITS_OF_VOIGT].concat());
/// The same of γ.
static LEVEL: LazyLock<Vec<f64>> = LazyLock::new(|| [SEAMS.im, &LIMITS_OF_VOIGT].concat());

static ON_SEAMS: LazyLock<String> = LazyLock::new(|| {
    format!(
        "x is {}, or gamma is {} times sigma sqrt 2, exactly or nearly",
        listed_seams(&UPRIGHT),
        listed_seams(&LEVEL)
    )
});

/// The regions.
pub(super) fn all() -> Vec<Region> {
    vec![
        region("comparable", "|x| < 12, sigma = 0.05..2, gamma < 3", |d| {
            vec![
                d.uniform(-12.0, 12.0),
                d.uniform(0.05, 2.0),
                d.uniform(0.0, 3.0),
            ]
        }),
        region(
            "narrow-lorentz",
            "|x| < 40, sigma = 0.5..2, gamma = 1e-320..1",
            |d| {
                vec![
                    d.uniform(-40.0, 40.0),
                    d.uniform(0.5, 2.0),
                    d.log_uniform(1e-320, 1.0),
                ]
            },
        ),
        region(
            "narrow-gauss",
            "|x| < 5, sigma = 1e-320..1, gamma = 0.1..2",
            |d| {
                vec![
                    d.uniform(-5.0, 5.0),
                    d.log_uniform(1e-320, 1.0),
                    d.uniform(0.1, 2.0),
                ]
            },
        ),
        region("normal", "gamma = 0, |x| < 40 sigma", |d| {
            in_widths(d.uniform(0.0, 28.3), 0.0, d)
        }),
        region("cauchy", "sigma = 0, x and gamma 1e-308..1e308", |d| {
            let (x, g) = (d.log_uniform(1e-308, 1e308), d.log_uniform(1e-308, 1e308));
            let x = if d.chance(0.5) { x } else { beside(g, d) };
            vec![d.signed(x), 0.0, g]
        }),
        region("centre", "x = 0, sigma and gamma 1e-300..1e300", |d| {
            let (s, g) = (d.log_uniform(1e-300, 1e300), d.log_uniform(1e-300, 1e300));
            match d.chance(0.5) {
                true => vec![0.0, s, g],
                false => vec![0.0, s, s * d.uniform(0.0, 9.0)],
            }
        }),
        region(
            "where-the-wings-meet",
            "the wing of the normal part is 1e-4..1e4 times that of the Cauchy part",
            |d| {
                let p = d.uniform(1.5, 26.0);
                let ratio = d.log_uniform(1e-4, 1e4);
                let q = std::f64::consts::PI.sqrt() * p * p * libm::exp(-p * p) * ratio;
                in_widths(p, q, d)
            },
        ),
        region(
            "wings",
            "|x| = 7..1e12 sigma, gamma = 1e-300..1e12 sigma",
            |d| in_widths(d.log_uniform(5.0, 1e12), d.log_uniform(1e-300, 1e12), d),
        ),
        region("seams", &ON_SEAMS, |d| {
            let of_x = d.chance(0.5);
            let edge = beside(seam(if of_x { &UPRIGHT } else { &LEVEL }, d), d);
            let other = d.uniform_or_log(0.5, [0.0, 30.0], [1e-20, 1e9]);
            match of_x {
                true => in_widths(edge, other, d),
                false => in_widths(other, edge, d),
            }
        }),
        region(
            "underflow",
            "|x| = 37..39.5 sigma, where the normal part underflows, gamma = 0 or 1e-323..1e-290",
            |d| {
                let p = d.uniform(26.2, 28.0);
                in_widths(p, d.zero_or_log(0.3, 1e-323, 1e-290), d)
            },
        ),
        region(
            "overflow",
            "sigma and gamma 5e-324..1e-304 or zero, |x| likewise",
            |d| {
                let mut tiny = || d.zero_or_log(0.25, 5e-324, 1e-304);
                let (x, s, g) = (tiny(), tiny(), tiny());
                vec![d.signed(x), s, g]
            },
        ),
        region("all-sizes", "x, sigma, gamma = 1e-100..1e100", |d| {
            let mut size = || d.log_uniform(1e-100, 1e100);
            let (x, s, g) = (size(), size(), size());
            vec![d.signed(x), s, g]
        }),
        region("any-exponent", "x, sigma, gamma = 1e-308..1e308", |d| {
            let mut size = || d.log_uniform(1e-308, 1e308);
            let (x, s, g) = (size(), size(), size());
            vec![d.signed(x), s, g]
        }),
        region(
            "any-bits",
            "any bit patterns, widths seldom negative",
            |d| vec![any_bits(1.0, d), any_bits(0.05, d), any_bits(0.05, d)],
        ),
    ]
}

/// Special arguments.
pub(super) fn check_points() -> Vec<CheckPoint> {
    let (inf, nan, max, min) = (f64::INFINITY, f64::NAN, f64::MAX, f64::from_bits(1));
    let named = [
        ("standard-normal", [0.0, 1.0, 0.0]),
        ("standard-cauchy", [0.0, 0.0, 1.0]),
        ("both", [1.0, 1.0, 1.0]),
        ("cauchy-off-centre", [-1.0, 0.0, 1.0]),
        ("point-mass", [0.0, 0.0, 0.0]),
        ("beside-a-point-mass", [min, 0.0, 0.0]),
        ("minus-zero-widths", [0.0, -0.0, -0.0]),
        ("smallest-widths", [0.0, min, min]),
        ("smallest-gamma", [3.0, 1.0, min]),
        ("smallest-sigma", [3.0, min, 1.0]),
        ("smallest-everything", [min, min, min]),
        ("largest-everything", [max, max, max]),
        ("largest-x", [max, 1.0, 1.0]),
        ("largest-x-smallest-widths", [max, min, min]),
        ("largest-sigma", [1.0, max, 0.0]),
        ("largest-gamma", [1.0, 0.0, max]),
        ("last-of-the-normal", [38.56, 1.0, 0.0]),
        ("gone-of-the-normal", [38.7, 1.0, 0.0]),
        ("infinite-x", [inf, 1.0, 1.0]),
        ("minus-infinite-x", [-inf, 0.0, 0.0]),
        ("infinite-sigma", [0.0, inf, 1.0]),
        ("infinite-gamma", [0.0, 1.0, inf]),
        ("negative-sigma", [0.0, -1.0, 1.0]),
        ("negative-gamma", [0.0, 1.0, -min]),
        ("minus-infinite-sigma", [0.0, -inf, 1.0]),
        ("nan-x", [nan, 1.0, 1.0]),
        ("nan-sigma", [0.0, nan, 1.0]),
        ("nan-gamma", [0.0, 1.0, nan]),
        ("nan-x-infinite-sigma", [nan, inf, 1.0]),
    ];
    named.map(|(name, input)| point(name, input)).to_vec()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::methods::special::faddeeva::regions::seams;
    use std::f64::consts::SQRT_2;

    /// x or γ on a seam is found there in units of σ√2.
    #[test]
    fn every_seam_is_drawn() {
        let all = all();
        let region = all.iter().find(|r| r.name == "seams").unwrap();
        let drawn: Vec<Vec<f64>> = (0..16_000)
            .map(|k| (region.sample)(&mut Draw::new(1, "voigt", "seams", k)))
            .collect();
        for (place, lines) in [(0, &UPRIGHT), (2, &LEVEL)] {
            for expected in seams(lines) {
                let near =
                    |x: &&Vec<f64>| (x[place].abs() / x[1] / SQRT_2 / expected - 1.0).abs() < 1e-6;
                let count = drawn.iter().filter(near).count();
                assert!(count > 40, "{expected} at {place}: {count}");
            }
        }
    }
}

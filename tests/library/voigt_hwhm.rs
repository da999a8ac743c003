//! The width of the Voigt profile beside its certified reference.

use mechaudit::reference::faddeeva as reference;
use mechaudit::solvers::faddeeva::voigt_hwhm;
use rug::{Float, Rational};

/// Units in the last place between a value and its certified one.
fn ulps(got: f64, sigma: f64, gamma: f64) -> f64 {
    let [s, g] = [sigma, gamma].map(|x| Rational::from_f64(x).expect("finite"));
    let due = reference::voigt_hwhm(&s, &g, 100).expect("decided");
    let unit = got.next_up() - got;
    (Float::with_val(200, due.mid() - got) / unit)
        .abs()
        .to_f64()
}

struct Random(u64);

impl Random {
    /// Uniform between 0 and 1 (SplitMix64).
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
    fn power(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(low + (high - low) * self.unit())
    }
}

/// The worst of `points` ratios of the widths from `10^low` to `10^high`, and where.
fn worst(points: usize, low: f64, high: f64) -> (f64, [f64; 2]) {
    let mut r = Random((high - low) as u64);
    let mut worst = (0.0, [0.0; 2]);
    for _ in 0..points {
        let sigma = r.power(-2.0, 2.0);
        let gamma = sigma * r.power(low, high);
        let u = ulps(voigt_hwhm(sigma, gamma), sigma, gamma);
        if !(u <= worst.0) {
            worst = (u, [sigma, gamma]);
        }
    }
    worst
}

const RATIOS: [(f64, f64); 4] = [(-19.0, -3.0), (-3.0, 0.0), (0.0, 3.0), (3.0, 20.0)];

#[test]
fn of_any_ratio() {
    for (low, high) in RATIOS {
        let found = worst(1000, low, high);
        assert!(found.0 <= 0.7, "{low}..{high}: {found:?}");
    }
}

#[test]
#[ignore = "half a minute; prints what the documentation says"]
fn table() {
    for (low, high) in RATIOS {
        println!("10^{low}..10^{high}: {:?}", worst(100_000, low, high));
    }
}

#[test]
fn scales_by_powers_of_two_without_rounding() {
    let x = voigt_hwhm(1.25, 0.75);
    for k in [-1000, -320, 320, 1000] {
        let p = 2f64.powi(k);
        assert_eq!(voigt_hwhm(1.25 * p, 0.75 * p), x * p, "2^{k}");
    }
}

#[test]
fn limits_and_refusals() {
    let (inf, nan, max) = (f64::INFINITY, f64::NAN, f64::MAX);
    for (sigma, gamma, due) in [
        (0.0, 0.0, 0.0),
        (-0.0, -0.0, 0.0),
        (0.0, 5e-324, 5e-324),
        (0.0, max, max),
        (5e-324, max, max),
        (max, 0.0, inf),
        (max, max, inf),
        (inf, 0.0, inf),
        (0.0, inf, inf),
    ] {
        let got = voigt_hwhm(sigma, gamma);
        assert_eq!(
            got.to_bits(),
            f64::to_bits(due),
            "{sigma:e}, {gamma:e}: {got:e}"
        );
    }
    for (sigma, gamma) in [
        (-1.0, 1.0),
        (1.0, -1.0),
        (nan, 0.0),
        (0.0, nan),
        (nan, inf),
        (inf, nan),
        (-inf, inf),
    ] {
        assert!(voigt_hwhm(sigma, gamma).is_nan(), "{sigma:e}, {gamma:e}");
    }
}

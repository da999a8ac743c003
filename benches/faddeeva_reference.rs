//! The certified Faddeeva function: a thousand points of a region, at several precisions.
//!
//! `cargo bench --bench faddeeva_reference`. Items are values, both components certified.
//! `benches/compare_flint.py` sets them beside python-flint.

use divan::Bencher;
use divan::counter::ItemsCount;
use mechaudit::reference::faddeeva;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rug::Rational;

fn main() {
    divan::main();
}

fn points(count: usize, x: (f64, f64), y: (f64, f64)) -> Vec<(f64, f64)> {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut uniform =
        move |(a, b): (f64, f64)| a + (b - a) * (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
    (0..count).map(|_| (uniform(x), uniform(y))).collect()
}

fn values(bencher: Bencher, bits: u32, points: &[(f64, f64)]) {
    bencher.counter(ItemsCount::new(points.len())).bench(|| {
        for &(x, y) in points {
            divan::black_box(faddeeva::w_f64(x, y, bits).expect("decided"));
        }
    });
}

/// The square |Re z| < 8, 0 < Im z < 8.
#[divan::bench(args = [70, 100, 333, 3322])]
fn square(bencher: Bencher, bits: u32) {
    let count = if bits > 1000 { 20 } else { 1000 };
    values(bencher, bits, &points(count, (-8.0, 8.0), (0.0, 8.0)));
}

/// The lower half-plane, |Re z| < 8, −6 < Im z < 0.
#[divan::bench(args = [70, 100, 333, 3322])]
fn below(bencher: Bencher, bits: u32) {
    let count = if bits > 1000 { 20 } else { 1000 };
    values(bencher, bits, &points(count, (-8.0, 8.0), (-6.0, 0.0)));
}

/// Far out, |z| up to 10^4.
#[divan::bench(args = [70, 100, 333, 3322])]
fn far(bencher: Bencher, bits: u32) {
    let count = if bits > 1000 { 20 } else { 1000 };
    values(bencher, bits, &points(count, (-1e4, 1e4), (0.0, 1e4)));
}

/// Thirty Taylor coefficients in the middle.
#[divan::bench]
fn taylor(bencher: Bencher) {
    let (x, y) = (Rational::from((5, 2)), Rational::from((3, 4)));
    bencher.bench(|| faddeeva::taylor(&x, &y, 30, 130).expect("decided"));
}

/// The first zero to thirty digits.
#[divan::bench]
fn zero(bencher: Bencher) {
    bencher.bench(|| faddeeva::zero(1, 100).expect("certified"));
}

//! Time for a value, all codes in turn.

use mechaudit_atlas::Algorithm;
use num_complex::Complex;
use std::hint::black_box;
use std::time::Instant;

/// Points, and how often each code gets them; the fastest round counts.
const POINTS: usize = 2000;
const ROUNDS: usize = 7;

/// Nanoseconds a value at points of the ordinary region, on one core, each code in each round.
pub fn nanoseconds(algorithms: &[Algorithm]) -> Vec<f64> {
    let points: Vec<Complex<f64>> = (0..POINTS)
        .map(|k| {
            // The golden ratio's multiples, which fill the square evenly.
            let t = k as f64 * 0.618_033_988_749_895;
            Complex::new(8.0 * (t - t.floor()), 0.1 + 7.9 * k as f64 / POINTS as f64)
        })
        .collect();
    let mut best = vec![f64::INFINITY; algorithms.len()];
    for _ in 0..ROUNDS {
        for (a, best) in algorithms.iter().zip(&mut best) {
            let start = Instant::now();
            for &z in &points {
                black_box((a.w)(black_box(z)));
            }
            let each = start.elapsed().as_secs_f64() * 1e9 / POINTS as f64;
            *best = best.min(each);
        }
    }
    best
}

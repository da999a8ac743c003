//! Time for a value, all codes in turn.

use super::lines;
use crate::audit::Draw;
use mechaudit_atlas::{Algorithm, Line, Profile};
use num_complex::Complex;
use std::hint::black_box;
use std::time::Instant;

/// Points, and how often each code gets them; the fastest round counts.
const POINTS: usize = 2000;
const ROUNDS: usize = 7;

/// Nanoseconds a value at points of the ordinary region, on one core, each code in each round.
pub fn nanoseconds(algorithms: &[Algorithm]) -> Vec<f64> {
    let points: Vec<Complex<f64>> = (0..POINTS).map(point).collect();
    in_turn(algorithms, &points, |a, z| (a.w)(z))
}

/// One of those that fill the square evenly, by multiples of the golden ratio.
fn point(k: usize) -> Complex<f64> {
    let t = k as f64 * 0.618_033_988_749_895;
    Complex::new(8.0 * (t - t.floor()), 0.1 + 7.9 * k as f64 / POINTS as f64)
}

/// Of profiles, likewise, at lines without shifts and correlation, which all of them have.
pub fn nanoseconds_of_lines(profiles: &[Profile]) -> Vec<f64> {
    let points: Vec<Line> = (0..POINTS as u64)
        .map(|k| lines::line(&lines::any_simple(&mut Draw::new(1, "atlas", "speed", k))))
        .collect();
    in_turn(profiles, &points, |p, line| (p.value)(&line))
}

fn in_turn<C, P: Copy, V>(codes: &[C], points: &[P], value: impl Fn(&C, P) -> V) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; codes.len()];
    for _ in 0..ROUNDS {
        for (code, best) in codes.iter().zip(&mut best) {
            let start = Instant::now();
            for &p in points {
                black_box(value(code, black_box(p)));
            }
            let each = start.elapsed().as_secs_f64() * 1e9 / points.len() as f64;
            *best = best.min(each);
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 2000 points in 64 squares each gets 31 or so.
    #[test]
    fn points_fill_the_square() {
        let mut counts = [0; 64];
        for z in (0..POINTS).map(point) {
            let [row, column] = [(z.im - 0.1) / 7.9 * 8.0, z.re].map(|x| x as usize);
            counts[8 * row + column] += 1;
        }
        assert!(counts.iter().all(|n| (28..35).contains(n)), "{counts:?}");
    }

    /// Codes that sleep.
    #[test]
    fn the_time_is_that_of_one_value() {
        let sleep = |microseconds: &u64, _: u8| {
            std::thread::sleep(std::time::Duration::from_micros(*microseconds));
        };
        let found = in_turn(&[200, 2000], &[0; 4], sleep);
        // No sleep is shorter than it was asked for.
        assert!(found[0] >= 2e5 && found[1] >= 2e6, "{found:?}");
        assert!(found.iter().all(|t| t.is_finite()), "{found:?}");
    }

    #[test]
    fn each_code_and_profile_has_a_time() {
        let algorithms =
            ["humlicek-1982", "wells-1999-r4"].map(|n| mechaudit_atlas::find(n).unwrap());
        let found = nanoseconds(&algorithms);
        assert!(found.len() == 2 && found.iter().all(|t| *t > 0.0 && t.is_finite()));
        let found = nanoseconds_of_lines(&mechaudit_atlas::PROFILES[..1]);
        assert!(found.len() == 1 && found[0] > 0.0 && found[0].is_finite());
    }
}

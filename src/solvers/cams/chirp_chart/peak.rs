//! The largest value of a function on an interval.

/// Steps of the golden section: an interval of two samples shrinks to 1e-5 of itself.
const STEPS: usize = 24;
/// What a sample may lie below the largest one for the peak beside it to be looked at. With eight
/// samples in the shortest period a peak is at most 1 − cos(π/8) = 7.6 % above its samples.
const MARGIN: f64 = 0.85;
/// The largest peaks among the samples are looked at, this many.
const MOST: usize = 64;

/// Place and value of the largest `|f|` given its values at equally spaced `places`.
pub(super) fn largest(places: &[f64], values: &[f64], f: impl Fn(f64) -> f64) -> (f64, f64) {
    let size = |i: usize| values[i].abs();
    let top = (0..values.len()).max_by(|&a, &b| size(a).total_cmp(&size(b)));
    let Some(top) = top else {
        return (f64::NAN, f64::NAN);
    };
    let mut best = (places[top], size(top));
    let last = values.len() - 1;
    let beside = |i: usize| (i.saturating_sub(1), (i + 1).min(last));
    let is_peak = |&i: &usize| {
        let (left, right) = beside(i);
        size(i) >= size(left) && size(i) >= size(right) && size(i) >= MARGIN * size(top)
    };
    let mut peaks: Vec<usize> = (0..=last).filter(is_peak).collect();
    peaks.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
    for &i in peaks.iter().take(MOST) {
        let (left, right) = beside(i);
        let found = golden(places[left], places[right], |x| f(x).abs());
        if found.1 > best.1 {
            best = found;
        }
    }
    best
}

/// The peak of a function with one peak between `a` and `b`.
fn golden(mut a: f64, mut b: f64, f: impl Fn(f64) -> f64) -> (f64, f64) {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let mut x = [b - ratio * (b - a), a + ratio * (b - a)];
    let mut y = x.map(&f);
    for _ in 0..STEPS {
        if y[0] > y[1] {
            b = x[1];
            x = [b - ratio * (b - a), x[0]];
            y = [f(x[0]), y[0]];
        } else {
            a = x[0];
            x = [x[1], a + ratio * (b - a)];
            y = [y[1], f(x[1])];
        }
    }
    if y[0] > y[1] {
        (x[0], y[0])
    } else {
        (x[1], y[1])
    }
}

#[cfg(test)]
mod tests {
    use super::{golden, largest};
    use std::cell::RefCell;

    #[test]
    fn a_peak_between_the_samples_is_found() {
        // The larger of two peaks lies between samples, the smaller one on a sample.
        let f = |x: f64| (8.0 * x).cos() + 0.3 * x.sin();
        let places: Vec<f64> = (0..=20).map(|i| f64::from(i) * 0.11).collect();
        let values: Vec<f64> = places.iter().map(|&x| f(x)).collect();
        let fine = (0..200_000)
            .map(|i| f(f64::from(i) * 1.1e-5).abs())
            .fold(0.0, f64::max);
        let (x, value) = largest(&places, &values, f);
        assert!((value - fine).abs() < 1e-8, "{x} {value} {fine}");
        assert!(values.iter().all(|v| v.abs() < value));
    }

    fn found(step: f64, last: usize, f: impl Fn(f64) -> f64) -> (f64, f64) {
        let places: Vec<f64> = (0..=last).map(|i| step * i as f64).collect();
        let values: Vec<f64> = places.iter().map(|&x| f(x)).collect();
        largest(&places, &values, f)
    }

    #[test]
    fn the_higher_peak_with_the_lower_samples() {
        // One peak of 1 on a sample, one of 1.05 half way between two of 0.99.
        let bump = |x: f64, at: f64, h: f64| h * (1.0 - 0.23 * (x - at).powi(2)).max(0.0);
        for sign in [1.0, -1.0] {
            let (x, y) = found(1.0, 30, |x| {
                sign * (bump(x, 5.0, 1.0) + bump(x, 20.5, 1.05))
            });
            assert!(
                (x - 20.5).abs() < 1e-4 && (y - 1.05).abs() < 1e-9,
                "{x} {y}"
            );
            let (x, y) = found(1.0, 30, |x| {
                sign * (bump(x, 20.0, 1.0) + bump(x, 5.5, 1.05))
            });
            assert!((x - 5.5).abs() < 1e-4 && (y - 1.05).abs() < 1e-9, "{x} {y}");
        }
    }

    /// Nothing that was looked at is larger than what is found, whatever the function.
    #[test]
    fn the_largest_of_all_that_was_looked_at() {
        let seen = RefCell::new(Vec::new());
        let peak = |at: f64| move |x: f64| 1.0 - (x - at).abs();
        for place in 0..=20 {
            let f = peak(0.05 * f64::from(place));
            seen.borrow_mut().clear();
            let watched = |x: f64| {
                seen.borrow_mut().push((x, f(x)));
                f(x)
            };
            let found = golden(0.0, 1.0, watched);
            let top = seen
                .borrow()
                .iter()
                .map(|s| s.1)
                .fold(f64::NEG_INFINITY, f64::max);
            assert_eq!(found.1, top);
            assert!(seen.borrow().contains(&found));
            assert_eq!(seen.borrow().len(), 26);
        }
    }

    /// Where nothing beside it is larger it is the sample.
    #[test]
    fn a_level_function_has_its_peak_on_a_sample() {
        assert_eq!(found(1.0, 4, |_| 2.0), (4.0, 2.0));
        assert_eq!(found(1.0, 4, |_| -2.0), (4.0, 2.0));
    }

    /// Whatever the size of the function.
    #[test]
    fn small_peaks_between_samples() {
        for size in [1e-6, 1.0, 1e6] {
            let (x, y) = found(1.0, 9, |x| size * (1.0 - 0.01 * (x - 4.5).powi(2)));
            assert!((x - 4.5).abs() < 1e-4 && (y / size - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_peak_at_an_end() {
        assert_eq!(found(0.5, 8, |x| x * x), (4.0, 16.0));
        assert_eq!(found(0.5, 8, |x| x - 7.0), (0.0, 7.0));
        // Half a step from an end.
        let (x, y) = found(1.0, 9, |x| 99.0 - (x - 8.6).powi(2));
        assert!((x - 8.6).abs() < 1e-4 && (y - 99.0).abs() < 1e-8, "{x} {y}");
        let (x, y) = largest(&[], &[], |x| x);
        assert!(x.is_nan() && y.is_nan());
    }
}

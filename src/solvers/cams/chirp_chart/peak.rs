//! The largest value of a function on an interval.

/// Samples in the shortest period.
const SAMPLES: f64 = 8.0;
/// States what a parabola through a sample and its neighbours, π/4 of phase apart, may be off by
/// between them, as a part of the largest value M: `|f‴| ≤ M` by phase (Bernstein), so it is at
/// most `(π/4)³/(9√3)`.
const OFF: f64 = 0.0311;
/// The largest peaks among the samples are looked at, this many at most.
const MOST: usize = 64;
/// The part of an interval of two samples within which a peak is found.
const NEAR: f64 = 1e-5;
/// Evaluations for a peak, at most.
const STEPS: usize = 60;
/// The smaller part of a golden section.
const GOLDEN: f64 = 0.381_966_011_250_105_1;

/// Place and value of the largest `|f|` given its values at equally spaced `places`, eight in the
/// shortest period.
pub(super) fn largest(places: &[f64], values: &[f64], f: impl Fn(f64) -> f64) -> (f64, f64) {
    let size = |i: usize| values[i].abs();
    let top = (0..values.len()).max_by(|&a, &b| size(a).total_cmp(&size(b)));
    let Some(top) = top else {
        return (f64::NAN, f64::NAN);
    };
    let mut best = (places[top], size(top));
    let last = values.len() - 1;
    let beside = |i: usize| (i.saturating_sub(1), (i + 1).min(last));
    // The largest value is at most half a sample from one, whose cosine it is larger by.
    let most = size(top) / (std::f64::consts::PI / SAMPLES).cos();
    // About the height of the peak by a sample.
    let height = |i: usize| {
        let (left, right) = beside(i);
        if left == i || right == i {
            return most;
        }
        // Of the function that is positive here; beside a low peak it may change its sign.
        let [before, after] = [left, right].map(|k| values[k] * values[i].signum());
        let bend = 2.0 * size(i) - before - after;
        let slope = after - before;
        match bend > 0.0 {
            true => size(i) + slope * slope / (8.0 * bend),
            false => size(i),
        }
    };
    let is_peak = |i: &usize| {
        let (left, right) = beside(*i);
        size(*i) >= size(left) && size(*i) >= size(right)
    };
    let peaks = (0..=last).filter(is_peak).map(|i| (i, height(i)));
    let mut peaks: Vec<(usize, f64)> = peaks.collect();
    peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
    for (i, height) in peaks.into_iter().take(MOST) {
        if height + OFF * most <= best.1 {
            break;
        }
        let (left, right) = beside(i);
        let around = [left, i, right].map(|k| (places[k], size(k)));
        let found = peak(around, |x| f(x).abs());
        if found.1 > best.1 {
            best = found;
        }
    }
    best
}

/// The peak of a function with one peak between the outer two of three points, of which the one
/// between them is the highest; by parabolas through the last three points, and by golden section
/// where they lead nowhere (R. P. Brent, *Algorithms for Minimization without Derivatives*, 1973,
/// chapter 5).
fn peak([first, middle, last]: [(f64, f64); 3], f: impl Fn(f64) -> f64) -> (f64, f64) {
    let (mut a, mut b) = (first.0, last.0);
    let least = NEAR * (b - a);
    // The highest, the second and the one before it.
    let (mut x, mut w, mut v) = match first.1 > last.1 {
        true => (middle, first, last),
        false => (middle, last, first),
    };
    let (mut step, mut before) = (b - a, b - a);
    for _ in 0..STEPS {
        let centre = 0.5 * (a + b);
        if (x.0 - centre).abs() <= 2.0 * least - 0.5 * (b - a) {
            break;
        }
        let r = (x.0 - w.0) * (v.1 - x.1);
        let q = (x.0 - v.0) * (w.1 - x.1);
        let (p, q) = ((x.0 - v.0) * q - (x.0 - w.0) * r, 2.0 * (r - q));
        let to = p / q;
        if to.abs() < 0.5 * before.abs() && x.0 + to > a && x.0 + to < b {
            (before, step) = (step, to);
        } else {
            before = if x.0 >= centre { a - x.0 } else { b - x.0 };
            step = GOLDEN * before;
        }
        let at = x.0 + step.abs().max(least).copysign(step);
        let u = (at, f(at));
        if u.1 >= x.1 {
            *(if at >= x.0 { &mut a } else { &mut b }) = x.0;
            (v, w, x) = (w, x, u);
            continue;
        }
        *(if at < x.0 { &mut a } else { &mut b }) = at;
        if u.1 >= w.1 || w.0 == x.0 {
            (v, w) = (w, u);
        } else if u.1 >= v.1 || v.0 == x.0 || v.0 == w.0 {
            v = u;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::{STEPS, largest, peak};
    use std::cell::RefCell;

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

    /// Nothing that was looked at is larger than what is found, whatever the function; a smooth
    /// peak takes few looks.
    #[test]
    fn the_largest_of_all_that_was_looked_at() {
        let seen = RefCell::new(Vec::new());
        let sharp = |at: f64| move |x: f64| 1.0 - (x - at).abs();
        let smooth = |at: f64| move |x: f64| (0.7 * (x - at)).cos();
        for place in 0..=20 {
            // The sample between the two others is the highest.
            let at = 0.25 + 0.025 * f64::from(place);
            for (f, looks) in [
                (&sharp(at) as &dyn Fn(f64) -> f64, STEPS),
                (&smooth(at), 10),
            ] {
                seen.borrow_mut().clear();
                let around = [0.0, 0.5, 1.0].map(|x| (x, f(x)));
                let found = peak(around, |x| {
                    seen.borrow_mut().push((x, f(x)));
                    f(x)
                });
                let seen = seen.borrow();
                let all = seen.iter().chain(&around);
                let top = all.map(|s| s.1).fold(f64::NEG_INFINITY, f64::max);
                assert_eq!(found.1, top);
                assert!(seen.contains(&found) || around.contains(&found));
                assert!(seen.len() <= looks, "{} for {at}", seen.len());
                assert!((found.0 - at).abs() < 3e-5, "{found:?} for {at}");
            }
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

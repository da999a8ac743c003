//! Steps of the continuation: limits, radius and prediction.

use super::super::tests::{paper, zinchenko};
use super::*;

#[test]
fn the_largest_angles() {
    for sign in [1.0, -1.0] {
        assert_eq!(checked(sign * 1e6), Ok(()));
        let phi1 = sign * 1e6f64.next_up();
        assert_eq!(checked(phi1), Err(ContinuationError::TooFar { phi1 }));
    }
}

/// `½ K r² − r/β + l1 |s| = 0`: its larger root is the radius (Kantorovich & Akilov).
#[test]
fn the_radius_of_the_only_solution() {
    // h = 4 · 3 · ½ · 1/16 = ⅜: (1 + ½)/6.
    assert_eq!(unique_radius(2.0, 3.0, 0.5, 0.0625), 0.25);
    assert_eq!(unique_radius(2.0, 3.0, 0.5, -0.0625), 0.25);
    assert_eq!(unique_radius(2.0, 4.0, 0.5, 0.0), 0.25);
    for (beta, k, l1) in [(0.7, 0.3, 1.5), (3.0, 7.0, 0.1), (20.0, 1.86, 0.1)] {
        let longest = longest_step(beta, k, l1);
        assert!((beta * beta * k * l1 * longest - 0.49).abs() < 1e-15);
        for step in [0.1 * longest, -0.5 * longest, longest] {
            let r = unique_radius(beta, k, l1, step);
            let off = 0.5 * k * r * r - r / beta + l1 * step.abs();
            assert!(
                off.abs() < 1e-15 * (r / beta + 1.0),
                "{beta} {k} {l1}: {off}"
            );
            assert!(r > 1.0 / (beta * k));
        }
    }
}

/// Off by the third power of the step.
#[test]
fn predictions() {
    let linkage = zinchenko();
    let start = paper(0.3);
    for h in [0.02, -0.02] {
        let off = |h: f64| {
            let there = linkage
                .follow(&start, Angle::from_rad(0.3 + h))
                .expect("a state");
            predicted(&start, 0.3 + h).distance(there.positions)
        };
        let ratio = off(h) / off(0.5 * h);
        assert!((ratio - 8.0).abs() < 0.5, "{h}: {ratio}");
    }
    let r = start.rates;
    let there = predicted(&start, 0.3 + 0.25).to_array();
    for (i, here) in start.positions.to_array().into_iter().enumerate() {
        let due = here + 0.25 * r.first[i] + 0.03125 * r.second[i];
        assert!((there[i] - due).abs() < 1e-15);
    }
}

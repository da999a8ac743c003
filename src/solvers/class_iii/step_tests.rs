//! Steps of the continuation: limits, radius and prediction.

use super::super::tests::zinchenko;
use super::*;

#[test]
fn the_largest_angles() {
    for sign in [1.0, -1.0] {
        assert_eq!(checked(sign * 1e6), Ok(()));
        let phi1 = sign * 1e6f64.next_up();
        assert_eq!(checked(phi1), Err(ContinuationError::TooFar { phi1 }));
    }
}

/// The larger root of `½ βK r² − r + h/(βK) = 0` (Kantorovich & Akilov).
#[test]
fn the_radius_of_the_only_solution() {
    assert_eq!(unique_radius(0.0, 4.0), 0.5);
    assert_eq!(unique_radius(0.375, 4.0), 0.375);
    assert_eq!(unique_radius(0.5, 4.0), 0.25);
    for (h, k) in [(0.1, 0.3), (0.25, 7.0), (0.49, 1.5)] {
        let r = unique_radius(h, k);
        assert!((0.5 * k * r * r - r + h / k).abs() < 1e-15, "{h} {k}");
        assert!(r > 1.0 / k);
    }
}

/// Off by the third power of the step.
#[test]
fn predictions() {
    let linkage = zinchenko();
    let mode = linkage.assembly_modes(0.3).modes[2];
    let start = linkage.state_near(0.3, mode).expect("a state");
    for h in [0.02, -0.02] {
        let off = |h: f64| {
            let there = linkage.follow(&start, 0.3 + h).expect("a state");
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

//! Times and peaks of a turn.

use super::*;
use crate::cam_law::{MotionLaw, Stroke};

fn drive(omega0: f64, eps: f64) -> CamDrive {
    let quarter = || Stroke {
        law: MotionLaw::modified_sine(),
        turns: 0.25,
    };
    let cycle = CamCycle::new(2.0, quarter(), 0.25, quarter(), 0.25);
    CamDrive {
        oscillator: Oscillator::new(8.0, 0.4).expect("an oscillator"),
        cycle: cycle.expect("a cycle"),
        chirp: Chirp { omega0, eps },
    }
}

/// An eighth of the shortest period apart, 200 at least and 20 000 at most.
#[test]
fn places_of_samples() {
    let spacing = |times: [f64; 2], fastest: f64, count: usize| {
        let places = places(times, fastest);
        assert_eq!(places.len(), count + 1);
        let step = (times[1] - times[0]) / count as f64;
        for (i, place) in places.iter().enumerate() {
            let due = times[0] + step * i as f64;
            assert!((place - due).abs() < 1e-14, "{i}: {place} {due}");
        }
    };
    // Two seconds of a hundred periods each, and of a hundred and a bit.
    spacing([3.0, 5.0], 100.0 * TAU, 1600);
    spacing([3.0, 5.0], 100.01 * TAU, 1601);
    spacing([3.0, 5.0], 10.0 * TAU, 200);
    spacing([3.0, 5.0], 12.5 * TAU, 200);
    spacing([3.0, 5.0], 13.01 * TAU, 209);
    spacing([3.0, 5.0], 1e4 * TAU, 20_000);
}

#[test]
fn the_highest_frequency() {
    let r = CamResponse::new(drive(2.0, 0.5), 6, None).expect("a response");
    assert_eq!(r.fastest([0.0, 2.0]), 18.0);
    assert_eq!(r.fastest([-10.0, 0.0]), 18.0);
    assert_eq!(r.fastest([-5.0, -4.0]), 8.0);
}

/// Checks that what is found is not below any state in the turn, and hardly above the largest.
#[test]
fn peaks_of_a_turn() {
    let r = CamResponse::new(drive(2.0, 0.5), 6, None).expect("a response");
    let peaks = r.peaks(4.0);
    let [from, to] = peaks.times;
    let times: Vec<f64> = (0..=3000)
        .map(|k| from + (to - from) * f64::from(k) / 3000.0)
        .collect();
    let states = r.states(&times);
    assert_eq!(states.len(), times.len());
    let top = |of: &dyn Fn(&State) -> f64| states.iter().map(|s| of(s).abs()).fold(0.0, f64::max);
    for (found, due) in [
        (peaks.displacement, top(&|s| s.displacement - r.mean())),
        (peaks.acceleration, top(&|s| s.acceleration)),
        (peaks.moment, top(&|s| s.acceleration * s.cam_rate)),
        (peaks.power, top(&|s| s.velocity * s.acceleration)),
    ] {
        let above = found / due - 1.0;
        assert!((-1e-12..1e-4).contains(&above), "{found} {due}");
    }
}

/// States that are refused are zero, the others are not.
#[test]
fn states_at_refused_times() {
    let r = CamResponse::new(drive(2.0, 0.5), 3, None).expect("a response");
    let states = r.states(&[1.0, -1.0, 2.0]);
    assert_eq!(states[1], State::default());
    assert_eq!(states[0], r.state(1.0).expect("a state"));
    assert_eq!(states[2], r.state(2.0).expect("a state"));
}

/// A criterion of zero belongs to no speed. The return half a turn ahead is ahead.
#[test]
fn seams_of_a_turn() {
    let xi = 0.0;
    let refused = Err(ChirpChartError::Criterion { xi });
    assert_eq!(drive(2.0, 0.5).time_of(xi, Period::Turn), refused);
    let r = CamResponse::new(drive(2.0, 0.0), 3, None).expect("a response");
    let t = r.end_of_dwell(0.0).expect("a dwell");
    assert!((t - 0.25 * TAU).abs() < 1e-15, "{t}");
}

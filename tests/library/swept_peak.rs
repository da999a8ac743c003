//! Peaks of an oscillator under a linear sweep: what Reed & Kabe (The Mathematica Journal 21, 2019)
//! say of them. Their curves are printed as pictures only, so that their shape is checked here, not
//! values: the peak is attenuated when the sweep begins beside or above the natural frequency, and
//! over the sweep rate it is scalloped, because the largest swing moves from one half-cycle to the
//! next; and a swept response can exceed the stationary one.

use mechaudit::solvers::chirp_oscillator::{
    Chirp, ChirpResponse, Harmonic, InitialState, Motion, Oscillator,
};
use std::f64::consts::FRAC_PI_2;

const ZETA: f64 = 0.01;

/// The largest `|y|` for w = 1 and rate `eps` from the frequency `start`, and the number of the
/// half-cycle of the excitation in which it falls.
fn peak(start: f64, eps: f64) -> (f64, i64) {
    let chirp = Chirp { omega0: start, eps };
    let harmonic = Harmonic {
        k: 1.0,
        amplitude: 1.0,
        phase: -FRAC_PI_2,
    };
    let oscillator = Oscillator::new(1.0, ZETA).unwrap();
    let rest = InitialState::default();
    let response = ChirpResponse::of_harmonic(oscillator, chirp, harmonic, rest).unwrap();
    let end = (1.0 - start).max(0.0) / eps + 8.0 / eps.sqrt() + 10.0;
    let times: Vec<f64> = (0..4000).map(|i| end * f64::from(i) / 4000.0).collect();
    let mut y = vec![0.0; times.len()];
    response.displacements(&times, &mut y).unwrap();
    let at = (0..y.len()).max_by(|&i, &j| y[i].abs().total_cmp(&y[j].abs()));
    let at = at.unwrap();
    let swings = y[..at].windows(2).filter(|p| p[0] * p[1] < 0.0).count();
    (y[at].abs(), swings as i64)
}

#[test]
fn the_peak_is_attenuated_from_the_resonance_on() {
    let peaks = [0.0, 0.5, 0.9, 1.0, 1.1, 1.5].map(|start| peak(start, 1e-3).0);
    assert!((peaks[1] / peaks[0] - 1.0).abs() < 1e-3, "{peaks:?}");
    assert!(peaks[3] < 0.7 * peaks[0], "{peaks:?}");
    assert!(
        peaks[4] < 0.5 * peaks[3] && peaks[5] < 0.5 * peaks[4],
        "{peaks:?}"
    );
}

#[test]
fn the_peak_is_scalloped_over_the_rate() {
    let rates: Vec<f64> = (0..400).map(|i| 0.02 + 2e-4 * f64::from(i)).collect();
    let peaks: Vec<_> = rates.iter().map(|&eps| peak(0.0, eps)).collect();
    let slope = |i: usize| (peaks[i + 1].0 - peaks[i].0) / 2e-4;
    let mut scallops = 0;
    for i in 2..rates.len() - 3 {
        let ((_, before), (_, after)) = (peaks[i], peaks[i + 1]);
        if before == after {
            continue;
        }
        // One half-cycle earlier at a time; the value goes on, its slope jumps upwards.
        assert_eq!(before - after, 1, "{}", rates[i]);
        assert!((peaks[i + 1].0 / peaks[i].0 - 1.0).abs() < 0.02);
        assert!(slope(i + 1) > slope(i - 1), "{}", rates[i]);
        scallops += 1;
    }
    assert!(scallops >= 3, "{scallops}");
    assert!(peaks.iter().all(|p| p.0 < 0.5 / ZETA));
}

/// The largest displacement and acceleration for w = 1 on the way from rest at zero frequency to
/// three bandwidths beyond the resonance, as parts of the largest stationary ones, which are the
/// same number.
fn swept_over_stationary(zeta: f64, eps: f64, phase: f64) -> [f64; 2] {
    let harmonic = Harmonic {
        k: 1.0,
        amplitude: 1.0,
        phase,
    };
    let chirp = Chirp { omega0: 0.0, eps };
    let (oscillator, rest) = (Oscillator::new(1.0, zeta).unwrap(), InitialState::default());
    let response = ChirpResponse::of_harmonic(oscillator, chirp, harmonic, rest).unwrap();
    let end = (1.0 + 6.0 * zeta) / eps;
    let times: Vec<f64> = (0..8000).map(|i| end * f64::from(i) / 8000.0).collect();
    let mut motions = vec![Motion::default(); times.len()];
    response.motions(&times, &mut motions).unwrap();
    let largest = |of: fn(&Motion) -> f64| motions.iter().map(of).fold(0.0, f64::max);
    let stationary = 0.5 / (zeta * (1.0 - zeta * zeta).sqrt());
    [
        largest(|m| m.displacement.abs()) / stationary,
        largest(|m| m.acceleration.abs()) / stationary,
    ]
}

/// In displacement it stays below; in acceleration the free vibration that the passage leaves adds
/// to a forced one that does not fall off beyond the resonance.
#[test]
fn the_swept_acceleration_exceeds_the_stationary_one() {
    for (zeta, excess) in [(0.05, 0.002), (0.1, 0.01), (0.2, 0.05)] {
        let mut best = 0.0f64;
        for i in 0..=12 {
            let eps = zeta * zeta * 0.05 * 24.0f64.powf(f64::from(i) / 12.0);
            for phase in [-FRAC_PI_2, -0.5 * FRAC_PI_2, 0.0] {
                let [y, a] = swept_over_stationary(zeta, eps, phase);
                assert!(y < 1.0, "{zeta} {eps} {phase}: {y}");
                best = best.max(a);
            }
        }
        assert!(best > 1.0 + excess, "{zeta}: {best}");
    }
}

//! Displacements beside a resonance, on its edge, at short times and with large phases.

use super::super::types::{Chirp, Harmonic, InitialState, Motion, Oscillator};
use super::*;

fn response(w: f64, n: f64, omega0: f64, eps: f64) -> ChirpResponse {
    let harmonic = Harmonic {
        k: 1.0,
        amplitude: 1.0,
        phase: 0.3,
    };
    let oscillator = Oscillator::new(w, n).expect("an oscillator");
    let chirp = Chirp { omega0, eps };
    let rest = InitialState::default();
    ChirpResponse::of_harmonic(oscillator, chirp, harmonic, rest).expect("a response")
}

/// All ways to the displacement, relative to itself and to `least`.
fn agree(r: &ChirpResponse, times: &[f64], least: f64) {
    let mut many = vec![0.0; times.len()];
    r.displacements(times, &mut many).expect("times");
    let mut motions = vec![Motion::default(); times.len()];
    r.motions(times, &mut motions).expect("times");
    for (i, &t) in times.iter().enumerate() {
        let due = r.motion(t).expect("a time").displacement;
        let once = r.displacement(t).expect("a time");
        for found in [many[i], motions[i].displacement, once] {
            let off = (found - due).abs();
            assert!(off <= 1e-13 * due.abs().max(least), "{t}: {found} {due}");
        }
    }
}

/// At `ω + Im λ = −Re λ` exactly, a resonance is not yet behind, neither for the particular
/// solution nor for what the passage leaves.
#[test]
fn on_the_edge_of_a_resonance() {
    let r = response(1.25, 0.75, -1.25, 0.125);
    let roots = &r.roots;
    let omega = r.harmonics[0].sweep.omega(8.0);
    assert_eq!(roots.p(0, omega).im, -roots.lambda[0].re);
    assert!(r.harmonics[0].left.is_some());
    let ulp = 8.0f64.next_up() - 8.0;
    agree(&r, &[8.0, 8.0 - ulp, 8.0 + ulp, 8.0, 8.0], 0.1);
}

/// From rest the first displacements are tiny, and right to their own size.
#[test]
fn short_times() {
    for (w, n, omega0, eps) in [
        (1.25, 0.75, -1.25, 0.125),
        (1.0, 0.1, 1.0, 0.01),
        (1.0, 3.0, 0.0, 1.0),
    ] {
        let r = response(w, n, omega0, eps);
        let times: Vec<f64> = (1..=30).map(|k| 0.01 * 1.2f64.powi(k)).collect();
        agree(&r, &times, 0.0);
    }
}

/// Phases beyond 2³⁰ are reduced the long way.
#[test]
fn phases_of_any_size() {
    for omega0 in [1e12, -1e15] {
        let r = response(1.0, 0.3, omega0, 3.0);
        let times: Vec<f64> = (1..=23).map(|k| 1.7 * f64::from(k)).collect();
        let size = 1.0 / omega0 / omega0;
        let mut many = vec![0.0; times.len()];
        r.displacements(&times, &mut many).expect("times");
        let mut motions = vec![Motion::default(); times.len()];
        r.motions(&times, &mut motions).expect("times");
        for (i, &t) in times.iter().enumerate() {
            let due = r.motion(t).expect("a time");
            assert!((many[i] - due.displacement).abs() < 1e-9 * due.displacement.abs().max(size));
            let off = (motions[i].acceleration - due.acceleration).abs();
            assert!(off < 1e-13, "{t}: {off:e}");
        }
    }
}

/// Roots that are told apart wait for W; others are computed otherwise.
#[test]
fn points_waiting_for_w() {
    let r = response(1.25, 0.75, -1.25, 0.125);
    let (roots, harmonic) = (&r.roots, &r.harmonics[0]);
    let mut near = Near::default();
    // Beside the resonance of the first root; the other one is far.
    let omega = Dd::from(-1.0);
    assert!(near.push(harmonic, roots, 3, omega, C::ONE));
    assert_eq!((near.place.len(), near.parts.len()), (1, 1));
    assert_eq!(near.place[0], (3, C::ONE));
    let mut y = [0.0; CHUNK];
    near.add(harmonic, roots, &mut y);
    let due = harmonic.sweep.particular(roots, omega).y.re * harmonic.scale;
    assert!((y[3] - due).abs() < 1e-15 && y[2] == 0.0, "{} {due}", y[3]);
    let critical = response(1.25, 1.25, -1.25, 0.125);
    let harmonic = &critical.harmonics[0];
    near.clear();
    assert!(!near.push(harmonic, &critical.roots, 3, omega, C::ONE));
    assert!(near.place.is_empty() && near.parts.is_empty());
}

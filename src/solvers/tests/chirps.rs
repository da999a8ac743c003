//! Many times at once under a chirp, against one after the other.

use crate::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Motion, Oscillator,
};

/// w, n, ε, Ω₀, end: run-up and run-down, through resonances and away from them, light, heavy and
/// critical damping, constant speed, a fast sweep and a slow one.
const SWEEPS: [[f64; 5]; 14] = [
    [10.0, 0.5, 4.0, 0.0, 12.0],
    [10.0, 0.01, 0.4, 1.0, 60.0],
    [10.0, 0.0, 2.0, 3.0, 20.0],
    [10.0, 2.0, -3.0, 25.0, 20.0],
    [10.0, 9.999_999, 4.0, 0.0, 10.0],
    [10.0, 10.0, 4.0, -10.0, 10.0],
    [10.0, 14.1, 4.0, -10.0, 25.0],
    [10.0, 0.3, 0.0, 10.0, 25.0],
    [10.0, 0.3, 0.0, 3.7, 25.0],
    [1.0, 0.1, 900.0, -30.0, 1.0],
    [1.0, 0.1, 1e-3, 0.2, 900.0],
    [300.0, 5.0, 20.0, 10.0, 8.0],
    [3.0, 0.02, 0.3, 50.0, 30.0],
    [1.0, 0.6, 0.02, 1e7, 100.0],
];

fn response([w, n, eps, omega0, _]: [f64; 5], count: u32) -> ChirpResponse {
    let harmonic = |k: u32| Harmonic {
        k: f64::from(k),
        amplitude: 1.0 / f64::from(k * k),
        phase: 0.3 * f64::from(k),
    };
    let excitation = Excitation {
        chirp: Chirp { omega0, eps },
        forcing: Forcing::Displacement,
        static_term: 0.2,
        harmonics: (1..=count).map(harmonic).collect(),
    };
    let initial = InitialState {
        displacement: 0.1,
        velocity: -0.2 * w,
    };
    let oscillator = Oscillator::new(w, n).expect("an oscillator");
    ChirpResponse::new(oscillator, excitation, initial).expect("a response")
}

#[test]
fn batches_of_times() {
    for sweep in SWEEPS {
        for count in [1, 4] {
            let r = response(sweep, count);
            let [w, .., end] = sweep;
            // Not a multiple of four; of any order.
            let times: Vec<f64> = (0..61)
                .map(|i| end * f64::from(i * 23 % 61) / 60.0)
                .collect();
            let one: Vec<Motion> = times
                .iter()
                .map(|t| r.motion(*t).expect("a time"))
                .collect();
            let size = one.iter().map(|m| m.displacement.abs()).fold(0.0, f64::max);
            let fast = one
                .iter()
                .map(|m| m.velocity.abs())
                .fold(w * size, f64::max);
            let hard = one
                .iter()
                .map(|m| m.acceleration.abs())
                .fold(w * w * size, f64::max);
            let close = |got: f64, due: f64, size: f64| {
                let off = (got - due).abs() / size;
                assert!(off <= 60.0 * f64::EPSILON, "{sweep:?} {count}: {off:e}");
            };
            for length in [61, 4, 3, 1] {
                let mut motions = vec![Motion::default(); length];
                let mut displacements = vec![0.0; length];
                r.motions(&times[..length], &mut motions).expect("times");
                r.displacements(&times[..length], &mut displacements)
                    .expect("times");
                for i in 0..length {
                    close(motions[i].displacement, one[i].displacement, size);
                    close(motions[i].velocity, one[i].velocity, fast);
                    close(motions[i].acceleration, one[i].acceleration, hard);
                    close(displacements[i], one[i].displacement, size);
                    let alone = r.displacement(times[i]).expect("a time");
                    close(alone, one[i].displacement, size);
                }
            }
        }
    }
}

/// A chunk of 512 ends within; all cores do the same chunks.
#[test]
#[cfg(feature = "parallel")]
fn chunks_of_times() {
    let r = response(SWEEPS[0], 2);
    let times: Vec<f64> = (0..1100).map(|i| 0.01 * f64::from(i)).collect();
    let mut one = (vec![0.0; 1100], vec![Motion::default(); 1100]);
    let mut all = one.clone();
    r.displacements(&times, &mut one.0).expect("times");
    r.motions(&times, &mut one.1).expect("times");
    r.displacements_parallel(&times, &mut all.0).expect("times");
    r.motions_parallel(&times, &mut all.1).expect("times");
    assert_eq!(one, all);
    for i in [0, 300, 511, 512, 777, 1023, 1024, 1099] {
        let due = r.motion(times[i]).expect("a time").displacement;
        assert!((one.0[i] - due).abs() < 1e-13 && (one.1[i].displacement - due).abs() < 1e-13);
    }
    assert!(
        r.motions_parallel(&times, &mut [Motion::default(); 3])
            .is_err()
    );
    assert!(r.displacements_parallel(&times, &mut [0.0; 3]).is_err());
    assert!(
        r.motions_parallel(&[1.0, -1.0], &mut [Motion::default(); 2])
            .is_err()
    );
}

//! Times the chirp-forced oscillator on the problem of `benches/compare_dop853.py`,
//! single-threaded.
//!
//! Usage: `chirp_timing OUT-FILE`. Prints the best of eleven runs in seconds, preparation included,
//! and writes the displacements as raw little-endian `f64`.

use mechaudit::solvers::chirp_oscillator::{
    Chirp, ChirpResponse, Excitation, Forcing, Harmonic, InitialState, Oscillator,
};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args()
        .nth(1)
        .ok_or("usage: chirp_timing OUT-FILE")?;
    let end = (400.0 * std::f64::consts::PI / 4.0).sqrt();
    let times: Vec<f64> = (0..10_000).map(|i| end * f64::from(i) / 9999.0).collect();
    let mut y = vec![0.0; times.len()];
    let mut best = f64::INFINITY;
    for _ in 0..11 {
        let start = Instant::now();
        let harmonic = |k: u32| Harmonic {
            k: f64::from(k),
            amplitude: 1.0 / f64::from(k * k),
            phase: 0.3 * f64::from(k),
        };
        let excitation = Excitation {
            chirp: Chirp {
                omega0: 0.0,
                eps: 4.0,
            },
            forcing: Forcing::Displacement,
            static_term: 0.0,
            harmonics: (1..=20).map(harmonic).collect(),
        };
        let oscillator = Oscillator::new(200.0, 4.0)?;
        let response = ChirpResponse::new(oscillator, excitation, InitialState::default())?;
        response.displacements(&times, &mut y)?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{best}");
    let bytes: Vec<u8> = y.iter().flat_map(|y| y.to_le_bytes()).collect();
    std::fs::write(path, bytes)?;
    Ok(())
}

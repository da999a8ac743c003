//! A damped oscillator forced by harmonics of a shaft whose speed changes linearly in time:
//!
//! ```text
//! y″ + 2n y′ + w² y = w² (a₀ + Σ D_k cos θ_k),   θ_k(t) = k (Ω₀ t + ε t²/2) + δ_k
//! ```
//!
//! from any initial state, for run-up (Ω₀ ≥ 0, ε > 0), run-down (ε < 0), reversal through zero
//! speed and constant speed (ε = 0); undamped, under-, critically and overdamped.
//!
//! # Amplitudes
//! The response of harmonic `k` from rest is `y_k = Re A_k e^{−iθ_k}`, that is
//! `|A_k| cos(θ_k + δ*_k)` with the envelope `|A_k|` and the phase `δ*_k = −arg A_k` by `atan2`, the
//! form of Gembara & Senyk (15)–(17).

mod direct;
mod error;
mod extended;
mod free;
mod harmonic;
mod passage;
mod phase;
mod response;
mod roots;
mod rules;
mod sweep;
mod types;

pub use error::ChirpError;
pub use response::ChirpResponse;
pub use types::{
    Chirp, Excitation, Forcing, Harmonic, HarmonicResponse, InitialState, Motion, Oscillator,
};

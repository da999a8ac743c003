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
//! `|A_k| cos(θ_k + δ*_k)` with the envelope `|A_k|` and the phase `δ*_k = −arg A_k` by `atan2`,
//! the form of Gembara & Senyk (15)–(17). Their closed form (18), with its signs put right, is not
//! evaluated as it stands: `e^{U₀² − U²}` overflows, `n = w` divides by zero, and for ε < 0 the
//! terms cancel.
//!
//! # Method
//! With `κ = kε` (made positive by the sign of k), `ν = kΩ₀`, `ω = ν + κt` and the roots
//! `λ± = −n ± √(n² − w²)` the response is a sum of parts of its own size or smaller:
//!
//! - a particular solution without memory of `t = 0` (`sweep.rs`): the Faddeeva function w,
//!   reflected into the upper half-plane, for both roots; a series without their difference where
//!   both resonances are far; double-double where `f64` does not tell the roots apart
//!   (`extended.rs`), critical damping included;
//! - the free vibration that starts with it (`free.rs`);
//! - the free vibration that each passage through a resonance leaves (`passage.rs`), its exponents
//!   combined before any exponential;
//! - within the first radians, where these would cancel, quadrature of the convolution integral
//!   (`direct.rs`), and beside a return to rest double-double (`return_to_rest.rs`).
//!
//! Phases are formed and reduced in double-double, beyond 2³⁰ rad by Payne & Hanek's method. Time
//! is measured in a power of two for which `w` lies in [1, 2).
//!
//! # Accuracy
//! Errors in units of `2⁻⁵³ (1 + cond)`, `cond = Σ_j |x_j ∂f/∂x_j|/|f|` over the nine inputs. For
//! the motion f is the complex response (so that zeros of the motion count for nothing); Re A and
//! Im A are each taken by itself. Worst found in 4000 random cases in each of the eighteen regions
//! of the audit (`examples/chirp_accuracy.rs`, seed 7), among them n/w = 0…1000, |kε| = 10⁻³⁰⁰…10⁶
//! w², phases up to 10⁹ rad, wt from 10⁻⁹⁰, returns to rest: y 2.6, y′ 1.6, y″ 1.2, Re A 4.8, Im A
//! 3.4. [`ChirpResponse::displacements`] differs from [`ChirpResponse::motion`] by up to 1.1 ·
//! 10⁻¹⁵ of the largest displacement in the sweeps tried.
//!
//! # Domain
//! All finite inputs with `w > 0`, `n ≥ 0`, `t ≥ 0` whose `ε/w²`, `Ω₀/w`, `n/w` and `wt` are within
//! the range of `f64`; beyond it values may be NaN.

mod batch;
mod both_roots;
mod complex_double_double;
mod direct;
mod error;
mod extended;
mod free;
mod group;
mod harmonic;
mod inlined;
mod many;
mod motions;
mod passage;
mod phase;
mod response;
mod return_to_rest;
mod roots;
mod series;
mod sweep;
mod types;

pub use error::ChirpError;
pub use response::ChirpResponse;
pub use types::{
    Chirp, Excitation, Forcing, Harmonic, HarmonicResponse, InitialState, Motion, Oscillator,
};

#[cfg(test)]
mod tests;

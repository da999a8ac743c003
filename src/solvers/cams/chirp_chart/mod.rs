//! A cam-driven oscillator while its shaft speeds up or slows down: time histories and charts over
//! the frequency criterion.
//!
//! ```text
//! y″ + 2n y′ + w² y = w² f(θ),   θ = θ_0 + Ω_0 t + ε t²/2
//! ```
//!
//! with the displacement `f` of a [`CamCycle`](super::cam_law::CamCycle). Its harmonics force
//! [`ChirpResponse`](super::chirp_oscillator::ChirpResponse), which gives `y` and `y′`; the
//! acceleration is `w² (f − y) − 2n y′` with `f` itself, so that of the harmonics left out only the
//! filtered response is missing. At shaft speeds below `1.5 w/N` the `N` harmonics do not reach
//! beyond the resonance, and the acceleration is theirs alone.
//!
//! # The frequency criterion
//! Gembara & Senyk's `ξ = w/Ω` (1) takes for the period of the forcing the time of the **rise**
//! alone, `ξ = w φ_y/(2π ω_cam)`; but the harmonics in their (19) are those of a whole **turn**,
//! for which `t = w/(εξ)` gives `ξ = w/ω_cam`. The two differ by the share of the rise in a turn.
//! [`Period`] says which one is meant, everywhere.
//!
//! # What is charted
//! * `Σ|A_k|` (19) with the correct amplitudes, an upper bound on the displacement from its mean
//!   once the start has died away, and likewise `w² Σ|D_k − A_k|`, one on `y″ + 2n y′`; both are
//!   sums over the harmonics in use;
//! * the true peaks in the turn about that time;
//! * the dynamic coefficients (2): peaks over those of the same motion without elasticity.
//!   `K_dc` for accelerations, `K_dM` for the moments `y″ df/dθ` of inertia on the camshaft, `K_dN`
//!   for the kinetic power `y′ y″`. The paper leaves the moduli of the last two to Tir (1965), so
//!   moments of a closing spring or of friction are not in them.
//!
//! # Sources
//! Gembara & Senyk, eqs (1), (2), (7), (19).

mod chart;
mod error;
mod peak;
mod response;

pub use chart::{BeatZone, Chart, ChartPoint, beat_zones};
pub use error::ChirpChartError;
pub use response::{CamDrive, CamResponse, FreeVibration, Period, State, TurnPeaks};

#[cfg(test)]
mod tests;

//! Cams: laws of motion, Fourier series, response of the follower to a chirp.

pub mod cam_law;
pub mod chirp_oscillator;
pub mod fourier_series;
mod fourier_transform;

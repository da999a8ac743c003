//! Cams: laws of motion, their Fourier series, the follower's response to a chirp.

pub mod cam_law;
pub mod chirp_chart;
pub mod chirp_oscillator;
pub mod fourier_series;

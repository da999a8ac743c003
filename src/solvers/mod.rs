//! Fast `f64` solvers. They know nothing of references or audits and need neither GMP nor MPFR.

pub mod cam_law;
pub mod chirp_chart;
pub mod chirp_oscillator;
pub mod class_iii;
pub mod cubic_spline;
pub mod cyclic_tridiagonal;
pub mod dyad;
pub mod faddeeva;
pub mod fourier_series;
mod hex;
pub mod reduction;
pub mod run_up;
pub mod tridiagonal;
pub mod units;

#[cfg(test)]
mod tests;

//! Fast `f64` solvers. They know nothing of references or audits and need neither GMP nor MPFR.

pub mod dyad;
pub mod units;

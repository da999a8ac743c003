//! Fast `f64` solvers. They know nothing of references or audits and need neither GMP nor MPFR.

pub mod class_iii;
pub mod reduction;
pub mod units;

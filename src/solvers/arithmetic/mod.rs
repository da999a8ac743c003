//! Floating-point arithmetic: exact constants, sums and products of two parts, vectors.

pub(crate) mod double_double;
pub(crate) mod hex;
pub(crate) mod lanes;
#[cfg(target_arch = "x86_64")]
pub(crate) mod pack;
pub(crate) mod real;
#[cfg(target_arch = "x86_64")]
pub(crate) mod two;

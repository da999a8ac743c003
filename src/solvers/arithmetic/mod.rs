//! Floating-point arithmetic: exact constants, sums and products of two parts, vectors, and the
//! exponential, sine and cosine of arguments in two parts.

pub(crate) mod arctangent;
pub(crate) mod double_double;
pub(crate) mod double_double_functions;
pub(crate) mod exponential;
pub(crate) mod hex;
pub(crate) mod lanes;
pub(crate) mod numbers;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
pub(crate) mod pack;
pub(crate) mod payne_hanek;
pub(crate) mod real;
mod tables;
#[cfg(test)]
pub(crate) mod tests;
#[cfg(all(target_arch = "x86_64", feature = "vectors"))]
pub(crate) mod two;

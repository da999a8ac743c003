//! Floating-point arithmetic: constants, sums and products of two parts, vectors, exponentials.

pub(crate) mod hex;

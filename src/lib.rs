//! mechaudit
#![forbid(unsafe_code)]
#![warn(missing_docs)]

#[cfg(feature = "oracle")]
pub mod audit;
#[cfg(feature = "oracle")]
pub mod methods;
#[cfg(feature = "oracle")]
pub mod papers;
#[cfg(feature = "oracle")]
pub mod reference;
pub mod solvers;

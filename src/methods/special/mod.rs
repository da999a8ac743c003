//! The Faddeeva function and its relatives.

mod branches;
mod faddeeva;
mod relatives;
mod voigt;

pub use faddeeva::{ComplexInput, Faddeeva};
pub use relatives::{Dawson, Erf, Erfc, Erfcx, Erfi, FaddeevaDerivative};
pub use voigt::{Voigt, VoigtInput};

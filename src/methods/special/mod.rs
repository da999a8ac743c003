//! The Faddeeva function and its relatives.

mod branches;
mod complex;
mod faddeeva;
mod identities;
mod relatives;
mod voigt;
mod voigt_hwhm;

pub use complex::ComplexInput;
pub use faddeeva::Faddeeva;
pub use relatives::{Dawson, Erf, Erfc, Erfcx, Erfi, FaddeevaDerivative};
pub use voigt::{Voigt, VoigtInput};
pub use voigt_hwhm::{VoigtHwhm, VoigtHwhmInput};

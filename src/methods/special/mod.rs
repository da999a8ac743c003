//! The Faddeeva function and its relatives.

mod branches;
mod faddeeva;
mod relatives;
mod voigt;
mod voigt_hwhm;

pub use faddeeva::{ComplexInput, Faddeeva};
pub use relatives::{Dawson, Erf, Erfc, Erfcx, Erfi, FaddeevaDerivative};
pub use voigt::{Voigt, VoigtInput};
pub use voigt_hwhm::{VoigtHwhm, VoigtHwhmInput};

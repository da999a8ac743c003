//! The Faddeeva function and its relatives.

mod branches;
mod complex;
mod identities;

pub use complex::ComplexInput;

crate::methods::definition::methods! {
    faddeeva: Faddeeva;
    relatives: FaddeevaDerivative, Erf, Erfc, Erfcx, Erfi, Dawson;
    voigt: Voigt;
    voigt_hwhm: VoigtHwhm;
}

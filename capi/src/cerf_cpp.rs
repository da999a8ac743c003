//! The functions of libcerf 3's C++ library (`libcerfcpp`) under their names as the Itanium C++ ABI mangles
//! them (5.1), so that a program linked with that one runs with ours.
//!
//! `std::complex<double>` is a class of two doubles that is trivial to copy, and so passed like a structure of
//! them: as [`Complex`].

use crate::cerf;
use crate::complex::Complex;

#[cfg(complex_by_value)]
mod by_value {
    use super::{Complex, cerf};

    /// `w_of_z(std::complex<double>)`
    #[unsafe(export_name = "_Z6w_of_zSt7complexIdE")]
    pub extern "C" fn cpp_w_of_z(z: Complex) -> Complex {
        cerf::w_of_z(z)
    }

    /// `cerf(std::complex<double>)`
    #[unsafe(export_name = "_Z4cerfSt7complexIdE")]
    pub extern "C" fn cpp_cerf(z: Complex) -> Complex {
        cerf::cerf(z)
    }

    /// `cerfc(std::complex<double>)`
    #[unsafe(export_name = "_Z5cerfcSt7complexIdE")]
    pub extern "C" fn cpp_cerfc(z: Complex) -> Complex {
        cerf::cerfc(z)
    }

    /// `cerfcx(std::complex<double>)`
    #[unsafe(export_name = "_Z6cerfcxSt7complexIdE")]
    pub extern "C" fn cpp_cerfcx(z: Complex) -> Complex {
        cerf::cerfcx(z)
    }

    /// `cerfi(std::complex<double>)`
    #[unsafe(export_name = "_Z5cerfiSt7complexIdE")]
    pub extern "C" fn cpp_cerfi(z: Complex) -> Complex {
        cerf::cerfi(z)
    }

    /// `cdawson(std::complex<double>)`
    #[unsafe(export_name = "_Z7cdawsonSt7complexIdE")]
    pub extern "C" fn cpp_cdawson(z: Complex) -> Complex {
        cerf::cdawson(z)
    }
}

#[cfg(complex_by_value)]
pub use by_value::*;

/// `im_w_of_x(double)`
#[unsafe(export_name = "_Z9im_w_of_xd")]
pub extern "C" fn cpp_im_w_of_x(x: f64) -> f64 {
    cerf::im_w_of_x(x)
}

/// `re_w_of_z(double, double)`
#[unsafe(export_name = "_Z9re_w_of_zdd")]
pub extern "C" fn cpp_re_w_of_z(x: f64, y: f64) -> f64 {
    cerf::re_w_of_z(x, y)
}

/// `im_w_of_z(double, double)`
#[unsafe(export_name = "_Z9im_w_of_zdd")]
pub extern "C" fn cpp_im_w_of_z(x: f64, y: f64) -> f64 {
    cerf::im_w_of_z(x, y)
}

/// `erfcx(double)`
#[unsafe(export_name = "_Z5erfcxd")]
pub extern "C" fn cpp_erfcx(x: f64) -> f64 {
    cerf::erfcx(x)
}

/// `erfi(double)`
#[unsafe(export_name = "_Z4erfid")]
pub extern "C" fn cpp_erfi(x: f64) -> f64 {
    cerf::erfi(x)
}

/// `dawson(double)`
#[unsafe(export_name = "_Z6dawsond")]
pub extern "C" fn cpp_dawson(x: f64) -> f64 {
    cerf::dawson(x)
}

/// `voigt(double, double, double)`
#[unsafe(export_name = "_Z5voigtddd")]
pub extern "C" fn cpp_voigt(x: f64, sigma: f64, gamma: f64) -> f64 {
    cerf::voigt(x, sigma, gamma)
}

/// `voigt_hwhm(double, double)`
#[unsafe(export_name = "_Z10voigt_hwhmdd")]
pub extern "C" fn cpp_voigt_hwhm(sigma: f64, gamma: f64) -> f64 {
    cerf::voigt_hwhm(sigma, gamma)
}

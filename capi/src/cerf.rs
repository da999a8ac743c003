//! libcerf's functions under its names and with its types, as `mechaudit/cerf.h` declares them.

use crate::complex::Complex;
use mechaudit_solvers::faddeeva as solver;
use num_complex::Complex64;

/// Functions of a complex number by value.
#[cfg(complex_by_value)]
mod by_value {
    use super::{Complex, solver};

    /// `w(z) = exp(−z²) erfc(−iz)`.
    #[unsafe(no_mangle)]
    pub extern "C" fn w_of_z(z: Complex) -> Complex {
        z.map(solver::faddeeva)
    }

    /// erf z.
    #[unsafe(no_mangle)]
    pub extern "C" fn cerf(z: Complex) -> Complex {
        z.map(solver::erf)
    }

    /// `erfc z = 1 − erf z`.
    #[unsafe(no_mangle)]
    pub extern "C" fn cerfc(z: Complex) -> Complex {
        z.map(solver::erfc)
    }

    /// `erfcx z = exp(z²) erfc z`.
    #[unsafe(no_mangle)]
    pub extern "C" fn cerfcx(z: Complex) -> Complex {
        z.map(solver::erfcx)
    }

    /// `erfi z = −i erf(iz)`.
    #[unsafe(no_mangle)]
    pub extern "C" fn cerfi(z: Complex) -> Complex {
        z.map(solver::erfi)
    }

    /// Dawson's function.
    #[unsafe(no_mangle)]
    pub extern "C" fn cdawson(z: Complex) -> Complex {
        z.map(solver::dawson)
    }
}

#[cfg(complex_by_value)]
pub use by_value::*;

/// Im w(x) for real x, `(2/√π)` times Dawson's function.
#[unsafe(no_mangle)]
pub extern "C" fn im_w_of_x(x: f64) -> f64 {
    solver::faddeeva(Complex64::new(x, 0.0)).im
}

/// Re w(x + iy).
#[unsafe(no_mangle)]
pub extern "C" fn re_w_of_z(x: f64, y: f64) -> f64 {
    solver::faddeeva(Complex64::new(x, y)).re
}

/// Im w(x + iy).
#[unsafe(no_mangle)]
pub extern "C" fn im_w_of_z(x: f64, y: f64) -> f64 {
    solver::faddeeva(Complex64::new(x, y)).im
}

/// erfcx x, real.
#[unsafe(no_mangle)]
pub extern "C" fn erfcx(x: f64) -> f64 {
    solver::erfcx_real(x)
}

/// erfi x, real.
#[unsafe(no_mangle)]
pub extern "C" fn erfi(x: f64) -> f64 {
    solver::erfi_real(x)
}

/// Dawson's function of a real number.
#[unsafe(no_mangle)]
pub extern "C" fn dawson(x: f64) -> f64 {
    solver::dawson_real(x)
}

/// The Voigt profile; as libcerf documents, of |σ| and |γ|.
#[unsafe(no_mangle)]
pub extern "C" fn voigt(x: f64, sigma: f64, gamma: f64) -> f64 {
    solver::voigt(x, sigma.abs(), gamma.abs())
}

/// Half the width of the Voigt profile of |σ| and |γ| at half its maximum.
#[unsafe(no_mangle)]
pub extern "C" fn voigt_hwhm(sigma: f64, gamma: f64) -> f64 {
    solver::voigt_hwhm(sigma.abs(), gamma.abs())
}

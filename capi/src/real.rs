//! Functions of real numbers, and the Voigt profile.

use crate::border::{Error, Failure, Status, guarded};
use crate::strided::apply_real;
use mechaudit_solvers::faddeeva as solver;
use std::ffi::c_int;

/// erf of a real number. NaN for NaN. Accuracy: within 0.875 units in the last place,
/// proved for every double (`mechaudit prove erf`).
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erf_real(x: f64) -> f64 {
    solver::erf_real(x)
}

/// erfc of a real number, gradual underflow included. Accuracy: within 0.875 units in the last place,
/// proved for every double (`mechaudit prove erfc`).
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfc_real(x: f64) -> f64 {
    solver::erfc_real(x)
}

/// erfcx x = exp(x^2) erfc x of a real number. Accuracy: within 0.875 units in the last place,
/// proved for every double (`mechaudit prove erfcx`).
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfcx_real(x: f64) -> f64 {
    solver::erfcx_real(x)
}

/// erfi of a real number. Accuracy: within 4 units in the last place; `mechaudit audit erfi`.
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfi_real(x: f64) -> f64 {
    solver::erfi_real(x)
}

/// Dawson's function of a real number. Accuracy: within 0.875 units in the last place,
/// proved for every double (`mechaudit prove dawson`).
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_dawson_real(x: f64) -> f64 {
    solver::dawson_real(x)
}

/// A function of n real numbers `x[k*incx]`, to `y[k*incy]`: erf, erfc, erfcx, erfi or Dawson's function
/// by their codes in `mechaudit_function`. The values are those of one point at a time, bit for bit, by
/// vectors of four or eight. `y` may be `x` with the same stride; `incy` is not 0 for n > 1. Dense arrays
/// are fastest.
///
/// Errors: `NULL_POINTER`, `SIZE`, `ARGUMENT` (also for the Faddeeva function and its derivative, which
/// are not real); nothing is written then. `error` may be NULL.
///
/// # Safety
/// `x` and `y` have n doubles at these strides, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_real_batch(
    function: c_int,
    n: usize,
    x: *const f64,
    incx: isize,
    y: *mut f64,
    incy: isize,
    error: *mut Error,
) -> Status {
    let run = || {
        let f = match function {
            2 => solver::erf_real_batch,
            3 => solver::erfc_real_batch,
            4 => solver::erfcx_real_batch,
            5 => solver::erfi_real_batch,
            6 => solver::dawson_real_batch,
            other => {
                let text =
                    format!("function {other} is none of mechaudit_function with real values");
                return Err(Failure::new(Status::Argument, text));
            }
        };
        let some = |_, x: &[f64], y: &mut [f64]| {
            f(x, y).map_err(|e| Failure::new(Status::Internal, e.to_string()))
        };
        // SAFETY: the caller promises n numbers of each array at these strides.
        unsafe { apply_real(n, (x, incx), (y, incy), some) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// The Voigt profile `Re w((x + i gamma)/(sigma sqrt 2))/(sigma sqrt(2 pi))`: the density at x of the sum of a
/// normal variable of standard deviation sigma and a Cauchy variable of half-width gamma. x, sigma and gamma
/// share a unit, the value has its inverse. sigma = 0 gives Lorentz's profile, gamma = 0 the normal
/// density, both zero infinity at x = 0 and else 0; NaN for negative widths (`voigt` of
/// `mechaudit/cerf.h` takes their moduli). Accuracy: within 3 units in the last place; `mechaudit
/// audit voigt`.
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_voigt(x: f64, sigma: f64, gamma: f64) -> f64 {
    solver::voigt(x, sigma, gamma)
}

/// Half the width of the Voigt profile at half its maximum, in the unit of sigma and gamma. NaN for
/// negative widths, infinity where one is infinite. Accuracy: within 1 unit in the last place;
/// `mechaudit audit voigt-hwhm`.
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_voigt_hwhm(sigma: f64, gamma: f64) -> f64 {
    solver::voigt_hwhm(sigma, gamma)
}

/// `mechaudit_voigt` at n abscissae `x[k*incx]`, to `v[k*incv]`; the values are those of one at a
/// time, bit for bit. `v` may be `x` with the same stride; `incv` is not 0 for n > 1.
///
/// Errors: `NULL_POINTER`, `SIZE`; nothing is written then. `error` may be NULL.
///
/// # Safety
/// `x` and `v` have n doubles at these strides, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_voigt_batch(
    n: usize,
    x: *const f64,
    incx: isize,
    sigma: f64,
    gamma: f64,
    v: *mut f64,
    incv: isize,
    error: *mut Error,
) -> Status {
    let some = |_, x: &[f64], v: &mut [f64]| {
        solver::voigt_batch(x, sigma, gamma, v)
            .map_err(|e| Failure::new(Status::Internal, e.to_string()))
    };
    // SAFETY: the caller promises n numbers of each array at these strides.
    let run = || unsafe { apply_real(n, (x, incx), (v, incv), some) };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

//! Functions of a complex number: parts by pointer, complex by value, batches.

use crate::border::{Error, Failure, Status, guarded};
use crate::strided::Complexes;
use mechaudit_solvers::faddeeva as solver;
use num_complex::Complex64;
use std::ffi::c_int;

/// A complex number by value, `double _Complex` in C.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct Complex {
    /// Real part.
    pub re: f64,
    /// Imaginary part.
    pub im: f64,
}

impl Complex {
    /// A function of it.
    #[inline(always)]
    pub(crate) fn map(self, f: impl Fn(Complex64) -> Complex64) -> Complex {
        let w = f(Complex64::new(self.re, self.im));
        Complex { re: w.re, im: w.im }
    }
}

/// Puts `f(x + iy)` where it is wanted.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[inline(always)]
unsafe fn put(f: impl Fn(Complex64) -> Complex64, x: f64, y: f64, re: *mut f64, im: *mut f64) {
    let w = f(Complex64::new(x, y));
    if !re.is_null() {
        // SAFETY: not NULL, so it can be written to.
        unsafe { re.write(w.re) };
    }
    if !im.is_null() {
        // SAFETY: not NULL, so it can be written to.
        unsafe { im.write(w.im) };
    }
}

/// The functions of a complex number, for batches.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// The Faddeeva function.
    Faddeeva = 0,
    /// Its derivative.
    FaddeevaDerivative = 1,
    /// The error function.
    Erf = 2,
    /// The complementary error function.
    Erfc = 3,
    /// The scaled complementary error function.
    Erfcx = 4,
    /// The imaginary error function.
    Erfi = 5,
    /// Dawson's function.
    Dawson = 6,
}

/// A batch of a function.
///
/// # Safety
/// All input can be read and all output written; nothing else does either meanwhile.
unsafe fn batch(function: c_int, points: Option<Complexes>) -> Result<(), Failure> {
    type Batch = fn(&[Complex64], &mut [Complex64]) -> Result<(), solver::LengthMismatch>;
    let f: Batch = match function {
        0 => solver::faddeeva_batch,
        1 => solver::w_derivative_batch,
        2 => solver::erf_batch,
        3 => solver::erfc_batch,
        4 => solver::erfcx_batch,
        5 => solver::erfi_batch,
        6 => solver::dawson_batch,
        other => {
            let text = format!("function {other} is none of mechaudit_function");
            return Err(Failure::new(Status::Argument, text));
        }
    };
    if let Some(points) = points {
        // SAFETY: as promised.
        unsafe { points.apply(|z, w| f(z, w).expect("equal lengths")) };
    }
    Ok(())
}

/// A function at n complex numbers `z`, each a real and an imaginary part one after the other, as C,
/// C++, Fortran and Julia store them. Strides count complex numbers and may be negative or, for `z`, zero; the
/// k-th number is `z[2*k*incz]`. `w` may be `z` with the same stride; other overlap gives values of
/// what was overwritten. The values are those of one point at a time, bit for bit, and
/// several times as fast. Thread-safe. Dense arrays are fastest.
///
/// Errors: `NULL_POINTER`, `SIZE` (also `incw` = 0 for n > 1), `ARGUMENT`; nothing is written then.
/// `error` may be NULL.
///
/// # Safety
/// `z` and `w` point to n complex numbers each at these strides, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_batch(
    function: c_int,
    n: usize,
    z: *const f64,
    incz: isize,
    w: *mut f64,
    incw: isize,
    error: *mut Error,
) -> Status {
    let run = || {
        let points = Complexes::interleaved(n, (z, incz), (w, incw))?;
        // SAFETY: the caller promises n numbers of each array at these strides.
        unsafe { batch(function, points) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// As `mechaudit_batch`, with real and imaginary parts in arrays of their own; strides count doubles, the
/// k-th number is `x[k*incx] + i y[k*incy]`. `re` and `im` may be `x` and `y` with the same strides; their
/// strides are not 0 for n > 1.
///
/// # Safety
/// The four arrays have n doubles at these strides, `error` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_batch_split(
    function: c_int,
    n: usize,
    x: *const f64,
    incx: isize,
    y: *const f64,
    incy: isize,
    re: *mut f64,
    incre: isize,
    im: *mut f64,
    incim: isize,
    error: *mut Error,
) -> Status {
    let run = || {
        let points = Complexes::split(n, [(x, incx), (y, incy)], [(re, incre), (im, incim)])?;
        // SAFETY: the caller promises n numbers of each array at these strides.
        unsafe { batch(function, points) }
    };
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { guarded(error, run) }
}

/// The Faddeeva function w(z) = exp(-z^2) erfc(-iz) (DLMF 7.2.3) at z = x + iy, dimensionless.
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit faddeeva`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_faddeeva(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::faddeeva, x, y, re, im) }
}

/// The derivative w'(z) = -2z w(z) + 2i/sqrt(pi) (DLMF 7.10.2) of the Faddeeva function, without that
/// sum's cancellation.
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit faddeeva-derivative`.
/// Thread-safe, allocates nothing, cannot fail; NaN and infinities give the limits where they exist,
/// else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_faddeeva_derivative(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::w_derivative, x, y, re, im) }
}

/// The error function erf z (DLMF 7.2.1).
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit erf`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_erf(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::erf, x, y, re, im) }
}

/// The complementary error function erfc z = 1 - erf z (DLMF 7.2.2).
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit erfc`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_erfc(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::erfc, x, y, re, im) }
}

/// The scaled complementary error function erfcx z = exp(z^2) erfc z = w(iz).
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit erfcx`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_erfcx(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::erfcx, x, y, re, im) }
}

/// The imaginary error function erfi z = -i erf(iz).
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit erfi`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_erfi(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::erfi, x, y, re, im) }
}

/// Dawson's function F(z) = exp(-z^2) (sqrt(pi)/2) erfi z (DLMF 7.2.5).
///
/// The parts go to `*re` and `*im`, of which either may be NULL. Accuracy: each component within 4
/// units in its last place. Budget, regions and worst inputs: `mechaudit audit dawson`. Thread-safe,
/// allocates nothing, cannot fail; NaN and infinities give the limits where they exist, else NaN.
///
/// # Safety
/// Each of `re` and `im` is NULL or can be written to.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mechaudit_dawson(x: f64, y: f64, re: *mut f64, im: *mut f64) {
    // SAFETY: NULL or writable, as the caller promises.
    unsafe { put(solver::dawson, x, y, re, im) }
}

/// `mechaudit_faddeeva` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_faddeeva_c(z: Complex) -> Complex {
    z.map(solver::faddeeva)
}

/// `mechaudit_faddeeva_derivative` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_faddeeva_derivative_c(z: Complex) -> Complex {
    z.map(solver::w_derivative)
}

/// `mechaudit_erf` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erf_c(z: Complex) -> Complex {
    z.map(solver::erf)
}

/// `mechaudit_erfc` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfc_c(z: Complex) -> Complex {
    z.map(solver::erfc)
}

/// `mechaudit_erfcx` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfcx_c(z: Complex) -> Complex {
    z.map(solver::erfcx)
}

/// `mechaudit_erfi` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_erfi_c(z: Complex) -> Complex {
    z.map(solver::erfi)
}

/// `mechaudit_dawson` with `double _Complex` by value, the same bits.
#[cfg(complex_by_value)]
#[unsafe(no_mangle)]
pub extern "C" fn mechaudit_dawson_c(z: Complex) -> Complex {
    z.map(solver::dawson)
}

//! The function that each ufunc computes.

use mechaudit::solvers::faddeeva as solver;
use num_complex::Complex;

/// A function of one variable on numbers of type `T`.
pub trait Function<T> {
    fn one(x: T) -> T;
    /// At all of `x`; the slices have one length. The values have the bits of [`Function::one`].
    fn many(x: &[T], y: &mut [T]);
}

macro_rules! batch {
    ($name:ident, $type:ty, $one:path, $many:path) => {
        impl Function<$type> for $name {
            fn one(x: $type) -> $type {
                $one(x)
            }
            fn many(x: &[$type], y: &mut [$type]) {
                let done = $many(x, y);
                debug_assert!(done.is_ok());
            }
        }
    };
}

pub struct Wofz;
batch!(Wofz, Complex<f64>, solver::faddeeva, solver::faddeeva_batch);

pub struct WofzDerivative;
batch!(
    WofzDerivative,
    Complex<f64>,
    solver::w_derivative,
    solver::w_derivative_batch
);

pub struct Erf;
batch!(Erf, Complex<f64>, solver::erf, solver::erf_batch);
batch!(Erf, f64, solver::erf_real, solver::erf_real_batch);

pub struct Erfc;
batch!(Erfc, Complex<f64>, solver::erfc, solver::erfc_batch);
batch!(Erfc, f64, solver::erfc_real, solver::erfc_real_batch);

pub struct Erfcx;
batch!(Erfcx, Complex<f64>, solver::erfcx, solver::erfcx_batch);
batch!(Erfcx, f64, solver::erfcx_real, solver::erfcx_real_batch);

pub struct Erfi;
batch!(Erfi, Complex<f64>, solver::erfi, solver::erfi_batch);
batch!(Erfi, f64, solver::erfi_real, solver::erfi_real_batch);

pub struct Dawsn;
batch!(Dawsn, Complex<f64>, solver::dawson, solver::dawson_batch);
batch!(Dawsn, f64, solver::dawson_real, solver::dawson_real_batch);

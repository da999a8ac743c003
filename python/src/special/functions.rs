//! The function that each ufunc computes.

use mechaudit::solvers::faddeeva as solver;
use num_complex::Complex;

/// A function of one variable on numbers of type `T`.
pub trait Function<T> {
    fn one(x: T) -> T;
    /// At all of `x`; the slices have one length. The values have the bits of [`Function::one`].
    fn many(x: &[T], y: &mut [T]);
}

/// A function with a batch of its own.
macro_rules! batch {
    ($name:ident, $one:path, $many:path) => {
        impl Function<Complex<f64>> for $name {
            fn one(x: Complex<f64>) -> Complex<f64> {
                $one(x)
            }
            fn many(x: &[Complex<f64>], y: &mut [Complex<f64>]) {
                let done = $many(x, y);
                debug_assert!(done.is_ok());
            }
        }
    };
}

/// A function called point by point.
macro_rules! pointwise {
    ($name:ident, $type:ty, $one:path) => {
        impl Function<$type> for $name {
            fn one(x: $type) -> $type {
                $one(x)
            }
            fn many(x: &[$type], y: &mut [$type]) {
                for (y, &x) in y.iter_mut().zip(x) {
                    *y = $one(x);
                }
            }
        }
    };
}

pub struct Wofz;
batch!(Wofz, solver::faddeeva, solver::faddeeva_batch);

pub struct WofzDerivative;
pointwise!(WofzDerivative, Complex<f64>, solver::w_derivative);

pub struct Erf;
pointwise!(Erf, Complex<f64>, solver::erf);
pointwise!(Erf, f64, solver::erf_real);

pub struct Erfc;
pointwise!(Erfc, Complex<f64>, solver::erfc);
pointwise!(Erfc, f64, solver::erfc_real);

pub struct Erfcx;
batch!(Erfcx, solver::erfcx, solver::erfcx_batch);
pointwise!(Erfcx, f64, solver::erfcx_real);

pub struct Erfi;
pointwise!(Erfi, Complex<f64>, solver::erfi);
pointwise!(Erfi, f64, solver::erfi_real);

pub struct Dawsn;
batch!(Dawsn, solver::dawson, solver::dawson_batch);
pointwise!(Dawsn, f64, solver::dawson_real);

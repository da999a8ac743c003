//! The Faddeeva function and its relatives as NumPy ufuncs.

mod float_status;
mod functions;
mod loops;
mod stored;
mod ufunc;

use functions::{Dawsn, Erf, Erfc, Erfcx, Erfi, Wofz, WofzDerivative};
use loops::{unary, voigt};
use num_complex::Complex;
use numpy::npyffi::NPY_TYPES::{NPY_CDOUBLE, NPY_CFLOAT, NPY_DOUBLE, NPY_FLOAT};
use pyo3::prelude::*;
use ufunc::{Loop, ufunc};

type C32 = Complex<f32>;
type C64 = Complex<f64>;

/// Adds every ufunc to the module.
pub fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
    // Double precision first, as scipy.special has it: NumPy gives integers and other numbers to
    // the first loop that takes them.
    macro_rules! both {
        ($function:ty) => {
            vec![
                Loop::new(unary::<$function, f64>, &[NPY_DOUBLE, NPY_DOUBLE]),
                Loop::new(unary::<$function, f32>, &[NPY_FLOAT, NPY_FLOAT]),
                Loop::new(unary::<$function, C64>, &[NPY_CDOUBLE, NPY_CDOUBLE]),
                Loop::new(unary::<$function, C32>, &[NPY_CFLOAT, NPY_CFLOAT]),
            ]
        };
    }
    macro_rules! complex {
        ($function:ty) => {
            vec![
                Loop::new(unary::<$function, C64>, &[NPY_CDOUBLE, NPY_CDOUBLE]),
                Loop::new(unary::<$function, C32>, &[NPY_CFLOAT, NPY_CFLOAT]),
            ]
        };
    }
    let all = [
        (c"wofz", include_str!("docs/wofz.txt"), complex!(Wofz)),
        (
            c"wofz_derivative",
            include_str!("docs/wofz_derivative.txt"),
            complex!(WofzDerivative),
        ),
        (c"erf", include_str!("docs/erf.txt"), both!(Erf)),
        (c"erfc", include_str!("docs/erfc.txt"), both!(Erfc)),
        (c"erfcx", include_str!("docs/erfcx.txt"), both!(Erfcx)),
        (c"erfi", include_str!("docs/erfi.txt"), both!(Erfi)),
        (c"dawsn", include_str!("docs/dawsn.txt"), both!(Dawsn)),
        (
            c"voigt_profile",
            include_str!("docs/voigt_profile.txt"),
            vec![
                Loop::new(voigt::<f64>, &[NPY_DOUBLE; 4]),
                Loop::new(voigt::<f32>, &[NPY_FLOAT; 4]),
            ],
        ),
    ];
    for (name, doc, loops) in all {
        module.add(
            name.to_string_lossy(),
            ufunc(module.py(), name, doc, loops)?,
        )?;
    }
    Ok(())
}

//! The imaginary error function.

use super::laws::{odd_law, on_the_axis, plain, real_argument_law};
use super::regions::zero_of_erfi;
use super::relative::{
    Exact, NORM_OF_PRODUCTS, Relative, Zeros, erf_from_w, negated, odd_limit, odd_signs,
};
use crate::audit::{Expected, Law};
use crate::methods::common::held;
use crate::methods::definition::method;
use crate::methods::special::complex::{C, exponential};
use crate::methods::special::identities::{gaussian, point, same_pair, within};
use crate::reference::faddeeva;
use crate::solvers::faddeeva::{dawson, erf, erfi, erfi_real};
use num_complex::Complex;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Input `Re z, Im z`, output `Re erfi z, Im erfi z`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Erfi;

method! {
    Erfi "erfi": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for Erfi {
    const SUMMARY: &'static str =
        "imaginary error function erfi(z) = -i erf(iz) in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.1, 7.5.1";
    const OUTPUTS: [&'static str; 2] = ["Re erfi", "Im erfi"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "erf at iz: an ulp each for the exponential, W, their product and the last rounding",
    );
    const NORM: (f64, &'static str) = NORM_OF_PRODUCTS;
    const VALUE: fn(C) -> C = erfi;
    const EXACT: Exact = faddeeva::erfi_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero_of_erfi,
        mirrored: [true, true],
        stored: 14,
    };

    fn from_w(w: fn(C) -> C, z: C) -> C {
        -C::i() * erf_from_w(w, C::i() * z)
    }

    fn slope(z: C, _: C) -> C {
        FRAC_2_SQRT_PI * exponential(z * z)
    }

    fn limit(x: f64, y: f64) -> [Expected; 2] {
        let [re, im] = odd_limit(1, -y, x);
        [im, negated(re)]
    }

    /// erfi′ = (2/√π) e^{z²} is positive on both axes.
    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
        odd_signs(x, y)
    }

    fn laws() -> Vec<Law> {
        vec![
            odd_law::<Erfi>(),
            Law {
                name: "turned",
                statement: "erfi(z) = -i erf(iz), bit for bit",
                residual: turned,
            },
            Law {
                name: "dawson",
                statement: "erfi(z) = 2/sqrt(pi) exp(z^2) F(z) within 16 u |erfi(z)|, for |z| <= 1e8",
                residual: by_dawson,
            },
            real_argument_law(|input| on_the_axis(Self::VALUE, erfi_real, input)),
        ]
    }
}

fn turned(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let e = erf(C::new(-z.im, z.re));
    held(same_pair(erfi(z), C::new(e.im, -e.re)))
}

fn by_dawson(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (e, f, g) = (erfi(z), dawson(z), gaussian(C::new(-z.im, z.re), 1));
    if !(z.norm() <= 1e8 && plain(&[e, f, g])) {
        return None;
    }
    // 4 u of each value, 8 u of the roundings of the products, the exponential and the constant.
    within(e - g * f * FRAC_2_SQRT_PI, 16.0, e.norm())
}

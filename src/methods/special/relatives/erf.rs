//! The error function.

use super::laws::{odd_law, on_the_axis, real_argument_law};
use super::regions::zero_of_erf;
use super::relative::{
    Exact, NORM_OF_PRODUCTS, Relative, Zeros, erf_from_w, odd_limit, odd_signs, on_the_real_line,
};
use crate::audit::{Expected, Law, ProvedBound};
use crate::methods::definition::method;
use crate::methods::special::complex::{C, exponential};
use crate::methods::special::identities::{gaussian, point, within};
use crate::reference::faddeeva;
use crate::solvers::faddeeva::{erf, erf_real, erfc, faddeeva as w};
use num_complex::Complex;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Input `Re z, Im z`, output `Re erf z, Im erf z`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Erf;

method! {
    Erf "erf": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for Erf {
    const SUMMARY: &'static str = "error function erf(z) in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.1, 7.2.2, 7.5.1";
    const OUTPUTS: [&'static str; 2] = ["Re erf", "Im erf"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "1 - exp(-z^2) W(iz) or a series without cancellation, else in double-double: an ulp each \
         for the exponential, W, their product and the last rounding",
    );
    const NORM: (f64, &'static str) = NORM_OF_PRODUCTS;
    const VALUE: fn(C) -> C = erf;
    const EXACT: Exact = faddeeva::erf_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero_of_erf,
        mirrored: [true, true],
        stored: 14,
    };

    fn from_w(w: fn(C) -> C, z: C) -> C {
        erf_from_w(w, z)
    }

    fn slope(z: C, _: C) -> C {
        FRAC_2_SQRT_PI * exponential(-z * z)
    }

    fn limit(x: f64, y: f64) -> [Expected; 2] {
        odd_limit(1, x, y)
    }

    /// erf′ = (2/√π) e^{−z²} is positive on both axes.
    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
        odd_signs(x, y)
    }

    fn proved() -> Vec<ProvedBound> {
        on_the_real_line("real arguments, by erf_real", "mechaudit prove erf")
    }

    fn laws() -> Vec<Law> {
        vec![
            odd_law::<Erf>(),
            Law {
                name: "complement",
                statement: "erf(z) + erfc(z) = 1 within 5 u (|erf(z)| + |erfc(z)|)",
                residual: complement,
            },
            Law {
                name: "faddeeva",
                statement: "erf(z) = 1 - exp(-z^2) W(iz) within 16 u (1 + |erf(z)|), for \
                            0 <= Re z, |z| <= 1e8",
                residual: by_w,
            },
            real_argument_law(|input| on_the_axis(Self::VALUE, erf_real, input)),
        ]
    }
}

fn complement(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (a, b) = (erf(z), erfc(z));
    // Each is within 4 u, and the sum of the two is rounded.
    within((a - 1.0) + b, 5.0, a.norm() + b.norm())
}

fn by_w(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    if !(z.re >= 0.0 && z.norm() <= 1e8) {
        return None;
    }
    let (e, w, g) = (erf(z), w(C::new(-z.im, z.re)), gaussian(z, 1));
    if !(e.norm() < 1e290 && g.norm() < 1e290) {
        return None;
    }
    // 4 u of erf, 4 u of W, 6 u of the product's roundings and of the exponential's, 2 u of the
    // sum.
    within((e - 1.0) + g * w, 16.0, 1.0 + e.norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_with_w_ends_before_the_exponential_overflows() {
        // e^{y²} at 0 + iy, where erf is 1/(√π y) of it.
        let law = |size: f64| by_w(&[0.0, libm::sqrt(libm::log(size))]);
        assert!(law(0.9e290).is_some_and(|r| r < 1.0));
        assert_eq!(law(1.1e290), None);
    }
}

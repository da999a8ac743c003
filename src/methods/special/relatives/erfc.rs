//! The complementary error function.

use super::laws::{conjugation_law, on_the_axis, plain, real_argument_law};
use super::regions::zero_of_erfc;
use super::relative::{
    Exact, NORM_OF_PRODUCTS, Relative, Zeros, negated, odd_limit, on_axis, on_the_real_line,
};
use crate::audit::{Expected, Law, ProvedBound};
use crate::methods::definition::method;
use crate::methods::special::complex::{C, exponential};
use crate::methods::special::identities::{gaussian, point, within};
use crate::reference::Ball;
use crate::reference::faddeeva;
use crate::solvers::faddeeva::{erfc, erfc_real, erfcx};
use num_complex::Complex;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Input `Re z, Im z`, output `Re erfc z, Im erfc z`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Erfc;

method! {
    Erfc "erfc": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for Erfc {
    const SUMMARY: &'static str =
        "complementary error function erfc(z) = 1 - erf(z) in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.2, 7.4.2";
    const OUTPUTS: [&'static str; 2] = ["Re erfc", "Im erfc"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "exp(-z^2) W(iz), 2 minus it or 1 minus a series, again in double-double where the terms \
         cancel: an ulp each for the exponential, W, their product and the last rounding",
    );
    const NORM: (f64, &'static str) = NORM_OF_PRODUCTS;
    const VALUE: fn(C) -> C = erfc;
    const EXACT: Exact = faddeeva::erfc_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero_of_erfc,
        mirrored: [false, true],
        stored: 12,
    };

    fn from_w(w: fn(C) -> C, z: C) -> C {
        exponential(-z * z) * w(C::i() * z)
    }

    fn slope(z: C, _: C) -> C {
        -FRAC_2_SQRT_PI * exponential(-z * z)
    }

    fn limit(x: f64, y: f64) -> [Expected; 2] {
        let [re, im] = odd_limit(1, x, y);
        let re = match re {
            Expected::Number(erf) => Expected::Number(Ball::integer(64, 1) - &erf),
            other => other,
        };
        [re, negated(im)]
    }

    /// erfc falls along the real axis.
    fn signs_of_zero(_: f64, y: f64) -> [Option<bool>; 2] {
        [None, on_axis(y, -1.0)]
    }

    fn proved() -> Vec<ProvedBound> {
        on_the_real_line("real arguments, by erfc_real", "mechaudit prove erfc")
    }

    fn laws() -> Vec<Law> {
        vec![
            conjugation_law::<Erfc>(),
            Law {
                name: "reflection",
                statement: "erfc(z) + erfc(-z) = 2 within 5 u (|erfc(z)| + |erfc(-z)|)",
                residual: reflection,
            },
            Law {
                name: "scaled",
                statement: "erfc(z) = exp(-z^2) erfcx(z) within 14 u |erfc(z)|, for |z| <= 1e8",
                residual: scaled,
            },
            real_argument_law(|input| on_the_axis(Self::VALUE, erfc_real, input)),
        ]
    }
}

fn reflection(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (a, b) = (erfc(z), erfc(-z));
    // Each is within 4 u, and the sum of the two is rounded.
    let rest = match a.norm() > b.norm() {
        true => (a - 2.0) + b,
        false => (b - 2.0) + a,
    };
    within(rest, 5.0, a.norm() + b.norm())
}

fn scaled(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (e, f, g) = (erfc(z), erfcx(z), gaussian(z, 1));
    if !(z.norm() <= 1e8 && plain(&[e, f, g])) {
        return None;
    }
    // 4 u of each value, 6 u of the product's roundings and of the exponential's.
    within(e - g * f, 14.0, e.norm())
}

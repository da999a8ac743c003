//! Dawson's function.

use super::laws::{odd_law, on_the_axis, real_argument_law};
use super::regions::zero_of_erfi;
use super::relative::{
    Exact, NORM_OF_PRODUCTS, Relative, Zeros, odd_limit, on_axis, on_the_real_line,
};
use crate::audit::{Expected, Law, ProvedBound};
use crate::methods::definition::method;
use crate::methods::special::complex::{C, exponential};
use crate::methods::special::identities::{batch_agrees, equation, point};
use crate::reference::Ball;
use crate::reference::faddeeva;
use crate::solvers::faddeeva::{dawson, dawson_batch, dawson_real};
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::PI;

/// Input `Re z, Im z`, output `Re F, Im F`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Dawson;

method! {
    Dawson "dawson": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for Dawson {
    const SUMMARY: &'static str =
        "Dawson's function F(z) = exp(-z^2) int_0^z exp(t^2) dt in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.5, 7.5.1";
    const OUTPUTS: [&'static str; 2] = ["Re F", "Im F"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "the difference of exp(-z^2) and W, again in double-double where they cancel: an ulp each \
         for the exponential, W, their difference and the last rounding",
    );
    const NORM: (f64, &'static str) = NORM_OF_PRODUCTS;
    const VALUE: fn(C) -> C = dawson;
    const EXACT: Exact = faddeeva::dawson_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero_of_erfi,
        mirrored: [true, true],
        stored: 14,
    };

    fn from_w(w: fn(C) -> C, z: C) -> C {
        C::new(0.0, PI.sqrt() / 2.0) * (exponential(-z * z) - w(z))
    }

    fn slope(z: C, value: C) -> C {
        1.0 - 2.0 * z * value
    }

    fn limit(x: f64, y: f64) -> [Expected; 2] {
        odd_limit(0, x, y)
    }

    /// On the imaginary axis `F(iy) = i (√π/2) e^{y²} erf y` grows with y. On the real axis
    /// `F′ = 1 − 2xF` is positive up to the maximum of F, negative beyond.
    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
        let im = match y == 0.0 {
            true => slope_is_negative(x).map(|negative| y.is_sign_negative() != negative),
            // F = 1/(2z) + … there.
            false if x.is_infinite() && y.is_finite() => Some(y > 0.0),
            false => None,
        };
        [on_axis(x, 1.0), im]
    }

    fn proved() -> Vec<ProvedBound> {
        on_the_real_line("real arguments, by dawson_real", "mechaudit prove dawson")
    }

    fn laws() -> Vec<Law> {
        vec![
            odd_law::<Dawson>(),
            Law {
                name: "differential-equation",
                statement: "the Taylor series of F' = 1 - 2 z F from F(z) gives F(z + h), \
                            |h| = 1/(8 max(|z|, 1)), within 16 u (|F(z)| + |F(z + h)| + |h|), for \
                            |z| <= 1e6",
                residual: |input| equation(dawson, C::new(1.0, 0.0), point(input)?),
            },
            Law {
                name: "batch",
                statement: "a batch of 1 to 40 points around z gives the scalar values, bit for bit",
                residual: |input| {
                    batch_agrees(point(input)?, 40, Self::VALUE, |z, f| {
                        dawson_batch(z, f).is_ok()
                    })
                },
            },
            real_argument_law(|input| on_the_axis(Self::VALUE, dawson_real, input)),
        ]
    }
}

/// Returns whether `F′(x) = 1 − 2xF(x) < 0`, if that is certain. The maximum of F is irrational, so
/// 256 bits decide every `f64`; 64 do but where x is next to it.
fn slope_is_negative(x: f64) -> Option<bool> {
    let Some(re) = Rational::from_f64(x) else {
        return x.is_infinite().then_some(true);
    };
    let double = Rational::from(&re * 2);
    [64, 256].into_iter().find_map(|bits| {
        let [f, _] = faddeeva::dawson_scaled(&re, &Rational::new(), bits).ok()?;
        let slope = Ball::integer(bits, 1) - &(Ball::rational(bits, &double) * &f.to_ball());
        (!slope.contains_zero()).then(|| slope.is_negative())
    })
}

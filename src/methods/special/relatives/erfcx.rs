//! The scaled complementary error function.

use super::laws::{conjugation_law, on_the_axis, real_argument_law};
use super::regions::zero_of_erfc;
use super::relative::{Exact, Relative, Zeros, on_the_real_line};
use crate::audit::{BranchAt, Expected, Law, ProvedBound};
use crate::methods::common::held;
use crate::methods::definition::method;
use crate::methods::special::branches::nearest;
use crate::methods::special::complex::{C, NORM};
use crate::methods::special::faddeeva::{expected_not_finite, signs_of_zero};
use crate::methods::special::identities::{batch_agrees, gaussian, point, within};
use crate::reference::faddeeva;
use crate::solvers::faddeeva::{SEAMS, branch, erfcx, erfcx_batch, erfcx_real, faddeeva as w};
use num_complex::Complex;
use std::f64::consts::FRAC_2_SQRT_PI;

/// Input `Re z, Im z`, output `Re erfcx z, Im erfcx z`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Erfcx;

method! {
    Erfcx "erfcx": Fn(Complex<f64>), |f, z| f(z.into())
}

impl Relative for Erfcx {
    const SUMMARY: &'static str =
        "scaled complementary error function erfcx(z) = exp(z^2) erfc(z) in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.3";
    const OUTPUTS: [&'static str; 2] = ["Re erfcx", "Im erfcx"];
    const ULPS: (f64, &'static str) = (
        4.0,
        "W(iz), whose components come from sums without cancellation or in double-double; 4 ulp \
         leave the exponential, the scaling and the table entries an ulp each",
    );
    const NORM: (f64, &'static str) = NORM;
    const VALUE: fn(C) -> C = erfcx;
    const EXACT: Exact = faddeeva::erfcx_scaled;
    const ZEROS: Zeros = Zeros {
        at: zero_of_erfc,
        mirrored: [false, true],
        stored: 12,
    };

    fn from_w(w: fn(C) -> C, z: C) -> C {
        w(C::i() * z)
    }

    fn slope(z: C, value: C) -> C {
        2.0 * z * value - FRAC_2_SQRT_PI
    }

    fn limit(x: f64, y: f64) -> [Expected; 2] {
        expected_not_finite(-y, x)
    }

    fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
        signs_of_zero(-y, x)
    }

    /// Those of w at `i z`.
    fn branch(z: Complex<f64>) -> Option<BranchAt> {
        let turned = Complex::new(-z.im, z.re);
        let at = nearest(turned, &SEAMS, Some(format!("{:?}", branch(turned))))?;
        Some(BranchAt {
            seam: format!("{} of i z", at.seam),
            ..at
        })
    }

    fn proved() -> Vec<ProvedBound> {
        on_the_real_line("real arguments, by erfcx_real", "mechaudit prove erfcx")
    }

    fn laws() -> Vec<Law> {
        vec![
            conjugation_law::<Erfcx>(),
            Law {
                name: "faddeeva",
                statement: "erfcx(z) = W(iz) within 8 u |W(iz)|",
                residual: by_w,
            },
            Law {
                name: "reflection",
                statement: "erfcx(z) + erfcx(-z) = 2 exp(z^2) within 7 u (|erfcx(z)| + |erfcx(-z)|), \
                            for |z| <= 1e8",
                residual: reflection,
            },
            Law {
                name: "batch",
                statement: "a batch of 1 to 40 points around z gives the scalar values, bit for bit",
                residual: |input| {
                    batch_agrees(point(input)?, 40, Self::VALUE, |z, f| {
                        erfcx_batch(z, f).is_ok()
                    })
                },
            },
            real_argument_law(|input| on_the_axis(Self::VALUE, erfcx_real, input)),
            Law {
                name: "monotonicity",
                statement: "on the real axis erfcx does not grow from x to x + 2^-40 |x|",
                residual: |input| monotonic(erfcx_real, point(input)?.re),
            },
        ]
    }
}

fn by_w(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    let (e, w) = (erfcx(z), w(C::new(-z.im, z.re)));
    // 4 u of each.
    within(e - w, 8.0, w.norm())
}

fn reflection(input: &[f64]) -> Option<f64> {
    let z = point(input)?;
    if !(z.norm() <= 1e8) {
        return None;
    }
    let (a, b) = (erfcx(z), erfcx(-z));
    // 4 u of each value, and the rounding of the three terms.
    let rest = (a - gaussian(C::new(-z.im, z.re), 2)) + b;
    within(rest, 7.0, a.norm() + b.norm())
}

fn monotonic(f: impl Fn(f64) -> f64, x: f64) -> Option<f64> {
    if !x.is_finite() {
        return None;
    }
    let next = x + x.abs() * 2f64.powi(-40);
    held(f(next) <= f(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn erfcx_may_not_grow_along_the_axis() {
        let jump = |at: f64, to: f64| move |x: f64| if x > at { to } else { 1.0 };
        let law = |at: f64, to: f64, x: f64| monotonic(jump(at, to), x);
        let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
        assert_eq!(law(3.0, 1.0, 3.0), holds);
        assert_eq!(law(3.0, 0.5, 3.0), holds);
        assert_eq!(law(3.0, 1.5, 3.0), broken);
        // 2^-40 |x| is 2.73e-12 for x = 3 and x = -3.
        for x in [3.0, -3.0] {
            assert_eq!(law(x + 2.7e-12, 1.5, x), broken);
            assert_eq!(law(x + 2.8e-12, 1.5, x), holds);
        }
        for x in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert_eq!(law(3.0, 1.5, x), None);
        }
    }
}

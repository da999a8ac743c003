//! The Faddeeva function.

pub(super) mod curves;
mod laws;
pub(super) mod regions;

use super::branches::nearest;
use super::complex::{ComplexInput, NORM, PROOF, asked, expected_part, number};
use crate::audit::{
    BranchAt, Budget, Domain, Expected, Law, Limit, NormBudget, Output, Proof, ProvedBound,
    ProvedError, ReferenceAnswer, Uncertified,
};
use crate::methods::common::output;
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::Number;
use crate::reference::Undecided;
use crate::reference::faddeeva::{Scaled, w, w_scaled};
use crate::solvers::faddeeva::{PROVED_NORM, SEAMS, branch, faddeeva};
use num_complex::Complex;
use rug::Rational;

/// The Faddeeva function: input `Re z, Im z`, output `Re W, Im W`.
///
/// A candidate is a `Fn(Complex<f64>) -> Complex<f64>`.
#[derive(Clone, Copy, Debug)]
pub struct Faddeeva;

method! {
    Faddeeva "faddeeva": Fn(Complex<f64>), |f, z| f(z.into())
}

fn expected_parts(re: &Rational, im: &Rational, bits: u32) -> Result<Vec<Expected>, Undecided> {
    let bits = asked(bits);
    Ok(match w(re, im, bits) {
        Ok(w) => vec![Expected::Number(w.re), Expected::Number(w.im)],
        Err(_) => w_scaled(re, im, bits)?.iter().map(expected_part).collect(),
    })
}

/// The limits at infinity, where there are any. W tends to 0 in the closed upper half-plane and
/// for Im z < 0 with Re z → ±∞, to +∞ down the imaginary axis, on which it is real.
pub(super) fn expected_not_finite(x: f64, y: f64) -> [Expected; 2] {
    if x == 0.0 && y == f64::NEG_INFINITY {
        return [Expected::Infinity { negative: false }, number(0)];
    }
    if x.is_nan() || y.is_nan() {
        let im = if x == 0.0 {
            number(0)
        } else {
            Expected::NotANumber
        };
        return [Expected::NotANumber, im];
    }
    if y > f64::NEG_INFINITY {
        return [number(0), number(0)];
    }
    [Expected::NotANumber, Expected::NotANumber]
}

/// On the imaginary axis `Im W(x + iy) = −x E′(y) + …`, `E = erfcx`, and erfcx falls everywhere. At
/// infinity `W = i/(√π z) + …`, but for `Im z ≤ 0` beside the axes.
pub(super) fn signs_of_zero(x: f64, y: f64) -> [Option<bool>; 2] {
    let re = match y == f64::INFINITY {
        true => Some(false),
        false => (x.is_infinite() && y.is_finite() && y != 0.0).then_some(y < 0.0),
    };
    let im = match x == 0.0 || (x.is_infinite() && y.is_finite()) || y == f64::INFINITY {
        true if !x.is_nan() => Some(x.is_sign_negative()),
        _ => None,
    };
    [re, im]
}

impl Definition for Faddeeva {
    type Input<'a, T: Number> = ComplexInput<'a, T>;
    const SUMMARY: &'static str = "Faddeeva function W(z) = exp(-z^2) erfc(-iz) in the whole plane";
    const SOURCE: &'static str = "DLMF 7.2.3; Faddeyeva & Terent'ev 1961";

    fn outputs() -> Vec<Output> {
        let budget = Budget::new(
            Limit::Ulps(4.0),
            "every component comes from sums without cancellation or in double-double, rounded \
             once; 4 ulp leave the exponential, the scaling and the table entries an ulp each",
        );
        ["Re W", "Im W"]
            .map(|name| output(name, "1", budget))
            .to_vec()
    }

    fn norm_budget() -> Option<NormBudget> {
        Some(NormBudget::new(NORM.0, NORM.1))
    }

    fn proved() -> Vec<ProvedBound> {
        vec![ProvedBound {
            error: ProvedError::Norm(2.0 * PROVED_NORM),
            inputs: "Im z >= 0",
            command: "mechaudit prove faddeeva",
        }]
    }

    fn domain() -> Domain {
        Domain {
            regions: regions::all(),
            check_points: regions::check_points(),
        }
    }

    fn signs_of_zero(z: Self::Input<'_, f64>) -> Vec<Option<bool>> {
        signs_of_zero(z.re, z.im).to_vec()
    }

    fn solve(z: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let w = faddeeva(z.into());
        Ok(vec![w.re, w.im])
    }

    fn branch(z: Self::Input<'_, f64>) -> Option<BranchAt> {
        let z = z.into();
        nearest(z, &SEAMS, Some(format!("{:?}", branch(z))))
    }

    fn reference(z: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        Ok(ReferenceAnswer::Expected(
            expected_parts(z.re, z.im, bits)?,
            PROOF,
        ))
    }

    fn reference_not_finite(z: Self::Input<'_, f64>) -> ReferenceAnswer {
        ReferenceAnswer::Expected(expected_not_finite(z.re, z.im).to_vec(), Proof::Exact)
    }

    fn certify(z: Self::Input<'_, Rational>, bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        Ok(w_scaled(z.re, z.im, bits)?.to_vec())
    }

    fn laws() -> Vec<Law> {
        laws::all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 48 bits fewer, but not fewer than 64.
    #[test]
    fn fewer_bits_are_asked_for() {
        let all = [
            (0, 64),
            (64, 64),
            (112, 64),
            (113, 65),
            (128, 80),
            (400, 352),
        ];
        for (bits, due) in all {
            assert_eq!(asked(bits), due, "{bits}");
        }
    }

    fn reference(x: f64, y: f64) -> Vec<Expected> {
        let exact = [x, y].map(|v| Rational::from_f64(v).unwrap());
        expected_parts(&exact[0], &exact[1], 128).unwrap()
    }

    #[test]
    fn what_no_ball_holds() {
        // Re W(10^200) = e^{-10^400} is not zero, Im W = 10^-200/√π.
        let d = reference(1e200, 0.0);
        assert!(d[0].number().unwrap().magnitude() < crate::reference::Mag::power_of_two(-1100));
        assert_eq!(d[1].to_decimal(5).unwrap(), "5.6419e-201");
        // W(−10^200 i) = 2e^{10^400}.
        let d = reference(0.0, -1e200);
        assert!(matches!(d[0], Expected::Infinity { negative: false }));
        assert!(d[1].number().unwrap().is_zero());
        // Off the axis both components have the sign of the phase −2xy: here cos 2 < 0, sin 2 > 0.
        let tiny = 2f64.powi(-600);
        let d = reference(tiny, -(2f64.powi(600)));
        assert!(matches!(d[0], Expected::Infinity { negative: true }));
        assert!(matches!(d[1], Expected::Infinity { negative: false }));
    }

    #[test]
    fn at_infinity() {
        let inf = f64::INFINITY;
        let shown = |x, y| expected_not_finite(x, y).map(|d| d.to_decimal(3).unwrap());
        assert_eq!(shown(inf, 0.0), ["0", "0"]);
        assert_eq!(shown(-inf, -5.0), ["0", "0"]);
        assert_eq!(shown(3.0, inf), ["0", "0"]);
        assert_eq!(shown(-0.0, -inf), ["inf", "0"]);
        assert_eq!(shown(1.0, -inf), ["nan", "nan"]);
        assert_eq!(shown(inf, -inf), ["nan", "nan"]);
        assert_eq!(shown(0.0, f64::NAN), ["nan", "0"]);
        assert_eq!(shown(f64::NAN, 1.0), ["nan", "nan"]);
    }

    /// At infinity w is i/(√π z): the real part has the sign of Im z, the imaginary part that of Re
    /// z.
    #[test]
    fn signs_of_zero_at_infinity_and_on_the_axis() {
        let (inf, plus, minus) = (f64::INFINITY, Some(false), Some(true));
        for ((x, y), due) in [
            ((1.0, inf), [plus, plus]),
            ((-1.0, inf), [plus, minus]),
            ((-0.0, inf), [plus, minus]),
            ((-inf, inf), [plus, minus]),
            ((inf, 2.0), [plus, plus]),
            ((-inf, -2.0), [minus, minus]),
            ((inf, 0.0), [None, plus]),
            ((-0.0, 3.0), [None, minus]),
            ((0.0, -3.0), [None, plus]),
            ((1.0, 3.0), [None, None]),
            ((1.0, -inf), [None, None]),
            ((inf, -inf), [None, None]),
            ((f64::NAN, inf), [plus, None]),
        ] {
            assert_eq!(signs_of_zero(x, y), due, "{x} {y}");
        }
    }

    /// They are asked of a method, and an answer with the other sign is wrong.
    #[test]
    fn a_wrong_sign_of_zero_is_found() {
        let method = crate::methods::find("faddeeva").unwrap();
        let input = [-2.0, f64::INFINITY];
        assert_eq!(method.signs_of_zero(&input), [Some(false), Some(true)]);
        let verdict = |value: [f64; 2]| {
            let case = crate::audit::Case {
                method: "faddeeva",
                region: "any",
                input: input.to_vec(),
                origin: crate::audit::Origin::CheckPoint {
                    name: "at infinity",
                },
            };
            let answer = crate::audit::SolverAnswer::Values(value.to_vec());
            let settings = crate::audit::Settings::default();
            crate::audit::judge_case(&*method, case, answer, &settings)
                .judgement
                .verdict
        };
        assert_eq!(verdict([0.0, -0.0]), crate::audit::Verdict::Pass);
        for wrong in [[-0.0, -0.0], [0.0, 0.0]] {
            assert_ne!(verdict(wrong), crate::audit::Verdict::Pass, "{wrong:?}");
        }
    }
}

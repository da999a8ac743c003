//! Half the width of the Voigt profile.

use super::complex::asked;
use super::faddeeva::regions::{beside, listed_seams, seam};
use super::identities::{U, same};
use super::voigt::regions::any_bits;
use crate::audit::{
    Budget, CheckPoint, Domain, Draw, Expected, Law, Limit, Output, Proof, ReferenceAnswer, Region,
    Uncertified,
};
use crate::methods::common::{held, output, point, region};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::faddeeva::{self as reference, Scaled};
use crate::solvers::faddeeva::{LIMITS_OF_VOIGT_HWHM, SEAMS, voigt, voigt_hwhm};
use rug::Rational;
use std::f64::consts::{LN_2, SQRT_2};
use std::sync::LazyLock;

inputs! {
    /// The two widths of a Voigt profile.
    pub struct VoigtHwhmInput {
        /// Standard deviation of the normal part.
        sigma: number "sigma", "1";
        /// Half the width of the Cauchy part at half its height.
        gamma: number "gamma", "1";
    }
}

/// Half the width of the Voigt profile at half its maximum: input `sigma, gamma`, output x with
/// `V(x) = V(0)/2`.
///
/// A candidate is a `Fn(sigma, gamma) -> f64`.
#[derive(Clone, Copy, Debug)]
pub struct VoigtHwhm;

method! {
    VoigtHwhm "voigt-hwhm": Fn(f64, f64), |f, i| f(i.sigma, i.gamma)
}

impl Definition for VoigtHwhm {
    type Input<'a, T: Number> = VoigtHwhmInput<'a, T>;
    const SUMMARY: &'static str =
        "Half the width at half the maximum of the Voigt profile of sigma and gamma";
    const SOURCE: &'static str = "DLMF 7.19.1 in other units; V(x) = V(0)/2";

    fn outputs() -> Vec<Output> {
        let budget = Budget::new(
            Limit::Ulps(1.0),
            "half an ulp for the last rounding, a quarter more where a subnormal value is rounded twice; \
             the rest for Re W at two points, known to a few hundredths before it is rounded, which the \
             slope there carries over at most once into x (0.72 times for gamma = 0, once for sigma = 0)",
        );
        vec![output("x", "1", budget)]
    }

    fn domain() -> Domain {
        Domain {
            regions: regions(),
            check_points: check_points(),
        }
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        Ok(vec![voigt_hwhm(i.sigma, i.gamma)])
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        if *i.sigma < 0 || *i.gamma < 0 {
            return Ok(ReferenceAnswer::Expected(
                vec![Expected::NotANumber],
                Proof::Exact,
            ));
        }
        let x = reference::voigt_hwhm(i.sigma, i.gamma, asked(bits))?;
        let proof = Proof::Bounded(
            "V - V(0)/2 falls and changes its sign between two floats, by balls \
             (reference::faddeeva::voigt_hwhm)",
        );
        Ok(ReferenceAnswer::Expected(vec![Expected::Number(x)], proof))
    }

    /// The width is at least that of either part.
    fn reference_not_finite(i: Self::Input<'_, f64>) -> ReferenceAnswer {
        let value = match i.sigma >= 0.0 && i.gamma >= 0.0 {
            true => Expected::Infinity { negative: false },
            false => Expected::NotANumber,
        };
        ReferenceAnswer::Expected(vec![value], Proof::Exact)
    }

    /// Widths are not negative.
    fn signs_of_zero(_: Self::Input<'_, f64>) -> Vec<Option<bool>> {
        vec![Some(false)]
    }

    fn certify(i: Self::Input<'_, Rational>, bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        Ok(vec![reference::voigt_hwhm(i.sigma, i.gamma, bits)?.into()])
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "units",
                statement: "x(sigma/8, gamma/8) = x(sigma, gamma)/8, bit for bit, where nothing is \
                            subnormal or overflows",
                residual: |input| units(voigt_hwhm, input),
            },
            Law {
                name: "half",
                statement: "V(x) = V(0)/2 within 12 u, where neither is subnormal or overflows",
                residual: half,
            },
            Law {
                name: "pure",
                statement: "x(0, gamma) = gamma, bit for bit; x(sigma, 0) = sigma sqrt(2 ln 2) within 3 u",
                residual: |input| pure(voigt_hwhm, input),
            },
        ]
    }
}

fn arguments(input: &[f64]) -> Option<[f64; 2]> {
    let i = VoigtHwhm::unpack(input)?;
    Some([i.sigma, i.gamma])
}

fn plain(t: f64) -> bool {
    (1e-300..1e300).contains(&t)
}

fn units(width: impl Fn(f64, f64) -> f64, input: &[f64]) -> Option<f64> {
    let [s, g] = arguments(input)?;
    let good = |t: f64| t == 0.0 || plain(t);
    let x = width(s, g);
    if !(good(s) && good(g) && plain(x)) {
        return None;
    }
    held(same(width(s / 8.0, g / 8.0), x / 8.0))
}

/// `|d ln V/d ln x| = 2 t |Re W′|/Re W` is at most 2 ln 2 there; 4 u in x and 3 u in each value.
fn half(input: &[f64]) -> Option<f64> {
    let [s, g] = arguments(input)?;
    let x = voigt_hwhm(s, g);
    let (v, top) = (voigt(x, s, g), voigt(0.0, s, g));
    if !(plain(x) && plain(v) && plain(top)) {
        return None;
    }
    Some((v / top - 0.5).abs() / (0.5 * 12.0 * U))
}

fn pure(width: impl Fn(f64, f64) -> f64, input: &[f64]) -> Option<f64> {
    let [s, g] = arguments(input)?;
    if !(plain(s) && plain(g)) {
        return None;
    }
    let gauss = width(s, 0.0) / s / (SQRT_2 * LN_2.sqrt());
    held(same(width(0.0, g), g) && (gauss - 1.0).abs() <= 6.0 * U)
}

/// The lines of W on which y may lie, and the function's own limits of y.
static LINES: LazyLock<Vec<f64>> = LazyLock::new(|| [SEAMS.im, &LIMITS_OF_VOIGT_HWHM].concat());

static ON_SEAMS: LazyLock<String> = LazyLock::new(|| {
    format!(
        "gamma is {} times sigma sqrt 2, exactly, nearly or 0.6..1.1 times that",
        listed_seams(&LINES)
    )
});

/// Returns widths at which `γ/(σ√2)` is p, and σ about 1.
fn ratio(p: f64, d: &mut Draw) -> Vec<f64> {
    let sigma = d.log_uniform(1e-3, 1e3);
    vec![sigma, p * sigma * SQRT_2]
}

fn regions() -> Vec<Region> {
    vec![
        region("comparable", "sigma = 0.05..2, gamma < 3", |d| {
            vec![d.uniform(0.05, 2.0), d.uniform(0.0, 3.0)]
        }),
        region(
            "any-ratio",
            "gamma = 1e-20..1e20 sigma, sigma = 1e-3..1e3",
            |d| ratio(d.log_uniform(1e-20, 1e20), d),
        ),
        region(
            "narrow-lorentz",
            "gamma = 1e-20..1 times sigma sqrt 2",
            |d| ratio(d.log_uniform(1e-20, 1.0), d),
        ),
        region("narrow-gauss", "gamma = 1..1e5 times sigma sqrt 2", |d| {
            ratio(d.log_uniform(1.0, 1e5), d)
        }),
        region("normal", "gamma = 0, sigma = 1e-308..1e308", |d| {
            vec![d.log_uniform(1e-308, 1e308), 0.0]
        }),
        region("cauchy", "sigma = 0, gamma = 1e-308..1e308", |d| {
            vec![0.0, d.log_uniform(1e-308, 1e308)]
        }),
        // |t + iy| or y on one of the limits of W's formulas.
        region("seams", &ON_SEAMS, |d| {
            let edge = seam(&LINES, d);
            let p = match d.chance(0.5) {
                true => beside(edge, d),
                false => edge * d.uniform(0.6, 1.1),
            };
            ratio(p, d)
        }),
        region("subnormal", "sigma and gamma 5e-324..1e-300 or zero", |d| {
            let mut tiny = || d.zero_or_log(0.25, 5e-324, 1e-300);
            vec![tiny(), tiny()]
        }),
        region("overflow", "sigma and gamma 1e306..1.7e308", |d| {
            vec![d.log_uniform(1e306, 1.7e308), d.log_uniform(1e306, 1.7e308)]
        }),
        region("any-exponent", "sigma, gamma = 1e-308..1e308", |d| {
            vec![d.log_uniform(1e-308, 1e308), d.log_uniform(1e-308, 1e308)]
        }),
        region(
            "any-bits",
            "any bit patterns, widths seldom negative",
            |d| vec![any_bits(0.05, d), any_bits(0.05, d)],
        ),
    ]
}

fn check_points() -> Vec<CheckPoint> {
    let (inf, nan, max, min) = (f64::INFINITY, f64::NAN, f64::MAX, f64::from_bits(1));
    let named: [(_, [f64; 2]); 27] = [
        ("unit-normal", [1.0, 0.0]),
        ("unit-cauchy", [0.0, 1.0]),
        ("both", [1.0, 1.0]),
        ("point-mass", [0.0, 0.0]),
        ("minus-zero-widths", [-0.0, -0.0]),
        ("minus-zero-sigma", [-0.0, 1.0]),
        ("minus-zero-gamma", [1.0, -0.0]),
        ("smallest-widths", [min, min]),
        ("smallest-sigma", [min, 1.0]),
        ("smallest-gamma", [1.0, min]),
        ("smallest-sigma-alone", [min, 0.0]),
        ("largest-widths", [max, max]),
        ("largest-sigma", [max, 1.0]),
        ("largest-gamma", [1.0, max]),
        ("largest-and-smallest", [max, min]),
        ("smallest-and-largest", [min, max]),
        ("last-that-fits", [1.5e308, 1.0]),
        ("infinite-sigma", [inf, 1.0]),
        ("infinite-gamma", [0.0, inf]),
        ("infinite-widths", [inf, inf]),
        ("negative-sigma", [-1.0, 1.0]),
        ("negative-gamma", [1.0, -min]),
        ("minus-infinite-sigma", [-inf, 1.0]),
        ("infinite-and-negative", [inf, -1.0]),
        ("nan-sigma", [nan, 1.0]),
        ("nan-gamma", [1.0, nan]),
        ("nan-and-infinite", [inf, nan]),
    ];
    named.map(|(name, input)| point(name, input)).to_vec()
}

#[cfg(test)]
mod tests;

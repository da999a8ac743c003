//! The Voigt profile.

pub(super) mod regions;

use super::complex::{PROOF, asked, expected_part, number};
use super::identities::{U, same};
use crate::audit::{
    Budget, Domain, Expected, Law, Limit, Output, Proof, ReferenceAnswer, Uncertified,
};
use crate::methods::common::{held, output};
use crate::methods::definition::{Definition, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::faddeeva::{Scaled, voigt_scaled};
use crate::solvers::faddeeva::{faddeeva as w, voigt, voigt_batch};
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::{PI, SQRT_2};

inputs! {
    /// An abscissa and the two widths.
    pub struct VoigtInput {
        x: number "x", "1";
        /// Standard deviation of the normal part.
        sigma: number "sigma", "1";
        /// Half the width of the Cauchy part at half its height.
        gamma: number "gamma", "1";
    }
}

/// The Voigt profile: input `x, sigma, gamma`, output the density.
///
/// A candidate is a `Fn(x, sigma, gamma) -> f64`.
#[derive(Clone, Copy, Debug)]
pub struct Voigt;

method! {
    Voigt "voigt": Fn(f64, f64, f64), |f, i| f(i.x, i.sigma, i.gamma)
}

impl Definition for Voigt {
    type Input<'a, T: Number> = VoigtInput<'a, T>;
    const SUMMARY: &'static str =
        "Voigt profile: density of a normal (sigma) plus a Cauchy variable (gamma) at x";
    const SOURCE: &'static str = "DLMF 7.19.1 in other units";

    fn outputs() -> Vec<Output> {
        let budget = Budget::new(
            Limit::Ulps(3.0),
            "Re W at quotients kept to 100 bits: 2 ulp of Re W in the upper half-plane, one more for \
             the slope and the scaling",
        );
        vec![output("V", "1", budget)]
    }

    fn domain() -> Domain {
        Domain {
            regions: regions::all(),
            check_points: regions::check_points(),
        }
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        Ok(vec![voigt(i.x, i.sigma, i.gamma)])
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        if *i.sigma < 0 || *i.gamma < 0 {
            return Ok(ReferenceAnswer::Expected(
                vec![Expected::NotANumber],
                Proof::Exact,
            ));
        }
        if *i.sigma == 0 && *i.gamma == 0 {
            // A point mass.
            let value = match *i.x == 0 {
                true => Expected::Infinity { negative: false },
                false => number(0),
            };
            return Ok(ReferenceAnswer::Expected(vec![value], Proof::Exact));
        }
        let value = voigt_scaled(i.x, i.sigma, i.gamma, asked(bits))?;
        Ok(ReferenceAnswer::Expected(
            vec![expected_part(&value)],
            PROOF,
        ))
    }

    fn reference_not_finite(i: Self::Input<'_, f64>) -> ReferenceAnswer {
        // Spread over the whole line, or looked at infinitely far away.
        let value = match i.x.is_nan() || !(i.sigma >= 0.0 && i.gamma >= 0.0) {
            true => Expected::NotANumber,
            false => number(0),
        };
        ReferenceAnswer::Expected(vec![value], Proof::Exact)
    }

    /// V ≥ 0.
    fn signs_of_zero(_: Self::Input<'_, f64>) -> Vec<Option<bool>> {
        vec![Some(false)]
    }

    fn certify(i: Self::Input<'_, Rational>, bits: u32) -> Result<Vec<Scaled>, Uncertified> {
        Ok(vec![voigt_scaled(i.x, i.sigma, i.gamma, bits)?])
    }

    fn laws() -> Vec<Law> {
        vec![
            Law {
                name: "even",
                statement: "V(-x) = V(x), bit for bit",
                residual: |input| even(voigt, input),
            },
            Law {
                name: "units",
                statement: "V(x/8, sigma/8, gamma/8) = 8 V(x, sigma, gamma), bit for bit, where \
                            nothing is subnormal or overflows",
                residual: |input| units(voigt, input),
            },
            Law {
                name: "batch",
                statement: "a batch of 1 to 9 points around x gives the scalar values, bit for bit",
                residual: |input| {
                    batch_agrees(arguments(input)?, |x, s, g, v| {
                        voigt_batch(x, s, g, v).is_ok()
                    })
                },
            },
            Law {
                name: "peak",
                statement: "0 <= V(x) <= V(0) (1 + 12 u)",
                residual: |input| {
                    let [x, s, g] = arguments(input)?;
                    peak(voigt(x, s, g), voigt(0.0, s, g))
                },
            },
            Law {
                name: "faddeeva",
                statement: "V = Re W((x + i gamma)/(sigma sqrt 2))/(sigma sqrt(2 pi)) within \
                            (20 + 8 |z|^2) u |W|/(sigma sqrt(2 pi)), for |z| < 1e6, sigma = 1e-100..1e100",
                residual: by_w,
            },
        ]
    }
}

fn arguments(input: &[f64]) -> Option<[f64; 3]> {
    let i = Voigt::unpack(input)?;
    Some([i.x, i.sigma, i.gamma])
}

fn even(v: impl Fn(f64, f64, f64) -> f64, input: &[f64]) -> Option<f64> {
    let [x, s, g] = arguments(input)?;
    held(same(v(x, s, g), v(-x, s, g)))
}

fn units(density: impl Fn(f64, f64, f64) -> f64, input: &[f64]) -> Option<f64> {
    let all = arguments(input)?;
    let [x, s, g] = all;
    let v = density(x, s, g);
    // V is at most 1/(2π |x|), 1/(π γ) and 0.4/σ: where it is not small, no argument is large.
    let plain = |t: f64| t == 0.0 || (t.is_finite() && t.abs() >= 1e-300);
    if !(v != 0.0 && plain(v) && all.into_iter().all(plain)) {
        return None;
    }
    held(same(density(x / 8.0, s / 8.0, g / 8.0), 8.0 * v))
}

fn batch_agrees(
    [x, s, g]: [f64; 3],
    batch: impl Fn(&[f64], f64, f64, &mut [f64]) -> bool,
) -> Option<f64> {
    let n = 1 + x.to_bits() as usize % 9;
    let points: Vec<f64> = (0..n).map(|k| x * (1.0 + 0.25 * k as f64)).collect();
    let mut values = vec![0.0; n];
    let done = batch(&points, s, g, &mut values);
    let mut pairs = points.iter().zip(&values);
    held(done && pairs.all(|(&x, &v)| same(v, voigt(x, s, g))))
}

/// Of `V(x)` and `V(0)`.
fn peak(v: f64, top: f64) -> Option<f64> {
    if v.is_nan() || top.is_nan() {
        return None;
    }
    // 6 u of each; units below the normal numbers are larger.
    held(v >= 0.0 && v <= top * (1.0 + 12.0 * U) + 6.0 * f64::from_bits(1))
}

fn by_w(input: &[f64]) -> Option<f64> {
    let [x, s, g] = arguments(input)?;
    let z = Complex::new(x / s / SQRT_2, g / s / SQRT_2);
    if !((1e-100..1e100).contains(&s) && g >= 0.0 && z.norm() < 1e6) {
        return None;
    }
    let (w, unit) = (w(z), s * (2.0 * PI).sqrt());
    // z is rounded twice in each component, 2|z| u in all, and |W'| ≤ 2|z||W| + 2/√π where |W| is
    // small only where |z| is large: z W tends to i/√π.
    let allowed = (20.0 + 8.0 * z.norm_sqr()) * U * w.norm();
    Some((voigt(x, s, g) * unit - w.re).abs() / allowed)
}

#[cfg(test)]
mod tests;

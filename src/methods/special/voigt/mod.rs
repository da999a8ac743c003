//! The Voigt profile.

mod regions;

use super::faddeeva::{asked, due};
use super::relatives::laws::{U, same};
use super::relatives::{PROOF, number};
use crate::audit::{Budget, Domain, Due, Law, Limit, Output, Proof, ReferenceAnswer, Uncertified};
use crate::methods::common::{held, output};
use crate::methods::definition::Definition;
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
            return Ok(ReferenceAnswer::Dues(vec![Due::NotANumber], Proof::Exact));
        }
        if *i.sigma == 0 && *i.gamma == 0 {
            // A point mass.
            let value = match *i.x == 0 {
                true => Due::Infinity { negative: false },
                false => number(0),
            };
            return Ok(ReferenceAnswer::Dues(vec![value], Proof::Exact));
        }
        let value = voigt_scaled(i.x, i.sigma, i.gamma, asked(bits))?;
        Ok(ReferenceAnswer::Dues(vec![due(&value)], PROOF))
    }

    fn reference_not_finite(i: Self::Input<'_, f64>) -> ReferenceAnswer {
        // Spread over the whole line, or looked at infinitely far away.
        let value = match i.x.is_nan() || !(i.sigma >= 0.0 && i.gamma >= 0.0) {
            true => Due::NotANumber,
            false => number(0),
        };
        ReferenceAnswer::Dues(vec![value], Proof::Exact)
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
mod tests {
    use super::*;
    use std::cell::Cell;

    fn shown(answer: ReferenceAnswer) -> String {
        match answer {
            ReferenceAnswer::Dues(dues, _) => dues[0].to_decimal(5).unwrap(),
            other => panic!("{other:?}"),
        }
    }

    /// A point mass where both widths are zero; no width is negative.
    #[test]
    fn what_is_due_at_the_ends_of_the_widths() {
        let method = crate::methods::find("voigt").unwrap();
        for (input, due) in [
            ([0.0, 0.0, 0.0], "inf"),
            ([1.0, 0.0, 0.0], "0"),
            ([0.0, -1.0, 1.0], "nan"),
            ([0.0, 1.0, -1.0], "nan"),
            // 1/(π γ).
            ([0.0, 0.0, 1.0], "0.31831"),
            // 1/(σ √(2π)).
            ([0.0, 1.0, 0.0], "0.39894"),
        ] {
            let exact = input.map(|x| Rational::from_f64(x).unwrap());
            assert_eq!(shown(method.reference(&exact, 128)), due, "{input:?}");
        }
        let (inf, nan) = (f64::INFINITY, f64::NAN);
        for (input, due) in [
            ([inf, 1.0, 1.0], "0"),
            ([-inf, 0.0, 0.0], "0"),
            ([0.0, inf, 1.0], "0"),
            ([0.0, 1.0, inf], "0"),
            ([nan, 1.0, 1.0], "nan"),
            ([nan, inf, 1.0], "nan"),
            ([0.0, -inf, 1.0], "nan"),
            ([inf, 1.0, -1.0], "nan"),
            ([0.0, nan, 1.0], "nan"),
            ([0.0, 1.0, nan], "nan"),
        ] {
            assert_eq!(shown(method.reference_not_finite(&input)), due, "{input:?}");
        }
        assert_eq!(method.signs_of_zero(&[inf, 1.0, 1.0]), [Some(false)]);
    }
    use std::collections::BTreeSet;

    #[test]
    fn batches_have_all_lengths_from_x_on() {
        let lengths: BTreeSet<usize> = (0..20)
            .map(|k| {
                let length = Cell::new(0);
                let x = 1.0 + f64::from(k) * f64::EPSILON;
                let refused = batch_agrees([x, 1.0, 0.5], |points, _, _, _| {
                    length.set(points.len());
                    assert_eq!(points[0], x);
                    false
                });
                assert_eq!(refused, Some(f64::INFINITY));
                length.get()
            })
            .collect();
        assert_eq!(lengths, (1..=9).collect());
    }

    #[test]
    fn a_batch_that_differs_or_refuses_breaks_the_law() {
        let broken = f64::INFINITY;
        for (by, done, due) in [
            (1.0, true, 0.0),
            (1.0, false, broken),
            (1.0 + f64::EPSILON, true, broken),
        ] {
            let law = batch_agrees([1.5, 1.0, 0.5], |points, s, g, values| {
                for (value, &x) in values.iter_mut().zip(points) {
                    *value = voigt(x, s, g) * by;
                }
                done
            });
            assert_eq!(law, Some(due), "{by} {done}");
        }
    }

    #[test]
    fn beside_the_peak_the_profile_may_exceed_it_by_rounding_alone() {
        let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
        let tiny = f64::from_bits(1);
        for (v, top, due) in [
            (0.5, 1.0, holds),
            (1.0 + 12.0 * U, 1.0, holds),
            (1.0 + 14.0 * U, 1.0, broken),
            (3.0, 2.0, broken),
            (6.0 * tiny, 0.0, holds),
            (7.0 * tiny, 0.0, broken),
            (-tiny, 1.0, broken),
            (f64::NAN, 1.0, None),
        ] {
            assert_eq!(peak(v, top), due, "{v:e} {top:e}");
        }
    }

    #[test]
    fn the_law_with_w_holds_up_to_a_million() {
        let law = |x: f64| by_w(&[x, 1.0, 1.0]);
        assert!(law(1.4e6).is_some_and(|r| r < 1.0));
        assert_eq!(law(1.5e6), None);
    }

    #[test]
    fn the_law_with_w_asks_for_widths_of_a_profile() {
        let holds = |s: f64, g: f64| by_w(&[s, s, g]).map(|r| r < 1.0);
        for (s, g, due) in [
            (1e-100, 1e-100, Some(true)),
            (0.9e-100, 1e-100, None),
            (0.9e100, 1e100, Some(true)),
            (1e100, 1e100, None),
            (1.0, 0.0, Some(true)),
            (1.0, -1e-300, None),
            (1.0, f64::NAN, None),
            (-1.0, 1.0, None),
        ] {
            assert_eq!(holds(s, g), due, "{s:e} {g:e}");
        }
    }

    #[test]
    fn a_function_that_is_no_density_breaks_the_laws() {
        let (holds, broken) = (Some(0.0), Some(f64::INFINITY));
        let input = [3.0, 2.0, 1.0];
        assert_eq!(even(|x, s, g| x * x + s + g, &input), holds);
        assert_eq!(even(|x, s, g| x + s + g, &input), broken);
        assert_eq!(units(|x, s, g| 1.0 / (x + s + g), &input), holds);
        assert_eq!(units(|_, _, _| 1.0, &input), broken);
        for one in [0, 1, 2] {
            let of_others = |x: f64, s: f64, g: f64| {
                let mut all = [x, s, g];
                all[one] = 1.0;
                1.0 / all.iter().sum::<f64>()
            };
            assert_eq!(units(of_others, &input), broken, "{one}");
        }
        assert_eq!(units(|_, _, _| 1.0, &input[..2]), None);
    }

    #[test]
    fn units_are_changed_where_nothing_is_subnormal() {
        for (t, applies) in [
            (1e-300, true),
            (0.9e-300, false),
            (0.0, true),
            (-1e-300, true),
            (f64::INFINITY, false),
            (f64::NAN, false),
        ] {
            for place in [0, 1, 2] {
                let mut input = [1.0; 3];
                input[place] = t;
                let law = units(|_, _, _| 1.0, &input);
                assert_eq!(law.is_some(), applies, "{t:e} at {place}");
            }
        }
        for (v, applies) in [
            (1e-300, true),
            (0.9e-300, false),
            (0.0, false),
            (f64::INFINITY, false),
        ] {
            let law = units(|_, _, _| v, &[1.0; 3]);
            assert_eq!(law.is_some(), applies, "{v:e}");
        }
    }
}

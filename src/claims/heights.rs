//! From which distance to the real axis on a code reaches an accuracy.

use super::code::Code;
use super::effort::Effort;
use super::{WHOLE, at, measured, regions};
use crate::audit::{Draw, Judge, Method, Settings, SolverAnswer};
use crate::methods::find;
use rayon::prelude::*;
use serde::Serialize;

/// Relative errors that users ask for; the last is 2 ε.
pub const TARGETS: [f64; 4] = [1e-4, 1e-6, 1e-10, 2.0 * f64::EPSILON];
/// Powers of ten that bound the bands; the lowest band is the axis itself and all below `10^LOW`.
const LOW: i32 = -20;
const HIGH: i32 = 3;

/// Where no point was found with a larger error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Height {
    /// The accuracy.
    pub target: f64,
    /// `Im z ≥ 10^k` and |Re z| < 1e5 of the norm; `−∞` for every `Im z ≥ 0`, nothing if nowhere.
    pub norm: Option<f64>,
    /// Of each part, likewise.
    pub parts: Option<f64>,
}

/// The points of the band above `10^k`; of that below all others for `k = LOW − 1`.
fn points(k: i32, effort: &Effort) -> Vec<Vec<f64>> {
    let band = (k + 64) as u64;
    (0..effort.cases)
        .map(|i| {
            let mut d = Draw::new(effort.seed, "atlas", "heights", band << 32 | i);
            let x = match d.uniform(0.0, 1.0) {
                u if u < 0.5 => d.uniform(0.0, 30.0),
                u if u < 0.75 => regions::fourth(&mut d, 64.0),
                _ => d.log_uniform(1e-3, 1e5),
            };
            let y = match k < LOW {
                true if d.chance(0.5) => 0.0,
                true => d.log_uniform(1e-300, 1e-20),
                false => 10f64.powi(k) * d.log_uniform(1.0, 10.0),
            };
            regions::either_side(x, y, &mut d)
        })
        .collect()
}

/// For each code, its heights.
pub fn heights(codes: &[&Code], effort: &Effort) -> Vec<Vec<Height>> {
    let method = find("faddeeva").expect("a method of the registry");
    let variant = measured(&*method, codes.first().copied());
    let single = codes.first().is_some_and(|c| c.single);
    // Of each code and band the worst, of the norm and of a part.
    let mut worst: Vec<Vec<[f64; 2]>> = vec![Vec::new(); codes.len()];
    for k in LOW - 1..HIGH {
        let mut inputs = points(k, effort);
        let numbers = inputs.iter_mut().flatten().filter(|_| single);
        numbers.for_each(|x| *x = f64::from(*x as f32));
        let answers: Vec<Vec<SolverAnswer>> = codes.iter().map(|c| c.answers(&inputs)).collect();
        let found: Vec<Vec<[f64; 2]>> = (0..inputs.len())
            .into_par_iter()
            .map(|i| {
                let each = answers.iter().map(|a| a.get(i).cloned());
                errors(&variant, &inputs[i], each)
            })
            .collect();
        for (c, worst) in worst.iter_mut().enumerate() {
            let largest = |part: usize| found.iter().map(|f| f[c][part]).fold(0.0, f64::max);
            worst.push([largest(0), largest(1)]);
        }
    }
    worst.iter().map(|bands| of_bands(bands)).collect()
}

/// The relative errors of each answer, of the norm and the larger of its parts; infinite where it
/// is no number.
pub fn errors(
    variant: &dyn Method,
    input: &[f64],
    answers: impl Iterator<Item = Option<SolverAnswer>>,
) -> Vec<[f64; 2]> {
    let settings = Settings::default();
    let unit = 2f64.powi(-(variant.format().precision() as i32));
    let judge = Judge::new(variant, &settings);
    let mut referee = judge.referee(at("faddeeva", input));
    answers
        .map(|answer| {
            let Some(answer) = answer else {
                return [f64::INFINITY; 2];
            };
            let judgement = referee.judge(answer, false).judgement;
            if !judgement.is_measured() {
                return [f64::INFINITY; 2];
            }
            let parts = judgement.components.iter().map(|c| c.of_budget * WHOLE);
            [judgement.normwise * unit, parts.fold(0.0, f64::max)]
        })
        .collect()
}

fn of_bands(bands: &[[f64; 2]]) -> Vec<Height> {
    let from = |target: f64, part: usize| {
        let good = bands.iter().rev().take_while(|b| b[part] <= target).count();
        match good {
            0 => None,
            n if n == bands.len() => Some(f64::NEG_INFINITY),
            n => Some(f64::from(HIGH - n as i32)),
        }
    };
    let height = |&target: &f64| Height {
        target,
        norm: from(target, 0),
        parts: from(target, 1),
    };
    TARGETS.iter().map(height).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{Limit, Variant};
    use crate::solvers::faddeeva::faddeeva;
    use mechaudit_atlas::Parts;
    use mechaudit_atlas::Plane;
    use num_complex::Complex;

    #[test]
    fn heights_are_counted_from_above() {
        let mut bands = vec![[0.0; 2]; (HIGH - LOW + 1) as usize];
        assert_eq!(of_bands(&bands)[3].norm, Some(f64::NEG_INFINITY));
        // Bad below 1e-2.
        let bad = (-2 - (LOW - 1)) as usize;
        bands[bad - 1][1] = 1e-5;
        let found = of_bands(&bands);
        assert_eq!(found[0].parts, Some(f64::NEG_INFINITY));
        assert_eq!(found[1].parts, Some(-2.0));
        assert_eq!(found[1].norm, Some(f64::NEG_INFINITY));
        bands.last_mut().unwrap()[0] = f64::INFINITY;
        assert_eq!(of_bands(&bands)[0].norm, None);
    }

    #[test]
    fn bands_are_full_of_points_of_their_own() {
        let effort = Effort { cases: 40, seed: 1 };
        for k in [LOW - 1, LOW, -3, HIGH - 1] {
            let all = points(k, &effort);
            assert_eq!(all.len(), 40);
            let (low, high) = match k < LOW {
                true => (0.0, 1e-20),
                false => (10f64.powi(k), 10f64.powi(k + 1)),
            };
            let slack = 1.0 + 1e-12;
            let inside = |z: &Vec<f64>| (low / slack..=high * slack).contains(&z[1]);
            assert!(all.iter().all(inside), "{k}: {all:?}");
            let on_the_axis = all.iter().filter(|z| z[1] == 0.0).count();
            assert_eq!(on_the_axis > 0, k < LOW);
        }
    }

    /// Half uniform up to 30, a quarter multiples of 1/4 up to 16, a quarter log-uniform.
    #[test]
    fn real_parts_are_drawn_in_three_ways() {
        let effort = Effort {
            cases: 8000,
            seed: 1,
        };
        let all: Vec<[f64; 2]> = points(-3, &effort)
            .iter()
            .map(|z| [z[0].abs(), z[1]])
            .collect();
        let (fourths, others): (Vec<f64>, Vec<f64>) = all
            .iter()
            .map(|z| z[0])
            .partition(|x| (4.0 * x).fract() == 0.0);
        assert!((1850..2150).contains(&fourths.len()), "{}", fourths.len());
        assert_eq!(fourths.iter().copied().fold(0.0, f64::max), 16.0);
        let between = |a: f64, b: f64| others.iter().filter(|x| (a..b).contains(*x)).count();
        // 4000 (30 − 16)/30 and 2000 log₁₀(30/16)/8; then 2000 log₁₀(1e5/30)/8.
        assert!((1800..2070).contains(&between(16.0, 30.0)));
        assert!((780..980).contains(&between(30.0, 1e5)));
        // 4000/30 and 2000 · 3/8.
        assert!((800..970).contains(&between(0.0, 1.0)));
        assert!(between(0.97e-3, 1.1e-3) > 3 && between(0.0, 0.97e-3) < 3);
        assert!(between(0.95e5, 1e5) > 2 && between(1e5, 1e9) == 0);
        let heights = all.iter().map(|z| z[1] * 1e3);
        let least = heights.clone().fold(f64::INFINITY, f64::min);
        assert!((0.999..1.01).contains(&least), "{least}");
        assert!((9.9..10.001).contains(&heights.fold(0.0, f64::max)));
    }

    #[test]
    fn the_lowest_band_is_the_axis_and_what_is_next_to_it() {
        let effort = Effort {
            cases: 4000,
            seed: 1,
        };
        let all = points(LOW - 1, &effort);
        let heights: Vec<f64> = all.iter().map(|z| z[1]).filter(|y| *y > 0.0).collect();
        assert!((1900..2100).contains(&heights.len()), "{}", heights.len());
        let above = |y: f64| heights.iter().filter(|x| **x > y).count();
        // Of 280 decades.
        assert!((980..1080).contains(&above(1e-164)) && above(1e-22) > 5);
        assert!(above(1e-299) < heights.len());
    }

    #[test]
    fn no_two_bands_have_a_point_in_common() {
        let effort = Effort { cases: 20, seed: 1 };
        let bands = LOW - 1..HIGH;
        let all = bands.flat_map(|k| points(k, &effort));
        let mut places: Vec<u64> = all.map(|z| z[0].to_bits()).collect();
        let count = places.len();
        places.sort_unstable();
        places.dedup();
        // But for multiples of 1/4, of which there are few.
        assert!(
            count == 24 * 20 && places.len() > count * 3 / 4,
            "{}",
            places.len()
        );
    }

    /// W times 1 + e, e a function of Im z.
    fn off<'a>(parts: Parts, e: impl Fn(f64) -> f64 + 'a) -> Code<'a> {
        Code::other(Default::default(), Plane::Upper, parts, move |points| {
            let answer = |z: &Vec<f64>| {
                let w = faddeeva(Complex::new(z[0], z[1])) * (1.0 + e(z[1]));
                SolverAnswer::Values(match parts {
                    Parts::Both => vec![w.re, w.im],
                    Parts::Real => vec![w.re],
                })
            };
            points.iter().map(answer).collect()
        })
    }

    #[test]
    fn a_code_reaches_an_accuracy_from_some_height_on() {
        let effort = Effort { cases: 3, seed: 1 };
        let e = |y: f64| if y < 0.0099 { 1e-5 } else { 1e-7 };
        let everywhere = Some(f64::NEG_INFINITY);
        let due = [everywhere, Some(-2.0), None, None];
        let (exact, low) = (off(Parts::Both, |_| 0.0), off(Parts::Both, e));
        let found = heights(&[&low, &exact], &effort);
        for h in found[0].iter().zip(due).zip(TARGETS) {
            let ((found, due), target) = h;
            assert_eq!((found.target, found.norm, found.parts), (target, due, due));
        }
        assert_eq!(
            (found[1][2].norm, found[1][2].parts),
            (everywhere, everywhere)
        );
        let found = heights(&[&off(Parts::Real, e)], &effort);
        let parts: Vec<Option<f64>> = found[0].iter().map(|h| h.parts).collect();
        assert_eq!(parts, due);
    }

    /// Asked at numbers of its own, and judged by their rounding.
    #[test]
    fn a_code_in_single_precision_is_asked_in_its_numbers() {
        let effort = Effort { cases: 3, seed: 1 };
        let asked = std::cell::RefCell::new(Vec::new());
        let answers = |points: &[Vec<f64>]| {
            asked.borrow_mut().extend(points.concat());
            let answer = |z: &Vec<f64>| {
                let w = faddeeva(Complex::new(z[0], z[1]));
                let e = if z[1] < 0.0099 { 1e-5 } else { 0.0 };
                SolverAnswer::Values(
                    [w.re, w.im]
                        .map(|x| f64::from((x * (1.0 + e)) as f32))
                        .into(),
                )
            };
            points.iter().map(answer).collect()
        };
        let mut code = Code::other(Default::default(), Plane::Upper, Parts::Both, answers);
        code.single = true;
        let found = heights(&[&code], &effort);
        let norm: Vec<Option<f64>> = found[0].iter().map(|h| h.norm).collect();
        assert_eq!(norm, [Some(f64::NEG_INFINITY), Some(-2.0), None, None]);
        drop(code);
        assert!(asked.take().iter().all(|x| f64::from(*x as f32) == *x));
    }

    /// At 1 + i, where Im w is 0.564 of |w|.
    #[test]
    fn errors_are_of_the_norm_and_of_the_worse_part() {
        let method = find("faddeeva").unwrap();
        let variant = Variant::new(&*method).limit(Limit::Relative(WHOLE));
        let [re, im] = [0.304_744_205_256_912_6, 0.208_218_938_202_831_62];
        let share = im / f64::hypot(re, im);
        let answers = [
            Some(SolverAnswer::Values(vec![re, im * 1.002])),
            Some(SolverAnswer::Values(vec![f64::NAN, im])),
            None,
            Some(SolverAnswer::Values(vec![re * 1.001, im * 1.001])),
        ];
        let found = errors(&variant, &[1.0, 1.0], answers.into_iter());
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| {
            assert!(
                (a / c - 1.0).abs() < 1e-9 && (b / d - 1.0).abs() < 1e-9,
                "{a} {b}"
            );
        };
        near(found[0], [2e-3 * share, 2e-3]);
        assert_eq!(found[1..3], [[f64::INFINITY; 2]; 2]);
        near(found[3], [1e-3, 1e-3]);
    }
}

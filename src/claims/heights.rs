//! From which distance to the real axis on a code reaches an accuracy.

use super::code::Code;
use super::whole::Effort;
use super::{WHOLE, at, regions};
use crate::audit::{Draw, Format, Judge, Limit, Method, Settings, SolverAnswer, Variant};
use crate::methods::find;
use mechaudit_atlas::Parts;
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
                _ => regions::log_uniform(&mut d, 1e-3, 1e5),
            };
            let y = match k < LOW {
                true if d.chance(0.5) => 0.0,
                true => regions::log_uniform(&mut d, 1e-300, 1e-20),
                false => 10f64.powi(k) * regions::log_uniform(&mut d, 1.0, 10.0),
            };
            regions::either_side(&mut d, x, y)
        })
        .collect()
}

/// For each code, its heights.
pub fn heights(codes: &[&Code], effort: &Effort) -> Vec<Vec<Height>> {
    let method = find("faddeeva").expect("a method of the registry");
    let mut variant = Variant::new(&*method).limit(Limit::Relative(WHOLE));
    let first = codes.first().map(|c| (c.parts, c.single));
    if let Some((Parts::Real, _)) = first {
        variant = variant.outputs(&["Re W"]).expect("an output of W");
    }
    if let Some((_, true)) = first {
        variant = variant.format(Format::Single);
    }
    // Of each code and band the worst, of the norm and of a part.
    let mut worst: Vec<Vec<[f64; 2]>> = vec![Vec::new(); codes.len()];
    for k in LOW - 1..HIGH {
        let inputs: Vec<Vec<f64>> = points(k, effort)
            .into_iter()
            .map(|z| match first {
                Some((_, true)) => z.iter().map(|x| f64::from(*x as f32)).collect(),
                _ => z,
            })
            .collect();
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

/// The relative errors of each answer, of the norm and the larger of its parts; infinite where it is no
/// number.
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
}

//! Fourier series of cam cycles.

use super::cam_law_input::{self as input, LawInput};
use crate::audit::{
    Budget, CheckPoint, Domain, Draw, HardCase, Input, Law, Limit, Method, Output, Proof,
    Reference, ReferenceAnswer, Region, Rows, SolverAnswer,
};
use crate::reference::cam_law::Law as ExactLaw;
use crate::reference::fourier_series::{self as exact, Orders, Stroke as ExactStroke};
use crate::reference::{Ball, Mag};
use crate::solvers::cam_law::{CamCycle, Stroke};
use crate::solvers::fourier_series::{FourierSeries, LAST_HARMONIC};
use rug::Rational;

/// See the module.
pub struct Audit;

// The layout of the input; the laws of the rise and of the return follow.
const LIFT: usize = 0;
const START: usize = 1;
const RISE: usize = 2;
const DWELL: usize = 3;
const FALL: usize = 4;
const FIRST: usize = 5;
const STRIDE: usize = 6;
const LAWS: usize = 7;

const BITS_OF_CONDITIONS: u32 = 128;

/// Harmonics of one case.
const HARMONICS: u32 = 8;

struct Parts<'a, T> {
    rise: LawInput<'a, T>,
    fall: LawInput<'a, T>,
}

fn laws<T: input::Count>(x: &[T]) -> Option<Parts<'_, T>> {
    let (rise, rest) = LawInput::split(x.get(LAWS..)?)?;
    let (fall, rest) = LawInput::split(rest)?;
    rest.is_empty().then_some(Parts { rise, fall })
}

/// The rise and, unless the cycle is carried on, the return.
fn exact_strokes(x: &[Rational]) -> Option<(ExactStroke, Option<ExactStroke>)> {
    let parts = laws(x)?;
    let (rise, fall) = (parts.rise.reference()?, parts.fall.reference()?);
    let rise = ExactStroke {
        law: rise,
        start: x[START].clone(),
        turns: x[RISE].clone(),
    };
    let fall = (x[FALL] != 0).then(|| ExactStroke {
        law: fall,
        start: Rational::from(&x[START] + &x[RISE]) + &x[DWELL],
        turns: x[FALL].clone(),
    });
    Some((rise, fall))
}

fn exact_orders(x: &[Rational]) -> Orders {
    Orders {
        first: x[FIRST].to_f64() as u32,
        stride: x[STRIDE].to_f64() as u32,
        count: HARMONICS,
    }
}

fn orders(x: impl Fn(usize) -> f64) -> impl Iterator<Item = u32> {
    let (first, stride) = (x(FIRST) as u32, x(STRIDE) as u32);
    (0..HARMONICS).map(move |k| first.saturating_add(k.saturating_mul(stride)))
}

fn series(x: &[f64]) -> Result<FourierSeries, &'static str> {
    let parts = laws(x).ok_or("bad layout")?;
    let stroke = |law: &LawInput<f64>, turns| {
        let law = law.solver().map_err(|_| "law")?;
        Ok::<_, &'static str>(Stroke { law, turns })
    };
    let rise = stroke(&parts.rise, x[RISE])?;
    let cycle = if x[FALL] == 0.0 {
        CamCycle::rise_dwell(x[LIFT], rise, 1.0 - x[RISE])
    } else {
        let fall = stroke(&parts.fall, x[FALL])?;
        let low = 1.0 - x[RISE] - x[DWELL] - x[FALL];
        CamCycle::new(x[LIFT], rise, x[DWELL], fall, low.max(0.0))
    };
    let cycle = cycle
        .and_then(|c| c.starting_at(x[START]))
        .map_err(|_| "cycle")?;
    Ok(FourierSeries::new(&cycle))
}

impl Method for Audit {
    fn name(&self) -> &'static str {
        "cam-fourier-series"
    }

    fn summary(&self) -> &'static str {
        "mean and eight Fourier coefficients of a cam cycle, harmonics up to a million"
    }

    fn source(&self) -> &'static str {
        "Gembara & Senyk, eqs (4)-(6), the period being the shaft's turn"
    }

    fn inputs(&self) -> Vec<Input> {
        let i = |name, unit| Input { name, unit };
        let mut all = vec![
            i("lift", "m"),
            i("start (of the rise)", "turn"),
            i("rise", "turn"),
            i("high_dwell", "turn"),
            i("return (0 for none)", "turn"),
            i("first (harmonic)", "1"),
            i("stride (from one harmonic to the next)", "1"),
        ];
        all.extend(input::inputs());
        all.extend(input::return_inputs());
        all
    }

    fn outputs(&self) -> Vec<Output> {
        let mean = Budget::new(
            Limit::Conditioned(4.0),
            "a sum of a few products of angles, each as good as half an ulp of the angles",
        );
        let coefficient = Budget::new(
            Limit::Normwise(64.0),
            "of the largest of the eight, for a condition of one (the lift); angles are exact. \
             Some 10 u of each stroke's share; besides, shares that cancel by up to a half, jumps \
             of derivatives that cancel by up to a factor of 10, eight harmonics all near zeros of \
             a transform by up to a factor of 5",
        );
        vec![
            Output {
                name: "a_0",
                unit: "m",
                budget: mean,
            },
            Output {
                name: "a_n",
                unit: "m",
                budget: coefficient,
            },
            Output {
                name: "b_n",
                unit: "m",
                budget: coefficient,
            },
        ]
    }

    fn hard(&self) -> Vec<HardCase> {
        HardCase::included(include_str!("../../reference/hard/cam-fourier-series.csv"))
    }

    fn rows(&self) -> Option<Rows> {
        Some(Rows {
            index: "k",
            count: "8",
            meaning: "the harmonics first + k stride, a_0 being the same in each",
        })
    }

    fn domain(&self) -> Domain {
        let region = |name, description, sample| Region {
            name,
            description,
            sample,
        };
        let point = |name, input| CheckPoint { name, input };
        let harmonic = [input::SCCA, 0.5, 2.0, 0.0, 1.0];
        let at = |numbers: [f64; LAWS]| {
            let mut x = numbers.to_vec();
            x.extend(harmonic);
            x.extend(harmonic);
            x
        };
        Domain {
            regions: vec![
                region("scca", "rise, dwell, return, dwell of two SCCA laws", |d| {
                    any_cycle(d, input::any_scca)
                }),
                region("symmetric-polynomials", "3-4-5 and 4-5-6-7", |d| {
                    any_cycle(d, input::any_symmetric)
                }),
                region(
                    "asymmetric",
                    "5 to 95 % of a stroke spent accelerating",
                    |d| any_cycle(d, input::any_asymmetric),
                ),
                region("polynomials", "degree 1 to 12", |d| {
                    any_cycle(d, input::any_polynomial)
                }),
                region("tables", "splines on 3 to 7 knots", |d| {
                    any_cycle(d, input::any_table)
                }),
                region("indexing", "a rise in each turn and no return", |d| {
                    let mut x = any_cycle(d, input::any_scca);
                    x[RISE] = d.uniform(0.2, 1.0);
                    (x[DWELL], x[FALL]) = (0.0, 0.0);
                    x
                }),
                region(
                    "short-strokes",
                    "strokes of 0.001 to 0.1 turns, harmonics 1 to 8",
                    |d| {
                        let mut x = any_cycle(d, input::any_asymmetric);
                        x[RISE] = d.log_uniform(1e-3, 0.1);
                        x[FALL] = d.log_uniform(1e-3, 0.1);
                        (x[FIRST], x[STRIDE]) = (1.0, 1.0);
                        x
                    },
                ),
                region(
                    "removable-singularities",
                    "n B b or n B d within 1e-12 to 1e-3 of 1/2",
                    near_singularity,
                ),
            ],
            check_points: vec![
                point(
                    "paper-law",
                    at([1.0, 0.1, 1.0 / 3.0, 1.0 / 6.0, 0.25, 1.0, 1.0]),
                ),
                point(
                    "indexing-cam",
                    at([1.0, 0.1, 1.0 / 3.0, 0.0, 0.0, 1.0, 1.0]),
                ),
                point(
                    "last",
                    at([1.0, 0.1, 1.0 / 3.0, 1.0 / 6.0, 0.25, 999_993.0, 1.0]),
                ),
            ],
        }
    }

    fn admits(&self, x: &[f64]) -> bool {
        let whole = |p: Parts<f64>| p.rise.is_whole() && p.fall.is_whole();
        laws(x).is_some_and(whole) && [FIRST, STRIDE].iter().all(|i| x[*i].fract() == 0.0)
    }

    fn solve(&self, x: &[f64]) -> SolverAnswer {
        let series = match series(x) {
            Ok(series) => series,
            Err(word) => return SolverAnswer::Refuses(word),
        };
        let mut values = Vec::new();
        for n in orders(|i| x[i]) {
            let Ok(h) = series.harmonic(n) else {
                return SolverAnswer::Refuses("harmonic");
            };
            values.extend([series.mean(), h.a, h.b]);
        }
        SolverAnswer::Values(values)
    }

    fn reference(&self, x: &[Rational], bits: u32) -> ReferenceAnswer {
        let Some((rise, fall)) = exact_strokes(x) else {
            return ReferenceAnswer::Refuses("bad layout");
        };
        if orders(|i| x[i].to_f64()).any(|n| !(1..=LAST_HARMONIC).contains(&n)) {
            return ReferenceAnswer::Refuses("harmonic");
        }
        let (lift, fall) = (&x[LIFT], fall.as_ref());
        let mean = exact::mean(lift, &rise, fall, bits);
        let mut values = Vec::new();
        for [a, b] in exact::harmonics(lift, &rise, fall, exact_orders(x), bits) {
            values.extend([mean.clone(), a, b]);
        }
        ReferenceAnswer::Values(Reference {
            values,
            proof: Proof::Bounded(
                "zones and polynomial pieces integrated in balls, phases reduced exactly \
                 (reference::fourier_series)",
            ),
        })
    }

    /// Of the mean all lengths are known to half an ulp, of the harmonics the lift alone; of a
    /// table also its data. Both follow from the values: the mean is a sum of terms proportional
    /// to one length each.
    fn conditions(&self, x: &[f64]) -> Option<Vec<f64>> {
        let exact: Option<Vec<Rational>> = x.iter().map(|&x| Rational::from_f64(x)).collect();
        self.conditions_beside(x, &self.reference(&exact?, BITS_OF_CONDITIONS))
    }

    fn conditions_beside(&self, x: &[f64], reference: &ReferenceAnswer) -> Option<Vec<f64>> {
        let ReferenceAnswer::Values(base) = reference else {
            return None;
        };
        let exact: Option<Vec<Rational>> = x.iter().map(|&x| Rational::from_f64(x)).collect();
        let exact = exact?;
        let size = |part: Option<ExactLaw>, left: bool| {
            let mean = part?.mean(BITS_OF_CONDITIONS);
            let mean = if left {
                Ball::integer(BITS_OF_CONDITIONS, 1) - mean
            } else {
                mean
            };
            Some(mean.magnitude().to_f64())
        };
        let parts = laws(&exact)?;
        let lengths = x[LIFT].abs()
            * match x[FALL] == 0.0 {
                true => x[START].abs() + x[RISE] * size(parts.rise.reference(), true)?,
                false => {
                    let rise = x[RISE] * size(parts.rise.reference(), false)?;
                    rise + x[DWELL] + x[FALL] * size(parts.fall.reference(), true)?
                }
            };
        let own = base.values.iter().enumerate().map(|(i, v)| {
            let size = v.magnitude().to_f64();
            if i % 3 == 0 { size + lengths } else { size }
        });
        let mut sums: Vec<f64> = own.collect();
        let tables = [
            parts.rise.is_table(),
            parts.fall.is_table() && x[FALL] != 0.0,
        ];
        if tables.contains(&true) {
            let (rise, fall) = exact_strokes(&exact)?;
            let mut data = vec![Mag::ZERO; sums.len()];
            for stroke in std::iter::once(rise)
                .chain(fall)
                .zip(tables)
                .filter_map(|(s, t)| t.then_some(s))
            {
                let (mean, harmonics) = exact::data_conditions(
                    &exact[LIFT],
                    &stroke,
                    exact_orders(&exact),
                    BITS_OF_CONDITIONS,
                );
                let all = harmonics.into_iter().flat_map(|[a, b]| [mean, a, b]);
                for (sum, own) in data.iter_mut().zip(all) {
                    *sum = sum.add(own);
                }
            }
            for (sum, data) in sums.iter_mut().zip(data) {
                *sum += data.to_f64();
            }
        }
        Some(sums)
    }

    fn laws(&self) -> Vec<Law> {
        vec![
            Law {
                name: "amplitude-and-phase",
                statement: "a_n = D_n cos delta_n and b_n = -D_n sin delta_n within 4 u D_n",
                residual: |x| worst(x, amplitude_and_phase),
            },
            Law {
                name: "decay",
                statement: "D_n is not greater than the bound on all harmonics from n on",
                residual: |x| worst(x, decay),
            },
        ]
    }
}

fn worst(x: &[f64], law: fn(&FourierSeries, u32) -> f64) -> Option<f64> {
    let series = series(x).ok()?;
    Some(
        orders(|i| x[i])
            .map(|n| law(&series, n))
            .fold(0.0, f64::max),
    )
}

fn amplitude_and_phase(series: &FourierSeries, n: u32) -> f64 {
    let Ok(h) = series.harmonic(n) else {
        return f64::NAN;
    };
    let (d, phase) = (h.amplitude(), h.phase());
    let off = (d * phase.cos() - h.a).abs() + (d * phase.sin() + h.b).abs();
    if off == 0.0 {
        0.0
    } else {
        off / (4.0 * f64::EPSILON * d)
    }
}

fn decay(series: &FourierSeries, n: u32) -> f64 {
    match series.harmonic(n) {
        Ok(h) => h.amplitude() / series.tail_bound(n - 1, 0),
        Err(_) => f64::NAN,
    }
}

/// Two laws of a family and up to the millionth harmonic, in steps of about a third of a period of
/// the transform.
fn any_cycle(d: &mut Draw, law: fn(&mut Draw) -> Vec<f64>) -> Vec<f64> {
    let (rise, fall) = (d.uniform(0.1, 0.45), d.uniform(0.1, 0.45));
    let dwell = d.uniform(0.0, 1.0 - rise - fall);
    let first = d.log_uniform(1.0, 9e5).floor();
    let stride = if first < 20.0 {
        1.0
    } else {
        d.integer(1, 7) as f64
    };
    let lift = d.log_uniform(1e-3, 10.0);
    let mut x = vec![lift, d.uniform(-1.0, 1.0), rise, dwell, fall, first, stride];
    x.extend(law(d));
    x.extend(law(d));
    x
}

fn near_singularity(d: &mut Draw) -> Vec<f64> {
    let mut x = any_cycle(d, input::any_scca);
    // Random shares, not those of a named law.
    let share = d.uniform(0.05, 0.9);
    let (b, dd) = if d.chance(0.5) {
        (share, 0.0)
    } else {
        (0.0, share)
    };
    x.truncate(LAWS);
    for _ in 0..2 {
        x.extend([input::SCCA, 0.5, 2.0, b, dd]);
    }
    let least = (0.5 / (0.45 * share)).ceil();
    let n = least + d.integer(0, (4.0 * least) as usize) as f64;
    let off = d.log_uniform(1e-12, 1e-3);
    let off = 1.0 + d.signed(off);
    x[RISE] = 0.5 / (n * share) * off;
    x[FALL] = 0.5 / ((n + 1.0) * share);
    x[DWELL] = d.uniform(0.0, 1.0 - x[RISE] - x[FALL]);
    (x[FIRST], x[STRIDE]) = (n, 1.0);
    x
}

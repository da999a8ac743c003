//! Fourier series of cam cycles.

use super::law_input::{self as input, LawInput};
use crate::audit::{
    Budget, Domain, Draw, Law, Limit, Output, ReferenceAnswer, Rows, Uncertified, largest,
};
use crate::methods::common::{output, point, region};
use crate::methods::definition::{Definition, conditions_at_reference, exact, method};
use crate::methods::inputs::{Number, inputs};
use crate::reference::cam_law::Law as ExactLaw;
use crate::reference::fourier_series::{self as reference, Orders, Stroke as ExactStroke};
use crate::reference::{Ball, Mag};
use crate::solvers::cam_law::{CamCycle, Stroke};
use crate::solvers::fourier_series::{FourierSeries, LAST_HARMONIC};
use rug::Rational;

inputs! {
    /// A cycle of a cam without its laws, and which harmonics are asked for.
    pub struct CamCycleInput {
        lift: number "lift", "m";
        start: number "start (of the rise)", "turn";
        rise: number "rise", "turn";
        high_dwell: number "high_dwell", "turn";
        fall: number "return (0 for none)", "turn";
        first: choice "first (harmonic)", "1";
        stride: choice "stride (from one harmonic to the next)", "1";
    }
}

inputs! {
    /// A cycle of a cam, and which harmonics are asked for.
    pub struct CamFourierSeriesInput {
        cycle: (CamCycleInput);
        kind: choice "kind (0 SCCA, 1 3-4-5, 2 4-5-6-7, 3 polynomial, 4 table)", "1";
        share: number "share (of the stroke spent accelerating)", "1";
        p: choice "p (number of parameters)", "1";
        parameters: list "parameters[p] (SCCA: b, d; polynomial: c_1 …; table: x_0 …, y_0 …)", "1";
        return_kind: choice "return_kind (as kind)", "1";
        return_share: number "return_share", "1";
        return_p: choice "return_p", "1";
        return_parameters: list "return_parameters[return_p]", "1";
    }
}

const BITS_OF_CONDITIONS: u32 = 128;
/// Harmonics of one case.
const HARMONICS: u32 = 8;

impl<'a, T: Number> CamFourierSeriesInput<'a, T> {
    fn rise(&self) -> Option<LawInput<'a, T>> {
        LawInput::new(T::near(self.kind), self.share, self.parameters)
    }

    fn fall(&self) -> Option<LawInput<'a, T>> {
        let kind = T::near(self.return_kind);
        LawInput::new(kind, self.return_share, self.return_parameters)
    }

    fn orders(&self) -> impl Iterator<Item = u32> + use<T> {
        let [first, stride] = [self.cycle.first, self.cycle.stride].map(|n| T::near(n) as u32);
        (0..HARMONICS).map(move |k| first.saturating_add(k.saturating_mul(stride)))
    }
}

impl CamFourierSeriesInput<'_, Rational> {
    /// The rise and, unless there is none, the return.
    fn exact_strokes(&self) -> Option<(ExactStroke, Option<ExactStroke>)> {
        let (rise, fall) = (self.rise()?.reference()?, self.fall()?.reference()?);
        let c = self.cycle;
        let rise = ExactStroke {
            law: rise,
            start: c.start.clone(),
            turns: c.rise.clone(),
        };
        let fall = (*c.fall != 0).then(|| ExactStroke {
            law: fall,
            start: Rational::from(c.start + c.rise) + c.high_dwell,
            turns: c.fall.clone(),
        });
        Some((rise, fall))
    }

    fn exact_orders(&self) -> Orders {
        Orders {
            first: self.cycle.first.to_f64() as u32,
            stride: self.cycle.stride.to_f64() as u32,
            count: HARMONICS,
        }
    }
}

/// Mean and Fourier coefficients of a cam cycle.
///
/// A candidate is a `Fn(CamFourierSeriesInput) -> [[a_0, a_n, b_n]; 8]`.
#[derive(Clone, Copy, Debug)]
pub struct CamFourierSeries;

method! {
    CamFourierSeries "cam-fourier-series": Fn(CamFourierSeriesInput<'_>), |f, i| f(i)
}

fn series(i: CamFourierSeriesInput) -> Result<FourierSeries, &'static str> {
    const LAYOUT: &str = "bad layout";
    let (rise, fall) = (i.rise().ok_or(LAYOUT)?, i.fall().ok_or(LAYOUT)?);
    let stroke = |law: LawInput<f64>, turns| {
        let law = law.solver().map_err(|_| "law")?;
        Ok::<_, &'static str>(Stroke { law, turns })
    };
    let c = i.cycle;
    let rise = stroke(rise, c.rise)?;
    let cycle = if c.fall == 0.0 {
        CamCycle::rise_dwell(c.lift, rise, 1.0 - c.rise)
    } else {
        let fall = stroke(fall, c.fall)?;
        let low = 1.0 - c.rise - c.high_dwell - c.fall;
        CamCycle::new(c.lift, rise, c.high_dwell, fall, low.max(0.0))
    };
    let cycle = cycle
        .and_then(|cycle| cycle.starting_at(c.start))
        .map_err(|_| "cycle")?;
    Ok(FourierSeries::new(&cycle))
}

impl Definition for CamFourierSeries {
    type Input<'a, T: Number> = CamFourierSeriesInput<'a, T>;
    const SUMMARY: &'static str =
        "mean and eight Fourier coefficients of a cam cycle, harmonics up to a million";
    const SOURCE: &'static str = "Gembara & Senyk, eqs (4)-(6), the period being the shaft's turn";

    fn outputs() -> Vec<Output> {
        let mean = Budget::new(
            Limit::Conditioned(4.0),
            "a sum of a few products of angles, each as good as half an ulp of the angles",
        );
        let coefficient = Budget::new(
            Limit::Normwise(64.0),
            "of the largest of all a_n and b_n, which turn into each other with the angle that is zero; for a condition of \
             one (the lift); angles are exact. Some 10 u of each stroke's share; in addition, shares that cancel by up to \
             a half, jumps of derivatives that cancel by up to a factor of 10, eight harmonics all near zeros of a \
             transform by up to a factor of 5",
        );
        vec![
            output("a_0", "m", mean),
            output("a_n", "m", coefficient),
            output("b_n", "m", coefficient),
        ]
    }

    fn rows() -> Option<Rows> {
        Some(Rows {
            index: "k",
            count: "8",
            meaning: "the harmonics first + k stride, a_0 being the same in each",
        })
    }

    fn domain() -> Domain {
        let harmonic = [input::SCCA, 0.5, 2.0, 0.0, 1.0];
        let at = |rise, high_dwell, fall, first| {
            let cycle = CamCycleInput {
                lift: 1.0,
                start: 0.1,
                rise,
                high_dwell,
                fall,
                first,
                stride: 1.0,
            };
            [&cycle.to_vec()[..], &harmonic, &harmonic].concat()
        };
        Domain {
            regions: vec![
                region("scca", "rise, dwell, return, dwell of two SCCA laws", |d| {
                    any_cycle(d, input::any_scca).numbers()
                }),
                region("symmetric-polynomials", "3-4-5 and 4-5-6-7", |d| {
                    any_cycle(d, input::any_symmetric).numbers()
                }),
                region(
                    "asymmetric",
                    "5 to 95 % of a stroke spent accelerating",
                    |d| any_cycle(d, input::any_asymmetric).numbers(),
                ),
                region("polynomials", "degree 1 to 12", |d| {
                    any_cycle(d, input::any_polynomial).numbers()
                }),
                region("tables", "splines on 3 to 7 knots", |d| {
                    any_cycle(d, input::any_table).numbers()
                }),
                region("indexing", "a rise in each turn and no return", |d| {
                    let mut drawn = any_cycle(d, input::any_scca);
                    drawn.cycle.rise = d.uniform(0.2, 1.0);
                    (drawn.cycle.high_dwell, drawn.cycle.fall) = (0.0, 0.0);
                    drawn.numbers()
                }),
                region(
                    "short-strokes",
                    "strokes of 0.001 to 0.1 turns, harmonics 1 to 8",
                    |d| {
                        let mut drawn = any_cycle(d, input::any_asymmetric);
                        drawn.cycle.rise = d.log_uniform(1e-3, 0.1);
                        drawn.cycle.fall = d.log_uniform(1e-3, 0.1);
                        (drawn.cycle.first, drawn.cycle.stride) = (1.0, 1.0);
                        drawn.numbers()
                    },
                ),
                region(
                    "removable-singularities",
                    "n B b or n B d within 1e-12 to 1e-3 of 1/2",
                    |d| near_singularity(d).numbers(),
                ),
            ],
            check_points: vec![
                point("paper-law", at(1.0 / 3.0, 1.0 / 6.0, 0.25, 1.0)),
                point("indexing-cam", at(1.0 / 3.0, 0.0, 0.0, 1.0)),
                point("last", at(1.0 / 3.0, 1.0 / 6.0, 0.25, 999_993.0)),
            ],
        }
    }

    fn admits(i: Self::Input<'_, f64>) -> bool {
        let whole = i.cycle.first.fract() == 0.0 && i.cycle.stride.fract() == 0.0;
        whole && i.rise().is_some() && i.fall().is_some()
    }

    fn solve(i: Self::Input<'_, f64>) -> Result<Vec<f64>, &'static str> {
        let series = series(i)?;
        let mut values = Vec::new();
        for n in i.orders() {
            let h = series.harmonic(n).map_err(|_| "harmonic")?;
            values.extend([series.mean(), h.a, h.b]);
        }
        Ok(values)
    }

    fn reference(i: Self::Input<'_, Rational>, bits: u32) -> Result<ReferenceAnswer, Uncertified> {
        let strokes = i.exact_strokes();
        let (rise, fall) = strokes.ok_or(Uncertified::Refused("bad layout"))?;
        if i.orders().any(|n| !(1..=LAST_HARMONIC).contains(&n)) {
            return Err(Uncertified::Refused("harmonic"));
        }
        let (lift, fall) = (i.cycle.lift, fall.as_ref());
        let mean = reference::mean(lift, &rise, fall, bits);
        let mut values = Vec::new();
        for [a, b] in reference::harmonics(lift, &rise, fall, i.exact_orders(), bits) {
            values.extend([mean.clone(), a, b]);
        }
        Ok(ReferenceAnswer::bounded(
            values,
            "zones and polynomial pieces integrated in balls, phases reduced exactly \
             (reference::fourier_series)",
        ))
    }

    /// Of the mean all lengths are known to half an ulp, of the harmonics the lift alone; of a
    /// table also its data. Both follow from the values: the mean is a sum of terms proportional
    /// to one length each.
    fn conditions(numbers: &[f64]) -> Option<Vec<f64>> {
        conditions_at_reference::<Self>(numbers, BITS_OF_CONDITIONS)
    }

    fn conditions_at(numbers: &[f64], values: &[Ball]) -> Option<Vec<f64>> {
        let i = Self::unpack(numbers)?;
        let q = exact(numbers)?;
        let fractions = Self::unpack(&q)?;
        let size = |part: Option<ExactLaw>, left: bool| {
            let mean = part?.mean(BITS_OF_CONDITIONS);
            let mean = if left {
                Ball::integer(BITS_OF_CONDITIONS, 1) - mean
            } else {
                mean
            };
            Some(mean.magnitude().to_f64())
        };
        let (rise, fall) = (fractions.rise()?.reference(), fractions.fall()?.reference());
        let c = i.cycle;
        let lengths = c.lift.abs()
            * match c.fall == 0.0 {
                true => c.start.abs() + c.rise * size(rise, true)?,
                false => {
                    let rise = c.rise * size(rise, false)?;
                    rise + c.high_dwell + c.fall * size(fall, true)?
                }
            };
        let own = values.iter().enumerate().map(|(i, v)| {
            let size = v.magnitude().to_f64();
            if i % 3 == 0 { size + lengths } else { size }
        });
        let mut sums: Vec<f64> = own.collect();
        let tables = [i.rise()?.is_table(), i.fall()?.is_table() && c.fall != 0.0];
        if tables.contains(&true) {
            let (rise, fall) = fractions.exact_strokes()?;
            let mut data = vec![Mag::ZERO; sums.len()];
            let strokes = std::iter::once(rise).chain(fall).zip(tables);
            for stroke in strokes.filter_map(|(stroke, table)| table.then_some(stroke)) {
                let (mean, harmonics) = reference::data_conditions(
                    fractions.cycle.lift,
                    &stroke,
                    fractions.exact_orders(),
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

    fn laws() -> Vec<Law> {
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
    let i = CamFourierSeries::unpack(x)?;
    let series = series(i).ok()?;
    Some(largest(i.orders().map(|n| law(&series, n))))
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
        Ok(h) if h.amplitude() == 0.0 => 0.0,
        Ok(h) => h.amplitude() / series.tail_bound(n - 1, 0),
        Err(_) => f64::NAN,
    }
}

/// A cycle as it is drawn, its two laws as they are laid out.
struct Drawn {
    cycle: CamCycleInput<'static>,
    laws: [Vec<f64>; 2],
}

impl Drawn {
    fn numbers(&self) -> Vec<f64> {
        [self.cycle.to_vec(), self.laws.concat()].concat()
    }
}

/// Two laws of a family and up to the millionth harmonic, in steps of about a third of a period of
/// the transform.
fn any_cycle(d: &mut Draw, law: fn(&mut Draw) -> Vec<f64>) -> Drawn {
    let (rise, fall) = (d.uniform(0.1, 0.45), d.uniform(0.1, 0.45));
    let high_dwell = d.uniform(0.0, 1.0 - rise - fall);
    let first = d.log_uniform(1.0, 9e5).floor();
    let stride = if first < 20.0 {
        1.0
    } else {
        d.integer(1, 7) as f64
    };
    let lift = d.log_uniform(1e-3, 10.0);
    let start = d.uniform(-1.0, 1.0);
    let cycle = CamCycleInput {
        lift,
        start,
        rise,
        high_dwell,
        fall,
        first,
        stride,
    };
    let laws = [law(d), law(d)];
    Drawn { cycle, laws }
}

fn near_singularity(d: &mut Draw) -> Drawn {
    let mut drawn = any_cycle(d, input::any_scca);
    // Random shares, not those of a named law.
    let share = d.uniform(0.05, 0.9);
    let (b, dd) = if d.chance(0.5) {
        (share, 0.0)
    } else {
        (0.0, share)
    };
    drawn.laws = [(); 2].map(|()| vec![input::SCCA, 0.5, 2.0, b, dd]);
    let least = (0.5 / (0.45 * share)).ceil();
    let n = least + d.integer(0, (4.0 * least) as usize) as f64;
    let off = d.log_uniform(1e-12, 1e-3);
    let off = 1.0 + d.signed(off);
    let c = &mut drawn.cycle;
    c.rise = 0.5 / (n * share) * off;
    c.fall = 0.5 / ((n + 1.0) * share);
    c.high_dwell = d.uniform(0.0, 1.0 - c.rise - c.fall);
    (c.first, c.stride) = (n, 1.0);
    drawn
}

#[cfg(test)]
mod tests;

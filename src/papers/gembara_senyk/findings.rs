//! Consequences of the misprints and of the model, in figures.

use super::amplitude::{Formula, Passage};
use super::charts::{self, Law, Programme};
use crate::papers::{Analysis, Found};
use crate::reference::{Ball, Undecided};
use crate::solvers::chirp_chart::{BeatZone, Chart, ChartPoint, ChirpChartError};
use rayon::prelude::*;
use rug::Rational;

/// Amplitudes by the printed formulas, and charts.
///
/// # Errors
/// None; the signature is that of every paper.
pub(in crate::papers) fn analysis() -> Result<Analysis, Undecided> {
    let mut analysis = Analysis::default();
    formulas(&mut analysis);
    // An oscillator that was refused leaves its findings without figures.
    if let (Ok(k), Ok(constant)) = (Charts::of(Law::K), Charts::of(Law::Constant)) {
        let charts = [k, constant];
        analysis.add("sum-of-moduli", sum_of_moduli(&charts));
        analysis.add("run-up-for-run-down", run_up_for_run_down(&charts));
    }
    Ok(analysis)
}

/// Working precision of the enclosures.
const PREC: u32 = 160;
/// Radius of an enclosure to 20 digits, and the size below which an error counts as zero.
const ENCLOSED: f64 = 1e-20;
/// w = 10, n = 1/2, ε = 4, k = 2: the resonance is passed at t = 1.25 s.
const OSCILLATOR: [(i32, u32); 4] = [(10, 1), (1, 2), (4, 1), (2, 1)];

fn passage(t: (i32, u32)) -> Passage {
    let [w, n, eps, k] = OSCILLATOR;
    Passage([w, n, eps, k, t].map(Rational::from))
}

fn middle(b: &Ball) -> f64 {
    b.mid().to_f64()
}

/// The errors of a formula at t = 0.1 … 5 s, and whether all are enclosed well enough to be
/// printed.
fn over_time(all: &[Vec<Ball>], formula: Formula) -> (Vec<f64>, bool) {
    let errors: Vec<Ball> = all.iter().map(|e| e[formula as usize].clone()).collect();
    (errors.iter().map(middle).collect(), sharp(&errors))
}

fn sharp(errors: &[Ball]) -> bool {
    errors.iter().all(|e| e.rad().to_f64() < ENCLOSED)
}

fn vanish(errors: &[f64]) -> bool {
    errors.iter().all(|e| e.abs() < ENCLOSED)
}

/// The largest of either sign, with its time.
fn worst(errors: &[f64]) -> (f64, f64) {
    let times = (1..).map(|i| 0.1 * f64::from(i));
    let timed = times.zip(errors.iter().copied());
    let worst = timed.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    worst.unwrap_or_default()
}

/// The relative errors of (18) and (19) as printed just after the resonance, and the largest over
/// time with its moment; how near (18) comes to the stationary magnification.
fn formulas(analysis: &mut Analysis) {
    let percent = |x: f64| format!("{:.2}", 100.0 * x);
    let times = (1..=50).collect::<Vec<i32>>().into_par_iter();
    let all: Vec<Vec<Ball>> = times.map(|i| passage((i, 10)).errors(PREC)).collect();
    let (corrected, sharp) = over_time(&all, Formula::Corrected);
    let holds = sharp && vanish(&corrected);
    for (id, formula) in [
        ("amplitude-as-printed", Formula::Printed18),
        ("chart-formula-as-printed", Formula::Printed19),
    ] {
        let (errors, sharp) = over_time(&all, formula);
        let (time, worst) = worst(&errors);
        // t = 1.5 s.
        let after = errors[14];
        let found = Found::values([percent(after), percent(worst)], holds && sharp);
        analysis.add(id, found.worded([format!("{time:.1}")]));
    }
    // kε t = 8 with kε = 1/10, 1/1000, 1/100000.
    let due = 100.0 / 36f64.hypot(8.0);
    let stationary = [10, 1000, 100_000].map(|d: i32| {
        let values = [(10, 1), (1, 2), (1, d as u32), (1, 1), (8 * d, 1)];
        let moduli = Passage(values.map(Rational::from)).moduli(PREC);
        let off = middle(&moduli[Formula::Corrected as usize]) / due - 1.0;
        format!("{off:.2e}")
    });
    analysis.add("stationary-limit", Found::values(stationary, true));
}

/// Charts of a law, run-up and run-down.
struct Charts {
    up: Chart,
    down: Chart,
}

impl Charts {
    fn of(law: Law) -> Result<Charts, ChirpChartError> {
        Ok(Charts {
            up: charts::chart(law, Programme::RunUp)?,
            down: charts::chart(law, Programme::RunDown)?,
        })
    }
}

/// The difference of two curves at each abscissa, relative to the second.
fn differences(a: &Chart, b: &Chart, curve: fn(&ChartPoint) -> f64) -> Vec<f64> {
    let pairs = a.points.iter().zip(&b.points);
    pairs.map(|(a, b)| curve(a) / curve(b) - 1.0).collect()
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let largest = values
        .into_iter()
        .max_by(|a, b| a.abs().total_cmp(&b.abs()));
    largest.unwrap_or_default()
}

/// For each beat zone of the first the relative distance to the nearest one of the second.
fn shifts(a: &[BeatZone], b: &[BeatZone]) -> Vec<f64> {
    let nearest = |z: &BeatZone| {
        let shift = |other: &BeatZone| other.xi / z.xi - 1.0;
        b.iter()
            .map(shift)
            .min_by(|x, y| x.abs().total_cmp(&y.abs()))
    };
    a.iter().filter_map(nearest).collect()
}

/// By laws the least and the largest ratio of Σ|A_n| to the true peak of the displacement, and how
/// many maxima Σ|A_n|, displacement and acceleration have.
fn sum_of_moduli(charts: &[Charts; 2]) -> Found {
    let ratio = |p: &ChartPoint| p.bound / p.displacement;
    let values = |c: &Charts| {
        let ratios = c.up.points.iter().map(ratio);
        let most = ratios.clone().fold(0.0, f64::max);
        let least = ratios.fold(f64::INFINITY, f64::min);
        let maxima = |of: fn(&ChartPoint) -> f64| c.up.beats(of).len();
        let formula = maxima(|p| p.bound);
        let peaks = [maxima(|p| p.displacement), maxima(|p| p.acceleration)];
        [
            format!("{least:.3}, {most:.3}"),
            format!("{formula}, {}, {}", peaks[0], peaks[1]),
        ]
    };
    Found::values(charts.iter().flat_map(values), true)
}

/// By laws the largest differences of run-up and run-down, in peaks and in places of beat zones;
/// the largest of all in words.
fn run_up_for_run_down(charts: &[Charts; 2]) -> Found {
    let curve = |p: &ChartPoint| p.acceleration;
    let off = charts.each_ref().map(|c| {
        let height = largest(differences(&c.up, &c.down, curve));
        [
            height,
            largest(shifts(&c.down.beats(curve), &c.up.beats(curve))),
        ]
    });
    let most = [0, 1].map(|k| largest(off.map(|o| o[k])).abs());
    let values = off.iter().flatten().map(|x| format!("{:+.2}", 100.0 * x));
    Found::values(values, true).worded(most.map(|x| format!("{:.1}", 100.0 * x)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Mag;

    #[test]
    fn errors_are_enclosed_to_twenty_digits() {
        for (size, due) in [(0.9e-20, true), (1.1e-20, false)] {
            let ball = |radius: f64| Ball::integer(PREC, 1).widened(Mag::from_f64(radius));
            assert_eq!(sharp(&[ball(0.0), ball(size)]), due);
            assert!(vanish(&[0.0, size]) == due && vanish(&[0.0, -size]) == due);
        }
    }

    #[test]
    fn the_worst_is_the_largest_of_either_sign() {
        assert_eq!(worst(&[0.5, -2.0, 1.0]), (0.2, -2.0));
        assert_eq!(largest([0.5, -2.0, 1.0]), -2.0);
        assert_eq!(largest([]), 0.0);
    }

    /// To the nearest zone on either side, of which there may be none.
    #[test]
    fn beat_zones_are_compared_with_the_nearest() {
        let zone = |xi: &f64| BeatZone {
            xi: *xi,
            value: 1.0,
            spacing: 1.0,
        };
        let zones = |all: &[f64]| -> Vec<BeatZone> { all.iter().map(zone).collect() };
        let (a, b) = (zones(&[2.0, 4.0, 10.0]), zones(&[2.5, 3.9, 4.2]));
        let found = shifts(&a, &b);
        let due = [0.25, -0.025, -0.58];
        assert_eq!(found.len(), 3);
        for (x, y) in found.iter().zip(due) {
            assert!((x - y).abs() < 1e-12, "{found:?}");
        }
        assert!(shifts(&a, &[]).is_empty() && shifts(&[], &a).is_empty());
    }
}

//! Consequences of the misprints and of the model, in figures.

use super::amplitude::{Formula, Passage};
use super::charts::{self, Law, Programme};
use crate::papers::{Draft, Finding, FindingVerdict, Subject, figure, figures};
use crate::reference::Ball;
use crate::solvers::chirp_chart::{BeatZone, Chart, ChartPoint, ChirpChartError};

/// Working precision of the enclosures.
const PREC: u32 = 160;
/// Radius of an enclosure to 20 digits, and the size below which an error counts as zero.
const ENCLOSED: f64 = 1e-20;
/// w = 10, n = 1/2, ε = 4, k = 2: the resonance is passed at t = 1.25 s.
const OSCILLATOR: [(i32, u32); 4] = [(10, 1), (1, 2), (4, 1), (2, 1)];

fn passage(t: (i32, u32)) -> Passage {
    let [w, n, eps, k] = OSCILLATOR;
    Passage::new([w, n, eps, k, t])
}

fn middle(b: &Ball) -> f64 {
    b.mid().to_f64()
}

/// The errors of a formula at t = 0.1 … 5 s, and whether all are enclosed well enough to be
/// printed.
fn over_time(formula: Formula) -> (Vec<f64>, bool) {
    let errors: Vec<Ball> = (1..=50)
        .map(|i| passage((i, 10)).error(formula, PREC))
        .collect();
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

/// (18) and (19) as printed at an oscillator.
pub(super) fn formulas() -> Vec<Finding> {
    let at = passage((3, 2));
    let error = |f| middle(&at.error(f, PREC));
    let (printed, sharp18) = over_time(Formula::Printed18);
    let (chart, sharp19) = over_time(Formula::Printed19);
    let (corrected, sharp) = over_time(Formula::Corrected);
    let holds = sharp && vanish(&corrected);
    let ([t18, worst18], [t19, worst19]) = (worst(&printed).into(), worst(&chart).into());
    let percent = |x: f64| format!("{:.2}", 100.0 * x);
    let of = |formula, worst: f64| {
        figures! {
            "relative error at t = 1.5 s": "{}", percent(error(formula)) => "%";
            "worst found, t = 0.1 … 5 s": "{}", percent(worst) => "%";
        }
    };
    let given = "w = 10 rad/s, n = 0.5 rad/s, ε = 4 rad/s², k = 2";
    vec![
        Draft::new("amplitude-as-printed", Subject::Formula, "(12), (18)")
            .verdict(FindingVerdict::ErrorOfPaper)
            .titled("With U_n as printed the amplitude (18) is wrong by tens of per cent")
            .text(format!(
                "(12) prints −i n in U_n where U_n0 rightly has +i n. At {given} the modulus of (18) \
                 is then off by {} % at t = 1.5 s, just after the resonance, and by {} % at \
                 t = {t18:.1} s, the worst of t = 0.1, 0.2 … 5 s. With +i n it is the convolution \
                 (10) at all fifty times, to the 20 digits enclosed.",
                percent(error(Formula::Printed18)),
                percent(worst18),
            ))
            .figures(of(Formula::Printed18, worst18))
            .only_if(holds && sharp18)
            .recorded(&["32.10", "4575.17"]),
        Draft::new("chart-formula-as-printed", Subject::Formula, "(19)")
            .verdict(FindingVerdict::ErrorOfPaper)
            .titled("W(V_n0) for W(U_n0) in (19) shows until the start has died away")
            .text(format!(
                "(19) repeats W(V_n0) where (18) has W(U_n0). At {given} the modulus is off by {} % \
                 at t = 1.5 s and by {} % at t = {t19:.1} s, the worst of fifty times: the term \
                 belongs to the start and decays with e^(−nt). The prefactor has a 4 too many besides.",
                percent(error(Formula::Printed19)),
                percent(worst19),
            ))
            .figures(of(Formula::Printed19, worst19))
            .only_if(holds && sharp19)
            .recorded(&["0.60", "7.36"]),
        stationary(),
    ]
}

/// ε → 0 at ω = 8.
fn stationary() -> Finding {
    // kε t = 8 with kε = 1/10, 1/1000, 1/100000.
    let due = 100.0 / 36f64.hypot(8.0);
    let figures = [10, 1000, 100_000].map(|d: i32| {
        let p = Passage::new([(10, 1), (1, 2), (1, d as u32), (1, 1), (8 * d, 1)]);
        let rate = 1.0 / f64::from(d);
        let name = format!("relative difference at ω = 8 rad/s, kε = {rate} rad/s²");
        let off = middle(&p.modulus(Formula::Corrected, PREC)) / due - 1.0;
        figure(name, format!("{off:.2e}"), "1")
    });
    Draft::new("stationary-limit", Subject::Formula, "(18)")
        .verdict(FindingVerdict::Confirmed)
        .titled("Corrected, (18) goes over into the textbook's magnification as ε goes to zero")
        .text(
            "At w = 10 rad/s, n = 0.5 rad/s and ω = 8 rad/s the modulus approaches \
             w²/√((w² − ω²)² + 4n²ω²) = 2.71163 in proportion to ε.",
        )
        .figures(figures)
        .recorded(&["-1.12e-2", "-1.07e-4", "-1.07e-6"])
}

/// Charts of both laws, run-up and run-down.
struct Charts {
    law: Law,
    up: Chart,
    down: Chart,
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

/// Findings on the paper's comparison from the charts.
pub(super) fn comparison() -> Vec<Finding> {
    let of = |law| -> Result<Charts, ChirpChartError> {
        Ok(Charts {
            law,
            up: charts::chart(law, Programme::RunUp)?,
            down: charts::chart(law, Programme::RunDown)?,
        })
    };
    match (of(Law::K), of(Law::Constant)) {
        (Ok(k), Ok(constant)) => {
            let charts = [k, constant];
            vec![sum_of_moduli(&charts), run_up_for_run_down(&charts)]
        }
        _ => vec![
            Draft::new("charts", Subject::Claim, "Fig. 5")
                .verdict(FindingVerdict::Unexplained)
                .titled("The charts could not be computed")
                .text("A response of the example's oscillator was refused.")
                .recorded_if(false),
        ],
    }
}

const EXAMPLE: &str = "a cam of 120°, 60°, 120° and 60°, w = 100 rad/s, damping ratio 0.02, \
                       |ε| = 0.2 rad/s², 60 harmonics, ξ = 2.0 … 14.0 in steps of 0.1";

fn sum_of_moduli(charts: &[Charts; 2]) -> Finding {
    let ratio = |p: &ChartPoint| p.bound / p.displacement;
    let mut figures = Vec::new();
    for c in charts {
        let name = c.law.name();
        let ratios: Vec<f64> = c.up.points.iter().map(ratio).collect();
        let most = ratios.iter().copied().fold(0.0, f64::max);
        let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
        let formula = c.up.beats(|p| p.bound).len();
        let true_peaks = c.up.beats(|p| p.displacement).len();
        let accelerations = c.up.beats(|p| p.acceleration).len();
        figures.extend(figures! {
            "Σ|A_n| over the true peak of |φ − a_0|, law {name}, least and largest":
                "{least:.3}, {most:.3}" => "1";
            "maxima of Σ|A_n|, of |φ − a_0|, of the acceleration, law {name}":
                "{formula}, {true_peaks}, {accelerations}" => "1";
        });
    }
    Draft::new("sum-of-moduli", Subject::Claim, "(19), Fig. 5")
        .verdict(FindingVerdict::Refuted)
        .titled("(19) bounds the displacement and says nothing of the acceleration")
        .text(format!(
            "(19) adds moduli as if all harmonics peaked at once, and is compared in Fig. 5 with \
             measured accelerations. For {EXAMPLE}, running up from rest, it exceeds the true peak \
             of the displacement in the turn everywhere; how often its curve has a maximum where \
             the true peaks have one is below: the lesser maxima that the paper misses in its \
             analysis are lost in the sum."
        ))
        .figures(figures)
        .recorded(&["1.309, 1.386", "16, 28, 17", "1.327, 1.468", "15, 28, 17"])
}

fn run_up_for_run_down(charts: &[Charts; 2]) -> Finding {
    let mut figures = Vec::new();
    let mut most = (0.0f64, 0.0f64);
    for c in charts {
        let name = c.law.name();
        let curve = |p: &ChartPoint| p.acceleration;
        let height = largest(differences(&c.up, &c.down, curve));
        let place = largest(shifts(&c.down.beats(curve), &c.up.beats(curve)));
        most = (most.0.max(height.abs()), most.1.max(place.abs()));
        figures.extend(figures! {
            "peak acceleration, run-up against run-down, law {name}, largest difference":
                "{:+.2}", 100.0 * height => "%";
            "place of a beat zone, run-up against run-down, law {name}, largest shift of ξ":
                "{:+.2}", 100.0 * place => "%";
        });
    }
    Draft::new("run-up-for-run-down", Subject::Claim, "conclusions")
        .verdict(FindingVerdict::Confirmed)
        .titled("A run-up formula for a measured run-down: part of the 16 % and the 10 %")
        .text(format!(
            "The paper computes a run-up from rest and measures a run-down; it blames the \
             difference, up to 16 % in the maxima and 10 % in the place of the beat zones, on the \
             formula's law of the speed. For {EXAMPLE}, with the same equation solved both ways, \
             the peak accelerations differ by up to {:.1} % and the beat zones lie up to {:.1} % \
             apart. At the paper's own, unstated rates it may be more or less.",
            100.0 * most.0,
            100.0 * most.1,
        ))
        .figures(figures)
        .recorded(&["-37.31", "-2.93", "+46.35", "+4.54"])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::Mag;

    #[test]
    fn findings_on_formulas_are_as_recorded() {
        let all = formulas();
        let changed: Vec<&str> = all
            .iter()
            .filter(|f| !f.as_recorded)
            .map(|f| f.id)
            .collect();
        assert!(all.len() == 3 && changed.is_empty(), "{changed:?}");
    }

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

    #[test]
    fn findings_on_charts_are_as_recorded() {
        let all = comparison();
        let found: Vec<(&str, bool)> = all.iter().map(|f| (f.id, f.as_recorded)).collect();
        assert_eq!(
            found,
            [("sum-of-moduli", true), ("run-up-for-run-down", true)]
        );
        let text = &all[1].text;
        assert!(text.contains("differ by up to 46.4 %"), "{text}");
        assert!(text.contains("lie up to 4.5 %"), "{text}");
    }
}

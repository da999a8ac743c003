//! Consequences of the model, in figures.

use super::charts::chart;
use crate::papers::file::Measured;
use crate::reference::Undecided;
use crate::solvers::chirp_chart::{BeatZone, Chart, ChartPoint};

/// Compares charts.
///
/// # Errors
/// None; the signature is that of every paper.
pub(in crate::papers) fn analysis() -> Result<Measured, Undecided> {
    let mut measured = Measured::default();
    for (name, law) in [("K", "К"), ("0050", "0050")] {
        // An oscillator that was refused leaves its findings without figures.
        if let (Some(up), Some(down)) = (chart(law, true), chart(law, false)) {
            compare(name, &up, &down, &mut measured);
        }
    }
    Ok(measured)
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

/// Of a law the least and the largest ratio of Σ|A_n| to the true peak of the displacement, how
/// many maxima Σ|A_n|, displacement and acceleration have, and the largest differences of run-up
/// and run-down, in peaks and in places of beat zones.
fn compare(name: &str, up: &Chart, down: &Chart, measured: &mut Measured) {
    let ratios = up.points.iter().map(|p| p.bound / p.displacement);
    let acceleration = |p: &ChartPoint| p.acceleration;
    let maxima = |of: fn(&ChartPoint) -> f64| up.beats(of).len() as f64;
    for (key, x) in [
        ("least", ratios.clone().fold(f64::INFINITY, f64::min)),
        ("most", ratios.fold(0.0, f64::max)),
        ("maxima", maxima(|p| p.bound)),
        ("beats", maxima(|p| p.displacement)),
        ("peaks", maxima(acceleration)),
        ("height", largest(differences(up, down, acceleration))),
        (
            "shift",
            largest(shifts(&down.beats(acceleration), &up.beats(acceleration))),
        ),
    ] {
        measured.set(format!("{key}_{name}"), x);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_the_largest_of_either_sign() {
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

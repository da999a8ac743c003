//! Drawings of a cam-driven oscillator.

use crate::cli::failure::Failure;
use mechaudit::machine::cam_oscillator::{CamOscillator, LawChart, Run};
use mechaudit::report::svg::chirp::{self, Column, History, Spectrum};
use mechaudit::solvers::chirp_chart::{CamResponse, State};
use mechaudit::solvers::fourier_series::FourierSeries;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Columns of a history.
const COLUMNS: usize = 1200;
const SAMPLES_IN_COLUMN: f64 = 24.0;

/// The motion over time.
pub fn history(machine: &CamOscillator, run: &Run, response: &CamResponse) -> String {
    let oscillator = &machine.drive.oscillator;
    let note = format!(
        "law {}, w = {} rad/s, n = {} rad/s, {} harmonics; the envelope is the mean a_0 ± (Σ|A_k| + free vibration)",
        machine.law,
        chirp::tick(oscillator.w()),
        chirp::tick(oscillator.n()),
        machine.harmonics
    );
    chirp::history(&motion(machine, run, response, note))
}

/// The motion over time, for a drawing or a page.
pub fn motion<'a>(
    machine: &'a CamOscillator,
    run: &Run,
    response: &CamResponse,
    note: String,
) -> History<'a> {
    History {
        name: &machine.name,
        note,
        unit: machine.unit,
        mean: response.mean(),
        columns: columns(run, response),
    }
}

fn columns(run: &Run, response: &CamResponse) -> Vec<Column> {
    let drive = response.drive();
    let width = run.duration / COLUMNS as f64;
    let speeds = [0.0, run.duration].map(|t| drive.speed(t));
    let samples = samples(speeds, drive.oscillator.w(), width);
    let one = |k: usize| {
        let start = width * k as f64;
        let mut ranges = [[f64::INFINITY, f64::NEG_INFINITY]; 3];
        for i in 0..samples {
            let t = start + width * (i as f64 / samples as f64);
            let s: State = response.state(t).unwrap_or_default();
            for (range, v) in ranges
                .iter_mut()
                .zip([s.displacement, s.cam, s.acceleration])
            {
                *range = [range[0].min(v), range[1].max(v)];
            }
        }
        Column {
            times: [start, start + 0.5 * width],
            ranges,
            envelope: response.envelope(start).unwrap_or(f64::NAN),
            speed: drive.speed(start),
        }
    };
    (0..COLUMNS).into_par_iter().map(one).collect()
}

/// The number of looks at a column of that many seconds: eight times in a period of the oscillator,
/// and of the tenth harmonic at the faster of the speeds that the shaft begins and ends with.
fn samples(speeds: [f64; 2], w: f64, width: f64) -> usize {
    let fastest = speeds.map(|s| 10.0 * s.abs()).into_iter().fold(w, f64::max);
    (8.0 * fastest * width / TAU)
        .clamp(1.0, SAMPLES_IN_COLUMN)
        .ceil() as usize
}

/// C_φ(ξ) of each law.
pub fn chart(machine: &CamOscillator, charts: &[LawChart]) -> String {
    let drive = &machine.drive;
    let note = format!(
        "n/w = {}, from {} rad/s with {} rad/s²; peaks are those of the turn about each point",
        chirp::tick(drive.oscillator.n() / drive.oscillator.w()),
        chirp::tick(drive.chirp.omega0),
        chirp::tick(drive.chirp.eps),
    );
    let charts: Vec<_> = charts.iter().map(|c| (c.law.as_str(), &c.chart)).collect();
    chirp::chart(&machine.name, &note, &charts)
}

/// The harmonics of the cam's displacement.
pub fn spectrum(machine: &CamOscillator) -> Result<String, Failure> {
    Ok(chirp::spectrum(&harmonics(machine)?))
}

/// The harmonics in lifts, for a drawing or a page.
pub fn harmonics(machine: &CamOscillator) -> Result<Spectrum<'_>, Failure> {
    let series = FourierSeries::new(&machine.drive.cycle);
    let lift = machine.drive.cycle.lift().abs();
    let all = series.harmonics(machine.harmonics);
    let all = all.map_err(Failure::caused)?;
    let of = |f: &dyn Fn(u32, f64) -> f64| -> Vec<(f64, f64)> {
        let points = all.iter().map(|h| (h.order, h.amplitude()));
        points
            .map(|(n, d)| (f64::from(n), f(n, d) / lift))
            .collect()
    };
    Ok(Spectrum {
        name: &machine.name,
        law: &machine.law,
        harmonics: of(&|_, amplitude| amplitude),
        beyond: of(&|order, _| series.tail_bound(order, 0)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::machine::Source;

    const RUN_UP: &str = include_str!("../../../../examples/chirp-run-up.toml");

    fn machine(speed: &str, duration: &str) -> CamOscillator {
        let text = RUN_UP.replace("[speed]", &format!("[speed]\nstart = \"{speed}\""));
        let text = text.replace("\"12 s\"", &format!("\"{duration}\""));
        CamOscillator::read(&Source::toml(text), Some(5)).unwrap()
    }

    /// Against a hundred states in every column.
    #[test]
    fn a_column_holds_the_motion_while_it_lasts() {
        let machine = machine("20 rad/s", "12 s");
        let run = machine.run.unwrap();
        let response = machine.response(&machine.drive).unwrap();
        let all = columns(&run, &response);
        assert_eq!(all.len(), 1200);
        let values = |t: f64| {
            let s = response.state(t).unwrap();
            [s.displacement, s.cam, s.acceleration]
        };
        for k in [0, 1, 500, 1199] {
            let (column, start) = (&all[k], 0.01 * k as f64);
            let near = |x: f64, due: f64| assert!((x - due).abs() < 1e-11, "{k}: {x} {due}");
            near(column.times[0], start);
            near(column.times[1], start + 0.005);
            near(column.speed, 20.0 + 2.5 * start);
            assert_eq!(column.envelope, response.envelope(column.times[0]).unwrap());
            let fine: Vec<[f64; 3]> = (0..100)
                .map(|i| values(start + 0.01 * f64::from(i) / 100.0))
                .collect();
            let first = values(column.times[0]);
            for i in 0..3 {
                let [low, high] = column.ranges[i];
                let least = fine.iter().map(|v| v[i]).fold(f64::INFINITY, f64::min);
                let most = fine.iter().map(|v| v[i]).fold(f64::NEG_INFINITY, f64::max);
                let slack = 0.45 * (most - least) + 1e-12;
                assert!(low <= first[i] && first[i] <= high, "{k} {i}");
                for (x, due) in [(low, least), (high, most)] {
                    assert!((x - due).abs() <= slack, "{k} {i}: {x} {due}");
                }
            }
        }
    }

    /// The heights of bars and of the bound are shares of the lift, so that they do not know its
    /// size.
    #[test]
    fn a_spectrum_is_one_of_shares() {
        let drawn = |lift: &str| {
            let text = RUN_UP.replace("\"20 mm\"", lift);
            let machine = CamOscillator::read(&Source::toml(text), Some(12)).unwrap();
            spectrum(&machine).unwrap()
        };
        let curves = |svg: &str| svg.matches("<path").count() + svg.matches("<polyline").count();
        let (small, large) = (drawn("\"1 mm\""), drawn("\"1024 mm\""));
        assert!(curves(&small) > 0 && small.contains("<title>"));
        assert_eq!(small, large);
    }

    /// The faster end decides, whichever it is and whichever way the shaft turns.
    #[test]
    fn columns_are_looked_at_as_often_as_the_shaft_is_fast() {
        let second = |speeds| samples(speeds, 0.5 * TAU, 1.0);
        for (speeds, due) in [
            ([0.0, 0.0], 4),
            ([0.0, 0.1 * TAU], 8),
            ([0.1 * TAU, 0.0], 8),
            ([-0.1 * TAU, 0.05 * TAU], 8),
            ([0.01 * TAU, 0.02 * TAU], 4),
            ([0.0, 9.0], 24),
        ] {
            assert_eq!(second(speeds), due, "{speeds:?}");
        }
        assert_eq!(samples([0.0; 2], TAU, 1e-3), 1);
    }
}

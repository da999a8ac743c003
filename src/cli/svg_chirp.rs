//! Drawings of a cam-driven oscillator: its motion over time, charts, the cam's spectrum.

use super::failure::Failure;
use super::svg_panel::{Curve, Place, curve, dashed, drawn, legend, panel, tick, titled};
use super::svg_style::{AXIS, BLUE, GREEN, GRID, INK, ORANGE};
use mechaudit::machine::cam_oscillator::{CamOscillator as Machine, LawChart as Charted, Run};
use mechaudit::solvers::chirp_chart::{CamResponse, ChartPoint, Period, State};
use mechaudit::solvers::fourier_series::FourierSeries;
use plotters::prelude::*;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// Columns of a history: with the least and the largest value of each it looks like all of them.
const BINS: usize = 1200;
const SAMPLES_IN_BIN: f64 = 24.0;

/// A wave that fills its columns is drawn finer.
fn finely(curve: Curve) -> Curve {
    Curve { width: 1, ..curve }
}

/// What one column of a history holds.
struct Bin {
    times: [f64; 2],
    /// Least and largest `y`, `f` and `y″`.
    ranges: [[f64; 2]; 3],
    envelope: f64,
    speed: f64,
}

fn bins(run: &Run, response: &CamResponse) -> Vec<Bin> {
    let drive = response.drive();
    let width = run.duration / BINS as f64;
    let fastest = [0.0, run.duration].map(|t| 10.0 * drive.speed(t).abs());
    let fastest = fastest[0].max(fastest[1]).max(drive.oscillator.w());
    let samples = (8.0 * fastest * width / TAU)
        .clamp(1.0, SAMPLES_IN_BIN)
        .ceil() as usize;
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
        Bin {
            times: [start, start + 0.5 * width],
            ranges,
            envelope: response.envelope(start).unwrap_or(f64::NAN),
            speed: drive.speed(start),
        }
    };
    (0..BINS).into_par_iter().map(one).collect()
}

/// The motion over time.
pub fn history(machine: &Machine, run: &Run, response: &CamResponse) -> Result<String, Failure> {
    let all = bins(run, response);
    let thinned = |i: usize| -> Vec<(f64, f64)> {
        let ends = all.iter().flat_map(|b| {
            let [low, high] = b.ranges[i];
            [(b.times[0], low), (b.times[1], high)]
        });
        ends.collect()
    };
    let along = |f: &dyn Fn(&Bin) -> f64| -> Vec<(f64, f64)> {
        all.iter().map(|b| (b.times[0], f(b))).collect()
    };
    let mean = response.mean();
    let unit = machine.unit;
    let note = format!(
        "law {}, w = {} rad/s, n = {} rad/s, {} harmonics; the envelope is the mean a_0 ± (Σ|A_k| + free vibration)",
        machine.law,
        tick(machine.drive.oscillator.w()),
        tick(machine.drive.oscillator.n()),
        machine.harmonics
    );
    drawn((1000, 1080), |root, page| {
        let areas = titled(root, page, &machine.name, &note)?.split_evenly((3, 1));
        let motion = [
            finely(curve("cam f", thinned(1), GREEN)),
            finely(curve("y", thinned(0), BLUE)),
            dashed("envelope", along(&|b| mean + b.envelope), ORANGE),
            dashed("", along(&|b| mean - b.envelope), ORANGE),
        ];
        panel(
            &areas[0],
            page,
            ("time, s", &format!("displacement, {unit}")),
            &motion,
        )?;
        let acceleration = [finely(curve("y″", thinned(2), BLUE))];
        panel(
            &areas[1],
            page,
            ("time, s", &format!("acceleration, {unit}/s²")),
            &acceleration,
        )?;
        let speed = [curve("shaft", along(&|b| b.speed), ORANGE)];
        panel(&areas[2], page, ("time, s", "speed, rad/s"), &speed)
    })
}

/// C_φ(ξ) of each law, formula against true peak.
pub fn chart(machine: &Machine, charts: &[Charted]) -> Result<String, Failure> {
    let rows = charts.len();
    let xi = match charts.first().map(|c| c.chart.period) {
        Some(Period::Turn) => "ξ, the turn as period",
        _ => "ξ, the rise as period",
    };
    let zeta = machine.drive.oscillator.n() / machine.drive.oscillator.w();
    let note = format!(
        "n/w = {}, from {} rad/s with {} rad/s²; peaks are those of the turn about each point",
        tick(zeta),
        tick(machine.drive.chirp.omega0),
        tick(machine.drive.chirp.eps),
    );
    drawn((1240, 100 + 360 * rows as u32), |root, page| {
        let areas = titled(root, page, &machine.name, &note)?.split_evenly((rows, 2));
        for (c, pair) in charts.iter().zip(areas.chunks(2)) {
            let along = |f: fn(&ChartPoint) -> f64| -> Vec<(f64, f64)> {
                c.chart
                    .points
                    .iter()
                    .map(|p| (c.chart.xi(p), f(p)))
                    .collect()
            };
            let displacement = [
                curve("true peak of |y − a_0|", along(|p| p.displacement), BLUE),
                dashed("formula (19), Σ|A_k|", along(|p| p.bound), ORANGE),
            ];
            let label = format!("{}: displacement, lifts", c.law);
            panel(&pair[0], page, (xi, &label), &displacement)?;
            let rigid = c
                .chart
                .points
                .iter()
                .map(|p| (c.chart.xi(p), c.chart.rigid[0]));
            let acceleration = [
                curve("true peak C_φ", along(|p| p.acceleration), BLUE),
                dashed("w² Σ|D_k − A_k|", along(|p| p.acceleration_bound), ORANGE),
                curve("C", rigid.collect(), GREEN),
            ];
            let label = format!("{}: C_φ, h(Ω/β)²", c.law);
            panel(&pair[1], page, (xi, &label), &acceleration)?;
        }
        Ok(())
    })
}

/// The harmonics of the cam's displacement.
pub fn spectrum(machine: &Machine) -> Result<String, Failure> {
    let series = FourierSeries::new(&machine.drive.cycle);
    let lift = machine.drive.cycle.lift().abs();
    let all = series.harmonics(machine.harmonics);
    let all = all.map_err(|e| Failure::new(e.to_string()))?;
    let lines: Vec<(f64, f64)> = all
        .iter()
        .map(|h| (f64::from(h.order), h.amplitude() / lift))
        .collect();
    let largest = lines.iter().map(|l| l.1).fold(0.0, f64::max).max(1e-12);
    // Harmonics that vanish have no place on the axis.
    let floor = lines.iter().map(|l| l.1).filter(|d| *d > 1e-9 * largest);
    let low = 10f64.powf(floor.fold(largest, f64::min).log10().floor());
    let rest = all.iter().map(|h| {
        let n = f64::from(h.order);
        (n, series.tail_bound(h.order, 0) / lift)
    });
    let rest: Vec<(f64, f64)> = rest.filter(|p| p.1 >= low && p.1.is_finite()).collect();
    let high = rest.iter().map(|p| p.1).fold(largest, f64::max);
    let high = 10f64.powf(high.log10().ceil());
    let last = f64::from(machine.harmonics).max(10.0);
    drawn((1000, 640), |root, page| {
        let note = format!(
            "law {}, amplitudes D_n of the displacement in lifts",
            machine.law
        );
        let area = titled(root, page, &machine.name, &note)?;
        let mut chart = ChartBuilder::on(&area)
            .margin(8)
            .margin_right(20)
            .margin_top(34)
            .x_label_area_size(52)
            .y_label_area_size(84)
            .build_cartesian_2d((0.9..last * 1.1).log_scale(), (low..high).log_scale())?;
        chart
            .configure_mesh()
            .x_label_formatter(&|n| tick(*n))
            .y_label_formatter(&|y| format!("{y:.0e}"))
            .x_desc("harmonic n")
            .y_desc("D_n, lifts")
            .label_style(("sans-serif", 15).into_font().color(&INK))
            .axis_desc_style(("sans-serif", 17).into_font().color(&INK))
            .axis_style(AXIS)
            .bold_line_style(GRID)
            .light_line_style(TRANSPARENT)
            .draw()?;
        let log = |(n, d): &(f64, f64)| (n.log10(), d.log10());
        let (left, right) = (0.9f64.log10(), (last * 1.1).log10());
        let place = Place::of(&chart, left..right, low.log10()..high.log10());
        for line in lines.iter().filter(|l| l.1 > low) {
            let stem = [(line.0, low), *line].iter().map(log).collect();
            page.line(&place, &finely(curve("", stem, BLUE)));
            page.dot(&place, log(line), BLUE);
        }
        let rest = rest.iter().map(log).collect();
        page.line(&place, &dashed("", rest, ORANGE));
        let names = [
            curve("D_n", Vec::new(), BLUE),
            dashed(
                "bound on all harmonics beyond n together",
                Vec::new(),
                ORANGE,
            ),
        ];
        legend(&area, &names)
    })
}
